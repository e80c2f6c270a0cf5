"""Readers of profile files: Simpack, MiniProf and plain columns.

=========  ==============  =====================================================================================
suffix     kind            content of the file, and assumptions
=========  ==============  =====================================================================================
.prw .prr  wheel, rail     Simpack. The header gives the unit and the steps, applied in the order of their numbers: shift,
                           rotate, bounds, mirror. The result is taken as the right side with z down, unless `side` is given.
.whl .ban  wheel, rail     MiniProf, in millimetres. The direction of z and the side of the flange or gauge corner are
                           found from the shape. A wheel measured from the back of its flange is moved by 70 mm.
others     `kind`          Two or more columns y, z separated by blanks, commas or semicolons, after any lines of text.
                           `kind`, `unit` and `side` are required. The direction of z is found from the shape.
=========  ==============  =====================================================================================

A point less than a micrometre from the previous one is dropped, because the tangent between them would be noise.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError
from contact.geometry.profile import Kind, Profile
from contact.geometry.smoothing import smoothed

Points = NDArray[np.float64]  # shape (n, 2): y, z

UNITS = {"m": 1.0, "mm": 1e-3}
NEAREST = 1e-6  # least distance of two points [m]
NARROWEST, WIDEST = 0.03, 0.2  # range of the width of a wheel or a rail's head [m]
_FLANGE = 0.015  # a flange's tip lies at least this far below the median of a wheel's points [m]
_KINDS: dict[str, Kind] = {".prw": "wheel", ".prr": "rail", ".whl": "wheel", ".ban": "rail"}
_FLANGE_BACK = 0.070  # distance from the tape circle [m]


def read(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Literal["m", "mm"] | None = None,
    side: Literal["right", "left"] | None = None,
    smoothing: float | None = None,
) -> Profile:
    """Read a profile and return it in the right-side convention of `contact.geometry.profile`.

    Parameters
    ----------
    path : path-like
        File; its suffix tells the format.
    kind : {"wheel", "rail"}, optional
        Required for plain columns; otherwise it must agree with the suffix.
    unit : {"m", "mm"}, optional
        Unit of length. Required for plain columns; otherwise it replaces the format's own unit.
    side : {"right", "left"}, optional
        Side that the file shows, seen from behind with y to the right. A left side is mirrored. Required for plain columns.
    smoothing : float, optional
        Noise of the measurement [m], root mean square, to be removed by a smoothing spline (needs scipy). By default the
        curve goes through every point.

    Returns
    -------
    Profile

    Raises
    ------
    ContactError
        If the file cannot be read, holds no profile or contradicts `kind`; for missing or unknown arguments; for a profile
        narrower than 30 mm or wider than 200 mm, as from a wrong unit; for a wheel with its flange on the field side.

    Notes
    -----
    The contact depends on tangents and curvatures, which are far noisier than points. An example is S1002 with points
    0.25 mm apart and 2 µm of noise. Without smoothing the root mean square errors are 9.6 mrad and 62 1/m. With
    ``smoothing=2e-6`` they are 1.6 mrad and 3.9 1/m, with half of it 6.4 mrad and 36 1/m, with twice as much 3.6 mrad and
    5.4 1/m; in the last case the points are 3.5 µm off.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if unit is not None and unit not in UNITS:
        raise ContactError(f"unit = {unit!r} is none of {', '.join(map(repr, UNITS))}")
    if side not in (None, "right", "left"):
        raise ContactError(f"side = {side!r} is neither 'right' nor 'left'")
    if kind not in (None, "wheel", "rail"):
        raise ContactError(f"kind = {kind!r} is neither 'wheel' nor 'rail'")
    if kind is not None and _KINDS.get(suffix, kind) != kind:
        raise ContactError(f"kind = {kind!r}, but {path.name!r} is a file of a {_KINDS[suffix]}")
    kind = _KINDS.get(suffix, kind)
    if suffix not in _KINDS:
        for name, value in (("kind", kind), ("unit", unit), ("side", side)):
            if value is None:
                raise ContactError(f"{name} = None: {path.name!r} does not say its {name}; give it")
    if path.exists() and not path.is_file():  # reading a named pipe would wait for ever
        raise ContactError(f"path = {str(path)!r} is not a regular file")
    try:
        lines = path.read_text(encoding="latin-1").splitlines()
    except OSError as error:
        raise ContactError(f"path = {str(path)!r} cannot be read: {error.strerror}") from None

    scale = UNITS[unit] if unit else 1e-3
    if suffix in (".prw", ".prr"):
        points, own_scale = _simpack(lines, path)
        points = points * (scale if unit else own_scale)
    else:
        points = _columns(lines, path) * scale
        points = _downwards(points, kind)  # type: ignore[arg-type]
    if suffix in (".whl", ".ban"):
        points = points if side is not None else _outwards(points, kind)  # type: ignore[arg-type]
    if side == "left":
        points = points * [-1.0, 1.0]
    if suffix == ".whl" and points[:, 0].min() > -0.5 * _FLANGE_BACK:
        points = points - [_FLANGE_BACK, 0.0]
    points = _ordered(points)
    if len(points) < 4:
        raise ContactError(f"path = {str(path)!r} holds {len(points)} distinct points; at least 4 make a profile")
    _plausible(points, kind, path)
    y, z = points.T
    angle = None
    if smoothing is not None:
        y, z, angle = smoothed(y, z, smoothing)
    return Profile(kind, y, z, angle, path.stem)  # type: ignore[arg-type]


