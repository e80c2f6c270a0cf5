"""Put the points of a profile file into the right-side convention, and refuse what cannot be a wheel or a rail."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contact.errors import ContactError
from contact.geometry import inspection, repair
from contact.geometry.formats import Content
from contact.geometry.inspection import Points
from contact.geometry.shape import Kind
from contact.inputs.options import GAUGE_POINT


def placed(
    points: Points, content: Content, kind: Kind, path: Path, zero: str | float | None, scale: float = 1.0
) -> Points:
    """Return the points [m] from the gauge or flange side to the field side, with z down, about the zero of this library.

    `zero` is the option of `contact.geometry.files.read`, `scale` that of a model.
    """
    if not content.downwards:
        points = _downwards(points, kind, content.outwards, scale)
    outwards = _is_outwards(points) if content.outwards is None else content.outwards
    points = points - [content.datum, 0.0]
    points = points if outwards else points * [-1.0, 1.0]
    points = _ordered(points)
    if len(points) < 4:
        raise ContactError(f"path = {str(path)!r} holds {len(points)} distinct points; at least 4 make a profile")
    if (
        zero is None
        and kind == "wheel"
        and path.suffix.lower() in (".whl", ".mpt")
        and points[:, 0].min() > -0.5 * inspection.FLANGE_BACK * scale
    ):
        zero = "flange_back"
    if zero == "flange_back":
        zero = inspection.FLANGE_BACK * scale
    if isinstance(zero, int | float):
        if kind == "rail":
            raise ContactError(f"zero = {zero!r}: {path.name!r} holds a rail, which has no back of a flange")
        return points - [zero, 0.0]
    return points - scale * _origin(points / scale, kind, path) if zero == "shape" else points


def require_plausible(points: Points, kind: Kind, path: Path, unit: float) -> None:
    """Raise a ContactError for an impossible width, the shape of the other kind, a profile upside down, or a flange on the
    wrong side. `unit` is that of the file [m]. The points are those of full size."""
    if fault := inspection.misplaced(points, kind, unit):
        seen, cure, _ = fault
        raise ContactError(f"path = {str(path)!r}: {seen}; {cure}")


def _origin(points: Points, kind: Kind, path: Path) -> Points:
    """Return the place (y, z) in the points that should be the zero, from the shape."""
    y, z = points.T
    if kind == "rail":
        top = z.min()
        gauge = np.flatnonzero((z > top + GAUGE_POINT.usual) & (np.arange(z.size) < np.argmin(z)))
        if not gauge.size:
            raise ContactError(f"zero = 'shape': the gauge side of {path.name!r} does not reach 14 mm below the top")
        return np.array([y[gauge[-1]] + inspection.CROWN_FROM_GAUGE, top])
    if not inspection.has_flange(points) or y[np.argmax(z)] == y.max():
        raise ContactError(f"zero = 'shape': the wheel in {path.name!r} has no flange to find the tape circle from")
    tape = y[np.argmax(z)] + inspection.TIP_FROM_TAPE
    outside = y > y[np.argmax(z)]
    return np.array([tape, np.interp(tape, y[outside], z[outside])])


def _downwards(points: Points, kind: Kind, outwards: bool | None, scale: float) -> Points:
    """Return the points with z down. Most of a rail is its head, near the top. A wheel's flange is far below the median; a
    wheel without a flange rises to its field side, or to both sides."""
    z = points[:, 1]
    if kind == "rail":
        down = z.mean() > np.median(z)
    else:
        across = points[np.argsort(points[:, 0], kind="stable")]
        even = np.linspace(across[0, 0], across[-1, 0], 201)
        heights = np.interp(even, across[:, 0], across[:, 1])  # also with parts missing
        middle = float(np.median(heights))
        below, above = z.max() - middle, middle - z[_tread(points)].min()
        if max(below, above) > inspection.FLANGE * scale:
            down = below > above
        else:
            ends = {True: heights[-20:], False: heights[:20], None: np.r_[heights[:20], heights[-20:]]}
            down = ends[outwards].mean() < middle
    return points if down else points * [1.0, -1.0]


def _tread(points: Points) -> slice:
    """Return the slice without the outermost tenths, which contain chamfers and flange backs."""
    n = len(points)
    return slice(n // 10, n - n // 10)


def _is_outwards(points: Points) -> bool:
    """Return whether y points to the field side: the flange's tip, or a rail's deeper side or groove, belongs at low y."""
    y, z = points.T
    return bool(y[np.argmax(z)] < 0.5 * (y.min() + y.max()))


def _ordered(points: Points) -> Points:
    """Return the points from the end with low y to the other, without points that nearly coincide with the previous one."""
    if len(points) > 1 and points[0, 0] > points[-1, 0]:
        points = points[::-1]
    return repair.distinct(points)
