"""What a case gives: numbers of each patch and of the whole, as rows of a table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from contact.errors import ContactError
from contact.inp.case import Case
from contact.inp.columns import PATCH, SIGNS, TOTALS, Column


@dataclass(frozen=True)
class PatchResult:
    """One patch.

    Attributes
    ----------
    values : dict
        Numbers by CONTACT's names, in SI units and with CONTACT's signs.
    solution : GridSolution or Solution
        In our signs and axes.
    fields : dict of ndarray
        Of the grid, in SI units and with CONTACT's signs and axes: x, y, h, mu, p, px, py, ux, uy, un, sx, sy, state; empty for
        strips.
    """

    values: dict[str, float]
    solution: Any = field(repr=False, default=None)
    fields: dict[str, Any] = field(repr=False, default_factory=dict)


@dataclass(frozen=True)
class Result:
    """What a case gives.

    Attributes
    ----------
    case : Case
    patches : tuple of PatchResult
    values : dict
        Numbers of the whole by CONTACT's names, in SI units and with CONTACT's signs.
    status : str
        "ok", "saturated", "no contact", "out of range", "not converged", …; "refused" if the case did not run, "checked" if
        the file only asks for a check.
    refused : str
        Name of the reason in `contact.inp.REASONS`, empty if the case ran.
    message : str
        Why it was refused, or why its numbers are not to be trusted.
    seconds : float
        Time of the case [s].
    """

    case: Case
    patches: tuple[PatchResult, ...] = ()
    values: dict[str, float] = field(default_factory=dict)
    status: str = "ok"
    refused: str = ""
    message: str = ""
    seconds: float = 0.0

    def rows(self, signs: str = "ours") -> list[dict[str, Any]]:
        """Return a row of the whole (patch 0) and one of each patch.

        `signs` is "ours", SI units with forces on the wheel and creepages wheel minus rail, or "contact", the names, units and
        signs of CONTACT.
        """
        if signs not in SIGNS:
            raise ContactError(f"signs = {signs!r} is unknown; allowed: {', '.join(SIGNS)}")
        shift = self.case.digits["T"] == 1
        first = {"case": self.case.number, "patch": 0, "status": self.status, "refused": self.refused}
        rows = [first | _cells(TOTALS, self.values, signs) | _cells(PATCH, {}, signs)]
        for k, patch in enumerate(self.patches, 1):
            one = {"case": self.case.number, "patch": k, "status": self.status, "refused": ""}
            rows.append(one | _cells(TOTALS, {}, signs) | _cells(PATCH, patch.values, signs, shift))
        return rows


#: Shifts of T = 1 under the names of creepages: mm and rad.
_SHIFTS = {"CKSI": 1e3, "CETA": 1e3, "CPHI": 1.0}


def printed_value(column: Column, value: float, shift: bool) -> float:
    """Return a value in CONTACT's unit; `shift` for T = 1, where creepages are shifts."""
    return value * (_SHIFTS.get(column.name, column.per_si) if shift else column.per_si)


def _cells(columns: Iterable[Column], values: dict[str, float], signs: str, shift: bool = False) -> dict[str, Any]:
    cells: dict[str, Any] = {}
    for column in columns:
        value = values.get(column.name)
        if signs == "contact":
            cells[column.title] = None if value is None else printed_value(column, value, shift)
        else:
            cells[column.our_title] = None if value is None else value * column.sign
    return cells


def table(results: Sequence[Result], signs: str = "ours") -> list[dict[str, Any]]:
    """Return the rows of all results, in the order of the file."""
    return [row for result in results for row in result.rows(signs)]
