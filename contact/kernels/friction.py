"""Friction that falls with sliding velocity and temperature, and reduced creep stiffness (theory.md 8.1-8.3, 8.5)."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Case
from contact.kernels.enumerations import FrictionLaw, SlipVelocity, TangentialFamily

#: Upper limit of the heat of a strip. Products of such numbers do not overflow.
_MOST_HEAT = 1e100


@entry
def coefficient(law: int, static: float, kinetic: float, half_speed: float, velocity: float) -> float:
    """Return the coefficient of friction at a sliding velocity [m/s] (theory.md 8.1).

    At `half_speed` it lies halfway between static and kinetic.
    """
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
    """Return whether the coefficient depends on the slip velocity of each element.

    Methods that give only forces have no local slip.
    """
    return (
        case.velocity != SlipVelocity.GLOBAL
        and case.law != FrictionLaw.COULOMB
        and case.tangential_family != TangentialFamily.CREEP_FORCE
    )


@kernel
def fallen(case, slip, stick, before):
    """Return the coefficient of an element with `slip` over V, divided by the static coefficient.

    `before` is the value of the element before it. The result never exceeds 1. With the law of the greatest slip
    velocity it never exceeds `before` either. Where slip begins within the element, the share `stick` of it keeps the
    value 1. So forces are continuous as this place moves from element to element.
    """
    most = before if case.velocity == SlipVelocity.GREATEST else 1.0
    if slip <= 0.0 or case.mu <= 0.0 or not falls_locally(case):
        return most
    kinetic = min(case.kinetic / case.mu, 1.0)
    local = coefficient(case.law, 1.0, kinetic, case.half_speed, case.speed * slip)
    return min(local + stick * (1.0 - local), most)


@kernel
def falls_hot(case):
    """Return whether the coefficient falls with the flash temperature.

    Methods that give only forces have no flash temperature.
    """
    return case.drop > 0.0 and case.tangential_family != TangentialFamily.CREEP_FORCE


@kernel
def heating(case, a, bound):
    """Return the rise of temperature [K] for unit slip over V and ∫ds'/√(s' - s) = 1 (theory.md 8.5).

    The traction is `bound` [Pa] and the half length of the strip is `a` [m]. s is x over a.
    """
    return min(case.heating * math.sqrt(case.speed * a) * bound, _MOST_HEAT)


@entry
def of_bodies(case: Case) -> float:
    """Return the factor on the coefficient due to the temperature of the bodies."""
    drop = case.drop
    if drop <= 0.0:
        return 1.0
    return min(max(1.0 + drop * (case.warm / case.warm_range), 1.0 - drop), 1.0)


@kernel
def of_heat(case, cold, warm, heat):
    """Return the coefficient at the temperature that it causes itself (theory.md 8.5).

    It falls from `cold`, the coefficient at the temperature of the bodies. The rise of temperature [K] is `warm` plus
    `heat` times the coefficient. A greater coefficient makes the element hotter, and heat makes the coefficient
    smaller. So there is exactly one solution. The law is linear between its ends.
    """
    bodies, drop, width = of_bodies(case), case.drop, case.warm_range
    if bodies <= 0.0:
        return cold
    within = cold * (width - drop * (warm - case.warm)) / (bodies * width + cold * drop * heat)
    return min(max(within, cold * ((1.0 - drop) / bodies)), cold)


@entry
def of_case(case: Case) -> float:
    """Return the coefficient of friction of a case at its global slip velocity V√(ξ² + η²).

    Where the local slip velocity counts, return the coefficient at rest.
    """
    if falls_locally(case):
        return case.mu
    velocity = case.speed * math.sqrt(case.vx**2 + case.vy**2)
    return coefficient(case.law, case.mu, case.kinetic, case.half_speed, velocity)


@entry
def over_profile(factor: float, border: float, width: float, y: float) -> float:
    """Return the factor on the coefficient of friction at y.

    It is `factor` where (border - y)/width > 1/2, 1 where this is below -1/2, and smooth between.
    """
    if width == 0.0:
        share = 1.0 if y < border else 0.0
    else:
        t = min(max(0.5 + (border - y) / width, 0.0), 1.0)
        share = t * t * (3.0 - 2.0 * t)
    return 1.0 + (factor - 1.0) * share


@kernel
def slope_of_case(case, place, a, b, c11, limit):
    """Return the factor on the creep stiffness (Spiryagin et al. 2013; theory.md 8.2).

    It is k = k0 (far + (1 - far)/(1 + rate·eps)) with eps = G π a b k0 C11 v/(4 mu N) and v² = ξ² + η_φ². η_φ is η +
    phi·a if that is larger in magnitude than η. `limit` is mu N [N]. (ξ, η) is the creepage at the `place` (x, y) of
    the patch.
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
