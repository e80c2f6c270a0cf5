"""Description of one native FMU for the builder and the C wrapper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numba import types
from numpy.typing import NDArray

from fmu_src.native.memory import PREFIX, Doubles
from fmu_src.resources import MOST_POINTS
from fmu_src.variables import Table

#: Functions that C calls → types of the result and of the arguments. See `Component.entries`.
SIGNATURES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "model_memory": (types.int64, (Doubles,)),
    "model_size": (types.int64, (Doubles,)),
    "model_prepare": (types.int64, (Doubles, Doubles)),
    "model_start": (types.int64, (Doubles, Doubles)),
    "model_outputs": (types.int64, (Doubles, Doubles, types.float64)),
    "model_lazy": (types.int64, (Doubles, Doubles)),
    "model_difference": (types.float64, (Doubles, types.int64)),
    "model_field": (types.int64, (Doubles, Doubles, types.int64)),
}


class Given(NamedTuple):
    """What every entry gets last: pointers to the content of the `resources`, and to the arrays of `data`."""

    resources: Any
    data: Any


class Resource(NamedTuple):
    """A file in resources/ that an instance reads (`fmu_src.resources`).

    It has the 8 bytes with which it begins, its number of rows, and the most points that a row may have.
    """

    name: str
    magic: bytes
    rows: int
    most: int = MOST_POINTS


@dataclass(frozen=True, kw_only=True)
class Component:
    """One native FMU. Its module in this package has a function `component(**options)` that returns it.

    Parameters
    ----------
    table : Table
        Variable table. The continuous states are the rows that have a derivative among the other rows.
    entries : callable
        Returns Python functions by the names in `SIGNATURES`, which numba compiles. The first argument is the array of all
        values, indexed by value reference. Most functions also take the working memory, which begins with the warm start. The
        last argument is `Given`.

        * ``model_memory(values, given)`` returns the size of the warm start in numbers, ``model_size(values, given)`` that of
          all working memory. Both depend only on the parameters in `values`.
        * ``model_prepare(values, work, given)`` fills what depends only on the parameters.
        * ``model_start(values, work, given)`` computes the continuous states and the outputs of co-simulation at the start,
          from the parameters. A model without states does not need it.
        * ``model_outputs(values, work, h, given)`` advances by h [s] from the warm start, then computes the outputs. With
          h = 0 it computes them only from the inputs and states in `values`.
        * ``model_lazy(values, work, given)`` computes the rows `lazy`. A model without such rows does not need it.
        * ``model_difference(values, reference, given)`` returns a suitable step of one variable for difference quotients.
        * ``model_field(values, work, k, given)`` writes field number `k` of the last ``model_outputs`` into `work` and returns
          where it begins. A model without fields does not need it.

        The functions that return neither a size, a step nor a position return 0 or the number of a message (`warnings`,
        `failures`). At a cold start the warm start is all zeros.
    data : callable
        Returns constant arrays that the kernels read.
    resources : tuple of Resource
        The kernels get the content of all files in sequence. For each file: the number of points n, then n values of each row.
    lazy : tuple of str
        Rows that are computed only when a host reads them.
    totals : mapping
        Outputs that the wrapper integrates over time: name → one or two values whose product is the rate.
    accumulated : tuple of str
        Rows that add up over time. They come after all other rows, and their numbers are the end of the warm start, not part
        of the values. The wrapper keeps them only after a call of ``model_outputs`` with h > 0, so in model exchange they stay
        zero.
    accumulates : str
        Parameter, an enumeration. With its first item nothing is added up: the memory of these rows is left out and the rows
        are zero.
    prefix : str
        Beginning of the names of the entries in the objects. An FMU that is linked with the objects of another one, whose
        entries it calls (`fmu_src.native.vehicle`), has a prefix of its own.
    exchange : bool
        Whether the FMU can do model exchange.
    warnings, failures : mapping
        Number → text. The number may be a member of an enumeration of the kernels. A failure discards the step.
    """

    table: Table
    entries: Callable[[], Mapping[str, Callable[..., Any]]]
    data: Callable[[], tuple[NDArray[np.float64], ...]]
    resources: tuple[Resource, ...] = ()
    lazy: tuple[str, ...] = ()
    totals: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    accumulated: tuple[str, ...] = ()
    accumulates: str = ""
    prefix: str = PREFIX
    exchange: bool = True
    warnings: Mapping[int, str] = field(default_factory=dict)
    failures: Mapping[int, str] = field(default_factory=dict)
