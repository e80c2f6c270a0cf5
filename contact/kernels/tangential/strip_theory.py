"""Stick zone and traction of one strip by strip theory (theory.md 2.4; thesis Eqs. 4.14-4.26).

All quantities are in units of the strip: s = (x - x_c)/a, traction over mu·p0. In stick, s > -1 + 2e,

    q = (kappa, lambda) √(1 - s²) - (kappa, lambda') √((1 - e)² - (s - e)²),

where e = D/(1 - nu) is the half length of the slip zone over a.
"""

import math

from contact.core import kernel

#: Larger root of D over 1 - nu at which the slip zone begins to grow, and the share of the way from there to the smaller root
#: over which it grows. From 1 and .5 to 1.1 and .8 the forces are equally near those of the half space (4104 solutions of
#: `creep_table.csv`, chosen on half of them: .0139 → .0135 on all). A wider range makes them smoother.
_EDGE, _WAY = 1.1, 0.8


@kernel
def coefficients(root_aspect, nu):
    """Return strip theory's own C11, C22, C23: Kalker's in the limit a/b → 0. `root_aspect` is √(a/b)."""
    return 0.25 * math.pi**2 / (1.0 - nu), 0.25 * math.pi**2, math.pi / 3.0 * root_aspect


@kernel
def stick_zone(xi, eta, psi, nu):
    """Return the half slip length e over a and the directions kappa, lambda, lambda' of a strip. e = 1 if all of it slips.

    `xi`, `eta`, `psi` are the strip's normalised creepages (thesis 4.16-4.19). Where lateral creepage opposes spin, the
    stick zone does not end at |psi| = 1, where the thesis declares full slip. The formula, written without its 0/0,
    continues (measured on set A: mean force error .0175 → .0148, accuracy.md).

    Beyond |psi| = 1 the equation of D also has a larger root, and the bound holds only between the two. D = 1 - nu is
    the whole strip. When the larger root reaches it, the leading edge slips. When both roots meet, or D reaches it, all
    of the strip slips. Where the leading edge slips, the slip zone grows from e to the whole strip. Full slip at once
    would be a jump, of .01 of mu N for one strip of 30, of .05 for neighbours together.
    """
    square, opposed = xi * xi + eta * eta, -eta * psi
    discriminant, excess = eta * eta + (1.0 - psi * psi) * xi * xi, psi * psi - 1.0
    if discriminant < 0.0 or (opposed <= 0.0 <= excess):
        return 1.0, 0.0, 0.0, 0.0
    root = math.sqrt(0.5 * (discriminant + abs(discriminant)))  # compilers take the root before the condition
    D = square / (root + opposed) if opposed > 0.0 else (opposed - root) / excess
    e = D / (1.0 - nu)
    if excess > 0.0:
        larger = (opposed + root) / (excess * (1.0 - nu))
        left = min((_EDGE - larger) / (_WAY * (_EDGE - e)), 1.0) if larger < _EDGE and e < 1.0 else 0.0
        e = 1.0 - (1.0 - e) * (1.0 - left) * (1.0 - left) * (1.0 + 2.0 * left)
        D = e * (1.0 - nu)
    if e >= 1.0:
        return 1.0, 0.0, 0.0, 0.0
    if D <= 0.0:
        return 0.0, 0.0, psi, 0.0
    positive = D + 1e-300  # compilers divide before the condition
    return e, xi / positive, eta / positive + psi, eta / positive


@kernel
def outer_resultants(e):
    """Return ∫√(1-s²) over the stick zone, and the same times s, in closed form (theory.md 4.1)."""
    s = -1.0 + 2.0 * e
    h2 = max(1.0 - s * s, 0.0)
    return 0.5 * (0.5 * math.pi - s * math.sqrt(h2) - math.asin(s)), h2 * math.sqrt(h2) / 3.0


@kernel
def inner_resultants(e):
    """Return ∫√((1-e)²-(s-e)²) over the stick zone, and the same times s."""
    inner = 0.5 * math.pi * (1.0 - e) ** 2
    return inner, e * inner
