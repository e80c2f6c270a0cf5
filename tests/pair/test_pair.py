"""`WheelRailPair` compared with its parts, mechanics and symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest

import contact
from contact import Status
from contact.damage import evaluate
from contact.friction import Friction
from contact.geometry.flexible import WheelOffset
from contact.geometry.surfaces import SurfacePair
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import ElasticRail, HalfspacePair, WheelRailPair
from tests.pair.made import R0, RAIL, WHEEL, WORN, make, random_motion

METHODS = contact.methods().batched


@pytest.fixture(scope="module")
def worn():
    return make(rail=WORN)


def turned(angle: float) -> np.ndarray:
    """Return the axes of the contact frame in track coordinates, as columns."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


#: On the gauge face of the rail friction is a quarter of that on its head.
FACE = Friction(0.4, gauge_factor=0.25, border=-8e-3, border_width=2e-2)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("load", [None, 80e3])
@pytest.mark.parametrize("conformal", [False, True])
def test_equals_search_and_separate_solution_of_every_patch(seed, load, conformal):
    side, mirror = ("left", -1.0) if seed in (3, 6) else ("right", 1.0)
    pair, friction = make(side, rail=WORN if seed % 2 else RAIL, conformal=conformal), FACE if seed % 3 else 0.4
    pose, velocity, rail = random_motion(seed)
    if seed == 1:
        pose, rail = Pose(y=6.37e-3), Irregularity()
    pose = Pose(pose.y, pair.pair.touch(pose, rail) + 8e-5, pose.roll, pose.yaw)
    pair.forget()
    actual = pair.solve(pose, velocity, load=load, irregularity=rail, friction=friction)
    exact = 1e-12
    if load:  # interacting strips start from a trial there, and from nothing here
        pose, found = replace(pose, z=actual.z), actual
        pair.forget()
        actual = pair.solve(pose, velocity, irregularity=rail, friction=friction)
        np.testing.assert_allclose(found.force, actual.force, rtol=0.0, atol=1e-4 * load)
    patches = pair.pair.contacts(pose, velocity, irregularity=rail)
    assert len(actual.contacts) == len(patches) >= 1
    force, damage = np.zeros(3), []
    for mine, patch in zip(actual.contacts, patches, strict=True):
        s = contact.solve(
            patch.separation, patch.creepage, approach=patch.approach, speed=velocity.forward, throw=False, conformal=conformal,
            friction=friction.placed(patch.on_rail[0], patch.angle, mirror) if friction is FACE else friction,
        )  # fmt: skip
        own = patch.share * np.array([s.N, s.Fx, s.Fy, s.Mz])
        np.testing.assert_allclose((mine.N, mine.Fx, mine.Fy, mine.Mz), own, rtol=exact, atol=1e-9)
        assert (mine.angle, mine.creepage, mine.status) == (patch.angle, patch.creepage, s.status)
        assert (mine.area, mine.max_pressure) == pytest.approx((patch.share * s.area, s.max_pressure), rel=exact)
        force += turned(mine.angle) @ (own[1], own[2], -own[0])
        d = evaluate(s, patch.rolling_radius)
        damage.append((patch.share * d.T_gamma, patch.share * d.archard.volume, d.archard.depth_max, d.burstow))
    np.testing.assert_allclose(actual.force, force, rtol=exact, atol=1e-9)
    T_gamma, volume, depth, burstow = zip(*damage, strict=True)
    total = actual.damage
    found = total.T_gamma, total.archard_volume, total.archard_depth, total.burstow
    wanted = (sum(T_gamma), sum(volume), max(depth), max(burstow))
    np.testing.assert_allclose(found, wanted, rtol=exact, atol=1e-30)


def axle_of(pose: Pose) -> np.ndarray:
    """Return the direction of the axle."""
    c, s = math.cos(pose.roll), math.sin(pose.roll)
    return np.array([-math.sin(pose.yaw) * c, math.cos(pose.yaw) * c, s])


