"""The pair behind the native FMU's table: what C calls, over one array of all values and one of working memory.

`contact.kernels.pair.solve_pair` does the work, as in Python; here profiles, values and memory become its arguments.
"""

from __future__ import annotations

import math
from collections import namedtuple
from collections.abc import Callable
from typing import Any, NamedTuple

from numba import carray

import contact
from contact import Status, quadrature
from contact.kernels.layout import MAX_PATCHES, N_CASE
from contact.damage import DamageParameters
from contact.kernels.damage.assess import N_DAMAGE, N_DAMAGE_FIELDS, N_PAR
from contact.kernels.damage.deposit import N_ROWS, arc_length
from contact.geometry import layout as rows
from contact.kernels.geometry.prepare import cut, facing, rail_origin, turn
from contact.kernels.geometry.settle import DEEPEST, GIVEN_Z, NO_OVERLAP, NOT_SETTLED, TOO_DEEP
from contact.kernels.geometry.settle import LOAD as UNDER_LOAD
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.geometry.workspace import N_STRIPS as SEARCH_STRIPS
from contact.kernels.pair import N_TOTAL, Bench, solve_pair
from contact.kernels.layout import N_CONTACT
from contact.kernels.ledger import DISTANCE, N_SETTINGS, START, WIDTH, Ledger
from fmu_src.differences import creepage_steps
from fmu_src.native.component import Component
from fmu_src.native.memory import ahead, compiled, cube, matrix, vector
from fmu_src.native.search import lay_out as search_arrays
from fmu_src.native.solver import (
    NORMAL_IDS,
    TANGENTIAL_IDS,
    data,
    fill,
    fill_friction,
    lay_out,
    memory_size,
)
from fmu_src.profiles import MAGIC
from fmu_src.tables.wheel_rail_pair import ACCUMULATED, BINS, LOAD_KIND, PATCH, PATCHES, RAIL, SIDE, WHEEL, table
from fmu_src.variables import Table, identifier

_UNDER_LOAD, _RIGHT = LOAD_KIND.number("NormalForce"), SIDE.number("Right")
_DAMAGE_PARAMETERS = DamageParameters().array(contact.STEEL, 1.0, 1.0)
_N_PATCH_ROWS = len(PATCH)
_steps = compiled(creepage_steps)

#: What discards a step, numbered behind the statuses.
_NO_OVERLAP, _NOT_SETTLED, _TOO_DEEP, _GAUGE_POINT, _STEEP, _ENDLESS = range(6, 12)
_FAILURES = {
    _NO_OVERLAP: "pose.y: the profiles of wheel and rail do not overlap",
    _NOT_SETTLED: "load.normal_force: no height was found at which the wheel carries it on this rail",
    _TOO_DEEP: f"pose.z: the wheel lies more than {DEEPEST:g} m inside its rail",
    _GAUGE_POINT: "track.gauge_point: the rail reaches no deeper on its gauge side",
    _STEEP: "rail.inclination: the rail is steep at its top",
    _ENDLESS: "what accumulates has no finite value for these inputs",
}


def component(inclination: float) -> Component:
    """The FMU for a rail that is to be turned by this inclination unless told otherwise."""
    interface = table(inclination)
    return Component(
        table=interface,
        entries=lambda: _entries(interface),
        data=data,
        resources=((WHEEL, MAGIC["wheel"]), (RAIL, MAGIC["rail"])),
        totals={
            "total.energy": ("power.friction",),
            "total.worn_volume": ("damage.archard_volume", "velocity.x"),
            "total.distance": ("velocity.x",),
            "total.T_gamma": ("damage.T_gamma", "velocity.x"),
        },
        accumulated=ACCUMULATED,
        accumulates="accumulation.wear_law",
        warnings={int(s): f"status {s.name}: {s.message}" for s in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED)},
        failures=_FAILURES,
    )


class Start(NamedTuple):
    """What lies before the bench: bins, counts of nodes that can touch, the whole wheel, the rail turned by its inclination."""

    bins: object
    counts: object
    wheel: object
    turned: object


