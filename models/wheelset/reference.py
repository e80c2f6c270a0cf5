"""The reference run beside the model: python -m models.wheelset.reference writes reference.csv anew.

A linear creep law stands for the contacts, so the numbers are those of the wheelset and of the geometry alone.
"""

from __future__ import annotations

from pathlib import Path

from models.wheelset import master
from models.wheelset.components import Component, DirectWheelset, LinearContact
from models.wheelset.master import History
from models.wheelset.model import WheelsetModel
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import MOTION, SIDES

PATH = Path(__file__).with_name("reference.csv")
SPEED, LATERAL = 28.0, 4e-3  # [m/s], [m]
STEP, DURATION, EVERY = 1e-3, 1.0, 20
CREEP_COEFFICIENT = 8e6  # [N]
COLUMNS = (
    "time",
    *MOTION,
    *(
        f"{side}.{name}"
        for side in SIDES
        for name in (
            "creepage.longitudinal",
            "creepage.lateral",
            "creepage.spin",
            "load.normal_force",
            "contact.y",
            "contact.angle",
        )
    ),
)


def simulate(wheelset: Component | None = None) -> History:
    """The run of `reference.csv`, of a `wheelset` that starts at LATERAL with SPEED, or of the model itself."""
    if wheelset is None:
        wheelset = DirectWheelset(WheelsetModel(WheelsetParameters(speed=SPEED, lateral=LATERAL)))
    contacts = [LinearContact(CREEP_COEFFICIENT) for _ in SIDES]
    return master.run(wheelset, contacts, speed=SPEED, step=STEP, duration=DURATION)


if __name__ == "__main__":
    simulate().write_csv(PATH, COLUMNS, EVERY)
