"""The normal problem by any method, and its elastic-perfectly plastic limit (theory.md 8.4).

No element bears more than the limit p_c: the pressure of the elastic solution is cut there, and the bodies approach until what
is left carries the load (after Sebès et al. 2014). A strip of peak p0 and half length a keeps

    N' = π/2 p0 a · kept(p_c/p0),   kept(c) = 2/π (c √(1 - c²) + asin c).

The cut load rises with the elastic one, so the problem has one solution. For what works on semi-ellipses - load and moments of
a strip, the tangential problem - the strip gets the peak p0·kept of the semi-ellipse with its load and length.
"""

import math

from contact._jit import kernel
from contact._layout import (
    APPROACH,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_NORMAL,
    CASE_PRESSURE_LIMIT,
    LOAD,
    RES_APPROACH,
    RES_N,
    RES_STATUS,
    RES_STIFFNESS,
    RES_TOUCH,
    STRIP_A,
    STRIP_DY,
    STRIP_P0,
)
from contact.normal.analyn import analyn
from contact.normal.by_approach import by_approach
from contact.normal.hertzian import hertzian
from contact.normal.strip_halfspace import strip_halfspace
from contact.quadrature import EL_ANGLE_END, EL_DX, EL_LOAD_END
from contact.registry import HERTZ, KIK_PIOTROWSKI, STRIP_HALFSPACE

#: Of the load on which the iteration stops; what is left is taken by the pressure. Cap, and steps of the stiffness: interacting
#: strips are solved to 1e-4 only.
_TOLERANCE, _MAX_ITERATIONS, _DIFFERENCE, _COARSE_DIFFERENCE = 1e-10, 60, 1e-3, 3e-2


@kernel
def kept(c):
    """Share of its load that a semi-elliptic pressure keeps when it is cut at `c` < 1 of its peak."""
    return 2.0 / math.pi * (c * math.sqrt(1.0 - c * c) + math.asin(c))


@kernel
def share_of(p0, limit):
    """Share of its load that a strip of peak p0 keeps; a limit of 0 stands for none."""
    return kept(limit / p0) if 0.0 < limit < p0 else 1.0


@kernel
def fill_cut(elements, p0, limit, row):
    """Mean pressure over each element of a strip whose peak p0 > limit is cut: the strip's load to round-off."""
    c = limit / p0
    t = math.sqrt(1.0 - c * c)
    outer = 0.5 * (math.asin(c) - t * c)  # ∫√(1-s²) from t to 1
    before = 0.0
    for k in range(elements.shape[1]):
        s, load = math.cos(elements[EL_ANGLE_END, k]), elements[EL_LOAD_END, k]
        if s < -t:
            load += 2.0 * (outer + c * t) - 0.5 * math.pi
        elif s < t:
            load = outer + c * (t - s)
        row[k] = p0 * (load - before) / elements[EL_DX, k]
        before = load


@kernel
def _elastic(y, g, A, xc, case, rule, tables, space, strips, result):
    """Solve the elastic normal problem by the method of the case; return the strip count."""
    result[:] = 0.0
    if case[CASE_NORMAL] == HERTZ:
        return hertzian(y, g, A, xc, case, rule.nodes, rule.weights, space.grid, strips, result)
    if case[CASE_NORMAL] == STRIP_HALFSPACE:
        return strip_halfspace(y, g, A, xc, case, rule, tables, space, strips, result)
    if case[CASE_NORMAL] >= KIK_PIOTROWSKI:
        return by_approach(y, g, A, xc, case, rule.nodes, rule.weights, space.grid, strips, result)
    return analyn(y, g, A, xc, case, rule.nodes, rule.weights, space.grid, strips, result)


@kernel
def _cut_load(strips, n, limit):
    """Load of `n` elastic strips after the cut."""
    N = 0.0
    for i in range(n):
        p0 = strips[STRIP_P0, i]
        N += 0.5 * math.pi * p0 * share_of(p0, limit) * strips[STRIP_A, i] * strips[STRIP_DY, i]
    return N


@kernel
def _find_elastic_load(load, n, y, g, A, xc, case, rule, tables, space, strips, result):
    """Raise the elastic load until its cut pressure carries `load`, by a bracketed secant; return the strip count."""
    limit = case[CASE_PRESSURE_LIMIT]
    before, cut_before, low, high = 0.0, 0.0, 0.0, math.inf
    now, cut = load, _cut_load(strips, n, limit)
    for _ in range(_MAX_ITERATIONS):
        if abs(cut - load) <= _TOLERANCE * load or (high < math.inf and high - low <= 1e-14 * high):
            return n
        if cut < load:
            low = now
        else:
            high = now
        new = now + (load - cut) * (now - before) / (cut - cut_before) if cut != cut_before else -1.0
        if not low < new < high:
            new = 0.5 * (low + high) if high < math.inf else 2.0 * now
        before, cut_before, now = now, cut, min(new, 4.0 * now)
        case[CASE_LOAD] = now
        n = _elastic(y, g, A, xc, case, rule, tables, space, strips, result)
        cut = _cut_load(strips, n, limit)
    if result[RES_STATUS] == 1.0:
        result[RES_STATUS] = 5.0
    return n


@kernel
def press(y, g, A, xc, case, rule, tables, space, strips, result):
    """Solve the normal problem; return the strip count. `strips` hold the elastic pressure, uncut, `result` what is left.

    Where it is cut the load that was asked for, or at an approach what the cut leaves, is in RES_N.
    """
    n = _elastic(y, g, A, xc, case, rule, tables, space, strips, result)
    limit = case[CASE_PRESSURE_LIMIT]
    top = 0.0
    for i in range(n):
        top = max(top, strips[STRIP_P0, i])
    if not 0.0 < limit < top:
        return n
    kind, amount = case[CASE_LOAD_KIND], case[CASE_LOAD]
    if kind == LOAD:
        n = _find_elastic_load(amount, n, y, g, A, xc, case, rule, tables, space, strips, result)
    elastic_N, approach, status = case[CASE_LOAD], result[RES_APPROACH], result[RES_STATUS]
    cut = _cut_load(strips, n, limit)
    # the slope of the cut load, from a step in the approach; then back
    step = (_COARSE_DIFFERENCE if case[CASE_NORMAL] == STRIP_HALFSPACE else _DIFFERENCE) * (
        approach - result[RES_TOUCH]
    )
    case[CASE_LOAD_KIND], case[CASE_LOAD] = APPROACH, approach + step
    further = _cut_load(strips, _elastic(y, g, A, xc, case, rule, tables, space, strips, result), limit)
    case[CASE_LOAD_KIND], case[CASE_LOAD] = kind, elastic_N
    n = _elastic(y, g, A, xc, case, rule, tables, space, strips, result)
    case[CASE_LOAD], result[RES_STATUS] = amount, max(status, result[RES_STATUS])
    result[RES_STIFFNESS] = max(further - cut, 0.0) / step
    result[RES_N] = amount if kind == LOAD else cut
    return n
