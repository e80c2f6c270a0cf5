"""Elastic, strength and thermal constants of the wheel-rail pair."""

from __future__ import annotations

import math
from dataclasses import dataclass

from contact.errors import require_number
from contact.inputs.options import HARDNESS, SHEAR_MODULUS, SHEAR_YIELD, SURFACE
from contact.inputs.plausibility import doubt_value


@dataclass(frozen=True, slots=True)
class Material:
    """Pair of elastic half spaces. Unlike bodies couple normal and tangential displacement by the constant `coupling`.

    Parameters
    ----------
    shear_modulus : float
        Combined shear modulus G [Pa], 1/G = (1/G1 + 1/G2)/2.
    poisson_ratio : float
        Combined Poisson ratio nu [-], nu/G = (nu1/G1 + nu2/G2)/2, in [0, 0.5].
    hardness : float
        Hardness H of the softer body [Pa], for Archard's wear law. Default 2.7 GPa, about 275 HV (recalled, rail steel
        R260).
    shear_yield : float
        Yield stress k in shear [Pa], for fatigue and stress index. Default 300 MPa. Torsion tests of R260 gave 211 MPa at
        first plasticity and 288 MPa at high plastic work (Meyer et al. 2020, doi 10.1016/j.euromechsol.2020.103977).
    pressure_limit : float
        Pressure p_c at which the softer body yields as a whole [Pa]; default infinite. The pressure is limited to p_c, and
        the bodies approach further (elastic-perfectly plastic, theory.md 8.4). For comparison: first yield is at 3.1 to
        3.3 k, shakedown at 4.0 k (line) to 4.7 k (circle), full indentation at about 5 k [R].
    coupling : float
        K = [(1 - 2nu_r)/G_r - (1 - 2nu_w)/G_w] G/4 of rail and wheel [-], in [-0.5, 0.5]; 0 for like bodies. Dundurs' constant
        is K/(1 - nu). Only the element-wise half space uses it (other_contacts.md); all other methods neglect it.

    Raises
    ------
    ContactError
        For a constant outside its range.

    Examples
    --------
    >>> import contact
    >>> pair = contact.Material.from_pair(60e9, 0.31, 210e9, 0.28)  # aluminium rail, steel wheel
    >>> round(pair.coupling, 3)
    0.101
    """

    shear_modulus: float
    poisson_ratio: float
    hardness: float = HARDNESS.usual
    shear_yield: float = SHEAR_YIELD.usual
    pressure_limit: float = math.inf
    coupling: float = 0.0

    def __post_init__(self) -> None:
        SHEAR_MODULUS.require("shear_modulus", self.shear_modulus)
        SURFACE["nu"].require("poisson_ratio", self.poisson_ratio)
        HARDNESS.require("hardness", self.hardness)
        SHEAR_YIELD.require("shear_yield", self.shear_yield)
        if not (isinstance(self.pressure_limit, float) and self.pressure_limit == math.inf):
            require_number("pressure_limit", self.pressure_limit, 0.0, open_minimum=True)
        require_number("coupling", self.coupling, -0.5, 0.5)
        doubt_value("shear_modulus", self.shear_modulus)
        doubt_value("pressure_limit", self.pressure_limit)

    @property
    def contact_modulus(self) -> float:
        """E* = G/(1 - nu) [Pa], 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2."""
        return self.shear_modulus / (1.0 - self.poisson_ratio)

    @classmethod
    def from_pair(cls, E1: float, nu1: float, E2: float, nu2: float, **strength: float) -> Material:
        """Return the material of two bodies with Young's moduli `E1`, `E2` [Pa] and Poisson ratios `nu1`, `nu2` (Kalker 1990).

        Body 1 is the rail, body 2 the wheel. `strength` are the other parameters.
        """
        G1 = require_number("E1", E1, 0.0, open_minimum=True) / (2.0 * (1.0 + require_number("nu1", nu1, 0.0, 0.5)))
        G2 = require_number("E2", E2, 0.0, open_minimum=True) / (2.0 * (1.0 + require_number("nu2", nu2, 0.0, 0.5)))
        G = 2.0 / (1.0 / G1 + 1.0 / G2)
        K = 0.25 * G * ((1.0 - 2.0 * nu1) / G1 - (1.0 - 2.0 * nu2) / G2)
        return cls(G, 0.5 * G * (nu1 / G1 + nu2 / G2), **{"coupling": K, **strength})


#: Wheel steel on rail steel, with the constants of the reference computations (G = 82 GPa, nu = 0.28).
STEEL = Material(SHEAR_MODULUS.usual, SURFACE["nu"].usual)
#: Allowed range of λ, ρ and c in SI units. It includes all solids, and the product does not overflow.
THERMAL_RANGE = (1e-6, 1e9)


@dataclass(frozen=True, slots=True)
class Thermal:
    """Thermal constants of wheel and rail, which have the same material. λ, ρ and c are within `THERMAL_RANGE`.

    Parameters
    ----------
    conductivity : float
        λ [W/(m K)]; 50 for steel [2+].
    density : float
        ρ [kg/m³]; 7850 [2+].
    heat_capacity : float
        c [J/(kg K)]; 450 [2+] (all three: Ertz and Knothe 2002, Wear 253, 498-508; constants.md 8).
    heat_share : float
        Share of the frictional energy that becomes heat, 0 to 1.

    Raises
    ------
    ContactError
        For a constant outside its range.
    """

    conductivity: float = 50.0
    density: float = 7850.0
    heat_capacity: float = 450.0
    heat_share: float = 1.0

    def __post_init__(self) -> None:
        for name in ("conductivity", "density", "heat_capacity"):
            require_number(f"thermal.{name}", getattr(self, name), *THERMAL_RANGE)
        require_number("thermal.heat_share", self.heat_share, 0.0, 1.0)

    @property
    def penetration(self) -> float:
        """β = √(λ ρ c) [W √s/(m² K)]."""
        return math.sqrt(self.conductivity * self.density * self.heat_capacity)

    @property
    def heating(self) -> float:
        """Heat share over 2 β √π [m² K/(W √s)], half of the heat in each body (theory.md 8.5)."""
        return heating(self.conductivity, self.density, self.heat_capacity, self.heat_share)


def heating(conductivity: float, density: float, heat_capacity: float, heat_share: float) -> float:
    """Return `Thermal.heating` [m² K/(W √s)] of these constants."""
    return heat_share / (2.0 * math.sqrt(math.pi * conductivity * density * heat_capacity))
