"""Native WheelRailPair: the functions that C calls, on one array of all values and one of working memory.

`contact.kernels.flexible.solve_flexible` does the work, as in Python. This module converts profiles, values and memory
to its arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from numba import carray

from contact.core import arranging, group
from contact.kernels import block, memory
from contact.kernels.arrays import Cube, Matrix, Numbers
from contact.kernels.block import ahead
from contact.kernels.entries.layout import fill
from contact.kernels.entries.pair import fill_profiles, lay_derivatives, lay_pair
from contact.kernels.geometry.prepare import facing, rail_origin, turn
from contact.kernels.records import LEDGER
from contact.kernels.rows import N_PROFILE_ROWS, Bin
from ..tables.wheel_rail_pair import ACCUMULATED, BINS, DERIVED, DERIVED_BY, table
from ..variables import Table
from . import pair_parts
from .failures import Failure
from .pair_parts import sizer
from .wires import constant, reader, references

#: Shape of the derivatives that the host sees.
SEEN = len(DERIVED), len(DERIVED_BY)


@group
class Start(NamedTuple):
    """Working memory before the pair's arrays.

    It holds the warm start, the bins, the numbers of nodes that can touch, the whole wheel and the inclined rail.
    """

    kept: Annotated[Numbers, "memory.pair_memory_size(piece)"]
    bins: Annotated[Cube, "2, len(Bin), n_bins"]
    counts: Annotated[Numbers, "2"]
    wheel: Matrix
    turned: Annotated[Matrix, "N_PROFILE_ROWS, n_rail"]


_lay_arrays = block.layout(Start, "piece, n_bins, wheel, n_rail", globals())


@arranging
def _lay_start(work, piece, n_bins, resources):
    """Lay out `Start` in `work`. Return it and the index where it ends."""
    n_wheel = int(carray(resources, (1,))[0])
    wheel = carray(ahead(resources, 1), (N_PROFILE_ROWS, n_wheel))
    n_rail = int(carray(ahead(resources, 1 + N_PROFILE_ROWS * n_wheel), (1,))[0])
    return _lay_arrays(work, 0, piece, n_bins, wheel, n_rail)


@arranging
def _lay(work, end, start, counts, size, constants):
    """Lay out the pair's arrays from index `end` on, for curves of `counts` nodes.

    Return it, the arrays for its derivatives, these as the host sees them with their index, and the total size in numbers.
    """
    arrays, _, end = lay_pair(work, end, (start.wheel, start.turned), counts, size, start.kept, start.bins, constants)
    derivatives, end = lay_derivatives(work, end, size, arrays)
    derived, total = block.matrix(work, end, *SEEN)
    return arrays, derivatives, (derived, end), total


def _parameter_setter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the parameters to the pair's arrays."""
    at, rows, set_shared = references(table), constant(table), pair_parts.parameter_setter(table)
    read_ledger = reader(table, "ledger", LEDGER)

    @arranging
    def set_parameters(v, origin_y, origin_z, arrays):
        set_shared(v, origin_y, origin_z, arrays)
        arrays.damage_parameters[0].wear_law = (
            int(v[at.accumulation_wear_law]) - 2
        )  # with the first item nothing accumulates
        settings = arrays.ledger.settings[0]
        read_ledger(v, rows, arrays.ledger.settings)
        settings.start = v[at.accumulation_first] / v[at.accumulation_width]

    return set_parameters


class Layout(NamedTuple):
    """Compiled functions of the values that lay out the working memory."""

    size: Callable[..., Any]
    n_bins: Callable[..., Any]
    begin: Callable[..., Any]
    arrange: Callable[..., Any]


def layout_of(table: Table) -> Layout:
    """Return the functions of the layout for the rows of `table`."""
    at, size = references(table), sizer(table)

    @arranging
    def n_bins(v):
        """Return the number of bins on each profile, 0 if nothing accumulates."""
        return BINS if v[at.accumulation_wear_law] > 1.0 else 0

    @arranging
    def begin(v, work, resources):
        return _lay_start(work, memory.memory_size(size(v)), n_bins(v), resources)

    @arranging
    def arrange(v, work, given):
        """Return the pair's arrays that `model_prepare` has filled, and what belongs to its derivatives."""
        start, end = begin(v, work, given.resources)
        return _lay(work, end, start, (int(start.counts[0]), int(start.counts[1])), size(v), given.data)[:3]

    return Layout(size, n_bins, begin, arrange)


def entries() -> dict[str, Callable[..., Any]]:
    """Return the functions of this kind (`kinds`)."""
    rows = table()
    at, n_values = references(rows), rows.span[ACCUMULATED[0]].start
    set_parameters, report, difference = _parameter_setter(rows), pair_parts.reporter(rows), pair_parts.differ(rows)
    size, n_bins, begin, arrange = layout_of(rows)
    solve, derive = pair_parts.step_solver(rows), pair_parts.deriver(rows)

    def model_memory(values, given):
        v = carray(values, (n_values,))
        return memory.pair_memory_size(memory.memory_size(size(v))) + 2 * len(Bin) * n_bins(v)

    def model_size(values, given):
        v = carray(values, (n_values,))
        start, end = begin(v, values, given.resources)
        counts = start.wheel.shape[1], start.turned.shape[1]
        return _lay(values, end, start, counts, size(v), given.data)[3]

    def model_prepare(values, work, given):
        v = carray(values, (n_values,))
        start, end = begin(v, work, given.resources)
        wheel, turned = start.wheel, start.turned
        rail = carray(ahead(given.resources, 2 + N_PROFILE_ROWS * wheel.shape[1]), (N_PROFILE_ROWS, turned.shape[1]))
        turn(rail, -math.atan(v[at.rail_inclination]), turned)
        (wheel_from, wheel_to), (rail_from, rail_to) = facing(wheel, True), facing(turned, False)
        if wheel_to - wheel_from < 3 or rail_to - rail_from < 3:
            return Failure.STEEP
        origin_y, origin_z, deepest = rail_origin(turned, v[at.track_gauge], v[at.track_gauge_point])
        if deepest < v[at.track_gauge_point]:
            return Failure.GAUGE_POINT
        counts = wheel_to - wheel_from, rail_to - rail_from
        arrays, _, _, _ = _lay(work, end, start, counts, size(v), given.data)
        start.counts[0], start.counts[1] = counts
        fill_profiles(arrays)
        fill(arrays.workspace, v[at.material_poisson_ratio], given.data)
        set_parameters(v, origin_y, origin_z, arrays)
        return 0

    def model_outputs(values, work, h, given):
        v = carray(values, (n_values,))
        arrays, _, _ = arrange(v, work, given)
        arrays.ledger.settings[0].distance = abs(v[at.velocity_x]) * h
        failure = solve(values, v, memory.memory_size(size(v)), arrays)
        if failure > 0:
            return failure
        if not math.isfinite(arrays.ledger.bins.sum()):
            return Failure.ENDLESS
        report(v, arrays)
        return arrays.total[0].status

    def model_jacobian(values, work, given):
        v = carray(values, (n_values,))
        arrays, derivatives, (derived, begin_derived) = arrange(v, work, given)
        derive(v, arrays, derivatives, derived)
        return begin_derived

    def model_difference(values, reference, given):
        return difference(carray(values, (n_values,)), reference)

    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_jacobian, model_difference)
    return {function.__name__: function for function in called_by_c}
