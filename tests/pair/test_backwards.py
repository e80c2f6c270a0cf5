"""A wheel that rolls backwards, or stands: V < 0 is -V turned by 180° about z; braked to rest with a reference speed."""

import math
from dataclasses import replace

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.records import Irregularity
from contact.geometry.surfaces import Polygon, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import ElasticRail, HalfspacePair, WheelRailPair

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
R = 0.46


def pairs(**options):
    return (WheelRailPair(Pair(WHEEL, RAIL, side=side, **options)) for side in ("right", "left"))


#: A force or a moment of the left wheel, seen after a turn of 180° about z.
TURNED = np.array([-1.0, -1.0, 1.0])


@pytest.mark.parametrize("amount", [{"load": 8e4}, {"vertical": 8e4}, {"penetration": 1e-4}])
@pytest.mark.parametrize(("y", "yaw", "V"), [(2e-3, 2e-3, 20.0), (6.5e-3, -8e-3, 1.0), (-1e-3, 0.0, 5e-4)])
def test_backwards_is_the_other_wheel_forwards_turned_about_z(amount, y, yaw, V):
    right, left = pairs()
    slip = 1.002
    rates = {"y": 1e-3 * V, "yaw": 2e-3 * V, "roll": 1e-3 * V}
    back = right.solve(
        Pose(y=y, yaw=yaw, roll=1e-3),
        Velocity(-V, spin=slip * V / R, **rates),
        irregularity=Irregularity(y=1e-4, roll=1e-3, y_rate=1e-4),
        **amount,
    )
    turned = left.solve(
        Pose(y=-y, yaw=yaw, roll=-1e-3),
        Velocity(V, spin=-slip * V / R, **{"y": -rates["y"], "yaw": rates["yaw"], "roll": -rates["roll"]}),
        irregularity=Irregularity(y=-1e-4, roll=-1e-3, y_rate=-1e-4),
        **amount,
    )
    N = abs(turned.Q)
    assert back.force == pytest.approx(TURNED * turned.force, abs=1e-9 * N)
    assert back.moment == pytest.approx(TURNED * turned.moment, abs=1e-9 * N)
    assert (back.z, back.Y, back.Q) == pytest.approx((turned.z, turned.Y, turned.Q), rel=1e-9, abs=1e-12)
    assert back.power_per_metre == pytest.approx(turned.power_per_metre, rel=1e-9)
    for one, other in zip(back.contacts, turned.contacts, strict=True):
        assert one.creepage.longitudinal == pytest.approx(-other.creepage.longitudinal, abs=1e-12)
        assert one.creepage.lateral == pytest.approx(-other.creepage.lateral, abs=1e-12)
        assert one.creepage.spin == pytest.approx(other.creepage.spin, abs=1e-9)
        assert one.position == pytest.approx(tuple(TURNED * other.position), abs=1e-12)
        assert one.Mz == pytest.approx(other.Mz, abs=1e-9 * N)


def test_a_flexible_wheel_on_a_soft_rail_rolls_back_too():
    right, left = pairs()
    rail = ElasticRail(8e6, 5e7)
    offset = WheelOffset(x=1e-4, y=2e-4, yaw=1e-3, pitch_rate=-1e-2, x_rate=1e-3)
    back = right.solve(Pose(y=2e-3, yaw=1e-3), Velocity(-10.0), load=8e4, rail=rail, offset=offset)
    other = replace(offset, x=-offset.x, y=-offset.y, pitch_rate=-offset.pitch_rate, x_rate=-offset.x_rate)
    turned = left.solve(Pose(y=-2e-3, yaw=1e-3), Velocity(10.0), load=8e4, rail=rail, offset=other)
    assert back.force == pytest.approx(TURNED * turned.force, abs=1e-4)
    assert back.moment == pytest.approx(TURNED * turned.moment, abs=1e-4)
    assert back.deflection == pytest.approx((-turned.deflection[0], turned.deflection[1]), abs=1e-12)


def test_braking_pushes_forwards_when_rolling_back():
    """A wheel that turns less than it rolls slides along its way; friction opposes this."""
    pair = next(pairs())
    for V in (10.0, -10.0):
        braked = pair.solve(Pose(), Velocity(V, spin=-0.995 * V / R), load=8e4)
        assert math.copysign(1.0, braked.force[0]) == -math.copysign(1.0, V)
        assert braked.power_per_metre > 0.0


