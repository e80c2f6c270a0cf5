"""Native WheelRailPair: the functions that C calls, on one array of all values and one of working memory.

`contact.kernels.flexible.solve_flexible` does the work, as in Python. This module converts profiles, values and memory
to its arguments.
"""

from __future__ import annotations

import math
from collections import namedtuple
from collections.abc import Callable
from enum import IntEnum, auto
from typing import Any, NamedTuple

import numpy as np
from numba import carray

import contact
from contact import Status
from contact.damage import DamageParameters
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.kernels import block, memory, quadrature
from contact.kernels.block import ahead
from contact.kernels.damage.deposit import arc_length
from contact.kernels.enumerations import Height, NoAnswer
from contact.kernels.flexible import solve_flexible
from contact.kernels.geometry.prepare import facing, rail_origin, take_nodes, turn
from contact.kernels.geometry.settle import DEEPEST
from contact.kernels.records import (
    CASE,
    DAMAGE_PARAMETERS,
    GIVEN,
    LARGEST_ANGLE,
    MAX_PATCHES,
    SLOWEST,
    TOTAL,
    WHEEL_OFFSET,
)
from contact.kernels.rows import N_PROFILE_ROWS, Bin
from fmu_src.differences import creepage_steps
from fmu_src.native.component import Component
from fmu_src.native.memory import compiled, numbers_of
from fmu_src.native.solver import choose, data, fill, forget_forged, lay_out, size_of
from fmu_src.native.wires import MATERIAL, case_reader, reader, writer
from fmu_src.profiles import MAGIC, ROWS
from fmu_src.tables.solver import DAMAGE_OUTPUTS
from fmu_src.tables.wheel_rail_pair import ACCUMULATED, BINS, LOAD_KIND, PATCH, PATCHES, RAIL, SIDE, WHEEL, table
from fmu_src.variables import Table, identifier

_HEIGHTS = {"NormalForce": Height.LOAD, "Position": Height.GIVEN, "VerticalForce": Height.VERTICAL}
#: Values of `Height`, by the number of an item of LOAD_KIND, less 1.
_HEIGHT = np.array([int(_HEIGHTS[name]) for name, _ in LOAD_KIND.items])
_RIGHT = SIDE.number("Right")
_DAMAGE_PARAMETERS = np.array([DamageParameters().record(contact.STEEL, 1.0, 1.0)], DAMAGE_PARAMETERS)
_N_PATCH_ROWS = len(PATCH)  # the first members of CONTACT, in this order
#: Outputs ← members of TOTAL.
_OUTPUTS = {
    "wheelset.z": "z",
    "pressure.max": "pmax",
    "patches.count": "n_patches",
    "patches.area": "area",
    "status": "status",
    "gap_error": "gap_error",
    "wheel.Q": "Q",
    "wheel.Y": "Y",
    "wheel.Y_over_Q": "Y_over_Q",
    "used_friction": "used_friction",
    **DAMAGE_OUTPUTS,
}
_steps = compiled(creepage_steps)


class _Failure(IntEnum):
    """Reasons to discard a step. Their numbers follow those of the statuses."""

    NO_OVERLAP = max(Status) + 1
    NOT_SETTLED = auto()
    TOO_DEEP = auto()
    GAUGE_POINT = auto()
    STEEP = auto()
    ENDLESS = auto()
    TURNED = auto()


_FAILURES: dict[int, str] = {
    _Failure.NO_OVERLAP: "pose.y: the profiles of wheel and rail do not overlap",
    _Failure.NOT_SETTLED: "load.normal_force: no height was found at which the wheel carries this load on this rail",
    _Failure.TOO_DEEP: f"pose.z: the wheel lies more than {DEEPEST:g} m inside its rail",
    _Failure.GAUGE_POINT: "track.gauge_point: the rail reaches no deeper on its gauge side",
    _Failure.STEEP: "rail.inclination: the rail is steep at its top",
    _Failure.ENDLESS: "the accumulated damage has no finite value for these inputs",
    _Failure.TURNED: f"offset: with the wheelset's roll and yaw the wheel is turned by more than {LARGEST_ANGLE:g} rad",
}


