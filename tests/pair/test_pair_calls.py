"""What `WheelRailPair` says of a solution, and which calls it refuses."""

import math
from dataclasses import replace

import numpy as np
import pytest

import contact
from contact import Status
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from tests.pair.made import RAIL, WHEEL, WORN, make, random_motion


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("seed", range(4))
def test_what_engineers_plot_is_that_of_forces_and_profiles(side, seed):
    """Q is positive down and Y positive outwards, on the rail. Contact positions lie on the profiles."""
    pair = make(side)
    pose, velocity, rail = random_motion(seed)
    found = pair.solve(pose, velocity, load=80e3, irregularity=rail)
    outwards = 1.0 if side == "right" else -1.0
    assert found.Q == -found.force[2] > 0.0
    assert -outwards * found.force[1] == found.Y
    assert found.Y_over_Q == found.Y / found.Q
    creep = [math.hypot(c.Fx, c.Fy) for c in found.contacts]
    assert found.used_friction == pytest.approx(sum(creep) / sum(c.N for c in found.contacts), rel=1e-12)
    assert 0.0 < found.used_friction <= 0.3 * (1.0 + 1e-6)
    for c, force in zip(found.contacts, creep, strict=True):
        assert c.used_friction == pytest.approx(force / c.N, rel=1e-12)
        for shape, (y, z) in ((RAIL, c.on_rail), (WHEEL, c.on_wheel)):
            order = np.argsort(shape.y)
            assert z == pytest.approx(np.interp(y, shape.y[order], shape.z[order]), abs=5e-6)


def test_flange_contact_pushes_the_rail_outwards(right, left):
    for pair, sign in ((right, 1.0), (left, -1.0)):
        found = pair.solve(Pose(sign * 7.5e-3), Velocity(20.0), load=80e3, friction=0.0)
        assert found.Y_over_Q > 0.1


def test_a_wheel_at_standstill_has_no_creep(right):
    found = right.solve(Pose(2e-3), Velocity(0.0), load=80e3)
    assert found.status == Status.OK
    assert found.used_friction == 0.0
    assert all(c.creepage == contact.Creepage(0.0, 0.0, 0.0) for c in found.contacts)


def test_the_patches_share_T_gamma_and_damage_has_the_names_of_a_solution():
    found = make(rail=WORN).solve(Pose(y=6.37e-3, yaw=4e-3), Velocity(forward=20.0), load=80e3)
    assert len(found.contacts) > 1
    assert sum(one.T_gamma for one in found.contacts) == pytest.approx(found.damage.T_gamma, rel=1e-12)
    assert min(one.T_gamma for one in found.contacts) > 0.0
    assert found.damage.archard == (found.damage.archard_depth, found.damage.archard_volume)


def test_friction_and_speed_are_those_of_the_call_whatever_was_given_before():
    """The pair keeps the last surface, since most calls have the same."""
    one, speed = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1())), Velocity(20.0, yaw=0.1)
    falling = Friction(0.4, 0.1, half_speed=0.05, law="rational")
    changing = np.array(0.3)

    def forces(friction, velocity=speed, pair=None):
        pair = pair or WheelRailPair(one.pair)
        pair.forget()
        return pair.solve(Pose(yaw=4e-3), velocity, load=8e4, friction=friction).force.tolist()

    for friction in (0.3, 0.3, falling, 0.1, Friction(0.1), np.float64(0.3), 1, changing, falling):
        assert forces(friction, pair=one) == forces(friction)
    assert forces(falling, Velocity(5.0, yaw=0.1), one) == forces(falling, Velocity(5.0, yaw=0.1))
    before = forces(changing, pair=one)
    changing[...] = 0.1
    assert forces(changing, pair=one) == forces(0.1) != before


def test_a_solution_that_is_read_late_is_that_of_its_call():
    one = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1()))
    first = one.solve(Pose(y=1e-3), load=8e4)
    other = one.solve(Pose(y=-3e-3), load=4e4)
    assert "contacts" not in first.__dict__
    loads = [solution.contacts[0].N for solution in (first, other)]
    assert loads == pytest.approx([8e4, 4e4], rel=0.02)
    assert first.force[2] == -first.Q
    assert replace(first, z=1.0).contacts == first.contacts
    assert {"contacts", "force", "moment", "damage", "Q"} <= set(dir(other))
    with pytest.raises(AttributeError, match="no attribute 'pressure'"):
        first.pressure  # noqa: B018
