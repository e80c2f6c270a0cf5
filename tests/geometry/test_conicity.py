"""Rigid contact points and equivalent conicity: cones in closed form, and the tables of both editions of EN 15302."""

import math
from functools import cache

import numpy as np
import pytest

import reference
from contact import ContactError
from contact.geometry import conicity, contact_points, equivalent_conicity, nonlinearity, profile, steering
from contact.geometry.wheelset import Pair, Pose

CONE, ARC = profile.cone(0.05), profile.rail_arc(0.3)
ON_ARC = {"gauge": 1.5, "gauge_point": 1e-3}
GAUGE = 1.4351645  # places the origin of rail A 750 mm from the centre of the track, as the standard does


def tabulated(edition):
    return [row for row in reference.conicities() if row["edition"] == edition]


@cache
def computed(right, left, left_radius, step):
    wheel, other = (profile.named(f"wheel {letter}") for letter in (right, left))
    return conicity(
        wheel, profile.named("rail A"), step=step, left_wheel=other, left_radius=float(left_radius), gauge=GAUGE
    )


def columns(row):
    """Return the indices of the amplitudes in the table, and its values there."""
    given = [k for k in range(7) if row[str(k + 1)]]
    return given, np.array([float(row[str(k + 1)]) for k in given])


def of(row, step=2e-5):
    return computed(row["right"], row["left"], row["left_radius"], step)


@pytest.mark.slow
@pytest.mark.parametrize("edition", ["2021", "2008"])
def test_reference_wheels_lie_within_the_tolerances_of_the_standard(edition):
    for row in tabulated(edition):
        given, wanted = columns(row)
        tolerance = np.maximum(np.minimum(0.05, 0.5 * wanted), 5e-4)  # zero is printed with three decimals
        np.testing.assert_array_less(np.abs(of(row).conicity[given] - wanted), tolerance, err_msg=str(row))


def test_conicity_of_the_edition_of_2008_comes_out_with_its_own_step():
    for row in tabulated("2008"):
        given, wanted = columns(row)
        np.testing.assert_allclose(of(row, 1e-4).conicity[given], wanted, rtol=0, atol=2.5e-3, err_msg=str(row))


@pytest.mark.parametrize(("edition", "tolerance"), [("2021", 2e-3), ("2008", 13e-3)])
def test_rolling_radius_differences_are_those_of_the_tables(edition, tolerance):
    # [mm]; the formulas of the wheels are from 2021, and the tables of 2008 differ by up to 0.012 mm
    for row in tabulated(edition):
        if row["dr3"]:
            points = of(row).points
            dr = 1e3 * np.interp(3e-3, points.y, points.radius_difference)
            assert dr == pytest.approx(float(row["dr3"]), abs=tolerance), row


def test_exchanged_wheels_have_the_same_conicity_about_the_opposite_centre():
    rail, a, b = (profile.named(name) for name in ("rail A", "wheel A", "wheel B"))
    one = conicity(a, rail, [2e-3, 5e-3], step=1e-4, left_wheel=b, gauge=GAUGE)
    other = conicity(b, rail, [2e-3, 5e-3], step=1e-4, left_wheel=a, gauge=GAUGE)
    np.testing.assert_allclose(other.conicity, one.conicity, rtol=1e-9)
    np.testing.assert_allclose(other.centre, -one.centre, atol=1e-10)
    np.testing.assert_array_equal(other.points.radius_difference, -one.points.radius_difference[::-1])
    np.testing.assert_array_equal(other.points.right.angle, one.points.left.angle[::-1])


def test_cones_have_their_conicity_at_every_amplitude_and_klingels_wavelength():
    found = conicity(CONE, ARC, **ON_ARC)
    np.testing.assert_allclose(found.conicity, 0.05, rtol=1e-5)
    np.testing.assert_allclose(found.wavelength(1.5, 0.46), 2 * math.pi * math.sqrt(0.75 * 0.46 / 0.05), rtol=1e-5)


def test_cones_of_unequal_radii_run_beside_the_centre():
    found = conicity(CONE, ARC, [1e-3, 3e-3], left_radius=0.4598, **ON_ARC)
    np.testing.assert_allclose(found.conicity, 0.05, rtol=1e-5)
    np.testing.assert_allclose(found.centre, -0.2e-3 / (2 * 0.05), rtol=1e-6)


