"""Kernels that make the curves of a search from two profiles: the parts that can touch, and the rail's place in its gauge.

A profile is an array with the rows y, z [m] and the angle of the tangent [rad], in the convention of `profile`.
"""

import math

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Given, Matrix, Motion
from contact.kernels.geometry.curve import Array
from contact.kernels.rows import Curve

#: Largest slope angles of the parts that take part in the search [rad]. The roll comes in addition.
STEEPEST_WHEEL, STEEPEST_RAIL = math.radians(80.0), math.radians(86.0)


@kernel
def turn(profile: Array, roll: float, out: Array) -> None:
    """Fill `out` with the profile turned about its origin by `roll` [rad], positive from y towards z."""
    c, s = math.cos(roll), math.sin(roll)
    for i in range(profile.shape[1]):
        y, z = profile[Curve.Y, i], profile[Curve.Z, i]
        out[Curve.Y, i], out[Curve.Z, i] = c * y - s * z, s * y + c * z
        out[Curve.ANGLE, i] = profile[Curve.ANGLE, i] + roll


@kernel
def _can_touch(profile: Array, i: int, steepest: float) -> bool:
    """Return whether node i is less steep than `steepest` and the next one, if any, lies further out."""
    rising = i == profile.shape[1] - 1 or profile[Curve.Y, i + 1] > profile[Curve.Y, i]
    return rising and math.cos(profile[Curve.ANGLE, i]) > math.cos(steepest)


@entry
def facing(profile: Matrix, is_wheel: bool) -> tuple[int, int]:
    """Return the first node and the end of the part that can touch, around the wheel's tape circle or the rail's crown.

    Its nodes are less steep than `STEEPEST_…` and have rising y. The part is empty if even the middle is too steep.
    """
    n = profile.shape[1]
    steepest = STEEPEST_WHEEL if is_wheel else STEEPEST_RAIL
    centre = 0
    for i in range(1, n):
        nearer = (
            abs(profile[Curve.Y, i]) < abs(profile[Curve.Y, centre])
            if is_wheel
            else profile[Curve.Z, i] < profile[Curve.Z, centre]
        )
        centre = i if nearer else centre
    low, high = centre, centre
    if not _can_touch(profile, centre, steepest):
        return centre, centre
    while low > 0 and _can_touch(profile, low - 1, steepest):
        low -= 1
    while high < n and _can_touch(profile, high, steepest):
        high += 1
    return low, high


@entry
def take_nodes(profile: Matrix, low: int, high: int, curve: Matrix) -> None:
    """Fill `curve` with the nodes low … high - 1 of a profile: rows y, z, dz/dy."""
    for i in range(low, high):
        curve[Curve.Y, i - low], curve[Curve.Z, i - low] = profile[Curve.Y, i], profile[Curve.Z, i]
        curve[Curve.SLOPE, i - low] = math.tan(profile[Curve.ANGLE, i])


@entry
def rail_origin(rail: Matrix, gauge: float, gauge_point: float) -> tuple[float, float, float]:
    """Return (y, z) of the origin of the right rail's profile and the depth that its gauge side reaches [m].

    With this origin the top lies at z = 0 and the gauge face at half the gauge. The depth counts from the top.
    `gauge_point` must be less deep.
    """
    highest = 0
    for i in range(1, rail.shape[1]):
        highest = i if rail[Curve.Z, i] < rail[Curve.Z, highest] else highest
    top = rail[Curve.Z, highest]
    for i in range(max(highest - 1, 0), min(highest + 1, rail.shape[1] - 1)):  # the crest may lie between two points
        h, m0, m1 = (
            rail[Curve.Y, i + 1] - rail[Curve.Y, i],
            math.tan(rail[Curve.ANGLE, i]),
            math.tan(rail[Curve.ANGLE, i + 1]),
        )
        t, z = cubic.interior_minimum(h, rail[Curve.Z, i], m0, rail[Curve.Z, i + 1], m1)
        top = min(top, z) if t > 0.0 else top
    deepest, i = -math.inf, highest
    for j in range(highest, -1, -1):
        deepest = max(deepest, rail[Curve.Z, j] - top)
        if deepest >= gauge_point:
            i = j
            break
    if deepest < gauge_point or i == rail.shape[1] - 1:
        return 0.0, 0.0, deepest
    h = rail[Curve.Z, i + 1] - rail[Curve.Z, i]  # the gauge face is steep, so y is interpolated over z
    cot0, cot1 = 1.0 / math.tan(rail[Curve.ANGLE, i]), 1.0 / math.tan(rail[Curve.ANGLE, i + 1])
    y = cubic.value(h, rail[Curve.Y, i], cot0, rail[Curve.Y, i + 1], cot1, (top + gauge_point - rail[Curve.Z, i]) / h)
    return 0.5 * gauge - y, -top, deepest


@entry
def move(given: Given, motion: Motion) -> None:
    """Copy pose, velocity and the rail's irregularity from a record GIVEN of `layout` to `motion`.

    They are mirrored to the right side, and the rail's origin is added.
    """
    mirror = motion.mirror
    motion.y, motion.z, motion.roll, motion.yaw = mirror * given.y, given.z, mirror * given.roll, mirror * given.yaw
    motion.vx, motion.vy, motion.vz = given.vx, mirror * given.vy, given.vz
    motion.roll_rate, motion.yaw_rate, motion.spin = mirror * given.roll_rate, mirror * given.yaw_rate, given.spin
    motion.rail_y = mirror * given.rail_y + motion.origin_y
    motion.rail_z = given.rail_z + motion.origin_z
    motion.rail_roll, motion.rail_roll_rate = mirror * given.rail_roll, mirror * given.rail_roll_rate
    motion.rail_vy, motion.rail_vz = mirror * given.rail_vy, given.rail_vz
