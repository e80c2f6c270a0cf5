"""Write input files of CONTACT."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from contact.errors import ContactError
from contact.inp.case import Case
from contact.inp.controls import WORDS
from contact.inp.fields import Array, Block, Field, Group
from contact.inp.subsurface import SUBSURFACE
from contact.inp.table import BLOCKS

_PER_LINE = 8


def write(cases: Case | Sequence[Case], path: str | os.PathLike[str]) -> None:
    """Write cases as an input file of CONTACT 25.1.

    Parameters
    ----------
    cases : Case or sequence of Case
        A single case is completed: what it keeps of cases before it is written too.
    path : path-like
        Names of profiles are written relative to its folder.

    Raises
    ------
    ContactError
        If a case lacks a value, or a value is no number that the format can hold.
    """
    file = Path(path)
    if isinstance(cases, Case):
        cases = [complete(cases)]
    parts: list[str] = []
    for k, case in enumerate(cases):
        stays = k > 0 and cases[k - 1].digits["R"] in (0, 2)
        if stays and case.memory != cases[k - 1].memory:
            raise ContactError(
                f"{cases[k - 1].place}: R = {cases[k - 1].digits['R']} must be 1 or 3 before another module"
            )
        if not stays:
            parts.append(f" {case.module} {case.element} {case.problem}   MODULE, REID, CPID")
        parts.extend(_case(case, file))
    if cases and cases[-1].digits["R"] in (0, 2):
        raise ContactError(f"{cases[-1].place}: R = {cases[-1].digits['R']} of the last case must be 1 or 3")
    parts.append(" 0   MODULE")
    file.write_text("\n".join(parts) + "\n", encoding="utf-8")


def complete(case: Case) -> Case:
    """Return the case with digits that read everything it keeps, so that it stands by itself."""
    to = {
        "P": 2,
        "I": 0,
        "R": 1,
        "L": case["LAW"],
        "V": case["ROWS"],
        "C3": case["INFLUENCE"],
        "G": 0 if case.digits["G"] == 1 else case.digits["G"],
    }
    if case.module == 1:
        wheel = 5 if case.digits["E"] in (4, 5) else 3
        to |= {"D": case["SEARCH"], "Z": 3, "E": wheel}
    else:
        to |= {"D": 2, "Z": 2}
    if case.digits["S"] in (1, 2):
        to["S"] = 3
    if case.digits["H"] == 1:
        to["H"] = 3
    return case.changed(to)


def _case(case: Case, file: Path) -> list[str]:
    lines: list[str] = []
    for k, word in enumerate(WORDS):
        used = word[1:] if k == 0 and case.module == 3 else word
        digits = "".join(str(case.digits[digit.letter]) for digit in used)
        damping = f" {10 * case.digits['WEIGHTING'] + case.digits['M2']}" if k == 1 else ""
        lines.append(f" {digits}{damping}   {'-'.join(digit.letter[0] for digit in used)}")
    return lines + _blocks(BLOCKS[case.module], {**case.values, **case.digits}, case, file)


def _blocks(blocks: Sequence[Block], now: dict[str, Any], case: Case, file: Path) -> list[str]:
    lines: list[str] = []
    for block in blocks:
        if not block.when(now):
            continue
        if isinstance(block, Group):
            rows: Sequence[int | None] = (None,) if block.repeat is None else range(block.repeat(now))
            lines.extend(_group(block, now, row, case, file) for row in rows)
        elif isinstance(block, Array):
            lines.extend(_array(_known(now, block.name, case), block.factors(now)))
        else:
            for points in _known(now, "SUBS", case):
                lines += [f" {points['ISUBS']}   ISUBS", *_blocks(SUBSURFACE, points, case, file)]
            lines.append(" 0   ISUBS")
    return lines


def _known(now: dict[str, Any], name: str, case: Case) -> Any:
    if now.get(name) is None:
        raise ContactError(f"{case.place}: {name} is not given")
    return now[name]


def _group(group: Group, now: dict[str, Any], row: int | None, case: Case, file: Path) -> str:
    words, names = [], []
    for field in group.fields:
        if field.when(now):
            value = _known(now, field.name, case)
            words.append(_word(field, value if row is None else value[row], field.scale(now), file))
            names.append(field.name)
    return f" {'  '.join(words)}   {', '.join(names)}"


def _word(field: Field, value: Any, factor: float, file: Path) -> str:
    if field.kind == "s":
        name = os.path.relpath(value, file.parent).replace(os.sep, "/")
        if any(bad in name for bad in "',%"):
            raise ContactError(f"{field.name} = {name!r}: CONTACT reads no name with ' , or %")
        return f"'{name}'"
    return str(value) if field.kind == "i" else number(value, factor)


def number(value: float, factor: float = 1.0) -> str:
    """Return the text of a number that, read back and multiplied by `factor`, is `value` to the last bit if there is one."""
    if not math.isfinite(value):
        raise ContactError(f"the value {value!r} cannot be written; allowed: finite numbers")
    middle = value / factor
    for text in (f"{middle:.12g}", repr(middle)):
        if float(text) * factor == value:
            return text
    low, high = middle, middle
    for _ in range(4):
        low, high = math.nextafter(low, -math.inf), math.nextafter(high, math.inf)
        for one in (low, high):
            if one * factor == value:
                return repr(one)
    return repr(middle)


def _array(values: Sequence[float], factors: tuple[float, ...]) -> list[str]:
    texts = [number(value, factors[k % len(factors)]) for k, value in enumerate(values)]
    return ["  " + "  ".join(texts[k : k + _PER_LINE]) for k in range(0, len(texts), _PER_LINE)]
