"""Fatigue below the surface over a profile: Basquin's line, one contact, sums, sides, errors."""

import numpy as np
import pytest

import contact
from contact import ContactError
from contact.accumulation import Section
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.stress import Endurance, SurfaceLoad, dang_van
from tests.command_line import call

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
LINE = Endurance(300e6, 8.0, 1e6)
DEPTHS = np.linspace(0.5e-3, 6e-3, 8)


@pytest.fixture(scope="module")
def touch():
    (patch,) = Pair(WHEEL, RAIL).contacts(Pose(y=1e-3), load=8e4)
    return patch, contact.solve(patch.separation, patch.creepage, load=patch.load)


def test_the_line_has_basquins_slope():
    assert float(LINE.damage(300e6)) == pytest.approx(1e-6, rel=1e-12)
    np.testing.assert_allclose(LINE.damage([600e6, 150e6, -1e6]), [256e-6, 1e-6 / 256, 0.0], rtol=1e-12)


@pytest.mark.parametrize("body", ["wheel", "rail"])
def test_one_contact_takes_the_share_of_its_largest_stress_under_the_patch(touch, body):
    patch, solution = touch
    own = {"wheel": WHEEL, "rail": RAIL}[body]
    section = Section(own, LINE, DEPTHS, width=2e-4)
    section.add(patch, solution, 1e3)
    found = dang_van(SurfaceLoad.of(solution, 32), DEPTHS, body=body, poisson_ratio=0.28)
    assert section.worst.damage == pytest.approx(1e3 * float(LINE.damage(found.peak.value)), rel=0.05)
    assert section.worst.depth == found.peak.z
    y = (patch.on_wheel if body == "wheel" else patch.on_rail)[0]
    # the arc length is y + y³/6r² or so on the tread
    assert section.worst.arc == pytest.approx(y + found.peak.y, abs=1e-3)


def test_passages_add_up(touch):
    one, other = (Section(RAIL, LINE, DEPTHS) for _ in range(2))
    one.add(*touch, 3.0)
    for _ in range(3):
        other.add(*touch)
    np.testing.assert_allclose(one.damage, other.damage, rtol=1e-12)
    assert one.passages == other.passages == 3.0


def test_the_left_rail_is_damaged_at_the_same_place(touch):
    (patch,) = Pair(WHEEL, RAIL, side="left").contacts(Pose(y=-1e-3), load=8e4)
    # the strips of both sides are solved to 1e-4 of the pressure, which the exponent multiplies
    left, right = (Section(RAIL, LINE, DEPTHS) for _ in range(2))
    left.add(patch, contact.solve(patch.separation, patch.creepage, load=patch.load))
    right.add(*touch)
    np.testing.assert_allclose(left.damage, right.damage, rtol=1e-2, atol=1e-4 * right.worst.damage)


def test_the_command_line():
    words = ("stress", "--curvatures", 1.1, 0.8, "--endurance", 3e8, 8, 1e6)
    import json

    (found,) = json.loads(call(*words, "--json").stdout)["patches"]
    assert found["passages"] == pytest.approx(1e6 * (3e8 / found["dang_van"]["value"]) ** 8, rel=1e-9)
    assert "passages to failure" in call(*words).stdout
    assert "endurance.limit = 0 is outside" in call(*words[:-3], 0, 8, 1e6, code=2).stderr


def test_a_patch_of_another_profile_is_refused(touch):
    with pytest.raises(ContactError, match="does not lie on"):
        Section(RAIL.rotated(0.1), LINE, DEPTHS).add(*touch)
