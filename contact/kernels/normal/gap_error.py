"""Violation of the half space's contact conditions by a pressure: an error estimate for every normal method.

Inside the patch the gap must close: displacement + undeformed gap = approach. The semi-elliptic pressures of all strips
displace the surface by U of `influence`. The estimate is the gap or overlap that remains at the middles of a few
strips, divided by the approach. It is zero for an exact solution and for Hertz's ellipse. Strips that interact satisfy
it by construction.
"""

import math

from contact._jit import kernel
from contact.kernels import cubic
from contact.kernels.normal.between_panels import IN_LINE
from contact.kernels.normal.influence import anywhere, at_centre
from contact.kernels.rows import Strip

#: Number of strips at which the gap is evaluated.
PROBES = 8


@kernel
def _displacement(i, n, strips, tables):
    """Return the displacement at the middle of strip i times pi E* [N/m]."""
    at, locus, total = strips[Strip.Y, i], strips[Strip.XC, i], 0.0
    for j in range(n):
        a, half = strips[Strip.A, j], 0.5 * strips[Strip.DY, j]
        if strips[Strip.P0, j] <= 0.0 or a <= 0.0:
            continue
        away = abs(strips[Strip.Y, j] - at)
        near = math.log(max(abs(away - half), 1e-12 * half) / a)
        far, X = math.log((away + half) / a), abs(strips[Strip.XC, j] - locus) / a
        if X > IN_LINE:
            low, high = anywhere(tables.plane, X, near), anywhere(tables.plane, X, far)
        else:
            low, high = at_centre(tables.centre, near), at_centre(tables.centre, far)
        total += strips[Strip.P0, j] * a * (high + low if away < half else high - low)
    return total


@kernel
def gap_error(sep, n, case, own, result):
    """Return the largest gap or overlap left at the middles of `PROBES` of n strips, over the approach [-]; 1 at most."""
    y, g, size, strips = sep.y, sep.g, sep.y.size, own.strips
    delta = result.approach - result.touch
    if not delta > 0.0 or n == 0:
        return 0.0
    per_modulus = (1.0 - case.nu) / (math.pi * case.G)
    largest, k = 0.0, 0
    for probe in range(min(PROBES, n)):
        i = (2 * probe + 1) * n // (2 * min(PROBES, n))
        at = strips[Strip.Y, i]
        k = cubic.locate(y, size, at, k)
        h = y[k + 1] - y[k]
        m0, m1 = cubic.slope_at(y, g, size, k), cubic.slope_at(y, g, size, k + 1)
        gap = cubic.value(h, g[k], m0, g[k + 1], m1, (at - y[k]) / h) - result.touch
        left = abs(gap + per_modulus * _displacement(i, n, strips, own.tables) - delta) / delta
        largest = max(largest, min(left, 1.0))
    return largest
