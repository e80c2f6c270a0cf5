"""`over_poses` gives the numbers of `WheelRailPair.solve`, whatever the number of threads."""

import numpy as np
import pytest

from contact import Status
from contact.errors import PlausibilityWarning
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair, over_poses

RADIUS = 0.46


@pytest.fixture(scope="module")
def pair():
    return WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(), nominal_radius=RADIUS))


def test_poses_have_the_bits_of_single_solutions(pair):
    y, load = np.array([[-4e-3], [0.0], [5e-3], [7e-3]]), np.array([40e3, 110e3])
    creepages = {"longitudinal": 1e-3, "lateral": -2e-3, "spin": 5e-3}
    found = over_poses(pair, y=y, yaw=2e-3, load=load, speed=30.0, friction=0.4, **creepages)
    assert found.Fx.shape == (4, 2)
    velocity = Velocity(30.0, y=-2e-3 * 30.0, yaw=5e-3 * 30.0, spin=(1e-3 - 1.0) * 30.0 / RADIUS)
    for i in range(4):
        for j in range(2):
            pair.forget()
            one = pair.solve(Pose(y=y[i, 0], yaw=2e-3), velocity, load=load[j], friction=0.4)
            assert [found.Fx[i, j], found.Fy[i, j], found.Fz[i, j]] == one.force.tolist()
            assert [found.Mx[i, j], found.My[i, j], found.Mz[i, j]] == one.moment.tolist()
            assert (found.z[i, j], found.max_pressure[i, j]) == (one.z, one.max_pressure)
            assert (found.T_gamma[i, j], found.status[i, j]) == (one.damage.T_gamma, one.status)


def test_the_number_of_threads_changes_no_bit(pair):
    given = {"y": np.linspace(-6e-3, 6e-3, 41), "load": 80e3}
    one, three = (over_poses(pair, **given, threads=n) for n in (1, 3))
    for name, values in vars(one).items():
        assert np.array_equal(values, getattr(three, name)), name


def test_braking_slip_gives_a_force_that_brakes(pair):
    found = over_poses(pair, longitudinal=[-2e-3, 2e-3], load=80e3)
    assert found.Fx[0] > 0.0 > found.Fx[1]


def test_a_pose_without_an_answer_has_no_numbers_and_spoils_no_other(pair):
    found = over_poses(pair, y=[0.0, 0.5, 0.0], load=80e3, threads=1)
    assert found.status.tolist() == [Status.OK, Status.OUT_OF_RANGE, Status.OK]
    assert np.isnan(found.Fx[1])
    assert found.Fz[0] == found.Fz[2] < 0.0


def test_penetrations_and_heights_are_taken_as_given(pair):
    pair.forget()
    known = pair.solve(Pose(), Velocity(20.0), penetration=1e-4)
    assert over_poses(pair, penetration=1e-4).Q == known.Q
    at_height = over_poses(pair, z=known.z)
    assert pytest.approx(known.Q, rel=1e-9) == at_height.Q
    assert over_poses(pair, z=-0.01).status == Status.NO_CONTACT


def test_a_load_in_kilonewton_is_doubted(pair):
    with pytest.warns(PlausibilityWarning, match=r"load\[0\] = 80: .*kN"):
        over_poses(pair, load=[80.0, 90.0])
