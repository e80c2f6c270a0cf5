"""Violation of the half space's contact conditions by a pressure: an error estimate for every normal method.

Inside the patch the gap must close: displacement + undeformed gap = approach. Outside, the bodies must not overlap. The
semi-elliptic pressures of all strips displace the surface by U of `influence`. The estimate is the gap or overlap that
remains at the middles of a few strips, or the overlap at the deepest point of a lobe without a patch, divided by the
approach. It is zero for an exact solution and for Hertz's ellipse. Strips that interact satisfy it by
construction.
"""

import math

from contact._jit import kernel
from contact.kernels import cubic
from contact.kernels.normal.between_panels import IN_LINE
from contact.kernels.normal.influence import anywhere, at_centre
from contact.kernels.rows import Strip

#: Number of strips at which the gap is evaluated.
CHECKED = 8


@kernel
def _displacement(at, locus, n, strips, tables):
    """Return the displacement at y = at, x = locus times pi E* [N/m]."""
    total = 0.0
    for j in range(n):
        a, half = strips[Strip.A, j], 0.5 * strips[Strip.DY, j]
        if strips[Strip.P0, j] <= 0.0 or a <= 0.0:
            continue
        away = abs(strips[Strip.Y, j] - at)
        near = math.log(max(abs(away - half), 1e-12 * half) / a)
        far, X = math.log((away + half) / a), abs(strips[Strip.XC, j] - locus) / a
        if X > IN_LINE:
            low, high = anywhere(tables.plane, X, near), anywhere(tables.plane, X, far)
        else:
            low, high = at_centre(tables.centre, near), at_centre(tables.centre, far)
        total += strips[Strip.P0, j] * a * (high + low if away < half else high - low)
    return total


@kernel
def _deepest_outside(sep, n, delta, strips, result):
    """Return the sample outside the patches where the undeformed overlap has its largest local maximum; -1 for none."""
    deepest, at = 0.0, -1
    for k in range(1, sep.y.size - 1):
        overlap = delta - (sep.g[k] - result.touch)
        if overlap > deepest and sep.g[k] <= min(sep.g[k - 1], sep.g[k + 1]):
            outside = True
            for patch in range(int(strips[Strip.PATCH, n - 1]) + 1):
                if result.edges[2 * patch] <= sep.y[k] <= result.edges[2 * patch + 1]:
                    outside = False
            if outside:
                deepest, at = overlap, k
    return at


@kernel
def gap_error(sep, n, case, own, result):
    """Return the largest gap or overlap left, over the approach [-]; 1 at most.

    Gaps are evaluated at the middles of `CHECKED` of n strips, overlaps also where a lobe may have been missed.
    """
    y, g, size, strips = sep.y, sep.g, sep.y.size, own.strips
    delta = result.approach - result.touch
    if not delta > 0.0 or n == 0:
        return 0.0
    per_modulus = (1.0 - case.nu) / (math.pi * case.G)
    largest, k = 0.0, 0
    count = min(CHECKED, n)
    for strip in range(count):
        i = (2 * strip + 1) * n // (2 * count)
        at = strips[Strip.Y, i]
        k = cubic.locate(y, size, at, k)
        h = y[k + 1] - y[k]
        m0, m1 = cubic.slope_at(y, g, size, k), cubic.slope_at(y, g, size, k + 1)
        gap = cubic.value(h, g[k], m0, g[k + 1], m1, (at - y[k]) / h) - result.touch
        left = abs(gap + per_modulus * _displacement(at, strips[Strip.XC, i], n, strips, own.tables) - delta) / delta
        largest = max(largest, min(left, 1.0))
    missed = _deepest_outside(sep, n, delta, strips, result)
    if missed >= 0:
        used = per_modulus * _displacement(y[missed], sep.x_c[missed], n, strips, own.tables)
        largest = max(largest, min((delta - (g[missed] - result.touch) - used) / delta, 1.0))
    return largest
