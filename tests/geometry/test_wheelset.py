"""Contacts of a wheelset: symmetry, kinematics, separation, equilibrium, errors."""

import dataclasses
import math

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity, contacts

R0 = 0.460
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
CONE, ARC = profile.cone(0.05), profile.rail_arc(0.3)


@pytest.fixture(scope="module")
def right():
    return Pair(WHEEL, RAIL)


@pytest.fixture(scope="module")
def left():
    return Pair(WHEEL, RAIL, side="left")


#: Lateral position of the arc's crown. Its gauge is measured 1 mm below.
ORIGIN = 0.7175 + math.sqrt(0.3**2 - 0.299**2)


# -- symmetry ---------------------------------------------------------------------------------------------------------


def test_turning_the_wheelset_the_other_way_mirrors_the_patch_in_x(right):
    (a,) = right.contacts(Pose(y=3e-3, yaw=0.01), load=80e3)
    (b,) = right.contacts(Pose(y=3e-3, yaw=-0.01), load=80e3)
    assert b.position[0] == pytest.approx(-a.position[0], rel=1e-12)
    assert b.creepage.lateral == pytest.approx(-a.creepage.lateral, rel=1e-12)
    assert b.angle == pytest.approx(a.angle, rel=1e-12)
    np.testing.assert_allclose(b.separation.x_c, -a.separation.x_c, atol=1e-14)


def test_rolling_wheelset_and_rail_together_about_the_wheelset_turns_the_frame_alone():
    pair = Pair(CONE, ARC, gauge_point=1e-3)
    roll = 0.01
    (a,) = pair.contacts(Pose(z=0.1e-3))
    # the rail's origin turns about the wheelset's centre (0, -r0 + z) too
    y, z = ORIGIN, R0 - 0.1e-3
    c, s = math.cos(roll), math.sin(roll)
    moved = Irregularity(y=c * y - s * z - y, z=s * y + c * z - z, roll=roll)
    (b,) = pair.contacts(Pose(z=0.1e-3, roll=roll), irregularity=moved)
    # the depth is weighted vertically, so the reference point shifts by 4 µm
    assert b.angle - a.angle == pytest.approx(roll, abs=2e-5)
    assert b.rolling_radius == pytest.approx(a.rolling_radius, abs=5e-7)
    assert b.approach == pytest.approx(a.approach, rel=1e-6)


# -- a cone on an arc: everything in closed form -------------------------------------------------------------------------


def test_cone_on_arc_touches_where_their_tangents_agree():
    pair = Pair(CONE, ARC, gauge_point=1e-3)
    (patch,) = pair.contacts(Pose(y=1e-3), penetration=1e-7)
    angle = -math.atan(0.05)
    u = 0.3 * math.sin(angle)
    assert patch.angle == pytest.approx(angle, abs=1e-6)
    assert patch.position[1] == pytest.approx(ORIGIN + u, abs=1e-6)
    assert patch.on_rail == pytest.approx((u, 0.3 - 0.3 * math.cos(angle)), abs=1e-6)
    on_wheel = ORIGIN + u - 0.751
    assert patch.rolling_radius == pytest.approx(R0 - 0.05 * on_wheel, abs=1e-6)
    assert patch.position[0] == 0.0


def test_touch_is_where_the_penetration_begins():
    pair = Pair(CONE, ARC, gauge_point=1e-3)
    z = pair.touch(Pose(y=1e-3))
    assert pair.contacts(Pose(y=1e-3, z=z - 1e-9)) == ()
    (patch,) = pair.contacts(Pose(y=1e-3, z=z + 1e-6))
    assert patch.approach == pytest.approx(1e-6 * math.cos(patch.angle), rel=1e-4)
    # the cone's line z = -λ (y - 0.751) + z is R away from the arc's centre (ORIGIN, R)
    assert z == pytest.approx(0.3 - 0.3 / math.cos(math.atan(0.05)) + 0.05 * (ORIGIN - 0.751), abs=1e-9)


