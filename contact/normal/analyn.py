"""ANALYN: the non-elliptic patch from an approximate surface deformation (theory.md 3; thesis section 9).

On the edge of a Hertzian patch the displacement is a multiple of the separation: alpha·A a² at (a, 0), beta·B b² at (0, b).
ANALYN uses these factors of the local A(y), B(y) on the true separation,

    (1 + alpha) A (x - x_c)² + (1 + beta) g = delta,                                       (theory.md 3.1)

so a strip is in contact where d(y) = delta - (1 + beta) g > 0, with half length a = √(d/((1 + alpha) A)) and the peak
pressure of a Hertz contact (A, B) at approach d: p0 = (2 E*/pi) d/(n r a) (thesis Eq. 9.1, corrected).
Its strip load (pi/2) p0 a = E* d/(n r) is linear in d: the load is a convex, monotone function of the approach.

Departures from the thesis, which does not say how curvature jumps are treated: B(y) is a second difference over a fixed width
and floored (theory.md 3.3), and the deformation beta·g of a flank never falls where the gap opens (set D: mean error of N
2.78 → 2.77 %, of the area 2.96 → 2.88 %; among 400 other real patches no satellite patch instead of three).
"""

import math

from contact._jit import kernel
from contact._layout import (
    APPROACH,
    CASE_G,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_NU,
    RES_APPROACH,
    RES_EDGES,
    RES_ITERATIONS,
    RES_N,
    RES_STATUS,
    RES_STIFFNESS,
    RES_TOUCH,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_DY,
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.hertz import local_factors
from contact.normal.lay import at_end, cubic, find_patches, lay_strips, least_point, locate, slopes

#: Half base of the second difference that gives B(y) [m]: a triangular average of g'' with standard deviation 1 mm.
CURVATURE_HALF_BASE = 2.45e-3
#: Least half curvature B [1/m]; negative and vanishing curvature count as this flat (CONTACT's value; theory.md 3.3).
CURVATURE_FLOOR = 0.1

#: An overlap below this fraction of the separation's width is round-off, not contact.
NO_OVERLAP = 1e-14

#: Rows of the work array that the caller provides, each as long as the separation.
GAP_SLOPE, EFFECTIVE_GAP, EFFECTIVE_SLOPE, STRETCHED_A, ONE_BETA, NR, LOG_ASPECT = range(7)
N_WORK_ROWS = 7

#: Below 1 + beta of every curvature (`local_factors`).
LEAST_ONE_BETA = 1.1

#: How far beyond the estimated approach the gap is prepared; farther when that is not enough.
REACH = 1.3

#: Share of the load that may be missing before the last of Newton's steps.
NEWTON_CLOSE = 1e-6

#: Newton's steps before bisection, which closes in on a step of the load, and the cap.
_NEWTON_ITERATIONS, _MAX_ITERATIONS = 15, 60


@kernel
def floored(B):
    """max(B, floor) with its corner rounded to a continuous slope; equal to B from twice the floor on."""
    if B >= 2.0 * CURVATURE_FLOOR:
        return B
    if B <= 0.0:
        return CURVATURE_FLOOR
    return CURVATURE_FLOOR + B * B / (4.0 * CURVATURE_FLOOR)


@kernel
def lateral_curvature(y, g, m, n, i, below, above):
    """B = g''/2 at sample i as a second difference of the interpolated gap over ±CURVATURE_HALF_BASE.

    A second difference is g'' averaged with a triangle: it needs no second derivative of noisy profiles, has a fixed
    physical width, and is exact for a parabola. At the ends of the data the base is shifted inwards. `below` and `above` are
    indices to search from, any; those found are returned for the neighbouring sample.
    """
    base = max(CURVATURE_HALF_BASE, 0.5 * (y[min(i + 1, n - 1)] - y[max(i - 1, 0)]))
    base = min(base, 0.5 * (y[n - 1] - y[0]))
    centre = min(max(y[i], y[0] + base), y[n - 1] - base)
    middle = g[i]
    if centre != y[i]:
        k = locate(y, n, centre, 0)
        h = y[k + 1] - y[k]
        middle = cubic(h, g[k], m[k], g[k + 1], m[k + 1], (centre - y[k]) / h)
    below = locate(y, n, centre - base, below)
    h = y[below + 1] - y[below]
    left = cubic(h, g[below], m[below], g[below + 1], m[below + 1], (centre - base - y[below]) / h)
    above = locate(y, n, centre + base, above)
    h = y[above + 1] - y[above]
    right = cubic(h, g[above], m[above], g[above + 1], m[above + 1], (centre + base - y[above]) / h)
    return 0.5 * (left - 2.0 * middle + right) / (base * base), below, above


@kernel
def _next_node(i, n, stride, direction):
    """Next of the samples at which B is computed; they lie alike from both ends: mirror images have mirrored factors."""
    left_end = (n - 1) // 2 // stride * stride
    right_start = n - 1 - left_end
    if direction > 0:
        return right_start if i == left_end and left_end < right_start else min(i + stride, n - 1)
    return left_end if i == right_start and left_end < right_start else max(i - stride, 0)


@kernel
def prepare(y, g, A, n, y_least, g_least, reach, work):
    """Local Hertz factors and effective gap (1 + beta)(g - min g) around the least point; return first and last sample.

    Outside these samples the effective gap is above `reach`: it is there at their ends, rises as long as the gap does
    (`_keep_rising`), and is at least LEAST_ONE_BETA (g - min g) where the gap falls again.

    The factors follow B, an average over the base: a fifth of it apart they are as good as linear, in constant B exactly. The
    samples chosen do not depend on `reach`, or the load would not be a smooth function of the approach.
    """
    lobe = g_least + reach / LEAST_ONE_BETA
    stride = max(1, int(0.2 * CURVATURE_HALF_BASE * (n - 1) / (y[n - 1] - y[0])))
    left_end = (n - 1) // 2 // stride * stride
    right_start = n - 1 - left_end
    start = locate(y, n, y_least, 0)
    if start >= right_start:
        start -= (start - right_start) % stride
    else:
        start = min(start // stride * stride, left_end)
    below, above = 0, 0
    B, below, above = lateral_curvature(y, g, work[GAP_SLOPE], n, start, below, above)
    _prepare_sample(A, B, g, g_least, start, work)
    ends = start, start
    for direction in (-1, 1):
        i, end, beyond = start, 0 if direction < 0 else n - 1, 0
        while i != end and beyond < 2:
            before, i = i, _next_node(i, n, stride, direction)
            B, below, above = lateral_curvature(y, g, work[GAP_SLOPE], n, i, below, above)
            _prepare_sample(A, B, g, g_least, i, work)
            _between(y, g, A, g_least, min(before, i), max(before, i), work)
            if beyond == 0 and work[EFFECTIVE_GAP, i] >= reach:
                j = i
                while j != end and g[j + direction] >= min(g[j], lobe):
                    j += direction
                beyond = 1 if j == end else 0  # and one node more: the slope at the edge of a patch has both neighbours
            elif beyond == 1:
                beyond = 2
        ends = (i, ends[1]) if direction < 0 else (ends[0], i)
    first, last = ends
    _keep_rising(g, first, last, work)
    gap, slope = work[EFFECTIVE_GAP, first : last + 1], work[EFFECTIVE_SLOPE, first : last + 1]
    slopes(y[first : last + 1], gap, last + 1 - first, slope)
    # noise or a curvature jump may let the interpolated product dip below zero: a patch would be born with a finite width
    _, deepest = least_point(y[first : last + 1], gap, slope, last + 1 - first)
    for i in range(first, last + 1):
        work[EFFECTIVE_GAP, i] -= deepest
    for i in range(n):  # strip_halfspace may lay strips beyond
        if not first <= i <= last:
            work[LOG_ASPECT, i] = work[LOG_ASPECT, min(max(i, first), last)]
    return first, last


@kernel
def _keep_rising(g, first, last, work):
    """Let the deformation beta·g not fall where the gap opens: its effective gap rises at least as the gap itself.

    A convex flank that turns concave would lose beta faster than the gap opens, which made a satellite patch without load.
    """
    falls = 0
    for i in range(first + 1, last + 1):
        rise, effective_rise = g[i] - g[i - 1], work[EFFECTIVE_GAP, i] - work[EFFECTIVE_GAP, i - 1]
        falls += 1 if (effective_rise - rise) * rise < 0.0 else 0
    if falls == 0:
        return
    for i in range(first + 1, last + 1):
        if g[i] > g[i - 1]:
            work[EFFECTIVE_GAP, i] = max(work[EFFECTIVE_GAP, i], work[EFFECTIVE_GAP, i - 1] + g[i] - g[i - 1])
    for i in range(last - 1, first - 1, -1):
        if g[i] > g[i + 1]:
            work[EFFECTIVE_GAP, i] = max(work[EFFECTIVE_GAP, i], work[EFFECTIVE_GAP, i + 1] + g[i] - g[i + 1])


@kernel
def _between(y, g, A, g_least, left, right, work):
    """Interpolate the local factors of the samples between two that are known."""
    per_length = 1.0 / (y[right] - y[left])
    beta, nr, log_aspect = work[ONE_BETA, left], work[NR, left], work[LOG_ASPECT, left]
    alpha = work[STRETCHED_A, left] / A[left]
    d_alpha = (work[STRETCHED_A, right] / A[right] - alpha) * per_length
    d_beta = (work[ONE_BETA, right] - beta) * per_length
    d_nr, d_log_aspect = (work[NR, right] - nr) * per_length, (work[LOG_ASPECT, right] - log_aspect) * per_length
    for i in range(left + 1, right):
        t = y[i] - y[left]
        work[EFFECTIVE_GAP, i] = (beta + t * d_beta) * (g[i] - g_least)
        work[STRETCHED_A, i] = A[i] * (alpha + t * d_alpha)
        work[NR, i], work[LOG_ASPECT, i] = nr + t * d_nr, log_aspect + t * d_log_aspect


@kernel
def _prepare_sample(A, B, g, g_least, i, work):
    one_alpha, one_beta, nr, log_aspect = local_factors(A[i], floored(B))
    work[ONE_BETA, i] = one_beta
    work[EFFECTIVE_GAP, i] = one_beta * (g[i] - g_least)
    work[STRETCHED_A, i] = one_alpha * A[i]
    work[NR, i] = nr
    work[LOG_ASPECT, i] = log_aspect


@kernel
def estimated_approach(y, g, n, g_least, load, modulus, one_beta, nr, hertz):
    """Approach at which a virtual penetration with the factors of the least point carries the load.

    Newton on a convex, piecewise linear function of the samples, started from Hertz's approach at the least point; that is
    also the answer when the patch is narrower than the samples.
    """
    delta = hertz
    for _ in range(12):
        N, width = 0.0, 0.0
        for i in range(1, n - 1):
            d = delta - one_beta * (g[i] - g_least)
            cell = 0.5 * (y[i + 1] - y[i - 1]) if d > 0.0 else 0.0
            N += d * cell
            width += cell
        if width == 0.0:
            return hertz
        change = (load * nr / modulus - N) / width
        delta = max(delta + change, 0.3 * delta)
        if abs(change) < 0.01 * delta:
            break
    return delta


@kernel
def load_at(y, first, last, delta, modulus, nodes, weights, work, edges):
    """Load and stiffness dN/d(delta) at approach `delta` above first touch."""
    G, m, nr = work[EFFECTIVE_GAP], work[EFFECTIVE_SLOPE], work[NR]
    count = find_patches(y, G, m, first, last, delta, edges)
    N, stiffness = 0.0, 0.0
    k = first
    for patch in range(count):
        centre = 0.5 * (edges[2 * patch] + edges[2 * patch + 1])
        half = 0.5 * (edges[2 * patch + 1] - edges[2 * patch])
        for i in range(nodes.size):
            at = centre + half * nodes[i]
            k = locate(y, last + 1, at, k)
            h = y[k + 1] - y[k]
            t = (at - y[k]) / h
            share = half * weights[i] / ((1.0 - t) * nr[k] + t * nr[k + 1])
            N += max(delta - cubic(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0) * share
            stiffness += share
    return modulus * N, modulus * stiffness


@kernel
def fill_strips(y, xc, first, last, delta, modulus, nodes, weights, work, edges, strips):
    """Lay strips at approach `delta`; return load, stiffness and number of strips."""
    G, m = work[EFFECTIVE_GAP], work[EFFECTIVE_SLOPE]
    count = find_patches(y, G, m, first, last, delta, edges)
    n_strips = lay_strips(edges, count, nodes, weights, strips)
    N, stiffness = 0.0, 0.0
    k = first
    for i in range(n_strips):
        at = strips[STRIP_Y, i]
        k = locate(y, last + 1, at, k)
        h = y[k + 1] - y[k]
        t = (at - y[k]) / h
        d = max(delta - cubic(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0)
        nr = (1.0 - t) * work[NR, k] + t * work[NR, k + 1]
        stretched = (1.0 - t) * work[STRETCHED_A, k] + t * work[STRETCHED_A, k + 1]
        a = math.sqrt(d / stretched)
        strips[STRIP_A, i] = a
        strips[STRIP_P0, i] = 2.0 * modulus / math.pi * a * stretched / nr  # Eq. 9.1 with d/a = a (1 + alpha) A
        strips[STRIP_XC, i] = (1.0 - t) * xc[k] + t * xc[k + 1]
        strips[STRIP_ASPECT, i] = (1.0 - t) * work[LOG_ASPECT, k] + t * work[LOG_ASPECT, k + 1]
        share = modulus * strips[STRIP_DY, i] / nr
        N += d * share
        stiffness += share
    return N, stiffness, n_strips


@kernel
def solve_load(y, g, A, n, y_least, g_least, load, modulus, nodes, weights, work, edges, result):
    """Approach above first touch that carries `load`; first and last prepared sample.

    N ~ delta^(3/2) in Hertz contact: Newton on N^(2/3), bracketed.
    """
    k = locate(y, n, y_least, 0)
    B, _, _ = lateral_curvature(y, g, work[GAP_SLOPE], n, k, 0, 0)
    _prepare_sample(A, B, g, g_least, k, work)
    hertz = (0.75 * load / modulus * work[NR, k] * math.sqrt(work[STRETCHED_A, k])) ** (2.0 / 3.0)
    delta = estimated_approach(y, g, n, g_least, load, modulus, work[ONE_BETA, k], work[NR, k], hertz)
    reach = REACH * delta
    first, last = prepare(y, g, A, n, y_least, g_least, reach, work)
    low, high = 0.0, math.inf
    for iteration in range(_MAX_ITERATIONS):
        result[RES_ITERATIONS] = iteration + 1.0
        if delta > reach:
            reach = REACH * delta
            first, last = prepare(y, g, A, n, y_least, g_least, reach, work)
        N, stiffness = load_at(y, first, last, delta, modulus, nodes, weights, work, edges)
        if load > N:
            low = delta
        else:
            high = delta
        if N > 0.0 and stiffness > 0.0:
            new = delta - 1.5 * N / stiffness * (1.0 - (load / N) ** (2.0 / 3.0))
        else:
            new = 2.0 * delta
        if abs(N - load) <= NEWTON_CLOSE * load:  # the step taken squares what is missing
            return new, first, last
        if not low < new < high or (iteration >= _NEWTON_ITERATIONS and high < math.inf):
            new = 0.5 * (low + high) if high < math.inf else 2.0 * delta
        if new == delta or high - low <= 1e-12 * delta:  # a step: two patches merge within one sample interval
            return (high if high < math.inf else delta), first, last  # its upper side, whatever the way there
        delta = new
    result[RES_STATUS] = 5.0
    return delta, first, last


@kernel
def analyn(y, g, A, xc, case, nodes, weights, work, strips, result):
    """Solve the normal problem; fill `strips` (STRIP_ASPECT holds ln(a/b)) and `result`; return the number of strips.

    The status is 1 solved, 2 no contact, 4 the patch reaches the end of the separation, 5 not converged.
    """
    n = y.size
    modulus = case[CASE_G] / (1.0 - case[CASE_NU])
    edges = result[RES_EDGES:]
    slopes(y, g, n, work[GAP_SLOPE])
    y_least, g_least = least_point(y, g, work[GAP_SLOPE], n)
    result[RES_STATUS] = 1.0
    result[RES_ITERATIONS] = 0.0
    result[RES_TOUCH] = g_least
    by_approach = case[CASE_LOAD_KIND] == APPROACH
    load, delta = case[CASE_LOAD], case[CASE_LOAD] - g_least
    if delta <= NO_OVERLAP * (y[n - 1] - y[0]) if by_approach else load <= 0.0:
        result[RES_STATUS] = 2.0
        result[RES_APPROACH] = case[CASE_LOAD] if by_approach else g_least
        return 0
    if by_approach:
        first, last = prepare(y, g, A, n, y_least, g_least, delta, work)
    else:
        delta, first, last = solve_load(
            y, g, A, n, y_least, g_least, load, modulus, nodes, weights, work, edges, result
        )
    N, stiffness, n_strips = fill_strips(y, xc, first, last, delta, modulus, nodes, weights, work, edges, strips)
    if not by_approach and N > 0.0:
        # what is left of round-off, or of the step at which two patches merge, is taken by the pressure
        for i in range(n_strips):
            strips[STRIP_P0, i] *= load / N
        N = load
    if result[RES_STATUS] == 1.0 and at_end(y, n, edges, n_strips // nodes.size):
        result[RES_STATUS] = 4.0
    result[RES_N] = N
    result[RES_APPROACH] = delta + g_least
    result[RES_STIFFNESS] = stiffness
    return n_strips
