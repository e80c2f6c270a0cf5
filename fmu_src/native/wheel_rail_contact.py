"""The contact behind the native FMU's table: what C calls, over one array of all values and one of working memory.

The solver's own kernels do the work; here values become their arguments and results become values.
"""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numba import carray

from contact.kernels.layout import Field, LoadKind, Strip
import contact
from contact import Status
from contact.kernels.layout import MAX_PATCHES, N_CASE, N_FIELD_ROWS
from contact.damage import DamageParameters
from contact.kernels.damage.assess import N_DAMAGE, N_DAMAGE_FIELDS, N_PAR, damage_kernel
from contact.kernels.pipeline import solve_case, solve_conformal
from contact.separation import HERTZIAN_POINTS, fill_hertzian
from fmu_src.differences import creepage_steps
from fmu_src.native.component import Component
from fmu_src.native.memory import compiled, cube, matrix, vector
from fmu_src.native.solver import (
    NORMAL_IDS,
    TANGENTIAL_IDS,
    data,
    fill,
    fill_friction,
    lay_out,
    memory_size,
)
from fmu_src.tables.solver import SURFACE
from fmu_src.tables.wheel_rail_contact import FLATTEST, GEOMETRY_KIND, LOAD_KIND, table
from fmu_src.variables import Table, identifier

_CURVATURES, _NORMAL_FORCE = GEOMETRY_KIND.number("Curvatures"), LOAD_KIND.number("NormalForce")
_CONFORMAL = SURFACE.number("Conformal")
_DAMAGE_PARAMETERS = DamageParameters().array(contact.STEEL, 1.0, 1.0)
_steps = compiled(creepage_steps)
#: Field of the table → row of the solver's fields, or what is made of strips.
_PATCH, _Y, _AREA = range(N_FIELD_ROWS, N_FIELD_ROWS + 3)
_FIELDS = {
    "field.patch": _PATCH,
    "field.x": Field.X,
    "field.y": _Y,
    "field.area": _AREA,
    "field.pressure": Field.P,
    "field.traction_x": Field.QX,
    "field.traction_y": Field.QY,
    "field.slip_x": Field.SX,
    "field.slip_y": Field.SY,
    "field.stick": Field.STICK,
}


@compiled
def _element(strips, fields, row, i, j):
    """Number of an element in the row of `_FIELDS`."""
    if row == _PATCH:
        return strips[Strip.PATCH, i] + 1.0
    if row == _Y:
        return strips[Strip.Y, i]
    if row == _AREA:
        return strips[Strip.DY, i] * fields[Field.DX, i, j]
    return fields[row, i, j]


def component(points: int) -> Component:
    """The FMU for separations of `points` samples."""
    interface = table(points)
    return Component(
        table=interface,
        entries=lambda: _entries(interface),
        data=data,
        lazy=("creep_stiffness",),
        totals={"total.energy": ("power.friction",), "total.worn_volume": ("damage.archard_volume", "speed")},
        warnings={int(s): f"status {s.name}: {s.message}" for s in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED)},
    )


class Problem(NamedTuple):
    """What `solve_case` is given of the problem."""

    y: object
    g: object
    A: object
    xc: object
    tilt: object
    rolling: object  # one number
    case: object


class After(NamedTuple):
    """What comes after `solve_case`: damage, and what the host sees of the fields."""

    damage_parameters: object
    damage_fields: object
    damage: object
    count: object  # of strips
    shown: object  # one field as the host sees it


