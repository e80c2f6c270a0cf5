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
from contact.normal.lay import cubic, find_patches, lay_strips, least_point, locate, slopes

#: Half base of the second difference that gives B(y) [m]: a triangular average of g'' with standard deviation 1 mm.
CURVATURE_HALF_BASE = 2.45e-3
#: Least half curvature B [1/m]; negative and vanishing curvature count as this flat (CONTACT's value; theory.md 3.3).
CURVATURE_FLOOR = 0.1

#: An overlap below this fraction of the separation's width is round-off, not contact.
NO_OVERLAP = 1e-14

#: Rows of the work array that the caller provides, each as long as the separation.
GAP_SLOPE, EFFECTIVE_GAP, EFFECTIVE_SLOPE, STRETCHED_A, ONE_BETA, NR, LOG_ASPECT = range(7)
N_WORK_ROWS = 7

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
def prepare(y, g, A, n, y_least, g_least, reach, work):
    """Local Hertz factors and the effective gap (1 + beta)(g - min g) at the samples where g - min g < `reach`.

    Beyond them, except for neighbours, the effective gap is the lower bound 1.2 (g - min g), which no approach below `reach`
    gets to.
    """
    least = locate(y, n, y_least, 0)
    first, last = least - 1, least + 2
    for i in range(n):
        work[EFFECTIVE_GAP, i] = 1.2 * (g[i] - g_least)
        work[STRETCHED_A, i], work[NR, i], work[LOG_ASPECT, i] = A[i], 1.0, 0.0
        if g[i] - g_least < reach:
            first, last = min(first, i), max(last, i)
    # The factors follow B, an average over the base: a fifth of it apart they are as good as linear, in constant B exactly. The
    # samples chosen must not depend on `reach`, or the load would not be a smooth function of the approach.
    stride = max(1, int(0.2 * CURVATURE_HALF_BASE * (n - 1) / (y[n - 1] - y[0])))
    # They lie alike from both ends, so that the mirror image has the mirrored factors.
    left_end = (n - 1) // 2 // stride * stride
    right_start = n - 1 - left_end
    first, last = max(first - 2, 0), min(last + 2, n - 1)
    if first < right_start:
        first = min(first // stride * stride, left_end)
    else:
        first -= (first - right_start) % stride
    below, above, i, i_step = 0, 0, first, 0
    while True:
        B, below, above = lateral_curvature(y, g, work[GAP_SLOPE], n, i, below, above)
        _prepare_sample(A, B, g, g_least, i, work)
        if i > first:
            _between(y, g, A, g_least, i - i_step, i, work)
        if i >= last:
            break
        i_step = right_start - left_end if i == left_end < right_start else stride
        i += i_step
    _keep_rising(g, n, work)
    slopes(y, work[EFFECTIVE_GAP], n, work[EFFECTIVE_SLOPE])
    # noise or a curvature jump may let the interpolated product dip below zero: a patch would be born with a finite width
    _, deepest = least_point(y, work[EFFECTIVE_GAP], work[EFFECTIVE_SLOPE], n)
    for i in range(n):
        work[EFFECTIVE_GAP, i] -= deepest


@kernel
def _keep_rising(g, n, work):
    """Let the deformation beta·g not fall where the gap opens: its effective gap rises at least as the gap itself.

    A convex flank that turns concave would lose beta faster than the gap opens, which made a satellite patch without load.
    """
    for i in range(1, n):
        if g[i] > g[i - 1]:
            work[EFFECTIVE_GAP, i] = max(work[EFFECTIVE_GAP, i], work[EFFECTIVE_GAP, i - 1] + g[i] - g[i - 1])
    for i in range(n - 2, -1, -1):
        if g[i] > g[i + 1]:
            work[EFFECTIVE_GAP, i] = max(work[EFFECTIVE_GAP, i], work[EFFECTIVE_GAP, i + 1] + g[i] - g[i + 1])


@kernel
def _between(y, g, A, g_least, left, right, work):
    """Interpolate the local factors of the samples between two that are known."""
    h = y[right] - y[left]
    beta_left = work[ONE_BETA, left]
    for i in range(left + 1, right):
        t = (y[i] - y[left]) / h
        work[ONE_BETA, i] = beta_left + t * (work[ONE_BETA, right] - beta_left)
        work[EFFECTIVE_GAP, i] = work[ONE_BETA, i] * (g[i] - g_least)
        alpha = work[STRETCHED_A, left] / A[left]
        work[STRETCHED_A, i] = A[i] * (alpha + t * (work[STRETCHED_A, right] / A[right] - alpha))
        for row in (NR, LOG_ASPECT):
            work[row, i] = work[row, left] + t * (work[row, right] - work[row, left])


@kernel
def _prepare_sample(A, B, g, g_least, i, work):
    one_alpha, one_beta, nr, log_aspect = local_factors(A[i], floored(B))
    work[ONE_BETA, i] = one_beta
    work[EFFECTIVE_GAP, i] = one_beta * (g[i] - g_least)
    work[STRETCHED_A, i] = one_alpha * A[i]
    work[NR, i] = nr
    work[LOG_ASPECT, i] = log_aspect


@kernel
def estimated_approach(y, g, n, g_least, load, modulus, hertz):
    """Approach at which a virtual penetration with the factors of a circle (beta = 0.8, n r = 0.95) carries the load.

    Newton on a convex, piecewise linear function of the samples, started from Hertz's approach at the least point; that is
    also the answer when the patch is narrower than the samples.
    """
    delta = hertz
    for _ in range(12):
        N, width = 0.0, 0.0
        for i in range(1, n - 1):
            d = delta - 1.8 * (g[i] - g_least)
            if d > 0.0:
                cell = 0.5 * (y[i + 1] - y[i - 1])
                N += d * cell
                width += cell
        if width == 0.0:
            return hertz
        change = (load * 0.95 / modulus - N) / width
        delta = max(delta + change, 0.3 * delta)
        if abs(change) < 0.01 * delta:
            break
    return delta


@kernel
def load_at(y, xc, n, delta, modulus, nodes, weights, work, strips, edges):
    """Lay strips at approach `delta` above first touch; return load, stiffness dN/d(delta), strip count, end flag."""
    G = work[EFFECTIVE_GAP]
    m = work[EFFECTIVE_SLOPE]
    count, touches_end = find_patches(y, G, m, n, delta, edges)
    n_strips = lay_strips(edges, count, nodes, weights, strips)
    N = 0.0
    stiffness = 0.0
    k = 0
    for i in range(n_strips):
        at = strips[STRIP_Y, i]
        k = locate(y, n, at, k)
        h = y[k + 1] - y[k]
        t = (at - y[k]) / h
        d = max(delta - cubic(h, G[k], m[k], G[k + 1], m[k + 1], t), 0.0)
        nr = (1.0 - t) * work[NR, k] + t * work[NR, k + 1]
        stretched = (1.0 - t) * work[STRETCHED_A, k] + t * work[STRETCHED_A, k + 1]
        a = math.sqrt(d / stretched)
        strips[STRIP_A, i] = a
        strips[STRIP_P0, i] = 2.0 * modulus / math.pi * math.sqrt(d * stretched) / nr  # Eq. 9.1 with d/a = √(d (1+α) A)
        strips[STRIP_XC, i] = (1.0 - t) * xc[k] + t * xc[k + 1]
        strips[STRIP_ASPECT, i] = (1.0 - t) * work[LOG_ASPECT, k] + t * work[LOG_ASPECT, k + 1]
        N += modulus * d / nr * strips[STRIP_DY, i]
        if d > 0.0:
            stiffness += modulus / nr * strips[STRIP_DY, i]
    return N, stiffness, n_strips, touches_end


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
    if case[CASE_LOAD_KIND] == APPROACH:
        delta = case[CASE_LOAD] - g_least
        if delta <= NO_OVERLAP * (y[n - 1] - y[0]):
            result[RES_STATUS] = 2.0
            result[RES_APPROACH] = case[CASE_LOAD]
            return 0
        prepare(y, g, A, n, y_least, g_least, delta, work)
        N, stiffness, n_strips, touches_end = load_at(y, xc, n, delta, modulus, nodes, weights, work, strips, edges)
    else:
        load = case[CASE_LOAD]
        if load <= 0.0:
            result[RES_STATUS] = 2.0
            result[RES_APPROACH] = g_least
            return 0
        # N ~ delta^(3/2) in Hertz contact: Newton on N^(2/3), bracketed
        k = locate(y, n, y_least, 0)
        B, _, _ = lateral_curvature(y, g, work[GAP_SLOPE], n, k, 0, 0)
        _prepare_sample(A, B, g, g_least, k, work)
        hertz = (0.75 * load / modulus * work[NR, k] * math.sqrt(work[STRETCHED_A, k])) ** (2.0 / 3.0)
        delta = estimated_approach(y, g, n, g_least, load, modulus, hertz)
        reach = 2.0 * max(delta, hertz)
        prepare(y, g, A, n, y_least, g_least, reach, work)
        low, high = 0.0, math.inf
        converged = False
        N, stiffness, n_strips, touches_end = 0.0, 0.0, 0, False
        for iteration in range(_MAX_ITERATIONS):
            result[RES_ITERATIONS] = iteration + 1.0
            N, stiffness, n_strips, touches_end = load_at(y, xc, n, delta, modulus, nodes, weights, work, strips, edges)
            if abs(N - load) <= 1e-11 * load:
                converged = True
                break
            if load > N:
                low = delta
            else:
                high = delta
            if N > 0.0 and stiffness > 0.0:
                step = 1.5 * N / stiffness * (1.0 - (load / N) ** (2.0 / 3.0))
                new = delta - step
            else:
                new = 2.0 * delta
            if not low < new < high or (iteration >= _NEWTON_ITERATIONS and high < math.inf):
                new = 0.5 * (low + high) if high < math.inf else 2.0 * delta
            if new == delta or high - low <= 1e-12 * delta:  # a step: two patches merge within one sample interval
                if load > N and high < math.inf:  # its upper side, whatever the way there
                    delta = high
                    N, stiffness, n_strips, touches_end = load_at(
                        y, xc, n, delta, modulus, nodes, weights, work, strips, edges
                    )
                converged = True
                break
            delta = new
        if not converged:
            result[RES_STATUS] = 5.0
        # what is left of round-off, or of the step at which two patches merge, is taken by the pressure
        if N > 0.0:
            for i in range(n_strips):
                strips[STRIP_P0, i] *= load / N
        N = load
    if touches_end and result[RES_STATUS] == 1.0:
        result[RES_STATUS] = 4.0
    result[RES_N] = N
    result[RES_APPROACH] = delta + g_least
    result[RES_STIFFNESS] = stiffness
    return n_strips