def component(inclination: float, accumulation: bool = False) -> Component:
    """Return the FMU. `inclination` is the default of `rail.inclination` (tangent); `accumulation` shows the bins."""
    interface = table(inclination, accumulation)
    return Component(
        table=interface,
        entries=lambda: entries(interface),
        data=data,
        resources=((WHEEL, MAGIC["wheel"], ROWS), (RAIL, MAGIC["rail"], ROWS)),
        totals={
            "total.energy": ("power.friction",),
            "total.worn_volume": ("damage.archard_volume", "velocity.x"),
            "total.distance": ("velocity.x",),
            "total.T_gamma": ("damage.T_gamma", "velocity.x"),
        },
        accumulated=ACCUMULATED,
        accumulates="accumulation.wear_law",
        warnings={s: f"status {s.name}: {s.message}" for s in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED)},
        failures=_FAILURES,
    )


class Start(NamedTuple):
    """Working memory before the bench.

    It holds the warm start, the bins, the numbers of nodes that can touch, the whole wheel and the inclined rail.
    """

    kept: Any
    bins: Any
    counts: Any
    wheel: Any
    turned: Any


def _references(table: Table) -> Any:
    """Return a named tuple of the value references of the table's rows."""
    return namedtuple("References", [identifier(name) for name in table.span])(
        *(span.start for span in table.span.values())
    )


@compiled
def _lay_start(work, piece, n_bins, resources):
    """Lay out `Start` in `work`. Return it and the index where it ends."""
    kept, end = block.vector(work, 0, memory.pair_memory_size(piece))
    bins, end = block.cube(work, end, 2, len(Bin), n_bins)
    counts, end = block.vector(work, end, 2)
    n_wheel = int(carray(resources, (1,))[0])
    wheel = carray(ahead(resources, 1), (N_PROFILE_ROWS, n_wheel))
    n_rail = int(carray(ahead(resources, 1 + N_PROFILE_ROWS * n_wheel), (1,))[0])
    turned, end = block.matrix(work, end, N_PROFILE_ROWS, n_rail)
    return Start(kept, bins, counts, wheel, turned), end


@compiled
def _lay(work, end, start, counts, size, constants):
    """Lay out the bench from index `end` on, for curves of `counts` nodes. Return it and the total size in numbers."""
    centre, plane, creep = constants
    search, end = memory.lay_search(work, end, counts[0], counts[1], 0, size.n_samples)
    piece = memory.memory_size(size)
    own, end = lay_out(work, end, start.kept[1 : 1 + piece], size, centre, plane, creep)
    ledger, end = memory.lay_ledger(work, end, start.wheel, start.turned, start.bins, size.n_strips)
    return memory.lay_bench(work, end, size, start.kept, search, own, ledger)


@compiled
def _place(wheel, turned, counts, search):
    """Copy the parts of the profiles that can touch to the search, and fill its quadrature rule."""
    wheel_from, wheel_to = facing(wheel, True)
    rail_from, rail_to = facing(turned, False)
    counts[0], counts[1] = wheel_to - wheel_from, rail_to - rail_from
    take_nodes(wheel, wheel_from, wheel_to, search.wheel)
    take_nodes(turned, rail_from, rail_to, search.rail)
    quadrature.fill_fejer(search.across.nodes, search.across.weights)


