"""Readers of profile files: Simpack, MiniProf and plain columns.

=========  ==============  =====================================================================================
suffix     kind            what the file says, and what is assumed
=========  ==============  =====================================================================================
.prw .prr  wheel, rail     Simpack. The header's unit and its steps in the order of their numbers there: shift, rotate,
                           bounds, mirror. The result is taken to be the right side with z down (`side` overrules).
.whl .ban  wheel, rail     MiniProf, in millimetres. Whether z points up or down and where the flange or the gauge corner
                           is, is seen from the shape; a wheel measured from the back of its flange is moved by 70 mm.
others     `kind`          Two or more columns y, z separated by blanks, commas or semicolons, after any lines of text;
                           `kind`, `unit` and `side` are needed. z up or down is seen from the shape.
=========  ==============  =====================================================================================

Points nearer than a micrometre to the one before are left out: a tangent between them would be noise.
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
NEAREST = 1e-6  # [m]
NARROWEST, WIDEST = 0.03, 0.2  # [m] of a wheel or a rail's head
_FLANGE = 0.015  # [m] that a point must lie below the middle of a wheel to be a flange's tip
_KINDS: dict[str, Kind] = {".prw": "wheel", ".prr": "rail", ".whl": "wheel", ".ban": "rail"}
_FLANGE_BACK = 0.070  # [m] from the tape circle


def read(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Literal["m", "mm"] | None = None,
    side: Literal["right", "left"] | None = None,
    smoothing: float | None = None,
) -> Profile:
    """Read a profile in the right-side convention of `contact.geometry.profile`.

    Parameters
    ----------
    path : path-like
        File; its suffix tells the format.
    kind : {"wheel", "rail"}, optional
        Needed for plain columns; else it must agree with the suffix.
    unit : {"m", "mm"}, optional
        Unit of length; needed for plain columns, overrules the format's own otherwise.
    side : {"right", "left"}, optional
        Which side the file shows, seen from behind with y to the right; a left one is mirrored. Needed for plain columns.
    smoothing : float, optional
        Noise of the measurement [m], root mean square, which a smoothing spline takes out (needs scipy); by default the curve
        goes through every point. The contact depends on tangents and curvatures, which are far noisier than points: 2 µm of
        noise on points of S1002 0.25 mm apart leave errors (root mean square) of 9.6 mrad and 62 1/m, and with
        ``smoothing=2e-6`` 1.6 mrad and 3.9 1/m; with half of it 6.4 mrad and 36 1/m, with twice as much 3.6 mrad and 5.4 1/m
        while the points are 3.5 µm off.

    Raises
    ------
    ContactError
        A file that cannot be read, holds no profile or contradicts `kind`; arguments that are missing or unknown; a profile
        narrower than 30 mm or wider than 200 mm, as in a wrong unit; a wheel with its flange on the field side.
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
    """Refuse a profile that only a wrong unit or a wrong side explains."""
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
    """Points after the header's steps, in the file's unit, and that unit in metres."""
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
                continue  # a text, as the comment or the name of the original file
    if not rows:
        raise ContactError(f"path = {str(path)!r} holds no points between point.begin and point.end")
    points = np.add(rows, (header.get("shift.y", 0.0), header.get("shift.z", 0.0)))
    turn = header.get("rotate", 0.0) / (header.get("units.ang.f") or 1.0)
    c, s = np.cos(turn), np.sin(turn)
    points = points @ np.array([[c, s], [-s, c]])
    for column, axis in enumerate("yz"):
        low, high = header.get(f"bound.{axis}.min", 1.0), header.get(f"bound.{axis}.max", 0.0)
        if low < high:  # the other way round they are off
            points = points[(points[:, column] >= low) & (points[:, column] <= high)]
    for column, axis in enumerate("yz"):
        if header.get(f"mirror.{axis}", 0.0) == 1.0:
            points[:, column] *= -1.0
    return points, 1.0 / (header.get("units.len.f") or 1.0)


def _columns(lines: list[str], path: Path) -> Points:
    """First two columns of the lines of numbers that follow lines of anything else."""
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
            rows.clear()  # still the header
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
    """Turn z down: a rail is highest inside, a wheel reaches lowest at its flange, far from the median of its tread."""
    z = points[:, 1]
    if kind == "rail":
        down = z[0] + z[-1] > 2.0 * np.median(z)
    else:
        down = z.max() - np.median(z) > np.median(z) - z[_tread(points)].min()
    return points if down else points * [1.0, -1.0]


def _tread(points: Points) -> slice:
    """Leave out the outermost tenths, where chamfers and flange backs are."""
    n = len(points)
    return slice(n // 10, n - n // 10)


def _outwards(points: Points, kind: Kind) -> Points:
    """Turn y to the field side: the flange's tip, or the deeper side of a rail, belongs at its lower end."""
    y, z = points[np.argsort(points[:, 0])].T
    if kind == "wheel":
        low = y[np.argmax(z)] < 0.5 * (y[0] + y[-1])
    else:
        low = z[0] > z[-1]
    return points if low else points * [-1.0, 1.0]


def _ordered(points: Points) -> Points:
    """From the low-y end to the other, without points that nearly coincide with the one before."""
    if len(points) > 1 and points[0, 0] > points[-1, 0]:
        points = points[::-1]
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) > NEAREST:
            kept.append(point)
    return np.array(kept)
