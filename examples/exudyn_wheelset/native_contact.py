"""Wheel-rail forces for a multibody program. The contact search is in Python, the elastic contact in the native FMU."""

from __future__ import annotations

import math
from pathlib import Path
from types import TracebackType

import numpy as np

from contact.arrays import Array
from contact.geometry.wheelset import Pair, Patch, Pose
from contact_fmu.tables.wheel_rail_contact import POINTS
from contact_models.runs.scenario import Scenario
from contact_models.wheelset.fmu import Fmu

WINDOW, SPACING = -0.02, 1e-3  # first sample of a separation and distance of samples [m]
_INPUTS = (
    *(f"geometry.{row}[{i}]" for row in "gA" for i in range(1, POINTS + 1)),
    *(f"creepage.{name}" for name in ("longitudinal", "lateral", "spin")),
    "load.approach",
)
_OUTPUTS = ("force.x", "force.y", "force.n", "moment.z")


class NativeContact:
    """One wheel on its rail.

    The FMU runs in model exchange, so the forces have no delay. The object is a context manager that frees the FMU.

    Parameters
    ----------
    fmu : Path
        The native FMU, dist/native/WheelRailContact.fmu.
    given : Scenario
        Profiles, vehicle, speed and friction.
    side : {"right", "left"}
        Side of the wheel.
    """

    def __init__(self, fmu: Path, given: Scenario, side: str) -> None:
        v = given.vehicle
        y = WINDOW + SPACING * np.arange(POINTS)
        self._radius, self._speed = v.radius, given.speed(0.0)
        self._pair = Pair(
            given.wheel, given.rail, side=side, **v.sizes, combine_distance=1.0,
            samples=y if side == "right" else -y[::-1],
        )  # fmt: skip
        start = {"geometry.y0": WINDOW, "geometry.dy": SPACING, "speed": self._speed, "load.kind": "Approach"}
        start |= {"friction.coefficient": given.friction.static, "wheel.radius": v.radius}
        self._fmu = Fmu(fmu, start, name=side, exchange=True)
        self._inputs, self._outputs = self._fmu.references(_INPUTS), self._fmu.references(_OUTPUTS)

    def wrench(self, centre: Array, axle: Array, velocity: Array, rotation: Array) -> Array:
        """Return force [N] and moment about the wheelset's centre [N m] on the wheelset, in track axes, shape (6,).

        Parameters
        ----------
        centre : ndarray, shape (3,)
            Centre of the wheelset in track axes [m].
        axle : ndarray, shape (3,)
            Unit vector along the axle, to the right.
        velocity, rotation : ndarray, shape (3,)
            Velocity of the centre relative to the track frame, which moves at the speed V [m/s], and angular velocity [rad/s].
        """
        pose = Pose(y=centre[1], z=centre[2] + self._radius, roll=math.asin(axle[2]), yaw=math.atan2(-axle[0], axle[1]))
        total = np.zeros(6)
        for patch in self._pair.contacts(pose):
            arm = patch.wheel_position - centre
            tangent = np.array([0.0, math.cos(patch.angle), math.sin(patch.angle)])
            normal = np.array([0.0, -tangent[2], tangent[1]])  # from the wheel into the rail
            slip = velocity + np.cross(rotation, arm)
            creepage = (1.0 + slip[0] / self._speed, slip @ tangent / self._speed, rotation @ normal / self._speed)
            fx, fy, n, mz = self._solve(patch, creepage)
            force = patch.share * (np.array([fx, 0.0, 0.0]) + fy * tangent - n * normal)
            total[:3] += force
            total[3:] += np.cross(arm, force) + patch.share * mz * normal
        return total

    def _solve(self, patch: Patch, creepage: tuple[float, float, float]) -> Array:
        """Return the forces of one patch by the FMU: Fx, Fy, N [N], Mz [N m]."""
        self._fmu.set(self._inputs, np.array([*patch.separation.g, *patch.separation.A, *creepage, patch.approach]))
        return self._fmu.get(self._outputs)

    def __enter__(self) -> NativeContact:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._fmu.free()