def test_separation_of_cone_and_arc_is_the_arc_along_and_the_ring_across():
    (patch,) = contacts(CONE, ARC, Pose(), load=50e3, gauge_point=1e-3)
    separation = patch.separation
    exact = 0.3 - np.sqrt(0.3**2 - separation.y**2)
    np.testing.assert_allclose(separation.g, exact, atol=1e-7)  # the reference point is 1 µm off the touching point
    assert separation.g.min() >= 0.0
    middle = np.argmin(np.abs(separation.y))
    assert separation.A[middle] == pytest.approx(math.cos(patch.angle) / (2 * patch.rolling_radius), rel=1e-5)
    np.testing.assert_allclose(separation.x_c, 0.0, atol=1e-15)


def test_load_and_approach_of_a_hertzian_pair():
    (patch,) = contacts(CONE, ARC, Pose(), load=50e3, gauge_point=1e-3)
    A, B = math.cos(patch.angle) / (2 * patch.rolling_radius), 1 / 0.6
    exact = contact.hertz(A, B, load=patch.load)
    assert patch.load * math.cos(patch.angle) == pytest.approx(50e3, rel=1e-8)
    assert patch.approach == pytest.approx(exact.approach, rel=2e-4)


# -- kinematics (theory.md 9.4) --------------------------------------------------------------------------------------------


def test_free_rolling_creepages_are_those_of_the_radius_and_the_angle(right, left):
    for pair, sign in ((right, 1.0), (left, -1.0)):
        for y in (-4e-3, 0.0, 3e-3):
            (patch,) = pair.contacts(Pose(y=y), load=80e3)
            assert patch.creepage.longitudinal == pytest.approx(-(patch.rolling_radius - R0) / R0, abs=1e-12)
            assert patch.creepage.lateral == pytest.approx(0.0, abs=1e-15)
            assert patch.creepage.spin == pytest.approx(math.sin(patch.angle) / R0, rel=1e-12)
            assert sign * patch.angle < 0.0  # negative on the right wheel's tread


@pytest.mark.parametrize("y", [0.0, 4e-3, 6e-3])
def test_lateral_creepage_under_yaw_is_yaw_over_the_cosine_at_the_true_contact_point(right, y):
    yaw = 0.01
    (patch,) = right.contacts(
        Pose(y=y, yaw=yaw), penetration=1e-7
    )  # rigid contact: both surfaces have the contact angle
    d, slope = 0.750 + patch.on_wheel[0], np.interp(patch.on_wheel[0], WHEEL.y, np.tan(WHEEL.angle))
    # the point leads or lags by x_c = l_x (d + r tan); evaluated at x = 0 the creepage would only have the cosine
    assert patch.position[0] == pytest.approx(-math.sin(yaw) * (d + patch.rolling_radius * slope), rel=1e-3)
    over_cosine = -math.sin(yaw) * math.hypot(1.0, slope)
    assert patch.creepage.lateral == pytest.approx(over_cosine * patch.rolling_radius / R0, rel=1e-4)


def test_each_velocity_enters_the_creepages_as_it_should(right):
    pose, V = Pose(y=1e-3), 25.0
    (base,) = right.contacts(pose, Velocity(V), load=80e3)

    def change(**velocity):
        (moved,) = right.contacts(pose, Velocity(V, **velocity), load=80e3)
        a, b = moved.creepage, base.creepage
        return a.longitudinal - b.longitudinal, a.lateral - b.lateral, a.spin - b.spin

    c, s = math.cos(base.angle), math.sin(base.angle)
    arm, lever = base.position[1] - pose.y, base.rolling_radius
    assert change(y=0.1) == pytest.approx((0.0, 0.1 * c / V, 0.0), abs=1e-9)
    assert change(z=0.1) == pytest.approx((0.0, 0.1 * s / V, 0.0), abs=1e-9)
    # yaw rate: the right wheel goes backwards when the wheelset turns to the right; spin about the normal
    assert change(yaw=0.1) == pytest.approx((-0.1 * arm / V, 0.0, 0.1 * c / V), rel=1e-4, abs=1e-9)
    # roll rate: the foot of the wheel swings to the left, the right wheel goes down
    assert change(roll=0.1) == pytest.approx((0.0, 0.1 * (-lever * c + arm * s) / V, 0.0), rel=1e-4, abs=1e-9)
    spin = -V / R0 * 1.001
    assert change(spin=spin) == pytest.approx((-1e-3 * lever / R0, 0.0, 1e-3 * s / R0), rel=1e-6, abs=1e-9)


