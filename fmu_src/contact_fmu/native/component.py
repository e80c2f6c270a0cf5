"""Description of one FMU for the builder and the C wrapper."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..resources import MOST_POINTS
from ..rows import identifier
from ..variables import Table

#: Function of a kind of models (`kinds`) → types of its result and of its arguments without `given`: a number of 64 bits, or a
#: pointer to float64.
SIGNATURES: dict[str, tuple[str, tuple[str, ...]]] = {
    "memory": ("i64", ("ptr",)),
    "size": ("i64", ("ptr",)),
    "prepare": ("i64", ("ptr", "ptr")),
    "outputs": ("i64", ("ptr", "ptr", "f64")),
    "lazy": ("i64", ("ptr", "ptr")),
    "jacobian": ("i64", ("ptr", "ptr")),
    "difference": ("f64", ("ptr", "i64")),
    "field": ("i64", ("ptr", "ptr", "i64")),
}
#: Sizes of a model at the beginning of its numbers, before the value references of its rows.
SIZES = ("n_values", "points", "n_bodies", "n_links", "n_elements", "n_axles", "n_table")


def places(table: Table) -> Any:
    """Return the numpy type of the record with which the numbers of a model begin: its sizes, and the reference of each row."""
    return np.dtype([(name, np.int64) for name in (*SIZES, *map(identifier, table.span))])


def numbers(table: Table, **sizes: int) -> NDArray[np.int64]:
    """Return the values of this record."""
    given = {"n_values": len(table.scalars), **sizes}
    return np.array([*(given.get(name, 0) for name in SIZES), *(s.start for s in table.span.values())], np.int64)


class Given(NamedTuple):
    """What every entry gets last.

    These are pointers to the `resources`, to the numbers `own`, and to the constant arrays, `c_tables.data`.
    """

    resources: Any
    own: Any
    data: Any


class Resource(NamedTuple):
    """A file in resources/ that an instance reads (`contact_fmu.resources`).

    It has the 8 bytes with which it begins, its number of rows, and the most points that a row may have.
    """

    name: str
    magic: bytes
    rows: int
    most: int = MOST_POINTS


@dataclass(frozen=True, kw_only=True)
class Component:
    """One FMU, as data for the library of all FMUs.

    Parameters
    ----------
    kind : str
        Which kernels compute it: a key of `kinds.KINDS`.
    table : Table
        Variable table.
    own : array of int64
        Numbers that the kernels get: the record `places`, then what they need beside it. Without them the kernels know all.
    resources : tuple of Resource
        The kernels get the content of all files in sequence. For each file: the number of points n, then n values of each row.
    lazy : tuple of str
        Rows that are computed only when a host reads them.
    derived, derived_by : tuple of str
        Outputs and inputs of the matrix of ``model_jacobian``.
    accumulated : tuple of str
        Rows that add up over time. They come after all other rows, and their numbers are the end of the warm start, not part
        of the values. The wrapper keeps them only after a call of ``model_outputs`` with h > 0, so in model exchange they stay
        zero.
    accumulates : str
        Parameter, an enumeration. With its first item nothing is added up: the memory of these rows is left out and the rows
        are zero.
    exchange : bool
        Whether the FMU can do model exchange.
    warnings, failures : mapping
        Number → text. The number may be a member of an enumeration of the kernels. A failure discards the step.
    """

    kind: str
    table: Table
    own: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, np.int64))
    resources: tuple[Resource, ...] = ()
    lazy: tuple[str, ...] = ()
    derived: tuple[str, ...] = ()
    derived_by: tuple[str, ...] = ()
    accumulated: tuple[str, ...] = ()
    accumulates: str = ""
    exchange: bool = True
    warnings: Mapping[int, str] = field(default_factory=dict)
    failures: Mapping[int, str] = field(default_factory=dict)

    @property
    def totals(self) -> dict[str, tuple[str | None, str | None]]:
        """Outputs that the wrapper integrates (`Variable.integral_of`)."""
        return {row.name: row.integral_of for row in self.table.rows if row.integral_of}
