"""Kik and Piotrowski's virtual penetration (1996): the patch is where the bodies overlap at 0.55 of the approach.

    A a(y)² = eps·delta - g(y),   p(x, y) = p00/a(0)·√(a(y)² - x²),   u_z(0) = delta at the smallest gap    (theory.md 5)

The displacement of the half space at the smallest gap, u_z(0) = ∬p/(pi E* rho) dA, gives p00. On an ellipse of
curvatures A, B the patch has a/b = √(B/A), which is Hertz's only for A = B. [R]: recalled from Kik and Piotrowski (2nd
mini conference on contact mechanics, Budapest 1996) by way of the thesis, ch. 7.

Departure: all patches of one contact share p00/a(0) instead of having their own. So the load is continuous where they
appear and merge.
"""

import math

from contact.core import kernel

#: Share of the approach at which the gap is cut.
PENETRATION = 0.55


@kernel
def deepest_half_length(delta, point):
    """Return the half length a(0) of the strip at the smallest gap [m]."""
    return math.sqrt(PENETRATION * delta / point.A)
