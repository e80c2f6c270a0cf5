"""SRST (Alonso and Giménez 2005): pressure proportional to the square root of half the overlap.

    p(x, y) = K √(delta/2 - g(y) - A x²)   where that is positive                                             (theory.md 5)

The root makes the pressure a semi-ellipse along every strip and a semi-ellipsoid on an ellipse. Half the approach gives
Hertz's patch for A = B. K depends only on the curvatures. It gives Hertz's load for those at the smallest gap: N = (2
pi/3) K (delta/2)^(3/2)/√(AB) = N_Hertz at every approach. On an ellipse a/b = √(B/A).

[R]: recalled from Alonso and Giménez, Vehicle System Dynamics 43 (2005) 149. Their own choice of K is not at hand.
"""

import math

from contact.core import kernel
from contact.kernels.normal.deepest import unit_load
from contact.kernels.rows import Strip

#: Share of the approach at which the gap is cut.
PENETRATION = 0.5


@kernel
def srst(strips, n, modulus, point):
    """Replace the depths that `cut` left in P0 by pressures [Pa]."""
    K = 1.5 / math.pi * unit_load(point, modulus) * math.sqrt(point.A * point.B) * PENETRATION**-1.5
    for i in range(n):
        strips[Strip.P0, i] = K * math.sqrt(PENETRATION * strips[Strip.P0, i])
