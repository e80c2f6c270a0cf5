"""A wheel on a roller: CONTACT's creepages and forces, the limit of a large roller, mirror, load, errors."""

import math

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import RollerRig
from tests.command_line import call

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
PAIR = Pair(WHEEL, RAIL)
#: Set N, CONTACT 25.1: roller radius [m], y [m], yaw, wheel [rad/s]; creepages of the rail, force on the roller [N].
RIGS = [
    (0.6, -3e-3, 0.0, -21.73913, (-0.000404706, 0.0, 0.049002), (3247.3, 134.3)),
    (0.6, 4e-3, 4e-3, -21.728261, (0.00306619, 0.0040303, 0.411621), (-9720.8, -8178.0)),
    (0.35, 3e-3, 0.0, -21.782609, (0.00567361, 0.0, 0.456983), (-17381.9, 2923.5)),
]


@pytest.mark.parametrize(("radius", "y", "yaw", "spin", "creepages", "force"), RIGS)
def test_creepages_and_forces_are_contacts(radius, y, yaw, spin, creepages, force):
    """The force within 1.5 % of the load, because 60E1 is not CONTACT's profile point by point.

    `benchmarks/contact_features.py` compares with CONTACT's own profiles.
    """
    s = RollerRig(PAIR, radius).solve(Pose(y=y, yaw=yaw), Velocity(10.0, spin=spin), vertical=6e4)
    assert s.status is contact.Status.OK
    c = s.contacts[0].creepage
    assert (c.longitudinal, c.lateral) == pytest.approx([-v for v in creepages[:2]], abs=2.5e-4)
    assert c.spin == pytest.approx(-creepages[2], abs=0.02)
    assert -s.force == pytest.approx([*force, 6e4], abs=0.015 * 6e4)


def test_a_large_roller_is_a_rail():
    """Curvature and creepages go over into those of the track."""
    pose, velocity = Pose(y=2e-3, yaw=1e-3), Velocity(10.0, spin=-10.0 / 0.46 * 1.001)
    rig = RollerRig(PAIR, 10.0).contacts(pose, velocity, penetration=6e-5)
    flat = PAIR.contacts(pose, velocity, penetration=6e-5)
    for one, other in zip(rig, flat, strict=True):
        cosine = math.cos(one.angle)
        np.testing.assert_allclose(one.separation.A - other.separation.A, cosine / 20.0, rtol=1e-3)
        a, b = one.creepage, other.creepage
        assert (a.longitudinal, a.lateral) == pytest.approx((b.longitudinal, b.lateral), abs=1e-4)
        assert a.spin - b.spin == pytest.approx(math.sin(one.angle) / 10.0, rel=0.05)


def test_a_smaller_roller_has_a_shorter_patch_and_more_pressure():
    pose, velocity = Pose(y=-3e-3), Velocity(10.0, spin=-10.0 / 0.46)
    large, small = (RollerRig(PAIR, r).solve(pose, velocity, vertical=6e4).contacts[0].solution for r in (2.0, 0.35))
    assert small.length < 0.9 * large.length
    assert small.max_pressure > 1.1 * large.max_pressure


def test_cylinders_have_their_closed_creepage():
    """xi = (V_r - V_w)/V of the wheel, with the speeds of both surfaces, for a cylinder on a rounded roller."""
    pair = Pair(profile.cone(0.0), profile.rail_arc(0.3), gauge_point=1e-3, nominal_radius=0.46)
    patch = RollerRig(pair, 0.5).contacts(Pose(), Velocity(20.0, spin=-43.0), penetration=2e-5)[0]
    local, rolling = 20.0 / 0.5 * (0.5 - patch.position[2]), 43.0 * patch.rolling_radius
    assert patch.creepage.longitudinal == pytest.approx((local - rolling) / (0.5 * (local + rolling)), rel=1e-9)


def test_the_left_side_is_the_mirror_image():
    left = Pair(profile.s1002(), profile.rail_60e1(), side="left")
    velocity = Velocity(10.0, spin=-21.75)
    one = RollerRig(PAIR, 0.6).solve(Pose(y=3e-3, yaw=2e-3), velocity, vertical=6e4)
    other = RollerRig(left, 0.6).solve(Pose(y=-3e-3, yaw=-2e-3), velocity, vertical=6e4)
    np.testing.assert_allclose(other.force, one.force * [1.0, -1.0, 1.0], atol=1.0)


def test_an_offset_lowers_the_wheel_and_inclines_the_line_of_the_axles():
    pose, velocity = Pose(y=-3e-3), Velocity(10.0, spin=-21.75)
    straight, ahead = (RollerRig(PAIR, 0.6, offset=x).solve(pose, velocity, vertical=6e4) for x in (0.0, 5e-3))
    np.testing.assert_allclose(ahead.force, straight.force, atol=2e-3 * 6e4)
    assert RollerRig(PAIR, 0.6, offset=5e-3).inclination == pytest.approx(5e-3 / 1.06)
    pose = Pose(y=-3e-3, z=PAIR.touch(pose) + 5e-5)
    at_height, without = (RollerRig(PAIR, 0.6, offset=x).contacts(pose, velocity)[0].approach for x in (5e-3, 0.0))
    assert without - at_height == pytest.approx(0.5 * 25e-6 / 1.06, rel=0.02)


def test_the_command_line():
    words = ("roller", 0.6, "--y", -3e-3, "--load", 6e4, "--spin", -21.73913, "--speed", 10)
    assert "peak pressure" in call(*words).stdout
    assert "radius = 0 is outside" in call("roller", 0.0, code=2).stderr


@pytest.mark.parametrize(("y", "yaw"), [(3e-3, 5e-3), (3e-3, -2e-2), (7.5e-3, 1e-2)])
def test_under_yaw_the_approach_is_the_depth_of_the_two_bodies_of_revolution(y, yaw):
    pose, radius = Pose(y=y, yaw=yaw), 0.35
    pose = Pose(y=y, yaw=yaw, z=PAIR.touch(pose) + 1.5e-4)
    patches = RollerRig(PAIR, radius).contacts(pose, Velocity(10.0))
    motion, z = PAIR.space.motion[0], pose.z
    across = np.linspace(-0.012, 0.012, 1201) + patches[0].on_wheel[0]
    turned = np.linspace(-0.06, 0.06, 1201)[:, None]
    r = PAIR.nominal_radius + np.interp(across, WHEEL.y, WHEEL.z)
    t = motion.tape + across
    forward = -math.sin(yaw) * t + math.cos(yaw) * r * np.sin(turned)
    side = y + math.cos(yaw) * t + math.sin(yaw) * r * np.sin(turned)
    down = z - PAIR.nominal_radius + r * np.cos(turned)
    top = radius - motion.origin_z - np.interp(side - motion.origin_y, RAIL.y, RAIL.z)
    depth = down - radius + np.sqrt(top**2 - forward**2)
    found = max((p.approach - p.separation.g.min()) / math.cos(p.angle) for p in patches)
    assert found == pytest.approx(np.nanmax(depth), rel=0.02)
