"""KPEC: Kik and Piotrowski's virtual penetration with elliptic correction, as in CONTACT 25.1.

An equivalent ellipse sets the share of the approach at which each strip is cut (theory.md 5):

    zone        where g < delta/2, from y_1 to y_2 around the smallest gap;  y_m its middle
    curvatures  A1 = A at the smallest gap,  B1 = (delta/2)/((y_2 - y_1)/2)²
    ellipse     a, b of Hertz for A1, B1 and the approach delta
    cut         A a(y)² = eps(y) delta - g(y),   eps(y) delta = A1 a² - (A1 a² - B1 b²) ((y - y_m)/b)²

The pressure p = kappa √(a(y)² - x²) displaces the point of the smallest gap by delta. On an ellipse this is Hertz's
solution.

The equations were read off CONTACT (routine snorm_kpec_method, rev 2707, Apache-2.0). There are two departures. Of
several zones only the one with the smallest gap counts. CONTACT takes the span of all, which reduces the load by a
third where a second zone appears. And eps is at most 1, so that no strip is cut deeper than the profiles overlap.
CONTACT has no such cap.

The load still steps where zones merge. Where eps decreases away from the ellipse, a second contact is not found.
"""

import math

from contact.core import kernel
from contact.kernels.hertz import local_factors
from contact.kernels.normal.curvature import floored
from contact.kernels.normal.lay import find_patches
from contact.kernels.rows import Sample


@kernel
def _zone(y, g, n, delta, point, work, edges):
    """Return the ends of the zone around the smallest gap where g < delta/2."""
    count = find_patches(y, g, work[Sample.GAP_SLOPE], n, point.g + 0.5 * delta, edges)
    for k in range(count):
        if edges[2 * k] <= point.y <= edges[2 * k + 1]:
            return edges[2 * k], edges[2 * k + 1]
    return edges[0], edges[2 * count - 1]


@kernel
def share_parabola(y, g, A, n, delta, point, work, edges):
    """Fill effective gap and curvature. Return the level to cut at, ln(a/b) of the ellipse, and a(0) at the smallest gap."""
    low, high = _zone(y, g, n, delta, point, work, edges)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    B1 = floored(0.5 * delta / (half * half), point.floor)
    one_alpha, one_beta, _, log_aspect = local_factors(point.A, B1)
    # A1 a² = delta/(1+alpha) and B1 b² = delta/(1+beta), so the share is a parabola that is added to the gap
    level, bend = delta / one_alpha, B1 * (one_beta / one_alpha - 1.0)
    # a share above 1 only lies outside the ellipse; coarse samples leave the interval of its edge uncapped
    edge = math.sqrt(delta / (one_beta * B1)) + 2.0 * (y[n - 1] - y[0]) / (n - 1)
    for i in range(n):
        gap, away = g[i] - point.g, y[i] - middle
        shared, whole = gap + bend * away * away, gap - (delta - level)
        capped = shared < whole and abs(away) > edge
        work[Sample.EFFECTIVE_GAP, i] = whole if capped else shared
        work[Sample.EFFECTIVE_SLOPE, i] = work[Sample.GAP_SLOPE, i] + (0.0 if capped else 2.0 * bend * away)
        work[Sample.STRETCHED_A, i] = A[i]
    return level, log_aspect, math.sqrt(max(level - bend * (point.y - middle) ** 2, 0.0) / point.A)
