"""Kik and Piotrowski's virtual penetration with shape correction (2008).

The patch of 1996 is stretched along x and shrunk along y at the same area, so that an ellipse has Hertz's axes
(theory.md 5; the errors of the thesis):

    a_c/a = b/b_c = √((m0/n0)/√(B0/A0)),   so that a_c/b_c = m0/n0 where a/b = √(B0/A0)

with the curvatures A0, B0 at the smallest gap. The pressure follows as in 1996. [R]: recalled from Piotrowski and Kik,
Vehicle System Dynamics 46 (2008) 27, by way of the thesis, Eqs. 7.5-7.6, whose ratio is printed upside down.

Two choices are ours. The factor comes from the curvatures. If it came from length and width of the patch, the load
would have a large step where patches merge. Every patch is stretched about the centroid of its own area, which leaves a
small step (0.8 % of the load for two equal patches).
"""

import math

from contact.core import kernel
from contact.kernels.rows import Strip


@kernel
def _stretch(strips, first, last, factor, edges, at):
    """Stretch the strips of one patch. Return the new position of the point `at` if it lies in the patch, else `at`."""
    area, moment = 0.0, 0.0
    for i in range(first, last):
        weight = strips[Strip.A, i] * strips[Strip.DY, i]
        area += weight
        moment += weight * strips[Strip.Y, i]
    if area <= 0.0:
        return at
    k = int(strips[Strip.PATCH, first])
    centre = moment / area
    for i in range(first, last):
        strips[Strip.A, i] *= factor
        strips[Strip.DY, i] /= factor
        strips[Strip.Y, i] = centre + (strips[Strip.Y, i] - centre) / factor
    if edges[2 * k] < at < edges[2 * k + 1]:
        at = centre + (at - centre) / factor
    for side in range(2 * k, 2 * k + 2):
        edges[side] = centre + (edges[side] - centre) / factor
    return at


@kernel
def stretch(strips, n, panel, edges, point):
    """Stretch `n` strips, `panel` per patch. Return the factor along x and the new position of the smallest gap."""
    factor = math.exp(0.5 * (point.log_aspect - 0.5 * math.log(point.B / point.A)))
    at = point.y
    for k in range(n // panel):
        at = _stretch(strips, k * panel, (k + 1) * panel, factor, edges, at)
    return factor, at