def _entries(table: Table) -> dict[str, Callable[..., Any]]:
    """`Component.entries`; data are Kalker's coefficients and the influence of strips on the centre line and off it."""
    at = namedtuple("References", [identifier(name) for name in table.span])(
        *(span.start for span in table.span.values())
    )
    n_values = table.span[ACCUMULATED[0]].start

    @compiled
    def piece_size(v):
        """Size of the memory of one patch."""
        return memory_size(int(v[at.method_normal]), int(v[at.resolution_n_strips]))

    @compiled
    def n_bins(v):
        """Bins over each profile, if anything accumulates."""
        return BINS if v[at.accumulation_wear_law] > 1.0 else 0

    @compiled
    def start(v, work, resources):
        """Lay out what comes first in `work`; return the memory, the rest, and where that ends."""
        memory, end = vector(work, 0, 1 + MAX_PATCHES * piece_size(v))
        bins, end = cube(work, end, 2, N_ROWS, n_bins(v))
        counts, end = vector(work, end, 2)
        n_wheel = int(carray(resources, (1,))[0])
        wheel = carray(ahead(resources, 1), (3, n_wheel))
        turned, end = matrix(work, end, 3, int(carray(ahead(resources, 1 + 3 * n_wheel), (1,))[0]))
        return memory, Start(bins, counts, wheel, turned), end

    @compiled
    def arrange(v, work, resources, n_wheel, n_rail, centre, plane, creep):
        """Lay all arrays into `work` for curves of so many nodes; return them, and how many numbers they are."""
        n_strips, n_elements = int(v[at.resolution_n_strips]), int(v[at.resolution_n_elements])
        samples, capacity = int(v[at.resolution_n_samples]), MAX_PATCHES * n_strips
        memory, begin, end = start(v, work, resources)
        search, end = search_arrays(work, end, n_wheel, n_rail, 0, samples, SEARCH_STRIPS)
        own, end = lay_out(
            work, end, memory[1 : 1 + piece_size(v)], n_strips, n_elements, samples, centre, plane, creep
        )  # fmt: skip
        case, end = vector(work, end, N_CASE)
        parameters, end = vector(work, end, N_PAR)
        damage_fields, end = cube(work, end, N_DAMAGE_FIELDS, capacity, n_elements)
        damage, end = vector(work, end, N_DAMAGE)
        contacts, end = matrix(work, end, MAX_PATCHES, N_CONTACT)
        total, end = vector(work, end, N_TOTAL)
        wheel_arc, end = vector(work, end, begin.wheel.shape[1])
        rail_arc, end = vector(work, end, begin.turned.shape[1])
        settings, end = vector(work, end, N_SETTINGS)
        rates, end = matrix(work, end, N_ROWS, capacity)
        edges, end = matrix(work, end, 2, capacity)
        ledger = Ledger(begin.wheel, wheel_arc, begin.turned, rail_arc, settings, rates, edges, begin.bins)
        bench = Bench(search, own, case, memory, parameters, damage_fields, damage, contacts, total, ledger)
        return bench, end

    def model_memory(values, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        return 1 + MAX_PATCHES * piece_size(v) + 2 * N_ROWS * n_bins(v)

    def model_size(values, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        n_wheel, n_rail = int(carray(resources, (1,))[0]), start(v, values, resources)[1].turned.shape[1]
        return arrange(v, values, resources, n_wheel, n_rail, centre, plane, creep)[1]

    def model_prepare(values, work, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        _, begin, _ = start(v, work, resources)
        wheel = begin.wheel
        rail = carray(ahead(resources, 2 + 3 * wheel.shape[1]), (3, begin.turned.shape[1]))
        turn(rail, -math.atan(v[at.rail_inclination]), begin.turned)
        wheel_from, wheel_to = facing(wheel, True)
        rail_from, rail_to = facing(begin.turned, False)
        if wheel_to - wheel_from < 3 or rail_to - rail_from < 3:
            return _STEEP
        origin_y, origin_z, deepest = rail_origin(begin.turned, v[at.track_gauge], v[at.track_gauge_point])
        if deepest < v[at.track_gauge_point]:
            return _GAUGE_POINT
        begin.counts[0], begin.counts[1] = wheel_to - wheel_from, rail_to - rail_from
        bench, _ = arrange(v, work, resources, wheel_to - wheel_from, rail_to - rail_from, centre, plane, creep)
        search, motion, case = bench.search, bench.search.motion, bench.case
        cut(wheel, wheel_from, wheel_to, search.wheel)
        cut(begin.turned, rail_from, rail_to, search.rail)
        motion.radius = v[at.wheel_radius]
        motion.tape = 0.5 * v[at.wheel_flange_back] + TAPE_FROM_FLANGE_BACK
        motion.combine_distance = v[at.patches_combine_distance]
        motion.combine_angle = v[at.patches_combine_angle]
        motion.most_patches = v[at.patches_max]
        motion.mirror = 1.0 if v[at.side] == _RIGHT else -1.0
        motion.origin_y, motion.origin_z = origin_y, origin_z
        quadrature.fill_fejer(search.nodes, search.weights)
        fill(bench.own, v[at.material_poisson_ratio], published)
        case.G, case.nu = v[at.material_shear_modulus], v[at.material_poisson_ratio]
        case.pressure_limit = v[at.material_pressure_limit]
        search.case.G, search.case.nu = case.G, case.nu
        case.normal = NORMAL_IDS[int(v[at.method_normal]) - 1]
        case.tangential = TANGENTIAL_IDS[int(v[at.method_tangential]) - 1]
        case.conformal = v[at.patches_surface] - 1.0
        for i in range(N_PAR):
            bench.damage_parameters[i] = _DAMAGE_PARAMETERS[i]
        bench.damage_parameters.hardness = v[at.material_hardness]
        bench.damage_parameters.shear_yield = v[at.material_shear_yield]
        bench.damage_parameters.wear_law = v[at.accumulation_wear_law] - 2.0  # the first item is none
        ledger = bench.ledger
        arc_length(ledger.wheel, ledger.wheel_arc)
        arc_length(ledger.rail, ledger.rail_arc)
        ledger.settings[WIDTH] = v[at.accumulation_width]
        ledger.settings[START] = v[at.accumulation_first] / v[at.accumulation_width]
        return 0

    def model_start(values, work, resources, published, centre, plane, creep):
        return 0

    def model_outputs(values, work, h, resources, published, centre, plane, creep):
        v = carray(values, (n_values,))
        counts = start(v, work, resources)[1].counts
        bench, _ = arrange(v, work, resources, int(counts[0]), int(counts[1]), centre, plane, creep)
        fill_friction(v, at.friction_coefficient, at.friction_law, v[at.velocity_x], bench.case)
        given = carray(ahead(values, at.pose_y), (rows.N_GIVEN,))
        by_load = v[at.load_kind] == _UNDER_LOAD
        bench.ledger.settings[DISTANCE] = v[at.velocity_x] * h
        code = solve_pair(UNDER_LOAD if by_load else GIVEN_Z, v[at.load_normal_force], given, bench)
        if code == NO_OVERLAP:
            return _NO_OVERLAP
        if code == NOT_SETTLED:
            return _NOT_SETTLED
        if code == TOO_DEEP:
            return _TOO_DEEP
        if not math.isfinite(bench.ledger.bins.sum()):
            return _ENDLESS
        total, speed = bench.total, v[at.velocity_x]
        for i in range(6):
            v[at.force_x + i] = total[TOTAL_FX + i]
        for row in range(_N_PATCH_ROWS):
            for k in range(PATCHES):
                v[at.patch_n + PATCHES * row + k] = bench.contacts[k, row]
        v[at.wheelset_z], v[at.pressure_max] = total.z, total.pmax
        v[at.patches_count], v[at.patches_area] = total.n_patches, total.area
        v[at.slip_ratio] = total.slip_area / total.area if total.area > 0.0 else 0.0
        v[at.power_friction], v[at.status] = speed * total.power, total.status
        v[at.damage_T_gamma] = total[TOTAL_DAMAGE + DAMAGE_T_GAMMA]
        v[at.damage_wear_rate_pearce_sherratt] = total[TOTAL_DAMAGE + DAMAGE_PEARCE_SHERRATT]
        v[at.damage_index_burstow] = total[TOTAL_DAMAGE + DAMAGE_BURSTOW]
        v[at.damage_wear_rate_usfd] = total[TOTAL_DAMAGE + DAMAGE_USFD]
        v[at.damage_archard_depth_max] = total[TOTAL_DAMAGE + DAMAGE_ARCHARD_DEPTH]
        v[at.damage_archard_volume] = total[TOTAL_DAMAGE + DAMAGE_ARCHARD_VOLUME]
        v[at.damage_fatigue_index_surface] = total[TOTAL_DAMAGE + DAMAGE_FATIGUE_INDEX]
        v[at.damage_stress_index_max] = total[TOTAL_DAMAGE + DAMAGE_STRESS_INDEX]
        v[at.damage_energy_index_max] = total[TOTAL_DAMAGE + DAMAGE_ENERGY_INDEX]
        return int(total.status)

    def model_lazy(values, work, resources, published, centre, plane, creep):
        return 0

    def model_difference(values, reference, resources, published, centre, plane, creep):
        """A step in which hardly an element passes from stick to slip: a millionth of the creepage that saturates.

        Positions and angles are moved by a tenth of a micrometre or what turns by that much a metre away; a height that is
        given by a tenth of that, as the penetration is small. Under a load the height is found to 1e-9 of the load. Every
        difference begins anew, from nothing, so that the error which interacting strips are solved to, 1e-4, is the same
        on both sides.
        """
        v = carray(values, (n_values,))
        speed = v[at.velocity_x]
        creepage = 1e-3 * _steps(
            v[at.friction_coefficient], abs(v[at.force_z]), v[at.material_shear_modulus], v[at.patches_area]
        )[0]  # fmt: skip
        if reference == at.pose_z or reference == at.irregularity_z:
            return 1e-8
        if at.pose_y <= reference <= at.pose_yaw or at.irregularity_y <= reference <= at.irregularity_roll:
            return 1e-7
        if at.velocity_x <= reference <= at.irregularity_roll_rate:
            lever = v[at.wheel_radius] if reference == at.velocity_spin else 1.0
            return creepage * speed / lever
        share = 1e-4 if reference == at.load_normal_force else 1e-6
        return max(share * abs(v[reference]), 1e-12)

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
