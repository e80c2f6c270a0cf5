"""Multi-Hertzian contact: Hertz's ellipse at the smallest gap, and at secondary points that the first leaves (gutter concept).

The first ellipse presses a gutter into the surface. Inside, the gap is closed. Outside, it grows by Hertz's
displacement, which has a closed form on the line x = 0,

    u(y) = (p0 a b/E*) ∫_0^1 y (1 - c²) dc/(√(y² - b² c²) √(y² + (a² - b²) c²)),   |y| > b.              [D]

The remaining gap is h = g + u. Where it is still below the approach, the bodies would overlap. Every minimum of h there
that is not inside an ellipse already laid is a secondary contact. It is an ellipse with the approach delta - h and the
curvatures of h. The deepest comes first, and there are at most four in all. The loads add up.

[R]: the gutter is recalled from Pascal and Sauvage, Vehicle System Dynamics 22 (1993) 263, by way of the thesis. That
the half space deepens it outside the first ellipse is our reading. Known weaknesses: the first contact is not affected
by the others, nor these by each other. Ellipses may overlap, and the pressures add up there. The load steps where a
secondary point appears or disappears.
"""

import math

import numpy as np

from contact.core import entry, kernel
from contact.kernels.cubic import locate, slopes
from contact.kernels.hertz import local_factors
from contact.kernels.normal.curvature import floored, lateral_curvature
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Sample, Strip

#: A secondary contact with a smaller share of the approach is neglected.
_LEAST_SHARE = 1e-4

_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(12)


@entry
def _outside(y: float, a2: float, b2: float) -> float:
    """Return the displacement of Hertz's ellipse at distance |y| >= b, up to a constant factor."""
    total = 0.0
    for i in range(_GAUSS_X.size):
        c2 = (0.5 + 0.5 * _GAUSS_X[i]) ** 2
        total += _GAUSS_W[i] * (1.0 - c2) / math.sqrt((y * y - b2 * c2) * (y * y + (a2 - b2) * c2))
    return total * y


@kernel
def _add_gutter(y, n, point, delta, h):
    """Add the displacement of the first ellipse to the gap h."""
    a2, b2 = delta / (point.one_alpha * point.A), delta / (point.one_beta * point.B)
    b = math.sqrt(b2)
    at_edge = (delta - point.B * b2) / _outside(b, a2, b2)
    for i in range(n):
        away = abs(y[i] - point.y)
        outside = at_edge * _outside(max(away, b), a2, b2)  # compilers take the root inside too
        h[i] += delta - point.B * away * away if away * away <= b2 else outside


@kernel
def _secondary_point(y, h, n, edges, count):
    """Return position and value of the smallest minimum of h outside the ellipses, by a parabola through three samples."""
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
    """Fill the strips of ellipse k with half curvatures (A, B) at `place` = (y, x). Return its load [N]."""
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
        strips[Strip.LN_ASPECT, j], strips[Strip.PATCH, j], strips[Strip.OFFSET, j] = log_aspect, k, 0.0
    return 4.0 / 3.0 * modulus * d * b / nr


@kernel
def multi_hertz(sep, delta, modulus, point, across, work, strips, edges):
    """Fill `strips` at approach delta. Return load [N] and number of strips."""
    y, g, A, xc, n = sep.y, sep.g, sep.A, sep.x_c, sep.y.size
    h, m = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE]
    for i in range(n):
        h[i] = g[i] - point.g
    count, N, centre, d, B = 0, 0.0, point.y, delta, point.B
    while count < MAX_PATCHES and d > _LEAST_SHARE * delta:
        k = locate(y, n, centre, 0)
        t = (centre - y[k]) / (y[k + 1] - y[k])
        if count > 0:
            left, below, above = lateral_curvature(y, h, m, n, k, point.base, 0, 0)
            right, _, _ = lateral_curvature(y, h, m, n, k + 1, point.base, below, above)
            B = floored((1.0 - t) * left + t * right, point.floor)
        A_here, x_c = (1.0 - t) * A[k] + t * A[k + 1], (1.0 - t) * xc[k] + t * xc[k + 1]
        N += lay_ellipse(strips, count, d, (A_here, B), (centre, x_c), modulus, across, edges)
        if count == 0:
            _add_gutter(y, n, point, delta, h)
            slopes(y, h, n, m)
        count += 1
        centre, least = _secondary_point(y, h, n, edges, count)
        d = delta - least
    return N, count * across.nodes.size


@kernel
def beyond(y, n, edges, count):
    """Return whether one of the `count` ellipses, in any order, goes beyond the data."""
    outside = False
    for k in range(count):
        outside = outside or edges[2 * k] < y[0] or edges[2 * k + 1] > y[n - 1]
    return outside
