"""Profile library: catalogue dimensions, tabulated points of the standards, names."""

import math

import numpy as np
import pytest

from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, place_of_rail
from tests.geometry.heights import height

# Half head width and its depth below the crown [mm], constants.md 14.
HEADS = {
    "60E1": (36.0, 14.3),
    "60E2": (36.0, 14.3),
    "54E1": (35.0, 14.1),
    "54E2": (33.505, 13.85),
    "54E3": (33.5, 14.0),
    "54E4": (33.5, 14.28),
    "49E1": (33.5, 14.0),
    "50E1": (32.5, None),
    "55E1": (31.0, None),
    "50E2": (36.0, 14.3),
    "56E1": (34.925, 14.53),
    "46E1": (32.5, 14.3),
}
#: y [mm] of corners between segments in the standards themselves: a chamfer, an outer slope, the end of a table.
CORNERS = {"EPS": (-35.0, -32.25, -26.0, 29.0), "1/40": (-32.696, 35.0), "EN 15302 C": (-59.5, 29.0, 59.0)}
CORNERS |= {"EN 15302 H": (-28.3119, -10.2297)}
CORNERS |= {f"EN 15302 {letter}": (30.0, 60.0, *CORNERS.get(f"EN 15302 {letter}", ())) for letter in "ABHI"}


@pytest.mark.parametrize("name", profile.names("rail")[:-1])
def test_heads_reach_their_catalogue_width(name):
    rail = profile.named(name, inclination=0.0)
    upright = math.inf if name == "46E1" else 17.2 if name in ("54E3", "54E4", "49E1") else 20.0
    flank = np.argmax(rail.angle > math.atan(upright) - 1e-9)
    half, depth = HEADS[name.removesuffix(" UIC 519")]
    assert 1e3 * rail.y[flank] == pytest.approx(half, abs=6e-3)
    if depth is not None:
        assert 1e3 * rail.z[flank] == pytest.approx(depth, abs=0.05 if name.endswith("519") else 6e-3)
    np.testing.assert_allclose(rail.y, -rail.y[::-1], atol=1e-15)
    np.testing.assert_allclose(rail.z, rail.z[::-1], atol=1e-15)


@pytest.mark.parametrize("name", profile.names())
def test_points_and_tangents_agree_but_at_the_standards_own_corners(name):
    shape = profile.named(name)
    chord = np.arctan2(np.diff(shape.z), np.diff(shape.y))
    bend = np.abs(chord - 0.5 * (shape.angle[1:] + shape.angle[:-1]))
    between = 0.5e3 * (shape.y[1:] + shape.y[:-1])
    for corner in CORNERS.get(name, ()):
        bend[np.abs(between - corner) < 0.75] = 0.0
    assert bend.max() < 2e-3  # joints where the curvature changes, and rounding to four printed digits
    assert np.hypot(np.diff(shape.y), np.diff(shape.z)).max() < (0.7e-3 if name == "EPS" else 1.001 * profile.SPACING)


@pytest.mark.parametrize(
    ("tall", "foot", "touch", "tip"),  # F1 and G1 of EN 13715, and the flange's height, mm
    [
        (28.0, (-39.765, 15.675), (-49.663, 26.748), 28.0),
        (30.0, (-40.530, 17.779), (-47.758, 27.568), 30.0),
        (32.0, (-41.497, 20.434), (-46.153, 28.108), 32.0),
    ],
)
def test_flange_of_every_height_has_the_tabulated_points(tall, foot, touch, tip):
    wheel = profile.s1002(flange_height=1e-3 * tall)
    for y, z in (foot, touch):
        assert height(wheel, np.array([y]))[0][0] == pytest.approx(z, abs=2e-3)  # the table has 1e-3, the face 70°
    assert 1e3 * wheel.z.max() == pytest.approx(tip, abs=1e-6)


@pytest.mark.parametrize("name", ["S1002", "1/40"])
def test_thinner_flange_moves_the_root_and_keeps_the_outer_tread(name):
    thick, thin = profile.named(name), profile.named(name, flange_thickness=0.0295)
    face = np.array([-41.0, -39.0, -35.0, -20.0, -5.0, -1.0])
    np.testing.assert_allclose(height(thin, face - 3.0)[0], height(thick, face)[0], atol=2e-5)
    outside = np.array([0.5, 10.0, 30.0])
    np.testing.assert_allclose(height(thin, outside)[0], height(thick, outside)[0], atol=1e-5)
    assert height(thin, np.array([-1.75]))[0][0] == pytest.approx(0.5 * height(thick, np.array([-0.5]))[0][0], abs=1e-6)


@pytest.mark.parametrize(
    ("name", "y", "z", "tolerance"),  # mm; the point D1a of 1/40 lies 2.6 µm beside the arc that ends there
    [
        ("S1002", [-34.5, -26.0, -0.5, 5.0, 32.0], [6.432, 2.741, 0.017, -0.132, -0.769], 1e-3),
        ("1/40", [-32.696, -15.640, -0.5, 35.0], [5.180, 0.391, 0.013, -0.875], 2.9e-3),
        ("EPS", [-35.0, -31.0, -26.0, -17.587, 19.0, 29.0], [6.867, 4.624, 2.790, 1.487, -0.547, -0.547], 1e-3),
    ],
)
def test_wheels_have_the_tabulated_points_of_en_13715(name, y, z, tolerance):
    np.testing.assert_allclose(height(profile.named(name), np.array(y))[0], z, atol=tolerance)


def test_rail_a_is_the_60e1_of_uic_519_inclined_1_to_20():
    drawn, turned = profile.named("rail A"), profile.named("60E1 UIC 519", inclination=0.05)
    (y0, z0), (y1, z1) = (1e3 * np.array(place_of_rail(shape, 1.435, 0.014)) for shape in (drawn, turned))
    y = np.linspace(-32.0, 39.0, 72)
    (z, slope), (other, _) = height(drawn, y), height(turned, y + y0 - y1)
    np.testing.assert_allclose((other + z1 - z - z0) / np.hypot(1.0, slope), 0.0, atol=2e-3)


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ("UIC60", "60E1"),
        ("uic 60", "60E1"),
        ("60 e1", "60E1"),
        ("S49", "49E1"),
        ("BS 113A", "56E1"),
        ("1:40", "1/40"),
        ("s1002", "S1002"),
        ("en15302-b", "EN 15302 B"),
        ("Wheel H", "EN 15302 H"),
        ("Rail A", "EN 15302 rail A"),
    ],
)
def test_old_names_and_other_spellings_are_accepted(given, name):
    assert profile.named(given).name == name


def test_names_are_those_of_both_kinds_and_all_can_touch():
    assert profile.names() == profile.names("wheel") + profile.names("rail")
    rail, wheel = profile.rail_60e1(), profile.s1002()
    for kind in ("wheel", "rail"):
        for name in profile.names(kind):
            shape = profile.named(name, kind=kind)
            assert shape.kind == kind
            pair = (shape, rail) if kind == "wheel" else (wheel, shape)
            assert -1e-3 < Pair(*pair, gauge_point=0.012).touch(Pose()) < 1e-3


def test_an_option_that_no_file_has_is_refused_for_a_standard_profile_too():
    assert profile.load("60E1", "rail", smoothing=1e-6).y.size == profile.rail_60e1().y.size
    with pytest.raises(TypeError, match="'smothing'"):
        profile.load("60E1", "rail", smothing=1e-6)
