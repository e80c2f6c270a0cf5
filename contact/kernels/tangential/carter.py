"""Carter's two-dimensional rolling contact (1926) for longitudinal creepage (theory.md 2.1; thesis Eqs. 4.1-4.9).

With X = |vx|/v_s and the creepage of full slip v_s = mu a/R, the force is |Fx|/(mu N) = 2X - X². The trailing share X
of the length slips. R is that of the line contact with the same half length and load: a/R = 2 (1 - nu) p0/G.

In three dimensions the patch is replaced by a rectangle as long as the longest strip and of the same area. With the
load of the patch this gives exactly Kalker's C11 = pi²/(4 (1 - nu)) of an ellipse for a/b → 0. Lateral creepage and
spin are neglected.
"""

import math

from contact.core import entry


@entry
def carter(vx: float, full_slip: float) -> tuple[float, float]:
    """Return Fx/(mu N) and the share of slip. `full_slip` is the creepage at which the whole contact slips."""
    x = min(max(vx / full_slip, -1.0), 1.0) if full_slip > 0.0 else math.copysign(1.0, vx)
    return -x * (2.0 - abs(x)), abs(x)


@entry
def creepage_of_full_slip(limit: float, area: float, G: float, nu: float) -> float:
    """Return the creepage of full slip mu a/R = 2 (1 - nu) mu p0/G [-] of a rectangle.

    The rectangle carries `limit` = mu N with p0 = (4/pi) N/area.
    """
    return 8.0 / math.pi * (1.0 - nu) * limit / (G * area)
