"""A wheel and a rail in steps: against one contact in steps, steady rolling, strips, mirror images, and what is kept."""

import copy
import warnings

import numpy as np
import pytest

import contact
from contact.errors import ModelWarning
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.shape import Profile
from contact.geometry.surfaces import RailSurface, SurfacePair
from contact.geometry.wheelset import Pair
from contact.halfspace import Gap
from contact.pair import ElasticRail, HalfspacePair, RollerRig, TransientPair, WheelRailPair

WHEEL, RAIL = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
POSE, DRIVEN = Pose(y=1e-3, yaw=2e-3), Velocity(20.0, spin=-20.0 / 0.46 * 1.001)


def plane(half=0.03):
    y = np.linspace(-half, half, 61)
    return Profile("wheel", y, np.zeros(y.size))


def circle(radius=0.1, middles=(0.0,), half=0.03):
    """Return a rail with circular tops."""
    y = np.linspace(-half, half, 241)
    z = np.min([radius - np.sqrt(radius**2 - (y - at) ** 2) for at in middles], axis=0)
    return Profile("rail", y, z)


def single(rail, **options):
    """Return a wheel of 100 mm radius with a plane tread, alone on a rail."""
    at = {"nominal_radius": 0.1, "tape": 0.0, "rail_origin": (0.0, 0.0), "spacing": 2e-4}
    return SurfacePair(plane(), rail, **(at | options))


def test_a_shift_of_a_wheel_is_that_of_one_contact_on_the_same_gap():
    pair, depth = TransientPair(single(circle())), 4e-5
    x = np.arange(-14, 15) * 2e-4
    h = (0.1 - np.sqrt(0.1**2 - x**2)) + (0.1 - np.sqrt(0.1**2 - x[:, None] ** 2))
    one = contact.Transient(Gap(x, x, h), approach=depth)
    for across, turn in ((2e-6, 1e-5), (0.0, 2e-5), (-3e-6, -4e-5)):
        found = pair.shift(Pose(z=depth), Velocity(0.0, y=across, spin=turn))
        same = one.shift(turn * 0.1, across)
        assert found.force == pytest.approx([same.Fx, same.Fy, -same.N], rel=2e-3, abs=2e-3 * same.N)
        assert found.contacts[0].creepage.lateral == pytest.approx(across, abs=1e-9)


def test_four_shifts_in_one_direction_are_one_and_a_copy_continues():
    pair, moved = TransientPair(SurfacePair(WHEEL, RAIL, spacing=1e-3)), Velocity(0.0, spin=1e-5)
    pair.shift(POSE, moved, penetration=8e-5)
    other = copy.copy(pair)
    for _ in range(3):
        found, same = pair.shift(POSE, moved, penetration=8e-5), other.shift(POSE, moved, penetration=8e-5)
        assert (found.force == same.force).all()
    pair.forget()
    once = pair.shift(POSE, Velocity(0.0, spin=4e-5), penetration=8e-5)
    assert found.force == pytest.approx(once.force, rel=2e-3)


def test_a_long_step_of_a_pair_is_told_once():
    pair = TransientPair(SurfacePair(WHEEL, RAIL, spacing=2e-3))
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        for _ in range(2):
            pair.roll(Pose(), DRIVEN, distance=8e-3, penetration=8e-5)
    assert [w.category for w in seen] == [ModelWarning]
    assert "distance = 0.008 m is 4 of the 5 elements" in str(seen[0].message)


@pytest.mark.slow
def test_rolling_in_steps_ends_in_steady_rolling_on_both_sides():
    for side, mirror in (("right", 1.0), ("left", -1.0)):
        pair, pose = TransientPair(SurfacePair(WHEEL, RAIL, spacing=1e-3, side=side)), Pose(y=mirror * 1e-3)
        steps = [pair.roll(pose, DRIVEN, distance=1e-3, penetration=8e-5) for _ in range(40)]
        steady = pair.roll_on(pose, DRIVEN, penetration=8e-5)
        assert abs(steps[0].force[0]) < 0.3 * abs(steady.force[0])
        assert steps[-1].force == pytest.approx(steady.force, rel=0.01, abs=0.01 * abs(steady.force[0]))
        held = pair.roll(pose, DRIVEN, distance=1e-3, penetration=8e-5)
        assert held.force == pytest.approx(steady.force, rel=0.01, abs=0.01 * abs(steady.force[0]))


def test_patches_keep_their_traction_when_they_join_and_part():
    """Pressing without a shift leaves all displacements, so the traction stays, whichever patch has the element."""
    pair = TransientPair(single(circle(middles=(-4e-3, 4e-3)), combine_distance=0.5e-3))
    two = pair.shift(Pose(z=5e-5), Velocity(0.0, spin=1e-5))
    assert len(two.contacts) == 2
    one = pair.shift(Pose(z=1.5e-4), Velocity(0.0, spin=0.0))
    assert len(one.contacts) == 1
    apart = pair.shift(Pose(z=6e-5), Velocity(0.0, spin=0.0))
    assert len(apart.contacts) == 2
    assert one.force[0] == pytest.approx(two.force[0], rel=0.02)
    fresh = TransientPair(pair.pair).shift(Pose(z=6e-5), Velocity(0.0, spin=0.0))
    assert pytest.approx(fresh.Q, rel=2e-3) == apart.Q  # each patch has its own elements only
    assert apart.contacts[0].Fx == pytest.approx(apart.contacts[1].Fx, rel=1e-6)


