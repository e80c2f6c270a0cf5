"""The solver's own arrays over raw memory: what `contact.workspace.allocate` is in Python; numba compiles it."""

from __future__ import annotations

import numpy as np
from numba import carray

import contact
from contact import kalker, quadrature
from contact.kernels.layout import MAX_PATCHES, N_FIELD_ROWS, N_RES, N_STRIP_ROWS
from contact.material import heating
from contact.kernels.normal import influence
from contact.kernels.normal.analyn import N_WORK_ROWS
from contact.kernels.normal.strip_halfspace import MEM_LN_A
from contact.kernels.normal.strip_system import N_VECTOR_ROWS
from contact.kernels.tangential import table
from contact.kernels.tangential.lanes import LANES, N_LANE_ROWS, TRACE_WIDTH
from contact.workspace import Rule, Space, Tables, Workspace, columns_shape
from fmu_src.native.memory import compiled, cube, matrix, next_line, vector

_METHODS = contact.methods().batched
#: By the number of an item of the enumerations `method.normal` and `method.tangential`, less 1.
NORMAL_IDS = np.array([float(method.id) for method in _METHODS.normal.values()])
TANGENTIAL_IDS = np.array([float(method.id) for method in _METHODS.tangential.values()])
INTERACTING = np.array([method.interacting for method in _METHODS.normal.values()])

_columns_shape, _heating = compiled(columns_shape), compiled(heating)


def data() -> tuple[np.ndarray, ...]:
    """Constants for `lay_out` and `fill`: Kalker's coefficients, influence of strips on the centre line and off it, forces."""
    return kalker.published(), *influence.tables(), table.load()


@compiled
def memory_size(normal, n_strips):
    """How many numbers one patch is started from, by the item of `method.normal`."""
    return MEM_LN_A + (MAX_PATCHES * n_strips if INTERACTING[normal - 1] else 1)


@compiled
def lay_out(work, end, memory, n_strips, n_elements, samples, centre, plane, creep):
    """Lay a workspace into `work` from `end` on; return it and where it ends. `memory` has the size of `memory_size`."""
    capacity = MAX_PATCHES * n_strips
    size = memory.size - MEM_LN_A
    nodes, end = vector(work, end, n_strips)
    weights, end = vector(work, end, n_strips)
    elements, end = matrix(work, end, quadrature.N_EL, n_elements)
    cosines, end = vector(work, end, n_strips + 1)
    cosine_logs, end = matrix(work, end, n_strips, n_strips + 1)
    tabulated, own, _ = _columns_shape(n_strips, size > 1)
    columns, end = cube(work, end, tabulated, own, own)
    coefficients, end = matrix(work, end, kalker.N_TABLE, 8)
    grid, end = matrix(work, end, N_WORK_ROWS, samples)
    vectors, end = matrix(work, end, N_VECTOR_ROWS, size)
    logs, end = matrix(work, end, size, size + MAX_PATCHES)
    influences, end = matrix(work, end, size, size)
    lu, end = matrix(work, end, size, size)
    lanes, end = vector(work, next_line(end), N_LANE_ROWS * LANES)
    trace, end = matrix(work, end, n_elements, TRACE_WIDTH)
    strips, end = matrix(work, end, N_STRIP_ROWS, capacity)
    fields, end = cube(work, end, N_FIELD_ROWS, capacity, n_elements)
    result, end = vector(work, end, N_RES)
    rule = Rule(nodes, weights, elements, cosines, cosine_logs, columns)
    tables = Tables(
        coefficients, carray(centre, influence.CENTRE), carray(plane, influence.PLANE), carray(creep, table.SHAPE)
    )
    space = Space(grid, vectors, logs, influences, lu, memory, lanes, trace)
    return Workspace(rule, tables, space, strips, fields, result), end


@compiled
def fill_friction(v, coefficient, law, speed, case):
    """Friction and speed of a case; `law` is the place of friction.law, behind which the table has the law's parameters."""
    case.mu, case.law = v[coefficient], v[law] - 1.0
    case.kinetic, case.half_speed = v[law + 1], v[law + 2]
    case.slope, case.slope_far, case.slope_rate = v[law + 3], v[law + 4], v[law + 5]
    case.velocity = v[law + 6] - 1.0
    case.gauge_factor, case.border, case.border_width = v[law + 7], v[law + 8], v[law + 9]
    case.k_A, case.k_S = v[law + 10], v[law + 11]
    case.drop, case.warm, case.warm_range = 1.0 - v[law + 12], v[law + 13] - v[law + 15], v[law + 14]
    case.heating = _heating(v[law + 16], v[law + 17], v[law + 18], v[law + 19])
    case.speed = speed


@compiled
def fill(own, poisson_ratio, published):
    """Fill what depends on resolution and material alone."""
    rule, tables = own.rule, own.tables
    quadrature.fill_fejer(rule.nodes, rule.weights)
    quadrature.fill_elements(rule.elements)
    quadrature.fill_panel(rule.cosines, rule.cosine_logs)
    if rule.columns.size > 1:
        influence.fill_columns(rule.cosine_logs, tables.centre, rule.columns)
    kalker.fill_table(carray(published, (kalker.N_TABLE, 4, 3)), poisson_ratio, tables.kalker)
