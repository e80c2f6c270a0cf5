"""What has no meaning is refused by name: numbers outside their ranges, arguments of a wrong kind or too many of them."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import contact
from contact.accumulation import Section
from contact.damage import (
    ArchardMap,
    Burstow,
    DamageParameters,
    PearceSherratt,
    Usfd,
    burstow,
    evaluate,
    t_gamma,
    usfd,
    wear_coefficient,
)
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.halfspace import Gap, Transient
from contact.inputs.material import Thermal
from contact.inputs.options import MEMBERS, Real, Whole
from contact.pair import ContactDamping, ElasticRail, FrictionMemory, RollerRig, WheelRailPair
from contact.stress import Endurance, SurfaceLoad, at, dang_van
from contact.theory import kalker

ELLIPSE, CREEPAGE = contact.Separation.hertzian(1.0, 2.0), contact.Creepage()
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
PAIR, LAW = Pair(WHEEL, RAIL), Friction(0.4, 0.1, half_speed=0.05, law="exponential")
HALF = {"normal": "halfspace", "tangential": "halfspace"}
SQUARE = SurfaceLoad([0.0, 1.0], [0.0, 1.0], np.ones((2, 2)))
LINE = Endurance(1e8, 8.0, 1e6)


def solve(separation=ELLIPSE, creepage=CREEPAGE, **given):
    return contact.solve(separation, creepage, **given)


def rolled(**given):
    return WheelRailPair(PAIR).solve(Pose(), **{"load": 8e4, **given})


def on_surfaces(**given):
    return WheelRailPair(SurfacePair(WHEEL, RAIL)).solve(Pose(), load=8e4, **given)


def on_rollers(velocity=1.0, **given):
    return RollerRig(PAIR, 0.6).solve(Pose(), Velocity(velocity), **given)


def stressed(**given):
    return at(**{"load": SQUARE, "x": 0.0, "y": 0.0, "z": 0.0, **given})


# -- numbers -------------------------------------------------------------------------------------------------------------------

#: A function of Python, what its messages put before an argument's name, and argument → member of a record in `MEMBERS`.
Door = tuple[Callable[..., Any], str, dict[str, str]]


def same(record: str, *without: str) -> dict[str, str]:
    """Return the members of a record that are arguments of the same name: all but `without`."""
    assert set(without) <= set(MEMBERS[record])
    return {name: name for name in MEMBERS[record] if name not in without}


def law(**given):
    return Friction(0.3, **given)


def steel(**given):
    return replace(contact.STEEL, **given)


TURNS = {"roll": "roll_rate", "yaw": "yaw_rate"}
#: Members of CASE that are numbers of a friction law, and those that follow from other arguments.
OF_LAW = [
    "kinetic",
    "half_speed",
    "slope",
    "slope_far",
    "slope_rate",
    "gauge_factor",
    "border",
    "border_width",
    "k_A",
    "k_S",
]
DERIVED = {"tolerance", "law", "velocity", "warm", "heating", "conformal", "load_kind"}
DOORS: dict[str, list[Door]] = {
    "case": [
        (lambda **given: solve(**{"load": 1.0, **given}), "", {"speed": "speed", "load": "amount", "friction": "mu"}),
        (contact.Solver, "", {"speed": "speed", "friction": "mu", "max_iterations": "max_iterations"}),
        (Friction, "friction.", {"static": "mu"}),
        (law, "friction.", {name: name for name in OF_LAW} | {"hot_factor": "drop", "temperature_range": "warm_range"}),
        (steel, "", {"shear_modulus": "G", "poisson_ratio": "nu", "pressure_limit": "pressure_limit"}),
        (contact.Creepage, "creepage.", {"longitudinal": "vx", "lateral": "vy", "spin": "phi"}),
        (lambda **given: contact.Separation(ELLIPSE.y, ELLIPSE.g, 1.0, **given), "", {"rolling": "rolling"}),
    ],
    "contact_options": [
        (contact.Solver, "", {"n_strips": "n_strips", "n_elements": "n_elements", "max_iterations": "max_iterations"}),
        (lambda **given: solve(load=1.0, **given), "", {"n_strips": "n_strips", "n_elements": "n_elements"}),
        (steel, "", same("contact_options", "n_strips", "n_elements", "max_iterations", "conformal")),
    ],
    "pair_options": [
        (
            lambda **given: Pair(WHEEL, RAIL, **given),
            "",
            same("pair_options", "wheel_radius", "reach", "tilted", "n_bins", "bin_start", "bin_width")
            | {"nominal_radius": "wheel_radius"},
        ),
        (lambda **given: SurfacePair(WHEEL, RAIL, **given), "", {"reach": "reach"}),
    ],
    "pair_input": [
        (rolled, "", {"load": "amount", "distance": "distance"}),
        (on_surfaces, "", {"station": "station", "rotation": "rotation"}),
    ],
    "given": [
        (Pose, "pose.", {"y": "y", "z": "z", "roll": "roll", "yaw": "yaw"}),
        (Velocity, "velocity.", {"forward": "vx", "y": "vy", "z": "vz", "spin": "spin", **TURNS}),
        (Irregularity, "irregularity.", {"y": "rail_y", "z": "rail_z", "roll": "rail_roll"}),
        (Irregularity, "irregularity.", {"y_rate": "rail_vy", "z_rate": "rail_vz", "roll_rate": "rail_roll_rate"}),
    ],
    "wheel_offset": [(WheelOffset, "offset.", same("wheel_offset"))],
    "elastic_rail": [(ElasticRail, "rail.", same("elastic_rail"))],
    "damage_parameters": [
        (steel, "", {"hardness": "hardness", "shear_yield": "shear_yield"}),
        (lambda **given: evaluate(solve(load=8e4), **given), "", {"wheel_radius": "wheel_radius"}),
        (DamageParameters, "", {"rail_wear": "rail_wear"}),
    ],
}
#: Members that no function of Python takes as a number: choices, switches, what follows from other arguments.
WITHOUT = {
    "case": DERIVED,
    "contact_options": {"conformal"},
    "pair_options": {"tilted", "n_bins", "bin_start", "bin_width"},
    "pair_input": {"height"},
    "damage_parameters": {"speed", "with_spin", "wear_law"},
}


def outside(limits: Whole | Real) -> Iterator[float]:
    """Yield values just outside a range and far outside, none that is allowed."""
    if isinstance(limits, Whole):
        yield from (limits.least - 1, limits.most + 1, limits.least + 0.5)
        return
    yield math.nan
    if limits.above:
        yield limits.least
    if limits.least > -math.inf:
        yield from (math.nextafter(limits.least, -math.inf), -math.inf)
    if limits.most < math.inf:
        yield from (math.nextafter(limits.most, math.inf), math.inf)


def test_every_number_that_a_user_gives_has_a_door():
    for record, members in MEMBERS.items():
        taken = {member for _, _, arguments in DOORS[record] for member in arguments.values()}
        assert set(members) == taken | WITHOUT.get(record, set()), record
        assert not taken & WITHOUT.get(record, set())


@pytest.mark.parametrize(
    ("door", "told", "argument", "limits"),
    [
        pytest.param(
            door, prefix + argument, argument, MEMBERS[record][member], id=f"{record}.{member}-{prefix}{argument}"
        )
        for record, doors in DOORS.items()
        for door, prefix, arguments in doors
        for argument, member in arguments.items()
    ],
)
def test_a_number_outside_its_range_is_refused_with_name_value_and_range(door, told, argument, limits):
    for value in outside(limits):
        with pytest.raises(contact.ContactError) as error:
            door(**{argument: value})
        said = str(error.value)
        assert said.startswith((f"{told} = {value:g} is", f"{told} = {value} is")), said
        assert "allowed range" in said or said.endswith("is not finite"), said


# -- other arguments -----------------------------------------------------------------------------------------------------------

REFUSED: list[tuple[Callable[[], Any], str]] = [
    # a contact
    (lambda: solve(), "exactly one of load and approach is needed; load = None, approach = None"),
    (lambda: solve(load=1.0, approach=1.0), "exactly one of load and approach is needed; load = 1.0, approach = 1.0"),
    (lambda: solve(approach=math.inf), "approach = inf"),
    (lambda: solve(load="80e3"), "load = '80e3' is not a number"),
    (lambda: solve(load=1e9), r"load = 1e\+09: .*end of the given separation"),
    (lambda: solve(load=1.0, normal="contact"), "normal = 'contact' .* analyn"),
    (lambda: solve(load=1.0, tangential="usetab"), "tangential = 'usetab' .* fastrip"),
    (lambda: solve(load=1.0, normal="ANALYN"), "normal = 'ANALYN' is not a registered method, did you mean 'analyn'"),
    (lambda: solve(load=1.0, tangential="fastripe"), "'fastripe' .*, did you mean 'fastrip'"),
    (lambda: solve(None, load=1.0), "separation = None is not a contact.Separation"),
    (lambda: solve(load=1.0, force=math.nan), "force = nan is not finite"),
    (lambda: solve(load=1.0, force="1e3"), "force = '1e3' is not a number"),
    (lambda: solve(load=1.0, force=(None, None)), "is not a number or a pair"),
    (lambda: solve(load=1.0, force=(1.0, 2.0, 3.0)), "is not a number or a pair"),
    (lambda: solve(load=1.0, force=(1.0, math.inf)), "force = inf is not finite"),
    (lambda: solve(load=1.0, material=steel(pressure_limit=1e9), **HALF), "normal = 'halfspace' is elastic"),
    (
        lambda: solve(load=1.0, friction=Friction(0.3, slope=0.5), **HALF),
        r"friction.slope = 0.5: tangential = 'halfspace'",
    ),
    (lambda: solve(load=1.0, layer=contact.ThirdBody(), tangential="fastsim"), "'fastsim' has no third body"),
    (lambda: solve(load=1.0, layer=3.0, **HALF), r"layer = 3.0 is not a contact.ThirdBody"),
    (
        lambda: solve(load=1.0, layer=contact.ThirdBody(), friction=replace(LAW, velocity="local"), **HALF),
        "must not depend on local slip",
    ),
    (lambda: solve(load=1.0, normal="halfspace", tangential="fastrip"), "does not work with normal = 'halfspace'"),
    (lambda: solve(load=1.0, spacing=0.0, **HALF), "spacing = 0 is outside"),
    (lambda: solve(load=1.0, spacing=(1e-3, 1e-3, 1e-3), **HALF), "pair of numbers"),
    (lambda: solve(load=1.0, spacing=1e-9, **HALF), "elements along a side"),
    (lambda: contact.Separation([0, 1], [0, 0], 1.0), "y has 2 points"),
    (lambda: contact.Separation([0, 1, 1], [0, 0, 0], 1.0), "y must increase"),
    (lambda: contact.Separation([[0, 1, 2]], [0, 0, 0], 1.0), "y has shape"),
    (lambda: contact.Separation([0, 1, 2], [0, 0], 1.0), "g has shape"),
    (lambda: contact.Separation([0, 1, 2], [0, math.nan, 0], 1.0), r"g\[1\] = nan"),
    (lambda: contact.Separation([0, 1, 2], [0, 0, 0], [1, 0, 1]), r"A\[1\] = 0"),
    (lambda: contact.Separation([0, 1, 2], [0, 0, 0], "steep"), "A = 'steep' is not a number"),
    (lambda: contact.Separation([0, 1, 2], [0, 0, 0], 1.0, [0, math.inf, 0]), r"x_c\[1\] = inf"),
    (
        lambda: contact.Separation(ELLIPSE.y, ELLIPSE.g, 1.0, tilt=1.1e3),
        r"is outside the allowed range \[-1000, 1000\]",
    ),
    (lambda: contact.Creepage("fast"), "creepage"),
    (lambda: contact.hertz(0.0, 1.0, load=1.0), "A = 0"),
    (lambda: contact.hertz(1.0, -1.0, load=1.0), "B = -1"),
    (lambda: contact.hertz(1.0, 1.0, load=math.nan), "load = nan"),
    (lambda: contact.hertz(1.0, 1.0, approach=-1.0), "approach = -1"),
    (lambda: contact.hertz(1.0, 1.0), "exactly one"),
    (lambda: contact.hertz(1.0, 1.0, load=1.0, approach=1.0), "exactly one"),
    (
        lambda: contact.forces(ELLIPSE, CREEPAGE, load=[1.0, -2.0]),
        r"load\[1\] = -2 is outside the allowed range \[0, inf\[",
    ),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load=[1.0, math.nan]), r"load\[1\] = nan"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load=1.0, friction=[[0.1], [-1.0]]), r"friction\[1, 0\] = -1"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load=[1.0, 2.0], friction=[0.1, 0.2, 0.3]), r"do not broadcast: \(2,\)"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE), "exactly one"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load="heavy"), "load = 'heavy' is not a number"),
    (lambda: contact.Solver(normal="analin"), "normal = 'analin' is not a registered method, did you mean 'analyn'"),
    (lambda: contact.Solver(normal="halfspace"), "normal = 'halfspace' is not offered here, only by contact.solve"),
    (lambda: contact.Solver(tangential="fastsim_knothe"), "tangential = 'fastsim_knothe' is not offered here, only by"),
    (lambda: contact.Solver(n_samples=2), r"n_samples = 2 is not an integer in the allowed range \[3, inf\["),
    (lambda: contact.Solver(n_samples=3.7), r"n_samples = 3.7 is not an integer"),
    (lambda: contact.Solver(friction="dry"), "friction = 'dry' is not a number"),
    (
        lambda: contact.Solver(tangential="polach", conformal=True),
        "conformal: tangential = 'polach' is only for",
    ),
    (lambda: Gap([0.0], [0.0, 1.0], [[0.0], [0.0]]), "x has shape"),
    (lambda: Gap([0.0, 1.0, 3.0], [0.0, 1.0], np.zeros((2, 3))), "equal steps"),
    (lambda: Gap([0.0, 1.0], [0.0, 1.0], np.zeros((3, 2))), r"\(2, 2\) is needed"),
    (lambda: Gap([0.0, 1.0], [0.0, 1.0], [[0.0, math.nan], [0.0, 0.0]]), r"h\[0, 1\] = nan"),
    (lambda: Transient(3.0, load=1.0), "separation = 3.0 is not a contact.Separation"),
    (lambda: Transient(ELLIPSE, load=1.0, friction=-1.0), "friction = -1 is outside"),
    (lambda: Transient(ELLIPSE, load=0.0), "load = 0 is outside"),
    (lambda: Transient(ELLIPSE, load=1.0, spacing=(1.0, 2.0, 3.0)), "spacing = "),
    (lambda: Transient(ELLIPSE, load=1.0, friction=law(hot_factor=0.5)), "greatest velocity or the temperature"),
    (lambda: Transient(ELLIPSE, load=1.0, approach=1e-5), "exactly one of load"),
    (lambda: Transient(ELLIPSE, load=1.0, layer=0.1), "layer = 0.1 is not"),
    # materials and friction
    (lambda: steel(coupling=0.6), "coupling = 0.6 is outside"),
    (lambda: steel(coupling=math.nan), "coupling = nan is outside"),
    (lambda: kalker.table(0.51), "poisson_ratio"),
    (lambda: kalker.table(-0.01), "poisson_ratio"),
    (lambda: Thermal(density=0.0), r"thermal.density = 0 is outside"),
    (lambda: law(law="stribeck"), "friction.law = 'stribeck' is unknown; allowed: coulomb, linear"),
    (lambda: law(velocity="mean"), "friction.velocity = 'mean' is unknown; allowed: global, local, greatest"),
    (
        lambda: law(reference_temperature=-1.0),
        r"friction.reference_temperature = -1 is outside the .* \[0, 100000\]",
    ),
    (lambda: law(background_temperature=math.nan), "friction.background_temperature = nan"),
    (lambda: contact.ThirdBody(flexibility=-1.0), "layer.flexibility = -1"),
    (lambda: contact.ThirdBody(yield_stress=0.0), "layer.yield_stress = 0"),
    (lambda: contact.ThirdBody(hardening=math.nan), "layer.hardening = nan"),
    # a wheel on its rail
    (lambda: WheelRailPair(WHEEL), r"pair = Profile.* is no contact.geometry.wheelset.Pair; make one"),
    (lambda: WheelRailPair(None), r"pair = None is no"),
    (lambda: WheelRailPair(PAIR, material=2e11), r"material = .* is no contact.inputs.material.Material"),
    (lambda: WheelRailPair(PAIR, damage="archard"), "damage = 'archard' is no"),
    (lambda: WheelRailPair(PAIR, normal="none"), "normal = 'none' is not a registered method"),
    (lambda: WheelRailPair(PAIR, n_strips=3), "n_strips = 3 is not"),
    (
        lambda: WheelRailPair(PAIR).solve(Pose(), 20.0, load=8e4),
        r"velocity = 20.0 is not a contact.geometry.wheelset.Velocity",
    ),
    (
        lambda: WheelRailPair(PAIR).solve(Pose(y=1.0), load=8e4),
        "pose.y = 1: the right wheel and rail profiles do not overlap",
    ),
    (
        lambda: WheelRailPair(PAIR).solve(Pose(z=0.01)),
        "pose.z = 0.01: the right wheel lies more than 0.005 m inside its rail",
    ),
    (lambda: rolled(penetration=1e-5), "exclude each other"),
    (lambda: rolled(vertical=1), "vertical = 1 excludes load = 80000.0"),
    (lambda: rolled(load=1e12), r"load = 1e\+12: no z was found"),
    (lambda: rolled(friction=math.nan), "friction = nan is outside"),
    (lambda: rolled(offset=0.1), r"offset = 0.1 is not a contact.geometry.flexible.WheelOffset"),
    (lambda: rolled(load=None, vertical=7e4, force=1.0, torque=1.0), "exactly one of force and torque"),
    (lambda: rolled(load=None, vertical=7e4, force=math.nan), "force = nan is not finite"),
    (lambda: rolled(load=None, vertical=7e4, torque="much"), "torque = 'much' is not a number"),
    (
        lambda: WheelRailPair(PAIR).solve(Pose(), Velocity(0.0), force=1.0, vertical=7e4),
        r"velocity.forward = 0 is outside",
    ),
    (lambda: ElasticRail(ky=0.0), r"rail.ky = 0 is outside"),
    (lambda: FrictionMemory(LAW, 0.0), "distance = 0 is outside"),
    (lambda: FrictionMemory(LAW, 1.0, -1.0), "least = -1 is outside"),
    (lambda: FrictionMemory(0.3, 1.0), "friction = 0.3 is not a contact.friction.Friction"),
    (lambda: FrictionMemory(law(velocity="local"), 1.0), "one state follows only 'global'"),
    (lambda: FrictionMemory(LAW, 1.0).advance(math.nan, 1.0), "sliding = nan is outside"),
    (lambda: ContactDamping(-1.0), "normal = -1 is outside"),
    (lambda: ContactDamping(1.0, normal_rate=0.0), "normal_rate = 0 is outside"),
    (lambda: RollerRig(PAIR, 0.0), r"radius = 0 is outside"),
    (lambda: RollerRig(3.0, 0.6), r"pair = 3.0 is not"),
    (lambda: RollerRig(PAIR, 0.6, offset=0.2), r"offset = 0.2 is outside"),
    (lambda: on_rollers(0.0, vertical=1e4), r"velocity.forward = 0 is outside"),
    (lambda: on_rollers(vertical=-1.0), r"vertical = -1 is outside"),
    (lambda: on_rollers(vertical=1e9), r"no height was found"),
    # damage and stress
    (lambda: burstow(-1.0), r"T_gamma = -1 is outside the allowed range \[0, inf\["),
    (lambda: burstow([1.0, math.nan]), r"T_gamma\[1\] = nan"),
    (lambda: usfd(10.0, 0.0), r"area = 0 is outside the allowed range \]0, inf\["),
    (lambda: usfd([1.0, 2.0], [1.0, 2.0, 3.0]), "do not broadcast"),
    (lambda: t_gamma("much", 0.0, 0.0, 0.0), "Fx = 'much' is not a number"),
    (lambda: wear_coefficient(0.1, 1e9, -2.7e9), "hardness"),
    (lambda: Burstow(peak_at=10.0), r"burstow.peak_at = 10 is outside the allowed range \]15, inf\["),
    (lambda: PearceSherratt(severe_limit=50.0), "pearce_sherratt.severe_limit = 50"),
    (lambda: Usfd(severe_branch="steep"), "severe_branch = 'steep' is unknown; allowed: continuous"),
    (lambda: ArchardMap(severe_to=0.1), "archard.severe_to"),
    (lambda: stressed(z=-1e-3), r"z = -0\.001 is outside the allowed range \[0, inf\["),
    (lambda: stressed(x=math.nan), "x = nan is not finite"),
    (lambda: stressed(x=[0.0, 1.0], y=[0.0, 1.0, 2.0]), "broadcast"),
    (lambda: stressed(x="one"), "x = 'one' is not a number"),
    (lambda: stressed(body="sleeper"), "body = 'sleeper' is unknown; allowed: rail, wheel"),
    (lambda: stressed(poisson_ratio=0.6), "poisson_ratio = 0.6 is outside the allowed range"),
    (lambda: stressed(load=3.0), "neither a contact.Solution nor"),
    (lambda: dang_van(SQUARE, [1.0], slope=4.0), "slope = 4 is outside the allowed range"),
    (lambda: dang_van(SQUARE, [1.0], slope=-1.0), "slope = -1 is outside the allowed range"),
    (lambda: dang_van(SQUARE, [1.0], residual=math.nan), "residual = nan is not finite"),
    (lambda: dang_van(SQUARE, [1.0], margin=11.0), "margin = 11 is outside the allowed range"),
    (lambda: Section(RAIL, LINE, [2e-3, 1e-3]), "depths must be"),
    (lambda: Section(RAIL, LINE, [-1e-3]), "depths must be"),
    (lambda: Section(RAIL, 1.0, [1e-3]), "endurance = 1.0 is not a contact.stress.Endurance"),
    (lambda: Section(RAIL, LINE, [1e-3], width=1.0), "width = 1 is outside"),
    (lambda: Endurance(math.nan, 8.0, 1e6), "endurance.limit = nan is outside"),
    (lambda: Endurance(1e8, 0.0, 1e6), "endurance.exponent = 0 is outside"),
]


@pytest.mark.parametrize(("call", "message"), REFUSED)
def test_an_argument_without_meaning_is_refused_by_name(call, message):
    with pytest.raises(contact.ContactError, match=message):
        call()
