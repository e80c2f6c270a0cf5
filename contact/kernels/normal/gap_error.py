"""Violation of the half space's contact conditions by a pressure: an error estimate for every normal method.

Inside the patch the gap must close: displacement + undeformed gap = approach. Outside, the bodies must not overlap. The
semi-elliptic pressures of all strips displace the surface by U of `influence`. The estimate is the gap or overlap that
remains at the middles of a few strips, or the overlap at the deepest point of a lobe without a patch, divided by the
approach. It is zero for an exact solution and for Hertz's ellipse. Strips that interact satisfy it by
construction. They do not see waves of the gap that are shorter than two of them, so the pressure that such waves would need
counts too, over the largest one.
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.normal.many_strips import displacement, fill_ln_X
from contact.kernels.rows import Pair, Strip, Vector

#: Number of strips at whose middles the gap is evaluated.
CHECKED = 8
#: The same of skewed strips, where the pressure may have two humps on a few strips, and the distance from their middles on
#: either side, over their half length, at which it is evaluated instead.
CHECKED_SKEWED, ASIDE = 12, 0.5
#: Distance from the ends of a patch, over its width, at which an overlap is sought: an end that was fixed before it arrived
#: leaves one.
BEYOND = 0.1
#: Half length [m] in place of 0, of which logarithm and reciprocal are traps.
_LEAST = 1e-12
#: Gap between two strips, over half the width of the second one, below which they share a side.
_LEAST_GAP = 1e-9


@kernel
def summarise(n, strips, vectors):
    """Fill ln a, 1/a and p0·a of the strips: the rows Q1, Q2 and R of the vectors."""
    for j in range(n):
        a = max(strips[Strip.A, j], _LEAST)
        vectors[Vector.Q1, j], vectors[Vector.Q2, j] = math.log(a), 1.0 / a
        vectors[Vector.R, j] = max(strips[Strip.P0, j], 0.0) * a


@kernel
def fill_sides(at, n, strips, vectors):
    """Fill the logarithms of the distances of y = `at` from the nearer and the farther side of each strip, over its a.

    They are the rows REACH and SPREAD of the vectors.
    """
    lows, highs, end, beyond = vectors[Vector.REACH], vectors[Vector.SPREAD], -math.inf, 0.0
    for j in range(n):
        y, half, ln_a = strips[Strip.Y, j], 0.5 * strips[Strip.DY, j], vectors[Vector.Q1, j]
        before = beyond  # the logarithm of the distance to the side of the strip before is that to the side of this one
        if abs(y - half - end) > _LEAST_GAP * half:
            before = math.log(max(abs(y - half - at), 1e-12 * half))
        end = y + half
        beyond = math.log(max(abs(end - at), 1e-12 * half))
        lows[j], highs[j] = min(before, beyond) - ln_a, max(before, beyond) - ln_a


@kernel
def displacement_at(locus, strip, n, strips, vectors, plane):
    """Return the displacement at x = locus times pi E* [N/m], after `fill_sides`. `strip` is the one there or -1."""
    pairs = vectors[Vector.PAIRS : Vector.PAIRS + len(Pair)]
    for j in range(n):
        pairs[Pair.X, j] = abs(strips[Strip.XC, j] - locus) * vectors[Vector.Q2, j]
        pairs[Pair.LOW, j], pairs[Pair.HIGH, j] = vectors[Vector.REACH, j], vectors[Vector.SPREAD, j]
    fill_ln_X(n, pairs)
    return displacement(plane, vectors[Vector.R, :n], pairs, strip)


@kernel
def _displacement(at, locus, n, strips, vectors, plane):
    """Return the displacement at y = at, x = locus outside all strips, times pi E* [N/m]."""
    fill_sides(at, n, strips, vectors)
    return displacement_at(locus, -1, n, strips, vectors, plane)


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
def _overlap_at(sep, at, n, delta, per_modulus, strips, vectors, plane, result):
    """Return the overlap at y = at on the line of least gap, over the approach; 0 within a patch or where there are no data."""
    y, g, size = sep.y, sep.g, sep.y.size
    for patch in range(int(strips[Strip.PATCH, n - 1]) + 1):
        if result.edges[2 * patch] <= at <= result.edges[2 * patch + 1]:
            return 0.0
    if not y[0] <= at <= y[size - 1]:
        return 0.0
    k = cubic.locate(y, size, at, 0)
    t = (at - y[k]) / (y[k + 1] - y[k])
    gap = (1.0 - t) * g[k] + t * g[k + 1] - result.touch
    locus = (1.0 - t) * sep.x_c[k] + t * sep.x_c[k + 1]
    return (delta - gap - per_modulus * _displacement(at, locus, n, strips, vectors, plane)) / delta


@kernel
def _mean_gap(sep, low, high, k):
    """Return the mean of the gap from y = `low`, in interval k of the samples, to `high`."""
    y, g, size = sep.y, sep.g, sep.y.size
    total, begin = 0.0, low
    while begin < high:
        end = high if k == size - 2 else min(high, y[k + 1])
        total += (end - begin) * (g[k] + (g[k + 1] - g[k]) * (0.5 * (begin + end) - y[k]) / (y[k + 1] - y[k]))
        k, begin = min(k + 1, size - 2), end
    return total / (high - low)


@kernel
def unresolved(sep, n, per_modulus, strips):
    """Return the mean pressure of the waves of the gap that strips do not see, over the largest pressure [-].

    Strips see the mean gaps over their widths, and slopes that are linear between these. A sinusoidal wave whose slope is s
    beyond them, and on which the gap closes, has pressures E* s/2 (Johnson 1985, 13.2). The mean of |s| is weighted with the
    loads of the strips.
    """
    y, g, size = sep.y, sep.g, sep.y.size
    left, weights, top = 0.0, 0.0, 0.0
    gap, slope, middle = 0.0, 0.0, 0.0  # of the last strip, and between it and the one before
    k, run = 0, 0  # run: strips since the last space between two of them
    for i in range(n):
        at, half, before = strips[Strip.Y, i], 0.5 * strips[Strip.DY, i], strips[Strip.Y, max(i - 1, 0)]
        top = max(top, strips[Strip.P0, i])
        if i == 0 or at - half - before - 0.5 * strips[Strip.DY, i - 1] > _LEAST_GAP * half:
            run = 0
        k = cubic.locate(y, size, max(at - half, y[0]), k)
        last_gap, last_slope, last_middle = gap, slope, middle
        gap = _mean_gap(sep, at - half, at + half, k)
        run += 1
        if run < 2:
            continue
        slope, middle = (gap - last_gap) / (at - before), 0.5 * (at + before)
        if run < 3:
            continue
        load = strips[Strip.P0, i - 1] * strips[Strip.A, i - 1]
        j = cubic.locate(y, size, last_middle, max(k - 1, 0))
        while j < size - 1 and 0.5 * (y[j] + y[j + 1]) < middle:
            place = 0.5 * (y[j] + y[j + 1])
            if place >= last_middle:
                seen = last_slope + (slope - last_slope) * (place - last_middle) / (middle - last_middle)
                weight = load * (y[j + 1] - y[j])
                left += weight * abs((g[j + 1] - g[j]) / (y[j + 1] - y[j]) - seen)
                weights += weight
            j += 1
    return 0.5 * left / (math.pi * per_modulus * weights * top) if weights > 0.0 else 0.0


@kernel
def gap_error(sep, n, case, workspace, result):
    """Return the largest gap or overlap left, over the approach [-]; 1 at most.

    Gaps are evaluated at the middles of `CHECKED` of n strips, on skewed strips beside them, overlaps also where a lobe
    may have been missed and beside the ends of the patches.
    """
    y, g, size = sep.y, sep.g, sep.y.size
    strips, vectors, plane = workspace.strips, workspace.space.vectors, workspace.tables.plane
    delta = result.approach - result.touch
    if not delta > 0.0 or n == 0:
        return 0.0
    per_modulus = (1.0 - case.nu) / (math.pi * case.G)
    summarise(n, strips, vectors)
    largest, k, skewed = 0.0, 0, False
    for i in range(n):
        skewed = skewed or strips[Strip.OFFSET, i] != 0.0
    count = min(CHECKED_SKEWED if skewed else CHECKED, n)
    for strip in range(count):
        i = (2 * strip + 1) * n // (2 * count)
        at = strips[Strip.Y, i]
        k = cubic.locate(y, size, at, k)
        h = y[k + 1] - y[k]
        m0, m1 = cubic.slope_at(y, g, size, k), cubic.slope_at(y, g, size, k + 1)
        t = (at - y[k]) / h
        gap = cubic.value(h, g[k], m0, g[k + 1], m1, t) - result.touch
        offset, curvature = strips[Strip.OFFSET, i], (1.0 - t) * sep.A[k] + t * sep.A[k + 1]
        fill_sides(at, n, strips, vectors)
        for side in range(2 if skewed else 1):
            aside = (2 * side - 1) * ASIDE * strips[Strip.A, i] if skewed else 0.0
            away, locus = offset + aside, strips[Strip.XC, i] + aside
            used = per_modulus * displacement_at(locus, i, n, strips, vectors, plane)
            left = abs(gap + curvature * away * away + used - delta) / delta
            largest = max(largest, min(left, 1.0))
    for patch in range(int(strips[Strip.PATCH, n - 1]) + 1):
        low, high = result.edges[2 * patch], result.edges[2 * patch + 1]
        for side in range(2):
            at = high + BEYOND * (high - low) if side > 0 else low - BEYOND * (high - low)
            left = _overlap_at(sep, at, n, delta, per_modulus, strips, vectors, plane, result)
            largest = max(largest, min(left, 1.0))
    missed = _deepest_outside(sep, n, delta, strips, result)
    if missed >= 0:
        used = per_modulus * _displacement(y[missed], sep.x_c[missed], n, strips, vectors, plane)
        largest = max(largest, min((delta - (g[missed] - result.touch) - used) / delta, 1.0))
    return max(largest, min(unresolved(sep, n, per_modulus, strips), 1.0))
