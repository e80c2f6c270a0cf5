"""Wheel and rail profiles: the record, the standard shapes and their sampling.

Convention (the right wheel and the right rail, seen from behind): y to the field side, z down, in metres. A wheel has its
tape circle at y = 0 with z = 0 and its flange at negative y; a rail has its gauge corner at negative y. The left side is
the mirror image and uses the same record.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number

Array = NDArray[np.float64]
Kind = Literal["wheel", "rail"]

SPACING = 0.25e-3  # [m] of arc between two points of an analytic profile


@dataclass(frozen=True, eq=False)
class Profile:
    """Outline of a wheel or a rail as points with their tangent angles.

    Parameters
    ----------
    kind : {"wheel", "rail"}
    y, z : array_like, shape (n,), n >= 4
        Points from the gauge or flange side to the field side [m]; y to the field side, z down.
    angle : array_like, shape (n,), optional
        Angle of the tangent, tan(angle) = dz/dy [rad]. Without it, the tangents of a cubic spline over the chord length.
    name : str
        What plots and messages call it.

    Raises
    ------
    ContactError
        Wrong shapes, values that are not finite, fewer than four points, coincident neighbours.
    """

    kind: Kind
    y: Array
    z: Array
    angle: Array = field(default=None, repr=False)  # type: ignore[arg-type]
    name: str = ""

    def __post_init__(self) -> None:
        if self.kind not in ("wheel", "rail"):
            raise ContactError(f"profile.kind = {self.kind!r} is neither 'wheel' nor 'rail'")
        y, z = _points("y", self.y), _points("z", self.z)
        if y.size != z.size or y.size < 4:
            raise ContactError(
                f"profile has {y.size} values of y and {z.size} of z; equally many, at least 4, are needed"
            )
        chord = np.hypot(np.diff(y), np.diff(z))
        if not (chord > 0.0).all():
            i = int(np.argmin(chord))
            raise ContactError(f"profile points {i} and {i + 1} coincide at y = {y[i]:g} m")
        angle = _spline_angles(y, z, chord) if self.angle is None else _points("angle", self.angle)
        if angle.size != y.size:
            raise ContactError(f"profile has {angle.size} angles for {y.size} points")
        for name, array in (("y", y), ("z", z), ("angle", angle)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def rotated(self, roll: float) -> Profile:
        """The profile turned about the x axis through its origin by `roll` [rad], positive from y towards z."""
        c, s = math.cos(require_number("roll", roll, -1.0, 1.0)), math.sin(roll)
        return Profile(self.kind, c * self.y - s * self.z, s * self.y + c * self.z, self.angle + roll, self.name)

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        return f"Profile({self.kind!r}, {name}{self.y.size} points, y = {self.y[0]:g} … {self.y[-1]:g} m)"


def _points(name: str, values: object) -> Array:
    """Return a finite one-dimensional float64 copy."""
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ContactError(f"profile.{name} is not an array of numbers") from None
    if array.ndim != 1 or not np.isfinite(array).all():
        raise ContactError(f"profile.{name} must be one-dimensional and finite; its shape is {array.shape}")
    return array


def _spline_angles(y: Array, z: Array, chord: Array) -> Array:
    """Tangent angles of the C² cubic spline (y, z) over the chord length, with not-a-knot replaced by parabolic ends."""
    u = np.concatenate(([0.0], np.cumsum(chord)))
    return np.unwrap(np.arctan2(_spline_slopes(u, z), _spline_slopes(u, y)))


def _spline_slopes(u: Array, f: Array) -> Array:
    """First derivatives of the interpolating C² cubic spline at its knots; the end segments are parabolas."""
    h, d = np.diff(u), np.diff(f) / np.diff(u)
    lower, upper = np.concatenate((h[1:], [1.0])), np.concatenate(([1.0], h[:-1]))
    middle = np.concatenate(([1.0], 2.0 * (h[1:] + h[:-1]), [1.0]))
    right = np.concatenate(([2.0 * d[0]], 3.0 * (h[1:] * d[:-1] + h[:-1] * d[1:]), [2.0 * d[-1]]))
    for i in range(1, u.size):  # Thomas' algorithm; row i is lower[i-1], middle[i], upper[i]
        factor = lower[i - 1] / middle[i - 1]
        middle[i] -= factor * upper[i - 1]
        right[i] -= factor * right[i - 1]
    slopes = right / middle
    for i in range(u.size - 2, -1, -1):
        slopes[i] = (right[i] - upper[i] * slopes[i + 1]) / middle[i]
    return slopes


# ---------------------------------------------------------------------------------------------------------------------
# Curves with a closed form. All lengths below are millimetres, as in the standards; `_sample` turns them into metres.

Piece = tuple[float, float, Callable[[Array], Array], Callable[[Array], Array]]  # y from, y to, z(y), dz/dy(y)


def _arc(radius: float, centre_y: float, centre_z: float, branch: float) -> tuple[Callable, Callable]:
    """z(y) and z'(y) of a circle; branch -1: above its centre (z down), a crest; +1: below, a trough."""

    def z(y: Array) -> Array:
        return centre_z + branch * np.sqrt(radius**2 - (y - centre_y) ** 2)

    def slope(y: Array) -> Array:
        return -branch * (y - centre_y) / np.sqrt(radius**2 - (y - centre_y) ** 2)

    return z, slope