@pytest.mark.parametrize("conformal", [False, True])
@pytest.mark.parametrize("y", [-6.6e-3, -6e-3, 0.0, 3e-3])
def test_without_friction_there_is_no_moment_about_the_axle(y, conformal):
    """The wheel is a body of revolution. The plane of a patch gave up to 45 N m on the flange, 1.9 kW at 20 m/s."""
    pose = Pose(y=y, roll=2e-3, yaw=4e-3)
    s = make("left", conformal=conformal).solve(pose, Velocity(20.0), load=60e3, friction=0.0)
    assert abs(s.moment @ axle_of(pose)) < 1e-9 * 60e3


@pytest.mark.parametrize("normal", METHODS.normal)
def test_vertical_parts_of_the_normal_forces_carry_the_load(normal):
    """The height is that of the method itself, so the number of patches depends on it. The load of some methods jumps."""
    pair = make(rail=WORN, normal=normal)
    s = pair.solve(Pose(y=6.385e-3), load=80e3)
    assert 1 <= len(s.contacts) <= 3
    missed = abs(sum(c.N * math.cos(c.angle) for c in s.contacts) / 80e3 - 1.0)
    # strips that iterate are found to 1e-5, the noise of their force; of `semi_winkler` the load has a step of 5e-6 here
    within = {"strip_halfspace": 1e-5, "semi_winkler": 1e-5}.get(normal, 2e-9)
    assert missed < within if METHODS.normal[normal].continuous else missed < 1e-3 or s.status is Status.NOT_CONVERGED


@pytest.mark.parametrize("seed", range(8))
def test_moment_is_that_of_the_contacts_wrenches_about_the_centre(worn, seed):
    """Without the moment of the pressure about the axle, which is an error of the plane."""
    pose, velocity, rail = random_motion(seed)
    s = worn.solve(pose, velocity, load=60e3, irregularity=rail)
    moment = np.zeros(3)
    for c in s.contacts:
        arm = np.array(c.position) - (0.0, pose.y, s.z - R0)
        pressure = np.cross(arm, turned(c.angle) @ (0.0, 0.0, -c.N)) + turned(c.angle) @ (c.Mx, c.My, 0.0)
        pressure -= (pressure @ axle_of(pose)) * axle_of(pose)
        moment += pressure + np.cross(arm, turned(c.angle) @ (c.Fx, c.Fy, 0.0)) + turned(c.angle) @ (0.0, 0.0, c.Mz)
    np.testing.assert_allclose(s.moment, moment, rtol=1e-12, atol=1e-7)


def test_pressure_of_a_curved_rail_is_centred_off_the_reference_point(right):
    """The moment Mx is the first moment of the pressure, here compared with the fields of the solution."""
    pose = Pose(y=2e-3, yaw=0.01)
    s = right.solve(pose, load=80e3)
    (patch,) = right.pair.contacts(replace(pose, z=s.z))
    field = contact.solve(patch.separation, patch.creepage, approach=patch.approach)
    dN = field.p * field.dA
    (c,) = s.contacts
    assert c.Mx == pytest.approx(-(dN * field.y).sum(), rel=1e-3)
    assert c.My == pytest.approx((dN * field.x).sum(), rel=1e-3)
    assert abs(c.Mx) > 1.0


