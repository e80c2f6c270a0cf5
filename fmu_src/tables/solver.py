"""Rows that both FMUs of a contact have: methods, material and resolution; damage, status and totals."""

from __future__ import annotations

from collections.abc import Iterable

import contact
from contact import Status, friction, registry
from contact.material import THERMAL_RANGE, Thermal
from contact.solver import N_ELEMENTS, N_STRIPS
from fmu_src.variables import Enumeration, Variable, output, parameter

NORMAL_METHOD = Enumeration("NormalMethod", tuple((m.name, m.title) for m in contact.methods().batched.normal.values()))
TANGENTIAL_METHOD = Enumeration(
    "TangentialMethod", tuple((m.name, m.title) for m in contact.methods().batched.tangential.values())
)
FRICTION_LAW = Enumeration(
    "FrictionLaw",  # in the order of contact.friction.LAWS
    (
        ("Coulomb", "constant coefficient of friction"),
        ("Linear", "falls linearly with the sliding velocity s/friction.half_speed, until twice that"),
        ("Rational", "falls as 1/(1 + s)"),
        ("RationalSquare", "falls as 1/(1 + s²)"),
        ("Exponential", "falls as 2^-s"),
    ),
)
FRICTION_VELOCITY = Enumeration(
    "FrictionVelocity",  # in the order of contact.friction.VELOCITIES
    (
        ("Global", "speed times the size of longitudinal and lateral creepage"),
        ("Local", "of each element; the global one where the tangential method gives forces alone"),
        (
            "Greatest",
            "the greatest local one since a particle entered the patch: what has slipped keeps the lower coefficient",
        ),
    ),
)
SURFACE = Enumeration(
    "Surface",
    (
        ("Plane", "the contact plane"),
        (
            "Conformal",
            "the surface between the profiles: the contact angle varies; not with methods that give forces alone",
        ),
    ),
)
_THERMAL = Thermal()
_STATUS_NAMES = ("OK", "NoContact", "Saturated", "OutOfRange", "NotConverged")
STATUS = Enumeration("Status", tuple(zip(_STATUS_NAMES, (status.message for status in Status), strict=True)))


def parameters() -> Iterable[Variable]:
    """Everything that `contact.solve` is told besides the problem."""
    steel = contact.STEEL
    yield parameter(
        "method.normal", "Method for the normal problem", enumeration=NORMAL_METHOD, start=registry.DEFAULT_NORMAL
    )
    yield parameter(
        "method.tangential",
        "Method for the tangential problem; creep force laws leave traction, slip, wear depth and indices of fields at zero",
        enumeration=TANGENTIAL_METHOD,
        start=registry.DEFAULT_TANGENTIAL,
    )
    yield parameter(
        "material.shear_modulus",
        "Combined shear modulus of wheel and rail",
        unit="Pa",
        start=steel.shear_modulus,
        minimum=0.0,
        open_minimum=True,
        nominal=1e11,
    )
    yield parameter(
        "material.poisson_ratio",
        "Combined Poisson ratio of wheel and rail",
        start=steel.poisson_ratio,
        minimum=0.0,
        maximum=0.5,
    )
    yield parameter(
        "material.hardness",
        "Hardness of the softer body (wear)",
        unit="Pa",
        start=steel.hardness,
        minimum=0.0,
        open_minimum=True,
        nominal=1e9,
    )
    yield parameter(
        "material.shear_yield",
        "Yield stress in shear (fatigue and stress index)",
        unit="Pa",
        start=steel.shear_yield,
        minimum=0.0,
        open_minimum=True,
        nominal=1e8,
    )
    yield parameter(
        "material.pressure_limit",
        "Pressure that is not exceeded, elastic-perfectly plastic; 0: none",
        unit="Pa",
        start=0.0,
        minimum=0.0,
        nominal=1e9,
    )
    yield parameter("resolution.n_strips", "Strips per patch", integer=True, start=N_STRIPS, minimum=4, maximum=1000)
    yield parameter(
        "resolution.n_elements", "Elements per strip", integer=True, start=N_ELEMENTS, minimum=4, maximum=1000
    )
    yield parameter("friction.law", "Friction over sliding velocity", enumeration=FRICTION_LAW, start="Coulomb")
    yield parameter(
        "friction.kinetic",
        "Coefficient of friction in fast sliding; not for Coulomb",
        start=0.3,
        minimum=0.0,
        maximum=friction.LARGEST,
    )
    yield parameter(
        "friction.half_speed",
        "Sliding velocity at which friction is halfway from friction.coefficient to friction.kinetic",
        unit="m/s",
        start=1.0,
        minimum=0.0,
        open_minimum=True,
    )
    yield parameter(
        "friction.slope",
        "Factor on the creep stiffness of the clean half space at small creepage",
        start=1.0,
        minimum=0.0,
        maximum=1.0,
        open_minimum=True,
    )
    yield parameter(
        "friction.slope_far",
        "What the factor tends to at large creepage, over friction.slope",
        start=1.0,
        minimum=0.0,
        maximum=1.0,
    )
    yield parameter("friction.slope_rate", "How soon the factor falls", start=1.0, minimum=0.0)
    yield parameter(
        "friction.velocity", "Slip velocity that the law follows", enumeration=FRICTION_VELOCITY, start="Global"
    )
    yield parameter(
        "friction.gauge_factor",
        "Factor on all coefficients of friction on the gauge side of the profile",
        start=1.0,
        minimum=0.0,
        maximum=100.0,
    )
    yield parameter(
        "friction.border",
        "Where the gauge side, y below it, ends: in the plane of the separation, or in the rail's profile of either side",
        unit="m",
        start=0.0,
    )
    yield parameter(
        "friction.border_width",
        "Width of the smooth transition; negative: the gauge side is y above friction.border",
        unit="m",
        start=5e-3,
        nominal=1e-3,
    )
    for name, where in (("k_A", "adhesion"), ("k_S", "slip")):
        yield parameter(
            f"friction.{name}",
            f"Polach's reduction factor in the area of {where}, for method.tangential = polach alone",
            start=1.0,
            minimum=0.0,
            maximum=1.0,
            open_minimum=True,
        )
    yield parameter(
        "friction.hot_factor",
        "What heat leaves of the coefficient of friction; 1: it does not depend on the temperature",
        start=1.0,
        minimum=0.0,
        maximum=1.0,
    )
    room = friction.ROOM_TEMPERATURE
    for name, start, description in (
        ("reference_temperature", room, "Temperature above which friction falls linearly"),
        ("temperature_range", 400.0, "How much above it only friction.hot_factor is left"),
        ("background_temperature", room, "Temperature of wheel and rail outside the patch, the mean of both"),
    ):
        yield parameter(
            f"friction.{name}",
            description,
            unit="K",
            start=start,
            minimum=0.0,
            maximum=friction.HOTTEST,
            open_minimum=name == "temperature_range",
            nominal=100.0,
        )
    low, high = THERMAL_RANGE
    for name, unit, description in (
        ("conductivity", "W/(m.K)", "Thermal conductivity of wheel and rail"),
        ("density", "kg/m3", "Density of wheel and rail"),
        ("heat_capacity", "J/(kg.K)", "Specific heat capacity of wheel and rail"),
    ):
        yield parameter(
            f"thermal.{name}",
            f"{description}, for friction.hot_factor",
            unit=unit,
            start=getattr(_THERMAL, name),
            minimum=low,
            maximum=high,
            nominal=100.0,
        )
    yield parameter(
        "thermal.heat_share",
        "Share of the frictional energy that becomes heat",
        start=_THERMAL.heat_share,
        minimum=0.0,
        maximum=1.0,
    )


