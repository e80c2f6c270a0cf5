"""Samples of a separation of constant curvatures."""

import math

from contact.core import entry
from contact.kernels.arrays import Numbers

#: Number of samples of a separation with constant curvatures.
HERTZIAN_POINTS = 41

#: Gap at both ends of these samples [m].
_HERTZIAN_GAP = 1e-3


@entry
def fill_hertzian(B: float, y: Numbers, g: Numbers) -> None:
    """Fill `y` and `g` [m] with samples of g = B·y² up to a gap of 1 mm."""
    n = y.size
    for i in range(n):
        y[i] = math.sqrt(_HERTZIAN_GAP / B) * (2.0 * i / (n - 1) - 1.0)
        g[i] = B * y[i] * y[i]
