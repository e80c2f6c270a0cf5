"""Friction that falls with sliding velocity and temperature, and surfaces softer at small creepage (theory.md 8.1-8.3, 8.5)."""

import math

from contact._jit import kernel
from contact.kernels.layout import FrictionLaw, SlipVelocity, TangentialFamily

#: Most heat of a strip, far from where products overflow.
_MOST_HEAT = 1e100


@kernel
def coefficient(law, static, kinetic, half_speed, velocity):
    """Coefficient of friction at a sliding velocity [m/s]; halfway from static to kinetic at `half_speed` (theory.md 8.1)."""
    if law == FrictionLaw.COULOMB:
        return static
    s = velocity / half_speed
    if law == FrictionLaw.LINEAR:
        share = max(0.0, 1.0 - 0.5 * s)
    elif law == FrictionLaw.RATIONAL:
        share = 1.0 / (1.0 + s)
    elif law == FrictionLaw.RATIONAL_SQUARE:
        share = 1.0 / (1.0 + s * s)
    else:
        share = math.exp(-math.log(2.0) * s)
    return kinetic + (static - kinetic) * share


@kernel
def falls_locally(case):
    """Whether the coefficient differs from element to element; methods that give forces alone have no local slip."""
    return (
        case.velocity != SlipVelocity.GLOBAL
        and case.law != FrictionLaw.COULOMB
        and case.tangential_family != TangentialFamily.CREEP_FORCE
    )


@kernel
def fallen(case, slip, stick, before):
    """Coefficient over the static one of an element with `slip` over V; `before` is that of the element before it.

    It never rises above 1, nor, after the greatest slip velocity, above that of the element before. Where slip begins within
    the element, the share `stick` of it keeps 1: so forces are continuous as the place moves from element to element.
    """
    most = before if case.velocity == SlipVelocity.GREATEST else 1.0
    if slip <= 0.0 or case.mu <= 0.0 or not falls_locally(case):
        return most
    kinetic = min(case.kinetic / case.mu, 1.0)
    own = coefficient(case.law, 1.0, kinetic, case.half_speed, case.speed * slip)
    return min(own + stick * (1.0 - own), most)


@kernel
def falls_hot(case):
    """Whether the coefficient falls with the temperature; methods that give forces alone know none."""
    return case.drop > 0.0 and case.tangential_family != TangentialFamily.CREEP_FORCE


@kernel
def heating(case, a, bound):
    """Rise of temperature [K] by unit slip over V under the traction `bound` over √(2 Δs) of a strip of half length a (8.5)."""
    return min(case.heating * math.sqrt(case.speed * a) * bound, _MOST_HEAT)


@kernel
def of_bodies(case):
    """What the temperature of the bodies leaves of the coefficient."""
    drop = case.drop
    if drop <= 0.0:
        return 1.0
    return min(max(1.0 + drop * (case.warm / case.warm_range), 1.0 - drop), 1.0)


@kernel
def of_heat(case, cold, warm, heat):
    """Coefficient that falls from `cold`, that at the bodies' temperature, by `warm` + `heat` times itself [K] (theory.md 8.5).

    The greater the coefficient the hotter, the hotter the smaller: there is one, and the law is linear between its ends.
    """
    bodies, drop, width = of_bodies(case), case.drop, case.warm_range
    if bodies <= 0.0:
        return cold
    within = cold * (width - drop * (warm - case.warm)) / (bodies * width + cold * drop * heat)
    return min(max(within, cold * ((1.0 - drop) / bodies)), cold)


@kernel
def of_case(case):
    """Coefficient of friction at the global slip velocity V√(ξ² + η²) of a case; that at rest, where the local one counts."""
    if falls_locally(case):
        return case.mu
    velocity = case.speed * math.sqrt(case.vx**2 + case.vy**2)
    return coefficient(case.law, case.mu, case.kinetic, case.half_speed, velocity)


@kernel
def over_profile(factor, border, width, y):
    """Factor on the coefficient of friction at y: `factor` where (border - y)/width > 1/2, 1 below -1/2, smooth between."""
    if width == 0.0:
        share = 1.0 if y < border else 0.0
    else:
        t = min(max(0.5 + (border - y) / width, 0.0), 1.0)
        share = t * t * (3.0 - 2.0 * t)
    return 1.0 + (factor - 1.0) * share


@kernel
def slope_of_case(case, place, a, b, c11, limit):
    """Factor on the flexibility's inverse, k = k0 (far + (1 - far)/(1 + rate·eps)) (Spiryagin et al. 2013; theory.md 8.2).

    eps = G π a b k0 C11 v/(4 mu N), v² = ξ² + η_φ², η_φ = η + phi·a if that is larger; `limit` is mu N, (ξ, η) the creepage
    at the `place` (x, y) of the patch.
    """
    k0, far = case.slope, case.slope_far
    if far == 1.0 or limit <= 0.0:
        return k0
    x, y = place
    vx, vy = case.vx - case.phi * y, case.vy + case.phi * x
    with_spin = vy + case.phi * a
    lateral = with_spin if abs(with_spin) > abs(vy) else vy
    v = math.sqrt(vx**2 + lateral * lateral)
    eps = 0.25 * math.pi * case.G * a * b * k0 * c11 * v / limit
    return k0 * (far + (1.0 - far) / (1.0 + case.slope_rate * eps))
