"""Methods whose strips follow from the approach without iteration, and the search for the approach that carries a load.

All methods of virtual penetration have one sequence. An effective gap, prepared in `work`, is cut at the approach. Then
the strips get their shape, then their pressure. `_load_at` shows this sequence. The file of a method has only what is
specific to it.
"""

import math

from contact.core import kernel
from contact.kernels.enumerations import LoadKind, Normal, Status
from contact.kernels.normal import semi_winkler as sw
from contact.kernels.normal import srst as sr
from contact.kernels.normal import stripes
from contact.kernels.normal.analyn import fill_strips
from contact.kernels.normal.deepest import deepest, first_approach, lowest, touches
from contact.kernels.normal.kik_piotrowski import PENETRATION, deepest_half_length
from contact.kernels.normal.kik_piotrowski_2008 import stretch
from contact.kernels.normal.kpec import share_parabola
from contact.kernels.normal.lay import at_end
from contact.kernels.normal.linder import local_ellipses
from contact.kernels.normal.multi_hertz import beyond, multi_hertz
from contact.kernels.normal.pascal_sauvage import one_ellipse
from contact.kernels.normal.virtual_penetration import carried, cut, equivalent_aspect, set_pressures, share_gap
from contact.kernels.normal.winkler import winkler
from contact.kernels.rows import Strip

#: Number of secant steps before bisection, which converges to a step of the load, and limit of iterations.
_SECANT_ITERATIONS, MAX_ITERATIONS = 20, 70
#: Relative step of the difference quotient that gives the stiffness.
_DIFFERENCE = 1e-6


@kernel
def _prepare(method, sep, point, work):
    """Fill the effective gap, curvature and factors of the samples in `work`."""
    y, g, A, n = sep.y, sep.g, sep.A, sep.y.size
    if method == Normal.STRIPES_A or method == Normal.STRIPES_AB:
        stripes.prepare(y, g, A, n, point, method == Normal.STRIPES_AB, work)
    elif method == Normal.SEMI_WINKLER:
        sw.prepare(y, g, A, n, point, work)
    elif method != Normal.KPEC and method != Normal.MULTI_HERTZ and method != Normal.PASCAL_SAUVAGE:
        share = PENETRATION
        if method == Normal.SRST:
            share = sr.PENETRATION
        elif method == Normal.WINKLER:
            share = 1.0
        share_gap(y, g, A, n, point.g, share, work)


@kernel
def _load_at(case, sep, delta, place, across, work, strips, edges):
    """Fill `strips` at approach delta. Return load [N], number of strips and whether the patch reaches the end of the data."""
    method, modulus = case.normal, case.G / (1.0 - case.nu)
    y, n, panel = sep.y, sep.y.size, across.nodes.size
    point = deepest(y, sep.g, sep.A, n, place, delta, work)
    _prepare(method, sep, point, work)
    if method == Normal.STRIPES_A or method == Normal.STRIPES_AB:
        N, _, n_strips = fill_strips(sep, delta, modulus, across, work, edges, strips)
        return N, n_strips, at_end(y, n, edges, n_strips // panel)
    if method == Normal.MULTI_HERTZ or method == Normal.PASCAL_SAUVAGE:
        N, n_strips = multi_hertz(sep, delta, modulus, point, across, work, strips, edges)
        if method == Normal.PASCAL_SAUVAGE:
            n_strips = one_ellipse(sep, N, n_strips, delta, modulus, across, strips, edges)
        return N, n_strips, beyond(y, n, edges, n_strips // panel)

    level, log_aspect, a0, at = delta, 0.0, deepest_half_length(delta, point), point.y
    if method == Normal.KPEC:
        level, log_aspect, a0 = share_parabola(y, sep.g, sep.A, n, delta, point, work, edges)
    n_strips, touches_end = cut(sep, level, across, work, strips, edges)
    if method == Normal.SEMI_WINKLER:
        sw.semi_winkler(sep, delta, modulus, point, across, work, strips, n_strips)
    elif method == Normal.KIK_PIOTROWSKI_2008:
        factor, at = stretch(strips, n_strips, panel, edges, point)
        a0 *= factor
    equivalent_aspect(strips, n_strips)
    if method == Normal.KPEC:
        strips[Strip.LN_ASPECT, :n_strips] = log_aspect
    elif method == Normal.LINDER:
        local_ellipses(strips, n_strips, edges)
    if method == Normal.WINKLER:
        winkler(strips, n_strips, delta, modulus, point)
    elif method == Normal.SRST:
        sr.srst(strips, n_strips, modulus, point)
    elif method != Normal.SEMI_WINKLER:
        set_pressures(strips, n_strips, edges, at, a0, delta, modulus)
    return carried(strips, n_strips), n_strips, touches_end


@kernel
def by_approach(sep, case, across, work, strips, result):
    """Solve the normal problem. Arguments and results are those of `analyn`."""
    y, n, edges = sep.y, sep.y.size, result.edges
    place = lowest(y, sep.g, n, work)
    result.status, result.iterations, result.touch = Status.OK, 0, place[1]
    load, modulus = case.amount, case.G / (1.0 - case.nu)
    by_load = case.load_kind != LoadKind.APPROACH
    delta = load - place[1]
    if by_load:
        delta = first_approach(y, sep.g, sep.A, n, place, load, modulus, work) if load > 0.0 else 0.0
    result.approach = place[1] + delta
    if not touches(y, n, delta):
        result.status = Status.NO_CONTACT
        return 0

    if by_load:
        # N ~ delta^(3/2) in Hertz contact, so a bracketed secant on N^(2/3)
        target = load ** (2.0 / 3.0)
        low, high, delta_before, before = 0.0, math.inf, 0.0, 0.0
        converged = False
        for iteration in range(MAX_ITERATIONS):
            result.iterations = iteration + 1
            N, n_strips, touches_end = _load_at(case, sep, delta, place, across, work, strips, edges)
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
            if new == delta or high - low <= 1e-13 * delta:  # the load has a step here
                converged = True
                break
            delta_before, before, delta = delta, now, new
        if not converged:
            result.status = Status.NOT_CONVERGED

    further, _, _ = _load_at(case, sep, delta * (1.0 + _DIFFERENCE), place, across, work, strips, edges)
    N, n_strips, touches_end = _load_at(case, sep, delta, place, across, work, strips, edges)
    if n_strips == 0 or N <= 0.0:
        result.status = Status.NO_CONTACT
        return 0
    result.stiffness = max(further - N, 0.0) / (_DIFFERENCE * delta)
    if by_load:  # the pressure is scaled to remove the rest of round-off or of a step
        for i in range(n_strips):
            strips[Strip.P0, i] *= load / N
        N = load
    if touches_end and result.status == Status.OK:
        result.status = Status.OUT_OF_RANGE
    result.N, result.approach = N, place[1] + delta
    return n_strips
