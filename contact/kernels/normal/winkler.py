"""Winkler's elastic foundation: independent springs, pressure proportional to the overlap.

    p(x, y) = k (delta - g(y) - A x²)   where that is positive

A foundation of constant k cannot follow Hertz's N ~ delta^(3/2). k must decrease with the size of the patch (Johnson
1985, ch. 4.3, who quotes k = 0.60 E*/a for the circle; the choice of equal approaches). Here k gives Hertz's load at
every approach for the curvatures at the smallest gap,

    N = k pi delta²/(2√(AB)) = N_Hertz   →   k = 2 N_Hertz √(AB)/(pi delta²).

So an elliptic contact has the right load and stiffness. Its patch is that of the whole overlap, a = √(delta/A), b =
√(delta/B), which is twice Hertz's area on a circle.

Strips carry a semi-ellipse of the same length and load. Its peak is 8/(3 pi) = 0.849 of the parabola's, and the two
differ by 16 % in L2.
"""

import math

from contact.core import kernel
from contact.kernels.normal.deepest import unit_load
from contact.kernels.rows import Strip

#: Peak of the semi-ellipse over that of the parabola with the same length and load.
ELLIPSE_OVER_PARABOLA = 8.0 / (3.0 * math.pi)


@kernel
def winkler(strips, n, delta, modulus, point):
    """Replace the depths that `cut` left in Strip.P0 by pressures [Pa]."""
    k = 2.0 / math.pi * unit_load(point, modulus) * math.sqrt(point.A * point.B / delta)
    for i in range(n):
        strips[Strip.P0, i] *= ELLIPSE_OVER_PARABOLA * k
