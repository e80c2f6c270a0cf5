"""Native WheelRailSurfaces: the functions that C calls, on one array of all values and one of working memory.

The arrays of both surfaces lie in the resources and are read where they are. `fmu_src.surfaces` writes them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from numba import carray

from contact.kernels import block, memory, quadrature
from contact.kernels.arrays import Sheet
from contact.kernels.block import ahead
from contact.kernels.entries.layout import fill, lay_out
from contact.kernels.rows import N_PROFILE_ROWS, Bin
from fmu_src.native import pair_parts
from fmu_src.native.components import Failure
from fmu_src.native.memory import compiled
from fmu_src.native.pair_parts import sizer
from fmu_src.native.wires import references
from fmu_src.tables.wheel_rail_surfaces import FRAME, HEAD, table
from fmu_src.variables import Table

_TILTED = FRAME.number("Tilted")
#: Least distance of slices and of points of a deviation, below those that `fmu_src.surfaces` writes, and greatest number.
_CLOSEST, _GREATEST = 1e-7, 1e7
_STEP_ALONG, _STEP_ANGLE = 1e-6, 2e-6  # [m], [rad] for difference quotients


@compiled
def _sizes(resources, at):
    """Return the numbers of slices, paths and points of the deviation of the surface from index `at` on, and whether they fit.

    They fit if the arrays of a surface have as many numbers as the resource. Other sizes are replaced by the least ones.
    """
    n = int(carray(ahead(resources, at), (1,))[0])
    head = carray(ahead(resources, at + 1), (HEAD,))
    if not (n > HEAD and 2.0 <= head[0] <= n and 2.0 <= head[1] <= n and 1.0 <= head[2] <= n):
        return 2, 2, 1, False
    slices, paths, points = int(head[0]), int(head[1]), int(head[2])
    if memory.lay_sheet(resources, 0, slices, paths, points)[1] != n - HEAD:
        return 2, 2, 1, False
    return slices, paths, points, True


@compiled
def _rail_at(resources):
    """Return the index at which the resource of the rail begins."""
    return 1 + int(carray(resources, (1,))[0])


@compiled
def _rises(numbers):
    """Return whether numbers increase by at least `_CLOSEST`."""
    least = math.inf
    for i in range(numbers.size - 1):
        least = min(least, numbers[i + 1] - numbers[i])
    return least >= _CLOSEST


@compiled
def _are_bounded(resources, at):
    """Return whether no number of the surface from index `at` on is so large that heights could overflow."""
    numbers = carray(ahead(resources, at + 1), (int(carray(ahead(resources, at), (1,))[0]),))
    greatest = 0.0
    for i in range(numbers.size):
        greatest = max(greatest, abs(numbers[i]))
    return greatest <= _GREATEST


@compiled
def _is_sound(resources, at):
    """Return whether slices and deviations are in order, and every slice has a run of paths."""
    slices, paths, points, fit = _sizes(resources, at)
    sheet, _ = memory.lay_sheet(resources, at + 1 + HEAD, slices, paths, points)
    if not fit or not _are_bounded(resources, at) or not _rises(sheet.u) or not _rises(sheet.deviation[0]):
        return False
    for i in range(slices):
        first, end = sheet.runs[i, 0], sheet.runs[i, 1]
        if not 0.0 <= first < end <= paths or first != math.floor(first) or end != math.floor(end):
            return False
    period, length = sheet.period[0], sheet.u[slices - 1] - sheet.u[0]
    return period == 0.0 or abs(period - length) <= 1e-9 * length


@compiled
def _period(resources, at):
    """Return the period of a surface and the middle of its full turn."""
    slices, paths, points, _ = _sizes(resources, at)
    sheet, _ = memory.lay_sheet(resources, at + 1 + HEAD, slices, paths, points)
    return sheet.period[0], sheet.period[1]


@compiled
def _lay_surface(work, end, resources, at):
    """Return the surface from index `at` of the resources on, with its own `period` in `work`, and the new end."""
    slices, paths, points, _ = _sizes(resources, at)
    sheet, _ = memory.lay_sheet(resources, at + 1 + HEAD, slices, paths, points)
    period, end = block.vector(work, end, 2)
    return Sheet(sheet.u, sheet.nodes, sheet.runs, period, sheet.deviation), end


@compiled
def _lay(work, given, size):
    """Lay out the bench. Return it and the total size in numbers."""
    resources, piece = given.resources, memory.memory_size(size)
    kept, end = block.vector(work, 0, memory.pair_memory_size(piece))
    wheel, end = _lay_surface(work, end, resources, 0)
    rail, end = _lay_surface(work, end, resources, _rail_at(resources))
    search, end = memory.lay_surface_search(work, end, wheel, rail, size.n_samples)
    own, _, end = lay_out(work, end, kept[1 : 1 + piece], size, given.data)
    nothing, _ = block.matrix(work, end, N_PROFILE_ROWS, 0)
    bins, _ = block.cube(work, end, 2, len(Bin), 0)
    ledger, end = memory.lay_ledger(work, end, nothing, nothing, bins, 0)
    return memory.lay_bench(work, end, size, kept, search, own, ledger)


def _parameter_setter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the parameters to the bench."""
    at, set_shared = references(table), pair_parts.parameter_setter(table)

    @compiled
    def set_parameters(v, origin_y, origin_z, bench):
        set_shared(v, origin_y, origin_z, bench)
        motion = bench.search.motion[0]
        motion.reach, motion.tilted = v[at.surfaces_reach], 1 if v[at.surfaces_frame] == _TILTED else 0
        bench.search.motion[1].radius = 0.0  # no search before
        bench.ledger.settings[0].distance = 0.0

    return set_parameters


