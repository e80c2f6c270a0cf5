"""Readers of CONTACT's files of slices (.slcs, .slcw), and of folders with one profile file for each slice.

A file of slices holds, in this order; `!`, `%` and `"` begin a comment:

    offset scale                 positions are scale·(offset + number), in mm for rails and rad for wheels
    slices                       number of slices
    features kinks accelerations numbers; 0 or 1 feature: each slice is one part
    method                       1: interpolating, 2: approximating
    position 'file name'         for each slice; names are relative to the folder of the file
    parts before each kink       if there are kinks: the tangent across may jump at the end of these parts
    parts before accelerations   if there are any; they are read and ignored
    position s_1 … s_n           for each slice, if there are features: their chord lengths [mm]; negative: absent

This was found from CONTACT's sources (m_varprof, rev 2707).
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array
from contact.errors import ContactError, ProfileWarning, warn
from contact.geometry.files import UNITS, Unit
from contact.geometry.formats import Choice, columns, simpack
from contact.geometry.surfaces.slices import MOST_SLICES
from contact.reading.text import lines_of

if TYPE_CHECKING:
    from contact.geometry.surfaces.surface import RailSurface, WheelSurface

Rail = TypeVar("Rail", bound="RailSurface")
Wheel = TypeVar("Wheel", bound="WheelSurface")

_RAIL, _WHEEL = ".prr", ".prw"


class _Slices(NamedTuple):
    """Contents of a file of slices, in its units."""

    positions: Array
    names: list[str]
    features: Array | None
    corners: list[int]
    interpolating: bool


def read_rail(
    path: str | PathLike[str],
    surface: type[Rail],
    *,
    s: ArrayLike | None = None,
    unit: Unit = "mm",
    mirror_y: bool = False,
    mirror_z: bool = False,
    smooth: Callable[[Array], Array] | None = None,
    **options: Any,
) -> Rail:
    """Return a rail from a file of slices or a folder.

    Parameters
    ----------
    path : path-like
        File .slcs, or a folder. All files of a folder are slices, in the order of the numbers in their names.
    surface : type
        `RailSurface`.
    s : array_like, optional
        Positions of the slices of a folder [m]. Not for a file, which has its own.
    unit : {"m", "mm", "cm", "inch"}
        Unit of files of plain columns. Simpack's files name their own.
    mirror_y, mirror_z : bool
        Reverse the sign of y or z. The result must have y to the field side of a right rail and z down.
    smooth : callable, optional
        Takes and returns the points (y, z) of a slice [m], shape (n, 2).
    **options
        As for `RailSurface`: spacing, deviations, name; for a folder also features, corners, interpolating.

    Raises
    ------
    ContactError
        If a file cannot be read or is not of this form, or as `RailSurface`.
    """
    return _read(Path(path), surface, _RAIL, s, 1e-3, _metres(unit), (mirror_y, mirror_z), smooth, options)


def read_wheel(
    path: str | PathLike[str],
    surface: type[Wheel],
    *,
    theta: ArrayLike | None = None,
    unit: Unit = "mm",
    mirror_y: bool = False,
    mirror_z: bool = False,
    smooth: Callable[[Array], Array] | None = None,
    **options: Any,
) -> Wheel:
    """Return a wheel from a file of slices (.slcw) or a folder; `theta` [rad] is for a folder. See `read_rail`."""
    return _read(Path(path), surface, _WHEEL, theta, 1.0, _metres(unit), (mirror_y, mirror_z), smooth, options)


def _metres(unit: str) -> float:
    """Return the unit in metres."""
    if unit not in UNITS:
        raise ContactError(f"unit = {unit!r} is none of {', '.join(map(repr, UNITS))}")
    return UNITS[unit]


def _read(
    path: Path,
    surface: Any,
    suffix: str,
    positions: ArrayLike | None,
    unit: float,
    scale: float,
    mirrored: tuple[bool, bool],
    smooth: Callable[[Array], Array] | None,
    options: dict[str, Any],
) -> Any:
    name = "s" if suffix == _RAIL else "theta"
    if path.is_dir():
        if positions is None:
            raise ContactError(f"{name} = None: the folder {str(path)!r} does not tell the positions of its slices")
        files = sorted((f for f in path.iterdir() if f.is_file() and not f.name.startswith(".")), key=_numbered)
        slices = _smoothed([_points(file, suffix, scale, mirrored) for file in files], smooth)
        return surface(positions, slices, **{"name": path.name, **options})
    if positions is not None:
        raise ContactError(f"{name}: the file {str(path)!r} holds the positions of its slices")
    found = _parsed(path)
    places = [path.parent / name.replace("\\", "/") for name in found.names]
    slices = _smoothed([_points(place, suffix, scale, mirrored) for place in places], smooth)
    given = {
        "features": None if found.features is None else 1e-3 * found.features,
        "corners": found.corners,
        "interpolating": found.interpolating,
        "name": path.stem,
    }
    return surface(unit * found.positions, slices, **{**given, **options})


def _smoothed(slices: list[Array], smooth: Callable[[Array], Array] | None) -> list[Array]:
    return slices if smooth is None else [smooth(points) for points in slices]


def _numbered(path: Path) -> tuple[list[int], str]:
    return [int(digits) for digits in re.findall(r"\d+", path.stem)], path.name


def _parsed(path: Path) -> _Slices:
    lines = _statements(path)
    offset, scale = _numbers(lines, 2, "offset and scale", path)
    n = _count(lines, "number of slices", path, 1, MOST_SLICES)[0]
    features, kinks, accelerations = _count(lines, "numbers of features, kinks and accelerations", path, 0, 999, 3)
    method = _count(lines, "method along the track", path, 1, 2)[0]
    positions, names = np.empty(n), []
    for i in range(n):
        number, text = _next(lines, f"slice {i} of {n}", path)
        match = re.match(r"\s*(\S+)\s+(?:'([^']+)'|(\S+))", text)
        if match is None:
            raise ContactError(f"path = {str(path)!r}, line {number}: position and 'file name' of slice {i} are needed")
        positions[i] = scale * (offset + _number(match[1], number, path))
        names.append(match[2] or match[3])
    if features < 2:
        for number, text in lines:
            warn(
                f"{path.name}, line {number}: {text[:40]!r} comes after the {n} slices of the file and is not read",
                ProfileWarning,
            )
            break
        return _Slices(positions, names, None, [], method == 1)
    rest = _stream(lines, path)
    corners = [int(value) for value in _take(rest, kinks, "kinks", path)]
    _take(rest, accelerations, "accelerations", path)
    table = np.array([_take(rest, features + 1, f"features of slice {i}", path) for i in range(n)])
    wrong = np.abs(scale * (offset + table[:, 0]) - positions) >= 1e-3
    if wrong.any():
        i = int(np.argmax(wrong))
        raise ContactError(
            f"path = {str(path)!r}: features {i} are of position {table[i, 0]:g}, slice {i} lies at {positions[i]:g}"
        )
    return _Slices(positions, names, table[:, 1:], corners, method == 1)


def _statements(path: Path) -> Iterator[tuple[int, str]]:
    """Yield number and text of the lines that are not empty, without comments."""
    for number, line in enumerate(lines_of(path), 1):
        text = re.split(r'[!%"]', line, maxsplit=1)[0].strip()
        if text:
            yield number, text


def _next(lines: Iterator[tuple[int, str]], what: str, path: Path) -> tuple[int, str]:
    """Return number and text of the next line."""
    for line in lines:
        return line
    raise ContactError(f"path = {str(path)!r}: the file ends where it needs {what}")


def _numbers(lines: Iterator[tuple[int, str]], count: int, what: str, path: Path) -> list[float]:
    """Return the first `count` numbers of the next line."""
    number, text = _next(lines, what, path)
    words = text.replace(",", " ").split()
    if len(words) < count:
        raise ContactError(f"path = {str(path)!r}, line {number}: {what} needed, {text[:40]!r} found")
    return [_number(word, number, path) for word in words[:count]]


def _number(word: str, number: int, path: Path) -> float:
    try:
        value = float(word.lower().replace("d", "e"))
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise ContactError(f"path = {str(path)!r}, line {number}: {word[:40]!r} is not a number")
    return value


def _count(lines: Iterator[tuple[int, str]], what: str, path: Path, low: int, high: int, count: int = 1) -> list[int]:
    values = _numbers(lines, count, what, path)
    if any(value != int(value) or not low <= value <= high for value in values):
        raise ContactError(f"path = {str(path)!r}: {what} = {values} outside the allowed range [{low}, {high}]")
    return [int(value) for value in values]


def _stream(lines: Iterator[tuple[int, str]], path: Path) -> Iterator[float]:
    for number, text in lines:
        for word in text.replace(",", " ").split():
            yield _number(word, number, path)


def _take(stream: Iterator[float], count: int, what: str, path: Path) -> Sequence[float]:
    values = list(itertools.islice(stream, count))
    if len(values) < count:
        raise ContactError(f"path = {str(path)!r} ends before the {what}")
    return values


def _points(path: Path, suffix: str, scale: float, mirrored: tuple[bool, bool]) -> Array:
    """Return the points of one slice [m]: of a rail from the gauge to the field side, of a wheel from field side to flange."""
    if path.suffix.lower() in (_RAIL, _WHEEL):
        if path.suffix.lower() != suffix:
            raise ContactError(f"path = {str(path)!r} is not a file of a {'rail' if suffix == _RAIL else 'wheel'}")
        content = simpack(path, Choice())
        points = content.points * (content.unit or scale)
    else:
        content = columns(path, Choice())
        points = content.points * scale
    for finding in content.told:
        warn(f"{path.name}: {finding}", ProfileWarning)
    points = points * np.where(mirrored, -1.0, 1.0)
    wanted = points[-1, 0] > points[0, 0] if suffix == _RAIL else points[-1, 0] < points[0, 0]
    points = points if wanted else points[::-1]
    apart = np.concatenate(([True], np.hypot(*np.diff(points, axis=0).T) > 1e-6))
    return np.asarray(points[apart])
