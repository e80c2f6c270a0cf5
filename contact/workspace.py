"""Allocation of the arrays that kernels read and write: one block of memory for each owner (`contact.kernels.memory`)."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact import force_table, kalker
from contact.kernels import families, memory, quadrature
from contact.kernels.damage.deposit import arc_length
from contact.kernels.layout import N_BIN_ROWS
from contact.kernels.memory import Bench, Ledger, Rule, Search, Size, Tables, Workspace
from contact.kernels.normal import influence
from contact.kernels.normal.descent import fill_descent
from contact.registry import Method

Array = NDArray[np.float64]


def _zeros(n: int) -> Array:
    """Return n zeros that begin at a cache line."""
    numbers = np.zeros(n + 7)
    first = -(numbers.ctypes.data // 8) % 8
    return numbers[first : first + n]


class _Everywhere:
    """A block that is as large as whoever lays arrays into it likes; only the end that comes out of it has a meaning."""

    shape = (0, 0, 0)
    size = 0

    def __getitem__(self, where: object) -> _Everywhere:
        return self

    def reshape(self, *shape: int) -> _Everywhere:
        return self

    def view(self, dtype: np.dtype) -> _Everywhere:
        return self


def _laid(lay: Callable[..., tuple[Any, ...]], *arguments: Any) -> Any:
    """Call a function of `contact.kernels.memory` with a block of the size that it needs; return what it lays."""
    size = lay(_Everywhere(), 0, *arguments)[-1]
    *arrays, _ = lay(_zeros(size), 0, *arguments)
    return arrays[0] if len(arrays) == 1 else tuple(arrays)


def _read_only(*arrays: Array) -> None:
    for array in arrays:
        array.setflags(write=False)


@functools.lru_cache(maxsize=64)
def rule(n_strips: int, n_elements: int, interacting: bool) -> Rule:
    """Return the (cached) rule of one resolution; its table of columns only for methods with `interacting` strips."""
    made = _laid(memory.lay_rule, Size(n_strips, n_elements, 0, int(interacting), 0))
    quadrature.fill_fejer(*made.across)
    quadrature.fill_elements(made.elements)
    quadrature.fill_panel(made.cosines, made.cosine_logs)
    if made.columns.size > 1:
        fill_descent(*strip_tables(), made.columns, made.descent)  # before the columns, which serve as scratch
        influence.fill_columns(made.cosine_logs, strip_tables()[0], made.columns)
    _read_only(*made.across, *made[1:])
    return made


@functools.cache
def strip_tables() -> tuple[Array, Array]:
    """Return U on the centre line, shape (401, 2), and over (X, ln t), shape (203, 534); made once a process (0.2 s)."""
    centre, plane = np.empty(influence.CENTRE), np.empty(influence.PLANE)
    influence.fill(centre, plane)
    _read_only(centre, plane)
    return centre, plane


@functools.lru_cache(maxsize=64)
def tables(poisson_ratio: float, interacting: bool, tabulated: bool) -> Tables:
    """Return the (cached) tables; influence of strips and the half space's forces only for methods that need them."""
    no_influence, no_forces = (np.zeros((1, 2)), np.zeros((1, 1))), np.zeros((1, 1, 1, 1, 1))
    _read_only(*no_influence, no_forces)  # as the tables are: one signature for numba
    return Tables(
        kalker.table(poisson_ratio),
        *(strip_tables() if interacting else no_influence),
        force_table.load() if tabulated else no_forces,
    )


def markers(normal: Method, tangential: Method) -> families.Families:
    """Return the markers by which kernels for these methods are chosen."""
    return families.Families(families.NORMAL[normal.family], families.TANGENTIAL[tangential.family])  # type: ignore[index]


def allocate(
    normal: Method, tangential: Method, poisson_ratio: float, size: tuple[int, int, int], *, fields: bool = True
) -> Workspace:
    """Allocate a workspace.

    Parameters
    ----------
    size : (n_strips, n_elements, n_samples)
        Resolution, and the most samples of a separation.
    fields : bool
        Whether fields are wanted; else forces only.
    """
    full = Size(*size, int(normal.interacting), int(fields))
    strips, field_array = _laid(memory.lay_strips_and_fields, full)
    space = _laid(memory.lay_space, full, np.zeros(memory.memory_size(full)))
    return Workspace(
        markers(normal, tangential),
        rule(full.n_strips, full.n_elements, normal.interacting),
        tables(poisson_ratio, normal.interacting, tangential.tabulated),
        space,
        strips,
        field_array,
    )


def search(wheel: Array, rail: Array, grid: Array, n_samples: int) -> Search:
    """Allocate what a search needs with these curves, for separations at the positions `grid` or, if empty, anywhere."""
    made: Search = _laid(memory.lay_search, wheel.shape[1], rail.shape[1], grid.size, n_samples)
    made.wheel[:], made.rail[:], made.grid[:] = wheel, rail, grid
    quadrature.fill_fejer(*made.across)
    return made


def ledger(wheel: Array, rail: Array, n_strips: int, n_bins: int, first: float, width: float) -> Ledger:
    """Allocate a ledger with nothing in it, for patches of at most `n_strips` strips a part.

    Parameters
    ----------
    wheel, rail : ndarray
        Rows y, z [m] of the profiles with which the pair was made.
    n_bins : int
    first, width : float
        Arc length at which the first bin begins, and width of a bin [m].
    """
    made: Ledger = _laid(memory.lay_ledger, wheel, rail, np.zeros((2, N_BIN_ROWS, n_bins)), n_strips)
    arc_length(made.wheel, made.wheel_arc)
    arc_length(made.rail, made.rail_arc)
    made.settings["start"], made.settings["width"] = first / width, width
    return made


def closed_ledger() -> Ledger:
    """Allocate a ledger without bins, in which nothing is entered."""
    nothing = np.zeros((2, 0))
    return _laid(memory.lay_ledger, nothing, nothing, np.zeros((2, N_BIN_ROWS, 0)), 0)


def bench(size: tuple[int, int, int], of_search: Search, own: Workspace, of_ledger: Ledger) -> Bench:
    """Allocate the arrays of a pair around its search, its workspace and its ledger."""
    full = Size(*size, 0, 1)
    kept = np.zeros(1 + memory.MAX_PATCHES * own.space.memory.size)
    return _laid(memory.lay_bench, full, kept, of_search, own, of_ledger)
