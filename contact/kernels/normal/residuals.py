"""Pressures of the strips, and residuals of their half lengths and offsets (strip_halfspace.md 2, steps 1 to 3)."""

import math

from contact.core import kernel
from contact.kernels.normal.between_panels import distances
from contact.kernels.normal.descent import COARSE
from contact.kernels.normal.factors import set_factors
from contact.kernels.normal.panels import half_lengths, is_between_loaded, lay_panels, place_middles
from contact.kernels.normal.strip_system import assemble, solve_active
from contact.kernels.rows import Vector

#: Weight of straightening from which on it is stiff: the residuals themselves, as steps, would swing.
_STIFF = 0.5
#: Mean residual, weighted by pressures, in the panel with the largest pressure, from which on that panel is not at rest. It may
#: carry so little load that the mean over all strips does not tell.
AT_PEAK = 0.02
#: Pressure of a strip over that of its neighbours, from which on it is no peak but swings, where offsets count in full.
LONE = 2.0
#: A pressure is a spike of an end that was fixed inside the contact if at most this share of the strips lies beyond, and if the
#: pressures inwards fall to this share of it and rise again to so much over that.
AT_END, _FALLEN, _RISEN = 0.12, 0.5, 1.5
#: Share of the load below which strips are too light to tell the largest pressure where the unknowns are not at rest.
_LIGHT = 0.01


@kernel
def find_pressures(problem, delta, n_panels):
    """Lay the strips between the ends of the panels and find their pressures. Return the approach above first touch [m].

    `delta` is the approach so far, which bounds the half lengths.
    """
    workspace, panels = problem.workspace, problem.panels
    n = workspace.rule.across.nodes.size
    lay_panels(problem.sep, problem.touch, problem.skew, panels, n_panels, workspace)
    if problem.skew > 0.0:
        place_middles(workspace.space.vectors, n, n_panels, delta)
    half_lengths(panels, workspace.space.vectors, n, n_panels, delta)
    distances(panels, n_panels, workspace)
    set_factors(panels, n_panels, problem.skew > 0.0, workspace.rule.factors, n, workspace.space.vectors)
    assemble(panels, n_panels, workspace, problem.skew > 0.0, problem.unit)
    return solve_active(n, n_panels, workspace.space, problem.by_load, problem.amount)


@kernel
def _bend(i, vectors):
    """Return how far a strip's middle would have to move to lie in line with its neighbours' [m]."""
    before, after = vectors[Vector.Y, i] - vectors[Vector.Y, i - 1], vectors[Vector.Y, i + 1] - vectors[Vector.Y, i]
    in_line = after * vectors[Vector.XC, i - 1] + before * vectors[Vector.XC, i + 1]
    return in_line / (before + after) - vectors[Vector.XC, i]


@kernel
def is_stiff(straighten):
    """Return whether the offsets' residuals are steps already, with this weight of straightening."""
    return straighten > _STIFF


@kernel
def _weight(i, n, straighten, vectors):
    """Return the weight of straightening of a strip.

    A bend falls with the square of the strip's width. That falls with 1/n in the middle of a panel, but with 1/n² at its ends.
    There strips are straightened as if they were as wide as the end strip of a panel of `COARSE` strips.
    """
    if not is_stiff(straighten):
        return straighten
    coarse = n / COARSE * vectors[Vector.HALF, i - i % n] / vectors[Vector.HALF, i]
    return straighten * max(1.0, coarse * coarse)


@kernel
def _straighten(first, n, straighten, vectors):
    """Replace the residuals r of a panel's offsets by the steps s with s - weight·(bend by s) = r. Return their sum by load.

    Where strips are far narrower than long, their straightening is stiff, and the residuals themselves would swing.
    """
    steps, ratios = vectors[Vector.OFFSET_R], vectors[Vector.Q1]
    ratios[first] = 1.0
    for i in range(first + 1, first + n - 1):
        if not is_between_loaded(i, n, vectors):
            ratios[i], steps[i] = 1.0, 0.0  # it makes its neighbour's step, as its middle follows that one's
            continue
        before, after = vectors[Vector.Y, i] - vectors[Vector.Y, i - 1], vectors[Vector.Y, i + 1] - vectors[Vector.Y, i]
        low, high = after / (before + after), before / (before + after)
        weight = _weight(i, n, straighten, vectors)
        inverse = 1.0 / (1.0 + weight * (1.0 - low * ratios[i - 1]))
        steps[i] = (steps[i] + weight * low * steps[i - 1]) * inverse
        ratios[i] = weight * high * inverse
    error = 0.0
    for i in range(first + n - 2, first, -1):
        if is_between_loaded(i, n, vectors):
            beyond = steps[i + 1] if is_between_loaded(i + 1, n, vectors) else steps[i] / (1.0 - ratios[i])
            steps[i] += ratios[i] * beyond
            weight_here = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
            error += weight_here * abs(steps[i]) / vectors[Vector.A, i]
    return error


