"""Polach's creep force (1999, 2005): linear growth of traction over an ellipse, saturated, with spin added (theory.md 2.3).

    F = (2 mu N/pi) (k_A eps/(1 + (k_A eps)²) + atan(k_S eps)),   eps = G pi a b C_jj v_C/(4 mu N)

acts against the creepage v_C = (vx, v_yC). v_yC is vy + phi a if that is larger in magnitude than vy, and vy otherwise.
With kappa = 1 + 6.3 (1 - exp(-a/b)), eps_S = (8/3) G b c C23 |v_yC|/(kappa mu N), D = (eps_S² - 1)/(eps_S² + 1), the
lateral force of spin is

    F_yS = (9/16) a mu N kappa (eps_S (D³/3 - D²/2 + 1/6) - (1 - D²)^(3/2)/3) phi/v_C.

At vanishing creepage the forces are Kalker's. The law has no moment. [R], checked against a public conversion of
Polach's program and the linear limit. Two things are ours. The resultant is limited to mu N, because lateral creepage with
spin would exceed it. The share of slip, (k_A eps)²/(1 + (k_A eps)²), follows from Polach's traction and never reaches
1.

The reduction factors k_S <= k_A <= 1 describe a real surface. k_S, k_A are .4, 1 for dry and .1, .3 for wet rails
(Polach 2005, Table 2, with friction that falls as the sliding velocity grows). They are in `contact.friction.Friction`.
1, 1 is the clean surface of the theory.
"""

import math

from contact.core import entry, kernel

_FAR = 1e100  # deep in full slip; its square does not overflow


@kernel
def _spin_integral(eps):
    """Return eps (D³/3 - D²/2 + 1/6) - (1 - D²)^(3/2)/3. It starts at 0 with the slope -2/3 and returns to 0.

    With D = 1 - 2u, u = 1/(1 + eps²), the first bracket is 2 u² (1 - 4u/3) and 1 - D² = 4 u (1 - u), free of
    cancellation.
    """
    u = 1.0 / (1.0 + eps * eps)
    root = 2.0 * math.sqrt(u * (1.0 - u))
    return eps * 2.0 * u * u * (1.0 - 4.0 / 3.0 * u) - root * root * root / 3.0


@entry
def polach(
    creepage: tuple[float, float, float],
    G: float,
    a: float,
    b: float,
    coefficients: tuple[float, float, float, float],
    limit: float,
    k_A: float,
    k_S: float,
) -> tuple[float, float, float, float]:
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip. `limit` is mu N."""
    vx, vy, phi = creepage
    c11, c22, c23, _ = coefficients
    with_spin = vy + phi * a
    vy_c = with_spin if abs(with_spin) > abs(vy) else vy
    v, v_c = math.sqrt(vx * vx + vy * vy), math.sqrt(vx * vx + vy_c * vy_c)
    if v_c <= 0.0 or limit <= 0.0:
        return 0.0, 0.0, 0.0, 0.0 if v_c <= 0.0 else 1.0
    stiffness = math.sqrt((c11 * vx) ** 2 + (c22 * vy) ** 2) / v if v > 0.0 else 0.0
    eps = min(0.25 * math.pi * G * a * b * stiffness * v_c / limit, _FAR)
    stick, slip = k_A * eps, k_S * eps
    force = 2.0 * limit / math.pi * (stick / (1.0 + stick * stick) + math.atan(slip))
    kappa = 1.0 + 6.3 * (1.0 - math.exp(-a / b))
    eps_spin = min(8.0 / 3.0 * G * b * math.sqrt(a * b) * c23 * abs(vy_c) / (kappa * limit), _FAR)
    of_spin = 0.5625 * a * limit * kappa * _spin_integral(eps_spin)
    Fx, Fy = -force * vx / v_c, (of_spin * phi - force * vy) / v_c
    size = math.sqrt(Fx * Fx + Fy * Fy)
    factor = limit / size if size > limit else 1.0
    return factor * Fx, factor * Fy, 0.0, stick * stick / (1.0 + stick * stick)
