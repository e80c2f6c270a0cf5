"""Steps with given forces, gaps that change, unlike bodies, layers, local friction: CONTACT 25.1 and closed forms."""

import numpy as np
import pytest

import contact
from contact.halfspace import Gap, LocalLaw, Transient
from contact.halfspace.local_law import Warmth
from contact.inputs.material import Thermal

BALL = contact.Material(200e6, 0.42)
BOTH = {"normal": "halfspace", "tangential": "halfspace"}


def ball(**others):
    """Return the ball of CONTACT's example cattaneo."""
    x = (np.arange(-1, 20) - 9.0) * 0.13333e-3
    h = 10.0 * (x**2 + x[:, None] ** 2)
    return Transient(Gap(x, x, h), load=9.1954, friction=0.4, material=BALL, **others)


def test_the_shift_under_a_given_force_is_contacts():
    """CONTACT 25.1, cattaneo.ref_out case 2: FX = -7/8 mu N needs a shift of 8.155e-3 mm, with 45 elements in stick."""
    s = ball().shift(force=(0.875 * 0.4 * 9.1954, 0.0))
    assert s.Fx == pytest.approx(0.875 * 0.4 * 9.1954, rel=1e-7)
    assert s.creepage.longitudinal == pytest.approx(-8.155e-6, rel=1e-4)
    assert int((s.stick & (s.p > 0.0)).sum()) == 45
    assert int((s.p > 0.0).sum()) == 177


def test_a_given_force_and_the_shift_that_it_needs_have_the_same_traction():
    driven, moved = ball(), ball()
    one = driven.shift(force=(-1.5, 2.0))
    other = moved.shift(one.creepage.longitudinal, one.creepage.lateral)
    np.testing.assert_allclose(one.qx, other.qx, atol=1e-5 * one.max_pressure)
    assert (other.Fx, other.Fy) == pytest.approx((-1.5, 2.0), rel=1e-5)
    one = driven.roll(contact.Creepage(), distance=0.13333e-3, force=(2.0, None))
    other = moved.roll(contact.Creepage(one.creepage.longitudinal), distance=0.13333e-3)
    assert other.Fx == pytest.approx(2.0, rel=1e-5)


def test_a_force_beyond_friction_is_unreachable():
    s = ball().shift(force=1.01 * 0.4 * 9.1954)
    assert s.status is contact.Status.UNREACHABLE


def moved_gap(over, *, slope=None, level=None):
    """A ball over the place `over`; slope and level of that file are rounded."""
    x, y = (np.arange(36) - 17.0) * 0.25e-3, (np.arange(35) - 17.0) * 0.25e-3
    slope, level = -5.926 * over if slope is None else slope, 2.963 * over**2 if level is None else level
    return Gap(x, y, 2.963 * (x**2 + y[:, None] ** 2) + slope * x + level)


def test_rolling_by_shifts_of_a_gap_that_moves_is_contacts():
    """CONTACT 25.1, catt_to_cart.ref_out cases 58 to 60, in its units of mm and N: shifts 1.774e-2, 4.548e-4, 4.705e-4 mm."""
    material = contact.Material(1e6, 0.28)
    patch = Transient(moved_gap(0.0), load=0.4705, friction=0.4013, material=material)
    first = patch.shift(force=(0.657 * 0.4013 * 0.4705, None))
    force = (0.657 * 0.4013 * 0.47046, None)  # over the normal force at the approach that the file gives
    gaps = [moved_gap(0.0, slope=a, level=b) for a, b in ((-1.4815e-3, 1.852e-7), (-2.963e-3, 7.407e-7))]
    steps = [patch.shift(force=force, approach=0.07258e-3, gap=gap) for gap in gaps]
    found = [-1e3 * s.creepage.longitudinal for s in (first, *steps)]
    assert found == pytest.approx([1.774e-2, 4.548e-4, 4.705e-4], rel=5e-4)
    assert [int((s.stick & (s.p > 0)).sum()) for s in (first, steps[0])] == [305, 422]


def test_a_grid_that_moves_with_the_gap_changes_nothing():
    material, forces = contact.Material(1e6, 0.28), []
    for window in (0, 3):
        patch = Transient(moved_gap(0.0), load=0.4705, friction=0.4013, material=material)
        patch.shift(1e-5)
        gap = moved_gap(0.5e-3)
        x = gap.x + window * 0.25e-3
        h = 2.963 * ((x - 0.5e-3) ** 2 + gap.y[:, None] ** 2)
        forces.append(patch.shift(2e-6, gap=Gap(x, gap.y, h)).Fx)
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)
    with pytest.raises(contact.ContactError, match="moved by"):
        patch.shift(gap=Gap(x + 0.125e-3, gap.y, h))


