"""Creepages and slope of rows of elements on a curved contact surface or in the contact plane."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.creepage import Creepage
from contact.kernels.conformal import bend
from contact.kernels.records import CASE
from contact.kernels.rows import Strip
from contact.separation import Separation

Array = NDArray[np.float64]


class Bent(NamedTuple):
    """Creepages `vx`, `vy` [-], `phi` [1/m] and surface slope `tilt` [-] of each row, shape (ny,).

    The rigid slip of a row is (vx - phi·y, vy + phi·x) V.
    """

    vx: Array
    vy: Array
    phi: Array
    tilt: Array

    @classmethod
    def plane(cls, creepage: Creepage, y: Array) -> Bent:
        """Return rows at `y` [m] in the contact plane."""
        ones = np.ones(y.size)
        return cls(creepage.longitudinal * ones, creepage.lateral * ones, creepage.spin * ones, 0.0 * ones)

    @classmethod
    def of(cls, separation: Separation, creepage: Creepage, y: Array) -> Bent:
        """Return rows at `y` [m] on the curved surface of a separation (`contact.kernels.conformal`)."""
        case, strips = np.zeros(1, CASE)[0], np.zeros((len(Strip), y.size))
        case.vx, case.vy, case.phi = creepage.longitudinal, creepage.lateral, creepage.spin
        strips[Strip.Y] = y
        case.rolling = separation.rolling
        bend(separation.samples, case, strips, y.size)
        return cls(strips[Strip.VX], strips[Strip.VY], strips[Strip.PHI], strips[Strip.TILT])
