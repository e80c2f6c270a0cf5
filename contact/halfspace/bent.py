"""Rows of elements on a curved contact surface or in the contact plane: place, creepages and slope."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.kernels.conformal import bend
from contact.kernels.records import CASE
from contact.kernels.rows import Strip

#: The arc length is summed over this many pieces between two samples of a separation.
_PIECES = 16


class Bent(NamedTuple):
    """Place `y` in the plane [m], creepages `vx`, `vy` [-], `phi` [1/m] and slope `tilt` [-] of each row, shape (ny,).

    The rigid slip of a row is (vx - phi·y, vy + phi·x) V.
    """

    y: Array
    vx: Array
    vy: Array
    phi: Array
    tilt: Array

    @classmethod
    def plane(cls, creepage: Creepage, y: Array) -> Bent:
        """Return rows at `y` [m] in the contact plane."""
        ones = np.ones(y.size)
        return cls(y, creepage.longitudinal * ones, creepage.lateral * ones, creepage.spin * ones, 0.0 * ones)


class Surface:
    """The curved contact surface of a separation, unrolled: rows of elements lie at equal steps of the arc length.

    The arc length counts from y = 0 of the plane.
    """

    def __init__(self, separation: Separation) -> None:
        self._separation = separation
        ends = np.union1d(separation.y, [0.0])
        pieces = np.linspace(ends[:-1], ends[1:], _PIECES, endpoint=False).ravel("F")
        self._y = np.append(pieces, ends[-1])
        longer = np.hypot(1.0, np.interp(self._y, separation.y, separation.tilt))
        arc = np.append(0.0, np.cumsum(0.5 * (longer[1:] + longer[:-1]) * np.diff(self._y)))
        self._arc = arc - arc[np.searchsorted(self._y, 0.0)]

    @classmethod
    def of(cls, separation: Separation) -> Surface | None:
        """Return the surface of a separation; None if it is a plane."""
        return cls(separation) if separation.tilt.any() else None

    def along(self, y: ArrayLike) -> Array:
        """Return the arc length [m] at `y` [m] in the plane."""
        return np.interp(np.asarray(y, dtype=np.float64), self._y, self._arc)

    def across(self, arc: ArrayLike) -> Array:
        """Return the place in the plane [m] at an arc length [m]."""
        return np.interp(np.asarray(arc, dtype=np.float64), self._arc, self._y)

    def angle(self, arc: Array) -> Array:
        """Return the angle against the plane [rad] at an arc length [m]."""
        return np.arctan(np.interp(self.across(arc), self._separation.y, self._separation.tilt))

    def unrolled(self) -> Separation:
        """Return the separation over the arc length. The gap stays that along the normal of the plane."""
        s = self._separation
        return Separation(self.along(s.y), s.g, s.A, s.x_c)

    def rows(self, creepage: Creepage, arc: Array) -> Bent:
        """Return rows at an arc length [m], with the rigid slip of `contact.kernels.conformal`."""
        y = self.across(arc)
        case, strips = np.zeros(1, CASE)[0], np.zeros((len(Strip), y.size))
        case.vx, case.vy, case.phi = creepage.longitudinal, creepage.lateral, creepage.spin
        strips[Strip.Y] = y
        case.rolling = self._separation.rolling
        bend(self._separation.samples, case, strips, y.size)
        return Bent(y, strips[Strip.VX], strips[Strip.VY], strips[Strip.PHI], strips[Strip.TILT])
