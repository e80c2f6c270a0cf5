"""A rail that gives way: balance, limits, CONTACT's deflections, start and jump, damping, errors."""

import math

import numpy as np
import pytest

from contact import Status
from contact.geometry import profile
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import ElasticRail, WheelRailPair

VELOCITY = Velocity(2.0, spin=-2.0 / 0.46 * 1.0003)


@pytest.fixture
def pair():
    return WheelRailPair(Pair(profile.s1002(), profile.rail_60e1()))


@pytest.mark.parametrize(
    ("pose", "options", "rail"),
    [
        (Pose(y=6.5e-3), {"vertical": 60e3}, ElasticRail(8e6, 50e6)),
        (Pose(y=2.5e-3, yaw=2e-3), {"load": 80e3}, ElasticRail(10e6, 40e6, 2e3, -1e4)),
        (Pose(y=-3e-3, z=3.3e-3), {}, ElasticRail(12e6, 30e6, 3e3, 0.0)),
        (Pose(y=3e-3, z=1.6e-3), {}, ElasticRail(15e6, 40e6, 2e3, -12e3)),
        (Pose(y=5e-3), {"vertical": 7e4}, ElasticRail(kz=40e6)),
        (Pose(y=5e-3), {"vertical": 7e4}, ElasticRail(ky=9e6)),
    ],
)
def test_springs_and_forces_are_in_balance(pair, pose, options, rail):
    s = pair.solve(pose, VELOCITY, rail=rail, **options)
    assert s.status in (Status.OK, Status.SATURATED)
    for axis, (k, preload) in enumerate(((rail.ky, rail.preload_y), (rail.kz, rail.preload_z)), start=1):
        d = s.deflection[axis - 1]
        if k == math.inf:
            assert d == 0.0
        else:
            assert k * d == pytest.approx(-s.force[axis] + preload, abs=1e-4 * s.Q)
    # the same forces follow from the displaced rail
    moved = Irregularity(y=s.deflection[0], z=s.deflection[1])
    again = pair.solve(pose, VELOCITY, irregularity=moved, **options)
    np.testing.assert_allclose(again.force, s.force, atol=1e-3 * s.Q)
    assert again.z == pytest.approx(s.z, abs=1e-7)


def test_stiff_springs_are_a_rigid_rail(pair):
    rigid = pair.solve(Pose(y=5e-3), VELOCITY, vertical=7e4)
    stiff = pair.solve(Pose(y=5e-3), VELOCITY, vertical=7e4, rail=ElasticRail(1e13, 1e13))
    np.testing.assert_allclose(stiff.force, rigid.force, atol=1e-3 * 7e4)
    endless = pair.solve(Pose(y=5e-3), VELOCITY, vertical=7e4, rail=ElasticRail())
    np.testing.assert_allclose(endless.force, rigid.force, atol=1e-3 * 7e4)
    assert endless.deflection == (0.0, 0.0)


#: Set L, CONTACT 25.1: pose y [mm], yaw; load [kN]; ky, kz [N/mm]; preload [N]; deflections [mm] and force on the rail [N].
DEFLECTIONS = [
    ((2.5, 0.002), 80.0, (10e3, 40e3), (0.0, 0.0), (-0.9401, 2.0), (-14311.1, -9401.5)),
    ((6.5, 0.0), 60.0, (8e3, 50e3), (0.0, 0.0), (1.2877, 1.2), (-17249.5, 10301.3)),
    ((7.2, 0.006), 60.0, (20e3, 50e3), (-5e3, -1e4), (0.7567, 1.0), (-14833.9, 20134.3)),
]


@pytest.mark.parametrize(("pose", "load", "springs", "preload", "deflection", "force"), DEFLECTIONS)
def test_the_deflections_are_contacts(pair, pose, load, springs, preload, deflection, force):
    """Within 0.12 mm and 2 % of the vertical force, because 60E1 is not CONTACT's profile point by point.

    `benchmarks/contact_features.py` compares with CONTACT's own profiles.
    """
    rail = ElasticRail(*(1e3 * k for k in springs), *preload)
    s = pair.solve(Pose(y=1e-3 * pose[0], yaw=pose[1]), VELOCITY, vertical=1e3 * load, rail=rail)
    assert s.status in (Status.OK, Status.SATURATED)
    assert s.deflection == pytest.approx([1e-3 * d for d in deflection], abs=0.12e-3)
    assert (-s.force[0], -s.force[1]) == pytest.approx(force, abs=20.0 * load)


def test_a_call_starts_from_the_last_deflection_and_forget_resets_it(pair):
    given = {"vertical": 6e4, "rail": ElasticRail(8e6, 50e6)}
    first = pair.solve(Pose(y=6.5e-3), VELOCITY, **given)
    pair.solve(Pose(y=6.4e-3), VELOCITY, **given)
    warm = pair.solve(Pose(y=6.5e-3), VELOCITY, **given)
    pair.forget()
    cold = pair.solve(Pose(y=6.5e-3), VELOCITY, **given)
    assert cold.deflection == first.deflection != warm.deflection
    assert warm.deflection == pytest.approx(first.deflection, abs=1e-6)


def test_a_wheel_in_the_air_leaves_the_rail_to_its_preload(pair):
    s = pair.solve(Pose(z=-0.01), VELOCITY, rail=ElasticRail(1e7, 2e7, 1e3, -2e3))
    assert s.status is Status.NO_CONTACT
    assert s.deflection == pytest.approx((1e-4, -1e-4), abs=1e-7)


def test_a_damper_pulls_back_in_proportion_to_the_rate():
    rail = ElasticRail(1e7, 2e7, 100.0, 200.0).damped(1e4, 3e4, 1e-3, (1e-4, 2e-4))
    assert (rail.ky, rail.kz) == pytest.approx((2e7, 5e7))
    dy = 3e-4  # k dy + c (dy - last)/step = F + P
    assert rail.ky * dy - rail.preload_y == pytest.approx(1e7 * dy + 1e4 * (dy - 1e-4) / 1e-3 - 100.0)
