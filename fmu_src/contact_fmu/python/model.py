"""The slave of every FMU for hosts with Python: a `TableSlave` whose values an `Instance` computes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from contact.arrays import Array
from ..native import components
from .instance import Instance
from .slave import TableSlave


class ModelSlave(TableSlave):
    """Slave of the model that a function of `native.components` returns. `options` are its arguments."""

    def __init__(self, declared: str, options: dict[str, Any], guid: str, **kwargs: Any) -> None:
        component = getattr(components, declared)(**options)
        self.lazy, self.warnings, self.failures = component.lazy, component.warnings, component.failures
        super().__init__(component.table, guid, **kwargs)
        self._instance = Instance(component, Path(self.resources))

    def solve(self, values: Array, h: float) -> int:
        """Advance the model by `h` [s], with inputs that are constant over the step. The first step is a cold start."""
        return self._instance.solve(values, h)

    def accept(self, values: Array, h: float) -> None:
        """Let the next step start from the last solution."""
        self._instance.accept(values, h)

    def solve_lazy(self, values: Array) -> None:
        """Compute the lazy rows from the solution of the last step."""
        self._instance.solve_lazy(values)

    def memory(self) -> str | None:
        """Return the warm starts, as text."""
        return self._instance.memory.tobytes().hex()

    def recall(self, memory: str | None) -> None:
        """Restore them."""
        numbers = np.frombuffer(bytes.fromhex(memory or ""))
        self._instance.memory = numbers.reshape(2, -1).copy()
