"""The normal problem by any method, and its elastic-perfectly plastic limit (theory.md 8.4).

No element bears more than the limit p_c. The elastic pressure is limited to it, and the bodies approach until the rest carries
the load (after Sebès et al. 2014). A strip of peak p0 and half length a keeps

    N' = π/2 p0 a · kept(p_c/p0),   kept(c) = 2/π (c √(1 - c²) + asin c).

The limited load rises with the elastic one, so the problem has one solution. Load, moments and the
tangential problem work on semi-ellipses. For them a strip gets the peak p0·kept of the semi-ellipse with its load and length.
"""

import math

from contact.core import entry, kernel
from contact.kernels.enumerations import LoadKind, NormalFamily, Status
from contact.kernels.normal.analyn import analyn
from contact.kernels.normal.by_approach import by_approach
from contact.kernels.normal.hertzian import hertzian
from contact.kernels.normal.strip_halfspace import strip_halfspace
from contact.kernels.result import clear
from contact.kernels.rows import Element, Strip

#: Of the load on which the iteration stops; what is left is taken by the pressure. Cap, and steps of the stiffness: interacting
#: strips are solved to 1e-4 only.
_TOLERANCE, _MAX_ITERATIONS, _DIFFERENCE, _COARSE_DIFFERENCE = 1e-10, 60, 1e-3, 3e-2


@entry
def kept(c: float) -> float:
    """Return the share of its load that a semi-elliptic pressure keeps when it is limited to `c` < 1 of its peak."""
    return 2.0 / math.pi * (c * math.sqrt(1.0 - c * c) + math.asin(c))


@kernel
def share_of(p0, limit):
    """Return the share of its load that a strip of peak p0 keeps. A limit of 0 means none."""
    return kept(limit / p0) if 0.0 < limit < p0 else 1.0


@kernel
def fill_limited(elements, p0, limit, row):
    """Fill the mean limited pressure of each element of a strip with p0 > limit. They add up to the strip's load."""
    c = limit / p0
    t = math.sqrt(1.0 - c * c)
    outer = 0.5 * (math.asin(c) - t * c)  # ∫√(1-s²) from t to 1
    before = 0.0
    for k in range(elements.shape[1]):
        s, load = math.cos(elements[Element.ANGLE_END, k]), elements[Element.LOAD_END, k]
        if s < -t:
            load += 2.0 * (outer + c * t) - 0.5 * math.pi
        elif s < t:
            load = outer + c * (t - s)
        row[k] = p0 * (load - before) / elements[Element.DX, k]
        before = load


@kernel
def _elastic(sep, case, workspace, result):
    """Solve the elastic normal problem by the method of the case; return the strip count."""
    across, grid, strips = workspace.rule.across, workspace.space.grid, workspace.strips
    clear(result)
    if case.normal_family == NormalFamily.HERTZ:
        return hertzian(sep, case, across, grid, strips, result)
    if case.normal_family == NormalFamily.STRIP_HALFSPACE:
        return strip_halfspace(sep, case, workspace, result)
    if case.normal_family == NormalFamily.BY_APPROACH:
        return by_approach(sep, case, across, grid, strips, result)
    return analyn(sep, case, across, grid, strips, result)


@kernel
def _limited_load(strips, n, limit):
    """Return the load of `n` elastic strips after their pressure is limited [N]."""
    N = 0.0
    for i in range(n):
        p0 = strips[Strip.P0, i]
        N += 0.5 * math.pi * p0 * share_of(p0, limit) * strips[Strip.A, i] * strips[Strip.DY, i]
    return N


@kernel
def _find_elastic_load(load, n, sep, case, workspace, result):
    """Find the elastic load of `case` whose limited pressure carries `load` by a bracketed secant; return the strip count."""
    limit = case.pressure_limit
    before, previous, low, high = 0.0, 0.0, 0.0, math.inf
    now, carried = load, _limited_load(workspace.strips, n, limit)
    for _ in range(_MAX_ITERATIONS):
        if abs(carried - load) <= _TOLERANCE * load or (high < math.inf and high - low <= 1e-14 * high):
            return n
        if carried < load:
            low = now
        else:
            high = now
        new = now + (load - carried) * (now - before) / (carried - previous) if carried != previous else -1.0
        if not low < new < high:
            new = 0.5 * (low + high) if high < math.inf else 2.0 * now
        before, previous, now = now, carried, min(new, 4.0 * now)
        case.amount = now
        n = _elastic(sep, case, workspace, result)
        carried = _limited_load(workspace.strips, n, limit)
    if result.status == Status.OK:
        result.status = Status.NOT_CONVERGED
    return n


@kernel
def press(sep, case, workspace, result):
    """Solve the normal problem; return the strip count.

    The strips hold the elastic pressure, `result` the limited one. Where the limit is reached, `result.N` is the load that
    was asked for or, at a given approach, the load of the limited pressure.
    """
    n = _elastic(sep, case, workspace, result)
    strips, limit, top = workspace.strips, case.pressure_limit, 0.0
    for i in range(n):
        top = max(top, strips[Strip.P0, i])
    if not 0.0 < limit < top:
        return n
    workspace.space.case[0] = case
    trial = workspace.space.case[0]  # the elastic problem whose limited pressure is the solution
    by_load = case.load_kind == LoadKind.LOAD
    if by_load:
        n = _find_elastic_load(case.amount, n, sep, trial, workspace, result)
    elastic_N, approach, status = trial.amount, result.approach, result.status
    carried = _limited_load(strips, n, limit)
    # the slope of the limited load, from a step in the approach; then back
    coarse = case.normal_family == NormalFamily.STRIP_HALFSPACE
    step = (_COARSE_DIFFERENCE if coarse else _DIFFERENCE) * (approach - result.touch)
    trial.load_kind, trial.amount = LoadKind.APPROACH, approach + step
    further = _limited_load(strips, _elastic(sep, trial, workspace, result), limit)
    trial.load_kind, trial.amount = case.load_kind, elastic_N
    n = _elastic(sep, trial, workspace, result)
    result.status = max(status, result.status)
    result.stiffness = max(further - carried, 0.0) / step
    result.N = case.amount if by_load else carried
    return n
