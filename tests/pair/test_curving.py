"""A wheelset in a curve: what is in balance, pure rolling, guidance, height, errors, the command."""

import json
import math

import pytest

from contact.geometry import profile
from contact.pair.curving import GRAVITY, in_curve
from tests.command_line import call

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
LOAD = 54.5e3
BENCHMARK = {"load": LOAD, "speed": 15.0, "cant": 0.1}
BOGIE = {"yaw_stiffness": 1e7, "lead": 1.28}


@pytest.fixture(scope="module")
def leading():
    return in_curve(WHEEL, RAIL, 300.0, **BENCHMARK, **BOGIE)


def test_rails_weight_inertia_and_guidance_are_in_balance(leading):
    tilt, around = math.asin(0.1 / 1.5), 15.0**2 / 300.0 / GRAVITY
    W = 2.0 * LOAD
    for found in (leading, in_curve(WHEEL, RAIL, 300.0, **BENCHMARK)):
        assert found.lateral == pytest.approx(W * (around * math.cos(tilt) - math.sin(tilt)), abs=2e-5 * W)
        assert found.guiding == pytest.approx(found.lateral, abs=1.0)
        weight = found.outer.Q + found.inner.Q
        assert weight == pytest.approx(W * (math.cos(tilt) + around * math.sin(tilt)), abs=2e-5 * W)
        assert found.outer.moment[1] + found.inner.moment[1] == pytest.approx(0.0, abs=2e-5 * W)
        assert found.trusted
    assert leading.steering == pytest.approx(1e7 * (leading.yaw + 1.28 / 300.0), abs=2.0)


def test_a_free_wheelset_rolls_on_the_circles_that_fit_the_curve():
    """Without friction forces to balance, the radii differ by 2 b r/R and the axle is radial."""
    free = in_curve(WHEEL, RAIL, 1000.0, load=LOAD, speed=10.0, cant=10.0**2 / 1000.0 / GRAVITY * 1.5)
    outer, inner = (
        wheel.contacts[0].on_wheel[1] for wheel in (free.outer, free.inner)
    )  # depth of the contact on the profile: the radius grows with it
    b = 0.5 * (abs(free.outer.contacts[0].position[1]) + abs(free.inner.contacts[0].position[1]))
    assert outer - inner == pytest.approx(2.0 * b * 0.46 / 1000.0, rel=0.05)
    assert abs(free.yaw) < 2e-4
    assert abs(free.lateral) < 50.0
    assert free.y < 0.0
    assert max(free.outer.damage.T_gamma, free.inner.damage.T_gamma) < 1.0


def test_a_stiff_bogie_turns_its_leading_axle_out_and_its_trailing_axle_in(leading):
    trailing = in_curve(WHEEL, RAIL, 300.0, **BENCHMARK, yaw_stiffness=1e7, lead=-1.28)
    assert leading.yaw < -1e-3 < 1e-3 < trailing.yaw
    assert leading.outer.Y > 1e4  # the flange guides
    free = in_curve(WHEEL, RAIL, 300.0, **BENCHMARK)
    assert leading.outer.damage.T_gamma > 20.0 * free.outer.damage.T_gamma


def test_a_high_centre_of_gravity_loads_the_outer_wheel():
    fast = {"load": LOAD, "speed": 25.0, "cant": 0.0}
    low, high = (in_curve(WHEEL, RAIL, 600.0, **fast, height=h) for h in (None, 1.5))
    moved = 0.5 * ((high.outer.Q - high.inner.Q) - (low.outer.Q - low.inner.Q))
    assert moved == pytest.approx(low.lateral * (1.5 - 0.46) / 1.5, rel=0.03)


@pytest.mark.parametrize("radius", [100.0, 25.0])
def test_curves_of_trams_and_depots(radius):
    found = in_curve(WHEEL, RAIL, radius, load=40e3, speed=3.0, yaw_stiffness=1e7, lead=0.9)
    assert found.yaw == pytest.approx(-0.9 / radius, rel=0.1)
    assert found.outer.used_friction == pytest.approx(0.3, abs=0.01)  # it slides across


def test_the_command_has_the_numbers_of_the_python_api(leading):
    words = ("curving", "--curve-radius", 300, "--speed", 15, "--cant", 0.1, "--load", LOAD)
    words += ("--yaw-stiffness", 1e7, "--lead", 1.28)
    found = json.loads(call(*words, "--json").stdout)
    assert found["wheelset"]["y"] == pytest.approx(leading.y, rel=1e-9)
    assert [row["Y"] for row in found["wheels"]] == pytest.approx([leading.outer.Y, leading.inner.Y], rel=1e-6)
    assert found["units"]["spin"] == "rad/s"
    assert "mm to the outside" in call(*words).stdout
