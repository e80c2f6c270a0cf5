"""A wheel displaced against its wheelset: rigid motions, pitch, mirror image, power, errors."""

import math

import numpy as np
import pytest

from contact import ContactError
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import ElasticRail, WheelRailPair

V = 20.0
VELOCITY = Velocity(V, 0.02, 0.01, 0.003, 0.01, -V / 0.46 * 1.001)


@pytest.fixture(scope="module")
def pairs():
    wheel, rail = profile.s1002(), profile.rail_60e1()
    return {side: WheelRailPair(Pair(wheel, rail, side=side)) for side in ("right", "left")}


def same(one, other):
    np.testing.assert_allclose(one.force, other.force, atol=2e-4 * one.Q)
    np.testing.assert_allclose(one.moment, other.moment, atol=2e-4 * one.Q)
    assert one.z == pytest.approx(other.z, abs=1e-9)


def test_no_offset_changes_nothing(pairs):
    one, other = (pairs["right"].solve(Pose(y=3e-3), VELOCITY, load=7e4, offset=o) for o in (WheelOffset(), None))
    same(one, other)


def test_a_displaced_wheel_is_a_displaced_wheelset(pairs):
    offset = WheelOffset(y=2e-3, z=-1e-3, y_rate=0.03, z_rate=-0.02)
    found = pairs["right"].solve(Pose(y=1e-3), VELOCITY, load=7e4, offset=offset)
    moved = Velocity(V, 0.05, -0.01, 0.003, 0.01, VELOCITY.spin)
    rigid = pairs["right"].solve(Pose(y=3e-3), moved, load=7e4)
    np.testing.assert_allclose(found.force, rigid.force, atol=2e-4 * 7e4)
    # the wheel is 1 mm higher on its axle, so the axle is 1 mm lower
    assert found.z == pytest.approx(rigid.z + 1e-3, abs=1e-9)
    arm = np.array([0.0, 2e-3, -1e-3])
    np.testing.assert_allclose(found.moment, rigid.moment + np.cross(arm, rigid.force), atol=20.0)


def test_a_turned_wheelset_is_one_whose_wheels_are_displaced_and_turned(pairs):
    """The wheels of a yawed and rolled wheelset, described from the straight one."""
    roll, yaw = 2e-3, 4e-3
    for side, pair in pairs.items():
        tape = (1 if side == "right" else -1) * float(pair.pair.space.motion[0].tape)
        axis = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
        d = tape * (axis - (0.0, 1.0, 0.0))
        rate = tape * np.array([-0.01, 0.0, 0.003])  # of the straight wheelset
        rate -= tape * np.array(
            [
                math.sin(yaw) * math.sin(roll) * 0.003 - math.cos(yaw) * math.cos(roll) * 0.01,
                -math.cos(yaw) * math.sin(roll) * 0.003 - math.sin(yaw) * math.cos(roll) * 0.01,
                math.cos(roll) * 0.003,
            ]
        )
        offset = WheelOffset(*d, roll, 0.0, yaw, *(-rate))
        found = pair.solve(Pose(y=1e-3), VELOCITY, load=7e4, offset=offset)
        same(found, pair.solve(Pose(y=1e-3, roll=roll, yaw=yaw), VELOCITY, load=7e4))


def test_a_rate_of_pitch_is_spin_and_pitch_does_nothing(pairs):
    found = pairs["right"].solve(Pose(), VELOCITY, load=7e4, offset=WheelOffset(pitch=0.05, pitch_rate=-0.04))
    faster = Velocity(V, 0.02, 0.01, 0.003, 0.01, VELOCITY.spin - 0.04)
    same(found, pairs["right"].solve(Pose(), faster, load=7e4))


def test_a_wheel_turned_too_far_with_its_wheelset_is_refused(pairs):
    with pytest.raises(ContactError, match=r"offset.yaw = 0.06: with the wheelset's roll and yaw the wheel is turned"):
        pairs["right"].solve(Pose(yaw=0.05), VELOCITY, load=7e4, offset=WheelOffset(yaw=0.06))


def test_a_rail_on_springs_under_a_flexible_wheel(pairs):
    """Both together: the deflection is that of the displaced wheelset."""
    rail, offset = ElasticRail(8e6, 5e7), WheelOffset(y=2e-3, y_rate=0.03)
    pairs["right"].forget()
    found = pairs["right"].solve(Pose(y=4e-3), Velocity(V), vertical=7e4, rail=rail, offset=offset)
    pairs["right"].forget()
    rigid = pairs["right"].solve(Pose(y=6e-3), Velocity(V, 0.03), vertical=7e4, rail=rail)
    assert found.deflection == rigid.deflection
    np.testing.assert_array_equal(found.force, rigid.force)