def test_what_leaves_the_contact_leaves_its_traction():
    """Half the load in a step: the traction left over outside the smaller contact must not move the rest."""
    whole, less = ball(), ball()
    for patch in (whole, less):
        patch.shift(3e-6)
    less.shift(3e-6, load=4.0)
    assert not less.traction[:, less.pressure == 0.0].any()
    stuck = (np.hypot(*less.traction) < 0.399 * less.pressure) & (less.pressure > 0.0)
    assert stuck.any()
    # in stick the surfaces move as the bodies do
    np.testing.assert_allclose((less.displacement[0] - whole.displacement[0])[stuck], -3e-6, atol=2e-12)


def test_compression_of_unlike_bodies_in_steps_is_contacts():
    """CONTACT 25.1, spence35.ref_out: pressure, approach and work of friction of stages 2 and 4 (units of mm and N)."""
    material = contact.Material.from_pair(1e6, 0.0, 2e11, 0.0)
    x = (np.arange(-1, 12) - 5.0) * 0.2e-3
    gap = Gap(x, x, 4.116 * (x**2 + x[:, None] ** 2))
    patch = Transient(gap, load=1.1e-5, friction=0.2986, material=material)
    steps = [patch.shift(load=load) for load in (1.1e-5, 8.8e-5, 2.96e-4, 7.02e-4)]
    assert steps[3].approach == pytest.approx(1.293e-6, rel=5e-4)
    assert [s.power_per_metre for s in steps[1:]] == pytest.approx([3.184e-13, 1.465e-12, 5.868e-12], rel=5e-4)


def one_element(layer):
    """Return a contact of one element of 1 mm under 900 N on a layer."""
    x, h = (np.arange(3) - 1.0) * 1e-3, np.full((3, 3), 1.0)
    h[1, 1] = 0.0
    return Transient(Gap(x, x, h), load=900.0, friction=0.7, material=contact.Material(82e9, 0.28), layer=layer)


def test_an_element_of_a_third_body_yields_step_by_step_as_in_contact():
    """CONTACT 25.1, plastic_3bl.ref_out cases 2 to 5: 280, 560, 560, 560 N, plastic work .0168 and .028 J."""
    patch = one_element(contact.ThirdBody(20e-6 / 176.63e6, 560e6))
    steps = [patch.shift(c) for c in (3.5e-5, 3.5e-5, 3e-5, 5e-5)]
    assert [-s.Fx for s in steps] == pytest.approx([280.0, 560.0, 560.0, 560.0], abs=0.05)
    assert [s.layer.power_per_metre for s in steps] == pytest.approx([0.0, 0.0, 0.0168, 0.028], abs=2e-5)
    assert [bool(s.layer.plastic.any()) for s in steps] == [False, False, True, True]


def test_hardening_raises_the_yield_stress_of_an_element_by_its_shear():
    k = 4.35e11
    patch = one_element(contact.ThirdBody(20e-6 / 106.25e6, 200e6, k))
    total = 1e-9 / (-patch.shift(1e-9).Fx / 1e-6)  # shift per stress of the element and its layer
    for _ in range(4):
        s = patch.shift(5e-5)
    expected = 200e6 + (2e-4 + 1e-9 - 200e6 * total) * k / (1.0 + k * total)
    assert -s.Fx / 1e-6 == pytest.approx(expected, rel=1e-5)
    assert s.layer.yield_stress.max() == pytest.approx(expected, rel=1e-5)


def test_roll_on_is_the_end_of_rolling():
    separation = contact.Separation.hertzian(1.1, 0.8)
    creepage = contact.Creepage(1e-3, -5e-4, 0.2)
    last = Transient(separation, load=80e3, spacing=0.6e-3).roll_on(creepage)
    steady = contact.solve(separation, creepage, load=80e3, spacing=0.6e-3, **BOTH)
    assert (last.Fx, last.Fy) == pytest.approx((steady.Fx, steady.Fy), rel=1e-4)


def test_a_local_law_is_that_of_the_steady_half_space():
    separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(6e-3)
    law = LocalLaw(0.2, (("exponential", 0.15, 0.05),))
    friction = contact.friction.Friction(0.35, 0.2, half_speed=0.05, law="exponential", velocity="local")
    steady = contact.solve(separation, creepage, load=80e3, friction=friction, spacing=0.8e-3, **BOTH)
    for given in (law, friction):
        found = Transient(separation, load=80e3, friction=given, spacing=0.8e-3).roll_on(creepage)
        assert found.Fx == pytest.approx(steady.Fx, rel=2e-3)


