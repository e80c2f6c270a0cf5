"""Stick zone and traction of one strip by strip theory (theory.md 2.4; thesis Eqs. 4.14-4.26).

All in units of the strip: s = (x - x_c)/a, traction over mu·p0. In stick, s > -1 + 2e,
    q = (kappa, lambda) √(1 - s²) - (kappa, lambda') √((1 - e)² - (s - e)²),
with e = D/(1 - nu) the half length of the slip zone over a.
"""

import math

from contact._jit import kernel


@kernel
def coefficients(root_aspect, nu):
    """Strip theory's own C11, C22, C23: Kalker's in the limit a/b → 0; `root_aspect` is √(a/b)."""
    return 0.25 * math.pi**2 / (1.0 - nu), 0.25 * math.pi**2, math.pi / 3.0 * root_aspect


@kernel
def stick_zone(xi, eta, psi, nu):
    """Half slip length e and the directions kappa, lambda, lambda' of a strip; e = 1 if all of it slips.

    `xi`, `eta`, `psi` are the strip's normalised creepages (thesis 4.16-4.19). Where lateral creepage opposes spin, the
    stick zone does not end at |psi| = 1, where the thesis declares full slip: the formula, written without its 0/0, holds
    as long as the leading edge sticks. This removes the jump at |psi| = 1 (measured on set A: mean force error .0175 →
    .0148, docs/accuracy.md).
    """
    square = xi * xi + eta * eta
    discriminant = eta * eta + (1.0 - psi * psi) * xi * xi
    if discriminant < 0.0:
        return 1.0, 0.0, 0.0, 0.0
    root = math.sqrt(discriminant)
    if eta * psi < 0.0:
        if abs(psi) > 1.0 and square <= (-eta * psi - root) * (1.0 - nu):
            return 1.0, 0.0, 0.0, 0.0  # the leading edge slips
        D = square / (root - eta * psi)
    elif abs(psi) >= 1.0:
        return 1.0, 0.0, 0.0, 0.0
    else:
        D = (eta * psi + root) / (1.0 - psi * psi)
    e = D / (1.0 - nu)
    if e >= 1.0:
        return 1.0, 0.0, 0.0, 0.0
    if D <= 0.0:
        return 0.0, 0.0, psi, 0.0
    return e, xi / D, eta / D + psi, eta / D


@kernel
def outer_resultants(e):
    """∫√(1-s²) over the stick zone, and the same times s, in closed form (theory.md 4.1)."""
    s = -1.0 + 2.0 * e
    h2 = max(1.0 - s * s, 0.0)
    return 0.5 * (0.5 * math.pi - s * math.sqrt(h2) - math.asin(s)), h2 * math.sqrt(h2) / 3.0


@kernel
def inner_resultants(e):
    """∫√((1-e)²-(s-e)²) over the stick zone, and the same times s."""
    inner = 0.5 * math.pi * (1.0 - e) ** 2
    return inner, e * inner
