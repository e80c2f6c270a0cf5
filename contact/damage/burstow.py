"""Rolling contact fatigue of rails from T-gamma: Burstow's whole life rail model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.errors import require_number
from contact.kernels.damage.burstow import burstow_kernel


@dataclass(frozen=True, slots=True)
class Burstow:
    """Constants of the piecewise linear damage function (constants.md 2).

    Parameters
    ----------
    threshold : float
        T-gamma at which damage starts [N]. 15 [X]: recalled (Burstow 2004, 2009); 20 in Dutch work on R260Mn rail
        (U. Twente).
    peak_at : float
        T-gamma of the largest damage [N]. 65 [2+].
    zero_at : float
        T-gamma at which wear removes cracks as fast as they start [N]. 175 [2+].
    peak : float
        Largest damage per axle pass [-]. 10e-6 [2+].
    clip_negative : bool
        [X] False (recalled): the falling branch continues below zero, because wear removes cracks. True (U. Twente): the
        damage is 0 there.
    """

    threshold: float = 15.0
    peak_at: float = 65.0
    zero_at: float = 175.0
    peak: float = 10e-6
    clip_negative: bool = False

    def __post_init__(self) -> None:
        require_number("burstow.threshold", self.threshold, 0.0)
        require_number("burstow.peak_at", self.peak_at, self.threshold, open_minimum=True)
        require_number("burstow.zero_at", self.zero_at, self.peak_at, open_minimum=True)
        require_number("burstow.peak", self.peak, 0.0)

    def constants(self) -> NDArray[np.float64]:
        """Return the constants as the array for `burstow_kernel`."""
        floor = 0.0 if self.clip_negative else -np.inf
        return np.array([self.threshold, self.peak_at, self.zero_at, self.peak, floor])


def burstow(T_gamma: ArrayLike, parameters: Burstow | None = None) -> float | Array:
    """Return the fraction of the rail's life to crack initiation that one axle pass uses [-].

    A sum of 1 means a visible crack.

    Parameters
    ----------
    T_gamma : array_like
        [N], not negative.
    parameters : Burstow
        Constants, rail grade R220/R260.

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        burstow_kernel, require_numbers("T_gamma", T_gamma, 0.0), constants=((parameters or Burstow()).constants(),)
    )
