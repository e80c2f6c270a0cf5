"""Hertz's ellipse from the curvatures at the smallest gap of the separation (theory.md 1.1)."""

import math

from contact.core import kernel
from contact.kernels.cubic import locate
from contact.kernels.enumerations import LoadKind, Status
from contact.kernels.normal.deepest import deepest, first_approach, lowest, touches, unit_load
from contact.kernels.normal.lay import lay_strips
from contact.kernels.rows import Strip

#: Search of the approach: relative error of the load at which it ends, and limit of iterations. The curvatures hardly change
#: with the approach, so two or three are usual, and one where they are constant.
_TOLERANCE, _MAX_ITERATIONS = 1e-13, 60


@kernel
def _approach_under(load, sep, place, modulus, work, result):
    """Return the approach [m] whose curvatures give Hertz's load, by bracketed secants."""
    y, n = sep.y, sep.y.size
    delta = first_approach(y, sep.g, sep.A, n, place, load, modulus, work)
    low, high, before, left_before = 0.0, math.inf, 0.0, -1.0
    if not touches(y, n, delta):  # the load is below round-off
        return 0.0
    for iteration in range(_MAX_ITERATIONS):
        result.iterations = iteration
        unit = unit_load(deepest(y, sep.g, sep.A, n, place, delta, work), modulus)
        own = (load / unit) ** (2.0 / 3.0)  # the approach with these curvatures
        left = delta / own - 1.0
        if abs(left) <= _TOLERANCE:
            return own
        if left < 0.0:
            low = delta
        else:
            high = delta
        new = own
        if iteration > 0 and left != left_before:
            new = delta - left * (delta - before) / (left - left_before)
        if not low < new < high:
            new = 0.5 * (low + high) if high < math.inf else 2.0 * delta
        if new == delta or high - low <= 1e-14 * delta:
            return delta
        before, left_before, delta = delta, left, new
    result.status = Status.NOT_CONVERGED
    return delta


@kernel
def hertzian(sep, case, across, work, strips, result):
    """Solve the normal problem as if A and B were constant. Arguments and results are those of `analyn`."""
    y, xc, n = sep.y, sep.x_c, sep.y.size
    modulus = case.G / (1.0 - case.nu)
    edges = result.edges
    place = lowest(y, sep.g, n, work)
    result.status = Status.OK
    result.iterations = 0
    result.touch = place[1]
    if case.load_kind == LoadKind.APPROACH:
        delta = case.amount - place[1]
        result.approach = case.amount
    else:
        delta = _approach_under(case.amount, sep, place, modulus, work, result) if case.amount > 0.0 else 0.0
        result.approach = place[1] + delta
    if not touches(y, n, delta):
        result.status = Status.NO_CONTACT
        return 0
    # at approach delta: a² = delta/((1+alpha)A), b² = delta/((1+beta)B), p0 = 2 E* delta/(pi n r a), N = 2/3 pi a b p0
    point = deepest(y, sep.g, sep.A, n, place, delta, work)
    unit = unit_load(point, modulus)
    b2 = delta / (point.one_beta * point.B)
    edges[0], edges[1] = point.y - math.sqrt(b2), point.y + math.sqrt(b2)
    if edges[0] < y[0] or edges[1] > y[n - 1]:
        result.status = Status.OUT_OF_RANGE
    n_strips = lay_strips(edges, 1, across, strips)
    k = locate(y, n, point.y, 0)
    t = (point.y - y[k]) / (y[k + 1] - y[k])
    centre = (1.0 - t) * xc[k] + t * xc[k + 1]
    for i in range(n_strips):
        d = delta * max(1.0 - (strips[Strip.Y, i] - point.y) ** 2 / b2, 0.0)
        strips[Strip.A, i] = math.sqrt(d / (point.one_alpha * point.A))
        strips[Strip.P0, i] = 2.0 * modulus / math.pi * math.sqrt(d * point.one_alpha * point.A) / point.nr
        strips[Strip.XC, i] = centre
        strips[Strip.LN_ASPECT, i] = point.log_aspect
    result.N = unit * delta**1.5
    result.stiffness = 1.5 * unit * math.sqrt(delta)
    return n_strips