def _sizer(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the sizes of the workspace for the parameters."""
    at = _references(table)

    @compiled
    def size(v):
        n_strips, n_elements = int(v[at.resolution_n_strips]), int(v[at.resolution_n_elements])
        return size_of(int(v[at.method_normal]), n_strips, n_elements, int(v[at.resolution_n_samples]))

    return size


def _parameter_setter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the parameters to the bench."""
    at = _references(table)
    read_material = reader(table, CASE, {**MATERIAL, "patches.surface": "conformal"})

    @compiled
    def set_parameters(v, origin_y, origin_z, bench):
        motion = bench.search.motion[0]
        motion.radius = v[at.wheel_radius]
        motion.tape = 0.5 * v[at.wheel_flange_back] + TAPE_FROM_FLANGE_BACK
        motion.combine_distance, motion.combine_angle = v[at.patches_combine_distance], v[at.patches_combine_angle]
        motion.most_patches = int(v[at.patches_max])
        motion.mirror = 1.0 if v[at.side] == _RIGHT else -1.0
        motion.origin_y, motion.origin_z = origin_y, origin_z
        read_material(v, bench.case)
        choose(int(v[at.method_normal]), int(v[at.method_tangential]), bench.case[0])
        bench.search.case[0].G, bench.search.case[0].nu = bench.case[0].G, bench.case[0].nu
        bench.damage_parameters[0] = _DAMAGE_PARAMETERS[0]
        parameters, settings = bench.damage_parameters[0], bench.ledger.settings[0]
        parameters.hardness, parameters.shear_yield = v[at.material_hardness], v[at.material_shear_yield]
        parameters.wear_law = int(v[at.accumulation_wear_law]) - 2  # the first item means that nothing accumulates
        settings.width = v[at.accumulation_width]
        settings.start = v[at.accumulation_first] / v[at.accumulation_width]
        rail = bench.rail[0]
        rail.ky, rail.kz = v[at.rail_ky], v[at.rail_kz]
        rail.preload_y, rail.preload_z = v[at.rail_preload_y], v[at.rail_preload_z]

    return set_parameters


def _reporter(table: Table) -> Callable[..., Any]:
    """Return a compiled function that copies the results to the outputs."""
    at = _references(table)
    write = writer(table, TOTAL, _OUTPUTS)

    @compiled
    def report(v, bench):
        total = bench.total[0]
        write(v, bench.total)
        for i, component in enumerate((total.Fx, total.Fy, total.Fz, total.Mx, total.My, total.Mz)):
            v[at.force_x + i] = component
        for k in range(PATCHES):
            numbers = carray(numbers_of(bench.contacts[k : k + 1]), (_N_PATCH_ROWS,))
            for row in range(_N_PATCH_ROWS):
                v[at.patch_n + PATCHES * row + k] = numbers[row]
        v[at.slip_ratio] = total.slip_area / total.area if total.area > 0.0 else 0.0
        v[at.power_friction] = v[at.velocity_x] * total.power
        v[at.rail_deflection_y], v[at.rail_deflection_z] = bench.rail[0].dy, bench.rail[0].dz

    return report


def _differ(table: Table) -> Callable[..., Any]:
    """Return a compiled function that returns the step of a variable for difference quotients."""
    at = _references(table)

    @compiled
    def difference(v, reference):
        """Return a step so small that elements hardly ever change from stick to slip within it.

        For velocities it corresponds to a millionth of the creepage at saturation. For positions it is 0.1 µm, for angles
        1e-7 rad. For heights it is 0.01 µm, since the penetration is small. Under a load the height is found to 1e-9 of the
        load. Both sides of a difference are solved from a cold start, so that the tolerance of interacting strips, 1e-4, gives
        the same error on both sides.
        """
        speed = max(v[at.velocity_x], SLOWEST)
        creepage = 1e-3 * _steps(
            v[at.friction_coefficient], abs(v[at.force_z]), v[at.material_shear_modulus], v[at.patches_area]
        )[0]  # fmt: skip
        if reference == at.pose_z or reference == at.irregularity_z or reference == at.offset_z:
            return 1e-8
        if at.pose_y <= reference <= at.pose_yaw or at.irregularity_y <= reference <= at.irregularity_roll:
            return 1e-7
        if at.offset_x <= reference <= at.offset_yaw:
            return 1e-7
        if (
            at.velocity_x <= reference <= at.irregularity_roll_rate
            or at.offset_x_rate <= reference <= at.offset_yaw_rate
        ):
            lever = v[at.wheel_radius] if reference == at.velocity_spin or reference == at.offset_pitch_rate else 1.0
            return creepage * speed / lever
        share = 1e-4 if reference == at.load_normal_force else 1e-6
        return max(share * abs(v[reference]), 1e-12)

    return difference


@compiled
def _failure(code):
    """Return the number of the failure for a value of `NoAnswer`, 0 for none."""
    if code == NoAnswer.NO_OVERLAP:
        return _Failure.NO_OVERLAP
    if code == NoAnswer.NOT_SETTLED:
        return _Failure.NOT_SETTLED
    if code == NoAnswer.TOO_DEEP:
        return _Failure.TOO_DEEP
    if code == NoAnswer.TURNED:
        return _Failure.TURNED
    return 0


class Layout(NamedTuple):
    """Compiled functions of the values that lay out the working memory."""

    size: Callable[..., Any]
    n_bins: Callable[..., Any]
    begin: Callable[..., Any]
    arrange: Callable[..., Any]


def layout_of(table: Table) -> Layout:
    """Return the functions of the layout for the rows of `table`."""
    at, size = _references(table), _sizer(table)

    @compiled
    def n_bins(v):
        """Return the number of bins on each profile, 0 if nothing accumulates."""
        return BINS if v[at.accumulation_wear_law] > 1.0 else 0

    @compiled
    def begin(v, work, resources):
        return _lay_start(work, memory.memory_size(size(v)), n_bins(v), resources)

    @compiled
    def arrange(v, work, resources, constants):
        """Return the bench that `model_prepare` has filled."""
        start, end = begin(v, work, resources)
        return _lay(work, end, start, (int(start.counts[0]), int(start.counts[1])), size(v), constants)[0]

    return Layout(size, n_bins, begin, arrange)


def entries(table: Table) -> dict[str, Callable[..., Any]]:
    """Return `Component.entries`. The data arguments are the arrays of `solver.data`."""
    at, n_values = _references(table), table.span[ACCUMULATED[0]].start
    set_parameters, report, difference = _parameter_setter(table), _reporter(table), _differ(table)
    size, n_bins, begin, arrange = layout_of(table)
    read_surface = case_reader(table, {"velocity.x": "speed"})

    def model_memory(values, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        return memory.pair_memory_size(memory.memory_size(size(v))) + 2 * len(Bin) * n_bins(v)

    def model_size(values, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        start, end = begin(v, values, resources)
        counts = start.wheel.shape[1], start.turned.shape[1]
        return _lay(values, end, start, counts, size(v), (centre, plane, creep))[1]

    def model_prepare(values, work, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        start, end = begin(v, work, resources)
        wheel, turned = start.wheel, start.turned
        rail = carray(ahead(resources, 2 + N_PROFILE_ROWS * wheel.shape[1]), (N_PROFILE_ROWS, turned.shape[1]))
        turn(rail, -math.atan(v[at.rail_inclination]), turned)
        (wheel_from, wheel_to), (rail_from, rail_to) = facing(wheel, True), facing(turned, False)
        if wheel_to - wheel_from < 3 or rail_to - rail_from < 3:
            return _Failure.STEEP
        origin_y, origin_z, deepest = rail_origin(turned, v[at.track_gauge], v[at.track_gauge_point])
        if deepest < v[at.track_gauge_point]:
            return _Failure.GAUGE_POINT
        counts = wheel_to - wheel_from, rail_to - rail_from
        bench, _ = _lay(work, end, start, counts, size(v), (centre, plane, creep))
        _place(wheel, turned, start.counts, bench.search)
        fill(bench.own, v[at.material_poisson_ratio], published)
        set_parameters(v, origin_y, origin_z, bench)
        arc_length(bench.ledger.wheel, bench.ledger.wheel_arc)
        arc_length(bench.ledger.rail, bench.ledger.rail_arc)
        return 0

    def model_start(values, work, resources, published, centre, plane, creep):
        return 0

    def model_outputs(values, work, h, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        bench = arrange(v, work, resources, (centre, plane, creep))
        read_surface(v, bench.case)
        given, _ = block.records(values, at.pose_y, 1, GIVEN)
        offset, _ = block.records(values, at.offset_x, 1, WHEEL_OFFSET)
        bench.offset[0] = offset[0]
        bench.ledger.settings[0].distance = v[at.velocity_x] * h
        piece = memory.memory_size(size(v))
        for k in range(MAX_PATCHES):
            forget_forged(bench.memory[1 + k * piece : 1 + (k + 1) * piece])
        mode = _HEIGHT[int(v[at.load_kind]) - 1]
        failure = _failure(solve_flexible(mode, max(v[at.load_normal_force], 0.0), given[0], bench))
        if failure > 0:
            return failure
        if not math.isfinite(bench.ledger.bins.sum()):
            return _Failure.ENDLESS
        report(v, bench)
        return bench.total[0].status

    def model_lazy(values, work, resources, published, centre, plane, creep):
        return 0

    def model_difference(values, reference, resources, published, centre, plane, creep):
        return difference(carray(values, (n_values,)), reference)

    def model_field(values, work, k, resources, published, centre, plane, creep):
        return 0

    called_by_c = (
        model_memory,
        model_size,
        model_prepare,
        model_start,
        model_outputs,
        model_lazy,
        model_difference,
        model_field,
    )
    return {function.__name__: function for function in called_by_c}
