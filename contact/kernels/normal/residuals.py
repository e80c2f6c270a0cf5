"""Pressures of the strips, and residuals of their half lengths and offsets (strip_halfspace.md 2, steps 1 to 3)."""

import math

from contact.core import kernel
from contact.kernels.normal.between_panels import distances
from contact.kernels.normal.descent import STRAIGHTEN
from contact.kernels.normal.panels import half_lengths, is_between_loaded, lay_panels, place_middles
from contact.kernels.normal.strip_system import assemble, solve_active
from contact.kernels.rows import Vector


@kernel
def find_pressures(problem, delta, n_panels):
    """Lay the strips between the ends of the panels and find their pressures. Return the approach above first touch [m].

    `delta` is the approach so far, which bounds the half lengths.
    """
    own, panels = problem.own, problem.panels
    n = own.rule.across.nodes.size
    lay_panels(problem.sep, problem.touch, problem.skew, panels, n_panels, own)
    if problem.skew > 0.0:
        place_middles(own.space.vectors, n, n_panels, delta)
    distances(panels, n_panels, own)
    half_lengths(own.space.vectors, n, n_panels, delta)
    assemble(panels, n_panels, own, problem.skew > 0.0, problem.unit)
    return solve_active(n, n_panels, own.space, problem.by_load, problem.amount)


@kernel
def _bend(i, vectors):
    """Return how far a strip's middle would have to move to lie in line with its neighbours' [m]."""
    before, after = vectors[Vector.Y, i] - vectors[Vector.Y, i - 1], vectors[Vector.Y, i + 1] - vectors[Vector.Y, i]
    in_line = after * vectors[Vector.XC, i - 1] + before * vectors[Vector.XC, i + 1]
    return in_line / (before + after) - vectors[Vector.XC, i]


@kernel
def fill_residuals(n, total, delta, cut, skewed, vectors):
    """Fill the residuals of all half lengths in Vector.R. Return the sum of their magnitudes, and of the strips' loads.

    A residual is the change of ln a that stretches a strip by the ratio of the overlap at its ends to that of a parabola.
    Both sums count the loads up to a factor. If idle strips are `cut` off, there are no residuals. If strips are `skewed`,
    their offsets have residuals too, the changes that close the gap at both ends alike.
    """
    error, load = math.inf if cut else 0.0, 0.0
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
                change = centred - vectors[Vector.OFFSET, i] + STRAIGHTEN * _bend(i, vectors)
                change = min(max(change, -a), a)
                vectors[Vector.OFFSET_R, i] = change
                error += weight * abs(change) / a
    return error, load
