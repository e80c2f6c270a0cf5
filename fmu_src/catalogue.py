"""The FMUs that this project makes.

What belongs to one of them is in modules of the same name: its table in `tables`, its slave in `python`, its component in
`native`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

from contact.geometry import profile
from contact.geometry.profile import Kind, Profile
from fmu_src import profiles
from fmu_src.variables import Table


@dataclass(frozen=True)
class Model:
    """An FMU: the name of its modules, what its table, slave and component are made with, its files in resources/."""

    name: str
    options: Mapping[str, float]
    resources: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def table(self) -> Table:
        """Its variables."""
        return self.module("tables").table(**self.options)

    def module(self, part: str) -> Any:
        """Its module in "tables", "python" or "native"."""
        return import_module(f"fmu_src.{part}.{self.name}")


def models(points: int, given: Mapping[Kind, Profile] | None = None) -> tuple[Model, ...]:
    """All FMUs, the contact for separations of `points` samples, the pair with the profiles that are `given`.

    By default that is S1002 on 60E1, which is turned by 1:40; another rail is taken as it is. The separations of the
    wheelset have `ports.POINTS`.
    """
    both: dict[Kind, Profile] = {"wheel": profile.s1002(), "rail": profile.rail_60e1(0.0), **(given or {})}
    inclination = 0.0 if given and "rail" in given else 1.0 / 40.0
    return (
        Model("wheel_rail_contact", {"points": points}),
        Model("wheel_rail_pair", {"inclination": inclination}, profiles.resources(both["wheel"], both["rail"])),
        Model("wheelset", {}),
    )
