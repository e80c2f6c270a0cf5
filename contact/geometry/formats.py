"""Formats of profile files: what each says about its points. `contact.geometry.files` puts the profile together.

The layouts of VAMPIRE and .mpt files are those that the readers of CONTACT take (open source, Apache 2.0), that of GENSYS is
from the manual of its program KPF (gensys.se). No file written by one of these three programs was at hand to try.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from contact.errors import ContactError
from contact.geometry.false_rows import false_rows
from contact.geometry.inspection import Fault, Finding, Points
from contact.geometry.shape import Kind
from contact.reading.columns import number, rows_of, without_remark
from contact.reading.text import lines_of

MM = 1e-3
INCH = 25.4e-3
_SHOWN, _MOST_PARTS = 3, 12  # rows and lists of points in a message


@dataclass(frozen=True)
class Choice:
    """What a reader takes of a file.

    Attributes
    ----------
    side : {"", "right", "left"}
        Side that the file shows; "" if it was not given.
    columns : tuple of int, optional
        Columns of y and z, from 1.
    rows : tuple of int, optional
        First and last line of the file that is read, from 1; 0 as the last is the end.
    section : int or "joined", optional
        Which of several lists of points, from 1.
    """

    side: str = ""
    columns: tuple[int, int] | None = None
    rows: tuple[int, int] | None = None
    section: int | str | None = None


@dataclass(frozen=True)
class Content:
    """Points of a file, in the order of its rows, and what the file says about them.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        y and z in the unit of the file.
    unit : float or None
        That unit [m]; None if the file does not say it.
    outwards : bool or None
        Whether y points to the field side; None if it must be found from the shape.
    downwards : bool
        Whether the direction of z is known to be down. Otherwise it is found from the shape.
    datum : float
        y of the wheel's tape circle in the points [m].
    told : tuple of Finding
        What was left out of the file or chosen in it.
    """

    points: Points
    unit: float | None = None
    outwards: bool | None = None
    downwards: bool = False
    datum: float = 0.0
    told: tuple[Finding, ...] = ()

    @property
    def resolution(self) -> float:
        """Last decimal place of the numbers, in the unit of the file: 0.01 if no number has a third decimal."""
        z = self.points[:, 1]
        for decimals in range(8):
            rounded = np.round(z, decimals)
            if np.allclose(z, rounded, rtol=0.0, atol=1e-6 * 10.0**-decimals):
                return 10.0**-decimals
        return 0.0


@dataclass(frozen=True)
class Format:
    """A format: its reader, the kind of its profiles, whether it says unit and side, and which choices the reader has."""

    read: Callable[[Path, Choice], Content]
    kind: Kind | None = None
    complete: bool = True
    choices: tuple[str, ...] = ("columns", "rows")


def simpack(path: Path, choice: Choice) -> Content:
    """Simpack: unit and steps in the header, applied in the order of their numbers: shift, rotate, bounds, mirror."""
    header: dict[str, float] = {}
    rows: list[tuple[int, str]] = []
    inside = False
    for k, line in _lines(path, choice):
        text = without_remark(line, quotes=True)
        if text == "point.begin":
            inside = True
        elif text == "point.end":
            inside = False
        elif inside:
            rows.append((k, line))
        elif "=" in text:
            key, _, value = text.partition("=")
            if (given := number(value)) is not None and np.isfinite(given):  # others are texts, like a comment
                header[key.strip()] = given
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no points between point.begin and point.end")
    points, told = points_in(rows, path, choice, heading=False, quotes=True)
    points = np.add(points, (header.get("shift.y", 0.0), header.get("shift.z", 0.0)))
    turn = header.get("rotate", 0.0) / (header.get("units.ang.f") or 1.0)
    c, s = np.cos(turn), np.sin(turn)
    points = points @ np.array([[c, s], [-s, c]])
    for column, axis in enumerate("yz"):
        low, high = header.get(f"bound.{axis}.min", 1.0), header.get(f"bound.{axis}.max", 0.0)
        if low < high:  # otherwise the bounds are switched off
            points = points[(points[:, column] >= low) & (points[:, column] <= high)]
            if not len(points):
                raise ContactError(f"path = {str(path)!r}: bound.{axis} from {low:g} to {high:g} leaves no point")
    for column, axis in enumerate("yz"):
        if header.get(f"mirror.{axis}", 0.0) == 1.0:
            points[:, column] *= -1.0
    unit = 1.0 / (header.get("units.len.f") or 1.0)
    return Content(points, unit, outwards=choice.side != "left", downwards=True, told=told)


def columns(path: Path, choice: Choice) -> Content:
    """Plain columns y, z, below lines of text. Blanks, tabs, semicolons, commas or bars separate them."""
    points, told = points_in(_lines(path, choice), path, choice)
    return Content(points, outwards=choice.side != "left", told=told)


def miniprof(path: Path, choice: Choice) -> Content:
    """MiniProf .whl and .ban, in millimetres. The side is found from the shape unless it is given."""
    return _miniprof(_lines(path, choice), path, choice)


def _miniprof(lines: Iterable[tuple[int, str]], path: Path, choice: Choice) -> Content:
    points, told = points_in(lines, path, choice, quotes=True)
    return Content(points, MM, outwards=None if not choice.side else choice.side == "right", told=told)


def miniprof_sections(path: Path, choice: Choice) -> Content:
    """MiniProf .mpt: points follow a line like [ProfilePoints]; other sections hold keys and values."""
    sections: list[tuple[str, list[tuple[int, str]]]] = []
    inside = False
    for k, line in _lines(path, choice):
        text = line.strip()
        if text.startswith("["):
            inside = text.endswith("Points]")
            if inside:
                sections.append((text, []))
        elif inside and "=" not in text:
            sections[-1][1].append((k, text))
    sections = [(name, lines) for name, lines in sections if any(map(str.isdigit, "".join(text for _, text in lines)))]
    if not sections:
        raise ContactError(f"path = {str(path)!r} holds no section of points, like [ProfilePoints]")
    parts = [_miniprof(lines, path, choice) for _, lines in sections]
    return chosen([(name, part) for (name, _), part in zip(sections, parts, strict=True)], path, choice)


def chosen(parts: Sequence[tuple[str, Content]], path: Path, choice: Choice) -> Content:
    """Return the part of a file that `choice.section` names, or all joined end to end."""
    named = [f"{k} {name} with {len(part.points)} points" for k, (name, part) in enumerate(parts, 1)]
    more = f" and {len(named) - _MOST_PARTS} more" if len(named) > _MOST_PARTS else ""
    listed = ", ".join(named[:_MOST_PARTS]) + more
    if choice.section is None and len(parts) > 1:
        raise ContactError(
            f"path = {str(path)!r} holds {len(parts)} lists of points: {listed}; set section to the number of one, or to "
            f"'joined' if they are parts of one profile"
        )
    if choice.section == "joined":
        points, *others = [part.points for _, part in parts]
        while others:
            points = _end_to_end(points, others)
        return replace(parts[0][1], points=points, told=tuple(finding for _, part in parts for finding in part.told))
    wanted = 1 if choice.section is None else choice.section
    if not isinstance(wanted, int) or not 1 <= wanted <= len(parts):
        raise ContactError(f"section = {wanted!r} is neither 'joined' nor one of {path.name!r}: {listed}")
    return parts[wanted - 1][1]


def _end_to_end(points: Points, others: list[Points]) -> Points:
    """Join the part of `others` that lies nearest to an end of the points, and take it out of them."""
    ways = [
        (float(np.hypot(*(points[end] - other[start]))), k, end, start)
        for k, other in enumerate(others)
        for end in (0, -1)
        for start in (0, -1)
    ]
    _, k, end, start = min(ways)
    other = others.pop(k)
    if end == 0:
        return np.concatenate((other if start == -1 else other[::-1], points))
    return np.concatenate((points, other if start == 0 else other[::-1]))


def vampire(path: Path, choice: Choice) -> Content:
    """VAMPIRE: four header lines, then rows with y and z of the left and the right profile, in mm from the track's centre."""
    lines = list(_lines(path, choice))
    heads = [line.strip().upper() for _, line in lines[:4]]
    if len(heads) < 4 or heads[0] not in ("WHEELPROFILE", "RAILPROFILE"):
        raise ContactError(
            f"path = {str(path)!r}: the first line is neither WHEELPROFILE nor RAILPROFILE, as in VAMPIRE"
        )
    chosen_columns = (1, 2) if choice.side == "left" else (3, 4)
    try:
        points, told = points_in(
            lines[4:], path, replace(choice, columns=chosen_columns), heading=False, quotes=True, needed=4
        )
    except ContactError as error:
        raise ContactError(str(error).replace("not a point y, z", "not y, z of both sides")) from None
    datum = 0.0
    if heads[0] == "WHEELPROFILE":
        back = {"EUROPEAN": 70.0 * MM, "US1": (2.0 + 27.0 / 32.0) * INCH, "US2": (3.0 + 1.0 / 16.0) * INCH}
        _, *place = heads[2].split()
        if place[:1] == ["CUSTOM"] and len(place) > 1:
            from_back = _number(place[1], 3, path) * MM
        elif place[:1] and place[0] in back:
            from_back = back[place[0]]
        else:
            raise ContactError(
                f"path = {str(path)!r}, line 3: {heads[2]!r} is no TREADDATUM; allowed: {', '.join(back)}, CUSTOM mm"
            )
        datum = 0.5 * _number(heads[3].removeprefix("FLANGEBACK"), 4, path) * MM + from_back
        datum = -datum if choice.side == "left" else datum
    return Content(points, MM, outwards=choice.side != "left", datum=datum, told=told)


