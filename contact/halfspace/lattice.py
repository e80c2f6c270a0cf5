"""Elements that keep their places on a rail while the contact moves over them, and a gap over a curved surface."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError
from contact.halfspace.bent import Bent
from contact.halfspace.gap import MAX_SIDE, Gap
from contact.inputs.creepage import Creepage


@dataclass(frozen=True, eq=False)
class Lattice:
    """Elements that keep their places on the rail, with centres at multiples of their size, whatever the contact's frame.

    Attributes
    ----------
    spacing : size (dx, dy) of an element [m]
    y, arc : arc length of the rail's profile [m] over its y [m]
    along : whether they keep their places along the track, too, as for a shift; else they follow the frame
    zero : place (u, arc length) of an element's centre [m]
    cover : ranges (x, x, y, y) on the lattice [m] that a grid takes in if it meets them
    origin : place of the frame on the lattice [m]
    """

    spacing: tuple[float, float]
    y: Array
    arc: Array
    along: bool
    zero: tuple[float, float] = (0.0, 0.0)
    cover: tuple[tuple[float, float, float, float], ...] = ()
    origin: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def centred(cls, spacing: tuple[float, float]) -> Lattice:
        """Return elements of which one has its centre at the origin of the frame, wherever that is."""
        return cls(spacing, np.array([0.0, 1.0]), np.zeros(2), False)

    def placed(self, u: float, y: float) -> Lattice:
        """Return the lattice for a frame with its origin at `u` along the rail and at `y` of its profile [m]."""
        arc = float(np.interp(y, self.y, self.arc))
        return replace(self, origin=(u - self.zero[0] if self.along else 0.0, arc - self.zero[1]))

    def centres(self, box: tuple[float, float, float, float]) -> tuple[Array, Array]:
        """Return x and y [m] of the centres of the elements on the box, as `contact.halfspace.gap.Division.centres`."""
        dx, dy = self.spacing
        left, right, low, high = (at + self.origin[k // 2] for k, at in enumerate(box))
        for a, b, c, d in self.cover:
            if a <= right and b >= left and c <= high and d >= low:
                left, right, low, high = min(left, a), max(right, b), min(low, c), max(high, d)
        ends = math.floor(left / dx), math.ceil(right / dx), math.floor(low / dy), math.ceil(high / dy)
        return self._axis(0, *ends[:2]), self._axis(1, *ends[2:])

    def clear(self, box: tuple[float, float, float, float], x: Array, y: Array, h: Array, away: float) -> bool:
        """Set h to `away` on elements that the box does not need, which cannot touch; return if there are any."""
        beyond = []
        for k, at in enumerate((x, y)):
            step, (low, high) = self.spacing[k], box[2 * k : 2 * k + 2]
            here = (at + self.origin[k]) / step
            first, last = math.floor((low + self.origin[k]) / step), math.ceil((high + self.origin[k]) / step)
            beyond.append((here < first - 0.5) | (here > last + 0.5))
        outside = beyond[0] | beyond[1][:, None]
        h[outside] = away
        return bool(outside.any())

    def _axis(self, k: int, first: int, last: int) -> Array:
        step = self.spacing[k]
        if last - first > MAX_SIDE - 2:
            raise ContactError(
                f"spacing = {step:g} makes {last - first} elements along a side; allowed: {MAX_SIDE - 2}"
            )
        return np.arange(first, last + 1, dtype=np.float64) * step - self.origin[k]


class CurvedGap(Gap):
    """Undeformed distance over a curved surface, along the normal of each row of elements.

    Parameters
    ----------
    x, y, h : as for `Gap`; y is the arc length across
    place : array_like, shape (ny,)
        y of each row in the contact plane [m].
    tilt : array_like, shape (ny,)
        Slope of each row against the plane [-].
    """

    __slots__ = ("place", "tilt")

    def __init__(self, x: ArrayLike, y: ArrayLike, h: ArrayLike, place: ArrayLike, tilt: ArrayLike) -> None:
        super().__init__(x, y, h)
        self.place, self.tilt = as_array("place", place), as_array("tilt", tilt)
        for name, rows in (("place", self.place), ("tilt", self.tilt)):
            if rows.shape != self.y.shape or not np.isfinite(rows).all():
                raise ContactError(f"{name} has shape {rows.shape}; finite numbers of shape {self.y.shape} are needed")


def bent_rows(gap: Gap, creepage: Creepage) -> Bent:
    """Return the rows of elements of a gap, for `contact.halfspace.solution.assemble`."""
    rows = Bent.plane(creepage, gap.y)
    return rows._replace(y=gap.place, tilt=gap.tilt) if isinstance(gap, CurvedGap) else rows
