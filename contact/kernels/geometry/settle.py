"""Height of the wheel on the rail: at a given z, at a given penetration, or under a given vertical load.

These are the entry kernels of the geometry. They return the number of patches or, below zero, a value of `NoAnswer`.
"""

import math

from contact.core import chosen_by, entry, inlined, kernel
from contact.kernels.arrays import Matrix, Motion, Samples, Search, SurfaceSearch
from contact.kernels.enumerations import Height, LoadKind, NoAnswer
from contact.kernels.geometry import surface
from contact.kernels.geometry.curve import Array, Record
from contact.kernels.geometry.frame import describe_all
from contact.kernels.geometry.search import place, size_of, touch, trace, vertical_gap
from contact.kernels.normal.analyn import analyn
from contact.kernels.result import clear
from contact.kernels.rows import Sep

_MAX_ITERATIONS = 60
_TOLERANCE = 1e-11  # of the load; it becomes noise of the height and of difference quotients of FMUs
_ROUGHER = 1e-8  # the same on surfaces that change along the way, whose grids make more noise
#: Forces after which surfaces are searched anew for each height. Before, grids that are laid for another height serve, which
#: takes less time, but the force then depends on the way to it by up to 2 % where the gap is rough.
_ANEW = 12
DEEPEST = 5e-3  # [m] below first touch, times `size_of`, far beyond any load that steel carries


@kernel
def oppose(wheel: Array, rail: Array, motion: Record, line: Array, placed: Array) -> tuple[int, int, int]:
    """Fill trace line, placed rail and the gap between. Return the first trace node and the range of those above the rail."""
    n = wheel.shape[1]
    first = trace(wheel, n, motion.radius, motion.tape, motion.y, motion.roll, motion.yaw, line)
    place(rail, rail.shape[1], motion.rail_y, motion.rail_z, motion.rail_roll, placed)
    start, end = vertical_gap(line, first, n, placed, rail.shape[1])
    return first, start, end


@entry
def first_touch(wheel: Matrix, rail: Matrix, motion: Motion, line: Matrix, placed: Matrix) -> tuple[bool, float]:
    """Return whether the profiles lie above each other, and the z [m] at which the rigid wheel just touches."""
    _, start, end = oppose(wheel, rail, motion, line, placed)
    if end - start < 3:
        return False, 0.0
    return True, touch(line, start, end)


@entry
def carried(n: int, space: Search) -> float:
    """Return the vertical force of the pressures of n patches by ANALYN [N]. Fill `load` of each patch.

    The force is the sum of share N cos(angle) cos(pitch).
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
        total += patches[k].share * result.N * math.cos(patches[k].angle) * math.cos(patches[k].pitch)
    return total


def begin(space: Search, z: float) -> tuple[bool, float, tuple[int, int, int]]:
    """Search along the curves or the surfaces of `space` at the pose without its z.

    Return whether the bodies lie above each other, z [m] at first touch, and three numbers for `describe`. Compiled code
    runs the function for the type of `space`.
    """
    raise NotImplementedError


def describe(space: Search, z: float, nodes: tuple[int, int, int]) -> int:
    """Set motion.z to z, describe all patches there and return their number. Chosen as `begin`."""
    raise NotImplementedError


def renew(space: Search) -> None:
    """Forget the grids that were laid or refined for other heights. Chosen as `begin`."""
    raise NotImplementedError


@kernel
def _renew_curves(space: Search) -> None:
    pass


@inlined
def _begin_curves(space, z):
    space.motion[0].changing = 0
    first, start, end = oppose(space.wheel, space.rail, space.motion[0], space.line, space.placed)
    above = end - start >= 3
    return above, touch(space.line, start, end) if above else z, (first, start, end)


@inlined
def _describe_curves(space, z, nodes):
    space.motion[0].z = z
    return describe_all(nodes[0], nodes[1], nodes[2], space)


@inlined
def _begin_surfaces(space, z):
    space.motion[0].changing = 1
    above, at = surface.begin(space)
    return above, at if above else z, (0, 0, 0)


@inlined
def _describe_surfaces(space, z, nodes):
    return surface.describe_at(z, space)


chosen_by(renew, {Search: _renew_curves, SurfaceSearch: surface.renew})
chosen_by(begin, {Search: _begin_curves, SurfaceSearch: _begin_surfaces})
chosen_by(describe, {Search: _describe_curves, SurfaceSearch: _describe_surfaces})


@kernel
def first_depth(load: float, size: float) -> float:
    """Return a depth below first touch [m] to begin the search for a load with, for a wheel of this `size`."""
    return min(1e-4 * (load / 1e5) ** (2.0 / 3.0) / size ** (1.0 / 3.0), DEEPEST * size)


@kernel
def locate(space: Search) -> int:
    """Describe the patches at motion.z and return their number. The arrays of the normal problem are not needed."""
    z = space.motion[0].z
    above, z0, nodes = begin(space, z)
    if not above:
        return NoAnswer.NO_OVERLAP.value
    if z > z0 + DEEPEST * size_of(space.motion[0]):
        return NoAnswer.TOO_DEEP.value
    return describe(space, z, nodes)


@entry
def settle(mode: int, amount: float, space: Search) -> int:
    """Set motion.z as `mode` says, describe the patches there and return their number.

    Under a load, F^(2/3) is nearly linear in the penetration (Hertz). Its root is bracketed and found by the Illinois
    variant of regula falsi, usually at the fifth force. If that is slow, bisection is used; on surfaces the bracket begins
    again with grids that are laid anew. There the force may jump with the height; then `motion.missed` tells by how much it
    misses the load.
    """
    motion = space.motion[0]
    motion.missed = 0.0
    if mode == Height.GIVEN:
        return locate(space)
    above, z0, nodes = begin(space, motion.z)
    if not above:
        return NoAnswer.NO_OVERLAP.value
    if amount <= 0.0:  # no load or depth: no patch, not even one due to round-off
        motion.z = z0 + amount
        return 0
    if mode == Height.PENETRATION:
        return describe(space, z0 + amount, nodes)
    target, tolerance = amount ** (2.0 / 3.0), _ROUGHER if motion.changing else _TOLERANCE
    low, high, f_low, f_high = 0.0, math.inf, -target, 0.0
    size = size_of(motion)
    p = first_depth(amount, size)
    side = 0
    anew = _ANEW if motion.changing else _MAX_ITERATIONS
    patient = 15 + (_ANEW if motion.changing else 0)  # the last iterations of regula falsi
    for iteration in range(_MAX_ITERATIONS):
        if iteration == anew:
            low, high, f_low, f_high, side = 0.0, math.inf, -target, 0.0, 0
        if iteration >= anew:
            renew(space)
        n = describe(space, z0 + p, nodes)
        force = carried(n, space)
        if abs(force - amount) <= tolerance * amount or high - low <= 1e-15:
            motion.missed = abs(force - amount) / amount
            return n
        f = max(force, 0.0) ** (2.0 / 3.0) - target
        if f > 0.0:
            f_low = 0.5 * f_low if side > 0 else f_low
            high, f_high, side = p, f, 1
        else:
            f_high = 0.5 * f_high if side < 0 else f_high
            low, f_low, side = p, f, -1
        if high < math.inf:
            p = low - f_low * (high - low) / (f_high - f_low) if iteration < patient else 0.5 * (low + high)
        else:  # extrapolate the line and go a little further
            p = min(1.05 * p * target / (f + target), 3.0 * p) if f > -target else 3.0 * p
            if p > DEEPEST * size:
                return NoAnswer.NOT_SETTLED.value
    return NoAnswer.NOT_SETTLED.value
