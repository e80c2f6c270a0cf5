"""Entries of a wheel on a rail, from two profiles and the motion of the wheelset: `wr_pair_…` of wheelrail.h.

`sizes` are those of `patch`, then the nodes of the wheel's and the rail's profile, the number of bins, and the nodes of both
profiles that can touch (`pair_init` says how many; before, all). A profile is an array with the rows y, z and the angle of
the tangent. `work` begins with the kept start and the kept bins, from which every solution starts, and with those that the
last solution has left.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, NamedTuple

from contact.core import COMPILING, arranging, group
from contact.kernels import block, memory, quadrature
from contact.kernels.arrays import Cube, Numbers
from contact.kernels.damage.deposit import arc_length
from contact.kernels.entries.layout import Entries, copy, copy_rows, fill, forget_forged, lay_out, size_of
from contact.kernels.flexible import solve_flexible
from contact.kernels.geometry.prepare import facing, rail_origin, take_nodes
from contact.kernels.pair_conditions import derive_pair
from contact.kernels.pair_patches import solve_patch
from contact.kernels.records import CASE, CONTACT, DAMAGE_PARAMETERS, MAX_PATCHES, MOTION, PAIR_INPUT, RESULT, TOTAL
from contact.kernels.rows import N_PROFILE_ROWS, Moved

if COMPILING:
    from numba import carray


@group
class Start(NamedTuple):
    """Warm starts and bins in the caller's memory: those kept, and those that the last solution has left."""

    kept: Annotated[Numbers, "memory.pair_memory_size(piece)"]
    trial: Annotated[Numbers, "memory.pair_memory_size(piece)"]
    spare: Annotated[Numbers, "piece"]
    kept_bins: Annotated[Cube, "2, len(Bin), n_bins"]
    bins: Annotated[Cube, "2, len(Bin), n_bins"]


lay_start = block.layout(Start, "piece, n_bins", globals())


@arranging
def lay_pair(work, end, profiles, facing, size, kept, bins, constants):
    """Lay out the pair's arrays from index `end` on. Return it, the index of the strips and the new end.

    `profiles` are the rows of wheel and rail, `facing` how many nodes of them can touch, `kept` is the warm start.
    """
    search, end = memory.lay_search(work, end, facing[0], facing[1], 0, size.n_samples)
    workspace, at_strips, end = lay_out(work, end, kept[1 : 1 + memory.memory_size(size)], size, constants)
    ledger, end = memory.lay_ledger(work, end, profiles[0], profiles[1], bins, size.n_strips)
    arrays, end = memory.lay_pair(work, end, size, kept, search, workspace, ledger)
    return arrays, at_strips, end


@arranging
def lay_derivatives(work, end, size, arrays):
    """Lay out what the derivatives of `arrays` need. Return it and the new end."""
    near, end = memory.lay_near_search(work, end, size.n_samples, arrays.search)
    return memory.lay_derivatives(work, end, size, near, arrays)


@arranging
def _lay(sizes, work, constants):
    """Return the start, the pair's arrays, the indices of the strips and of the kept bins, and the size in numbers."""
    size, s = size_of(sizes), carray(sizes, (9,))
    start, end = lay_start(work, 0, memory.memory_size(size), int(s[6]))
    at_bins = end - start.kept_bins.size - start.bins.size
    wheel, end = block.matrix(work, end, N_PROFILE_ROWS, int(s[4]))
    rail, end = block.matrix(work, end, N_PROFILE_ROWS, int(s[5]))
    facing = int(s[7]), int(s[8])
    arrays, at_strips, end = lay_pair(work, end, (wheel, rail), facing, size, start.trial, start.bins, constants)
    return start, arrays, at_strips, at_bins, end


@arranging
def fill_profiles(arrays):
    """Copy the parts of the ledger's profiles that can touch to the search, and fill what else follows from both profiles."""
    search, ledger = arrays.search, arrays.ledger
    low, high = facing(ledger.wheel, True)
    take_nodes(ledger.wheel, low, high, search.wheel)
    low, high = facing(ledger.rail, False)
    take_nodes(ledger.rail, low, high, search.rail)
    quadrature.fill_fejer(search.across.nodes, search.across.weights)
    arc_length(ledger.wheel, ledger.wheel_arc)
    arc_length(ledger.rail, ledger.rail_arc)


