"""The class that the script in each FMU for hosts with Python names."""

from __future__ import annotations

from typing import Any

from ..native import components
from .slave import TableSlave


class ModelSlave(TableSlave):
    """Slave of the FMU that a function of `native.components` returns. `options` are its arguments."""

    def __init__(self, declared: str, options: dict[str, Any], guid: str, **kwargs: Any) -> None:
        super().__init__(getattr(components, declared)(**options), guid, **kwargs)
