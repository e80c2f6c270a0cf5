"""ANALYN: the non-elliptic patch from an approximate surface deformation (theory.md 3; thesis section 9).

On the edge of a Hertzian patch the displacement is a multiple of the separation: alpha·A a² at (a, 0), beta·B b² at (0,
b). ANALYN applies these factors, of the local A(y), B(y), to the true separation,

    (1 + alpha) A (x - x_c)² + (1 + beta) g = delta.                                       (theory.md 3.1)

So a strip is in contact where d(y) = delta - (1 + beta) g > 0. Its half length is a = √(d/((1 + alpha) A)). Its peak
pressure is that of a Hertz contact (A, B) at approach d: p0 = (2 E*/pi) d/(n r a) (thesis Eq. 9.1, corrected). Its
strip load (pi/2) p0 a = E* d/(n r) is linear in d, so the load is a continuous function of the approach.

The thesis does not say how curvature jumps are treated. Here B(y) is a second difference over a share of the overlap, and
floored (`curvature`), and the deformation beta·g of a flank never falls where the gap opens (set D: mean error of N 2.78 →
2.69 %, of the area 2.96 → 2.85 %; among 400 other real patches no satellite patch instead of three).
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.cubic import locate, slopes
from contact.kernels.enumerations import LoadKind, Status
from contact.kernels.hertz import local_factors
from contact.kernels.normal.curvature import base_of, floor_of, floored, half_width, lateral_curvature
from contact.kernels.normal.deepest import first_approach, lowest, touches
from contact.kernels.normal.lay import at_end, find_patches, lay_strips, least_point
from contact.kernels.rows import Sample, Strip

#: Largest ratio of the fall of the deformation to the fall of the gap (`_keep_rising`).
STEEPEST = 20.0

#: Limit of the product of the relative errors of the load at both ends of the last secant.
SECANT_CLOSE = 1e-8

#: Number of steps before bisection, which converges to a step of the load, and limit of iterations.
_STEPS, _MAX_ITERATIONS = 15, 60


@kernel
def prepare(y, g, A, n, g_least, delta, work):
    """Fill local Hertz factors and effective gap (1 + beta)(g - min g) at every sample, for the approach `delta` > 0.

    GAP_SLOPE of `work` holds the slopes of the gap.
    """
    m = work[Sample.GAP_SLOPE]
    half = half_width(y, g, m, n, g_least, delta)
    floor = floor_of(half, delta)
    below, above = 0, 0
    for i in range(n):
        B, below, above = lateral_curvature(y, g, m, n, i, base_of(half, A[i], delta), below, above)
        alpha, beta, nr, log_aspect = local_factors(A[i], floored(B, floor))
        work[Sample.STRETCHED_A, i] = A[i] * alpha
        work[Sample.EFFECTIVE_GAP, i] = beta * (g[i] - g_least)
        work[Sample.NR, i], work[Sample.LOG_ASPECT, i] = nr, log_aspect
    _keep_rising(g, n, work)
    gap, slope = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE]
    slopes(y, gap, n, slope)
    # noise or a curvature jump may bring the interpolated product below zero: a patch would appear with a finite width
    _, deepest = least_point(y, gap, slope, n)
    for i in range(n):
        gap[i] -= deepest


@kernel
def _keep_rising(g, n, work):
    """Raise the effective gap so that the deformation beta·g does not fall where the gap opens.

    Then the effective gap rises at least as the gap itself. On a convex flank that turns concave, beta would fall
    faster than the gap opens, which made a satellite patch without load. Beyond a maximum of the gap the deformation
    may fall with it, STEEPEST times as fast. So the rule fades out; otherwise the result would jump where a maximum
    moves from one sample to the next.
    """
    gap, deformation = work[Sample.EFFECTIVE_GAP], work[Sample.SHARE]
    for i in range(n):
        deformation[i] = gap[i] - g[i]
    up, down = deformation[0], deformation[n - 1]  # lower bounds of the deformation, from the left and from the right
    for i in range(1, n):
        j = n - 1 - i
        rise = g[i] - g[i - 1]
        up = max(deformation[i], up - 0.5 * STEEPEST * (abs(rise) - rise))
        gap[i] = max(gap[i], g[i] + up)
        rise = g[j] - g[j + 1]
        down = max(deformation[j], down - 0.5 * STEEPEST * (abs(rise) - rise))
        gap[j] = max(gap[j], g[j] + down)


@kernel
def _sampled_load(delta, n, gap, share):
    """Return load over the modulus and its slope at an approach, summed over the samples.

    Four partial sums are used, because in one sum every addition waits for the one before.
    """
    N0, N1, N2, N3, k0, k1, k2, k3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    quads = (n - 2) // 4
    for q in range(quads):
        i = 1 + 4 * q
        d0, d1, d2, d3 = delta - gap[i], delta - gap[i + 1], delta - gap[i + 2], delta - gap[i + 3]
        s0, s1 = share[i] if d0 > 0.0 else 0.0, share[i + 1] if d1 > 0.0 else 0.0
        s2, s3 = share[i + 2] if d2 > 0.0 else 0.0, share[i + 3] if d3 > 0.0 else 0.0
        N0, N1, N2, N3 = N0 + d0 * s0, N1 + d1 * s1, N2 + d2 * s2, N3 + d3 * s3
        k0, k1, k2, k3 = k0 + s0, k1 + s1, k2 + s2, k3 + s3
    for i in range(1 + 4 * quads, n - 1):
        part = share[i] if gap[i] < delta else 0.0
        N0, k0 = N0 + (delta - gap[i]) * part, k0 + part
    return N0 + N1 + N2 + N3, k0 + k1 + k2 + k3


@kernel
def estimated_approach(y, n, load, modulus, work, hertz):
    """Return the approach [m] at which the samples carry the load, to about a thousandth.

    Newton's method on a convex, piecewise linear function starts from Hertz's approach at the smallest gap. That is
    also the result if the patch is narrower than the samples.
    """
    gap, share = work[Sample.EFFECTIVE_GAP], work[Sample.SHARE]
    for i in range(1, n - 1):
        share[i] = 0.5 * (y[i + 1] - y[i - 1]) / work[Sample.NR, i]
    delta = hertz
    for _ in range(12):
        N, stiffness = _sampled_load(delta, n, gap, share)
        if stiffness == 0.0:
            return hertz
        change = (load / modulus - N) / stiffness
        delta = max(delta + change, 0.3 * delta)
        if abs(change) < 0.03 * delta:
            break
    return delta


@kernel
def load_at(y, n, delta, modulus, across, work, edges):
    """Return load [N] and stiffness dN/d(delta) [N/m] at approach `delta` above first touch."""
    nodes, weights = across.nodes, across.weights
    G, m, nr = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE], work[Sample.NR]
    count = find_patches(y, G, m, n, delta, edges)
    N, stiffness = 0.0, 0.0
    k = 0
    for patch in range(count):
        centre = 0.5 * (edges[2 * patch] + edges[2 * patch + 1])
        half = 0.5 * (edges[2 * patch + 1] - edges[2 * patch])
        for i in range(nodes.size):
            at = centre + half * nodes[i]
            k = locate(y, n, at, k)
            h = y[k + 1] - y[k]
            t = (at - y[k]) / h
            share = half * weights[i] / ((1.0 - t) * nr[k] + t * nr[k + 1])
            N += max(delta - cubic.value(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0) * share
            stiffness += share
    return modulus * N, modulus * stiffness


@kernel
def fill_strips(sep, delta, modulus, across, work, edges, strips):
    """Fill `strips` at approach `delta`. Return load [N], stiffness [N/m] and number of strips."""
    y, xc, n = sep.y, sep.x_c, sep.y.size
    G, m = work[Sample.EFFECTIVE_GAP], work[Sample.EFFECTIVE_SLOPE]
    count = find_patches(y, G, m, n, delta, edges)
    n_strips = lay_strips(edges, count, across, strips)
    N, stiffness = 0.0, 0.0
    k = 0
    for i in range(n_strips):
        at = strips[Strip.Y, i]
        k = locate(y, n, at, k)
        h = y[k + 1] - y[k]
        t = (at - y[k]) / h
        d = max(delta - cubic.value(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0)
        nr = (1.0 - t) * work[Sample.NR, k] + t * work[Sample.NR, k + 1]
        stretched = (1.0 - t) * work[Sample.STRETCHED_A, k] + t * work[Sample.STRETCHED_A, k + 1]
        a = math.sqrt(d / stretched)
        strips[Strip.A, i] = a
        strips[Strip.P0, i] = 2.0 * modulus / math.pi * a * stretched / nr  # Eq. 9.1 with d/a = a (1 + alpha) A
        strips[Strip.XC, i] = (1.0 - t) * xc[k] + t * xc[k + 1]
        strips[Strip.LN_ASPECT, i] = (1.0 - t) * work[Sample.LOG_ASPECT, k] + t * work[Sample.LOG_ASPECT, k + 1]
        share = modulus * strips[Strip.DY, i] / nr
        N += d * share
        stiffness += share
    return N, stiffness, n_strips


@kernel
def solve_load(sep, place, case, across, work, result):
    """Return the approach above first touch [m] that carries the load `case.amount`. Prepare everything for it.

    `place` is that of `lowest`.

    N ~ delta^(3/2) in Hertz contact, so steps are bracketed steps on N^(2/3). The first is Newton's. Its slope is that
    of fixed strips, one or two per cent off, so the others are secants. The start is the approach of a parabola like the
    overlap.
    """
    y, n, edges = sep.y, sep.y.size, result.edges
    load, modulus = case.amount, case.G / (1.0 - case.nu)
    delta = first_approach(y, sep.g, sep.A, n, place, load, modulus, work)
    if not touches(y, n, delta):  # the load is below round-off
        return 0.0
    prepare(y, sep.g, sep.A, n, result.touch, delta, work)
    delta = estimated_approach(y, n, load, modulus, work, delta)
    low, high = 0.0, math.inf
    before, left_before, missing_before = 0.0, 0.0, 1.0
    for iteration in range(_MAX_ITERATIONS):
        result.iterations = iteration + 1
        prepare(y, sep.g, sep.A, n, result.touch, delta, work)
        N, stiffness = load_at(y, n, delta, modulus, across, work, edges)
        if load > N:
            low = delta
        else:
            high = delta
        missing = abs(N - load) / load
        left = (N / load) ** (2.0 / 3.0) - 1.0
        if iteration > 0 and left != left_before:
            new = delta - left * (delta - before) / (left - left_before)
        elif N > 0.0 and stiffness > 0.0:
            new = delta - 1.5 * N / stiffness * left / (1.0 + left)
        else:
            new = 2.0 * delta
        if missing * missing_before <= SECANT_CLOSE:  # the error of a secant is proportional to both
            return new
        before, left_before, missing_before = delta, left, missing
        if not low < new < high or (iteration >= _STEPS and high < math.inf):
            new = 0.5 * (low + high) if high < math.inf else 2.0 * delta
        if new == delta or high - low <= 1e-12 * delta:  # a step: two patches merge within one sample interval
            return high if high < math.inf else delta  # its upper side, so that the result does not depend on the path
        delta = new
    result.status = Status.NOT_CONVERGED
    return delta


@kernel
def analyn(sep, case, across, work, strips, result):
    """Solve the normal problem. Fill `strips` (`Strip.LN_ASPECT` holds ln(a/b)) and `result`. Return the number of strips.

    `across` is the rule for the positions of strips in a patch. `work` is a scratch array of the rows of `Sample`.
    """
    y, g, A, n = sep.y, sep.g, sep.A, sep.y.size
    modulus = case.G / (1.0 - case.nu)
    edges = result.edges
    place = lowest(y, g, n, work)
    g_least = place[1]
    result.status = Status.OK
    result.iterations = 0
    result.touch = g_least
    by_approach = case.load_kind == LoadKind.APPROACH
    load, delta = case.amount, case.amount - g_least
    if not by_approach:
        delta = solve_load(sep, place, case, across, work, result) if load > 0.0 else 0.0
    result.approach = case.amount if by_approach else g_least
    if not touches(y, n, delta):
        result.status = Status.NO_CONTACT
        return 0
    if by_approach:
        prepare(y, g, A, n, g_least, delta, work)
    N, stiffness, n_strips = fill_strips(sep, delta, modulus, across, work, edges, strips)
    if N <= 0.0:
        result.status = Status.NO_CONTACT
        return 0
    if not by_approach:
        # the pressure is scaled to remove the rest of round-off, or of the step at which two patches merge
        for i in range(n_strips):
            strips[Strip.P0, i] *= load / N
        N = load
    if result.status == Status.OK and at_end(y, n, edges, n_strips // across.nodes.size):
        result.status = Status.OUT_OF_RANGE
    result.N = N
    result.approach = delta + g_least
    result.stiffness = stiffness
    return n_strips
