"""Multi-Hertzian contact: Hertz's ellipse at the least point, and at secondary points that the first leave (gutter concept).

The first ellipse presses a gutter into the surface: inside, the gap is closed; outside, it has grown by Hertz's displacement,
which has a closed form on the line x = 0,

    u(y) = (p0 a b/E*) ∫_0^1 y (1 - c²) dc/(√(y² - b² c²) √(y² + (a² - b²) c²)),   |y| > b.              [D]

Where what is left of the gap, h = g + u, is still below the approach, the bodies would overlap: every least point of h there,
but for those inside an ellipse already laid, is a secondary contact, an ellipse with the approach delta - h and the curvatures
of h; the deepest first, four in all. The loads add up.

[R]: the gutter is recalled from Pascal and Sauvage, Vehicle System Dynamics 22 (1993) 263, by way of the thesis; that the half
space deepens it outside the first ellipse is our reading. The first contact does not feel the others nor they each other, and
ellipses may overlap, where the pressures add up: known weaknesses. The load steps where a secondary point comes or goes.
"""

import math

import numpy as np

from contact._jit import kernel
from contact.kernels.cubic import locate, slopes
from contact.kernels.hertz import local_factors
from contact.kernels.layout import MAX_PATCHES, Sample, Strip
from contact.kernels.normal.analyn import floored, lateral_curvature

#: A secondary contact with less of the approach than this is none.
_LEAST_SHARE = 1e-4

_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(12)


@kernel
def _outside(y, a2, b2):
    """Displacement of Hertz's ellipse at distance |y| >= b, but for a factor."""
    total = 0.0
    for i in range(_GAUSS_X.size):
        c2 = (0.5 + 0.5 * _GAUSS_X[i]) ** 2
        total += _GAUSS_W[i] * (1.0 - c2) / math.sqrt((y * y - b2 * c2) * (y * y + (a2 - b2) * c2))
    return total * y


@kernel
def _press(y, n, point, delta, h):
    """Add the displacement of the first ellipse to the gap h."""
    a2, b2 = delta / (point.one_alpha * point.A), delta / (point.one_beta * point.B)
    at_edge = (delta - point.B * b2) / _outside(math.sqrt(b2), a2, b2)
    for i in range(n):
        away = abs(y[i] - point.y)
        h[i] += delta - point.B * away * away if away * away <= b2 else at_edge * _outside(away, a2, b2)


@kernel
def _secondary(y, h, n, edges, count):
    """Position and value of the least point of h outside the ellipses, on a parabola through three samples."""
    y_best, best = 0.0, math.inf
    for i in range(1, n - 1):
        if h[i] > h[i - 1] or h[i] >= h[i + 1]:
            continue
        free = True
        for k in range(count):
            if edges[2 * k] <= y[i] <= edges[2 * k + 1]:
                free = False
        if not free:
            continue
        left, right = y[i] - y[i - 1], y[i + 1] - y[i]
        d0, d1 = (h[i] - h[i - 1]) / left, (h[i + 1] - h[i]) / right
        curvature = (d1 - d0) / (left + right)
        slope = (right * d0 + left * d1) / (left + right)
        value = h[i] - 0.25 * slope * slope / curvature if curvature > 0.0 else h[i]
        if value < best:
            y_best, best = y[i] - 0.5 * slope / curvature if curvature > 0.0 else y[i], value
    return y_best, best


@kernel
def lay_ellipse(strips, k, d, curvatures, place, modulus, across, edges):
    """Write the strips of ellipse k, half curvatures (A, B) at `place` = (y, x), and return its load."""
    A, B = curvatures
    centre, x_c = place
    nodes, weights = across.nodes, across.weights
    one_alpha, one_beta, nr, log_aspect = local_factors(A, B)
    b = math.sqrt(d / (one_beta * B))
    edges[2 * k], edges[2 * k + 1] = centre - b, centre + b
    for i in range(nodes.size):
        j = k * nodes.size + i
        depth = d * (1.0 - nodes[i]) * (1.0 + nodes[i])
        strips[Strip.Y, j], strips[Strip.DY, j], strips[Strip.XC, j] = centre + b * nodes[i], b * weights[i], x_c
        strips[Strip.A, j] = math.sqrt(depth / (one_alpha * A))
        strips[Strip.P0, j] = 2.0 * modulus / math.pi * math.sqrt(depth * one_alpha * A) / nr
        strips[Strip.ASPECT, j], strips[Strip.PATCH, j] = log_aspect, k
    return 4.0 / 3.0 * modulus * d * b / nr


@kernel
def multi_hertz(sep, delta, modulus, point, across, work, strips, edges):
    """Fill `strips` at approach delta; return load and number of strips."""
    y, g, A, xc, n = sep.y, sep.g, sep.A, sep.x_c, sep.y.size
    h, m = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE]
    for i in range(n):
        h[i] = g[i] - point.g
    count, N, centre, d, B = 0, 0.0, point.y, delta, point.B
    while count < MAX_PATCHES and d > _LEAST_SHARE * delta:
        k = locate(y, n, centre, 0)
        t = (centre - y[k]) / (y[k + 1] - y[k])
        if count > 0:
            left, below, above = lateral_curvature(y, h, m, n, k, 0, 0)
            right, _, _ = lateral_curvature(y, h, m, n, k + 1, below, above)
            B = floored((1.0 - t) * left + t * right)
        A_here, x_c = (1.0 - t) * A[k] + t * A[k + 1], (1.0 - t) * xc[k] + t * xc[k + 1]
        N += lay_ellipse(strips, count, d, (A_here, B), (centre, x_c), modulus, across, edges)
        if count == 0:
            _press(y, n, point, delta, h)
            slopes(y, h, n, m)
        count += 1
        centre, least = _secondary(y, h, n, edges, count)
        d = delta - least
    return N, count * across.nodes.size


@kernel
def beyond(y, n, edges, count):
    """Whether one of the `count` ellipses, in any order, goes beyond the data."""
    found = False
    for k in range(count):
        found = found or edges[2 * k] < y[0] or edges[2 * k + 1] > y[n - 1]
    return found