@kernel
def stands_alone(total, vectors):
    """Return whether one strip has the largest pressure, and both its neighbours have less than half of it."""
    top = 0
    for i in range(total):
        top = i if vectors[Vector.P, i] > vectors[Vector.P, top] else top
    before = vectors[Vector.P, top - 1] if top > 0 else 0.0
    after = vectors[Vector.P, top + 1] if top < total - 1 else 0.0
    return vectors[Vector.P, top] > LONE * max(before, after)


@kernel
def is_spike_at_end(n, n_panels, vectors, most):
    """Return whether the largest pressure is a spike of an end that was fixed inside the contact.

    It lies at most `most` loaded strips away from an end of a panel. Inwards, pressures fall far and rise again.
    """
    top = 0
    for i in range(n * n_panels):
        top = i if vectors[Vector.P, i] > vectors[Vector.P, top] else top
    first, highest = top - top % n, vectors[Vector.P, top]
    for step in (1, -1):
        i, beyond, lowest = top - step, 0, highest
        while first <= i < first + n:
            beyond += 1 if vectors[Vector.P, i] > 0.0 else 0
            i -= step
        i = top if beyond <= most else first - 1
        while first <= i < first + n:
            lowest = min(lowest, vectors[Vector.P, i])
            if lowest < _FALLEN * highest and vectors[Vector.P, i] > _RISEN * lowest:
                return True
            i += step
    return False


@kernel
def level_light(total, vectors):
    """Lower the largest pressures, of strips that bear at most a share `_LIGHT` of the load. Return whether there are any."""
    load, borne, limit = 0.0, 0.0, math.inf
    for i in range(total):
        load += vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
    for k in range(total):
        top = 0.0
        for i in range(total):
            top = max(top, vectors[Vector.P, i] if vectors[Vector.P, i] < limit else 0.0)
        limit = top
        for i in range(total):
            if vectors[Vector.P, i] == limit:
                borne += limit * vectors[Vector.A, i] * vectors[Vector.HALF, i]
        if borne > _LIGHT * load or limit == 0.0:
            for i in range(total):
                vectors[Vector.P, i] = min(vectors[Vector.P, i], limit)
            return k > 0
    return False


@kernel
def _unrest_at_peak(n, n_panels, skewed, vectors):
    """Return the mean residual of half lengths and offsets, weighted by pressures, in the panel with the largest pressure."""
    highest, unrest = 0.0, 0.0
    for p in range(n_panels):
        top, pressures, residuals = 0.0, 0.0, 0.0
        for i in range(p * n, p * n + n):
            pressure = vectors[Vector.P, i]
            top = max(top, pressure)
            if pressure > 0.0 and 0 < i % n < n - 1:
                residual = abs(vectors[Vector.R, i])
                residual += abs(vectors[Vector.OFFSET_R, i]) / vectors[Vector.A, i] if skewed else 0.0
                pressures, residuals = pressures + pressure, residuals + pressure * residual
        if top > highest:
            highest, unrest = top, residuals / max(pressures, 1e-300)  # 0 where only end strips are loaded
    return unrest


@kernel
def fill_residuals(n, cut, skewed, straighten, vectors, state):
    """Fill the residuals of all half lengths in Vector.R. Set the sums of their magnitudes and of the strips' loads.

    A residual is the change of ln a that stretches a strip by the ratio of the overlap at its ends to that of a parabola.
    Both sums count the loads up to a factor. If idle strips are `cut` off, there are no residuals. If strips are `skewed`,
    their offsets have residuals too, the changes that close the gap at both ends alike.
    """
    error, load, delta, total = math.inf if cut else 0.0, 0.0, state.approach, n * state.n_panels
    for i in range(total):
        vectors[Vector.R, i] = vectors[Vector.OFFSET_R, i] = 0.0
        weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
        load += weight
        if weight > 0.0 and 0 < i % n < n - 1 and not cut:  # the ends of a panel follow their own rule
            overlap = delta - vectors[Vector.GAP, i] - vectors[Vector.U, i]
            ratio = overlap / (vectors[Vector.CURVATURE, i] * vectors[Vector.A, i] ** 2)
            least = (vectors[Vector.FLOOR, i] / vectors[Vector.A, i]) ** 2
            vectors[Vector.R, i] = 0.5 * math.log(min(max(ratio, 0.2, least), 5.0))
            error += weight * abs(vectors[Vector.R, i])
            if skewed and is_between_loaded(i, n, vectors):
                a = vectors[Vector.A, i]
                centred = -vectors[Vector.DIFFERENCE, i] / (4.0 * vectors[Vector.CURVATURE, i] * a)
                change = centred - vectors[Vector.OFFSET, i] + _weight(i, n, straighten, vectors) * _bend(i, vectors)
                change = min(max(change, -a), a)
                vectors[Vector.OFFSET_R, i] = change
                error += weight * abs(change) / a if not is_stiff(straighten) else 0.0
    if skewed and not cut and is_stiff(straighten):
        for p in range(total // n):
            error += _straighten(p * n, n, straighten, vectors)
    state.error, state.load, state.at_peak = error, load, _unrest_at_peak(n, state.n_panels, skewed, vectors)
