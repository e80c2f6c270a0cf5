"""One model in memory of its own, computed by the compiled functions of the native FMU.

They take the values by value reference (`native.kinds`). So Python copies no variable and knows no record, and both packagings
give the same bits. This module does in Python what `native/c/evaluate.c` does around them.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.instance.workspace import zeros
from .. import resources
from ..native import kinds, systems
from ..native.component import Component, Resource
from ..variables import Causality

_TYPES: dict[str, Any] = {"i64": ctypes.c_int64, "f64": ctypes.c_double, "ptr": ctypes.c_void_p}


class Instance:
    """Working memory of one model, for the parameters of the last call.

    `solve` and `accept` are those of wheelrail.h: what was solved changes nothing until it is accepted.

    Parameters
    ----------
    component : Component
    folder : Path
        Where its files of resources/ are.

    Raises
    ------
    ContactError
        If one of these cannot be read.
    """

    def __init__(self, component: Component, folder: Path) -> None:
        self.component = component
        scalars = component.table.scalars
        self._n_parameters = sum(scalar.row.causality is Causality.PARAMETER for scalar in scalars)
        added = [r for name in component.accumulated for r in component.table.references(name)]
        self._added = slice(added[0], added[-1] + 1) if added else slice(0)
        self._adds = component.table.span[component.accumulates].start if added else 0
        self._functions = {name: _function(component.kind, name) for name in kinds.SIGNATURES}
        content = [part for one in component.resources for part in _numbers(folder, one)]
        self._given = np.concatenate([*content, np.zeros(1)]), np.append(component.own, 0)
        self._work, self._prepared, self._size = zeros(0), np.zeros(0), 0
        #: Warm start of the next step, and that of the last one.
        self.memory = np.zeros((2, 0))

    def solve(self, values: Array, h: float) -> int:
        """Advance `values` by `h` [s] and compute their outputs, with h = 0 those at the start. Return a message's number."""
        if number := self._prepare(values):
            return number
        self._work[: self.memory.shape[1]] = self.memory[0] if h > 0.0 else 0.0
        return self._call("outputs", values, self._work, h)

    def accept(self, values: Array, h: float) -> None:
        """Let the next step start from the solution of the last call of `solve`, and add up what accumulates in `values`."""
        if h > 0.0:
            self.memory[1] = self.memory[0]
            self.memory[0] = self._work[: self.memory.shape[1]]
        else:
            self.memory[1] = 0.0
        if n := self._added.stop - (self._added.start or 0):  # the end of the warm start
            values[self._added] = self.memory[0, -n:] if values[self._adds] > 1.0 else 0.0

    def solve_lazy(self, values: Array) -> None:
        """Compute the lazy rows that belong to `values`, which are those of the last step."""
        if self._prepare(values):
            return
        self._work[: self.memory.shape[1]] = self.memory[1]
        self._call("outputs", values, self._work, 0.0)
        self._call("lazy", values, self._work)

    def _prepare(self, values: Array) -> int:
        """Lay out and fill working memory for the parameters. Return 0 or the number of a failure.

        A warm start of another size is discarded.
        """
        parameters = values[: self._n_parameters]
        if self.memory.shape[1] == self._size and np.array_equal(parameters, self._prepared):
            return 0
        self._prepared, self._size = np.zeros(0), self._call("memory", values)
        if self._size != self.memory.shape[1]:
            self.memory = np.zeros((2, self._size))
        self._work = zeros(self._call("size", values))
        if number := self._call("prepare", values, self._work):
            return number
        self._prepared = parameters.copy()
        return 0

    def _call(self, name: str, *arguments: Array | float) -> int:
        given = (*arguments, *self._given)
        return int(self._functions[name](*(one.ctypes.data if isinstance(one, np.ndarray) else one for one in given)))


def _function(kind: str, name: str) -> Callable[..., int]:
    """Return a function of a kind of model as Python calls it, which releases the global lock."""
    result, arguments = kinds.SIGNATURES[name]
    types = [_TYPES[one] for one in (*arguments, "ptr", "ptr")]
    return ctypes.CFUNCTYPE(_TYPES[result], *types)(systems.of_this_machine().address(f"{kind}_{name}"))


def _numbers(folder: Path, resource: Resource) -> Iterator[Array]:
    """Yield the number of points of a file, and its rows, as the kernels read them."""
    path = folder / resource.name
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ContactError(f"resource {path.name} cannot be read: {error.strerror}") from None
    fault = f"resource {path.name} is not valid"
    if not content.startswith(resource.magic):
        raise ContactError(f"{fault}: it is of another kind")
    rows = resources.unpack(content, resource.rows, fault, resource.most)
    yield np.array([rows.shape[1]], np.float64)
    yield rows.ravel()
