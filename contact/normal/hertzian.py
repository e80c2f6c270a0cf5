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
from contact.normal.analyn import NO_OVERLAP
from contact.normal.deepest import deepest, unit_load
from contact.normal.lay import lay_strips, locate


@kernel
def hertzian(y, g, A, xc, case, nodes, weights, work, strips, result):
    """Solve as if A and B were constant; same arguments and answers as `analyn`."""
    n = y.size
    modulus = case[CASE_G] / (1.0 - case[CASE_NU])
    edges = result[RES_EDGES:]
    point = deepest(y, g, A, n, work)
    # at approach delta: a² = delta/((1+alpha)A), b² = delta/((1+beta)B), p0 = 2 E* delta/(pi n r a), N = 2/3 pi a b p0
    unit = unit_load(point, modulus)
    result[RES_STATUS] = 1.0
    result[RES_ITERATIONS] = 0.0
    result[RES_TOUCH] = point.g
    if case[CASE_LOAD_KIND] == APPROACH:
        delta = case[CASE_LOAD] - point.g
        result[RES_APPROACH] = case[CASE_LOAD]
    else:
        delta = (max(case[CASE_LOAD], 0.0) / unit) ** (2.0 / 3.0)
        result[RES_APPROACH] = point.g + delta
    if delta <= NO_OVERLAP * (y[n - 1] - y[0]):
        result[RES_STATUS] = 2.0
        return 0
    b2 = delta / (point.one_beta * point.B)
    edges[0], edges[1] = point.y - math.sqrt(b2), point.y + math.sqrt(b2)
    if edges[0] < y[0] or edges[1] > y[n - 1]:
        result[RES_STATUS] = 4.0
    n_strips = lay_strips(edges, 1, nodes, weights, strips)
    k = locate(y, n, point.y, 0)
    t = (point.y - y[k]) / (y[k + 1] - y[k])
    centre = (1.0 - t) * xc[k] + t * xc[k + 1]
    for i in range(n_strips):
        d = delta * max(1.0 - (strips[STRIP_Y, i] - point.y) ** 2 / b2, 0.0)
        strips[STRIP_A, i] = math.sqrt(d / (point.one_alpha * point.A))
        strips[STRIP_P0, i] = 2.0 * modulus / math.pi * math.sqrt(d * point.one_alpha * point.A) / point.nr
        strips[STRIP_XC, i] = centre
        strips[STRIP_ASPECT, i] = point.log_aspect
    result[RES_N] = unit * delta**1.5
    result[RES_STIFFNESS] = 1.5 * unit * math.sqrt(delta)
    return n_strips
