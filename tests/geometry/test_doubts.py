"""Input that is allowed but hardly meant gives a warning that names its unit or its sign; errors name the likely slip."""

import math
import warnings

import pytest

import contact
from contact import ContactError
from contact.errors import PlausibilityWarning
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity, contacts
from contact.pair import WheelRailPair

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
LIGHT = r"^{} = 80: a wheel carries 20 to 150 kN; the unit is N$"
BACKWARD = r"^velocity\.spin = 43\.4783: longitudinal creepage = 2: .*spin is negative when rolling forward"


@pytest.fixture(scope="module")
def solver():
    return WheelRailPair(Pair(WHEEL, RAIL), normal="analyn", tangential="fastrip")


def doubts(function, *arguments, **options):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        function(*arguments, **options)
    return [one for one in said if issubclass(one.category, PlausibilityWarning)]


def test_a_wheel_load_in_kilonewton_is_doubted(solver):
    with pytest.warns(PlausibilityWarning, match=LIGHT.format("load")) as said:
        contacts(WHEEL, RAIL, Pose(), load=80)
    assert said[0].filename == __file__
    for name in ("load", "vertical"):
        solver.pair._doubted = False
        with pytest.warns(PlausibilityWarning, match=LIGHT.format(name)) as said:
            solver.solve(Pose(), **{name: 80})
        assert said[0].filename == __file__
    for load in (0.0, 1e3, 80e3):
        assert not doubts(contacts, WHEEL, RAIL, Pose(), load=load)


def test_a_run_with_small_loads_warns_once(solver):
    solver.pair._doubted = False
    said = [doubts(solver.solve, Pose(), load=load) for load in (80e3, 500.0, 400.0, 300.0)]
    assert [len(one) for one in said] == [0, 1, 0, 0]


def test_a_separation_alone_may_have_any_scale():
    separation = contact.Separation.hertzian(1.1, 0.8)
    assert not doubts(contact.solve, separation, contact.Creepage(), load=80, normal="analyn", tangential="fastrip")


def test_a_wrong_sign_of_the_axles_spin_is_doubted(solver):
    motion = Velocity(forward=20.0, spin=20.0 / 0.46)
    with pytest.warns(PlausibilityWarning, match=BACKWARD):
        contacts(WHEEL, RAIL, Pose(), motion, load=80e3)
    solver.pair._doubted = False
    with pytest.warns(PlausibilityWarning, match=BACKWARD):
        solver.solve(Pose(), motion, load=80e3)
    for spin in (-20.0 / 0.46, -30.0 / 0.46, None):  # free, driven up to the slip of `contact.driven`
        assert not doubts(contacts, WHEEL, RAIL, Pose(), Velocity(forward=20.0, spin=spin), load=80e3)
    assert not doubts(contacts, WHEEL, RAIL, Pose(), Velocity(forward=0.0, spin=1.0), load=80e3)


def test_errors_name_the_likely_slip():
    with pytest.raises(ContactError, match=r"^pose\.y = 3: .*\]-0\.\d+, 0\.\d+\[ m; is it in mm\?$"):
        contacts(WHEEL, RAIL, Pose(y=3), load=80e3)
    with pytest.raises(ContactError, match=r"^pose\.y = nan is not finite$"):
        Pose(y=math.nan)
    (patch,) = contacts(WHEEL, RAIL, Pose(), load=80e3)
    with pytest.raises(ContactError, match=r"^separation is a Patch; use patch\.separation$"):
        contact.solve(patch, patch.creepage, load=80e3)
