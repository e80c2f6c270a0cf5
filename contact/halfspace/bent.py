"""Rows of elements on the surface in which the bodies touch, or in the contact plane."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact._layout import (
    CASE_PHI,
    CASE_VX,
    CASE_VY,
    N_CASE,
    N_STRIP_ROWS,
    STRIP_PHI,
    STRIP_TILT,
    STRIP_VX,
    STRIP_VY,
    STRIP_Y,
)
from contact.conformal import bend
from contact.creepage import Creepage
from contact.separation import Separation

Array = NDArray[np.float64]


class Bent(NamedTuple):
    """Creepages of rows, rigid slip (vx - phi·y, vy + phi·x) over V, and slope of the surface, each of shape (ny,)."""

    vx: Array
    vy: Array
    phi: Array
    tilt: Array

    @classmethod
    def plane(cls, creepage: Creepage, y: Array) -> Bent:
        """Rows of the contact plane at `y` [m]."""
        ones = np.ones(y.size)
        return cls(creepage.longitudinal * ones, creepage.lateral * ones, creepage.spin * ones, 0.0 * ones)

    @classmethod
    def of(cls, separation: Separation, creepage: Creepage, y: Array) -> Bent:
        """Rows at `y` [m] on the surface of a separation (`contact.conformal`)."""
        case, strips = np.zeros(N_CASE), np.zeros((N_STRIP_ROWS, y.size))
        case[CASE_VX], case[CASE_VY], case[CASE_PHI] = creepage.longitudinal, creepage.lateral, creepage.spin
        strips[STRIP_Y] = y
        bend(separation.y, separation.tilt, separation.rolling, case, strips, y.size)
        return cls(strips[STRIP_VX], strips[STRIP_VY], strips[STRIP_PHI], strips[STRIP_TILT])