def test_creepages_do_not_depend_on_the_speed_of_free_rolling(right):
    (slow,) = right.contacts(Pose(y=2e-3, yaw=1e-3), Velocity(1.0), load=80e3)
    (fast,) = right.contacts(Pose(y=2e-3, yaw=1e-3), Velocity(80.0), load=80e3)
    assert dataclasses.astuple(fast.creepage) == pytest.approx(dataclasses.astuple(slow.creepage), rel=1e-12)


# -- under a load ------------------------------------------------------------------------------------------------------------


def test_no_load_no_patch(right):
    assert right.contacts(Pose(), load=0.0) == ()
    assert right.contacts(Pose(z=-1e-3)) == ()


def test_penetration_counts_from_first_touch(right):
    z = right.touch(Pose(y=1e-3))
    (a,) = right.contacts(Pose(y=1e-3), penetration=5e-5)
    (b,) = right.contacts(Pose(y=1e-3, z=z + 5e-5))
    assert right.z == pytest.approx(z + 5e-5, abs=1e-15)
    assert a.approach == pytest.approx(b.approach, rel=1e-12)


# -- several patches, fixed grids ----------------------------------------------------------------------------------------------


def worn_pair(**options):
    """Return a pair whose flange root clears the gauge corner, so tread and flange touch far apart."""
    return Pair(WHEEL, profile.rail_60e1(1 / 20, breakpoints="UIC 519"), **options)


def test_tread_and_flange_touch_in_frames_of_their_own():
    pair = worn_pair()
    patches = pair.contacts(Pose(y=6.385e-3), load=80e3)
    assert len(patches) == 2
    tread, flange = patches
    assert tread.share == flange.share == 1.0
    assert abs(flange.angle) - abs(tread.angle) > math.radians(20.0)
    assert flange.position[1] < tread.position[1] - 8e-3
    assert sum(p.load * math.cos(p.angle) for p in patches) == pytest.approx(80e3, rel=1e-8)
    # neither separation contains the other patch: the gap stays open away from its own interpenetration
    for patch in patches:
        outside = (patch.separation.y < patch.edges[0] - 1e-4) | (patch.separation.y > patch.edges[1] + 1e-4)
        assert patch.separation.g[outside].min() > patch.approach
    assert len(worn_pair(combine_distance=1.0).contacts(Pose(y=6.385e-3), load=80e3)) == 1


@pytest.mark.parametrize("y", [-3e-3, 0.0, 5e-3, 6.5e-3])
def test_a_fixed_grid_shows_the_same_gap(right, y):
    grid = np.linspace(-10e-3, 10e-3, 41)
    fixed = Pair(WHEEL, RAIL, samples=grid)
    (a,) = Pair(WHEEL, RAIL, samples=801).contacts(Pose(y=y), penetration=8e-5)
    (b,) = fixed.contacts(Pose(y=y), penetration=8e-5)
    np.testing.assert_array_equal(b.separation.y, grid)
    inside = (grid > a.edges[0]) & (grid < a.edges[1])
    for name, tolerance in (("g", 1e-7), ("A", 1e-4)):
        expected = np.interp(grid[inside], a.separation.y, getattr(a.separation, name))
        np.testing.assert_allclose(getattr(b.separation, name)[inside], expected, atol=tolerance)
    assert np.isfinite(b.separation.g).all()
    assert b.approach == a.approach
    assert b.angle == a.angle


# -- bad input -----------------------------------------------------------------------------------------------------------------
