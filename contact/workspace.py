"""The arrays that kernels read and write, allocated once by their owner: a call, a batch thread or an FMU instance."""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact import kalker, quadrature
from contact._layout import MAX_PATCHES, N_FIELD_ROWS, N_RES, N_STRIP_ROWS
from contact.normal import influence
from contact.normal.analyn import N_WORK_ROWS
from contact.normal.strip_halfspace import MEM_LN_A
from contact.normal.strip_system import N_VECTOR_ROWS
from contact.registry import Method
from contact.tangential import table
from contact.tangential.lanes import LANES, N_LANE_ROWS, TRACE_WIDTH

Array = NDArray[np.float64]


class Rule(NamedTuple):
    """Where strips and elements lie in a patch (`quadrature`): constant for a resolution, read-only."""

    nodes: Array
    weights: Array
    elements: Array
    cosines: Array
    cosine_logs: Array
    columns: Array


class Tables(NamedTuple):
    """Interpolated functions, read-only: Kalker's coefficients of one Poisson ratio, influence of strips, half-space forces."""

    kalker: Array
    centre: Array
    plane: Array
    creep: Array


class Space(NamedTuple):
    """Scratch arrays: of the normal methods, `memory`, from which the next call may start, and of the tangential ones."""

    grid: Array
    vectors: Array
    logs: Array
    matrix: Array
    lu: Array
    memory: Array
    lanes: Array
    trace: Array


class Workspace(NamedTuple):
    """Everything that `pipeline.solve_case` needs besides the problem."""

    rule: Rule
    tables: Tables
    space: Space
    strips: Array
    fields: Array
    result: Array


def columns_shape(n_strips: int, interacting: bool) -> tuple[int, int, int]:
    """Shape of `Rule.columns`; (1, 1, 1) where it is not used."""
    if interacting and n_strips <= influence.MOST_TABULATED:
        return influence.N_COLUMNS, n_strips, n_strips
    return 1, 1, 1


@functools.lru_cache(maxsize=64)
def rule(n_strips: int, n_elements: int, interacting: bool) -> Rule:
    """Return the (cached) rule of one resolution; `columns` only for methods with `interacting` strips."""
    cosines, logs = quadrature.panel(n_strips)
    columns = np.empty(columns_shape(n_strips, interacting))
    if columns.size > 1:
        influence.fill_columns(logs, influence.tables()[0], columns)
    return Rule(*quadrature.fejer(n_strips), quadrature.elements(n_elements), cosines, logs, columns)


@functools.lru_cache(maxsize=64)
def tables(poisson_ratio: float, interacting: bool, tabulated: bool) -> Tables:
    """Return the (cached) tables; influence of strips and the half space's forces only for methods that need them."""
    empty, no_forces = (np.zeros((1, 2)), np.zeros((1, 1))), np.zeros((1, 1, 1, 1, 1))
    no_forces.setflags(write=False)  # as the table is: one signature for numba
    return Tables(
        kalker.table(poisson_ratio),
        *(influence.tables() if interacting else empty),
        table.load() if tabulated else no_forces,
    )


def _at_line(n: int) -> Array:
    """`n` numbers from the beginning of a cache line on; vectors that lie across two cost a sixth of the march's time."""
    memory = np.empty(n + 7)
    first = -(memory.ctypes.data // 8) % 8
    return memory[first : first + n]


def allocate(
    normal: Method,
    tangential: Method,
    poisson_ratio: float,
    n_strips: int,
    n_elements: int,
    n_samples: int,
    *,
    fields: bool = True,
) -> Workspace:
    """Allocate a workspace for separations of at most `n_samples` points; without `fields`, for forces alone."""
    capacity = MAX_PATCHES * n_strips
    size = capacity if normal.interacting else 1
    return Workspace(
        rule(n_strips, n_elements, normal.interacting),
        tables(poisson_ratio, normal.interacting, tangential.tabulated),
        Space(
            grid=np.empty((N_WORK_ROWS, n_samples)),
            vectors=np.empty((N_VECTOR_ROWS, size)),
            logs=np.empty((size, size + MAX_PATCHES)),
            matrix=np.empty((size, size)),
            lu=np.empty((size, size)),
            memory=np.zeros(MEM_LN_A + size),
            lanes=_at_line(N_LANE_ROWS * LANES),
            trace=_at_line(n_elements * TRACE_WIDTH).reshape(n_elements, TRACE_WIDTH),
        ),
        np.empty((N_STRIP_ROWS, capacity)),
        np.empty((N_FIELD_ROWS, capacity if fields else 1, n_elements)),
        np.empty(N_RES),
    )