def test_what_a_shift_left_on_the_rail_stays_there_when_the_wheel_moves_along():
    """Two steps that move the wheel by whole elements: the grid follows, and the elements keep their traction."""
    pair = TransientPair(single(circle()))
    first = pair.shift(Pose(z=4e-5), Velocity(0.0, spin=1e-5))
    pair.shift(Pose(z=4e-5), Velocity(4e-4, spin=-4e-4 / 0.1), station=4e-4)  # rolls along in one step
    (before,), peak = pair.state, first.contacts[0].solution
    assert before.u == pytest.approx(4e-4 + before.x, abs=1e-12)
    assert np.abs(before.state.traction[0]).max() > 0.1 * np.abs(peak.qx).max()


def test_steps_under_a_vertical_force_carry_it_with_friction():
    pair = TransientPair(SurfacePair(WHEEL, RAIL, spacing=1e-3))
    for k in range(3):
        found = pair.roll(Pose(y=5e-3), DRIVEN, distance=1e-3, vertical=6e4)
        assert pytest.approx(6e4, rel=2e-4) == found.Q, k


def test_a_step_that_raises_leaves_the_state_as_it_was():
    pair = TransientPair(SurfacePair(WHEEL, RAIL, spacing=1e-3))
    pair.shift(POSE, Velocity(0.0, spin=1e-5), penetration=8e-5)
    before = pair.state
    with pytest.raises(contact.ContactError, match="load"):
        pair.shift(POSE, Velocity(0.0, spin=1e-5), load=-1.0)
    assert pair.state is before
    with pytest.raises(contact.ContactError, match="spacing"):
        TransientPair(SurfacePair(WHEEL, RAIL))


@pytest.mark.slow
def test_displaced_wheels_and_elastic_rails_are_those_of_strips():
    offset = WheelOffset(
        x=2e-3,
        y=1e-3,
        z=2e-4,
        roll=3e-3,
        yaw=1e-3,
        y_rate=0.01,
        z_rate=0.005,
        roll_rate=0.02,
        yaw_rate=0.03,
        pitch_rate=0.02,
    )
    surfaces = SurfacePair(WHEEL, RAIL, spacing=1e-3)
    exact, strips = HalfspacePair(surfaces), WheelRailPair(Pair(WHEEL, RAIL))
    for given in ({"offset": offset}, {"rail": ElasticRail(2e7, 4e7)}, {"force": 5e3}):
        a, b = (
            one.solve(POSE, DRIVEN, vertical=8e4, irregularity=Irregularity(y=1e-4), **given) for one in (exact, strips)
        )
        assert a.z == pytest.approx(b.z, abs=2e-6)
        assert a.deflection == pytest.approx(b.deflection, abs=2e-5)
        assert a.contacts[0].creepage.lateral == pytest.approx(b.contacts[0].creepage.lateral, abs=2e-5)
        assert a.contacts[0].creepage.longitudinal == pytest.approx(b.contacts[0].creepage.longitudinal, abs=3e-5)
        assert a.force == pytest.approx(b.force, abs=0.03 * 24e3)
        assert a.moment == pytest.approx(b.moment, abs=0.03 * 24e3)


def test_a_roller_is_that_of_the_roller_rig():
    """The rig takes the radius of the roller at the track's plane, the surface at its profile's origin."""
    radius, level = 0.5, profile.rail_60e1(inclination=0)
    surfaces = SurfacePair(
        WHEEL, RailSurface.roller(level, radius), rail_origin=SurfacePair(WHEEL, level).rail_origin, spacing=5e-4
    )
    exact = HalfspacePair(surfaces).solve(POSE, DRIVEN, vertical=8e4)
    strips = RollerRig(Pair(WHEEL, level), radius).solve(POSE, DRIVEN, vertical=8e4)
    a, b = exact.contacts[0], strips.contacts[0]
    assert exact.z == pytest.approx(strips.z, abs=2e-6)
    assert a.max_pressure == pytest.approx(b.max_pressure, rel=0.02)
    for name in ("longitudinal", "lateral"):
        assert getattr(a.creepage, name) == pytest.approx(getattr(b.creepage, name), abs=1e-5)
    assert a.creepage.spin == pytest.approx(b.creepage.spin, rel=0.01)
    with pytest.raises(contact.ContactError, match="radius"):
        RailSurface.roller(level, 20.0)


def test_a_curved_surface_of_a_narrow_patch_is_its_plane():
    surfaces, motion = single(circle(), spacing=6e-5), Velocity(1.0, y=1e-4, spin=-1.0 / 0.1 * 1.0002)
    plane_, bent, slipping = (
        TransientPair(surfaces, **kind).solve(Pose(y=3e-3, z=3e-6, roll=0.03), motion)
        for kind in ({}, {"conformal": True}, {"true_slip": True})
    )
    for found in (bent, slipping):
        assert found.force == pytest.approx(plane_.force, abs=5e-3 * plane_.Q)
        assert found.max_pressure == pytest.approx(plane_.max_pressure, rel=2e-3)
        assert found.contacts[0].creepage == plane_.contacts[0].creepage


@pytest.mark.slow
@pytest.mark.parametrize(("side", "mirror"), [("right", 1.0), ("left", -1.0)])
def test_a_conformal_patch_at_the_flange_root_is_that_of_strips(side, mirror):
    surfaces = SurfacePair(WHEEL, RAIL, side=side, spacing=2e-4)
    pose = Pose(y=mirror * 5.5e-3)
    exact = TransientPair(surfaces, conformal=True).solve(pose, DRIVEN, vertical=3e4)
    strips = WheelRailPair(Pair(WHEEL, RAIL, side=side), conformal=True).solve(pose, DRIVEN, vertical=3e4)
    assert exact.force == pytest.approx(strips.force, abs=0.01 * 0.3 * 3e4)
    assert exact.contacts[0].max_pressure == pytest.approx(strips.contacts[0].max_pressure, rel=0.01)
    assert exact.contacts[0].solution.bend > 0.03
