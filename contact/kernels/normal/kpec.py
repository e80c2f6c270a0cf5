"""KPEC: Kik and Piotrowski's virtual penetration with elliptic correction, as CONTACT 25.1 has it.

An equivalent ellipse sets the share of the approach at which each strip is cut (theory.md 5):

    zone        where g < delta/2, from y_1 to y_2 around the least point;  y_m its middle
    curvatures  A1 = A at the least point,  B1 = (delta/2)/((y_2 - y_1)/2)²
    ellipse     a, b of Hertz for A1, B1 and the approach delta
    cut         A a(y)² = eps(y) delta - g(y),   eps(y) delta = A1 a² - (A1 a² - B1 b²) ((y - y_m)/b)²

and the pressure, p = kappa √(a(y)² - x²), displaces the least point by delta. On an ellipse this is Hertz's solution.
Read off CONTACT (routine snorm_kpec_method, rev 2707, Apache-2.0). Departures: of several zones the one with the least point
counts, not the span of all, which drops the load by a third where a second zone is born; the share is capped at 1 away from
the ellipse. The load still steps where zones merge. The share falls away from the ellipse: a second
contact elsewhere is not seen.
"""

import math

from contact._jit import kernel
from contact.kernels.cubic import slopes
from contact.kernels.hertz import local_factors
from contact.kernels.layout import Sample
from contact.kernels.normal.analyn import floored
from contact.kernels.normal.lay import find_patches


@kernel
def _zone(y, g, n, delta, point, work, edges):
    """Ends of the zone around the least point where g < delta/2."""
    count = find_patches(y, g, work[Sample.GAP_SLOPE], n, point.g + 0.5 * delta, edges)
    for k in range(count):
        if edges[2 * k] <= point.y <= edges[2 * k + 1]:
            return edges[2 * k], edges[2 * k + 1]
    return edges[0], edges[2 * count - 1]


@kernel
def share_parabola(y, g, A, n, delta, point, work, edges):
    """Fill effective gap and curvature; return the level to cut at, ln(a/b) of the ellipse and a(0) of the least point."""
    low, high = _zone(y, g, n, delta, point, work, edges)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    B1 = floored(0.5 * delta / (half * half))
    one_alpha, one_beta, _, log_aspect = local_factors(point.A, B1)
    # A1 a² = delta/(1+alpha) and B1 b² = delta/(1+beta): the share is a parabola that is added to the gap
    level, bend = delta / one_alpha, B1 * (one_beta / one_alpha - 1.0)
    far = 2.0 * math.sqrt(delta / (one_beta * B1)) + 4.0 * (y[n - 1] - y[0]) / (n - 1)
    for i in range(n):
        gap, away = g[i] - point.g, y[i] - middle
        G = gap + bend * away * away
        if abs(away) > far:
            G = max(G, gap - delta + level)
        work[Sample.EFFECTIVE_GAP, i], work[Sample.STRETCHED_A, i] = G, A[i]
    slopes(y, work[Sample.EFFECTIVE_GAP], n, work[Sample.EFFECTIVE_SLOPE])
    return level, log_aspect, math.sqrt(max(level - bend * (point.y - middle) ** 2, 0.0) / point.A)
