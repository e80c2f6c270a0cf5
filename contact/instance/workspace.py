"""Allocate the arrays that kernels read and write, one block of memory for each owner (`contact.kernels.memory`)."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.kernels import memory, quadrature
from contact.kernels.arrays import (
    DerivativeArrays,
    Ledger,
    PairArrays,
    Rule,
    Search,
    Sheet,
    Size,
    SolverArrays,
    SurfaceSearch,
    Tables,
    Workspace,
)
from contact.kernels.damage.deposit import arc_length
from contact.kernels.normal import influence
from contact.kernels.normal.between_panels import fill_probes
from contact.kernels.normal.descent import fill_descent
from contact.kernels.normal.factors import fill_factors
from contact.kernels.rows import Bin
from contact.registry import Method
from contact.theory import force_table, kalker, strips


def zeros(n: int) -> Array:
    """Return n zeros, aligned to a cache line."""
    numbers = np.zeros(n + 7)
    first = -(numbers.ctypes.data // 8) % 8
    return numbers[first : first + n]


class _UnboundedBlock:
    """Stand-in for a block of memory of unlimited size, used to find the size that a layout needs."""

    shape = (0, 0, 0)

    def __init__(self, size: int = 0) -> None:
        self.size = size

    def __getitem__(self, where: slice) -> _UnboundedBlock:
        return _UnboundedBlock(where.stop - where.start)

    def reshape(self, *shape: int) -> _UnboundedBlock:
        return self

    def view(self, dtype: np.dtype) -> _UnboundedBlock:
        return self


def laid(lay: Callable[..., tuple[Any, ...]], *arguments: Any) -> Any:
    """Return the arrays that `lay`, as those of `contact.kernels.memory`, places in a new block of the needed size."""
    size = lay(_UnboundedBlock(), 0, *arguments)[-1]
    *arrays, _ = lay(zeros(size), 0, *arguments)
    return arrays[0] if len(arrays) == 1 else tuple(arrays)


def _read_only(*arrays: Array) -> None:
    for array in arrays:
        array.setflags(write=False)


@functools.lru_cache(maxsize=64)
def rule(n_strips: int, n_elements: int, interacting: bool) -> Rule:
    """Return the cached rule of one resolution. Only methods with `interacting` strips get its table of columns."""
    made = laid(memory.lay_rule, Size(n_strips, n_elements, 0, int(interacting), 0))
    quadrature.fill_fejer(*made.across)
    quadrature.fill_elements(made.elements)
    quadrature.fill_panel(made.cosines, made.cosine_logs)
    fill_probes(made.cosines, made.probes, made.spread)
    if made.columns.size > 1:
        fill_descent(
            *strips.tables(), made.columns, made.descent
        )  # first, because it uses the columns as scratch memory
        fill_factors(*strips.tables(), made.columns, made.factors)  # as does this
        influence.fill_columns(made.cosine_logs, strips.tables()[0], made.columns)
    _read_only(*made.across, *made[1:])
    return made


@functools.lru_cache(maxsize=64)
def tables(poisson_ratio: float, tabulated: bool) -> Tables:
    """Return the cached tables. Only methods that need them get the half space's forces."""
    no_forces = np.zeros((1, 1, 1, 1, 1))
    return Tables(kalker.table(poisson_ratio), *strips.tables(), force_table.load() if tabulated else no_forces)


def allocate(
    normal: Method, tangential: Method, poisson_ratio: float, size: tuple[int, int, int], *, fields: bool = True
) -> Workspace:
    """Return a new workspace.

    Parameters
    ----------
    normal, tangential : Method
    poisson_ratio : float
        Combined Poisson ratio [-].
    size : (n_strips, n_elements, n_samples)
        Resolution, and the largest number of separation samples.
    fields : bool
        Allocate the fields of all strips. If False, the workspace is for forces only.
    """
    full = Size(*size, int(normal.interacting), int(fields))
    strips, field_array = laid(memory.lay_strips_and_fields, full)
    space = laid(memory.lay_space, full, np.zeros(memory.memory_size(full)))
    return Workspace(
        rule(full.n_strips, full.n_elements, normal.interacting),
        tables(poisson_ratio, tangential.tabulated),
        space,
        strips,
        field_array,
    )


