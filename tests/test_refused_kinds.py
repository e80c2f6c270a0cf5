"""Arguments of a wrong kind are refused by name, and those of pairs without meaning, beside `test_refused_arguments.py`."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import HalfspacePair, RollerRig, WheelRailPair, over_poses
from contact_models.runs.scenario import Methods
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.simulation import Simulation
from contact_models.vehicle.track import Track
from tests.doors import CREEPAGE, ELLIPSE, PAIR, RAIL, WHEEL, rolled, solve, steel
from tests.vehicle.parts import FAST, simulation


def on_elements(velocity=None, **given):
    return HalfspacePair(SurfacePair(WHEEL, RAIL)).solve(Pose(), velocity, **{"load": 8e4, **given})


def on_profiles_that_may_change(pose=None, **given):
    return WheelRailPair(SurfacePair(WHEEL, RAIL), normal="analyn").solve(pose or Pose(), **{"load": None, **given})


def shared(threads):
    rows = lay(Track(), 5.0, lambda s: 15.0, (1,), 0.0)
    return Simulation(read("wheelset"), rows, WHEEL, RAIL, 0.3, FAST, threads=threads)


def driven(motion, **given):
    return WheelRailPair(PAIR).run(motion, **given)


REFUSED: list[tuple[Callable[[], Any], str]] = [
    # a contact
    (lambda: solve(load=1.0, normal=["analyn"]), r"normal = \['analyn'\] is not a registered method"),
    (lambda: solve(load=1.0, material="steel"), "material = 'steel' is not a contact.inputs.material.Material"),
    (lambda: solve(load=1.0, conformal="no"), "conformal = 'no' is neither True nor False"),
    (lambda: solve(load=1.0, speed=np.array([1.0, 2.0])), r"speed = array\(\[1., 2.\]\) is not a number"),
    (lambda: contact.Solver(conformal=2), "conformal = 2 is neither True nor False"),
    (lambda: contact.forces(None, CREEPAGE, load=1.0), "separation is empty or holds an object that is not"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load=1.0, threads="x"), "threads = 'x' is not an integer"),
    (lambda: contact.forces(ELLIPSE, CREEPAGE, load=1.0, conformal="no"), "conformal = 'no' is neither True nor False"),
    (lambda: steel(pressure_limit=np.array([1e9, 2e9])), r"pressure_limit = array\(.*\) is not a number"),
    # what a wheel's motion is
    (lambda: Pair(WHEEL, RAIL, material=None), "material = None is not a contact.inputs.material.Material"),
    (lambda: WheelRailPair(PAIR, material=None), "material = None is not a contact.inputs.material.Material"),
    (lambda: WheelRailPair(PAIR, conformal="yes"), "conformal = 'yes' is neither True nor False"),
    (lambda: rolled(velocity={}), "velocity = {} is not a contact.geometry.wheelset.Velocity"),
    (lambda: rolled(velocity="fast", force=1.0), "velocity = 'fast' is not a contact"),
    (lambda: rolled(irregularity=0), "irregularity = 0 is not a contact.geometry.wheelset.Irregularity"),
    (lambda: rolled(rotation="1"), "rotation = '1' is not a number"),
    (lambda: rolled(rotation="1", offset=WheelOffset(pitch=0.01)), "rotation = '1' is not a number"),
    (lambda: RollerRig(PAIR, 0.6).solve(None, Velocity(1.0), load=1.0), "pose = None is not a contact"),
    (lambda: RollerRig(PAIR, 0.6).contacts(Pose(), None), "velocity = None is not a contact"),
    (lambda: on_elements(load="8"), "load = '8' is not a number"),
    (lambda: on_elements(rotation=[1.0]), r"rotation = \[1.0\] is not a number"),
    (lambda: on_elements(velocity=20.0, force=1.0), "velocity = 20.0 is not a contact"),
    (lambda: on_elements(irregularity="x"), "irregularity = 'x' is not a contact"),
    (lambda: on_profiles_that_may_change(Pose(z=0.1)), "inside its rail"),
    (lambda: on_profiles_that_may_change(irregularity=Irregularity(z=-1e300)), "does not lie above its rail"),
    (lambda: on_profiles_that_may_change(irregularity=Irregularity(y=1e300)), "does not lie above its rail"),
    (lambda: rolled(velocity=Velocity(-1.0), torque=1e3), "forward = -1 is"),
    (lambda: over_poses(PAIR), "WheelRailPair"),
    *(
        (lambda given=given: over_poses(WheelRailPair(PAIR), **given), message)
        for given, message in (
            ({"load": -1.0}, "load = -1"),
            ({"yaw": [0.0, 0.2]}, r"yaw\[1\] = 0\.2"),
            ({"load": 1e3, "penetration": 1e-4}, "exclude"),
            ({"y": np.zeros(3), "yaw": np.zeros(2)}, "do not broadcast"),
            ({"speed": 0.0}, "speed = 0"),
        )
    ),
    (lambda: driven([1.0]), r"motion = \[1.0\] is not a collections.abc.Mapping"),
    (lambda: driven({"time": [0.0, 1.0]}, memory="x"), "memory = 'x' is not a contact.pair"),
    (lambda: driven({"time": [0.0, 1.0]}, damping=1.0), "damping = 1.0 is not a contact.pair"),
    (lambda: profile.load(None, "rail"), "name = None is not a"),
    (lambda: profile.load("rail.txt", "rail", repair="no"), "repair = 'no' is neither True nor False"),
    # the steps and the threads of a vehicle
    *((lambda n=n: simulation(options=replace(FAST, pace=n)), rf"pace = {n} is outside .* \[1, 5\]") for n in (0, 6)),
    *((lambda n=n: Methods(pace=n), f"pace = {n} is outside") for n in (0, 6)),
    *((lambda n=n: shared(n), rf"threads = {n} is outside the allowed range \[1, 2\]") for n in (0, 3)),
]


@pytest.mark.parametrize(("call", "message"), REFUSED)
def test_an_argument_of_a_wrong_kind_is_refused_by_name(call, message):
    with pytest.raises(contact.ContactError, match=message):
        call()


@pytest.mark.parametrize(
    ("name", "place"), [("WheelRailPair", "contact.pair"), ("Pose", "contact.geometry.wheelset"), ("Nonsense", "")]
)
def test_a_class_of_a_package_is_found_by_the_message(name, place):
    with pytest.raises(AttributeError) as said:
        getattr(contact, name)
    assert str(said.value) == f"module 'contact' has no attribute {name!r}" + (
        f"; it is {place}.{name}" if place else ""
    )


def test_packages_load_when_they_are_first_used():
    code = "import contact; print(contact.pair.WheelRailPair.__name__, contact.geometry.profile.s1002().kind)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["WheelRailPair", "wheel"]
