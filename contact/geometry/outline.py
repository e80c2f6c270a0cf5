"""Outlines of the standards: arcs, lines, polynomials and tables in millimetres, and their points with exact tangents.

Conventions as in `contact.geometry.profile`: right side, y to the field side, z down. An outline is a sequence of segments
from the gauge or flange side to the field side. A curve through the points rounds a corner between two segments within
`SPACING`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np

from contact.arrays import Array

Points = tuple[Array, Array, Array]  # y, z [mm], angle of the tangent [rad]

SPACING = 0.25e-3  # [m] of arc between two points


class Segment(Protocol):
    """One piece of an outline."""

    def points(self) -> Points:
        """Return points at equal arc lengths of at most `SPACING`, both ends included."""

    def moved(self, by: float) -> Self:
        """Return this segment, moved to the field side by `by` [mm]."""


@dataclass(frozen=True)
class Arc:
    """Arc of a circle from y0 to y1. A crest lies above the centre (z = cz − √…), a trough below it."""

    y0: float
    y1: float
    radius: float
    cy: float
    cz: float
    crest: bool = True

    def points(self) -> Points:
        sign = 1.0 if self.crest else -1.0
        start, end = (math.asin(max(-1.0, min(1.0, (y - self.cy) / self.radius))) for y in (self.y0, self.y1))
        turned = np.linspace(start, end, _number(self.radius * (end - start)))
        return self.cy + self.radius * np.sin(turned), self.cz - sign * self.radius * np.cos(turned), sign * turned

    def moved(self, by: float) -> Self:
        return replace(self, y0=self.y0 + by, y1=self.y1 + by, cy=self.cy + by)

    def between(self, y0: float, y1: float) -> Self:
        """Return the part from y0 to y1."""
        return replace(self, y0=y0, y1=y1)


def trough(y0: float, y1: float, radius: float, cy: float, cz: float) -> Arc:
    """Return an arc below its centre, like the tip of a flange."""
    return Arc(y0, y1, radius, cy, cz, crest=False)


@dataclass(frozen=True)
class Straight:
    """Straight line from (y0, z0) to (y1, z1), y0 <= y1."""

    y0: float
    z0: float
    y1: float
    z1: float

    def points(self) -> Points:
        dy, dz = self.y1 - self.y0, self.z1 - self.z0
        t = np.linspace(0.0, 1.0, _number(math.hypot(dy, dz)))
        return self.y0 + t * dy, self.z0 + t * dz, np.full(t.size, math.atan2(dz, dy))

    def moved(self, by: float) -> Self:
        return replace(self, y0=self.y0 + by, y1=self.y1 + by)

    def between(self, y0: float, y1: float) -> Straight:
        """Return the part from y0 to y1."""
        slope = (self.z1 - self.z0) / (self.y1 - self.y0)
        return sloped(y0, y1, self.z0 - slope * self.y0, slope)


def sloped(y0: float, y1: float, constant: float, slope: float) -> Straight:
    """Return the straight line z = constant + slope·y from y0 to y1."""
    return Straight(y0, constant + slope * y0, y1, constant + slope * y1)


@dataclass(frozen=True)
class Polynomial:
    """z = Σ c_k (y − shift)^k from y0 to y1."""

    y0: float
    y1: float
    coefficients: tuple[float, ...]
    shift: float = 0.0

    def points(self) -> Points:
        p = np.polynomial.Polynomial(self.coefficients)
        return _along(lambda y: p(y - self.shift), lambda y: p.deriv()(y - self.shift), self.y0, self.y1)

    def moved(self, by: float) -> Self:
        return replace(self, y0=self.y0 + by, y1=self.y1 + by, shift=self.shift + by)

    def between(self, y0: float, y1: float) -> Self:
        """Return the part from y0 to y1."""
        return replace(self, y0=y0, y1=y1)


@dataclass(frozen=True)
class Tabulated:
    """z at equal steps of y from y0 to y1, with a cubic spline between them."""

    y0: float
    y1: float
    z: tuple[float, ...]

    def points(self) -> Points:
        y, z = np.linspace(self.y0, self.y1, len(self.z)), np.array(self.z)
        return y, z, np.arctan(spline_slopes(y, z))

    def moved(self, by: float) -> Self:
        return replace(self, y0=self.y0 + by, y1=self.y1 + by)


def sample(segments: Iterable[Segment]) -> Points:
    """Return y [m], z [m] and tangent angles [rad] of an outline. A joint has the tangent of the segment on its field side."""
    pieces = [segment.points() for segment in segments]
    ends = [slice(-1)] * (len(pieces) - 1) + [slice(None)]
    y, z, angle = (np.concatenate([p[row][end] for p, end in zip(pieces, ends, strict=True)]) for row in range(3))
    return 1e-3 * y, 1e-3 * z, angle


def chain(radii: Sequence[float], widths: Sequence[float], flank: float) -> tuple[Segment, ...]:
    """Return the outline of a rail's head: arcs with common tangents, symmetric about y = 0, with the crown at z = 0.

    Parameters
    ----------
    radii : sequence of float
        Radii of the arcs from the crown outwards [mm].
    widths : sequence of float
        Full widths [mm] at which each arc but the last is followed by the next.
    flank : float
        Slope dz/dy of the head's side; `math.inf` if it is vertical.
    """
    arcs, start, cy, cz = [], 0.0, 0.0, radii[0]
    for k, radius in enumerate(radii):
        last = k == len(radii) - 1
        sine = math.sin(math.atan(flank)) if last else (0.5 * widths[k] - cy) / radius
        end = cy + radius * sine
        arcs.append(Arc(start, end, radius, cy, cz))
        if not last:  # the next centre lies on the line through this one and the common point
            inward = radius - radii[k + 1]
            start, cy, cz = end, cy + inward * sine, cz - inward * math.sqrt(1.0 - sine**2)
    top = cz - radius * math.sqrt(1.0 - sine**2)
    right = Straight(end, top, end + _FLANK * math.sqrt(1.0 - sine**2), top + _FLANK * sine)
    crown, *outer = arcs
    left = [Arc(-a.y1, -a.y0, a.radius, -a.cy, a.cz) for a in reversed(outer)]
    crown = Arc(-crown.y1, crown.y1, crown.radius, 0.0, crown.cz)
    return (Straight(-right.y1, right.z1, -right.y0, right.z0), *left, crown, *outer, right)


_FLANK = 12.0  # length of the head's side below the last arc [mm]


def spline_slopes(u: Array, f: Array) -> Array:
    """Return the first derivatives of the interpolating C² cubic spline at its knots. The end segments are parabolas."""
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


def _number(length: float) -> int:
    """Return the number of points on a segment of this length [mm]."""
    return max(2, math.ceil(1e-3 * length / SPACING) + 1)


def _along(z: Callable[[Array], Array], slope: Callable[[Array], Array], y0: float, y1: float) -> Points:
    fine = np.linspace(y0, y1, 2001)
    arc = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(fine), np.diff(z(fine))))))
    y = np.interp(np.linspace(0.0, arc[-1], _number(arc[-1])), arc, fine)
    return y, z(y), np.arctan(slope(y))
