"""Shakedown limits, the curves of the shakedown map (Johnson)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, require_numbers

#: Rows of utilised friction and shakedown limit p0/k below the surface, for a line contact: max |τxz| with free residual
#: stresses. Computed by this project with McEwen's fields [V] (constants.md 5); it agrees with Johnson's 4.00 without
#: friction.
LINE = np.array(
    [
        *((0.0, 4.00), (0.05, 3.77), (0.1, 3.56), (0.15, 3.38), (0.2, 3.20), (0.25, 3.04), (0.3, 2.90), (0.35, 2.77)),
        (0.367, 2.72),
    ]
)
#: Half length over half width → p0/k below the surface without friction, from the orthogonal shear on y = 0 in Hertz's
#: ellipse, computed by this project [V]. The line contact has the ratio 0. For the circle 4.7 is recalled.
ELLIPSE = {0.1: 4.01, 0.2: 4.04, 0.5: 4.22, 1.0: 4.68}


def shakedown_limit(utilisation: ArrayLike) -> float | Array:
    """Return the largest peak pressure over shear yield stress, p0/k [-], for which a line contact shakes down.

    The result is the smaller of two limits: that below the surface (`LINE`), and that at the surface, 1/utilisation, where
    `fatigue_index` is zero. They meet at 0.367. Patches that are not long in the lateral direction have a higher limit below
    the surface. Without friction it is 4.68 for a circle instead of 4.00 (`ELLIPSE`). With friction no value was found; the
    line contact is on the safe side.

    Parameters
    ----------
    utilisation : array_like
        Utilised friction √(Fx² + Fy²)/N [-], not negative.

    Raises
    ------
    ContactError
        For values outside their range.
    """
    mu = require_numbers("utilisation", utilisation, 0.0)
    surface = np.divide(1.0, mu, out=np.full_like(mu, np.inf), where=mu > LINE[-1, 0])
    limit = np.minimum(np.interp(mu, *LINE.T), surface)
    return limit if limit.ndim else float(limit)
