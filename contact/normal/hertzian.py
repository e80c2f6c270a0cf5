"""Hertz's ellipse from the curvatures at the least point of the separation (theory.md 1.1)."""

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
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.hertz import local_factors
from contact.normal.analyn import GAP_SLOPE, NO_OVERLAP, floored, lateral_curvature
from contact.normal.lay import lay_strips, least_point, locate, slopes


@kernel
def hertzian(y, g, A, xc, case, nodes, weights, work, strips, result):
    """Solve as if A and B were constant; same arguments and answers as `analyn`."""
    n = y.size
    modulus = case[CASE_G] / (1.0 - case[CASE_NU])
    edges = result[RES_EDGES:]
    m = work[GAP_SLOPE]
    slopes(y, g, n, m)
    y_least, g_least = least_point(y, g, m, n)
    k = locate(y, n, y_least, 0)
    t = (y_least - y[k]) / (y[k + 1] - y[k])
    A0 = (1.0 - t) * A[k] + t * A[k + 1]
    B_left, below, above = lateral_curvature(y, g, m, n, k, 0, 0)
    B_right, _, _ = lateral_curvature(y, g, m, n, k + 1, below, above)
    B0 = floored((1.0 - t) * B_left + t * B_right)
    one_alpha, one_beta, nr, log_aspect = local_factors(A0, B0)
    # at approach delta: a² = delta/((1+alpha)A), b² = delta/((1+beta)B), p0 = 2 E* delta/(pi n r a), N = 2/3 pi a b p0
    unit = 4.0 / 3.0 * modulus / (nr * math.sqrt(one_beta * B0))
    result[RES_STATUS] = 1.0
    result[RES_ITERATIONS] = 0.0
    result[RES_TOUCH] = g_least
    if case[CASE_LOAD_KIND] == APPROACH:
        delta = case[CASE_LOAD] - g_least
        result[RES_APPROACH] = case[CASE_LOAD]
    else:
        delta = (max(case[CASE_LOAD], 0.0) / unit) ** (2.0 / 3.0)
        result[RES_APPROACH] = g_least + delta
    if delta <= NO_OVERLAP * (y[n - 1] - y[0]):
        result[RES_STATUS] = 2.0
        return 0
    b2 = delta / (one_beta * B0)
    edges[0], edges[1] = y_least - math.sqrt(b2), y_least + math.sqrt(b2)
    if edges[0] < y[0] or edges[1] > y[n - 1]:
        result[RES_STATUS] = 4.0
    n_strips = lay_strips(edges, 1, nodes, weights, strips)
    centre = (1.0 - t) * xc[k] + t * xc[k + 1]
    for i in range(n_strips):
        d = delta * max(1.0 - (strips[STRIP_Y, i] - y_least) ** 2 / b2, 0.0)
        strips[STRIP_A, i] = math.sqrt(d / (one_alpha * A0))
        strips[STRIP_P0, i] = 2.0 * modulus / math.pi * math.sqrt(d * one_alpha * A0) / nr
        strips[STRIP_XC, i] = centre
        strips[STRIP_ASPECT, i] = log_aspect
    result[RES_N] = unit * delta**1.5
    result[RES_STIFFNESS] = 1.5 * unit * math.sqrt(delta)
    return n_strips
