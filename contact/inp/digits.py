"""The table of control digits of the page "If you come from CONTACT", from the table of the format."""

from __future__ import annotations

from contact.inp.controls import WORDS, Digit
from contact.inp.reasons import REFUSED, REFUSED_ON_GRID

#: Digits that change nothing here.
_WITHOUT_EFFECT = {
    "X": "not used",
    "G": "not used: one solver; G = 2 with DQ other than DX is refused",
    "I": "not used: the start changes no result where the solution is unique",
    "A": "elements of `--contact-mat`",
    "O": "not used: `--out` chooses",
    "W": "not used",
    "S": "points are read; `contact.stress` computes stresses of a solution",
}


def digit_table() -> str:
    """Return the table of control digits, as Markdown."""
    lines = ["| digit | value | module 1 | module 3 |", "|---|---|---|---|"]
    for word in WORDS:
        for digit in word:
            if digit.letter in _WITHOUT_EFFECT:
                lines.append(f"| {_name(digit)} | all | {_WITHOUT_EFFECT[digit.letter]} | the same |")
                continue
            for value in sorted({*digit.module_1, *digit.module_3}):
                cells = (_cell(digit, value, module) for module in (1, 3))
                lines.append(f"| {_name(digit)} | {value} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _name(digit: Digit) -> str:
    return f"{digit.letter.rstrip('13')} {digit.name}"


def _cell(digit: Digit, value: int, module: int) -> str:
    meaning = digit.values(module).get(value)
    if meaning is None:
        return "–"
    refused = REFUSED[module].get(digit.letter, {}).get(value)
    if refused is not None:
        return f"{meaning}: **refused**"
    on_grid = REFUSED_ON_GRID[module].get(digit.letter, {}).get(value)
    if on_grid is not None:
        return f"{meaning}: **refused**, but with `--fast`"
    return meaning