#: Outputs of `damage` ← members of `contact.kernels.layout.DAMAGE` and TOTAL.
DAMAGE_OUTPUTS = {
    "damage.T_gamma": "T_gamma",
    "damage.wear_rate_pearce_sherratt": "pearce_sherratt",
    "damage.index_burstow": "burstow",
    "damage.wear_rate_usfd": "usfd",
    "damage.archard_depth_max": "archard_depth",
    "damage.archard_volume": "archard_volume",
    "damage.fatigue_index_surface": "fatigue_index",
    "damage.stress_index_max": "stress_index",
    "damage.energy_index_max": "energy_index",
}


def damage() -> Iterable[Variable]:
    """The damage models' numbers."""
    yield output("damage.T_gamma", "Wear number |Fx ξ| + |Fy η|", unit="N", minimum=0.0, nominal=100.0)
    yield output(
        "damage.wear_rate_pearce_sherratt", "Tread area worn off, Pearce and Sherratt", unit="m2/m", minimum=0.0
    )
    yield output("damage.index_burstow", "Rolling contact fatigue index per axle pass, Burstow")
    yield output(
        "damage.wear_rate_usfd",
        "Volume worn off a unit of contact area, Sheffield",
        unit="m/m",
        minimum=0.0,
        nominal=1e-8,
    )
    yield output("damage.archard_depth_max", "Greatest wear depth, Archard", unit="m/m", minimum=0.0, nominal=1e-10)
    yield output("damage.archard_volume", "Volume worn off, Archard", unit="m3/m", minimum=0.0, nominal=1e-12)
    yield output("damage.fatigue_index_surface", "Surface fatigue index, Ekberg")
    yield output("damage.stress_index_max", "Greatest stress index |q| - k", unit="Pa", nominal=1e8)
    yield output("damage.energy_index_max", "Greatest energy index q.w", unit="Pa", nominal=1e6)


def status_and_totals() -> Iterable[Variable]:
    """How the solution came about, and what adds up over time."""
    yield output("status", "How the solution came about", enumeration=STATUS)
    yield output("total.energy", "Energy dissipated since start", unit="J", start=0.0, minimum=0.0, depends=())
    yield output("total.worn_volume", "Volume worn off since start", unit="m3", start=0.0, minimum=0.0, depends=())
