"""Carter's two-dimensional rolling contact (1926), longitudinal creepage alone (theory.md 2.1; thesis Eqs. 4.1-4.9).

With X = |vx|/v_s, v_s = mu a/R the creepage of full slip, the force is |Fx|/(mu N) = 2X - X² and the trailing share X of the
length slips. R is that of the line contact with the same half length and load: a/R = 2 (1 - nu) p0/G.

In three dimensions the patch is a rectangle as long as the longest strip and of the same area. With the load of the patch
this meets Kalker's C11 = pi²/(4 (1 - nu)) of an ellipse for a/b → 0 exactly; lateral creepage and spin are not known.
"""

import math

from contact._jit import kernel


@kernel
def carter(vx, full_slip):
    """Fx/(mu N) and the share of slip; `full_slip` is the creepage at which all of the contact slips."""
    x = min(max(vx / full_slip, -1.0), 1.0) if full_slip > 0.0 else math.copysign(1.0, vx)
    return -x * (2.0 - abs(x)), abs(x)


@kernel
def creepage_of_full_slip(limit, area, G, nu):
    """mu a/R = 2 (1 - nu) mu p0/G of a rectangle that carries `limit` = mu N: p0 = (4/pi) N/area."""
    return 8.0 / math.pi * (1.0 - nu) * limit / (G * area)
