"""Native WheelRailContact: the functions that C calls, on one array of all values and one of working memory.

The solver's own kernels do the work. This module converts values to their arguments and results to values.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import IntEnum, auto
from typing import Annotated, Any, NamedTuple

import numpy as np
from numba import carray

import contact
from contact.core import arranging, group
from contact.damage import DamageParameters
from contact.kernels import block, memory
from contact.kernels.arrays import Cube, Damages, Matrix, Numbers, Parameters, Samples, SolverArrays
from contact.kernels.damage.assess import damage_kernel
from contact.kernels.entries.layout import fill, forget_forged, lay_out
from contact.kernels.enumerations import FrictionLaw, LoadKind
from contact.kernels.jacobian import (
    AMOUNT,
    COLUMNS,
    MU,
    POWER,
    ROWS,
    creepage_step,
    derive_solved,
    roll_creepages,
    subtract_creepages,
)
from contact.kernels.pipeline import solve_case
from contact.kernels.records import DAMAGE, DAMAGE_PARAMETERS, RESULT
from contact.kernels.rows import Field, Strip
from contact.kernels.separation import HERTZIAN_POINTS, fill_hertzian
from contact.kernels.solver import for_forces
from ..tables.solver import SURFACE
from ..tables.wheel_rail_contact import FLATTEST, GEOMETRY_KIND, LOAD_KIND, table
from .component import places
from .wires import case_reader, choose, reader, size_of, writer

_CURVATURES, _NORMAL_FORCE = GEOMETRY_KIND.number("Curvatures"), LOAD_KIND.number("NormalForce")
_CONFORMAL = SURFACE.number("Conformal")
_DAMAGE_PARAMETERS = np.array([DamageParameters().record(contact.STEEL, 1.0, 1.0)], DAMAGE_PARAMETERS)


class _OfStrip(IntEnum):
    """Numbers of an element that are computed from its strip. They follow the rows of the solver's fields."""

    PATCH = len(Field)
    Y = auto()
    AREA = auto()


#: Field of the table → its row.
_FIELDS = {
    "field.patch": _OfStrip.PATCH,
    "field.x": Field.X,
    "field.y": _OfStrip.Y,
    "field.area": _OfStrip.AREA,
    "field.pressure": Field.P,
    "field.traction_x": Field.QX,
    "field.traction_y": Field.QY,
    "field.slip_x": Field.SX,
    "field.slip_y": Field.SY,
    "field.stick": Field.STICK,
}


@arranging
def _element(strips, fields, row, i, j):
    """Return the value of one element. `row` is a value of `_FIELDS`."""
    if row == _OfStrip.PATCH:
        return strips[Strip.PATCH, i] + 1.0
    if row == _OfStrip.Y:
        return strips[Strip.Y, i]
    if row == _OfStrip.AREA:
        return strips[Strip.DY, i] * fields[Field.DX, i, j]
    return fields[row, i, j]


_TABLE = table()  # its rows, of whatever size
_AT = places(_TABLE)


@group
class Arrays(NamedTuple):
    """All arrays in the working memory of an instance."""

    solver: SolverArrays
    samples: Annotated[Samples, "size.n_samples"]
    damage_parameters: Annotated[Parameters, "1"]
    damage_fields: Annotated[Cube, "len(DamageField), MAX_PATCHES * size.n_strips, size.n_elements"]
    damage: Annotated[Damages, "1"]
    count: Annotated[Numbers, "1"]  # number of strips
    derived: Annotated[Matrix, "ROWS, COLUMNS + 1"]  # what the host sees of it: `tables.wheel_rail_contact.DERIVED`
    shown: Annotated[Matrix, "MAX_PATCHES * size.n_strips, size.n_elements"]  # one field as the host sees it


_lay_arrays = block.layout(Arrays, "size, solver", {**globals(), "COLUMNS": COLUMNS})


@arranging
def _lay(work, size, kept, data):
    """Lay out all arrays in `work`. Return them, the indices of `shown` and `derived`, and the total size in numbers."""
    workspace, _, end = lay_out(work, kept.size, kept, size, data)
    solver, end = memory.lay_solver(work, end, size, workspace)
    a, total = _lay_arrays(work, end, size, solver)
    at_shown = total - a.shown.size
    return a, (at_shown, at_shown - a.derived.size), total


