"""Contact points of rigid wheels on rigid rails over the lateral displacement of the wheelset.

Rolling radii and contact angles, their differences between both wheels, and where the profiles touch: what a linearised
model of the running gear and the equivalent conicity are made from.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.geometry.wheelset import Pair, Pose

Array = NDArray[np.float64]

_DEPTH = 1e-9  # [m] at which a patch is a point: it is some micrometres wide
_STEEPEST_ROLL = 0.1  # [rad] of a pose
_BISECTIONS = 44  # of that range, down to 1e-14 rad


@dataclass(frozen=True)
class Touches:
    """Where one wheel touches its rail, an array each over the displacements.

    Attributes
    ----------
    on_wheel, on_rail : ndarray, shape (n,)
        y of the contact point in the profiles' own right-side coordinates [m]: negative towards the flange.
    radius : ndarray, shape (n,)
        Rolling radius [m].
    angle : ndarray, shape (n,)
        Contact angle [rad], positive where the rail pushes the wheel to the track's centre, as on a tread and at the flange.
    """

    on_wheel: Array
    on_rail: Array
    radius: Array
    angle: Array


@dataclass(frozen=True)
class ContactPoints:
    """Contact points of a wheelset at the lateral displacements `y` [m], with the `roll` [rad] that it has there."""

    y: Array
    roll: Array
    right: Touches
    left: Touches

    @property
    def radius_difference(self) -> Array:
        """Δr: rolling radius of the right wheel minus that of the left [m]."""
        return self.right.radius - self.left.radius

    @property
    def angle_difference(self) -> Array:
        """Contact angle of the right wheel minus that of the left [rad]."""
        return self.right.angle - self.left.angle

    def columns(self) -> dict[str, Array]:
        """All of it by name, in SI units, as a table has it."""
        sides = {
            f"{side}_{name}": values for side in ("right", "left") for name, values in vars(getattr(self, side)).items()
        }
        differences = {"radius_difference": self.radius_difference, "angle_difference": self.angle_difference}
        return {"y": self.y, "roll": self.roll, **differences, **sides}


def contact_points(
    wheel: Profile,
    rail: Profile,
    y: ArrayLike | None = None,
    *,
    left_wheel: Profile | None = None,
    left_rail: Profile | None = None,
    nominal_radius: float = 0.460,
    left_radius: float | None = None,
    gauge: float = 1.435,
    flange_back: float = 1.360,
    gauge_point: float = 0.014,
    roll: bool = False,
) -> ContactPoints:
    """Where rigid wheels touch rigid rails, without yaw.

    Parameters
    ----------
    wheel, rail : Profile
        Of the right side; and of the left one unless `left_wheel` or `left_rail` is another.
    y : array_like, shape (n,), optional
        Lateral displacements of the wheelset to the right [m]; default -10 mm to 10 mm by 0.1 mm.
    nominal_radius, left_radius : float
        Radius of the tape circles [m], and of the left one if it is another.
    gauge, flange_back, gauge_point : float
        As for `contact.geometry.wheelset.Pair` [m].
    roll : bool
        Let the wheelset roll until both wheels touch; without it (EN 15302) each wheel is lowered onto its rail by itself.

    Raises
    ------
    ContactError
        Bad arguments, and a displacement at which a wheel does not lie above its rail.
    """
    try:
        shifts = np.atleast_1d(np.array(np.arange(-100, 101) * 1e-4 if y is None else y, dtype=np.float64))
    except (TypeError, ValueError):
        raise ContactError(f"y = {y!r} is not an array of numbers") from None
    if shifts.ndim != 1 or not shifts.size or not np.isfinite(shifts).all():
        raise ContactError(f"y of shape {shifts.shape}: at least one finite displacement [m] is needed")
    track = {"gauge": gauge, "flange_back": flange_back, "gauge_point": gauge_point}
    track |= {"combine_distance": 0.0, "combine_angle": 0.0}  # of two points at once the deeper one counts
    other = nominal_radius if left_radius is None else require_number("left_radius", left_radius, 0.05, 2.0)
    right = Pair(wheel, rail, side="right", nominal_radius=nominal_radius, **track)  # type: ignore[arg-type]
    left = Pair(left_wheel or wheel, left_rail or rail, side="left", nominal_radius=other, **track)  # type: ignore[arg-type]
    rolls = np.array([_level(right, left, shift) if roll else 0.0 for shift in shifts.tolist()])
    poses = [Pose(y=a, roll=b) for a, b in zip(shifts.tolist(), rolls.tolist(), strict=True)]
    return ContactPoints(shifts, rolls, _touches(right, poses), _touches(left, poses))


def _touches(pair: Pair, poses: list[Pose]) -> Touches:
    rows = []
    for pose in poses:
        patches = pair.patches[: pair.locate(pose, penetration=_DEPTH)]
        rows.append(patches[np.argmax(patches["approach"])].copy())
    table = np.array(rows)
    return Touches(table["wheel_y"], table["rail_y"], table["radius"], -table["angle"])


def _level(right: Pair, left: Pair, y: float) -> float:
    """The roll at which both wheels touch at one height of the wheelset; roll lowers the right wheel."""
    low, high = -_STEEPEST_ROLL, _STEEPEST_ROLL
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        pose = Pose(y=y, roll=middle)
        if right.touch(pose) > left.touch(pose):  # the left wheel touches first (z down): roll more to the right
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