def _entries(table: Table) -> dict[str, Callable[..., Any]]:
    """`Component.entries`; data are Kalker's coefficients and the influence of strips on the centre line and off it."""
    at = namedtuple("References", [identifier(name) for name in table.span])(
        *(span.start for span in table.span.values())
    )
    n_values, points = len(table.scalars), table.row["geometry.g"].size
    samples = max(points, HERTZIAN_POINTS)
    rows = np.array([_FIELDS[field.name] for field in table.fields])

    @compiled
    def warm_start_size(v):
        return memory_size(int(v[at.method_normal]), int(v[at.resolution_n_strips]))

    @compiled
    def arrange(v, work, centre, plane, creep):
        """Lay all arrays into `work`; return them, where the field shown to the host begins, how many numbers there are."""
        n_strips, n_elements = int(v[at.resolution_n_strips]), int(v[at.resolution_n_elements])
        capacity = MAX_PATCHES * n_strips
        memory, end = vector(work, 0, warm_start_size(v))
        own, end = lay_out(work, end, memory, n_strips, n_elements, samples, centre, plane, creep)
        y, end = vector(work, end, samples)
        g, end = vector(work, end, samples)
        A, end = vector(work, end, samples)
        xc, end = vector(work, end, samples)
        tilt, end = vector(work, end, samples)
        rolling, end = vector(work, end, 1)
        case, end = vector(work, end, N_CASE)
        parameters, end = vector(work, end, N_PAR)
        damage_fields, end = cube(work, end, N_DAMAGE_FIELDS, capacity, n_elements)
        damage, end = vector(work, end, N_DAMAGE)
        count, end = vector(work, end, 1)
        shown, total = matrix(work, end, capacity, n_elements)
        problem = Problem(y, g, A, xc, tilt, rolling, case)
        return own, problem, After(parameters, damage_fields, damage, count, shown), end, total

    @compiled
    def pose(v, problem):
        """Fill the problem from values; return how many samples its separation has."""
        case, n = problem.case, points
        if v[at.geometry_kind] == _CURVATURES:
            n = HERTZIAN_POINTS
            fill_hertzian(v[at.geometry_B0], problem.y[:n], problem.g[:n])
        for i in range(n):
            problem.xc[i], problem.tilt[i] = 0.0, 0.0
            if v[at.geometry_kind] == _CURVATURES:
                problem.A[i] = v[at.geometry_A0]
            else:
                problem.y[i] = v[at.geometry_y0] + v[at.geometry_dy] * i
                problem.g[i], problem.A[i] = v[at.geometry_g + i], max(v[at.geometry_A + i], FLATTEST)
                problem.tilt[i] = v[at.geometry_tilt + i]
        problem.rolling[0] = v[at.geometry_rolling] if v[at.geometry_kind] != _CURVATURES else 0.0
        case.conformal = 1.0 if v[at.geometry_surface] == _CONFORMAL else 0.0
        by_load = v[at.load_kind] == _NORMAL_FORCE
        case.load_kind = LoadKind.LOAD if by_load else LoadKind.APPROACH
        case.amount = v[at.load_normal_force] if by_load else v[at.load_approach]
        case.vx, case.vy = v[at.creepage_longitudinal], v[at.creepage_lateral]
        case.phi = v[at.creepage_spin]
        fill_friction(v, at.friction_coefficient, at.friction_law, v[at.speed], case)
        case.G, case.nu = v[at.material_shear_modulus], v[at.material_poisson_ratio]
        case.pressure_limit = v[at.material_pressure_limit]
        case.normal = NORMAL_IDS[int(v[at.method_normal]) - 1]
        case.tangential = TANGENTIAL_IDS[int(v[at.method_tangential]) - 1]
        return n

    @compiled
    def solve(n, own, problem, after):
        """Solve what `pose` has left."""
        y, g, A, xc, case = problem.y[:n], problem.g[:n], problem.A[:n], problem.xc[:n], problem.case
        rule, tables, space, strips, fields, result = own
        if case.conformal > 0.5 and case.tangential < CARTER:
            tilt, rolling = problem.tilt[:n], problem.rolling[0]
            count = solve_conformal(y, g, A, xc, tilt, rolling, case, rule, tables, space, strips, fields, result)
        else:
            count = solve_case(y, g, A, xc, case, rule, tables, space, strips, fields, result)
        after.count[0] = count
        return count

    def model_memory(values, published, centre, plane, creep):
        return warm_start_size(carray(values, (n_values,)))

    def model_size(values, published, centre, plane, creep):
        return arrange(carray(values, (n_values,)), values, centre, plane, creep)[4]

    def model_prepare(values, work, published, centre, plane, creep):
        v = carray(values, (n_values,))
        own, _, after, _, _ = arrange(v, work, centre, plane, creep)
        fill(own, v[at.material_poisson_ratio], published)
        for i in range(N_PAR):
            after.damage_parameters[i] = _DAMAGE_PARAMETERS[i]
        return 0

    def model_start(values, work, published, centre, plane, creep):
        return 0

    def model_outputs(values, work, h, published, centre, plane, creep):
        v = carray(values, (n_values,))
        own, problem, after, _, _ = arrange(v, work, centre, plane, creep)
        n = solve(pose(v, problem), own, problem, after)
        parameters, result, damage = after.damage_parameters, own.result, after.damage
        speed = v[at.speed]
        parameters.speed, parameters.wheel_radius = speed, v[at.wheel_radius]
        parameters.hardness, parameters.shear_yield = v[at.material_hardness], v[at.material_shear_yield]
        damage_kernel(own.strips, n, own.fields, problem.case, result, parameters, after.damage_fields, damage)
        power = speed * result.power
        v[at.force_x], v[at.force_y], v[at.force_n] = result.Fx, result.Fy, result.N
        v[at.moment_z], v[at.approach], v[at.pressure_max] = result.Mz, result.approach, result.pmax
        v[at.patch_area], v[at.patch_length], v[at.patch_width] = (
            result.area,
            result.length,
            result.width,
        )
        v[at.patch_count], v[at.power_friction] = result.n_patches, power
        v[at.slip_ratio] = result.slip_area / result.area if result.area > 0.0 else 0.0
        v[at.damage_T_gamma], v[at.damage_index_burstow] = damage.T_gamma, damage.burstow
        v[at.damage_wear_rate_pearce_sherratt] = damage.pearce_sherratt
        v[at.damage_wear_rate_usfd] = damage.usfd
        v[at.damage_archard_depth_max] = damage.archard_depth
        v[at.damage_archard_volume] = damage.archard_volume
        v[at.damage_fatigue_index_surface] = damage.fatigue_index
        v[at.damage_stress_index_max] = damage.stress_index
        v[at.damage_energy_index_max] = damage.energy_index
        v[at.stiffness_normal], v[at.status] = result.stiffness, result.status
        return int(result.status)

    @compiled
    def steps(v):
        return _steps(v[at.friction_coefficient], v[at.force_n], v[at.material_shear_modulus], v[at.patch_area])

    def model_lazy(values, work, published, centre, plane, creep):
        v = carray(values, (n_values,))
        own, problem, after, _, _ = arrange(v, work, centre, plane, creep)
        n, case, result = pose(v, problem), problem.case, own.result
        for j, step in enumerate(steps(v)):
            for i in range(3):
                v[at.creep_stiffness + 3 * i + j] = 0.0
            for sign in (1.0, -1.0):
                case[CASE_VX + j] = v[at.creepage_longitudinal + j] + sign * step
                own.space.memory[0] = 0.0  # a cold start: what is found does not depend on earlier steps
                solve(n, own, problem, after)
                for i in range(3):
                    v[at.creep_stiffness + 3 * i + j] += sign * result[RES_FX + i] / (2.0 * step)
            case[CASE_VX + j] = v[at.creepage_longitudinal + j]
        return 0

    def model_difference(values, reference, published, centre, plane, creep):
        """A step so small that hardly ever an element passes from stick to slip within it: forces have kinks there.

        A thousandth of the step of `creep_stiffness`, which is meant to average over the kinks, or a millionth of a value:
        of the penetration for the approach, and for the gap where that is less: along the geometry as a whole, samples
        outside the patch then leave those inside a step above round-off. Every difference begins anew, from nothing, so
        that the error which interacting strips are solved to, 1e-4, is the same on both sides.
        """
        v = carray(values, (n_values,))
        if at.creepage_longitudinal <= reference <= at.creepage_spin:
            longitudinal, lateral, spin = steps(v)
            if reference == at.creepage_spin:
                return 1e-3 * spin
            return 1e-3 * (lateral if reference == at.creepage_lateral else longitudinal)
        penetration = (
            1.5 * v[at.force_n] / v[at.stiffness_normal] if v[at.stiffness_normal] > 0.0 else 1e-6
        )  # N ~ its ^3/2
        if reference == at.load_approach:
            return 1e-6 * penetration
        if at.geometry_g <= reference < at.geometry_g + points:
            least = v[at.geometry_g]
            for i in range(1, points):
                least = min(least, v[at.geometry_g + i])
            return 1e-6 * max(penetration, v[reference] - least)
        if at.geometry_tilt <= reference <= at.geometry_rolling:
            return 1e-6 * max(abs(v[reference]), 1.0)
        return max(1e-6 * abs(v[reference]), 1e-12)

    def model_field(values, work, k, published, centre, plane, creep):
        v = carray(values, (n_values,))
        own, _, after, begin, _ = arrange(v, work, centre, plane, creep)
        n, shown = after.count[0], after.shown
        for i in range(shown.shape[0]):
            for j in range(shown.shape[1]):
                shown[i, j] = _element(own.strips, own.fields, rows[k], i, j) if i < n else 0.0
        return begin

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