@arranging
def _first(samples, n):
    """Return the first n samples."""
    return Samples(samples.y[:n], samples.g[:n], samples.A[:n], samples.x_c[:n], samples.tilt[:n])


_read_case, _read_damage = case_reader(_TABLE), reader(_TABLE, "damage_parameters", DAMAGE_PARAMETERS)
_write, _write_damage = writer(_TABLE, "result", RESULT), writer(_TABLE, "damage", DAMAGE)


@arranging
def _values(values, given):
    """Return the values as an array, and the record `places` as an array of one record."""
    rows, _ = block.records(given.own, 0, 1, _AT)
    return carray(values, (rows[0].n_values,)), rows


@arranging
def _pose(v, rows, a):
    """Fill samples and case from the values. Return the number of samples."""
    at, sep, case = rows[0], a.samples, a.solver.case[0]
    _read_case(v, rows, a.solver.case)
    choose(int(v[at.method_normal]), int(v[at.method_tangential]), case)
    by_load = v[at.load_kind] == _NORMAL_FORCE
    case.load_kind = LoadKind.LOAD if by_load else LoadKind.APPROACH
    case.amount = max(v[at.load_normal_force], 0.0) if by_load else v[at.load_approach]
    curved = v[at.geometry_kind] == _CURVATURES
    conformal = not curved and v[at.geometry_surface] == _CONFORMAL
    n = HERTZIAN_POINTS if curved else at.points
    if not conformal:
        case.conformal, case.rolling = 0, 0.0
    if curved:
        A, B = max(v[at.geometry_A0], FLATTEST), max(v[at.geometry_B0], FLATTEST)
        fill_hertzian(A, B, sep.y[:n], sep.g[:n])
    for i in range(n):
        sep.x_c[i] = 0.0
        if curved:
            sep.A[i], sep.tilt[i] = max(v[at.geometry_A0], FLATTEST), 0.0
        else:
            sep.y[i] = v[at.geometry_y0] + v[at.geometry_dy] * i
            sep.g[i], sep.A[i] = v[at.geometry_g + i], max(v[at.geometry_A + i], FLATTEST)
            sep.tilt[i] = v[at.geometry_tilt + i] if conformal else 0.0
    return n


@arranging
def _report(v, rows, a):
    """Copy the results to the outputs."""
    at, result = rows[0], a.solver.result[0]
    _write(v, rows, a.solver.result, 0)
    _write_damage(v, rows, a.damage, 0)
    v[at.power_friction] = v[at.speed] * result.power
    v[at.slip_ratio] = result.slip_area / result.area if result.area > 0.0 else 0.0


@arranging
def _difference(v, at, reference):
    """Return a step so small that elements hardly ever change from stick to slip within it, where forces have kinks.

    For a creepage it is a millionth of the creepage at saturation. For the
    approach it is a millionth of the penetration. For the gap it is a millionth of the penetration or of the height above
    the least gap, whichever is greater: in a derivative along the whole geometry, samples outside the patch then leave
    those inside a step above round-off. For other variables it is a millionth of the value. Both sides of a difference
    are solved from a cold start, so that the tolerance of interacting strips, 1e-4, gives the same error on both sides.
    """
    if at.creepage_longitudinal <= reference <= at.creepage_spin:
        mu, N, G, area = v[at.friction_coefficient], v[at.force_n], v[at.material_shear_modulus], v[at.patch_area]
        creepage, spin = creepage_step(mu, N, G, area)
        return spin if reference == at.creepage_spin else creepage
    stiffness = v[at.stiffness_normal]
    penetration = 1.5 * v[at.force_n] / stiffness if stiffness > 0.0 else 1e-6  # N ~ its ^3/2
    if reference == at.load_approach:
        return 1e-6 * penetration
    if at.geometry_g <= reference < at.geometry_g + at.points:
        least = v[at.geometry_g]
        for i in range(1, at.points):
            least = min(least, v[at.geometry_g + i])
        return 1e-6 * max(penetration, v[reference] - least)
    if at.geometry_tilt <= reference <= at.geometry_rolling:
        return 1e-6 * max(abs(v[reference]), 1.0)
    return max(1e-6 * abs(v[reference]), 1e-12)


@arranging
def _solve(n, a):
    """Solve the case of `a` with its first `n` samples."""
    solver = a.solver
    forget_forged(solver.workspace.space.memory)
    a.count[0] = solve_case(_first(a.samples, n), solver.case, solver.workspace, solver.result)


