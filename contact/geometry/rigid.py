"""Contact points of rigid wheels on rigid rails over the lateral displacement of the wheelset.

The results are rolling radii, contact angles, their differences between both wheels, and the positions of contact on the
profiles. Linearised vehicle models and the equivalent conicity are based on them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array, brief
from contact.errors import ContactError, require_number
from contact.geometry.shape import Profile
from contact.geometry.wheelset import Pair, Pose
from contact.inputs.options import FLANGE_BACK, GAUGE, GAUGE_POINT, RADIUS

_DEPTH = 1e-9  # penetration [m] at which a patch counts as a point: it is some micrometres wide
_STEEPEST_ROLL = 0.1  # largest roll of a pose [rad]
_BISECTIONS = 44  # bisections of the range of roll, down to 1e-14 rad


@dataclass(frozen=True, eq=False)
class Touches:
    """Contact points of one wheel on its rail, as arrays over the lateral displacements.

    Attributes
    ----------
    on_wheel, on_rail : ndarray, shape (n,)
        y of the contact point in the profiles' right-side coordinates [m], negative towards the flange.
    radius : ndarray, shape (n,)
        Rolling radius [m].
    angle : ndarray, shape (n,)
        Contact angle [rad], positive if the rail pushes the wheel towards the track's centre, as on a tread and at a flange.
    """

    on_wheel: Array
    on_rail: Array
    radius: Array
    angle: Array

    __repr__ = brief


@dataclass(frozen=True, eq=False)
class ContactPoints:
    """Contact points of a wheelset at the lateral displacements `y` [m] and the corresponding `roll` [rad]."""

    y: Array
    roll: Array
    right: Touches
    left: Touches

    __repr__ = brief

    @property
    def radius_difference(self) -> Array:
        """Δr: rolling radius of the right wheel minus that of the left [m]."""
        return self.right.radius - self.left.radius

    @property
    def angle_difference(self) -> Array:
        """Contact angle of the right wheel minus that of the left [rad]."""
        return self.right.angle - self.left.angle

    def columns(self) -> dict[str, Array]:
        """Return all arrays by name, in SI units, as columns of a table."""
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
    nominal_radius: float = RADIUS.usual,
    left_radius: float | None = None,
    gauge: float = GAUGE.usual,
    flange_back: float = FLANGE_BACK.usual,
    gauge_point: float = GAUGE_POINT.usual,
    roll: bool = False,
) -> ContactPoints:
    """Return the contact points of rigid wheels on rigid rails, without yaw.

    Parameters
    ----------
    wheel, rail : Profile
        Profiles of the right side.
    y : array_like, shape (n,), optional
        Lateral displacements of the wheelset to the right [m]; default -10 mm to 10 mm in steps of 0.1 mm.
    left_wheel, left_rail : Profile, optional
        Profiles of the left side; default those of the right side.
    nominal_radius, left_radius : float
        Radius of the tape circles [m]; `left_radius` is for a left wheel with another radius.
    gauge, flange_back, gauge_point : float
        As for `contact.geometry.wheelset.Pair` [m].
    roll : bool
        Roll the wheelset until both wheels touch. If False (EN 15302), each wheel is lowered onto its rail separately.

    Returns
    -------
    ContactPoints

    Raises
    ------
    ContactError
        For invalid arguments, or a displacement at which a wheel does not lie above its rail.
    """
    shifts = np.atleast_1d(as_array("y", np.arange(-100, 101) * 1e-4 if y is None else y))
    if shifts.ndim != 1 or not shifts.size or not np.isfinite(shifts).all():
        raise ContactError(f"y of shape {shifts.shape}: at least one finite displacement [m] is needed")
    track = {"gauge": gauge, "flange_back": flange_back, "gauge_point": gauge_point}
    track |= {"combine_distance": 0.0, "combine_angle": 0.0}  # separate patches; `_touches` takes the deepest
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
    """Return the roll [rad] at which both wheels touch at the same height. Positive roll lowers the right wheel."""
    low, high = -_STEEPEST_ROLL, _STEEPEST_ROLL
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        pose = Pose(y=y, roll=middle)
        if right.touch(pose) > left.touch(pose):  # the left wheel touches first (z down): roll more to the right
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
