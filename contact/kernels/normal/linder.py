"""Linder's local ellipses (1997) on the patch of virtual penetration.

Patch and pressure are those of Kik and Piotrowski with the same 0.55. The tangential methods get other ellipses: every
strip belongs to an ellipse of its own. This is as wide as the patch, and the strip lies on it at its own position
(theory.md 5):

    a_loc = a(y)/√(1 - ((y - y_m)/b)²),   b = half the width of the patch, y_m its middle.

On an ellipse all local ellipses are that ellipse. [R]: recalled from Linder's thesis (ETH Zürich 1997) by way of
theory.md 5.
"""

import math

from contact.core import kernel
from contact.kernels.rows import Strip


@kernel
def local_ellipse(a, y, low, high):
    """Return the semi-axes [m] of the ellipse from y = `low` to `high` on which a strip at y has the half length a."""
    b = 0.5 * (high - low)
    return a * b / math.sqrt(max((y - low) * (high - y), 1e-12 * b * b)), b


@kernel
def local_ellipses(strips, n, edges):
    """Set LN_ASPECT of each strip to ln(a_loc/b)."""
    for i in range(n):
        k = int(strips[Strip.PATCH, i])
        if strips[Strip.A, i] > 0.0:
            a, b = local_ellipse(strips[Strip.A, i], strips[Strip.Y, i], edges[2 * k], edges[2 * k + 1])
            strips[Strip.LN_ASPECT, i] = math.log(a / b)
