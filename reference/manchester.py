"""The Manchester contact benchmark, case A-2.2 of Shackleton and Iwnicki 2008, with CONTACT's results (manchester.csv).

A wheelset with S1002 wheels on UIC 60 rails is displaced and yawed by 2.4 mrad per millimetre. Its roll and pitch rate are
given. Each wheel carries 10 kN, including friction.
"""

from __future__ import annotations

import csv
import math
from typing import NamedTuple

import contact
import reference
from contact.geometry import profile
from contact.geometry.records import Patch, Pose, Velocity
from contact.geometry.wheelset import Pair as WheelOnRail
from contact.study import REFERENCE

LOAD, SPEED, FRICTION = 10e3, 2.0, 0.3
#: Largest number of Newton steps for the height of the wheelset, and their relative tolerance of the load.
_MAX_STEPS, _TOLERANCE = 20, 1e-5


class Place(NamedTuple):
    """A position of the benchmark and CONTACT's results, in SI units. Forces act on the wheel; creepages are wheel minus rail.

    Attributes
    ----------
    y, yaw, roll, pitch, side : pose of the wheelset [m], [rad], [rad], its pitch rate [rad/s], and the side of the wheel
    angle : contact angle [rad]
    longitudinal, lateral, spin : creepages over the mean of V and the wheel's circumferential speed [-], [-], [1/m]
    N, Fx, Fy, approach, max_pressure : results of CONTACT's half space
    kpec, analyn : approach [m] and peak pressure [Pa] by CONTACT's fast methods, or None
    """

    y: float
    yaw: float
    roll: float
    pitch: float
    side: str
    angle: float
    longitudinal: float
    lateral: float
    spin: float
    N: float
    Fx: float
    Fy: float
    approach: float
    max_pressure: float
    kpec: tuple[float, float] | None
    analyn: tuple[float, float] | None

    @property
    def name(self) -> str:
        """Name in tables."""
        return f"{1e3 * self.y:g} mm {self.side}"


def places() -> list[Place]:
    """Return the positions for which results of CONTACT are available."""
    text = (reference.FOLDER / "manchester.csv").read_text(encoding="utf-8")
    found = []
    for row in csv.DictReader(line for line in text.splitlines() if not line.startswith("#")):
        given = {name: float(value) for name, value in row.items() if name != "side" and value}
        fast = [
            (1e-3 * given[f"approach_{method}"], 1e6 * given[f"pmax_{method}"]) if f"pmax_{method}" in given else None
            for method in ("kpec", "analyn")
        ]
        found.append(
            Place(
                1e-3 * given["y"], given["yaw"], given["roll"], given["pitch"], row["side"], given["angle"],
                -given["xi"], -given["eta"], -1e3 * given["phi"], given["N"], -given["Fx"], -given["Fy"],
                1e-3 * given["approach"], 1e6 * given["pmax"], *fast,
            )
        )  # fmt: skip
    return found


def settled(place: Place, elements: int) -> tuple[Patch, contact.Case]:
    """Return the patch at the height at which the half space carries the load, and the case with its normal force."""
    wheel, rail = profile.s1002(), profile.rail_60e1(1 / 40, breakpoints="UIC 519")
    both = WheelOnRail(wheel, rail, side=place.side)
    motion = Velocity(forward=SPEED, spin=place.pitch)
    both.contacts(Pose(y=place.y, roll=place.roll, yaw=place.yaw), motion, load=LOAD)
    z = both.z
    for _ in range(_MAX_STEPS):
        found = both.contacts(Pose(y=place.y, z=z, roll=place.roll, yaw=place.yaw), motion)
        if len(found) != 1:
            raise contact.ContactError(
                f"{place.name} has {len(found)} contact patches; the benchmark's places have one"
            )
        patch = found[0]
        s = contact.solve(
            patch.separation, patch.creepage, approach=patch.approach, friction=FRICTION, throw=False,
            normal=REFERENCE.normal, tangential=REFERENCE.tangential, n_strips=elements, n_elements=elements,
        )  # fmt: skip
        vertical = s.N * math.cos(patch.angle) - s.Fy * math.sin(patch.angle)
        if abs(vertical - LOAD) <= _TOLERANCE * LOAD:
            given = {"load": s.N, "friction": FRICTION, "speed": SPEED, "name": place.name}
            return patch, contact.Case(patch.separation, patch.creepage, **given)
        z -= (vertical - LOAD) / (vertical / s.N * s.normal_stiffness * math.cos(patch.angle))
    raise contact.ContactError(f"{place.name}: the height under the load was not found in {_MAX_STEPS} steps")
