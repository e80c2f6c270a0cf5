"""One line of a comparison."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from contact.study.errors import Errors


@dataclass(frozen=True, slots=True)
class Row:
    """Results of one case by one pair of methods, in SI units. Forces act on the wheel.

    Attributes
    ----------
    case, normal, tangential, status : str
    N, Fx, Fy, Mz, approach, max_pressure, area : float
        As in `Solution`.
    adhesion_area : float or None
        [m²]; None if the tangential method gives forces only.
    time : float
        Least wall time of a warm `contact.solve` [s].
    errors : Errors or None
        Errors against the reference. None for the reference itself, without a reference, or without contact.
    """

    case: str
    normal: str
    tangential: str
    status: str
    N: float
    approach: float
    Fx: float
    Fy: float
    Mz: float
    max_pressure: float
    area: float
    adhesion_area: float | None
    time: float
    errors: Errors | None

    def flat(self) -> dict[str, Any]:
        """Return a dictionary without nesting, with `error_force` and so on; None if there is no value."""
        content = asdict(self)
        errors = content.pop("errors") or {}
        names = Errors.__dataclass_fields__
        return content | {f"error_{name}": errors.get(name) for name in names}
