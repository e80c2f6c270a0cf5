"""Strips inside the patches where a penetration function is positive.

The function is known at the samples of the separation. Between them it is the cubic through values and three-point
slopes, which reproduces a parabola exactly. Patches are found at any approach, even if they are narrower than a sample
interval.
"""

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Numbers
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Strip


@entry
def least_point(y: Numbers, f: Numbers, m: Numbers, n: int) -> tuple[float, float]:
    """Return position and value of the smallest value of the interpolant."""
    k = 0
    for i in range(1, n):
        if f[i] < f[k]:
            k = i
    y_best, best = y[k], f[k]
    for i in range(n - 1):
        if m[i] >= 0.0 or m[i + 1] <= 0.0:
            continue
        h = y[i + 1] - y[i]
        t, value = cubic.least(h, f[i], m[i], f[i + 1], m[i + 1])
        if value < best:
            y_best, best = y[i] + t * h, value
    return y_best, best


@entry
def find_patches(y: Numbers, G: Numbers, m: Numbers, n: int, delta: float, edges: Numbers) -> int:
    """Fill edges[2k], edges[2k+1] with the intervals of the `n` samples y on which G(y) < delta. Return their number.

    There are at most MAX_PATCHES; further ones are merged into the last. A patch that reaches the end of the data ends
    there.
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
            at = y[i] + h * cubic.crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, 0.0, 1.0)
            if below:
                if count < MAX_PATCHES:
                    edges[2 * count] = at
            else:
                edges[2 * min(count, MAX_PATCHES - 1) + 1] = at
                count += 1
            inside = below
        else:  # perhaps a patch narrower than the sample interval
            t, least = cubic.least(h, G[i], m[i], G[i + 1], m[i + 1])
            if least < delta:
                if count < MAX_PATCHES:
                    edges[2 * count] = y[i] + h * cubic.crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, 0.0, t)
                right = y[i] + h * cubic.crossing(h, G[i], m[i], G[i + 1], m[i + 1], delta, t, 1.0)
                edges[2 * min(count, MAX_PATCHES - 1) + 1] = right
                count += 1
    if inside:
        edges[2 * min(count, MAX_PATCHES - 1) + 1] = y[n - 1]
        count += 1
    return min(count, MAX_PATCHES)


@kernel
def at_end(y, n, edges, count):
    """Return whether one of the `count` patches reaches the end of the data."""
    return count > 0 and (edges[0] <= y[0] or edges[2 * count - 1] >= y[n - 1])


@kernel
def lay_strips(edges, count, across, strips):
    """Fill y, dy and the patch number of a panel of strips for every patch. Return the number of strips."""
    nodes, weights, n = across.nodes, across.weights, across.nodes.size
    for k in range(count):
        centre = 0.5 * (edges[2 * k] + edges[2 * k + 1])
        half = 0.5 * (edges[2 * k + 1] - edges[2 * k])
        for i in range(n):
            strips[Strip.Y, k * n + i] = centre + half * nodes[i]
            strips[Strip.DY, k * n + i] = half * weights[i]
            strips[Strip.PATCH, k * n + i], strips[Strip.OFFSET, k * n + i] = k, 0.0
    return count * n
