"""Entries of a wheel on a rail that change along the way: `wr_pair_…` of wheelrail.h for memory of `wr_pair_init_surfaces`.

A surface is an array of numbers, which `contact.geometry.surfaces.compiled.numbers` writes: `HEAD` numbers - those of
slices, paths and points of the deviation, and the place (y, z) of the origin [m] - then the arrays of a `Sheet`, one after
the other. `sizes` are those of `patch`, then how many numbers the wheel and the rail have. `work` begins with both arrays.
"""

from __future__ import annotations

import math

from contact.core import COMPILING, arranging
from contact.kernels import block, memory, quadrature
from contact.kernels.arrays import Sheet
from contact.kernels.block import ahead
from contact.kernels.entries.layout import Entries, copy, fill, lay_out, size_of
from contact.kernels.entries.pair import entries_of, lay_start, reset, set_options
from contact.kernels.rows import N_PROFILE_ROWS, Bin

if COMPILING:
    from numba import carray

#: Numbers before the arrays of a surface.
HEAD = 5
#: Least distance of slices and of points of a deviation, below those that Python writes, and greatest number.
_CLOSEST, _GREATEST = 1e-7, 1e7


@arranging
def _counts(numbers, n):
    """Return the numbers of slices, paths and points of the deviation of a surface, and whether they fit `n`.

    Others are replaced by the least ones.
    """
    head = carray(numbers, (HEAD,))
    if not (n > HEAD and 2.0 <= head[0] <= n and 2.0 <= head[1] <= n and 1.0 <= head[2] <= n):
        return 2, 2, 1, False
    slices, paths, points = int(head[0]), int(head[1]), int(head[2])
    if memory.lay_sheet(numbers, 0, slices, paths, points)[1] != n - HEAD:
        return 2, 2, 1, False
    return slices, paths, points, True


@arranging
def _rises(numbers):
    """Return whether numbers increase by at least `_CLOSEST`."""
    least = math.inf
    for i in range(numbers.size - 1):
        least = min(least, numbers[i + 1] - numbers[i])
    return least >= _CLOSEST


@arranging
def _are_bounded(numbers):
    """Return whether no number is so large that heights could overflow."""
    greatest = 0.0
    for i in range(numbers.size):
        greatest = max(greatest, abs(numbers[i]))
    return greatest <= _GREATEST


@arranging
def is_sound(numbers, n):
    """Return whether slices and deviations are in order, and every slice has a run of paths."""
    slices, paths, points, fit = _counts(numbers, n)
    sheet, _ = memory.lay_sheet(numbers, HEAD, slices, paths, points)
    if not fit or not _are_bounded(carray(numbers, (n,))) or not _rises(sheet.u) or not _rises(sheet.deviation[0]):
        return False
    for i in range(slices):
        first, end = sheet.runs[i, 0], sheet.runs[i, 1]
        if not 0.0 <= first < end <= paths or first != math.floor(first) or end != math.floor(end):
            return False
    period, length = sheet.period[0], sheet.u[slices - 1] - sheet.u[0]
    return period == 0.0 or abs(period - length) <= 1e-9 * length


@arranging
def lay_surface(work, end, numbers, n):
    """Return the surface in `numbers`, with its own `period` in `work`, and the new end."""
    slices, paths, points, _ = _counts(numbers, n)
    sheet, _ = memory.lay_sheet(numbers, HEAD, slices, paths, points)
    period, end = block.vector(work, end, 2)
    return Sheet(sheet.u, sheet.nodes, sheet.runs, period, sheet.deviation), end


@arranging
def lay_pair(work, end, wheel, n_wheel, rail, n_rail, size, kept, constants):
    """Lay out the arrays of two surfaces from index `end` on. Return it, the index of the strips and the new end."""
    of_wheel, end = lay_surface(work, end, wheel, n_wheel)
    of_rail, end = lay_surface(work, end, rail, n_rail)
    search, end = memory.lay_surface_search(work, end, of_wheel, of_rail, size.n_samples)
    piece = memory.memory_size(size)
    workspace, at_strips, end = lay_out(work, end, kept[1 : 1 + piece], size, constants)
    nothing, _ = block.matrix(work, end, N_PROFILE_ROWS, 0)
    bins, _ = block.cube(work, end, 2, len(Bin), 0)
    ledger, end = memory.lay_ledger(work, end, nothing, nothing, bins, 0)
    arrays, end = memory.lay_pair(work, end, size, kept, search, workspace, ledger)
    return arrays, at_strips, end