def test_noise_of_either_sign_about_standing_passes_and_changes_little():
    pair = next(pairs())
    at = (Pose(y=2e-3, yaw=2e-3),)
    forces = np.array([pair.solve(*at, Velocity(V, spin=0.0), load=8e4).force for V in (1e-12, 0.0, -1e-12)])
    assert np.ptp(forces, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=0.1)  # 1e-12 m/s over 1 mm/s
    run = pair.run({"time": [0.0, 1.0, 2.0], "velocity.x": [1e-3, -1e-12, -1e-3], "load": 8e4, "pose.y": 2e-3})
    assert (run["power"] >= 0.0).all()


def test_derivatives_backwards_are_those_of_differences():
    pair = next(pairs())
    pose, velocity = Pose(y=3e-3, yaw=2e-3), Velocity(-15.0, spin=1.001 * 15.0 / R)
    found = pair.solve(pose, velocity, load=8e4, derivatives=True).jacobian
    for name, step, given in (
        ("velocity.forward", 1e-3, lambda h: (pose, replace(velocity, forward=-15.0 + h))),
        ("velocity.spin", 1e-3, lambda h: (pose, replace(velocity, spin=velocity.spin + h))),
        ("velocity.y", 1e-4, lambda h: (pose, replace(velocity, y=h))),
        ("pose.yaw", 1e-5, lambda h: (replace(pose, yaw=2e-3 + h), velocity)),
    ):
        high, low = (pair.solve(*given(side * step), load=8e4) for side in (1.0, -1.0))
        by_difference = np.concatenate((high.force - low.force, high.moment - low.moment)) / (2.0 * step)
        column = found.values[:6, list(found.columns).index(name)]
        assert column == pytest.approx(by_difference, rel=0.05, abs=0.02 * np.abs(by_difference).max()), name


def test_rolling_back_is_refused_where_the_surfaces_change_along_the_way():
    wheel = WheelSurface.constant(WHEEL, Polygon(20, 1e-4))
    for solver in (WheelRailPair, HalfspacePair):
        with pytest.raises(ContactError, match=r"velocity.forward = -1 is negative: on surfaces"):
            solver(SurfacePair(wheel, RAIL)).solve(Pose(), Velocity(-1.0), penetration=5e-5)


MASS, INERTIA, STEP = 10e3, 120.0, 2e-4  # of an axle with its share of the vehicle, and the step of a fixed-step model
WEIGHT = 9.81 * MASS


def rolled(speed, torque, slope, seconds, reference):
    """Return speed, spin and longitudinal force of an axle over time, by explicit steps. `torque` may depend on the spin."""
    right, left = pairs(reference_speed=reference)
    V, spin, rows = speed, -speed / R, []
    for _ in range(round(seconds / STEP)):
        both = [one.solve(Pose(), Velocity(V, spin=spin), load=0.5 * WEIGHT, friction=0.3) for one in (right, left)]
        Fx, My = sum(s.force[0] for s in both), sum(s.moment[1] for s in both)
        V += STEP * (Fx - slope * WEIGHT) / MASS
        free = spin + STEP * My / INERTIA
        brake = torque * STEP / INERTIA
        spin = free - math.copysign(min(abs(free), brake), free)  # a brake holds, it does not drive
        rows.append((V, spin, Fx))
    return np.array(rows).T


def test_an_axle_is_braked_to_rest_at_steps_of_a_fifth_of_a_millisecond_without_chatter():
    V, spin, Fx = rolled(0.3, 6e3, 0.0, 0.6, reference=5.0)
    assert abs(V[-1]) < 1e-3
    assert abs(spin[-1]) < 1e-9
    resting = Fx[-500:]
    assert np.abs(np.diff(resting)).max() < 1e-3 * 0.3 * WEIGHT  # with 1 mm/s it jumps from -μN to μN at every step
    assert np.abs(resting).max() < 0.02 * 0.3 * WEIGHT


def test_a_braked_axle_stands_on_one_per_cent_and_an_unbraked_one_rolls_back():
    V, _, Fx = rolled(0.0, 6e3, 0.01, 0.4, reference=5.0)
    assert Fx[-1] == pytest.approx(0.01 * WEIGHT, rel=0.05)
    assert abs(V[-1]) < 5e-3  # it creeps by the damper that its contact is
    V, spin, _ = rolled(0.05, 0.0, 0.01, 1.0, reference=5.0)
    assert V[0] > 0.0 > V[-1]
    whole = MASS + INERTIA / R**2
    assert V[-1] == pytest.approx(0.05 - 0.01 * WEIGHT / whole, abs=5e-3)
    assert spin[-1] == pytest.approx(-V[-1] / R, rel=0.05)