@pytest.mark.parametrize("seed", range(10))
def test_power_of_the_wrench_is_that_of_the_creepages(right, worn, seed):
    """F·v + M·Omega of the wheelset is V(Fx ξ + Fy η + Mz φ) plus the power of the pressure. The rail is at rest."""
    pair = worn if seed % 2 else right
    pose, velocity, _ = random_motion(seed)
    s = pair.solve(pose, velocity, load=80e3)
    c, si = math.cos(pose.yaw), math.sin(pose.yaw)
    axle = np.array([-si * math.cos(pose.roll), c * math.cos(pose.roll), math.sin(pose.roll)])
    omega = velocity.roll * np.array([c, si, 0.0]) + velocity.yaw * np.array([0.0, 0.0, 1.0]) + velocity.spin * axle
    v = np.array([velocity.forward, velocity.y, velocity.z])
    wanted, scale = 0.0, 0.0
    for k in s.contacts:
        axes = turned(k.angle)
        at = v + np.cross(omega, np.array(k.position) - (0.0, pose.y, s.z - R0))
        creep = k.creepage
        creeping = k.Fx * creep.longitudinal + k.Fy * creep.lateral + k.Mz * creep.spin
        pressing = -k.N * (at @ axes[:, 2]) + (k.Mx, k.My, 0.0) @ (axes.T @ omega)
        arm = np.array(k.position) - (0.0, pose.y, s.z - R0)
        turning = (np.cross(arm, -k.N * axes[:, 2]) + axes @ (k.Mx, k.My, 0.0)) @ axle
        wanted += velocity.forward * creeping + pressing - turning * (axle @ omega)
        scale += abs(velocity.forward * k.Fx) + abs(k.Mz * velocity.spin)
    assert s.force @ v + s.moment @ omega == pytest.approx(wanted, abs=1e-11 * max(scale, 80e3))


@pytest.mark.parametrize(("methods", "tolerance"), [(contact.THESIS, 0.02), ({}, 0.001)])
@pytest.mark.parametrize("y", [-6e-3, 0.0, 3e-3, 6.4e-3])
def test_the_power_lost_by_the_motion_is_the_frictional_dissipation(y, methods, tolerance):
    """In steady rolling -(Fx ξ + Fy η + Mz φ) is the frictional energy per metre, within the discretisation of FaStrip.

    The slip of mapped FaStrip follows the given creepages, its forces the effective ones (docs/check/limits.md).
    """
    s = make(**methods).solve(Pose(y=y, yaw=3e-3), load=80e3)
    lost = -sum(c.Fx * c.creepage.longitudinal + c.Fy * c.creepage.lateral + c.Mz * c.creepage.spin for c in s.contacts)
    assert s.power_per_metre > 0.0
    assert lost == pytest.approx(s.power_per_metre, rel=tolerance)


@pytest.mark.parametrize("seed", range(6))
def test_left_is_the_mirror_image_of_right_to_the_last_bit(seed):
    pose, v, r = random_motion(seed)
    right, left = (make(side, conformal=seed > 2) for side in ("right", "left"))
    offset, rail = WheelOffset(1e-4, 1e-3, 2e-4, 1e-3, 0.0, 2e-3), ElasticRail(8e6, 50e6, 1e3, 0.0)
    across = WheelOffset(1e-4, -1e-3, 2e-4, -1e-3, 0.0, -2e-3), ElasticRail(8e6, 50e6, -1e3, 0.0)
    soft = seed % 2 == 1
    a = right.solve(
        pose, v, load=80e3, irregularity=r, friction=FACE, **({"offset": offset, "rail": rail} if soft else {})
    )
    b = left.solve(
        Pose(-pose.y, pose.z, -pose.roll, -pose.yaw),
        Velocity(v.forward, -v.y, v.z, -v.roll, -v.yaw, v.spin),
        load=80e3,
        irregularity=Irregularity(-r.y, r.z, -r.roll, -r.y_rate, r.z_rate, -r.roll_rate),
        friction=FACE,
        **(dict(zip(("offset", "rail"), across, strict=True)) if soft else {}),
    )
    assert b.deflection == (-a.deflection[0], a.deflection[1])
    np.testing.assert_array_equal(b.force, a.force * [1, -1, 1])
    np.testing.assert_array_equal(b.moment, a.moment * [-1, 1, -1])
    np.testing.assert_array_equal(b.damage, a.damage)
    for p, q in zip(a.contacts, b.contacts, strict=True):
        assert (q.N, q.Fx, q.Fy, q.Mx, q.My, q.Mz) == (p.N, p.Fx, -p.Fy, -p.Mx, p.My, -p.Mz)
        assert q.position == (p.position[0], -p.position[1], p.position[2])
        assert (q.angle, q.creepage.lateral, q.creepage.spin) == (-p.angle, -p.creepage.lateral, -p.creepage.spin)


