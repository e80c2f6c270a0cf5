"""Semi-Winkler (Telliskivi 2004): springs that are also tied to their neighbours, a foundation with two constants.

    k w - k l² (w_xx + w_yy) = p,   w = delta - g - A x² in the patch, decaying as exp(-distance/l) outside

The neighbours draw the surface down around the patch, so the patch is smaller than Winkler's. Its edge is where the
slope of w continues into the decay, w = l |grad w|. With g'² = 4 B g, exact for a parabola,

    delta - g - A a² = 2 l √(A² a² + B g)      half length of the strip at y,
    g < eps delta,  √eps = √(1 + l² B/delta) - √(l² B/delta)      width of the patch,
    p = k [delta - g - A x² + 2 l² (A + B)]

l and k are not Telliskivi's, who fitted his springs to one contact ([R]: recalled from Wear 256 (2004) 817). Here l is
half the mean semi-axis √(a b) of Hertz's ellipse at the smallest gap, which gives Hertz's patch for A = B. k gives
Hertz's load at every approach. Both scale with the patch. B is smoothed and floored as in ANALYN.

Strips carry a semi-ellipse with the length and load of the parabola on its pedestal.
"""

import math

from contact.core import entry, kernel
from contact.kernels.cubic import locate, slopes
from contact.kernels.normal.curvature import floored, lateral_curvature
from contact.kernels.normal.deepest import unit_load
from contact.kernels.normal.lay import least_point
from contact.kernels.rows import Sample, Strip

#: Row of `work` that holds B(y).
_B = Sample.SHARE


@kernel
def _decay_length(point):
    """Return the decay length of the foundation over √delta [√m]: half of √(a b)/√delta."""
    return 0.5 / math.sqrt(math.sqrt(point.one_alpha * point.A * point.one_beta * point.B))


@entry
def _share(B: float, decay: float) -> float:
    """Return the share of the approach at which the gap is cut."""
    u = decay * decay * B
    return (math.sqrt(1.0 + u) - math.sqrt(u)) ** 2


@kernel
def prepare(y, g, A, n, point, work):
    """Fill effective gap, A and B of all samples."""
    decay = _decay_length(point)
    below, above = 0, 0
    for i in range(n):
        B, below, above = lateral_curvature(y, g, work[Sample.GAP_SLOPE], n, i, point.base, below, above)
        B = floored(B, point.floor)
        work[_B, i], work[Sample.STRETCHED_A, i] = B, A[i]
        work[Sample.EFFECTIVE_GAP, i] = (g[i] - point.g) / _share(B, decay)
    slopes(y, work[Sample.EFFECTIVE_GAP], n, work[Sample.EFFECTIVE_SLOPE])
    _, least = least_point(y, work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE], n)
    for i in range(n):  # the smallest value of the interpolated product may differ from zero
        work[Sample.EFFECTIVE_GAP, i] -= least


@entry
def _strip(gap: float, A: float, B: float, delta: float, length: float) -> tuple[float, float]:
    """Return the half length of a strip [m], and its load over 2 a k."""
    depth = delta - gap
    side = 4.0 * length * length * B * gap
    root = math.sqrt(4.0 * length * length * A * (depth + length * length * A) + side)
    a2 = max(depth * depth - side, 0.0) / (A * (depth + 2.0 * A * length * length + root))
    return math.sqrt(a2), depth - A * a2 / 3.0 + 2.0 * length * length * (A + B)


@kernel
def semi_winkler(sep, delta, modulus, point, across, work, strips, n_strips):
    """Set half lengths and pressures of strips from the depths that `cut` left in P0."""
    y, A, n = sep.y, sep.A, sep.y.size
    nodes, weights = across.nodes, across.weights
    decay = _decay_length(point)
    length = decay * math.sqrt(delta)
    # k such that the ellipse at the smallest gap carries Hertz's load
    volume, gap_at_edge = 0.0, _share(point.B, decay) * delta
    for i in range(nodes.size):
        a, mean = _strip(gap_at_edge * nodes[i] * nodes[i], point.A, point.B, delta, length)
        volume += 2.0 * a * mean * weights[i] * math.sqrt(gap_at_edge / point.B)
    k = unit_load(point, modulus) * delta * math.sqrt(delta) / volume
    j = 0
    for i in range(n_strips):
        at = strips[Strip.Y, i]
        j = locate(y, n, at, j)
        t = (at - y[j]) / (y[j + 1] - y[j])
        B = (1.0 - t) * work[_B, j] + t * work[_B, j + 1]
        gap = max(delta - strips[Strip.P0, i], 0.0) * _share(B, decay)
        a, mean = _strip(gap, (1.0 - t) * A[j] + t * A[j + 1], B, delta, length)
        strips[Strip.A, i] = a
        strips[Strip.P0, i] = 4.0 / math.pi * k * mean if a > 0.0 else 0.0
