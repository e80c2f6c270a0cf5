"""The reference run of the model: ``python -m contact_models.wheelset.reference`` writes reference.csv again.

The contacts are a linear creep law, so the results depend only on the wheelset and the geometry.
"""

from __future__ import annotations

from pathlib import Path

from . import master
from .components import Component, DirectWheelset, LinearContact
from .master import History
from .model import WheelsetModel
from .parameters import WheelsetParameters
from .ports import MOTION, SIDES

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
    """Return the run of `reference.csv`. `wheelset` must start at LATERAL with SPEED; default the Python model."""
    if wheelset is None:
        wheelset = DirectWheelset(WheelsetModel(WheelsetParameters(speed=SPEED, lateral=LATERAL)))
    contacts = [LinearContact(CREEP_COEFFICIENT) for _ in SIDES]
    return master.run(wheelset, contacts, speed=SPEED, step=STEP, duration=DURATION)


if __name__ == "__main__":
    simulate().write_csv(PATH, COLUMNS, EVERY)
