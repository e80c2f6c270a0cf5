"""Native WheelRailSurfaces: the functions that C calls, on one array of all values and one of working memory.

The arrays of both surfaces lie in the resources and are read where they are. `contact_fmu.surfaces` writes them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import carray

from contact.core import arranging
from contact.kernels import block, memory
from contact.kernels.block import ahead
from contact.kernels.entries.layout import fill
from contact.kernels.entries.surfaces import is_sound, lay_derivatives, lay_pair, place_of, prepare_search
from ..tables.wheel_rail_surfaces import table
from ..variables import Table
from . import pair_parts
from .failures import Failure
from .pair_parts import sizer
from .wheel_rail_pair import SEEN
from .wires import references

_STEP_ALONG, _STEP_ANGLE = 1e-6, 2e-6  # [m], [rad] for difference quotients


@arranging
def _found(resources):
    """Return the numbers of the wheel's surface and how many they are, and those of the rail's."""
    n_wheel = int(carray(resources, (1,))[0])
    rest = ahead(resources, 1 + n_wheel)
    return ahead(resources, 1), n_wheel, ahead(rest, 1), int(carray(rest, (1,))[0])


@arranging
def _lay(work, given, size):
    """Lay out the pair's arrays. Return it, and what else `wheel_rail_pair` lays after it."""
    wheel, n_wheel, rail, n_rail = _found(given.resources)
    kept, end = block.vector(work, 0, memory.pair_memory_size(memory.memory_size(size)))
    arrays, _, end = lay_pair(work, end, wheel, n_wheel, rail, n_rail, size, kept, given.data)
    derivatives, end = lay_derivatives(work, end, size, arrays)
    derived, total = block.matrix(work, end, *SEEN)
    return arrays, derivatives, (derived, end), total


def _differ(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the step of a variable for difference quotients."""
    at, as_pair = references(table), pair_parts.differ(table)

    @arranging
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
    set_parameters, report, difference = pair_parts.parameter_setter(rows), pair_parts.reporter(rows), _differ(rows)
    size, solve, derive = sizer(rows), pair_parts.step_solver(rows), pair_parts.deriver(rows)

    def model_memory(values, given):
        return memory.pair_memory_size(memory.memory_size(size(carray(values, (n_values,)))))

    def model_size(values, given):
        return _lay(values, given, size(carray(values, (n_values,))))[3]

    def model_prepare(values, work, given):
        v = carray(values, (n_values,))
        wheel, n_wheel, rail, n_rail = _found(given.resources)
        if not is_sound(wheel, n_wheel):
            return Failure.WHEEL
        if not is_sound(rail, n_rail):
            return Failure.RAIL
        arrays, derivatives, _, _ = _lay(work, given, size(v))
        fill(arrays.workspace, v[at.material_poisson_ratio], given.data)
        y, z = place_of(rail)
        set_parameters(v, y, z, arrays)
        arrays.ledger.settings[0].distance = 0.0
        prepare_search(wheel, n_wheel, arrays.search)
        prepare_search(wheel, n_wheel, derivatives.neighbour.search)
        return 0

    def model_outputs(values, work, h, given):
        v = carray(values, (n_values,))
        arrays, _, _, _ = _lay(work, given, size(v))
        motion = arrays.search.motion[0]
        motion.station, motion.rotation = v[at.pose_station], v[at.pose_rotation] + v[at.offset_pitch]
        failure = solve(values, v, memory.memory_size(size(v)), arrays)
        if failure > 0:
            return failure
        report(v, arrays)
        return arrays.total[0].status

    def model_jacobian(values, work, given):
        v = carray(values, (n_values,))
        arrays, derivatives, (derived, begin), _ = _lay(work, given, size(v))
        derive(v, arrays, derivatives, derived)
        return begin

    def model_difference(values, reference, given):
        return difference(carray(values, (n_values,)), reference)

    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_jacobian, model_difference)
    return {function.__name__: function for function in called_by_c}
