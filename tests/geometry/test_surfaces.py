"""Surfaces through slices: exact limits, interruptions, search against constant profiles, errors."""

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from contact.geometry import profile
from contact.geometry.surfaces import Flat, Polygon, RailSurface, SurfacePair, Wave, WheelSurface
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.spline import approximated, slopes
from contact.geometry.wheelset import Pose
from contact.kernels.geometry.section import AWAY

R0 = 0.460
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
CONE, ARC = profile.cone(0.0), profile.rail_arc(0.3)
#: With this origin the crown of a rail lies under the tape circle.
UNDER = {"rail_origin": (0.75, 0.0)}


def lifted(rate):
    """Return a rail that rises by `rate` along the track."""
    s = np.linspace(-0.1, 0.1, 9)
    return RailSurface(s, [np.stack((ARC.y, ARC.z - rate * at), axis=1) for at in s])


def rail_heights(rail, frame, x, y, *, origin=(0.75, 0.0), station=0.0):
    """Return the heights of a rail over a frame: its distance from a cylinder, plus the cylinder's height; NaN where absent.

    The cylinder has the radius R0 and touches the height z = 0. Its height along the normal follows from Pythagoras.
    """
    pair = SurfacePair(CONE, rail, rail_origin=origin)
    pair.place(Pose(), station=station)
    distance = pair.distance(frame, x, y)
    (x0, _, z0), (ahead, across, normal) = frame.origin, frame.axes
    at_x = x0 + x * ahead[0] + y[:, None] * across[0]
    at_z = z0 + x * ahead[2] + y[:, None] * across[2] + R0
    # (at_x + n normal_x)² + (at_z + n normal_z)² = R0²
    a, b, c = normal[0] ** 2 + normal[2] ** 2, at_x * normal[0] + at_z * normal[2], at_x**2 + at_z**2 - R0**2
    return np.where(distance < AWAY, distance + (np.sqrt(b**2 - a * c) - b) / a, np.nan)


# -- splines ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [2, 3, 4, 5, 40])
def test_slopes_are_those_of_the_not_a_knot_spline(n):
    u = np.sort(np.random.default_rng(n).uniform(0.0, 1.0, n)) + np.arange(n)
    f = np.random.default_rng(1).normal(size=(n, 2, 3))
    assert slopes(u, f) == pytest.approx(CubicSpline(u, f)(u, 1), abs=1e-12)


def test_slopes_of_functions_with_knots_of_their_own():
    u = np.cumsum(np.random.default_rng(2).uniform(0.5, 2.0, (9, 2)), axis=0)
    f = np.sin(u)
    both = slopes(u, f)
    for k in range(2):
        assert both[:, k] == pytest.approx(CubicSpline(u[:, k], f[:, k])(u[:, k], 1), abs=1e-13)


def test_slopes_of_a_closed_spline_are_periodic():
    u = np.array([0.0, 0.5, 1.7, 2.0, 3.1, 4.4, 5.9])
    f = np.cos(u)
    wanted = CubicSpline(np.append(u, 2.0 * math.pi), np.append(f, f[0]), bc_type="periodic")(u, 1)
    assert slopes(u, f, 2.0 * math.pi) == pytest.approx(wanted, abs=1e-13)


def test_control_points_at_equal_steps_are_weighted_1_4_1():
    f = np.random.default_rng(3).normal(size=12)
    wanted = np.concatenate((f[:1], (f[:-2] + 4.0 * f[1:-1] + f[2:]) / 6.0, f[-1:]))
    assert approximated(np.arange(12.0), f) == pytest.approx(wanted, abs=1e-14)
    u = np.arange(12.0) / 12.0
    assert approximated(u, f, 1.0) == pytest.approx((np.roll(f, 1) + 4.0 * f + np.roll(f, -1)) / 6.0, abs=1e-14)


# -- surfaces ---------------------------------------------------------------------------------------------------------


def test_a_cubic_along_the_track_is_reproduced():
    """A tensor product of not-a-knot splines is exact for it, between slices too."""
    u, y = np.array([-0.4, -0.3, -0.15, 0.3, 0.5]), np.linspace(-0.03, 0.03, 61)
    rail = RailSurface(u, [np.stack((y, 0.2 * y**2 + 0.1 * s - 0.3 * s**3), axis=1) for s in u])
    x, across = np.random.default_rng(4).uniform(-0.05, 0.05, 9), np.random.default_rng(5).uniform(-0.02, 0.02, 11)
    x, across = np.sort(x), np.sort(across)
    for station in (-0.3, -0.1, 0.1, 0.4):
        frame = Frame.turned(np.array([0.0, 0.75, 0.0]), 0.0)
        s = station + x
        found = rail_heights(rail, frame, x, across, station=station)
        assert found == pytest.approx(0.2 * across[:, None] ** 2 + 0.1 * s - 0.3 * s**3, abs=1e-9)