def gensys(path: Path, choice: Choice) -> Content:
    """GENSYS: columns in mm with y to the track's centre, whichever side, and z down."""
    return replace(columns(path, choice), unit=MM, outwards=False, downwards=True)


FORMATS: dict[str, Format] = {
    ".prw": Format(simpack, "wheel"),
    ".prr": Format(simpack, "rail"),
    ".whl": Format(miniprof, "wheel"),
    ".ban": Format(miniprof, "rail"),
    ".mpt": Format(miniprof_sections, choices=("columns", "rows", "section")),
    ".whe": Format(vampire, "wheel", choices=("rows",)),
    ".rai": Format(vampire, "rail", choices=("rows",)),
    ".wheel": Format(gensys, "wheel"),
    ".rail": Format(gensys, "rail"),
}
COLUMNS = Format(columns, complete=False)


def _lines(path: Path, choice: Choice) -> Iterable[tuple[int, str]]:
    """Return the chosen lines of a file with their numbers."""
    lines = list(enumerate(lines_of(path), 1))
    if choice.rows is None:
        return lines
    first, last = choice.rows
    if first > len(lines):
        raise ContactError(f"rows = {choice.rows}: {path.name!r} has {len(lines)} lines")
    return lines[first - 1 : last or None]


def points_in(
    lines: Iterable[tuple[int, str]],
    path: Path,
    choice: Choice,
    *,
    heading: bool = True,
    quotes: bool = False,
    needed: int = 2,
) -> tuple[Points, tuple[Finding, ...]]:
    """Return the points in some lines, and what was left out of them."""
    where = f"path = {str(path)!r}"
    rows = rows_of(lines, where, quotes=quotes, heading=heading, columns=choice.columns, needed=needed)
    told = [Finding(Fault.FILE, seen, cure, np.empty((0, 2))) for seen, cure in rows.told]
    return left_out(rows.values, [f"line {k} {text!r}" for k, text in rows.lines], tuple(told))


