"""Kernels that make a search's curves of two profiles: the parts that can touch, and the place of the rail in its gauge.

A profile is an array with the rows y, z [m] and the angle of the tangent [rad], in the convention of `profile`.
"""

import math

from contact._jit import kernel
from contact.geometry.curve import SLOPE, Array, Y, Z, hermite, least
from contact.geometry.layout import MIRROR, N_GIVEN, ODD, ORIGIN_Y, ORIGIN_Z, RAIL_Y, RAIL_Z

ANGLE = 2  # profile[ROW, node]
N_PROFILE_ROWS = 3

#: Steeper parts of the profiles take no part in the search, whatever roll is allowed on top [rad].
STEEPEST_WHEEL, STEEPEST_RAIL = math.radians(80.0), math.radians(86.0)


@kernel
def turn(profile: Array, roll: float, out: Array) -> None:
    """The profile turned about its origin by `roll`, positive from y towards z."""
    c, s = math.cos(roll), math.sin(roll)
    for i in range(profile.shape[1]):
        y, z = profile[Y, i], profile[Z, i]
        out[Y, i], out[Z, i] = c * y - s * z, s * y + c * z
        out[ANGLE, i] = profile[ANGLE, i] + roll


@kernel
def _fair(profile: Array, i: int, steepest: float) -> bool:
    """Whether node i is less steep than that and the next one, if any, lies further out."""
    rising = i == profile.shape[1] - 1 or profile[Y, i + 1] > profile[Y, i]
    return rising and math.cos(profile[ANGLE, i]) > math.cos(steepest)


@kernel
def facing(profile: Array, is_wheel: bool) -> tuple[int, int]:
    """First node, and the one after the last, around the wheel's tape circle or the rail's crown that can touch.

    They are less steep than `STEEPEST_…` and have rising y; none where even the middle is steep.
    """
    n = profile.shape[1]
    steepest = STEEPEST_WHEEL if is_wheel else STEEPEST_RAIL
    centre = 0
    for i in range(1, n):
        nearer = abs(profile[Y, i]) < abs(profile[Y, centre]) if is_wheel else profile[Z, i] < profile[Z, centre]
        centre = i if nearer else centre
    low, high = centre, centre
    if not _fair(profile, centre, steepest):
        return centre, centre
    while low > 0 and _fair(profile, low - 1, steepest):
        low -= 1
    while high < n and _fair(profile, high, steepest):
        high += 1
    return low, high


@kernel
def cut(profile: Array, low: int, high: int, curve: Array) -> None:
    """Nodes low … high - 1 as a curve: rows y, z, dz/dy."""
    for i in range(low, high):
        curve[Y, i - low], curve[Z, i - low] = profile[Y, i], profile[Z, i]
        curve[SLOPE, i - low] = math.tan(profile[ANGLE, i])


@kernel
def rail_origin(rail: Array, gauge: float, gauge_point: float) -> tuple[float, float, float]:
    """(y, z) of the origin of the right rail's profile: its top at z = 0, its gauge face at half the gauge.

    The third number is the depth below the top that its gauge side reaches: `gauge_point` must lie less deep.
    """
    highest = 0
    for i in range(1, rail.shape[1]):
        highest = i if rail[Z, i] < rail[Z, highest] else highest
    top = rail[Z, highest]
    for i in range(max(highest - 1, 0), min(highest + 1, rail.shape[1] - 1)):  # the crest lies between two points
        h, m0, m1 = rail[Y, i + 1] - rail[Y, i], math.tan(rail[ANGLE, i]), math.tan(rail[ANGLE, i + 1])
        t, z = least(rail[Z, i], rail[Z, i + 1], m0, m1, h)
        top = min(top, z) if t > 0.0 else top
    deepest, i = -math.inf, highest
    for j in range(highest, -1, -1):
        deepest = max(deepest, rail[Z, j] - top)
        if deepest >= gauge_point:
            i = j
            break
    if deepest < gauge_point or i == rail.shape[1] - 1:
        return 0.0, 0.0, deepest
    h = rail[Z, i + 1] - rail[Z, i]  # the gauge face is steep: y is interpolated over z there
    cot0, cot1 = 1.0 / math.tan(rail[ANGLE, i]), 1.0 / math.tan(rail[ANGLE, i + 1])
    y = hermite(rail[Y, i], rail[Y, i + 1], cot0, cot1, h, (top + gauge_point - rail[Z, i]) / h)[0]
    return 0.5 * gauge - y, -top, deepest


@kernel
def move(given: Array, motion: Array) -> None:
    """Take over pose, velocity and the rail's irregularity, in the order of `motion`, mirrored to the right side."""
    mirror = motion[MIRROR]
    for i in range(N_GIVEN):
        motion[i] = given[i]
    for i in ODD:
        motion[i] *= mirror
    motion[RAIL_Y] += motion[ORIGIN_Y]
    motion[RAIL_Z] += motion[ORIGIN_Z]