def test_a_surface_is_constant_beyond_its_slices():
    rail = lifted(0.1)
    for end, beyond in ((-0.1, -0.5), (0.1, 3.0)):
        assert rail.curves(np.array([beyond])) == pytest.approx(rail.curves(np.array([end])), abs=1e-15)
    x, frame = np.linspace(-0.02, 0.02, 9), Frame.turned(np.array([0.0, 0.75, 0.0]), 0.0)
    beyond = rail_heights(rail, frame, x, np.array([-1e-3, 0.0]), station=0.5)
    assert beyond == pytest.approx(np.broadcast_to(beyond[:, :1], beyond.shape), abs=1e-12)


def test_a_part_begins_at_the_first_slice_that_has_it_and_the_rest_is_there_before():
    y = np.linspace(-0.04, 0.04, 81)
    whole, half = np.stack((y, 5.0 * y**2), axis=1), np.stack((y, 5.0 * y**2), axis=1)[40:]
    length = np.hypot(*np.diff(whole, axis=0).T).sum()
    features = [[np.nan, 0.0, length]] * 3 + [[0.0, length / 2.0, length]] * 3
    rail = RailSurface(np.arange(6.0), [half] * 3 + [whole] * 3, features=features)
    before, at, after = (np.isfinite(rail.curves(np.array([s]))[0, 0]) for s in (2.999999, 3.0, 4.5))
    assert at.all()
    assert after.all()
    assert not before.all()
    assert before[-1]
    frame, across = Frame.turned(np.array([0.0, 0.75, 0.0]), 0.0), np.array([-0.02, 0.02])
    z = rail_heights(rail, frame, np.array([-0.1, -0.01, 0.0, 0.01]), across, station=3.0)
    assert np.isnan(z[0]).tolist() == [True, True, False, False]
    assert z[1] == pytest.approx(5.0 * 0.02**2, abs=1e-8)


def test_a_corner_at_a_feature_is_kept():
    y = np.linspace(-0.03, 0.03, 121)
    roof = np.stack((y, 0.2 * np.abs(y)), axis=1)
    half = np.hypot(0.03, 0.2 * 0.03)
    sharp = RailSurface([0.0, 1.0], [roof, roof], features=[[0.0, half, 2.0 * half]] * 2, corners=[1])
    frame, at = Frame.turned(np.array([0.0, 0.75, 0.0]), 0.0), np.array([-1e-4, 0.0, 1e-4])
    found = rail_heights(sharp, frame, np.zeros(1), at, station=0.5)
    assert found[:, 0] == pytest.approx(0.2 * np.abs(at), abs=1e-12)


def test_heights_of_a_ramp_are_exact_in_a_turned_and_in_a_tilted_frame():
    y = np.linspace(-0.03, 0.03, 61)
    plane = RailSurface([-0.1, 0.0, 0.1], [np.stack((y, 0.3 * y - 0.1 * s), axis=1) for s in (-0.1, 0.0, 0.1)])
    origin, angle = np.array([0.0, 0.75, 0.1 - 0.1 * 0.02]), math.atan(0.3)
    x, across = np.linspace(-0.01, 0.01, 5), np.linspace(-0.01, 0.01, 7)
    options = {"origin": (0.75, 0.1), "station": 0.02}
    along = Frame.turned(origin, angle, math.atan(0.1 * math.cos(angle)))
    assert along.axes[2] == pytest.approx(np.array([0.1, -0.3, 1.0]) / math.sqrt(1.1), abs=1e-15)
    assert rail_heights(plane, along, x, across, **options) == pytest.approx(0.0, abs=1e-11)
    turned = rail_heights(plane, Frame.turned(origin, angle), x, across, **options)
    assert turned == pytest.approx(np.broadcast_to(-0.1 * x * math.cos(angle), turned.shape), abs=1e-12)


