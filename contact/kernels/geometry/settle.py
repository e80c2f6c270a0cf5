"""Height of the wheel on the rail: at a given z, at a given penetration, or under a given vertical load.

These are the entry kernels of the geometry. They return the number of patches or, below zero, a value of `NoAnswer`.
"""

import math

from contact._jit import kernel
from contact.kernels.arrays import Samples, Search
from contact.kernels.enumerations import Height, LoadKind, NoAnswer
from contact.kernels.geometry.curve import Array, Record
from contact.kernels.geometry.frame import describe_all
from contact.kernels.geometry.search import place, touch, trace, vertical_gap
from contact.kernels.normal.analyn import analyn
from contact.kernels.result import clear
from contact.kernels.rows import Sep

_MAX_ITERATIONS = 60
_TOLERANCE = 1e-11  # of the load; it becomes noise of the height and of difference quotients of FMUs
DEEPEST = 5e-3  # [m] below first touch, far beyond any load that steel carries


@kernel
def oppose(wheel: Array, rail: Array, motion: Record, line: Array, placed: Array) -> tuple[int, int, int]:
    """Fill trace line, placed rail and the gap between. Return the first trace node and the range of those above the rail."""
    n = wheel.shape[1]
    first = trace(wheel, n, motion.radius, motion.tape, motion.y, motion.roll, motion.yaw, line)
    place(rail, rail.shape[1], motion.rail_y, motion.rail_z, motion.rail_roll, placed)
    start, end = vertical_gap(line, first, n, placed, rail.shape[1])
    return first, start, end


@kernel
def first_touch(wheel: Array, rail: Array, motion: Record, line: Array, placed: Array) -> tuple[bool, float]:
    """Return whether the profiles lie above each other, and the z [m] at which the rigid wheel just touches."""
    _, start, end = oppose(wheel, rail, motion, line, placed)
    if end - start < 3:
        return False, 0.0
    return True, touch(line, start, end)


@kernel
def carried(n: int, space: Search) -> float:
    """Return the vertical force of the pressures of n patches by ANALYN [N]. Fill `load` of each patch.

    The force is the sum of share N cos(angle).
    """
    total = 0.0
    case, result, patches = space.case[0], space.result[0], space.patches
    case.load_kind = LoadKind.APPROACH
    for k in range(n):
        case.amount = patches[k].approach
        sep = space.separations[k]
        samples = Samples(sep[Sep.Y], sep[Sep.G], sep[Sep.A], sep[Sep.XC], sep[Sep.TILT])
        clear(result)
        analyn(samples, case, space.across, space.work, space.strips, result)
        patches[k].load = result.N
        total += patches[k].share * result.N * math.cos(patches[k].angle)
    return total


@kernel
def _describe_at(z: float, first: int, start: int, end: int, space: Search) -> int:
    """Set motion.z to z, describe all patches there and return their number."""
    space.motion[0].z = z
    return describe_all(first, start, end, space)


@kernel
def locate(space: Search) -> int:
    """Describe the patches at motion.z and return their number. The arrays of the normal problem are not needed."""
    motion = space.motion[0]
    first, start, end = oppose(space.wheel, space.rail, motion, space.line, space.placed)
    if end - start < 3:
        return NoAnswer.NO_OVERLAP.value
    if motion.z > touch(space.line, start, end) + DEEPEST:
        return NoAnswer.TOO_DEEP.value
    return _describe_at(motion.z, first, start, end, space)


@kernel
def settle(mode: int, amount: float, space: Search) -> int:
    """Set motion.z as `mode` says, describe the patches there and return their number.

    Under a load, F^(2/3) is nearly linear in the penetration (Hertz). Its root is bracketed and found by the Illinois
    variant of regula falsi, usually at the fifth force. If that is slow, bisection is used.
    """
    if mode == Height.GIVEN:
        return locate(space)
    motion = space.motion[0]
    first, start, end = oppose(space.wheel, space.rail, motion, space.line, space.placed)
    if end - start < 3:
        return NoAnswer.NO_OVERLAP.value
    z0 = touch(space.line, start, end)
    if amount <= 0.0:  # no load or depth: no patch, not even one due to round-off
        motion.z = z0 + amount
        return 0
    if mode == Height.PENETRATION:
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
        else:  # extrapolate the line and go a little further
            p = min(1.05 * p * target / (f + target), 3.0 * p) if f > -target else 3.0 * p
            if p > DEEPEST:
                return NoAnswer.NOT_SETTLED.value
    return NoAnswer.NOT_SETTLED.value
