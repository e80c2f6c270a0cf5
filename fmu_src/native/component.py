"""What the builder and the C wrapper need to know of one native FMU."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numba import types
from numpy.typing import NDArray

from fmu_src.native.memory import Doubles
from fmu_src.variables import Table

#: What C calls, by name: types of the result and of the arguments. See `Component.entries`.
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


@dataclass(frozen=True, kw_only=True)
class Component:
    """One native FMU. The module of each in this package has a function `component(**options)` that returns it.

    Parameters
    ----------
    table : Table
        Its continuous states are the rows that others are the derivatives of.
    entries : callable
        Returns Python functions by the names in `SIGNATURES`, for numba to compile. Each is given the array of all values
        by value reference, most a second one of working memory, and after these that of the `resources`, if there are
        any, and the arrays of `data`:

        * ``model_memory(values)`` and ``model_size(values)`` count the numbers of the warm start, with which working memory
          begins, and of all working memory, for the parameters in `values`;
        * ``model_prepare(values, work)`` fills what depends on parameters alone;
        * ``model_start(values, work)`` computes the continuous states, and the outputs of co-simulation, at the start, of
          parameters alone; it is of no use to a model without states;
        * ``model_outputs(values, work, h)`` advances by h [s] from the warm start, then computes the outputs; with h = 0 it
          computes them from inputs and states in `values` alone;
        * ``model_lazy(values, work)`` computes the rows `lazy`;
        * ``model_difference(values, reference)`` is a fitting change of one variable for difference quotients;
        * ``model_field(values, work, k)`` lays out the field with the number `k`, of what ``model_outputs`` has just computed,
          and returns where in `work` it begins; it is of no use to a model without fields.

        Except for counts and the last two they return 0, or the number of what they have to say (`warnings`, `failures`). A
        model that begins anew finds zeros as its warm start.
    data : callable
        Returns constant arrays that the kernels read.
    resources : tuple of (str, bytes)
        Files in resources/ that an instance reads, and the 8 bytes that each begins with (`fmu_src.profiles`). Kernels find
        the points of one behind the other: their number n, then n numbers each of y, z and the angle.
    lazy : tuple of str
        Rows that are computed when somebody reads them.
    totals : mapping
        Outputs that the wrapper adds up over time: name → one or two values whose product is the rate.
    accumulated : tuple of str
        Rows behind all others that add up, with numbers that are not among the values but end the warm start; what
        ``model_outputs`` makes of them is kept with h > 0 alone, so in model exchange they stay zero.
    accumulates : str
        Enumeration, a parameter, at whose first item there are none of these numbers: the rows are zero.
    warnings, failures : mapping
        Number → text; a number may be a member of an enumeration of `contact.kernels.layout`. A failure discards the step.
    """

    table: Table
    entries: Callable[[], Mapping[str, Callable[..., Any]]]
    data: Callable[[], tuple[NDArray[np.float64], ...]]
    resources: tuple[tuple[str, bytes], ...] = ()
    lazy: tuple[str, ...] = ()
    totals: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    accumulated: tuple[str, ...] = ()
    accumulates: str = ""
    warnings: Mapping[int, str] = field(default_factory=dict)
    failures: Mapping[int, str] = field(default_factory=dict)
