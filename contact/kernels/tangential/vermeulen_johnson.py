"""Vermeulen and Johnson (1964): creepage without spin on an ellipse; on a circle Johnson (1958) (theory.md 2.2).

The stick zone is the ellipse of the patch scaled by k, k³ = 1 - F/(mu N), and touches the leading edge. The traction is
that of sliding minus k times that of the small ellipse. The force is F = |(C11 vx, C22 vy)| G c², linear in creepage
and saturated by the cubic law. The slopes are those of the semi-ellipsoidal traction, evaluated here for any ellipse by
complete elliptic integrals. With B, D of theory.md 1.1, C = (D - B)/k² and g the minor over the major axis (derived
from the integrals of theory.md 2.2),

    a >= b   C11 = pi (a/b)/((1 - nu) D + nu C),   C22 = pi (a/b)/(D - nu C)
    a <= b   C11 = pi/((1 - nu) B + nu g² C),      C22 = pi/(B - nu g² C)

On a circle they are 16/(4 - 3 nu) and 16/(4 - nu), a fifth above Kalker's, because the stick zone touches the leading
edge at one point only. The moment is that of the traction, whose small ellipse lies (1 - k) a ahead of the middle:
Mz = -(1 - k) a k³ mu N e_y, with e along the force.
"""

import math

from contact.core import entry
from contact.kernels.hertz import elliptic_integrals
from contact.kernels.tangential.linear import smoothed

_NEARLY_CIRCULAR = 1e-3


@entry
def slopes(aspect: float, nu: float) -> tuple[float, float]:
    """Return C11 and C22 for a/b = `aspect`."""
    g = min(aspect, 1.0 / aspect)
    k2 = (1.0 - g) * (1.0 + g)
    _, _, B, D = elliptic_integrals(g)
    if k2 < _NEARLY_CIRCULAR:  # the difference cancels, so a series with the error k⁸ is used
        C = math.pi / 16.0 * (1.0 + k2 * (0.75 + k2 * (75.0 / 128.0 + k2 * 245.0 / 512.0)))
    else:
        C = (D - B) / k2
    if aspect >= 1.0:
        return math.pi * aspect / ((1.0 - nu) * D + nu * C), math.pi * aspect / (D - nu * C)
    C *= g * g
    return math.pi / ((1.0 - nu) * B + nu * C), math.pi / (B - nu * C)


@entry
def vermeulen_johnson(
    vx: float, vy: float, G: float, a: float, b: float, nu: float, limit: float
) -> tuple[float, float, float, float]:
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip. `limit` is mu N."""
    c11, c22 = slopes(a / b, nu)
    Fx, Fy = -c11 * G * a * b * vx, -c22 * G * a * b * vy
    factor, slip = smoothed(math.sqrt(Fx * Fx + Fy * Fy), limit)
    k = math.sqrt(1.0 - slip)
    moment = -a * k * k * k * Fy / 3.0  # 1 - k is a third of the linear force over mu N
    return factor * Fx, factor * Fy, moment, slip