def _line(y0: float, z0: float, slope: float) -> tuple[Callable, Callable]:
    return lambda y: z0 + slope * (y - y0), lambda y: np.full_like(y, slope)


def _polynomial(coefficients: tuple[float, ...]) -> tuple[Callable, Callable]:
    p = np.polynomial.Polynomial(coefficients)
    return p, p.deriv()


def _sample(kind: Kind, pieces: list[Piece], name: str) -> Profile:
    """Points at equal arcs on every piece, with a point on each joint, and their exact tangents."""
    ys, zs, angles = [], [], []
    for start, end, z, slope in pieces:
        # near a vertical tangent equal steps of y would leave large arcs: cosine spacing is dense at both ends
        fine = 0.5 * (start + end) - 0.5 * (end - start) * np.cos(np.linspace(0.0, math.pi, 2001))
        arc = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(fine), np.diff(z(fine))))))
        n = max(2, math.ceil(arc[-1] * 1e-3 / SPACING) + 1)
        y = np.interp(np.linspace(0.0, arc[-1], n), arc, fine)
        last = n - 1 if end < pieces[-1][1] else n  # a joint belongs to the piece on its field side
        ys.append(y[:last])
        zs.append(z(y)[:last])
        angles.append(np.arctan(slope(y))[:last])
    return Profile(kind, 1e-3 * np.concatenate(ys), 1e-3 * np.concatenate(zs), np.concatenate(angles), name)


def s1002() -> Profile:
    """Wheel S1002 (EN 13715, UIC 510-2): flange height 28 mm, thickness 32.5 mm, from the flange's inner side to 60 mm.

    The flange tip is cut where its inner face becomes steeper than 70° (theory.md 9.1, sections A to H).
    """
    tread: tuple[float, ...] = (0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8)
    tread += (5.309217349e-15, -5.957839843e-12, 2.646656573e-13)
    root: tuple[float, ...] = (-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1)
    root += (-4.169739389e-3, -4.687195829e-5, -2.252755540e-7)
    return _sample(
        "wheel",
        [
            (-69.0, -62.764705882, *_arc(20.5, -49.5, 9.519259302, 1.0)),
            (-62.764705882, -49.662510381, *_arc(12.0, -55.0, 16.0, 1.0)),
            (-49.662510381, -39.764473993, *_arc(20.0, -58.558326413, 8.834924130, 1.0)),
            (-39.764473993, -38.426669071, *_line(0.0, -93.576667419, -2.747477419)),
            (-38.426669071, -35.0, *_arc(13.0, -26.210665, 16.446, -1.0)),
            (-35.0, -26.0, *_polynomial(root)),
            (-26.0, 32.15796, *_polynomial(tread)),
            (32.15796, 60.0, *_line(0.0, 1.364323640, -0.066666667)),
        ],
        "S1002",
    )


