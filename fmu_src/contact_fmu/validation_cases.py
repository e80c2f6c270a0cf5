"""Inputs over time of the validation sets: they visit tread, flange, two patches, lift-off and full slip."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact_models.vehicle.assembly import assemble
from contact_models.vehicle.declared import read
from .variables import Causality, Kind, Table

#: What a scene is called → its beginning and end as shares of the run.
SCENES = {
    "tread": (0.0, 0.2),
    "flange and two patches": (0.2, 0.5),
    "yaw on the tread": (0.5, 0.6),
    "lift-off": (0.6, 0.8),
    "full slip": (0.8, 1.0),
}
_LOAD = 80e3


class Case(NamedTuple):
    """Step [s], times [s] and the inputs that vary, by name, at these times."""

    step: float
    time: Array
    inputs: dict[str, Array]


def case(table: Table, amplitude: float = 1.0, vehicle: str = "") -> Case:
    """Return the inputs for an FMU.

    `amplitude` scales the way to the flange, for profiles whose flange lies nearer. `vehicle` is that of an OpenVehicle.
    """
    step, n = (1e-3, 200) if table.name in ("Vehicle", "OpenVehicle", "Wheelset") else (0.01, 200)
    time = step * np.arange(n + 1, dtype=np.float64)
    share: Array = time / time[-1]

    def through(*points: tuple[float, float]) -> Array:
        at, values = zip(*points, strict=True)
        return np.asarray(np.interp(share, at, values), dtype=np.float64)

    starts = {s.name: s.start for s in table.scalars if s.row.causality is Causality.INPUT}
    load = through((0.0, _LOAD), (0.6, _LOAD), (0.66, 0.0), (0.72, 0.0), (0.78, _LOAD), (1.0, _LOAD))
    slip = through((0.0, 0.0), (0.8, 0.0), (1.0, 0.03))
    found: dict[str, Array] = {}
    if "pose.y" in starts:  # a pair
        speed, spin = (float(starts[name] or 0.0) for name in ("velocity.x", "velocity.spin"))
        lateral = through(
            (0.0, -1e-3), (0.2, 4e-3), (0.28, 7.8e-3), (0.36, 7.45e-3), (0.42, 7.45e-3), (0.5, 1e-3), (1.0, 1e-3)
        )
        roll = through((0.0, 0.0), (0.3, 0.0), (0.36, -0.04), (0.42, -0.04), (0.5, 0.0), (1.0, 0.0))
        yaw = through((0.0, 0.0), (0.5, 0.0), (0.55, 5e-3), (0.6, -5e-3), (0.65, 0.0), (1.0, 0.0))
        found = {
            "pose.y": amplitude * lateral,
            "pose.yaw": yaw,
            "irregularity.roll": roll,
            "velocity.spin": spin * (1.0 + slip),
        }
        found |= {"velocity.x": np.full(n + 1, speed), "load.normal_force": load}
        if "station" in starts:
            found["station"] = speed * time
    elif "creepage.longitudinal" in starts:  # a contact
        found = {
            "creepage.longitudinal": slip + 1e-3 * np.sin(8.0 * math.pi * share),
            "creepage.lateral": 1e-3 * np.cos(6.0 * math.pi * share),
            "creepage.spin": through((0.0, 0.1), (0.2, 0.1), (0.4, 2.0), (0.6, 0.1), (1.0, 0.1)),
            "load.normal_force": load,
        }
        if "geometry.A0" in starts:
            found["geometry.B0"] = through((0.0, 1.0), (0.2, 1.0), (0.4, 8.0), (0.6, 1.0), (1.0, 1.0))
    elif table.name == "Vehicle":
        mu, speed = (float(starts[name] or 0.0) for name in ("friction.coefficient", "speed"))
        found = {
            "friction.coefficient": mu * through((0.0, 1.0), (0.5, 0.5), (1.0, 1.0)),
            "speed": np.full(n + 1, speed),
        }
    elif table.name in ("OpenVehicle", "Wheelset"):
        found = _on_given_forces(vehicle, share)
    return Case(step, time, found)


def _on_given_forces(vehicle: str, share: Array) -> dict[str, Array]:
    """Return the forces of a vehicle without contacts: each wheel carries its load, the first wheelset is pushed and turned."""
    made = assemble(read(vehicle))
    found: dict[str, Array] = {}
    for axle, i in enumerate(made.wheelsets):
        for side in (1, 2):
            found[f"wheel[{2 * axle + side}].force.z"] = np.full(share.size, -float(made.bodies[i]["load"]))
    found["wheel[1].force.y"] = 2e3 * np.sin(4.0 * math.pi * share)
    found["wheel[1].force.x"], found["wheel[2].force.x"] = 1e3 * share, -1e3 * share
    found["wheel[1].moment.z"], found["wheel[2].moment.z"] = -750.0 * share, -750.0 * share
    return found


def columns(table: Table, causality: Causality) -> list[str]:
    """Return the names of the scalars of a set: Reals that every host can write, without bins of damage.

    Those of a matrix have a comma, at which readers of the Cross-Check divide lines.
    """
    return [
        s.name
        for s in table.scalars
        if s.row.causality is causality
        and s.row.kind is Kind.REAL
        and s.row in table.shown
        and not s.name.startswith("accumulated")
    ]
