"""Pairs on strips, by the half space and on a roller give one kind of result."""

import pytest

from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import RollerRig, WheelRailPair

PROFILES = profile.s1002(), profile.rail_60e1()
POSE, VELOCITY = Pose(y=-2e-3, yaw=1e-3), Velocity(10.0, spin=-21.75)


@pytest.mark.slow
def test_a_rail_and_a_roller_of_ten_metres_agree_in_every_number():
    """The pair's sums are formed in a kernel, the roller's in Python."""
    rail = WheelRailPair(Pair(*PROFILES)).solve(POSE, VELOCITY, vertical=6e4)
    roller = RollerRig(Pair(*PROFILES), 10.0).solve(POSE, VELOCITY, vertical=6e4)
    assert roller.force == pytest.approx(rail.force, abs=0.01 * 6e4)
    assert roller.moment == pytest.approx(rail.moment, abs=0.01 * 6e4 * 0.46)
    for name in ("Q", "Y_over_Q", "area", "max_pressure", "slip_area", "z", "spin"):
        assert getattr(roller, name) == pytest.approx(getattr(rail, name), rel=0.05, abs=0.01), name
    assert roller.power_per_metre == pytest.approx(rail.power_per_metre, rel=0.1)
    assert roller.damage.T_gamma == pytest.approx(rail.damage.T_gamma, rel=0.1)
    assert roller.used_friction == pytest.approx(rail.used_friction, abs=0.01)
    assert roller.status is rail.status
