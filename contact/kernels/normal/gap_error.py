"""Violation of the half space's contact conditions by a pressure: an error estimate for every normal method.

Inside the patch the gap must close: displacement + undeformed gap = approach. Outside, the bodies must not overlap. The
semi-elliptic pressures of all strips displace the surface by U of `influence`. The estimate is the gap or overlap that
remains at the middles of a few strips, or the overlap at the deepest point of a lobe without a patch, divided by the
approach. It is zero for an exact solution and for Hertz's ellipse. Strips that interact satisfy it by
construction.
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.normal.many_strips import displacement, fill_ln_X
from contact.kernels.rows import Pair, Strip, Vector

#: Number of strips at which the gap is evaluated.
CHECKED = 8
#: Distance from the middle of a skewed strip, over its half length, at which the gap is evaluated too.
ASIDE = 0.5
#: Half length [m] in place of 0, of which logarithm and reciprocal are traps.
_LEAST = 1e-12


@kernel
def _summarise(n, strips, vectors):
    """Fill ln a, 1/a and p0·a of the strips: the rows Q1, Q2 and R of the vectors."""
    for j in range(n):
        a = max(strips[Strip.A, j], _LEAST)
        vectors[Vector.Q1, j], vectors[Vector.Q2, j] = math.log(a), 1.0 / a
        vectors[Vector.R, j] = max(strips[Strip.P0, j], 0.0) * a


@kernel
def _displacement(at, locus, strip, n, strips, vectors, plane):
    """Return the displacement at y = at, x = locus times pi E* [N/m]. The point lies in `strip`; -1 if in none."""
    pairs = vectors[Vector.PAIRS : Vector.PAIRS + len(Pair)]
    lows, highs = pairs[Pair.LOW], pairs[Pair.HIGH]
    for j in range(n):
        away, half = abs(strips[Strip.Y, j] - at), 0.5 * strips[Strip.DY, j]
        lows[j] = math.log(max(abs(away - half), 1e-12 * half)) - vectors[Vector.Q1, j]
        highs[j] = math.log(away + half) - vectors[Vector.Q1, j]
        pairs[Pair.X, j] = abs(strips[Strip.XC, j] - locus) * vectors[Vector.Q2, j]
    fill_ln_X(n, pairs)
    return displacement(plane, vectors[Vector.R, :n], pairs, strip)


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
    y, g, size = sep.y, sep.g, sep.y.size
    strips, vectors, plane = own.strips, own.space.vectors, own.tables.plane
    delta = result.approach - result.touch
    if not delta > 0.0 or n == 0:
        return 0.0
    per_modulus = (1.0 - case.nu) / (math.pi * case.G)
    _summarise(n, strips, vectors)
    largest, k = 0.0, 0
    count = min(CHECKED, n)
    for strip in range(count):
        i = (2 * strip + 1) * n // (2 * count)
        at = strips[Strip.Y, i]
        k = cubic.locate(y, size, at, k)
        h = y[k + 1] - y[k]
        m0, m1 = cubic.slope_at(y, g, size, k), cubic.slope_at(y, g, size, k + 1)
        t = (at - y[k]) / h
        gap = cubic.value(h, g[k], m0, g[k + 1], m1, t) - result.touch
        offset, curvature = strips[Strip.OFFSET, i], (1.0 - t) * sep.A[k] + t * sep.A[k + 1]
        for point in range(-1 if offset != 0.0 else 0, 2 if offset != 0.0 else 1):
            aside = point * ASIDE * strips[Strip.A, i]
            away, locus = offset + aside, strips[Strip.XC, i] + aside
            used = per_modulus * _displacement(at, locus, i, n, strips, vectors, plane)
            left = abs(gap + curvature * away * away + used - delta) / delta
            largest = max(largest, min(left, 1.0))
    missed = _deepest_outside(sep, n, delta, strips, result)
    if missed >= 0:
        used = per_modulus * _displacement(y[missed], sep.x_c[missed], -1, n, strips, vectors, plane)
        largest = max(largest, min((delta - (g[missed] - result.touch) - used) / delta, 1.0))
    return largest