@arranging
def _copy_bins(source, to):
    copy_rows(source[0], to[0])
    copy_rows(source[1], to[1])


@arranging
def _clear_bins(bins):
    for body in range(bins.shape[0]):
        for row in range(bins.shape[1]):
            for i in range(bins.shape[2]):
                bins[body, row, i] = 0.0


@arranging
def reset(a):
    """Forget warm starts and bins."""
    a.kept[:] = 0.0
    a.trial[:] = 0.0
    _clear_bins(a.kept_bins)
    _clear_bins(a.bins)


@arranging
def set_options(motion, y, z, case, parameters, arrays):
    """Copy what stays constant to the pair's arrays. (y, z) is the place of the rail's origin [m]."""
    motions, _ = block.records(motion, 0, 1, MOTION)
    arrays.search.motion[0] = motions[0]
    arrays.search.motion[0].origin_y, arrays.search.motion[0].origin_z = y, z
    cases, _ = block.records(case, 0, 1, CASE)
    arrays.case[0] = cases[0]
    arrays.search.case[0].G, arrays.search.case[0].nu = cases[0].G, cases[0].nu
    constants, _ = block.records(parameters, 0, 1, DAMAGE_PARAMETERS)
    arrays.damage_parameters[0] = constants[0]
    arrays.ledger.settings[0].distance = 0.0


@arranging
def _solve_from(a, arrays, piece, asked, answer):
    """Solve at one instant from the kept start into a wr_pair_answer. Return the number of patches or `NoAnswer`."""
    copy(a.kept, a.trial)
    _copy_bins(a.kept_bins, a.bins)
    for k in range(MAX_PATCHES):
        forget_forged(a.trial[1 + k * piece : 1 + (k + 1) * piece])
    arrays.case[0], arrays.rail[0], arrays.offset[0], arrays.given[0] = (
        asked.surface,
        asked.rail,
        asked.offset,
        asked.motion,
    )
    code = solve_flexible(asked.height, asked.amount, arrays)
    if code < 0:
        return code
    totals, end = block.records(answer, 1, 1, TOTAL)  # after its size
    patches, end = block.records(answer, end, MAX_PATCHES, CONTACT)
    deflection, _ = block.vector(answer, end, 2)
    totals[0], deflection[0], deflection[1] = arrays.total[0], arrays.rail[0].dy, arrays.rail[0].dz
    for k in range(MAX_PATCHES):
        patches[k] = arrays.contacts[k]
    return code if math.isfinite(a.bins.sum()) else -100


