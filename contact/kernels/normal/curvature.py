"""Curvature of the gap across the rolling direction, averaged over a base that follows the contact (theory.md 3.3).

Two rules of elasticity leave little choice. It has no length of its own: bodies of 1:k under loads of 1:k² have the same
pressures. And it is linear: a gap k times as high under k times the load has the same patch. So the width over which a method
averages the curvature, and the curvature that counts as flat, follow from half width and half length of the overlap,

    w = 3/(4 delta) ∫ max(delta - g, 0) dy,    l = √(delta/A),    base = .44/√(1/w² + 1/l²),    floor = .2 delta/w².

w is half the width of the overlap and delta/w² its curvature, both exact for a parabola. The integral grows with the power
3/2 of the depth of a new lobe, so nothing jumps where one appears. Of bases .4 w, .26 l, .32 √(w l), those with 1/w + 1/l and
the one above, it is nearest to CONTACT on sets D and O and to the strip half space on 500 random patches; .32 √(w l) and
.0326 √(w/A), which the second rule excludes, averaged flanges too bluntly, and .4 w saw the joints of arcs too sharply. A
shorter base, .40, has better loads and worse pressures. On a tread under 80 kN it is 2.2 mm.
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.cubic import locate

#: Half base of the second difference, over 1/√(1/w² + 1/l²).
BASE_SHARE = 0.44
#: Smallest half curvature B, over that of the overlap. Negative and vanishing curvature count as this value. A parabola has
#: more than twice as much, so it keeps its own.
FLOOR_SHARE = 0.2
#: Least half width of an overlap, over that of the data. It is round-off.
_NARROWEST = 1e-9


@kernel
def overlap(y, g, m, n, level):
    """Return the integral of max(level - g, 0) over y [m²]; g is the cubic interpolant with the slopes m."""
    area = 0.0
    for i in range(n - 1):
        g0, g1, m0, m1 = g[i], g[i + 1], m[i], m[i + 1]
        h = y[i + 1] - y[i]
        if g0 < level and g1 < level:
            area += h * (level - 0.5 * (g0 + g1) - h * (m0 - m1) / 12.0)
        elif g0 < level:
            t = cubic.crossing(h, g0, m0, g1, m1, level, 0.0, 1.0)
            area += h * t * level - cubic.integral(h, g0, m0, g1, m1, t)
        elif g1 < level:
            t = cubic.crossing(h, g0, m0, g1, m1, level, 0.0, 1.0)
            whole = 0.5 * h * (g0 + g1) + h * h * (m0 - m1) / 12.0
            area += h * (1.0 - t) * level - (whole - cubic.integral(h, g0, m0, g1, m1, t))
        elif m0 < 0.0 < m1:  # perhaps an overlap narrower than the interval
            at, least = cubic.least(h, g0, m0, g1, m1)
            if least < level:
                first = cubic.crossing(h, g0, m0, g1, m1, level, 0.0, at)
                last = cubic.crossing(h, g0, m0, g1, m1, level, at, 1.0)
                inside = cubic.integral(h, g0, m0, g1, m1, last) - cubic.integral(h, g0, m0, g1, m1, first)
                area += h * (last - first) * level - inside
    return area


@kernel
def half_width(y, g, m, n, g_least, delta):
    """Return half the width of the overlap [m] at the approach `delta` > 0 above first touch."""
    return max(0.75 * overlap(y, g, m, n, g_least + delta) / delta, _NARROWEST * (y[n - 1] - y[0]), 1e-150)


@kernel
def base_of(half, A, delta):
    """Return the half base [m] for an overlap of half width `half` at the approach `delta` [m]; A is g''/2 along x [1/m]."""
    return BASE_SHARE * half / math.sqrt(1.0 + half * half * A / delta)


@kernel
def floor_of(half, delta):
    """Return the smallest half curvature [1/m] for an overlap of half width `half` [m] at the approach `delta`."""
    return FLOOR_SHARE * delta / (half * half)


@kernel
def floored(B, floor):
    """Return max(B, floor) [1/m] with its corner rounded to a continuous slope. It is B from twice the floor on."""
    if 2.0 * floor <= B:
        return B
    if B <= 0.0:
        return floor
    return floor + B * B / (4.0 * floor)


@kernel
def lateral_curvature(y, g, m, n, i, base, below, above):
    """Return B = g''/2 [1/m] at sample i and two indices for the neighbouring sample.

    B is a second difference of the interpolated gap over ±`base`, or the next samples if they are further. That is g''
    averaged with a triangle. It needs no second derivative of noisy profiles, and is exact for a parabola. At the ends of the
    data the base is shifted inwards. `below` and `above` are any indices to search from.
    """
    base = max(base, 0.5 * (y[min(i + 1, n - 1)] - y[max(i - 1, 0)]))
    base = min(base, 0.5 * (y[n - 1] - y[0]))
    centre = min(max(y[i], y[0] + base), y[n - 1] - base)
    middle = g[i]
    if centre != y[i]:
        k = locate(y, n, centre, 0)
        h = y[k + 1] - y[k]
        middle = cubic.value(h, g[k], m[k], g[k + 1], m[k + 1], (centre - y[k]) / h)
    below = locate(y, n, centre - base, below)
    h = y[below + 1] - y[below]
    left = cubic.value(h, g[below], m[below], g[below + 1], m[below + 1], (centre - base - y[below]) / h)
    above = locate(y, n, centre + base, above)
    h = y[above + 1] - y[above]
    right = cubic.value(h, g[above], m[above], g[above + 1], m[above + 1], (centre + base - y[above]) / h)
    return 0.5 * (left - 2.0 * middle + right) / max(base * base, 1e-300), below, above
