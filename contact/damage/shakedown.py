"""Limits of shakedown, the lines of the shakedown map (Johnson)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from contact.damage._check import Array, numbers

#: Shakedown limit p0/k below the surface over the utilised friction: line contact, max |τxz| with free residual stresses. Own
#: computation with McEwen's fields [V] (constants.md 5), in agreement with Johnson's 4.00 at no friction.
LINE = np.array(
    [
        *((0.0, 4.00), (0.05, 3.77), (0.1, 3.56), (0.15, 3.38), (0.2, 3.20), (0.25, 3.04), (0.3, 2.90), (0.35, 2.77)),
        (0.367, 2.72),
    ]
)
#: Half length over half width → p0/k below the surface without friction, orthogonal shear on y = 0 in Hertz's ellipse: own
#: computation [V]. The line is 0; that of the circle is recalled as 4.7.
ELLIPSE = {0.1: 4.01, 0.2: 4.04, 0.5: 4.22, 1.0: 4.68}


def shakedown_limit(utilisation: ArrayLike) -> float | Array:
    """Peak pressure over shear yield stress, p0/k, up to which a line contact shakes down [-].

    The lesser of the limit below the surface (`LINE`) and that at the surface, 1/utilisation, where `fatigue_index` is zero;
    they meet at 0.367. Patches that are not long across bear more below the surface: without friction a circle 4.68
    instead of 4.00 (`ELLIPSE`); with friction no value was found, so the line is the safe side.

    Parameters
    ----------
    utilisation : array_like
        Utilised friction √(Fx² + Fy²)/N [-], not negative.

    Raises
    ------
    ContactError
        For values outside their range.
    """
    mu = numbers("utilisation", utilisation, 0.0)
    with np.errstate(divide="ignore"):
        surface = np.where(mu > LINE[-1, 0], 1.0 / mu, np.inf)
    limit = np.minimum(np.interp(mu, *LINE.T), surface)
    return limit if limit.ndim else float(limit)