def entries_of(kind: str, lay: Any, lay_beside: Any, place: Any) -> Entries:
    """Return what profiles and surfaces have alike, by names that begin with `kind`.

    Parameters
    ----------
    lay : function (sizes, work, constants) -> (Start, arrays, …, end)
    lay_beside : function (work, end, size, arrays) -> (arrays for the derivatives, end)
    place : function (arrays, record PAIR_INPUT)
        Says where the wheel is.
    """

    def solve(sizes, work, question, answer, given):
        """Fill a wr_pair_answer for a wr_pair_input. Return the number of patches or `NoAnswer`, -100 for endless damage."""
        a, arrays = lay(sizes, work, given.data)[:2]
        asked, _ = block.records(question, 0, 1, PAIR_INPUT)
        place(arrays, asked[0])
        return _solve_from(a, arrays, memory.memory_size(size_of(sizes)), asked[0], answer)

    def derivatives(sizes, work, mode, jacobian, given):
        """Fill `jacobian`, shape (6, 17), for the last solution. Return the number of patches or `NoAnswer`."""
        laid = lay(sizes, work, given.data)
        beside, _ = lay_beside(work, laid[-1], size_of(sizes), laid[1])
        code = derive_pair(mode, laid[1], beside)
        out, _ = block.matrix(jacobian, 0, 6, Moved.FRICTION.value)
        for i in range(6):
            for j in range(out.shape[1]):
                out[i, j] = beside.jacobian[i, j]
        return code

    def accept(sizes, work, given):
        """Make what the last solution has left the start of the following ones, and keep its bins."""
        a = lay(sizes, work, given.data)[0]
        copy(a.trial, a.kept)
        _copy_bins(a.bins, a.kept_bins)
        return 0

    def forget(sizes, work, given):
        """Let the following solutions start from nothing. The bins stay."""
        a = lay(sizes, work, given.data)[0]
        a.kept[:] = 0.0
        a.trial[:] = 0.0
        return 0

    def patch(sizes, work, k, result, given):
        """Solve patch k of the last solution once more, for its strips and fields. Return the number of strips.

        It starts from what the last solution has left, which it restores.
        """
        a, arrays = lay(sizes, work, given.data)[:2]
        piece = memory.memory_size(size_of(sizes))
        of_patch = a.trial[1 + k * piece : 1 + (k + 1) * piece]
        copy(of_patch, a.spare)
        n = solve_patch(k, arrays)
        copy(a.spare, of_patch)
        results, _ = block.records(result, 0, 1, RESULT)
        results[0] = arrays.result[0]
        return n

    return {
        f"{kind}_solve": (solve, "i64", ("ptr",) * 4),
        f"{kind}_derivatives": (derivatives, "i64", ("ptr", "ptr", "i64", "ptr")),
        f"{kind}_accept": (accept, "i64", ("ptr", "ptr")),
        f"{kind}_forget": (forget, "i64", ("ptr", "ptr")),
        f"{kind}_patch": (patch, "i64", ("ptr", "ptr", "i64", "ptr")),
    }


def pair_size(sizes, given):
    """Return the size of `work` in float64."""
    laid = _lay(sizes, sizes, given.data)
    return lay_derivatives(sizes, laid[4], size_of(sizes), laid[1])[1]


def pair_strips(sizes, given):
    """Return the index of the strips in `work`. The fields follow them."""
    return _lay(sizes, sizes, given.data)[2]


def pair_bins(sizes, given):
    """Return the index of the kept bins in `work`."""
    return _lay(sizes, sizes, given.data)[3]


def pair_facing(sizes, wheel, rail, counts, given):
    """Fill `counts`: the first node and the end of the part that can touch, of the wheel and of the rail."""
    s, c = carray(sizes, (9,)), carray(counts, (4,))
    a, b = facing(carray(wheel, (N_PROFILE_ROWS, int(s[4]))), True)
    c[0], c[1] = a, b
    a, b = facing(carray(rail, (N_PROFILE_ROWS, int(s[5]))), False)
    c[2], c[3] = a, b
    return 0


def pair_init(sizes, work, wheel, rail, motion, case, parameters, gauge, gauge_point, start, width, given):
    """Fill what depends only on the options. Return 0, or 1 where the rail has no gauge point."""
    s = carray(sizes, (9,))
    whole_wheel = carray(wheel, (N_PROFILE_ROWS, int(s[4])))
    whole_rail = carray(rail, (N_PROFILE_ROWS, int(s[5])))
    y, z, deepest = rail_origin(whole_rail, gauge, gauge_point)
    if deepest < gauge_point:
        return 1
    a, arrays, _, _, _ = _lay(sizes, work, given.data)
    reset(a)
    ledger = arrays.ledger
    copy_rows(whole_wheel, ledger.wheel)
    copy_rows(whole_rail, ledger.rail)
    fill_profiles(arrays)
    set_options(motion, y, z, case, parameters, arrays)
    fill(arrays.workspace, arrays.case[0].nu, given.data)
    ledger.settings[0].start, ledger.settings[0].width = start / width, width
    return 0


@arranging
def _place(arrays, asked):
    arrays.ledger.settings[0].distance = asked.distance


ENTRIES: Entries = {
    "pair_size": (pair_size, "i64", ("ptr",)),
    "pair_strips": (pair_strips, "i64", ("ptr",)),
    "pair_bins": (pair_bins, "i64", ("ptr",)),
    "pair_facing": (pair_facing, "i64", ("ptr",) * 4),
    "pair_init": (pair_init, "i64", (*("ptr",) * 7, *("f64",) * 4)),
    **entries_of("pair", _lay, lay_derivatives, _place),
}
