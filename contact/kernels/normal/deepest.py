"""The smallest gap of a separation with the constants of Hertz's contact there."""

import math
from typing import NamedTuple

from contact.core import kernel
from contact.kernels.cubic import locate, slopes
from contact.kernels.hertz import local_factors
from contact.kernels.normal.curvature import base_of, floor_of, floored, half_width, lateral_curvature
from contact.kernels.normal.lay import least_point
from contact.kernels.rows import Sample

#: Approach over the width of the data below which bodies do not touch: gap and approach are the same to within round-off.
NO_OVERLAP = 1e-14
#: Number of parabolas like the overlap, one after the other, in the first guess of an approach.
_PARABOLAS = 2


class Deepest(NamedTuple):
    """Position and value of the smallest gap, the half curvatures there and their Hertz factors (`hertz.local_factors`).

    `base` and `floor` are those of curvatures at the same approach (`curvature`).
    """

    y: float
    g: float
    A: float
    B: float
    one_alpha: float
    one_beta: float
    nr: float
    log_aspect: float
    base: float
    floor: float


@kernel
def lowest(y, g, n, work):
    """Return position and value of the smallest gap. Fill GAP_SLOPE of `work` with the slopes of the gap."""
    slopes(y, g, n, work[Sample.GAP_SLOPE])
    return least_point(y, g, work[Sample.GAP_SLOPE], n)


@kernel
def touches(y, n, delta):
    """Return whether an approach above first touch is more than round-off."""
    return delta > NO_OVERLAP * (y[n - 1] - y[0])


@kernel
def deepest(y, g, A, n, place, delta, work):
    """Return the smallest gap, at `place` as `lowest` gives it, with its constants at the approach `delta` > 0."""
    m = work[Sample.GAP_SLOPE]
    y_least, g_least = place
    half = half_width(y, g, m, n, g_least, delta)
    floor = floor_of(half, delta)
    k = locate(y, n, y_least, 0)
    t = (y_least - y[k]) / (y[k + 1] - y[k])
    A0 = (1.0 - t) * A[k] + t * A[k + 1]
    base = base_of(half, A0, delta)
    B_left, below, above = lateral_curvature(y, g, m, n, k, base, 0, 0)
    B_right, _, _ = lateral_curvature(y, g, m, n, k + 1, base, below, above)
    B0 = floored((1.0 - t) * B_left + t * B_right, floor)
    one_alpha, one_beta, nr, log_aspect = local_factors(A0, B0)
    return Deepest(y_least, g_least, A0, B0, one_alpha, one_beta, nr, log_aspect, base, floor)


@kernel
def unit_load(point, modulus):
    """Return Hertz's load at unit approach [N/m^1.5]; N = unit·delta^(3/2).

    It follows from a² = delta/((1+alpha)A) and p0 = 2 E* delta/(pi n r a).
    """
    return 4.0 / 3.0 * modulus / (point.nr * math.sqrt(point.one_beta * point.B))


@kernel
def first_approach(y, g, A, n, place, load, modulus, work):
    """Return the approach at which a parabola like the overlap carries `load` > 0 (Hertz), to begin a search with.

    An approach within round-off may be any other one there.
    """
    A0 = A[locate(y, n, place[0], 0)]
    delta = approach_of(A0, A0, load, modulus)
    for _ in range(_PARABOLAS):
        if not touches(y, n, delta):
            break
        half = half_width(y, g, work[Sample.GAP_SLOPE], n, place[1], delta)
        delta = approach_of(A0, delta / (half * half), load, modulus)
    return delta


@kernel
def approach_of(A, B, load, modulus):
    """Return the approach [m] at which Hertz's contact with half curvatures A, B carries a load."""
    _, one_beta, nr, _ = local_factors(A, B)
    return (0.75 * load / modulus * nr * math.sqrt(one_beta * B)) ** (2.0 / 3.0)
