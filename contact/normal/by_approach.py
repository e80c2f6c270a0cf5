"""The methods whose strips follow from the approach in one go, and the search for the approach that carries a load.

Virtual penetration is one sequence: an effective gap, prepared in `work`, is cut at the approach, the strips get their shape,
then their pressure. `_load_at` shows it; a method's file holds what only that method does.
"""

import math

from contact._jit import kernel
from contact._layout import (
    APPROACH,
    CASE_G,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_NORMAL,
    CASE_NU,
    RES_APPROACH,
    RES_EDGES,
    RES_ITERATIONS,
    RES_N,
    RES_STATUS,
    RES_STIFFNESS,
    RES_TOUCH,
    STRIP_ASPECT,
    STRIP_P0,
)
from contact.normal import semi_winkler as sw
from contact.normal import srst as sr
from contact.normal import stripes
from contact.normal.analyn import NO_OVERLAP, fill_strips
from contact.normal.cut import carried, cut, equivalent_aspect, press, share_gap
from contact.normal.deepest import deepest, unit_load
from contact.normal.kik_piotrowski import PENETRATION, deepest_half_length
from contact.normal.kik_piotrowski_2008 import stretch
from contact.normal.kpec import share_parabola
from contact.normal.lay import at_end
from contact.normal.linder import local_ellipses
from contact.normal.multi_hertz import beyond, multi_hertz
from contact.normal.pascal_sauvage import one_ellipse
from contact.normal.winkler import winkler
from contact.registry import (
    KIK_PIOTROWSKI_2008,
    KPEC,
    LINDER,
    MULTI_HERTZ,
    PASCAL_SAUVAGE,
    SEMI_WINKLER,
    SRST,
    STRIPES_A,
    STRIPES_AB,
    WINKLER,
)

#: Secant steps before bisection, which closes in on a step of the load, and the cap.
_SECANT_ITERATIONS, MAX_ITERATIONS = 20, 70
#: Relative step of the difference quotient that gives the stiffness.
_DIFFERENCE = 1e-6


@kernel
def _prepare(method, y, g, A, n, point, work):
    if method in (STRIPES_A, STRIPES_AB):
        stripes.prepare(y, g, A, n, point, method == STRIPES_AB, work)
    elif method == SEMI_WINKLER:
        sw.prepare(y, g, A, n, point, work)
    elif method not in (KPEC, MULTI_HERTZ, PASCAL_SAUVAGE):
        share = PENETRATION
        if method == SRST:
            share = sr.PENETRATION
        elif method == WINKLER:
            share = 1.0
        share_gap(y, g, A, n, point.g, share, work)


@kernel
def _load_at(method, y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges):
    """Fill `strips` at approach delta; return load, number of strips and whether the patch reaches the end of the data."""
    if method in (STRIPES_A, STRIPES_AB):
        N, _, n_strips = fill_strips(y, xc, n, delta, modulus, nodes, weights, work, edges, strips)
        return N, n_strips, at_end(y, n, edges, n_strips // nodes.size)
    if method in (MULTI_HERTZ, PASCAL_SAUVAGE):
        N, n_strips = multi_hertz(y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
        if method == PASCAL_SAUVAGE:
            n_strips = one_ellipse(y, A, xc, n, N, n_strips, delta, modulus, nodes, weights, strips, edges)
        return N, n_strips, beyond(y, n, edges, n_strips // nodes.size)

    level, log_aspect, a0, at = delta, 0.0, deepest_half_length(delta, point), point.y
    if method == KPEC:
        level, log_aspect, a0 = share_parabola(y, g, A, n, delta, point, work, edges)
    n_strips, touches_end = cut(y, xc, n, level, nodes, weights, work, strips, edges)
    if method == SEMI_WINKLER:
        sw.semi_winkler(y, A, n, delta, modulus, point, nodes, weights, work, strips, n_strips)
    elif method == KIK_PIOTROWSKI_2008:
        factor, at = stretch(strips, n_strips, nodes.size, edges, point)
        a0 *= factor
    equivalent_aspect(strips, n_strips)
    if method == KPEC:
        strips[STRIP_ASPECT, :n_strips] = log_aspect
    elif method == LINDER:
        local_ellipses(strips, n_strips, edges)
    if method == WINKLER:
        winkler(strips, n_strips, delta, modulus, point)
    elif method == SRST:
        sr.srst(strips, n_strips, modulus, point)
    elif method != SEMI_WINKLER:
        press(strips, n_strips, edges, at, a0, delta, modulus)
    return carried(strips, n_strips), n_strips, touches_end


@kernel
def by_approach(y, g, A, xc, case, nodes, weights, work, strips, result):
    """Solve the normal problem; same arguments and answers as `analyn`."""
    n = y.size
    method = case[CASE_NORMAL]
    modulus = case[CASE_G] / (1.0 - case[CASE_NU])
    edges = result[RES_EDGES:]
    point = deepest(y, g, A, n, work)
    result[RES_STATUS], result[RES_ITERATIONS], result[RES_TOUCH] = 1.0, 0.0, point.g
    load = case[CASE_LOAD]
    by_load = case[CASE_LOAD_KIND] != APPROACH
    delta = (max(load, 0.0) / unit_load(point, modulus)) ** (2.0 / 3.0) if by_load else load - point.g
    result[RES_APPROACH] = point.g + delta
    if delta <= NO_OVERLAP * (y[n - 1] - y[0]):
        result[RES_STATUS] = 2.0
        return 0
    _prepare(method, y, g, A, n, point, work)

    if by_load:
        # N ~ delta^(3/2) in Hertz contact: secant on N^(2/3), bracketed
        target = load ** (2.0 / 3.0)
        low, high, delta_before, before = 0.0, math.inf, 0.0, 0.0
        converged = False
        for iteration in range(MAX_ITERATIONS):
            result[RES_ITERATIONS] = iteration + 1.0
            N, n_strips, touches_end = _load_at(
                method, y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges
            )
            if abs(N - load) <= 1e-11 * load:
                converged = True
                break
            if load > N:
                low = delta
            else:
                high = delta
            now = N ** (2.0 / 3.0)
            new = delta + (target - now) * (delta - delta_before) / (now - before) if now != before else -1.0
            if not low < new < high or (iteration >= _SECANT_ITERATIONS and high < math.inf):
                new = 0.5 * (low + high) if high < math.inf else 2.0 * delta
            if new == delta or high - low <= 1e-13 * delta:  # a step of the load
                converged = True
                break
            delta_before, before, delta = delta, now, new
        if not converged:
            result[RES_STATUS] = 5.0

    further, _, _ = _load_at(
        method, y, g, A, xc, n, delta * (1.0 + _DIFFERENCE), modulus, point, nodes, weights, work, strips, edges
    )
    N, n_strips, touches_end = _load_at(
        method, y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges
    )
    if n_strips == 0 or N <= 0.0:
        result[RES_STATUS] = 2.0
        return 0
    result[RES_STIFFNESS] = max(further - N, 0.0) / (_DIFFERENCE * delta)
    if by_load:  # what is left of round-off, or of a step, is taken by the pressure
        for i in range(n_strips):
            strips[STRIP_P0, i] *= load / N
        N = load
    if touches_end and result[RES_STATUS] == 1.0:
        result[RES_STATUS] = 4.0
    result[RES_N], result[RES_APPROACH] = N, point.g + delta
    return n_strips