def left_out(values: Points, named: Sequence[str], told: tuple[Finding, ...]) -> tuple[Points, tuple[Finding, ...]]:
    """Return the points without false rows, and `told` with a finding of these; `named` are the rows in messages."""
    false = false_rows(values)
    if false.any():
        shown = [named[k] for k in np.flatnonzero(false)[:_SHOWN]]
        more = "" if np.count_nonzero(false) <= _SHOWN else " …"
        seen = f"{np.count_nonzero(false)} of {len(values)} rows are no points of the profile: {', '.join(shown)}{more}"
        told = (Finding(Fault.FALSE, seen, "they were left out", values[:0]), *told)
    return values[~false], told


def _number(word: str, k: int, path: Path) -> float:
    value = number(word)
    if value is None or not np.isfinite(value):
        raise ContactError(f"path = {str(path)!r}, line {k}: {word.strip()[:40]!r} is not a number")
    return value


def as_choice(
    side: str,
    columns: Sequence[int] | None = None,
    rows: Sequence[int] | None = None,
    section: int | str | None = None,
) -> Choice:
    """Return the options as a choice.

    Raises
    ------
    ContactError
        For columns that are not two different numbers from 1 on, and rows that are not two lines in order.
    """
    if columns is not None and (len(columns) != 2 or not all(map(_counts, columns)) or columns[0] == columns[1]):
        raise ContactError(f"columns = {columns!r} is not two different numbers of columns, from 1 on")
    if rows is not None and (
        len(rows) != 2 or not _counts(rows[0]) or not (rows[1] == 0 or (_counts(rows[1]) and rows[1] >= rows[0]))
    ):
        raise ContactError(f"rows = {rows!r} is not the first and the last line, from 1 on; 0 as the last is the end")
    if isinstance(section, str) and section.isdigit():  # from the command line
        section = int(section)
    if section is not None and section != "joined" and not _counts(section):
        raise ContactError(f"section = {section!r} is neither 'joined' nor a number from 1 on")
    return Choice(
        side,
        None if columns is None else (int(columns[0]), int(columns[1])),
        None if rows is None else (int(rows[0]), int(rows[1])),
        section,
    )


def _counts(value: object) -> bool:
    """Return whether a value is an integer from 1 on."""
    return isinstance(value, int) and not isinstance(value, bool) and value > 0
