"""The error of the public API, and the checks that raise it."""

import math
from collections.abc import Iterable
from difflib import get_close_matches


class ContactError(ValueError):
    """Input that the contact problem cannot be posed with; the message names argument, value and allowed range."""


def require_number(
    name: str, value: object, minimum: float = -math.inf, maximum: float = math.inf, *, open_minimum: bool = False
) -> float:
    """Return `value` as a finite float within [`minimum`, `maximum`] (or ]`minimum`, …] when `open_minimum`).

    Raises
    ------
    ContactError
        If it is no real number, not finite or outside the range.
    """
    try:
        if isinstance(value, str | bytes):  # float would take "80e3": a form or a table that was not converted
            raise TypeError
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise ContactError(f"{name} = {value!r} is not a number") from None
    above = number > minimum if open_minimum else number >= minimum
    if not math.isfinite(number) or not above or number > maximum:
        left = "]" if open_minimum or math.isinf(minimum) else "["
        right = "[" if math.isinf(maximum) else "]"
        raise ContactError(f"{name} = {number:g} is outside the allowed range {left}{minimum:g}, {maximum:g}{right}")
    return number


def suggestion(word: object, known: Iterable[str]) -> str:
    """ ", did you mean 'analyn'?" when one of the `known` names is close to `word`, capitals apart; else nothing."""
    originals = {name.casefold(): name for name in known}
    close = get_close_matches(str(word).casefold(), originals, n=1)
    return f", did you mean {originals[close[0]]!r}?" if close else ""
