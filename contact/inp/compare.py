"""Differences between results and those that CONTACT has printed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from contact.errors import ContactError
from contact.inp.columns import PATCH, TOTALS
from contact.inp.printed import Printed
from contact.inp.results import Result, printed_value

#: Largest difference that counts as agreement: forces over the load, pressure and approach over themselves.
TOLERANCE = 1e-3
_FORCES, _THEMSELVES = ("FN", "FX", "FY"), ("APPROACH", "PMAX")
_TOTAL_FORCES = ("FX(TR)", "FY(TR)", "FZ(TR)")


@dataclass(frozen=True, slots=True)
class Difference:
    """A number here and there, in CONTACT's unit and sign.

    Attributes
    ----------
    case, patch : numbers; patch 0 is the whole case
    name : CONTACT's name
    ours, theirs : the numbers
    error : difference over the load (forces), or over their number (pressure, approach)
    """

    case: int
    patch: int
    name: str
    ours: float
    theirs: float
    error: float


def compare(results: Sequence[Result], printed: Sequence[Printed]) -> list[Difference]:
    """Return all differences, the worst first. Refused cases, and cases without printed results, have none.

    Raises
    ------
    ContactError
        If no case of the results is among the printed ones.
    """
    of = {(one.element, one.number): one for one in printed}
    found: list[Difference] = []
    known = 0
    for result in results:
        there = of.get((result.case.element, result.case.number))
        if there is None or not there.printed:
            continue
        known += 1
        if not result.refused and result.status != "checked":
            found.extend(_of_case(result, there))
    if not known:
        raise ContactError("no case is in the printed results; is it the file of other cases?")
    return sorted(found, key=lambda one: -one.error)


def _of_case(result: Result, there: Printed) -> list[Difference]:
    case, found = result.case, []
    if len(result.patches) != len(there.patches):
        found.append(Difference(case.number, 0, "patches", len(result.patches), len(there.patches), math.inf))
    load = abs(there.values.get("FZ(TR)", 0.0)) or sum(patch.values.get("FN", 0.0) for patch in there.patches)
    for column in TOTALS:
        if column.name in _TOTAL_FORCES and column.name in there.values and column.name in result.values and load:
            ours, theirs = result.values[column.name] * column.per_si, there.values[column.name]
            found.append(Difference(case.number, 0, column.name, ours, theirs, abs(ours - theirs) / load))
    shift = case.digits["T"] == 1
    for k, (one, other) in enumerate(zip(result.patches, there.patches, strict=False), 1):
        for column in PATCH:
            name = column.name
            if name not in one.values or name not in other.values or name not in (*_FORCES, *_THEMSELVES):
                continue
            ours, theirs = printed_value(column, one.values[name], shift), other.values[name]
            scale = load if name in _FORCES else abs(theirs)
            if scale > 0.0 and math.isfinite(theirs):
                found.append(Difference(case.number, k, name, ours, theirs, abs(ours - theirs) / scale))
    return found


def worst_of(differences: Sequence[Difference]) -> dict[int, float]:
    """Return the largest error of each case."""
    worst: dict[int, float] = {}
    for one in differences:
        worst[one.case] = max(worst.get(one.case, 0.0), one.error)
    return worst