def _differ(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the step of a variable for difference quotients."""
    at, as_pair = references(table), pair_parts.differ(table)

    @compiled
    def difference(v, reference):
        if reference == at.pose_station:
            return _STEP_ALONG
        if reference == at.pose_rotation:
            return _STEP_ANGLE
        return as_pair(v, reference)

    return difference


def entries() -> dict[str, Callable[..., Any]]:
    """Return the functions of this kind (`kinds`)."""
    rows = table()
    at, n_values = references(rows), len(rows.scalars)
    set_parameters, report, difference = _parameter_setter(rows), pair_parts.reporter(rows), _differ(rows)
    size, solve = sizer(rows), pair_parts.step_solver(rows)

    def model_memory(values, given):
        return memory.pair_memory_size(memory.memory_size(size(carray(values, (n_values,)))))

    def model_size(values, given):
        return _lay(values, given, size(carray(values, (n_values,))))[1]

    def model_prepare(values, work, given):
        v, resources = carray(values, (n_values,)), given.resources
        at_rail = _rail_at(resources)
        if not _is_sound(resources, 0):
            return Failure.WHEEL
        if not _is_sound(resources, at_rail):
            return Failure.RAIL
        bench, _ = _lay(work, given, size(v))
        search = bench.search
        search.wheel.period[0], search.wheel.period[1] = _period(resources, 0)
        search.rail.period[0], search.rail.period[1] = 0.0, math.nan
        quadrature.fill_fejer(search.across.nodes, search.across.weights)
        fill(bench.own, v[at.material_poisson_ratio], given.data)
        origin = carray(ahead(resources, at_rail + HEAD - 1), (2,))
        set_parameters(v, origin[0], origin[1], bench)
        return 0

    def model_outputs(values, work, h, given):
        v = carray(values, (n_values,))
        bench, _ = _lay(work, given, size(v))
        motion = bench.search.motion[0]
        motion.station, motion.rotation = v[at.pose_station], v[at.pose_rotation] + v[at.offset_pitch]
        failure = solve(values, v, memory.memory_size(size(v)), bench)
        if failure > 0:
            return failure
        report(v, bench)
        return bench.total[0].status

    def model_difference(values, reference, given):
        return difference(carray(values, (n_values,)), reference)

    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