def test_cones_the_wrong_way_round_have_negative_conicity_and_no_wavelength():
    y = np.linspace(-0.06, 0.06, 41)
    found = conicity(profile.Profile("wheel", y, 0.03 * y), ARC, [2e-3], **ON_ARC)
    np.testing.assert_allclose(found.conicity, -0.03, rtol=1e-5)
    assert np.isinf(found.wavelength()).all()


def test_cone_touches_an_arc_where_their_tangents_agree():
    y = np.array([-4e-3, 0.0, 3e-3])
    found = contact_points(CONE, ARC, y, **ON_ARC)
    for side, sign in ((found.right, 1.0), (found.left, -1.0)):
        np.testing.assert_allclose(side.angle, math.atan(0.05), rtol=1e-6)
        np.testing.assert_allclose(side.on_rail, -0.3 * math.sin(math.atan(0.05)), rtol=1e-5)
        np.testing.assert_allclose(np.diff(side.on_wheel), -sign * np.diff(y), atol=1e-9)
        np.testing.assert_allclose(side.radius, 0.46 - 0.05 * side.on_wheel, atol=1e-12)
    np.testing.assert_allclose(found.radius_difference, 2 * 0.05 * y, atol=1e-9)
    np.testing.assert_allclose(found.angle_difference, 0.0, atol=1e-9)


def test_rolling_wheelset_touches_with_both_wheels_at_one_height():
    wheel, rail = profile.s1002(), profile.rail_60e1()
    found = contact_points(wheel, rail, [-5e-3, 0.0, 2e-3, 6.5e-3], roll=True)
    pairs = [Pair(wheel, rail, side=side) for side in ("right", "left")]
    for y, roll in zip(found.y, found.roll, strict=True):
        heights = [pair.touch(Pose(y=y, roll=roll)) for pair in pairs]
        assert heights[0] == pytest.approx(heights[1], abs=1e-11)
    assert found.roll[1] == pytest.approx(0.0, abs=1e-13)
    assert found.roll[3] < 0.0, "a wheel that climbs at its flange lifts its side"


def test_known_points_must_lie_at_equal_steps_and_far_enough():
    points = contact_points(CONE, ARC, [-3e-3, 0.0, 1e-3], **ON_ARC)
    with pytest.raises(ContactError, match="equal steps"):
        equivalent_conicity(points, 1e-3)
    points = contact_points(CONE, ARC, np.linspace(-3e-3, 3e-3, 7), **ON_ARC)
    assert equivalent_conicity(points, 2e-3).conicity == pytest.approx(0.05, rel=1e-5)
    with pytest.raises(ContactError, match=r"amplitudes = 0\.003 reach beyond the points"):
        equivalent_conicity(points, 3e-3)


def test_a_cone_steers_by_its_slope_and_has_no_nonlinearity():
    """Δr = 2 γ y of a cone on rails whose crowns stay under it; without a flange all displacements count."""
    slope = 0.05
    points = contact_points(profile.cone(slope), profile.rail_60e1(), np.linspace(-9e-3, 9e-3, 181))
    found = steering(points, [500.0, 1000.0])
    assert found.at == pytest.approx(9e-3)
    assert found.available == pytest.approx(2.0 * slope * 9e-3, rel=1e-3)
    np.testing.assert_allclose(found.needed, 1.5 * 0.46 / found.curve_radius, rtol=1e-12)
    assert found.smallest_radius == pytest.approx(1.5 * 0.46 / found.available)
    np.testing.assert_allclose(found.index, found.smallest_radius / found.curve_radius, rtol=1e-12)
    assert nonlinearity(points) == pytest.approx(0.0, abs=0.02)


def test_a_flange_ends_the_steering():
    points = contact_points(profile.s1002(), profile.rail_60e1(), np.linspace(-8e-3, 8e-3, 321))
    gentle, steep = (steering(points, 300.0, flange=np.radians(angle)) for angle in (10.0, 60.0))
    assert gentle.at < steep.at < 8e-3
    assert gentle.available < steep.available
    assert points.right.angle[points.y <= gentle.at].max() <= np.radians(10.0)
    with pytest.raises(ContactError, match="curve_radius = 1 is outside"):
        steering(points, 1.0)
    with pytest.raises(ContactError, match="steeper at all displacements"):
        steering(points, 300.0, flange=1e-3)