def _plausible(points: Points, kind: Kind | None, path: Path) -> None:
    """Raise a ContactError for a profile with an implausible width or with the flange on the wrong side."""
    y, z = points.T
    width = y.max() - y.min()
    if not NARROWEST <= width <= WIDEST:
        raise ContactError(
            f"path = {str(path)!r}: the profile is {width:g} m wide, outside the range [{NARROWEST:g}, {WIDEST:g}] of wheels "
            f"and rails; set unit to 'm' or 'mm'"
        )
    deepest = np.argmax(z)
    if kind == "wheel" and z[deepest] > np.median(z) + _FLANGE and y[deepest] > y.mean():
        raise ContactError(
            f"path = {str(path)!r}: the flange lies on the field side, at y = {y[deepest]:g} m; set side to the other side"
        )


def _simpack(lines: list[str], path: Path) -> tuple[Points, float]:
    """Return the points in the file's unit, after the steps of the header, and that unit in metres."""
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
    return points, 1.0 / (header.get("units.len.f") or 1.0)


def _columns(lines: list[str], path: Path) -> Points:
    """Return the first two columns of the lines of numbers. Other lines may precede them."""
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        text = line.split("#")[0].split("!")[0].strip()
        if not text:
            continue
        try:
            rows.append(_numbers(text, number, path)[:2])
        except ContactError:
            if len(rows) > 1:
                raise
            rows.clear()  # the line belongs to the header
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no columns of numbers")
    return np.array(rows)


def _numbers(text: str, number: int, path: Path) -> list[float]:
    try:
        values = [float(word) for word in text.replace(",", " ").replace(";", " ").split()]
    except ValueError:
        values = []
    if len(values) < 2 or not np.isfinite(values[:2]).all():
        raise ContactError(f"path = {str(path)!r}, line {number}: {text[:40]!r} is not a point y, z")
    return values


def _downwards(points: Points, kind: Kind) -> Points:
    """Return the points with z down. A rail is highest inside. A wheel is lowest at its flange, far below the median."""
    z = points[:, 1]
    if kind == "rail":
        down = z[0] + z[-1] > 2.0 * np.median(z)
    else:
        down = z.max() - np.median(z) > np.median(z) - z[_tread(points)].min()
    return points if down else points * [1.0, -1.0]


def _tread(points: Points) -> slice:
    """Return the slice without the outermost tenths, which contain chamfers and flange backs."""
    n = len(points)
    return slice(n // 10, n - n // 10)


def _outwards(points: Points, kind: Kind) -> Points:
    """Return the points with y to the field side. The flange's tip and the deeper side of a rail belong at low y."""
    y, z = points[np.argsort(points[:, 0])].T
    if kind == "wheel":
        low = y[np.argmax(z)] < 0.5 * (y[0] + y[-1])
    else:
        low = z[0] > z[-1]
    return points if low else points * [-1.0, 1.0]


def _ordered(points: Points) -> Points:
    """Return the points from the end with low y to the other, without points that nearly coincide with the previous one."""
    if len(points) > 1 and points[0, 0] > points[-1, 0]:
        points = points[::-1]
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > NEAREST:
            kept.append(point)
    return np.array(kept)
