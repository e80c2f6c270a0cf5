"""The FMUs that this project makes.

What belongs to one of them is in modules of the same name: its table in `tables`, its slave in `python`, its component in
`native`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from fmu_src.variables import Table


@dataclass(frozen=True)
class Model:
    """An FMU: the name of its modules, and the options that its table, slave and component are made with."""

    name: str
    options: Mapping[str, int]

    @property
    def table(self) -> Table:
        """Its variables."""
        return self.module("tables").table(**self.options)

    def module(self, part: str) -> Any:
        """Its module in "tables", "python" or "native"."""
        return import_module(f"fmu_src.{part}.{self.name}")


def models(points: int) -> tuple[Model, ...]:
    """All FMUs, the contact for separations of `points` samples; those of the wheelset have `ports.POINTS`."""
    return Model("wheel_rail_contact", {"points": points}), Model("wheelset", {})