@arranging
def lay_derivatives(work, end, size, arrays):
    """Lay out what the derivatives of `arrays` need. Return it and the new end."""
    search, end = memory.lay_surface_search(work, end, arrays.search.wheel, arrays.search.rail, size.n_samples)
    return memory.lay_derivatives(work, end, size, search, arrays)


@arranging
def place_of(numbers):
    """Return the place (y, z) of the origin of a rail's surface [m]."""
    head = carray(numbers, (HEAD,))
    return head[3], head[4]


@arranging
def periods_of(numbers, n):
    """Return the period of a surface and the middle of its full turn."""
    slices, paths, points, _ = _counts(numbers, n)
    sheet, _ = memory.lay_sheet(numbers, HEAD, slices, paths, points)
    return sheet.period[0], sheet.period[1]


@arranging
def prepare_search(wheel, n_wheel, search):
    """Fill the periods and the quadrature of a search on surfaces, which has not searched yet."""
    search.wheel.period[0], search.wheel.period[1] = periods_of(wheel, n_wheel)
    search.rail.period[0], search.rail.period[1] = 0.0, math.nan
    quadrature.fill_fejer(search.across.nodes, search.across.weights)
    search.motion[1].radius = 0.0


@arranging
def _lay(sizes, wheel, rail, work, constants):
    """Return the start, the pair's arrays, the index of the strips and the size. `wheel` and `rail`: the surfaces."""
    size, s = size_of(sizes), carray(sizes, (9,))
    n_wheel, n_rail = int(s[4]), int(s[5])
    start, end = lay_start(work, n_wheel + n_rail, memory.memory_size(size), 0)
    arrays, at_strips, end = lay_pair(work, end, wheel, n_wheel, rail, n_rail, size, start.trial, constants)
    return start, arrays, at_strips, end


@arranging
def _laid(sizes, work, constants):
    """As `_lay`, after `surfaces_init`."""
    return _lay(sizes, work, ahead(work, int(carray(sizes, (9,))[4])), work, constants)


@arranging
def _place(arrays, asked):
    of_search = arrays.search.motion[0]
    of_search.station, of_search.rotation = asked.station, asked.rotation + asked.offset.pitch
    arrays.ledger.settings[0].distance = 0.0


def surfaces_check(sizes, numbers, n, given):
    """Return 1 if an array of `n` finite numbers is a surface, else 0."""
    return 1 if is_sound(numbers, n) else 0


def surfaces_size(sizes, wheel, rail, given):
    """Return the size of `work` in float64."""
    _, arrays, _, end = _lay(sizes, wheel, rail, sizes, given.data)
    return lay_derivatives(sizes, end, size_of(sizes), arrays)[1]


def surfaces_init(sizes, work, wheel, rail, motion, case, parameters, given):
    """Copy the surfaces and fill what depends only on the options. Return the index of the strips in `work`."""
    s = carray(sizes, (9,))
    n_wheel, n_rail = int(s[4]), int(s[5])
    copy(carray(wheel, (n_wheel,)), carray(work, (n_wheel,)))
    copy(carray(rail, (n_rail,)), carray(ahead(work, n_wheel), (n_rail,)))
    a, arrays, at_strips, end = _laid(sizes, work, given.data)
    reset(a)
    y, z = place_of(rail)
    set_options(motion, y, z, case, parameters, arrays)
    prepare_search(wheel, n_wheel, arrays.search)
    fill(arrays.workspace, arrays.case[0].nu, given.data)
    derivatives, _ = lay_derivatives(work, end, size_of(sizes), arrays)
    prepare_search(wheel, n_wheel, derivatives.neighbour.search)
    return at_strips


ENTRIES: Entries = {
    "surfaces_check": (surfaces_check, "i64", ("ptr", "ptr", "i64")),
    "surfaces_size": (surfaces_size, "i64", ("ptr",) * 3),
    "surfaces_init": (surfaces_init, "i64", ("ptr",) * 7),
    **entries_of("surfaces", _laid, lay_derivatives, _place),
}
