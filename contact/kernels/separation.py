"""Samples of a separation of constant curvatures."""

import math

from contact.core import entry
from contact.kernels.arrays import Numbers

#: Number of samples of a separation with constant curvatures.
HERTZIAN_POINTS = 41

#: Gap at both ends of these samples [m], and over the radius 1/(A + B) of large bodies; more than steel bears.
_HERTZIAN_GAP, _OF_RADIUS = 1e-3, 1e-3


@entry
def fill_hertzian(A: float, B: float, y: Numbers, g: Numbers) -> None:
    """Fill `y` and `g` [m] with samples of g = B·y² up to a gap of 1 mm, or of a thousandth of the radius 1/(A + B)."""
    n, highest = y.size, max(_HERTZIAN_GAP, _OF_RADIUS / (A + B))
    for i in range(n):
        y[i] = math.sqrt(highest / B) * (2.0 * i / (n - 1) - 1.0)
        g[i] = B * y[i] * y[i]
