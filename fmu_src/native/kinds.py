"""The kinds of models whose kernels make up the library of all native FMUs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numba import types
from numpy.typing import NDArray

from fmu_src.native.memory import Doubles

#: Functions that C calls → types of the result and of the arguments. See `Kernels`.
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
class Kernels:
    """Kernels of one kind of model. Its module in this package has a function `kernels()` that returns them.

    Parameters
    ----------
    kind : str
        With this the names of the entries in the objects begin, instead of ``model``.
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
    data : callable
        Returns constant arrays that the kernels read.
    """

    kind: str
    entries: Callable[[], Mapping[str, Callable[..., Any]]]
    data: Callable[[], tuple[NDArray[np.float64], ...]]


def kernels_of(module: str) -> Kernels:
    """Return the kernels of a module of this package."""
    return import_module(f"fmu_src.native.{module}").kernels()
