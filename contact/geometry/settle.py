"""How deep the wheel sits on the rail: at a given z, at a given penetration, or under a given vertical load.

These are the entry kernels of the geometry. They return the number of patches or a code below zero: NO_OVERLAP,
NOT_SETTLED or TOO_DEEP.
"""

import math

from contact._jit import kernel
from contact._layout import APPROACH, CASE_LOAD, CASE_LOAD_KIND, RES_N
from contact.geometry.curve import Array
from contact.geometry.frame import describe_all
from contact.geometry.layout import (
    PATCH_ANGLE,
    PATCH_APPROACH,
    PATCH_LOAD,
    POSE_ROLL,
    POSE_Y,
    POSE_YAW,
    POSE_Z,
    RADIUS,
    RAIL_ROLL,
    RAIL_Y,
    RAIL_Z,
    SEP_A,
    SEP_G,
    SEP_XC,
    SEP_Y,
    TAPE,
)
from contact.geometry.search import place, touch, trace, vertical_gap
from contact.geometry.workspace import Search
from contact.normal.analyn import analyn

NO_OVERLAP, NOT_SETTLED, TOO_DEEP = -1, -2, -3
GIVEN_Z, PENETRATION, LOAD = 0, 1, 2

_MAX_ITERATIONS = 60
_TOLERANCE = 1e-11  # of the load; it is noise of the height, and difference quotients of FMUs see that
DEEPEST = 5e-3  # [m] below first touch: far beyond any load that steel carries


@kernel
def oppose(wheel: Array, rail: Array, motion: Array, line: Array, placed: Array) -> tuple[int, int, int]:
    """Trace line, placed rail and the gap between; returns the first trace node and the range of those above the rail."""
    n = wheel.shape[1]
    first = trace(wheel, n, motion[RADIUS], motion[TAPE], motion[POSE_Y], motion[POSE_ROLL], motion[POSE_YAW], line)
    place(rail, rail.shape[1], motion[RAIL_Y], motion[RAIL_Z], motion[RAIL_ROLL], placed)
    start, end = vertical_gap(line, first, n, placed, rail.shape[1])
    return first, start, end


@kernel
def first_touch(wheel: Array, rail: Array, motion: Array, line: Array, placed: Array) -> tuple[bool, float]:
    """Do the profiles lie above each other, and the z at which the rigid wheel just touches."""
    _, start, end = oppose(wheel, rail, motion, line, placed)
    if end - start < 3:
        return False, 0.0
    return True, touch(line, start, end)


@kernel
def carried(n: int, space: Search) -> float:
    """Vertical force of the pressures of n patches by ANALYN at their approaches, sum of N cos(angle); fills PATCH_LOAD."""
    total = 0.0
    case, patches = space.case, space.patches
    case[CASE_LOAD_KIND] = APPROACH
    for k in range(n):
        case[CASE_LOAD] = patches[k, PATCH_APPROACH]
        sep = space.separations[k]
        space.result[:] = 0.0
        analyn(
            sep[SEP_Y], sep[SEP_G], sep[SEP_A], sep[SEP_XC], case, space.nodes, space.weights, space.work, space.strips,
            space.result,
        )  # fmt: skip
        patches[k, PATCH_LOAD] = space.result[RES_N]
        total += space.result[RES_N] * math.cos(patches[k, PATCH_ANGLE])
    return total


@kernel
def _describe_at(z: float, first: int, start: int, end: int, space: Search) -> int:
    """All patches with the wheelset at z, which is left in motion[POSE_Z]."""
    space.motion[POSE_Z] = z
    return describe_all(
        space.line, first, start, end, space.placed, space.lobe, space.motion, space.grid, space.wheel_plane,
        space.rail_plane, space.patches, space.separations,
    )  # fmt: skip


@kernel
def locate(space: Search) -> int:
    """Describe the patches at motion[POSE_Z]; needs none of the arrays of the normal problem."""
    motion = space.motion
    first, start, end = oppose(space.wheel, space.rail, motion, space.line, space.placed)
    if end - start < 3:
        return NO_OVERLAP
    if motion[POSE_Z] > touch(space.line, start, end) + DEEPEST:
        return TOO_DEEP
    return _describe_at(motion[POSE_Z], first, start, end, space)


@kernel
def settle(mode: int, amount: float, space: Search) -> int:
    """Find z as `mode` says, leave it in motion[POSE_Z] and describe the patches there.

    Under a load, F^(2/3) is nearly linear in the penetration (Hertz); its root is bracketed and found by the Illinois
    variant of regula falsi, usually at the fifth force, by bisection when that is slow.
    """
    if mode == GIVEN_Z:
        return locate(space)
    motion = space.motion
    first, start, end = oppose(space.wheel, space.rail, motion, space.line, space.placed)
    if end - start < 3:
        return NO_OVERLAP
    z0 = touch(space.line, start, end)
    if mode == PENETRATION or amount <= 0.0:
        return _describe_at(z0 + amount, first, start, end, space)
    target = amount ** (2.0 / 3.0)
    low, high, f_low, f_high = 0.0, math.inf, -target, 0.0
    p = 1e-4 * (amount / 1e5) ** (2.0 / 3.0)
    side = 0
    for iteration in range(_MAX_ITERATIONS):
        n = _describe_at(z0 + p, first, start, end, space)
        force = carried(n, space)
        if abs(force - amount) <= _TOLERANCE * amount or high - low <= 1e-15:
            return n
        f = max(force, 0.0) ** (2.0 / 3.0) - target
        if f > 0.0:
            f_low = 0.5 * f_low if side > 0 else f_low
            high, f_high, side = p, f, 1
        else:
            f_high = 0.5 * f_high if side < 0 else f_high
            low, f_low, side = p, f, -1
        if high < math.inf:
            p = low - f_low * (high - low) / (f_high - f_low) if iteration < 15 else 0.5 * (low + high)
        else:  # extrapolate the line, a little beyond
            p = min(1.05 * p * target / (f + target), 3.0 * p) if f > -target else 3.0 * p
            if p > DEEPEST:
                return NOT_SETTLED
    return NOT_SETTLED