@pytest.mark.parametrize("how", [{"load": 80e3}, {}])
def test_a_displaced_rail_is_a_wheelset_displaced_the_other_way(right, how):
    z = right.pair.touch(Pose(y=2e-3, yaw=0.01)) + 8e-5
    right.forget()
    a = right.solve(Pose(2e-3, z, 0.0, 0.01), Velocity(20.0, 0.1, 0.03), **how)
    rail = Irregularity(-3e-3, -0.2e-3, 0.0, -0.1, -0.03)
    right.forget()
    b = right.solve(Pose(-1e-3, z - 0.2e-3, 0.0, 0.01), Velocity(20.0), irregularity=rail, **how)
    np.testing.assert_allclose(b.force, a.force, rtol=1e-9)
    np.testing.assert_allclose(b.moment, a.moment, rtol=1e-9)
    assert b.z == pytest.approx(a.z - 0.2e-3, abs=1e-12)


def test_lift_off_is_a_valid_result(right):
    of_elements = HalfspacePair(SurfacePair(WHEEL, RAIL)).solve(Pose(z=-1e-4))
    for s in (right.solve(Pose(z=-1e-3)), right.solve(Pose(y=1e-3), load=0.0), of_elements):
        assert s.status is Status.NO_CONTACT
        assert not s.force.any()
        assert not s.moment.any()
        assert not any(s.damage)
        assert s.slip_ratio == s.power_per_metre == s.area == 0.0


def test_interacting_strips_start_from_the_last_call_unless_the_patches_changed():
    pair = make(rail=WORN, normal="strip_halfspace")
    z = pair.solve(Pose(y=3.1e-3), load=80e3).z
    pair.solve(Pose(y=3e-3), load=80e3)
    warm = pair.solve(Pose(y=3.1e-3, z=z))
    pair.forget()
    cold = pair.solve(Pose(y=3.1e-3, z=z))
    assert len(cold.contacts) == 1
    np.testing.assert_allclose(warm.force, cold.force, atol=1e-4 * 80e3)
    assert (warm.force != cold.force).any()
    both = pair.solve(Pose(y=6.385e-3), load=80e3)
    assert len(both.contacts) == 2
    fresh = make(rail=WORN, normal="strip_halfspace").solve(Pose(y=6.385e-3), load=80e3)
    np.testing.assert_array_equal(both.force, fresh.force)


def test_the_number_of_patches_with_their_own_frame_is_limited():
    single = WheelRailPair(Pair(WHEEL, WORN, most_patches=1)).solve(Pose(y=6.385e-3), load=80e3)
    assert len(single.contacts) == 1


@pytest.mark.parametrize("methods", [{}, contact.THESIS])
@pytest.mark.parametrize(("y", "friction"), [(0.0, 0.3), (6.37e-3, 0.3), (7.5e-3, 0.33), (7.5e-3, 0.0)])
def test_normal_and_friction_forces_carry_the_vertical_force_together(y, friction, methods):
    pair, force = make(**methods), 69e3
    motion = Pose(y=y, yaw=5e-3), Velocity(20.0, y=0.1)
    s = pair.solve(*motion, vertical=force, friction=friction)
    assert -s.force[2] == pytest.approx(force, rel=1e-4)
    if friction == 0.0:  # then it is the load of the normal forces, but for ANALYN's share between patches
        by_load = pair.solve(*motion, load=force, friction=0.0)
        assert s.z == pytest.approx(by_load.z, abs=2e-5)


def test_a_vertical_force_with_friction_differs_from_the_load_of_the_normal_forces_on_a_flange():
    pair, force = make(), 69e3
    motion = Pose(y=9e-3, yaw=8e-3), Velocity(20.0)
    by_load = pair.solve(*motion, load=force, friction=0.33)
    assert abs(-by_load.force[2] / force - 1.0) > 0.05
    assert -pair.solve(*motion, vertical=force, friction=0.33).force[2] == pytest.approx(force, rel=1e-4)
