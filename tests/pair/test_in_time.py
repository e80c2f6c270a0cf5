"""Friction memory and contact damping over time steps, against their closed forms."""

import math

import numpy as np
import pytest

from contact import ContactError
from contact.contact_damping import ContactDamping
from contact.friction import Friction
from contact.friction_memory import FrictionMemory
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair

LAW = Friction(static=0.35, law="exponential", kinetic=0.15, half_speed=0.5)


def test_the_coefficient_fades_exponentially_over_the_distance_slid():
    for n in (1, 7):
        memory = FrictionMemory(LAW, 2e-3)
        for _ in range(n):
            memory.advance(0.8, 4e-3 / n)
        steady = float(LAW.coefficient(0.8))
        assert memory.coefficient == pytest.approx(steady + (0.35 - steady) * math.exp(-0.8 * 4e-3 / 2e-3), rel=1e-12)
    assert memory.friction.law == "coulomb"
    assert memory.friction.static == memory.coefficient


def test_without_sliding_the_state_rests_unless_it_has_a_least_velocity():
    memory = FrictionMemory(LAW, 1e-3)
    fast = memory.advance(5.0, 1.0)
    assert fast == pytest.approx(float(LAW.coefficient(5.0)), rel=1e-9)
    assert memory.advance(0.0, 10.0) == fast
    memory = FrictionMemory(LAW, 1e-3, least=1e-3)
    memory.advance(5.0, 1.0)
    assert memory.advance(0.0, 2.0) == pytest.approx(0.35 + (fast - 0.35) * math.exp(-2.0), rel=1e-9)


def test_a_short_memory_is_the_law():
    memory = FrictionMemory(LAW, 1e-9)
    for sliding in (0.1, 2.0, 0.4):
        assert memory.advance(sliding, 1e-3) == pytest.approx(float(LAW.coefficient(sliding)), rel=1e-12)


@pytest.fixture(scope="module")
def pair():
    return WheelRailPair(Pair(profile.s1002(), profile.rail_60e1()))


def solved(pair, load, creep=0.0):
    return pair.solve(Pose(y=2e-3), Velocity(20.0, spin=-20.0 / 0.46 * (1.0 + creep)), load=load)


def test_a_force_that_rises_evenly_has_its_rate_times_the_damping_time_more(pair):
    damping = ContactDamping(2e-4, 5e-4)
    first = solved(pair, 60e3, 1e-4)
    np.testing.assert_array_equal(damping.force(first, 1e-3), first.force)
    one, other = first.contacts[0], (second := solved(pair, 61e3, 4e-4)).contacts[0]
    added = damping.force(second, 1e-3) - second.force
    assert added[0] == pytest.approx(5e-4 * (other.Fx - one.Fx) / 1e-3, rel=1e-9)
    normal, lateral = 2e-4 * (other.N - one.N) / 1e-3, 5e-4 * (other.Fy - one.Fy) / 1e-3
    c, s = math.cos(other.angle), math.sin(other.angle)
    assert added[1:] == pytest.approx((c * lateral + s * normal, s * lateral - c * normal), rel=1e-9)
    damping.forget()
    np.testing.assert_array_equal(damping.force(second, 1e-3), second.force)


def test_rates_are_limited_and_no_patch_pulls(pair):
    damping = ContactDamping(1e-3, normal_rate=2e5)
    high, low = solved(pair, 80e3), solved(pair, 1e3)
    damping.force(high, 1e-3)
    middle = solved(pair, 60e3)
    assert np.linalg.norm(damping.force(middle, 1e-3) - middle.force) == pytest.approx(1e-3 * 2e5, rel=1e-6)
    damping = ContactDamping(1.0)
    damping.force(high, 1e-3)
    left = damping.force(low, 1e-3) - low.force
    assert np.linalg.norm(left) == pytest.approx(low.contacts[0].N, rel=1e-9)


def test_a_new_patch_has_no_damping(pair):
    damping, flange = ContactDamping(1e-3), pair.solve(Pose(y=7e-3), Velocity(20.0), load=6e4)
    damping.force(solved(pair, 6e4), 1e-3)
    np.testing.assert_array_equal(damping.force(flange, 1e-3), flange.force)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: FrictionMemory(LAW, 0.0), "distance = 0 is outside"),
        (lambda: FrictionMemory(LAW, 1.0, -1.0), "least = -1 is outside"),
        (lambda: FrictionMemory(0.3, 1.0), "friction = 0.3 is not a contact.friction.Friction"),
        (lambda: FrictionMemory(Friction(0.3, velocity="local"), 1.0), "one state follows only 'global'"),
        (lambda: FrictionMemory(LAW, 1.0).advance(math.nan, 1.0), "sliding = nan is outside"),
        (lambda: ContactDamping(-1.0), "normal = -1 is outside"),
        (lambda: ContactDamping(1.0, normal_rate=0.0), "normal_rate = 0 is outside"),
    ],
)
def test_bad_input_is_refused(call, message):
    with pytest.raises(ContactError, match=message):
        call()
