"""The smallest gap of a separation with the constants of Hertz's contact there."""

import math
from typing import NamedTuple

from contact.core import kernel
from contact.kernels.cubic import locate, slopes
from contact.kernels.hertz import local_factors
from contact.kernels.normal.analyn import floored, lateral_curvature
from contact.kernels.normal.lay import least_point
from contact.kernels.rows import Sample


class Deepest(NamedTuple):
    """Position and value of the smallest gap, the half curvatures there and their Hertz factors (`hertz.local_factors`)."""

    y: float
    g: float
    A: float
    B: float
    one_alpha: float
    one_beta: float
    nr: float
    log_aspect: float


@kernel
def deepest(y, g, A, n, work):
    """Return the smallest gap with its constants. Fill GAP_SLOPE of `work` with the slopes of the gap."""
    m = work[Sample.GAP_SLOPE]
    slopes(y, g, n, m)
    y_least, g_least = least_point(y, g, m, n)
    k = locate(y, n, y_least, 0)
    t = (y_least - y[k]) / (y[k + 1] - y[k])
    A0 = (1.0 - t) * A[k] + t * A[k + 1]
    B_left, below, above = lateral_curvature(y, g, m, n, k, 0, 0)
    B_right, _, _ = lateral_curvature(y, g, m, n, k + 1, below, above)
    B0 = floored((1.0 - t) * B_left + t * B_right)
    one_alpha, one_beta, nr, log_aspect = local_factors(A0, B0)
    return Deepest(y_least, g_least, A0, B0, one_alpha, one_beta, nr, log_aspect)


@kernel
def unit_load(point, modulus):
    """Return Hertz's load at unit approach [N/m^1.5]; N = unit·delta^(3/2).

    It follows from a² = delta/((1+alpha)A) and p0 = 2 E* delta/(pi n r a).
    """
    return 4.0 / 3.0 * modulus / (point.nr * math.sqrt(point.one_beta * point.B))
