"""One named contact problem for comparisons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from contact.errors import ContactError
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.separation import Separation


@dataclass(frozen=True)
class Case:
    """A contact problem: the arguments of `contact.solve` without methods and resolution.

    Parameters
    ----------
    separation : Separation
    creepage : Creepage
    load, approach : float
        Normal force [N] or rigid approach [m]. Give exactly one of them.
    friction, material, speed :
        As in `contact.solve`.
    name : str
        Name in tables and pictures. Cases without a name are numbered.

    Raises
    ------
    ContactError
        If `separation` or `creepage` has the wrong type, or if not exactly one of load and approach is given.

    Examples
    --------
    >>> import contact
    >>> case = contact.Case(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=80e3, name="tread")
    >>> round(contact.solve(**case.arguments).Fx)
    -11846
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
        """Arguments of `contact.solve` without methods and resolution."""
        names = ("separation", "creepage", "load", "approach", "friction", "material", "speed")
        return {name: getattr(self, name) for name in names}