@pytest.mark.parametrize(("angle", "pitch"), [(0.0, 0.0), (-0.3, 0.0), (1.0, 0.0), (0.2, 0.1)])
def test_the_height_of_a_cone_under_yaw_and_roll_is_exact(angle, pitch):
    """A cone is a quadric, so its height over a plane is the root of a quadratic equation."""
    conicity, yaw, roll = 0.2, 0.03, -0.02
    pair = SurfacePair(profile.cone(conicity), RailSurface.constant(profile.rail_arc(0.3)), **UNDER)
    pose = Pose(y=2e-3, z=1e-3, roll=roll, yaw=yaw)
    pair.place(pose, rotation=0.4)
    axle = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
    centre = np.array([0.0, pose.y, pose.z - R0])
    frame = Frame.turned(np.array([1e-3, 0.751, 2e-4]), angle, pitch)
    x, y = np.linspace(-8e-3, 8e-3, 7), np.linspace(-5e-3, 5e-3, 5)
    # rail: a circular cylinder along x about (0.75, 0.3)
    points = frame.origin[:, None, None] + frame.axes[0][:, None, None] * x + frame.axes[1][:, None, None] * y[:, None]
    n, p = frame.axes[2], points - np.array([0.0, 0.75, 0.3])[:, None, None]
    a, b, c = n[1] ** 2 + n[2] ** 2, n[1] * p[1] + n[2] * p[2], p[1] ** 2 + p[2] ** 2 - 0.3**2
    rail = (-b - np.sqrt(b**2 - a * c)) / a
    # wheel: |q|² - d² = (R0 - conicity (d - tape))², where d is the place along the axle
    q = points - centre[:, None, None]
    d, rate = np.tensordot(axle, q, 1), float(axle @ n)
    r = R0 - conicity * (d - pair.tape)
    a = 1.0 - rate**2 - (conicity * rate) ** 2
    b = np.tensordot(n, q, 1) - d * rate + r * conicity * rate
    c = (q**2).sum(axis=0) - d**2 - r**2
    wheel = (-b + np.sqrt(b**2 - a * c)) / a
    assert pair.distance(frame, x, y) == pytest.approx(rail - wheel, abs=1e-9)


# -- deviations -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "deviation", [Polygon(12, 2e-4, 0.3), Wave(0.05, 1e-4, 0.01), Flat(0.06), Flat(0.05, shape="chord", angle=3.0)]
)
def test_the_slope_of_a_deviation_is_its_derivative(deviation):
    u = np.linspace(-4.0, 4.0, 1001) + 1e-4
    step = 1e-7
    difference = (deviation.at(u + step)[0] - deviation.at(u - step)[0]) / (2.0 * step)
    assert deviation.at(u)[1] == pytest.approx(difference, abs=1e-5)


def test_a_chord_has_its_length_and_is_plane():
    flat = Flat(0.05, shape="chord")
    half = math.asin(0.025 / R0)
    theta = np.linspace(-0.999 * half, 0.999 * half, 11)
    r = R0 + flat.at(theta)[0]
    assert r * np.cos(theta) == pytest.approx(R0 * math.cos(half), abs=1e-15)
    assert flat.depth == pytest.approx(R0 - R0 * math.cos(half), rel=1e-2)


# -- search -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [0.1, -0.1, 0.02])
def test_on_a_ramp_the_wheel_touches_ahead_or_behind_the_axle(rate):
    pair = SurfacePair(CONE, lifted(rate), **UNDER)
    stretched = math.hypot(1.0, rate)
    z = pair.touch(Pose(), station=0.01)
    assert z == pytest.approx(R0 - R0 * stretched - rate * 0.01, abs=2e-8)
    (patch,) = pair.contacts(Pose(z=z + 5e-5), station=0.01)
    assert patch.position[0] == pytest.approx(R0 * rate / stretched, abs=1e-5)
    tilted = SurfacePair(CONE, lifted(rate), tilted=True, **UNDER)
    (patch,) = tilted.contacts(Pose(z=z + 5e-5), station=0.01)
    assert patch.frame.axes[2] == pytest.approx(np.array([rate, 0.0, 1.0]) / stretched, abs=1e-4)
    assert patch.approach == pytest.approx(5e-5 / stretched, rel=2e-3)
    # the reference point lies on the rail, the wheel's deeper along the normal
    assert patch.position[2] == pytest.approx(-rate * (0.01 + patch.position[0]), abs=1e-7)
    deeper = np.array(patch.wheel_position) - patch.position
    assert deeper == pytest.approx(patch.approach * patch.frame.axes[2], abs=0.05 * patch.approach)


def test_a_steep_ramp_is_touched_beyond_the_first_reach():
    pair = SurfacePair(CONE, lifted(0.3), **UNDER)
    assert pair.touch(Pose(), station=-0.1) == pytest.approx(R0 - R0 * math.hypot(1.0, 0.3) + 0.03, abs=2e-7)