def test_memory_of_friction_follows_the_distance_slipped():
    law = LocalLaw(0.2, (("rational", 0.2, 0.1),), memory_distance=1e-4)
    slip, time = np.full((1, 400), 0.5), 1e-5
    field = law.along_rows(slip, np.ones(slip.shape, dtype=bool), time)[0, ::-1]
    distance = 0.5 * time * np.arange(1, 401)
    at = 0.2 + 0.2 / 6.0
    np.testing.assert_allclose(field, at + (0.4 - at) * np.exp(-distance / 1e-4), rtol=1e-9)


@pytest.mark.parametrize("kind", ["linear", "rational", "rational_square", "exponential"])
def test_a_term_is_halved_at_its_velocity(kind):
    law = LocalLaw(0.1, ((kind, 0.2, 0.3),))
    assert float(law.at(np.array([[0.3]]))[0, 0]) == pytest.approx(0.2)
    assert float(law.static[0, 0]) == pytest.approx(0.3)


def test_falling_friction_has_a_sticking_and_a_sliding_step_as_in_contact():
    """CONTACT 25.1, veldep_fric.ref_out cases 2 and 4: 77 of 81 elements stick, or 34; FX 111600 or 106400 N."""
    x, row = (np.arange(-1, 93) * 0.1 - 4.6) * 1e-3, 0.2
    h = np.full((3, 94), 1.0)
    h[1, 1:-1] = x[1:-1] ** 2 / (2.0 * 0.46)
    gap = Gap(x, np.array([-row, 0.0, row]), h)
    law = LocalLaw(0.18, (("exponential", 0.12, 0.1),))
    stick, force = [], []
    for sliding in (False, True):
        patch = Transient(gap, load=622216.0, friction=law, material=contact.Material(82e9, 0.28), speed=45.0)
        patch.roll_on(contact.Creepage(0.0009999))
        s = patch.roll(contact.Creepage(0.001), distance=1e-4, sliding=sliding)
        assert s.status is contact.Status.OK
        stick.append(int((s.stick & (s.p > 0.0)).sum()))
        force.append(-s.Fx)
    assert stick == [77, 34]
    assert force == pytest.approx([111.6e3, 106.4e3], abs=60.0)


def test_friction_over_the_temperature_is_that_of_the_steady_half_space():
    x, y = (np.arange(42) - 20.5) * 0.5e-3, (np.arange(48) - 23.5) * 0.5e-3
    gap, creepage = Gap(x, y, 1.015 * x**2 + 0.4215 * y[:, None] ** 2), contact.Creepage(0.05)
    friction = contact.friction.Friction(
        0.3, hot_factor=0.4, reference_temperature=293.15, background_temperature=293.15, temperature_range=400.0
    )
    steady = contact.solve(gap, creepage, load=1e5, friction=friction, speed=30.0, **BOTH)
    warmth = Warmth(-0.18, 293.15, 400.0, 293.15, Thermal())
    hot = Transient(gap, load=1e5, friction=LocalLaw(0.3, warmth=warmth), speed=30.0)
    found = hot.roll_on(creepage)
    assert found.Fx == pytest.approx(steady.Fx, rel=2e-3)
    assert -found.Fx < 0.95 * 0.3e5
    with pytest.raises(contact.ContactError, match="a step follows no temperature"):
        hot.roll(creepage, distance=0.5e-3)
    rising = LocalLaw(0.3, warmth=Warmth(0.1, 293.15, 400.0, 293.15, Thermal()))
    assert -Transient(gap, load=1e5, friction=rising, speed=30.0).roll_on(creepage).Fx > 0.3e5


def test_rigid_slip_of_each_element_adds_to_the_motion():
    one, other, lateral = ball(), ball(), 2e-6
    moved = one.shift(3e-6, lateral, 1e-3)
    x, y = other.grid
    slip = np.zeros((2, y.size, x.size))
    slip[0], slip[1] = -1e-3 * y[:, None], lateral + 1e-3 * x
    other.change(slip=slip)
    given = other.shift(3e-6)
    assert (given.Fx, given.Fy, given.Mz) == pytest.approx((moved.Fx, moved.Fy, moved.Mz), rel=1e-6)
    with pytest.raises(contact.ContactError, match="slip has shape"):
        other.change(slip=[1.0])
