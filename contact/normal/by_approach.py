"""The methods whose strips follow from the approach in one go, and the search for the approach that carries a load.

A method of this family is a kernel (y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges) that fills `strips`
at approach delta above first touch and returns the load, the number of strips and whether a patch reaches the end of the
data; what does not depend on delta has been prepared in `work`; some also take g and A. Kernels take no functions: `_load_at`
names the methods.
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
    STRIP_P0,
)
from contact.normal import kik_piotrowski as kp
from contact.normal import semi_winkler as sw
from contact.normal import srst as sr
from contact.normal import stripes
from contact.normal.analyn import NO_OVERLAP, fill_strips
from contact.normal.cut import share_gap
from contact.normal.deepest import deepest, unit_load
from contact.normal.kik_piotrowski_2008 import kik_piotrowski_2008
from contact.normal.kpec import kpec
from contact.normal.lay import at_end
from contact.normal.linder import linder
from contact.normal.multi_hertz import multi_hertz
from contact.normal.pascal_sauvage import pascal_sauvage
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

kik_piotrowski, srst = kp.kik_piotrowski, sr.srst

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
        share = kp.PENETRATION
        if method == SRST:
            share = sr.PENETRATION
        elif method == WINKLER:
            share = 1.0
        share_gap(y, g, A, n, point.g, share, work)


@kernel
def _load_at(method, y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges):
    if method in (STRIPES_A, STRIPES_AB):
        N, _, n_strips = fill_strips(y, xc, 0, n - 1, delta, modulus, nodes, weights, work, edges, strips)
        return N, n_strips, at_end(y, n, edges, n_strips // nodes.size)
    if method == KIK_PIOTROWSKI_2008:
        return kik_piotrowski_2008(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == LINDER:
        return linder(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == SRST:
        return srst(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == KPEC:
        return kpec(y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == MULTI_HERTZ:
        return multi_hertz(y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == PASCAL_SAUVAGE:
        return pascal_sauvage(y, g, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == SEMI_WINKLER:
        return sw.semi_winkler(y, A, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    if method == WINKLER:
        return winkler(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)
    return kik_piotrowski(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges)


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