#: Half widths of the tangent points R300/R80 and R80/R13 of the 60E1 head [mm] (constants.md 12.2 and 14).
BREAKPOINTS = {"EN 13674": (20.456 / 2.0, 52.053 / 2.0), "UIC 519": (10.5, 25.988)}


def rail_60e1(inclination: float = 1.0 / 40.0, breakpoints: str = "EN 13674") -> Profile:
    """Rail 60E1 (UIC 60): arcs R300, R80, R13 and the head's flanks 1:20, turned towards the track by `inclination`.

    Parameters
    ----------
    inclination : float
        Tangent of the angle between the rail's axis and the vertical, 0 ... 0.1.
    breakpoints : {"EN 13674", "UIC 519"}
        Where R300 meets R80 and R80 meets R13: the widths 20.456 and 52.053 mm of EN 13674-1, or the 10.5 and
        25.988 mm on either side of the axis of the rail of EN 15302 and of the Manchester contact benchmark.

    Notes
    -----
    The origin is the crown's point on the rail axis (theory.md 9.2, a chain of tangents).
    """
    require_number("inclination", inclination, 0.0, 0.1)
    if breakpoints not in BREAKPOINTS:
        raise ContactError(f"breakpoints = {breakpoints!r} is none of {', '.join(map(repr, BREAKPOINTS))}")
    y1, y2 = BREAKPOINTS[breakpoints]
    theta1 = math.asin(y1 / 300.0)
    c2y, c2z = 220.0 * math.sin(theta1), 300.0 - 220.0 * math.cos(theta1)
    theta2 = math.asin((y2 - c2y) / 80.0)
    c3y, c3z = c2y + 67.0 * math.sin(theta2), c2z - 67.0 * math.cos(theta2)
    theta3 = math.atan(20.0)
    y3, z3 = c3y + 13.0 * math.sin(theta3), c3z - 13.0 * math.cos(theta3)
    flank = 0.6  # mm of width: 12 mm of height below the tangent point
    head = _sample(
        "rail",
        [
            (-y3 - flank, -y3, *_line(-y3, z3, -20.0)),
            (-y3, -y2, *_arc(13.0, -c3y, c3z, -1.0)),
            (-y2, -y1, *_arc(80.0, -c2y, c2z, -1.0)),
            (-y1, y1, *_arc(300.0, 0.0, 300.0, -1.0)),
            (y1, y2, *_arc(80.0, c2y, c2z, -1.0)),
            (y2, y3, *_arc(13.0, c3y, c3z, -1.0)),
            (y3, y3 + flank, *_line(y3, z3, 20.0)),
        ],
        f"60E1 {breakpoints}",
    )
    return head.rotated(-math.atan(inclination))


def cone(conicity: float, half_width: float = 0.06) -> Profile:
    """A wheel without a flange: a straight cone of the given `conicity` (0 ... 0.5) over tape circle ± `half_width` [m]."""
    require_number("conicity", conicity, 0.0, 0.5)
    require_number("half_width", half_width, 1e-3, 0.2)
    w = 1e3 * half_width
    return _sample("wheel", [(-w, w, *_line(0.0, 0.0, -conicity))], f"cone {conicity:g}")


def rail_arc(radius: float, half_width: float = 0.03) -> Profile:
    """A rail that is one circular arc of `radius` [m] with its crown at the origin, within ± `half_width` [m]."""
    require_number("radius", radius, 1e-3, 100.0)
    require_number("half_width", half_width, 1e-3, 0.99 * radius)
    w = 1e3 * half_width
    return _sample("rail", [(-w, w, *_arc(1e3 * radius, 0.0, 1e3 * radius, -1.0))], f"arc {radius:g} m")


def read(
    path: str | PathLike[str],
    *,
    kind: Kind | None = None,
    unit: Literal["m", "mm"] | None = None,
    side: Literal["right", "left"] | None = None,
) -> Profile:
    """Read a profile from a file; see `contact.geometry.files` for the formats and their conventions."""
    from contact.geometry import files

    return files.read(path, kind=kind, unit=unit, side=side)