def entries() -> dict[str, Callable[..., Any]]:
    """Return the functions of this kind (`kinds`), for separations of any number of samples."""
    fields = np.array([_FIELDS[field.twin_of or field.name] for field in _TABLE.fields])

    @arranging
    def size(v, at):
        n_strips, n_elements = int(v[at.resolution_n_strips]), int(v[at.resolution_n_elements])
        return size_of(int(v[at.method_normal]), n_strips, n_elements, max(at.points, HERTZIAN_POINTS))

    @arranging
    def arrange(v, at, work, given):
        kept, _ = block.vector(work, 0, memory.memory_size(size(v, at)))
        return _lay(work, size(v, at), kept, given.data)

    def model_memory(values, given):
        v, rows = _values(values, given)
        return memory.memory_size(size(v, rows[0]))

    def model_size(values, given):
        v, rows = _values(values, given)
        return arrange(v, rows[0], values, given)[2]

    def model_prepare(values, work, given):
        v, rows = _values(values, given)
        at = rows[0]
        a, _, _ = arrange(v, at, work, given)
        fill(a.solver.workspace, v[at.material_poisson_ratio], given.data)
        a.damage_parameters[0] = _DAMAGE_PARAMETERS[0]
        return 0

    def model_outputs(values, work, h, given):
        v, rows = _values(values, given)
        at = rows[0]
        a, _, _ = arrange(v, at, work, given)
        _solve(_pose(v, rows, a), a)
        _read_damage(v, rows, a.damage_parameters)
        workspace, case, result = a.solver.workspace, a.solver.case[0], a.solver.result[0]
        parameters, n = a.damage_parameters[0], int(a.count[0])
        parameters.speed = v[at.speed]
        damage_kernel(workspace.strips, n, workspace.fields, case, result, parameters, a.damage_fields, a.damage[0])
        _report(v, rows, a)
        return result.status

    def model_lazy(values, work, given):
        v, rows = _values(values, given)
        at = rows[0]
        a, _, _ = arrange(v, at, work, given)
        sep, n, solver = _first(a.samples, _pose(v, rows, a)), int(a.count[0]), a.solver
        solver.slopes[:, :] = 0.0
        if n > 0:
            roll_creepages(sep, n, solver.case, for_forces(solver), solver.result, solver.slopes)
            subtract_creepages(solver.case, solver.result, solver.slopes)
        for i in range(3):
            for j in range(3):
                v[at.creep_stiffness + 3 * i + j] = solver.slopes[i, j]
        return 0

    def model_jacobian(values, work, given):
        v, rows = _values(values, given)
        at = rows[0]
        a, (_, begin), _ = arrange(v, at, work, given)
        sep, n, solver = _first(a.samples, _pose(v, rows, a)), int(a.count[0]), a.solver
        case, slopes = solver.case[0], solver.slopes
        slopes[:, :] = 0.0
        if n > 0:
            n = derive_solved(sep, n, solver.case, for_forces(solver), solver.result, slopes)
        by_load = case.load_kind == LoadKind.LOAD
        for i in range(ROWS):
            scale = v[at.speed] if i == POWER else 1.0
            for j in range(AMOUNT):
                a.derived[i, j] = scale * slopes[i, j]
            amount = scale * slopes[i, AMOUNT] if n > 0 else math.nan  # contact may begin here
            a.derived[i, AMOUNT], a.derived[i, AMOUNT + 1] = (amount, 0.0) if by_load else (0.0, amount)
            # the jacobian scales a law of friction as a whole
            a.derived[i, MU + 1] = scale * slopes[i, MU] if case.law == FrictionLaw.COULOMB else math.nan
        return begin

    def model_difference(values, reference, given):
        v, rows = _values(values, given)
        return _difference(v, rows[0], reference)

    def model_field(values, work, k, given):
        v, places = _values(values, given)
        a, (begin, _), _ = arrange(v, places[0], work, given)
        for i in range(a.shown.shape[0]):
            for j in range(a.shown.shape[1]):
                a.shown[i, j] = (
                    _element(a.solver.workspace.strips, a.solver.workspace.fields, fields[k], i, j)
                    if i < a.count[0]
                    else 0.0
                )
        return begin

    called_by_c = (
        model_memory, model_size, model_prepare, model_outputs, model_lazy, model_jacobian, model_difference, model_field,
    )  # fmt: skip
    return {function.__name__: function for function in called_by_c}
