"""Kik and Piotrowski's virtual penetration (1996): the patch is where the bodies overlap at 0.55 of the approach.

    A a(y)² = eps·delta - g(y),   p(x, y) = p00/a(0)·√(a(y)² - x²),   u_z(0) = delta at the least point     (theory.md 5)

The displacement of the half space at the least point, u_z(0) = ∬p/(pi E* rho) dA, gives p00. On an ellipse of curvatures
A, B the patch has a/b = √(B/A): Hertz's only for A = B. [R]: recalled from Kik and Piotrowski (2nd mini conference on contact
mechanics, Budapest 1996) by way of the thesis, ch. 7. Departure: all patches of one contact share p00/a(0) instead of having
their own, so that the load is continuous where they are born and merge.
"""

import math

from contact._jit import kernel
from contact.normal.cut import cut, equivalent_aspect, press

#: Share of the approach at which the gap is cut.
PENETRATION = 0.55


@kernel
def kik_piotrowski(y, xc, n, delta, modulus, point, nodes, weights, work, strips, edges):
    """Fill `strips` at approach delta; return load, number of strips and whether the patch reaches the end of the data."""
    n_strips, touches_end = cut(y, xc, n, delta, nodes, weights, work, strips, edges)
    equivalent_aspect(strips, n_strips)
    a0 = math.sqrt(delta * PENETRATION / point.A)
    return press(strips, n_strips, edges, point.y, a0, delta, modulus), n_strips, touches_end
