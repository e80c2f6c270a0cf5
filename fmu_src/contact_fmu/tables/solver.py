"""Rows that WheelRailContact and WheelRailPair share: methods, material, resolution, friction, damage, status and totals."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import contact
from contact import Status, registry
from contact.inputs.material import THERMAL_RANGE, Thermal
from contact.inputs.options import HOT_FACTOR, N_ELEMENTS, N_STRIPS, TEMPERATURE, TEMPERATURE_RANGE
from contact.results import BEND, BEYOND
from ..rows import Limits, output, parameter, taken
from ..variables import Enumeration, Variable

NORMAL_METHOD = Enumeration("NormalMethod", tuple((m.name, m.title) for m in contact.methods().batched.normal.values()))
TANGENTIAL_METHOD = Enumeration(
    "TangentialMethod", tuple((m.name, m.title) for m in contact.methods().batched.tangential.values())
)
_GAP_LIMITS = {m.name: m.gap_limit for m in contact.methods().normal.values()}
FRICTION_LAW = Enumeration(
    "FrictionLaw",  # in the order of contact.friction.LAWS
    (
        ("Coulomb", "constant coefficient of friction"),
        ("Linear", "falls linearly with s = sliding velocity/friction.half_speed, constant from s = 2 on"),
        ("Rational", "falls as 1/(1 + s)"),
        ("RationalSquare", "falls as 1/(1 + s²)"),
        ("Exponential", "falls as 2^-s"),
    ),
)
FRICTION_VELOCITY = Enumeration(
    "FrictionVelocity",  # in the order of contact.friction.VELOCITIES
    (
        ("Global", "speed times the magnitude of longitudinal and lateral creepage"),
        ("Local", "slip velocity of each element; the global one if the tangential method gives forces only"),
        (
            "Greatest",
            "greatest local slip velocity since the particle entered the patch, so the coefficient never rises again",
        ),
    ),
)
SURFACE = Enumeration(
    "Surface",
    (
        ("Plane", "the contact plane"),
        (
            "Conformal",
            "the curved surface between the profiles with varying contact angle; not with methods that give forces only",
        ),
    ),
)
#: Names that rows `friction.…` and `thermal.…` share with members of `Friction` and `Thermal`.
FRICTION = (
    *("kinetic", "half_speed", "slope", "slope_far", "slope_rate"),
    *("gauge_factor", "border", "border_width", "k_A", "k_S", "hot_factor", "reference_temperature"),
    *("temperature_range", "background_temperature"),
)
THERMAL = ("conductivity", "density", "heat_capacity", "heat_share")
_THERMAL = Thermal()
#: Least load [N]. Suspensions and round-off give small negative loads at lift-off; more is a wrong sign.
LEAST_LOAD = -1e3
NO_LOAD = f"from {LEAST_LOAD:g} N to 0 there is no contact"
_STATUS_NAMES = ("OK", "NoContact", "Saturated", "OutOfRange", "NotConverged", "Unreachable")
STATUS = Enumeration("Status", tuple(zip(_STATUS_NAMES, (status.message for status in Status), strict=True)))


#: Groups of parameters that a host may change during a run: work arrays and warm start do not depend on them.
_TUNABLE = {"friction", "material", "thermal"}


def parameters() -> Iterable[Variable]:
    """Yield the parameters of `contact.solve` other than geometry, creepages and load."""
    for row in _parameters():
        yield replace(row, tunable=row.name.split(".")[0] in _TUNABLE)


def _parameters() -> Iterable[Variable]:
    yield parameter(
        "method.normal", "Method for the normal problem", enumeration=NORMAL_METHOD, start=registry.DEFAULT_NORMAL
    )
    about = (
        "Method for the tangential problem; with creep force laws traction, slip, wear depth and field indices are zero"
    )
    yield parameter("method.tangential", about, enumeration=TANGENTIAL_METHOD, start=registry.DEFAULT_TANGENTIAL)
    yield from _numbers(
        ("material.shear_modulus", "case.G", 1e11, "Combined shear modulus of wheel and rail"),
        ("material.poisson_ratio", "case.nu", None, "Combined Poisson ratio of wheel and rail"),
        ("material.hardness", "damage_parameters.hardness", 1e9, "Hardness of the softer body (wear)"),
        (
            "material.shear_yield",
            "damage_parameters.shear_yield",
            1e8,
            "Yield stress in shear (fatigue and stress index)",
        ),
    )
    about = "Pressure limit of an elastic-perfectly plastic material; 0: no limit"
    yield parameter("material.pressure_limit", about, start=0.0, nominal=1e9, member="case.pressure_limit")
    about = "Most iterations of interacting strips, which cap the time of a step; then the status is NotConverged"
    yield parameter("method.max_iterations", about, member="case.max_iterations")
    about = (
        "Strips per patch. Above 200 the time of interacting strips grows with the cube of those of all patches: a second for "
        "1000, a minute for several patches of 1000"
    )
    yield parameter("resolution.n_strips", about, **taken(N_STRIPS))
    yield parameter("resolution.n_elements", "Elements per strip", **taken(N_ELEMENTS))
    about = "Dependence of friction on sliding velocity"
    yield parameter("friction.law", about, enumeration=FRICTION_LAW, start="Coulomb", member="case.law")
    half = "Sliding velocity at which friction is halfway from friction.coefficient to friction.kinetic"
    border = "Border of the gauge side, which is y below it: in the plane of the separation, or in the profile of either rail"
    width = "Width of the smooth transition at friction.border; negative: the gauge side is y above it"
    polach = "Polach's reduction factor in the area of {}, used only when method.tangential = polach"
    yield from _numbers(
        (
            "friction.kinetic",
            "case.kinetic",
            None,
            "Coefficient of friction at high sliding velocity; not used by Coulomb",
        ),
        ("friction.half_speed", "case.half_speed", None, half),
        ("friction.slope", "case.slope", None, "Factor on the creep stiffness at small creepage; 1: clean surfaces"),
        (
            "friction.slope_far",
            "case.slope_far",
            None,
            "Limit of the factor at large creepage, divided by friction.slope",
        ),
        ("friction.slope_rate", "case.slope_rate", None, "Rate at which the factor falls with creepage"),
    )
    about = "Slip velocity that the law follows"
    yield parameter("friction.velocity", about, enumeration=FRICTION_VELOCITY, start="Global", member="case.velocity")
    gauge = "Factor on all coefficients of friction on the gauge side of the profile"
    yield from _numbers(
        ("friction.gauge_factor", "case.gauge_factor", None, gauge),
        ("friction.border", "case.border", None, border),
        ("friction.border_width", "case.border_width", 1e-3, width),
        ("friction.k_A", "case.k_A", None, polach.format("adhesion")),
        ("friction.k_S", "case.k_S", None, polach.format("slip")),
    )
    about = "Share of the coefficient of friction that remains when hot; 1: friction does not depend on the temperature"
    yield parameter("friction.hot_factor", about, **taken(HOT_FACTOR))
    fallen = "Rise above it at which friction has fallen to friction.hot_factor"
    for name, option, member, about in (
        ("reference_temperature", TEMPERATURE, "", "Temperature above which friction falls linearly"),
        ("temperature_range", TEMPERATURE_RANGE, "case.warm_range", fallen),
        ("background_temperature", TEMPERATURE, "", "Mean temperature of wheel and rail outside the patch"),
    ):
        yield parameter(f"friction.{name}", about, unit="K", **taken(option), nominal=100.0, member=member)
    thermal: dict[str, Any] = {"minimum": THERMAL_RANGE[0], "maximum": THERMAL_RANGE[1], "nominal": 100.0}
    for name, unit, about in (
        ("conductivity", "W/(m.K)", "Thermal conductivity of wheel and rail"),
        ("density", "kg/m3", "Density of wheel and rail"),
        ("heat_capacity", "J/(kg.K)", "Specific heat capacity of wheel and rail"),
    ):
        about = f"{about}, used when friction.hot_factor < 1"
        yield parameter(f"thermal.{name}", about, unit=unit, start=getattr(_THERMAL, name), **thermal)
    about = "Share of the frictional energy that becomes heat"
    yield parameter("thermal.heat_share", about, start=_THERMAL.heat_share, minimum=0.0, maximum=1.0)


def _numbers(*rows: tuple[str, str, float | None, str]) -> Iterable[Variable]:
    """Yield parameters: name, member, nominal and description of each."""
    for name, member, nominal, about in rows:
        yield parameter(name, about, nominal=nominal, member=member)


#: Each damage: name, member, attributes.
_DAMAGE: tuple[tuple[str, str, Limits], ...] = (
    ("T_gamma", "T_gamma", {"minimum": 0.0, "nominal": 100.0}),
    ("wear_rate_pearce_sherratt", "pearce_sherratt", {"minimum": 0.0}),
    ("index_burstow", "burstow", {}),
    ("wear_rate_usfd", "usfd", {"minimum": 0.0, "nominal": 1e-8}),
    ("archard_depth_max", "archard_depth", {"minimum": 0.0, "nominal": 1e-10}),
    ("archard_volume", "archard_volume", {"minimum": 0.0, "nominal": 1e-12}),
    ("fatigue_index_surface", "fatigue_index", {}),
    ("stress_index_max", "stress_index", {"nominal": 1e8}),
    ("energy_index_max", "energy_index", {"nominal": 1e6}),
)


def damage(record: str) -> Iterable[Variable]:
    """Yield the outputs of the damage models, members of the record DAMAGE or TOTAL."""
    for name, member, attributes in _DAMAGE:
        yield output(f"damage.{name}", member=f"{record}.{member}", **attributes)


def status_and_totals(record: str, speed: str) -> Iterable[Variable]:
    """Yield the status of the solution, a member of the record RESULT or TOTAL, and the totals over time at a `speed`."""
    yield output("status", "Status of the solution", enumeration=STATUS, member=f"{record}.status")
    yield total("energy", "Energy dissipated since start", "J", ("power.friction", None))
    yield total("worn_volume", "Volume worn off since start", "m3", ("damage.archard_volume", speed))


def total(name: str, description: str, unit: str, of: tuple[str | None, str | None]) -> Variable:
    """Return an output that is integrated over time (`Variable.integral_of`)."""
    return output(f"total.{name}", description, unit=unit, start=0.0, minimum=0.0, depends=(), integral_of=of)


def bend(record: str, depends: tuple[str, ...] | None = None) -> Variable:
    """Return how far the contact angle changes over a patch."""
    about = "Largest change of the contact angle over the patches in one plane. Above "
    about += f"{BEND:g} rad strips in a plane are doubtful"
    return output("bend", about, minimum=0.0, nominal=0.1, depends=depends, member=f"{record}.bend")


def beyond(record: str) -> Variable:
    """Return how much of the load is on shapes beyond the table that the method reads."""
    about = (
        "Largest share of a patch's load on shapes whose a/b is beyond the table that the method reads. "
        f"Above {BEYOND:g} forces are doubtful"
    )
    return output("beyond", about, minimum=0.0, maximum=1.0, member=f"{record}.beyond")


def gap_error(record: str, depends: tuple[str, ...] | None = None) -> Variable:
    """Return the error estimate of the normal problem."""
    about = (
        "Largest gap or overlap left in the patch, over the approach. Above "
        f"{_GAP_LIMITS['strip_halfspace']:g} ({_GAP_LIMITS['analyn']:g} for strips that do not interact) "
        "the largest pressure is doubtful"
    )
    return output("gap_error", about, minimum=0.0, maximum=1.0, depends=depends, member=f"{record}.gap_error")