def solver_arrays(normal: Method, tangential: Method, poisson_ratio: float, size: tuple[int, int, int]) -> SolverArrays:
    """Return the arrays of a contact that is solved again and again. The arguments are those of `allocate`."""
    full = Size(*size, int(normal.interacting), 1)
    return laid(memory.lay_solver, full, allocate(normal, tangential, poisson_ratio, size))


def search(wheel: Array, rail: Array, grid: Array, n_samples: int) -> Search:
    """Return the arrays of a contact search with these curves.

    Separations are sampled at the positions `grid` [m] or, if it is empty, at positions that the search chooses.
    """
    made: Search = laid(memory.lay_search, wheel.shape[1], rail.shape[1], grid.size, n_samples)
    made.wheel[:], made.rail[:], made.grid[:] = wheel, rail, grid
    quadrature.fill_fejer(*made.across)
    return made


def sheet(u: Array, nodes: Array, runs: Array, period: tuple[float, float], deviation: Array) -> Sheet:
    """Return the arrays of a surface. The arguments are the members of `Sheet`."""
    made: Sheet = laid(memory.lay_sheet, u.size, nodes.shape[2], deviation.shape[1])
    for array, given in zip(made, (u, nodes, runs, period, deviation), strict=True):
        array[:] = given
    return made


def surface_search(wheel: Sheet, rail: Sheet, n_samples: int) -> SurfaceSearch:
    """Return the arrays of a contact search over two surfaces. Separations have `n_samples` samples."""
    made: SurfaceSearch = laid(memory.lay_surface_search, wheel, rail, n_samples)
    quadrature.fill_fejer(*made.across)
    return made


def ledger(wheel: Array, rail: Array, n_strips: int, n_bins: int, first: float, width: float) -> Ledger:
    """Return an empty ledger for patches of at most `n_strips` strips each.

    Parameters
    ----------
    wheel, rail : ndarray
        Rows y, z [m] of the pair's profiles.
    n_strips, n_bins : int
    first, width : float
        Arc length of the start of the first bin, and width of a bin [m].
    """
    made: Ledger = laid(memory.lay_ledger, wheel, rail, np.zeros((2, len(Bin), n_bins)), n_strips)
    arc_length(made.wheel, made.wheel_arc)
    arc_length(made.rail, made.rail_arc)
    made.settings["start"], made.settings["width"] = first / width, width
    return made


def closed_ledger() -> Ledger:
    """Return a ledger without bins, which records nothing."""
    nothing = np.zeros((2, 0))
    return laid(memory.lay_ledger, nothing, nothing, np.zeros((2, len(Bin), 0)), 0)


def pair_arrays(
    size: tuple[int, int, int], of_search: Search | SurfaceSearch, of_patch: Workspace, of_ledger: Ledger
) -> PairArrays:
    """Return the arrays of a wheel-rail pair, which include its search, its workspace and its ledger."""
    full = Size(*size, 0, 1)
    kept = np.zeros(memory.pair_memory_size(of_patch.space.memory.size))
    return laid(memory.lay_pair, full, kept, of_search, of_patch, of_ledger)


def derivative_arrays(size: tuple[int, int, int], of_pair: PairArrays) -> DerivativeArrays:
    """Return the arrays that the derivatives of a wheel-rail pair need besides its own."""
    full, search = Size(*size, int(of_pair.workspace.space.tangent.size > 1), 1), of_pair.search
    if isinstance(search, SurfaceSearch):
        near = surface_search(search.wheel, search.rail, search.separations.shape[2])
    else:
        near = laid(memory.lay_near_search, full.n_samples, search)
    return laid(memory.lay_derivatives, full, near, of_pair)
