"""Lay strips inside the patches where a penetration function is positive.

The function is known at the samples of the separation; between them it is the cubic through values and three-point slopes,
which reproduces a parabola exactly. Patches are found at any approach, also when they are narrower than a sample interval.
"""

import math

from contact._jit import kernel
from contact.kernels.layout import MAX_PATCHES, Strip


@kernel
def slopes(y, f, n, out):
    """Three-point slopes of f over y, exact for a parabola; one-sided at the ends."""
    for i in range(1, n - 1):
        h0, h1 = y[i] - y[i - 1], y[i + 1] - y[i]
        out[i] = (h1 * (f[i] - f[i - 1]) / h0 + h0 * (f[i + 1] - f[i]) / h1) / (h0 + h1)
    out[0] = 2.0 * (f[1] - f[0]) / (y[1] - y[0]) - out[1]
    out[n - 1] = 2.0 * (f[n - 1] - f[n - 2]) / (y[n - 1] - y[n - 2]) - out[n - 2]


@kernel
def cubic(h, f0, m0, f1, m1, t):
    """Cubic Hermite interpolant on an interval of length h at t in [0, 1]."""
    w = 1.0 - t
    return w * w * ((1.0 + 2.0 * t) * f0 + h * t * m0) + t * t * ((1.0 + 2.0 * w) * f1 - h * w * m1)


@kernel
def interval_minimum(h, f0, m0, f1, m1):
    """Position t in [0, 1] and value of the least point of the cubic on its interval."""
    best_t, best = 0.0, f0
    if f1 < f0:
        best_t, best = 1.0, f1
    if m0 < 0.0 and m1 > 0.0:  # derivative: a t² + b t + c with c < 0 < a + b + c, one root inside
        a = 3.0 * (2.0 * (f0 - f1) + h * (m0 + m1))
        b = 2.0 * (3.0 * (f1 - f0) - h * (2.0 * m0 + m1))
        c = h * m0
        root = math.sqrt(max(b * b - 4.0 * a * c, 0.0))
        t = -2.0 * c / (b + root) if b + root > 0.0 else 0.5
        if 0.0 < t < 1.0:
            value = cubic(h, f0, m0, f1, m1, t)
            if value < best:
                best_t, best = t, value
    return best_t, best


@kernel
def least_point(y, f, m, n):
    """Position and value of the least point of the interpolant."""
    k = 0
    for i in range(1, n):
        if f[i] < f[k]:
            k = i
    y_best, best = y[k], f[k]
    for i in range(n - 1):
        if m[i] >= 0.0 or m[i + 1] <= 0.0:
            continue
        h = y[i + 1] - y[i]
        t, value = interval_minimum(h, f[i], m[i], f[i + 1], m[i + 1])
        if value < best:
            y_best, best = y[i] + t * h, value
    return y_best, best


@kernel
def _crossing(h, f0, m0, f1, m1, level, low, high):
    """Position t where the cubic passes `level` between `low` and `high`: bracketed Newton, capped."""
    # coefficients of the cubic in t
    d = f1 - f0
    c3, c2, c1 = h * (m0 + m1) - 2.0 * d, 3.0 * d - h * (2.0 * m0 + m1), h * m0
    c0 = f0 - level
    low_is_negative = c0 + low * (c1 + low * (c2 + low * c3)) < 0.0
    t = 0.5 * (low + high)
    if c1 != 0.0 or d != 0.0:
        guess = -c0 / d if d != 0.0 else t
        if low < guess < high:
            t = guess
    for _ in range(60):
        value = c0 + t * (c1 + t * (c2 + t * c3))
        if (value < 0.0) == low_is_negative:
            low = t
        else:
            high = t
        slope = c1 + t * (2.0 * c2 + 3.0 * t * c3)
        new = t - value / slope if slope != 0.0 else 0.5 * (low + high)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-15:
            return new
        t = new
    return t


@kernel
def find_patches(y, G, m, n, delta, edges):
    """Intervals of the `n` samples y on which G(y) < delta, into edges[2k], edges[2k+1]; return their number.

    There are at most MAX_PATCHES; further ones are merged into the last. A patch that reaches the end of the data ends there.
    """
    count = 0
    inside = G[0] < delta
    if inside:
        edges[0] = y[0]
    for i in range(n - 1):
        below = G[i + 1] < delta
        if below == inside and (below or not m[i] < 0.0 < m[i + 1]):
            continue
        h = y[i + 1] - y[i]
        if below != inside:
            at = y[i] + h * _crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, 0.0, 1.0)
            if below:
                if count < MAX_PATCHES:
                    edges[2 * count] = at
            else:
                edges[2 * min(count, MAX_PATCHES - 1) + 1] = at
                count += 1
            inside = below
        else:  # perhaps a patch narrower than the sample interval
            t, least = interval_minimum(h, G[i], m[i], G[i + 1], m[i + 1])
            if least < delta:
                if count < MAX_PATCHES:
                    edges[2 * count] = y[i] + h * _crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, 0.0, t)
                right = y[i] + h * _crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, t, 1.0)
                edges[2 * min(count, MAX_PATCHES - 1) + 1] = right
                count += 1
    if inside:
        edges[2 * min(count, MAX_PATCHES - 1) + 1] = y[n - 1]
        count += 1
    return min(count, MAX_PATCHES)


@kernel
def at_end(y, n, edges, count):
    """Whether one of the `count` patches reaches the end of the data."""
    return count > 0 and (edges[0] <= y[0] or edges[2 * count - 1] >= y[n - 1])


@kernel
def lay_strips(edges, count, across, strips):
    """Write y, dy and the label of a panel of strips for every patch; return the number of strips."""
    nodes, weights, n = across.nodes, across.weights, across.nodes.size
    for k in range(count):
        centre = 0.5 * (edges[2 * k] + edges[2 * k + 1])
        half = 0.5 * (edges[2 * k + 1] - edges[2 * k])
        for i in range(n):
            strips[Strip.Y, k * n + i] = centre + half * nodes[i]
            strips[Strip.DY, k * n + i] = half * weights[i]
            strips[Strip.PATCH, k * n + i] = k
    return count * n


@kernel
def locate(y, n, at, start):
    """Index i with y[i] <= at <= y[i+1], found by walking from `start`; clamped to the first and last interval."""
    i = start
    while i > 0 and y[i] > at:
        i -= 1
    while i < n - 2 and y[i + 1] < at:
        i += 1
    return i
