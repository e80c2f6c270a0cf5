"""Formats of profile files: what each says about its points. `contact.geometry.files` puts the profile together.

The layouts of VAMPIRE and .mpt files are those that the readers of CONTACT take (open source, Apache 2.0), that of GENSYS is
from the manual of its program KPF (gensys.se). No file written by one of these three programs was at hand to try.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError
from contact.geometry.shape import Kind

Points = NDArray[np.float64]  # shape (n, 2): y, z

MM = 1e-3
INCH = 25.4e-3
_NOT_FINITE = re.compile(r"(?<![\w.])(nan|inf)(?![\w.])", re.IGNORECASE)
_NUMBER_WITH_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_NUMBER = re.compile(r"[+-]?\d+(?:[.,]\d*)?(?:[eE][+-]?\d+)?")


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
    """

    points: Points
    unit: float | None = None
    outwards: bool | None = None
    downwards: bool = False
    datum: float = 0.0

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
    """A format: its reader, the kind of its profiles, and whether the reader must be told unit and side."""

    read: Callable[[Sequence[str], Path, str], Content]
    kind: Kind | None = None
    complete: bool = True


def simpack(lines: Sequence[str], path: Path, side: str) -> Content:
    """Simpack: unit and steps in the header, applied in the order of their numbers: shift, rotate, bounds, mirror."""
    header: dict[str, float] = {}
    rows: list[list[float]] = []
    inside = False
    for number, line in enumerate(lines, 1):
        text = line.split("!")[0].strip()
        if text == "point.begin":
            inside = True
        elif text == "point.end":
            inside = False
        elif inside and text:
            rows.append(_numbers(text, number, path)[:2])
        elif "=" in text:
            key, _, value = text.partition("=")
            try:
                header[key.strip()] = float(value)
            except ValueError:
                continue  # a text value, like a comment or the name of the original file
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no points between point.begin and point.end")
    points = np.add(rows, (header.get("shift.y", 0.0), header.get("shift.z", 0.0)))
    turn = header.get("rotate", 0.0) / (header.get("units.ang.f") or 1.0)
    c, s = np.cos(turn), np.sin(turn)
    points = points @ np.array([[c, s], [-s, c]])
    for column, axis in enumerate("yz"):
        low, high = header.get(f"bound.{axis}.min", 1.0), header.get(f"bound.{axis}.max", 0.0)
        if low < high:  # otherwise the bounds are switched off
            points = points[(points[:, column] >= low) & (points[:, column] <= high)]
    for column, axis in enumerate("yz"):
        if header.get(f"mirror.{axis}", 0.0) == 1.0:
            points[:, column] *= -1.0
    return Content(points, 1.0 / (header.get("units.len.f") or 1.0), outwards=side == "right", downwards=True)


def columns(lines: Sequence[str], path: Path, side: str) -> Content:
    """Plain columns y, z, after any lines of text. Blanks, tabs, semicolons or commas separate them."""
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        text = line.split("#")[0].split("!")[0].strip()
        if not text:
            continue
        _require_clear_commas(text, number, path)
        try:
            rows.append(_numbers(text, number, path)[:2])
        except ContactError:
            if len(rows) > 1 or _NOT_FINITE.search(text):
                raise
            rows.clear()  # the line belongs to the header
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no columns of numbers")
    return Content(np.array(rows), outwards=side != "left")


def miniprof(lines: Sequence[str], path: Path, side: str) -> Content:
    """MiniProf .whl and .ban, in millimetres. The side is found from the shape unless it is given."""
    return replace(columns(lines, path, side), unit=MM, outwards=None if not side else side == "right")


def miniprof_sections(lines: Sequence[str], path: Path, side: str) -> Content:
    """MiniProf .mpt: points follow a line like [ProfilePoints]; other sections hold keys and values."""
    kept: list[str] = []
    inside = False
    for line in lines:
        text = line.strip()
        if text.startswith("["):
            inside = text.endswith("Points]")
        else:
            kept.append(text if inside and "=" not in text else "")
    return miniprof(kept, path, side)


