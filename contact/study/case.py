"""One contact problem with a name: what the comparisons are made on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from contact.creepage import Creepage
from contact.errors import ContactError
from contact.material import STEEL, Material
from contact.separation import Separation


@dataclass(frozen=True)
class Case:
    """A contact problem as `contact.solve` takes it, without the methods.

    Parameters
    ----------
    separation : Separation
    creepage : Creepage
    load, approach : float
        Exactly one of them: normal force [N] or rigid approach [m].
    friction, material, speed :
        As in `contact.solve`.
    name : str
        What tables and pictures call it; cases without one are numbered.

    Raises
    ------
    ContactError
        Something else than a separation and a creepage; both or neither of load and approach.
    """

    separation: Separation
    creepage: Creepage
    load: float | None = None
    approach: float | None = None
    friction: float = 0.3
    material: Material = STEEL
    speed: float = 20.0
    name: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.separation, Separation):
            raise ContactError(f"separation = {self.separation!r} is not a contact.Separation")
        if not isinstance(self.creepage, Creepage):
            raise ContactError(f"creepage = {self.creepage!r} is not a contact.Creepage")
        if (self.load is None) == (self.approach is None):
            raise ContactError(
                f"exactly one of load and approach is needed; load = {self.load}, approach = {self.approach}"
            )

    @property
    def arguments(self) -> dict[str, Any]:
        """What `contact.solve` is given besides the methods and the resolution."""
        names = ("separation", "creepage", "load", "approach", "friction", "material", "speed")
        return {name: getattr(self, name) for name in names}
