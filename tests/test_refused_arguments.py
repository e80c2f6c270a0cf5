"""Arguments without meaning are refused by name, beside numbers outside their ranges (`test_refused.py`): one row a fault."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import contact
from contact import damage, inp
from contact.accumulation import Section
from contact.arrays import as_array, require_numbers
from contact.errors import require_integer
from contact.geometry import conicity, contact_points, profile
from contact.geometry.surfaces import Flat, Polygon, RailSurface, SurfacePair, Wave, WheelSurface
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity, contacts
from contact.halfspace import Gap, LocalLaw, Transient
from contact.inputs.material import Thermal
from contact.pair import ContactDamping, FrictionMemory, HalfspacePair, RollerRig, WheelRailPair
from contact.pair.curving import in_curve
from contact.stress import Endurance, SurfaceLoad, at, below, dang_van, largest
from contact.theory import kalker
from contact_fmu import surfaces
from contact_models.life.flange import Flange
from contact_models.life.scale import Workers
from contact_models.runs.torque import Torque
from contact_models.toml import build
from contact_models.vehicle import hunting
from contact_models.vehicle.declared import read
from contact_models.vehicle.measured import Measured
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from tests.doors import CREEPAGE, ELLIPSE, HALF, LAW, PAIR, RAIL, WHEEL, law, on_rollers, rolled, solve, steel
from tests.study.problems import problem

SQUARE = SurfaceLoad([0.0, 1.0], [0.0, 1.0], np.ones((2, 2)))
LINE = Endurance(1e8, 8.0, 1e6)
CIRCLE = Transient(ELLIPSE, load=1.0)
CONE, ARC = profile.cone(0.0), profile.rail_arc(0.3)
POINTS = np.stack((ARC.y, ARC.z), axis=1)
#: With this origin the crown of a rail lies under the tape circle.
UNDER = {"rail_origin": (0.75, 0.0)}
ON_ARC = {"gauge": 1.5, "gauge_point": 1e-3}
CURVE = Curve(start=0.0, radius=500.0, length=40.0)
LAYER = contact.ThirdBody()
MASKED = np.ma.masked_array([1.0, 2.0, 3.0], mask=[0, 0, 1])


def stressed(**given):
    return at(**{"load": SQUARE, "x": 0.0, "y": 0.0, "z": 0.0, **given})


def forces(**given):
    return contact.forces(ELLIPSE, CREEPAGE, **given)


def points(kind="rail", y=(0, 1, 2, 3), z=(0, 0, 0, 0)):
    return profile.Profile(kind, y, z)


def on_slices(wheel=CONE, rail=ARC, **given):
    return SurfacePair(wheel, rail, **{**UNDER, **given})


def sliced(s=(0.0, 1.0), **given):
    return RailSurface(s, [POINTS] * len(s), **given)


def steered(**given):
    return conicity(profile.cone(0.05), ARC, **{**ON_ARC, "amplitudes": [1e-3], "step": 1e-4, **given})


def in_a_curve(**given):
    return in_curve(WHEEL, RAIL, 300.0, **{"load": 54.5e3, "speed": 15.0, "cant": 0.1, **given})


def torque(**given):
    return build(Torque, {"at": [0.0], "values": [1.0], **given}, "torque")


REFUSED: list[tuple[Callable[[], Any], str]] = [
    # a contact
    (lambda: solve(), "exactly one of load and approach is needed; load = None, approach = None"),
    (lambda: solve(load=1.0, approach=1.0), "exactly one of load and approach is needed; load = 1.0, approach = 1.0"),
    (lambda: solve(approach=math.inf), "approach = inf"),
    (lambda: solve(load="80e3"), "load = '80e3' is not a number"),
    (lambda: solve(load=1e9), r"load = 1e\+09: .*end of the given separation"),
    (lambda: solve(load=1.0, normal="ANALYN"), "normal = 'ANALYN' is not a registered method, did you mean 'analyn'"),
    (lambda: solve(load=1.0, tangential="fastripe"), "'fastripe' .*, did you mean 'fastrip'"),
    (lambda: solve(None, load=1.0), "separation = None is not a contact.Separation"),
    (lambda: solve(load=1.0, force=math.nan), "force = nan is not finite"),
    (lambda: solve(load=1.0, force="1e3"), "force = '1e3' is not a number"),
    (lambda: solve(load=1.0, force=(None, None)), "is not a number or a pair"),
    (lambda: solve(load=1.0, force=(1.0, 2.0, 3.0)), "is not a number or a pair"),
    (lambda: solve(load=1.0, force=(1.0, math.inf)), "force = inf is not finite"),
    (lambda: solve(load=1.0, material=steel(pressure_limit=1e9), **HALF), "normal = 'halfspace' is elastic"),
    (lambda: solve(load=1.0, friction=law(slope=0.5), **HALF), r"friction.slope = 0.5: tangential = 'halfspace'"),
    (lambda: solve(load=1.0, layer=LAYER, tangential="fastsim"), "'fastsim' has no third body"),
    (lambda: solve(load=1.0, layer=3.0, **HALF), r"layer = 3.0 is not a contact.ThirdBody"),
    (lambda: solve(load=1.0, layer=LAYER, friction=replace(LAW, velocity="local"), **HALF), "not depend on local slip"),
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
    (lambda: contact.Separation.hertzian(1e-9, 1e-9), r"A = 1e-09 is outside the allowed range \[1e-06, 1e\+09\]"),
    (lambda: contact.Separation.hertzian(1.0, 1e300), r"B = 1e\+300 is outside the allowed range \[1e-06, 1e\+09\]"),
    (lambda: contact.hertz(1e100, 1e300, load=1.0), r"A = 1e\+100 is outside the allowed range"),
    (
        lambda: contact.Separation([0, 1, 2], [0, 0, -1e200], 1.0),
        r"g\[2\] = -1e\+200 is outside the allowed range \[-1",
    ),
    (
        lambda: contact.Separation([0, 1e-13, 2], [0, 0, 0], 1.0),
        r"y must increase, by 1e-12 at least; y\[0\] = 0, y\[1",
    ),
    (lambda: contact.Material(1e-20, 0.28), r"shear_modulus = 1e-20 is outside the allowed range \[0.001, 1e\+15\]"),
    (
        lambda: inp.solve("case.inp"),
        r"cases = 'case.inp' are no cases; contact.inp.read\(path\) returns those of a file",
    ),
    (lambda: contact.Separation([0, 1, 2], [0, 0, 0], "steep"), "A = 'steep' is not a number"),
    (lambda: contact.Separation([0, 1, 2], [0, 0, 0], 1.0, [0, math.inf, 0]), r"x_c\[1\] = inf"),
    (lambda: contact.Separation(ELLIPSE.y, ELLIPSE.g, 1.0, tilt=1.1e3), r"outside the allowed range \[-1000, 1000\]"),
    (lambda: contact.Creepage("fast"), "creepage"),
    (lambda: contact.hertz(0.0, 1.0, load=1.0), "A = 0"),
    (lambda: contact.hertz(1.0, -1.0, load=1.0), "B = -1"),
    (lambda: contact.hertz(1.0, 1.0, load=math.nan), "load = nan"),
    (lambda: contact.hertz(1.0, 1.0, approach=-1.0), "approach = -1"),
    (lambda: contact.hertz(1.0, 1.0), "exactly one"),
    (lambda: contact.hertz(1.0, 1.0, load=1.0, approach=1.0), "exactly one"),
    (lambda: forces(load=[1.0, -2.0]), r"load\[1\] = -2 is outside the allowed range \[0, 1e\+15\]"),
    (lambda: forces(load=[1.0, math.nan]), r"load\[1\] = nan"),
    (lambda: forces(load=1e300), r"load = 1e\+300 is outside the allowed range \[0, 1e\+15\]"),
    (lambda: solve(approach=1e300), r"approach = 1e\+300 is outside the allowed range \[-1e\+15, 1e\+15\]"),
    (lambda: solve(load=1e200, **HALF), r"load = 1e\+200 is outside"),
    (lambda: forces(load=1.0, friction=[[0.1], [-1.0]]), r"friction\[1, 0\] = -1"),
    (lambda: forces(load=[1.0, 2.0], friction=[0.1, 0.2, 0.3]), r"do not broadcast: load \(2,\)"),
    (lambda: forces(), "exactly one"),
    (lambda: contact.Solver().forces(None, CREEPAGE, load=1.0), "separation = None is not a contact.Separation"),
    (lambda: contact.Solver().forces(ELLIPSE, (1e-3, 0.0), load=1.0), r"creepage = .* is neither a contact.Creep"),
    (lambda: contact.Solver(normal="analin"), "normal = 'analin' is not a registered method, did you mean 'analyn'"),
    (lambda: contact.Solver(normal="halfspace"), "normal = 'halfspace' is not offered here, only by contact.solve"),
    (lambda: contact.Solver(tangential="fastsim_knothe"), "tangential = 'fastsim_knothe' is not offered here, only by"),
    (lambda: contact.Solver(n_samples=2), r"n_samples = 2 is not an integer in the allowed range \[3, inf\["),
    (lambda: contact.Solver(n_samples=3.7), r"n_samples = 3.7 is not an integer"),
    (lambda: contact.Solver(friction="dry"), "friction = 'dry' is not a number"),
    (lambda: contact.Solver(tangential="polach", conformal=True), "conformal: tangential = 'polach' is only for"),
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
    (lambda: CIRCLE.shift(math.nan), "longitudinal = nan is not finite"),
    (lambda: CIRCLE.roll(CREEPAGE, distance=0.0), "distance = 0 is outside"),
    (lambda: CIRCLE.roll(1e-3, distance=1e-4), "creepage = 0.001 is neither a contact.Creepage"),
    (lambda: CIRCLE.shift(load=2.0), "load = 2 is outside"),
    (lambda: CIRCLE.shift(load=1.0, approach=1e-5), "only one may be given"),
    (lambda: CIRCLE.shift(force="much"), "force = 'much'"),
    (lambda: LocalLaw(0.2, terms=(("cubic", 0.1, 0.1),)), "cubic"),
    (lambda: LocalLaw(0.2, memory_distance=-1.0), "memory_distance = -1"),
    (lambda: LocalLaw(math.nan), "nan"),
    *(
        (lambda given=given: solve(load=1.0, derivatives=True, **given), "derivatives = True does not work with")
        for given in (HALF | {"normal": "analyn"}, {"tangential": "halfspace"}, {"force": 1e3})
    ),
    # materials and friction
    (lambda: steel(coupling=0.6), "coupling = 0.6 is outside"),
    (lambda: steel(coupling=math.nan), "coupling = nan is outside"),
    (lambda: kalker.table(0.51), "poisson_ratio"),
    (lambda: kalker.table(-0.01), "poisson_ratio"),
    (lambda: Thermal(density=0.0), r"thermal.density = 0 is outside"),
    (lambda: law(law="stribeck"), "friction.law = 'stribeck' is unknown; allowed: coulomb, linear"),
    (lambda: law(velocity="mean"), "friction.velocity = 'mean' is unknown; allowed: global, local, greatest"),
    (lambda: law(reference_temperature=-1.0), r"friction.reference_temperature = -1 is outside the .* \[0, 100000\]"),
    (lambda: law(background_temperature=math.nan), "friction.background_temperature = nan"),
    (lambda: contact.ThirdBody(flexibility=-1.0), "layer.flexibility = -1"),
    (lambda: contact.ThirdBody(yield_stress=0.0), "layer.yield_stress = 0"),
    (lambda: contact.ThirdBody(hardening=math.nan), "layer.hardening = nan"),
    # a wheel on its rail
    (lambda: WheelRailPair(WHEEL), r"pair = Profile.* is no contact.geometry.wheelset.Pair; make one"),
    (lambda: WheelRailPair(None), r"pair = None is no"),
    (lambda: WheelRailPair(PAIR, material=2e11), r"material = .* is not a contact.inputs.material.Material"),
    (lambda: WheelRailPair(PAIR, damage="archard"), "damage = 'archard' is no"),
    (lambda: WheelRailPair(PAIR, normal="none"), "normal = 'none' is not a registered method"),
    (lambda: rolled(velocity=20.0), r"velocity = 20.0 is not a contact.geometry.wheelset.Velocity"),
    (lambda: rolled(Pose(y=1.0)), "pose.y = 1: the right wheel and rail profiles do not overlap"),
    (lambda: rolled(Pose(z=0.01), load=None), "pose.z = 0.01: the right wheel lies more than 0.005 m inside its rail"),
    (lambda: rolled(penetration=1e-5), "exclude each other"),
    (lambda: rolled(vertical=1), "vertical = 1 excludes load = 80000.0"),
    (lambda: rolled(load=1e12), r"load = 1e\+12: no z was found"),
    (lambda: rolled(offset=0.1), r"offset = 0.1 is not a contact.geometry.flexible.WheelOffset"),
    (lambda: rolled(load=None, vertical=7e4, force=1.0, torque=1.0), "exactly one of force and torque"),
    (lambda: rolled(load=None, vertical=7e4, force=math.nan), "force = nan is not finite"),
    (lambda: rolled(load=None, vertical=7e4, torque="much"), "torque = 'much' is not a number"),
    (lambda: rolled(load=None, velocity=Velocity(0.0), force=1.0, vertical=7e4), r"velocity.forward = 0 is outside"),
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
    (lambda: damage.DamageParameters(wear_law="reye"), "wear_law = 'reye' is unknown; allowed: archard, usfd"),
    (lambda: damage.burstow(-1.0), r"T_gamma = -1 is outside the allowed range \[0, inf\["),
    (lambda: damage.burstow([1.0, math.nan]), r"T_gamma\[1\] = nan"),
    (lambda: damage.usfd(10.0, 0.0), r"area = 0 is outside the allowed range \]0, inf\["),
    (lambda: damage.usfd([1.0, 2.0], [1.0, 2.0, 3.0]), "do not broadcast"),
    (lambda: damage.t_gamma("much", 0.0, 0.0, 0.0), "Fx = 'much' is not a number"),
    (lambda: damage.wear_coefficient(0.1, 1e9, -2.7e9), "hardness"),
    (lambda: damage.Burstow(peak_at=10.0), r"burstow.peak_at = 10 is outside the allowed range \]15, inf\["),
    (lambda: damage.PearceSherratt(severe_limit=50.0), "pearce_sherratt.severe_limit = 50"),
    (lambda: damage.Usfd(severe_branch="steep"), "severe_branch = 'steep' is unknown; allowed: continuous"),
    (lambda: damage.ArchardMap(severe_to=0.1), "archard.severe_to"),
    (lambda: stressed(z=-1e-3), r"z = -0\.001 is outside the allowed range \[0, inf\["),
    (lambda: stressed(x=math.nan), "x = nan is not finite"),
    (lambda: stressed(x=[0.0, 1.0], y=[0.0, 1.0, 2.0]), "broadcast"),
    (lambda: stressed(body="sleeper"), "body = 'sleeper' is unknown; allowed: rail, wheel"),
    (lambda: stressed(poisson_ratio=0.6), "poisson_ratio = 0.6 is outside the allowed range"),
    (lambda: stressed(load=3.0), "neither a contact.Solution nor"),
    (lambda: SurfaceLoad([0.0, 1.0, 3.0], [0.0, 1.0], np.ones((2, 3))), "does not increase in equal steps"),
    (lambda: SurfaceLoad([0.0, 1.0], [0.0, 1.0], np.ones((2, 2)), np.ones(2)), r"qx has shape \(2,\); \(2, 2\) is"),
    (lambda: SurfaceLoad([0.0, 1.0], [0.0, 1.0], [[0.0, math.nan], [1.0, 1.0]]), r"p\[0, 1\] = nan"),
    (lambda: largest(solve(load=0.0)), "NO_CONTACT: there is no contact"),
    (lambda: largest(solve(load=8e4, tangential="polach")), "gives forces only"),
    (lambda: largest(SQUARE, "mises"), "criterion = 'mises' is unknown"),
    (lambda: below(SQUARE, np.ones((2, 2))), r"z has shape \(2, 2\)"),
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
    # arrays
    (lambda: contact.Separation([0, 1, 2], MASKED, 1.1), r"^g\[2\] is masked; leave masked values out, for example by"),
    (lambda: as_array("p", [[1.0] * 3, MASKED]), r"^p\[1\]\[2\] is masked"),
    (lambda: as_array("p", [1.0, np.ma.masked]), r"^p\[1\] is masked"),
    (lambda: as_array("p", np.ma.masked_equal([[1.0], [2.0]], 2.0)), r"^p\[1, 0\] is masked"),
    (lambda: require_integer("n_strips", True), r"^n_strips = True is not an integer"),
    (lambda: require_numbers("a", [[1.0, 2.0], [-1.0, -2.0]], 0.0), r"^a\[1, 0\] = -1 is outside .* \[0, inf\["),
    (lambda: require_numbers("a", [1.0, 0.0], 0.0, 3.0, open_minimum=True), r"^a\[1\] = 0 is outside .* \]0, 3\]"),
    (lambda: require_numbers("a", np.nan), r"^a = nan is not finite"),
    # profiles
    (lambda: points("hub"), "kind = 'hub'"),
    (lambda: points(y=[0, 1, 2], z=[0, 0, 0]), "at least 4"),
    (lambda: points(z=[0, 0, 0]), "equally many"),
    (lambda: points(y=[0, 1, 1, 3]), "coincide"),
    (lambda: points(y=[0, 1, math.nan, 3]), "finite"),
    (lambda: profile.rail_60e1(0.5), r"inclination = 0\.5"),
    *((lambda text=text: profile.rail_60e1(text), "a ratio like 1/40") for text in ("1/0", "steep", "1/40/2")),
    (lambda: profile.rail_60e1(breakpoints="EN"), "breakpoints = 'EN'"),
    (lambda: profile.cone(-1), "conicity = -1"),
    (lambda: profile.named("60E9"), "'60E9' is no profile of the standards, did you mean '60E[12]'"),
    (lambda: profile.named("S1002", kind="rail"), "'S1002' is no profile"),
    (lambda: profile.named("S1002", inclination=0.025), "S1002 has no inclination"),
    (lambda: profile.named("60E2", flange_height=0.028), "60E2 has no flange_height"),
    (lambda: profile.named("rail A", inclination=0.05), "EN 15302 rail A has no inclination"),
    (lambda: profile.named("wheel B", flange_thickness=0.03), "EN 15302 B has no flange_thickness"),
    (lambda: profile.named("60E2", inclination=0.5), "inclination = 0.5 is outside"),
    (lambda: profile.named("1/40", flange_height=28.0), "flange_height = 28 is outside"),
    (lambda: profile.named("EPS", flange_thickness=0.03), r"flange_thickness = 0.03 is outside .* \[0.0325, 0.0325\]"),
    (lambda: Flange.measured(profile.cone(0.05)), "no flange"),
    # the place of a wheelset
    (lambda: Pair(RAIL, RAIL), "wheel = .* is not a profile of a wheel"),
    (lambda: Pair(WHEEL, WHEEL), "rail = .* is not a profile of a rail"),
    (lambda: Pair(WHEEL, RAIL, side="up"), "side = 'up'"),
    (lambda: Pair(WHEEL, RAIL, samples=3), "samples = 3"),
    (lambda: Pair(WHEEL, RAIL, samples=[0, 1, 1, 2, 3]), "increasing"),
    (lambda: Pair(WHEEL, RAIL, samples="many"), "samples = 'many'"),
    (lambda: rolled(irregularity=Irregularity(y=1.0)), r"do not overlap; .*; look at irregularity\.y and offset\.y"),
    (lambda: contacts(WHEEL, RAIL, Pose(y=0.2)), r"pose\.y = 0\.2: the right wheel and rail profiles do not overlap"),
    (lambda: contacts(WHEEL, RAIL, 3e-3), r"pose = 0\.003 is not a contact\.geometry\.wheelset\.Pose"),
    (lambda: contacts(WHEEL, RAIL, Pose(), 20.0, load=1.0), r"velocity = 20\.0 is not a .*Velocity"),
    (lambda: contacts(WHEEL, RAIL, Pose(), irregularity=Pose()), r"irregularity = Pose.* is not a .*Irregularity"),
    (lambda: contacts(WHEEL, RAIL, Pose(), load=-1.0), "load = -1"),
    (lambda: contacts(WHEEL, RAIL, Pose(), penetration=-1e-5), "penetration = -1e-05"),
    (lambda: contacts(WHEEL, RAIL, Pose(), load=1.0, penetration=1e-5), "exclude each other"),
    (lambda: contacts(WHEEL, RAIL, Pose(), load=1e12), "no z was found"),
    (lambda: contact_points(CONE, ARC, [], **ON_ARC), r"y of shape \(0,\)"),
    (lambda: steered(amplitudes=[0.0]), r"amplitudes\[0\] = 0 is outside"),
    (lambda: steered(amplitudes="x"), "amplitudes = 'x' is not a number"),
    (lambda: steered(amplitudes=[]), "at least one"),
    (lambda: steered(step=1.0), "step = 1 is outside"),
    (lambda: steered(gauge="wide"), "gauge = 'wide' is not a number"),
    (lambda: steered(left_radius=0.44), "has the same sign"),
    (lambda: steered(left_wheel=ARC), "is not a profile of a wheel"),
    (lambda: in_a_curve(load=54.5), r"load = 54.5 is outside the allowed range \[100"),
    (lambda: in_a_curve(speed=0.0), "speed = 0 is outside"),
    (lambda: in_a_curve(cant=100.0), "cant = 100 is outside"),
    (lambda: in_a_curve(yaw_stiffness=-1.0), "yaw_stiffness = -1 is outside"),
    (lambda: in_a_curve(speed=120.0), r"radius = 300, speed = 120, cant = 0.1: no steady motion|overlap"),
    # surfaces
    (lambda: sliced([0.0, 2.0, 1.0]), r"s must increase strictly; s\[1\] = 2, s\[2\] = 1"),
    (lambda: sliced([0.0, math.nan]), "finite positions"),
    (lambda: RailSurface([0.0, 1.0], [POINTS]), "1 slices for 2 positions"),
    (lambda: RailSurface([0.0], [POINTS[:3]]), "at least 4 finite points"),
    (lambda: RailSurface([0.0], [np.where(POINTS[9] == POINTS, math.nan, POINTS)]), "at least 4 finite points"),
    (lambda: RailSurface([0.0], [POINTS[[0, 1, 1, 2, 3]]]), "points 1 and the next coincide"),
    (lambda: sliced(features=[[0.0, 1.0]]), r"features has shape \(1, 2\)"),
    (lambda: sliced(features=[[0.0, 0.01, 1.0], [0.0, math.nan, 1.0]]), "without holes"),
    (lambda: sliced([0.0], features=[[0.0, 0.03, 0.02]]), "must increase strictly"),
    (lambda: sliced([0.0], features=[[0.0, 7.0, 9.0]]), "end within the slice"),
    (lambda: sliced([0.0], corners=[1]), "is no inner feature"),
    (lambda: sliced([0.0], spacing=0.0), r"spacing = 0 is outside"),
    (lambda: RailSurface.constant(WHEEL), "not a profile of a rail"),
    (lambda: RailSurface([0.0, 1.0], [ARC, CONE]), r"slices\[1\] = .* is not a profile of a rail"),
    (lambda: WheelSurface([0.0, 7.0], [POINTS] * 2), "less than a full turn"),
    (lambda: WheelSurface.from_deviations([0.0, 0.1], ARC.y, np.zeros((2, 5))), r"dr has shape \(2, 5\)"),
    (lambda: WheelSurface.constant(CONE, 3.0), r"deviation = 3.0 has no method at\(u\)"),
    (lambda: Polygon(0, 1e-4), "order = 0"),
    (lambda: Flat(0.05, shape="square"), "shape = 'square'"),
    (lambda: Flat(0.05, depth=1e-3, shape="chord"), "follows from its length"),
    (lambda: SurfacePair(CONE, sliced()), "rail_origin = None"),
    (lambda: on_slices(rows=5), "rows = 5 is outside"),
    (lambda: on_slices(ARC), "not a profile of a wheel"),
    (lambda: on_slices().contacts(Pose(y=0.5), penetration=1e-4), "does not lie above its rail"),
    (lambda: on_slices().contacts(Pose(), load=1.0, penetration=1e-4), "exclude each other"),
    (lambda: on_slices().contacts(Pose(), load=1e9), "no z was found"),
    (lambda: on_slices().contacts(Pose(), station=math.nan), "station = nan"),
    (lambda: HalfspacePair(PAIR), r"is not a contact\.geometry\.surfaces\.SurfacePair"),
    (lambda: HalfspacePair(on_slices()).solve(Pose(), vertical=1.0, load=1.0), "only one may be given"),
    (lambda: surfaces.pack(sliced(np.arange(60.0), spacing=1.5e-5)), "reads at most 2000000"),
    (lambda: surfaces.pack(RailSurface.constant(RAIL, Wave(0.3, 1e-4))), "has deviations, which have no end"),
    # studies
    (lambda: contact.compare([]), "cases is empty or holds an object that is not a contact.Case"),
    (lambda: contact.compare([problem(), problem()]), "two have the name 'ellipse'"),
    (lambda: contact.compare(problem(), "magic+fastrip"), "normal = 'magic'"),
    (lambda: contact.compare(problem(), "analyn"), "'analyn' is not a normal and a tangential method"),
    (lambda: contact.compare(problem(), "halfspace+fastrip"), r"halfspace\+fastrip cannot be combined"),
    (lambda: contact.compare(problem(), [], reference=False), "methods is empty"),
    (lambda: contact.compare(problem(), reference_elements=2), "reference_elements = 2"),
    (lambda: contact.compare(problem(friction=-1.0)), "friction = -1"),
    (lambda: problem(approach=1e-5), "exactly one of load and approach"),
    (lambda: contact.Case(1.0, CREEPAGE, load=1.0), "separation = 1.0"),
    # vehicles
    (lambda: Track(curves=(CURVE, replace(CURVE, start=100.0))), "starts at 100 m overlaps .* ends at 140 m"),
    (lambda: Irregularities(spectrum="ERRI B176 lo"), "did you mean 'ERRI B176 low'"),
    (lambda: Measured(file="x", direction="up"), "neither 'rising'"),
    (lambda: Measured(file="x", unit="cm"), "neither 'm'"),
    (lambda: torque(values=[1.0, 2.0]), "at has 1 places and values 2 torques"),
    (lambda: torque(at=[1.0, 0.0], values=[1.0, 2.0]), r"at\[1\] = 0"),
    (lambda: torque(values=[1e7]), r"values\[0\] = 1e\+07"),
    (lambda: torque(over="tme"), "over = 'tme' is neither 'distance' nor 'time'.*time"),
    (lambda: hunting.fall(read("wheelset"), (WHEEL, RAIL), (20.0, 10.0)), "two rising speeds"),
    (lambda: read("lorry"), "neither a file nor one of manchester, wheelset"),
    (lambda: Workers(0), r"workers = 0 is outside the allowed range \[1, 512\]"),
]


@pytest.mark.parametrize(("call", "message"), REFUSED)
def test_an_argument_without_meaning_is_refused_by_name(call, message):
    with pytest.raises(contact.ContactError, match=message):
        call()