def vampire(lines: Sequence[str], path: Path, side: str) -> Content:
    """VAMPIRE: four header lines, then rows with y and z of the left and the right profile, in mm from the track's centre."""
    heads = [line.strip().upper() for line in lines[:4]]
    if len(heads) < 4 or heads[0] not in ("WHEELPROFILE", "RAILPROFILE"):
        raise ContactError(
            f"path = {str(path)!r}: the first line is neither WHEELPROFILE nor RAILPROFILE, as in VAMPIRE"
        )
    columns_of_side = slice(0, 2) if side == "left" else slice(2, 4)
    rows = []
    for number, line in enumerate(lines[4:], 5):
        text = re.split(r'["!%]', line)[0].strip()
        if text:
            row = _numbers(text, number, path)
            if len(row) < 4:
                raise ContactError(f"path = {str(path)!r}, line {number}: {text[:40]!r} is not y, z of both sides")
            rows.append(row[columns_of_side])
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no columns of numbers")
    datum = 0.0
    if heads[0] == "WHEELPROFILE":
        back = {"EUROPEAN": 70.0 * MM, "US1": (2.0 + 27.0 / 32.0) * INCH, "US2": (3.0 + 1.0 / 16.0) * INCH}
        _, *place = heads[2].split()
        if place[:1] == ["CUSTOM"] and len(place) > 1:
            from_back = _numbers(f"{place[1]} 0", 3, path)[0] * MM
        elif place[:1] and place[0] in back:
            from_back = back[place[0]]
        else:
            raise ContactError(
                f"path = {str(path)!r}, line 3: {heads[2]!r} is no TREADDATUM; allowed: {', '.join(back)}, CUSTOM mm"
            )
        datum = 0.5 * _numbers(f"{heads[3].removeprefix('FLANGEBACK')} 0", 4, path)[0] * MM + from_back
        datum = -datum if side == "left" else datum
    return Content(np.array(rows), MM, outwards=side != "left", datum=datum)


def gensys(lines: Sequence[str], path: Path, side: str) -> Content:
    """GENSYS: columns in mm with y to the track's centre, whichever side, and z down."""
    return replace(columns(lines, path, side), unit=MM, outwards=False, downwards=True)


FORMATS: dict[str, Format] = {
    ".prw": Format(simpack, "wheel"),
    ".prr": Format(simpack, "rail"),
    ".whl": Format(miniprof, "wheel"),
    ".ban": Format(miniprof, "rail"),
    ".mpt": Format(miniprof_sections),
    ".whe": Format(vampire, "wheel"),
    ".rai": Format(vampire, "rail"),
    ".wheel": Format(gensys, "wheel"),
    ".rail": Format(gensys, "rail"),
}
COLUMNS = Format(columns, complete=False)


def _numbers(text: str, number: int, path: Path) -> list[float]:
    """Return the numbers of a row, at least two. Decimal commas are recognised by another separator of the columns."""
    words = [word.strip(",") for word in re.split(r"[;\s]+", text) if word.strip(",")]
    pair = words[:2]
    if len(pair) == 2 and any(map(_NUMBER_WITH_COMMA.fullmatch, pair)) and all(map(_NUMBER.fullmatch, pair)):
        words = [word.replace(",", ".") for word in words]
    else:
        words = text.replace(",", " ").replace(";", " ").split()
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) < 2 or not np.isfinite(values[:2]).all():
        raise ContactError(f"path = {str(path)!r}, line {number}: {text[:40]!r} is not a point y, z")
    return values


def _require_clear_commas(text: str, number: int, path: Path) -> None:
    """Raise a ContactError for a row like 1,5,2,5, which may be two or four numbers."""
    word = text.strip(", ")
    if word.count(",") in (3, 5) and re.fullmatch(r"[+-]?\d+(,[+-]?\d+)+", word):
        raise ContactError(
            f"path = {str(path)!r}, line {number}: {text[:40]!r}: commas may be decimal or separate columns; separate the "
            f"columns by semicolons or blanks"
        )
