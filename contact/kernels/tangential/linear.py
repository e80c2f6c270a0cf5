"""Kalker's linear theory, and the laws that bound its force (theory.md 1.2, 2.2).

    Fx = -C11 G c² vx,   Fy = -C22 G c² vy - C23 G c³ phi,   Mz = C23 G c³ vy - C33 G c⁴ phi,   c = √(ab)

(Kalker 1967, 1990 Table E.3). Friction does not limit this force, so |F| may exceed mu N. With f = |F|/(mu N), the
bounded laws multiply it by

    linear_saturated     min(1, 1/f)
    shen_hedrick_elkins  1 - f/3 + f²/27 up to f = 3, then 1/f: Johnson's and Vermeulen's cubic (1983; thesis Eq. 5.4)

and have no moment. If the linear moment were reduced as the force, it would reach 6 mu N c under pure spin, where the
half space has less than one (a/b = .2). The share of the patch that slips is 0 or 1, except for the cubic: its stick
zone is an ellipse 1 - f/3 times the patch.
"""

import math

from contact.core import entry, kernel

_TINY = 1e-300  # for a friction limit of 0


@kernel
def linear(creepage, G, c, coefficients):
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip."""
    vx, vy, phi = creepage
    c11, c22, c23, c33 = coefficients
    unit = G * c * c
    return -unit * c11 * vx, -unit * (c22 * vy + c23 * c * phi), unit * c * (c23 * vy - c33 * c * phi), 0.0


@entry
def capped(force: float, limit: float) -> tuple[float, float]:
    """Return the factor that keeps a linear `force` below `limit`, and the share of slip."""
    # LLVM divides before it chooses, so the divisor must not be 0: that would be a trap
    return limit / max(force, limit, _TINY), 0.0 if force <= limit else 1.0


@entry
def smoothed(force: float, limit: float) -> tuple[float, float]:
    """Return the factor by Johnson's and Vermeulen's cubic, and the share of slip."""
    if force <= 0.0:
        return 1.0, 0.0
    if force >= 3.0 * limit:
        return limit / force, 1.0
    f = force / limit
    stick = 1.0 - f / 3.0
    return 1.0 - f / 3.0 + f * f / 27.0, 1.0 - stick * stick


@kernel
def saturated(Fx, Fy, limit, smoothly):
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip from the linear force, bounded at once or `smoothly`."""
    force = math.sqrt(Fx * Fx + Fy * Fy)
    factor, slip = smoothed(force, limit) if smoothly else capped(force, limit)
    return factor * Fx, factor * Fy, 0.0, slip