@pytest.mark.parametrize("turned", [0.0, 0.3, 0.7, -0.7])
def test_a_cylinder_with_a_chord_falls_and_turns_about_its_end(turned):
    """The wheel stands on the sharp end of its flat, at the distance R0 from the axle."""
    flat = Flat(0.05, shape="chord", angle=1.0)
    half = math.asin(0.025 / R0)
    pair = SurfacePair(WheelSurface.constant(CONE, flat), ARC, **UNDER)
    z = pair.touch(Pose(), rotation=-1.0 + turned * half)
    assert z == pytest.approx(R0 - R0 * math.cos(half * (1.0 - abs(turned))), abs=1e-7)


@pytest.mark.parametrize("depth", [1e-6, 3e-6, 1e-5, 5e-5])
@pytest.mark.parametrize("turned", [0.1, 0.37, 0.8])
def test_the_narrow_overlap_at_the_end_of_a_chord_is_found(depth, turned):
    """It may lie between the points of the first grids. The rail is flat across, so both bodies are known in closed form.

    Before and behind the end the wheel rises as a circle and as the plane of the flat.
    """
    half = math.asin(0.015 / R0)
    wheel = WheelSurface.constant(CONE, Flat(0.03, shape="chord"))
    pair = SurfacePair(wheel, ARC, **UNDER)
    (patch,) = pair.contacts(Pose(), rotation=turned * half, penetration=depth)
    x = np.linspace(-1.0, 1.0, 200001) * 8.0 * math.sqrt(depth) - R0 * math.sin(half * (1.0 - turned))
    plane = (R0 * math.cos(half) - x * math.sin(turned * half)) / math.cos(turned * half)
    rim = np.minimum(np.sqrt(R0**2 - x**2), plane)
    over = np.maximum(rim - rim.max() + depth, 0.0)
    volume = float((4.0 / 3.0 * over * np.sqrt(2.0 * 0.3 * over)).sum() * (x[1] - x[0]))  # parabolas across
    gap = patch.gap
    found = float(np.maximum(patch.approach - gap.h, 0.0).sum()) * gap.dx * gap.dy
    middle = float((x * over**2.5).sum() / (over**2.5).sum())  # weights are depth²
    assert patch.approach == pytest.approx(depth, abs=0.02 * depth + 1e-7)
    assert found == pytest.approx(volume, rel=0.03, abs=0.25 * volume * 1e-6 / depth)
    assert patch.position[0] == pytest.approx(middle, abs=0.1 * np.ptp(x[over > 0.0]) + 1e-4)


def test_a_polygon_touches_where_the_rigid_wheel_is_lowest():
    polygon = Polygon(12, 2e-4)
    pair = SurfacePair(WheelSurface.constant(CONE, polygon), ARC, **UNDER)
    theta = np.linspace(-0.2, 0.2, 400001)
    for rotation in (0.0, 0.05, -0.13):
        lowest = ((R0 + polygon.at(theta - rotation)[0]) * np.cos(theta)).max()
        assert pair.touch(Pose(), rotation=rotation) == pytest.approx(R0 - lowest, abs=1e-8)


def test_slices_of_a_polygon_are_the_analytic_polygon():
    polygon, theta = Polygon(12, 2e-4), np.linspace(-0.4, 0.4, 97)
    y = np.linspace(-0.06, 0.06, 61)
    measured = WheelSurface.from_deviations(theta, y, polygon.at(theta)[0][:, None] + 0.0 * y)
    a, b = (SurfacePair(wheel, ARC, **UNDER) for wheel in (measured, WheelSurface.constant(CONE, polygon)))
    for rotation in (0.0, 0.07):
        assert a.touch(Pose(), rotation=rotation) == pytest.approx(b.touch(Pose(), rotation=rotation), abs=1e-9)


def test_a_closed_wheel_continues_from_its_last_slice_to_the_first():
    theta = np.linspace(-math.pi, math.pi, 73)[:-1]
    y = np.linspace(-0.06, 0.06, 61)
    closed = WheelSurface.from_deviations(theta, y, 1e-4 * np.sin(3.0 * theta)[:, None] + 0.0 * y)
    assert closed.sheet.period is not None
    u = np.linspace(0.9 * math.pi, 1.1 * math.pi, 11)
    assert closed.curves(u)[1, :, 40] == pytest.approx(1e-4 * np.sin(3.0 * u), abs=1e-8)
    opened = WheelSurface.from_deviations(theta[:30], y, np.zeros((30, 61)))
    assert opened.sheet.period is None


# -- errors -----------------------------------------------------------------------------------------------------------


def test_a_wheel_above_the_rail_has_no_patch():
    assert SurfacePair(CONE, ARC, **UNDER).contacts(Pose(z=-1e-5)) == ()
