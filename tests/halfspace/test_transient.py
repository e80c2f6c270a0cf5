"""Shift and transient rolling: Mindlin's closed form, CONTACT's forces, the steady state, step lengths, errors."""

import math
import warnings

import numpy as np
import pytest

import contact
import reference
from contact.errors import ModelWarning
from contact.halfspace import Gap, Transient, norm, tang

MU, STEEL, N = 0.3, reference.STEEL, 52359.87755983
RADIUS, P0 = 5e-3, 1e9
#: Set I, circ_xi, CONTACT 25.1: shift [m] and creepage of the rail against the wheel; step and force on the rail over mu N.
CIRC_SHIFT, CIRC_CREEPAGE = -6e-06, 0.0008
CIRC_XI = [(0, 0.3412466), (1, 0.3191374), (5, 0.2327168), (10, 0.1298549), (20, -0.0551761)]
B = math.pi * P0 / (4.0 * RADIUS * STEEL.contact_modulus)


def circle(n=32, mu=MU, **others):
    """Return a circle of 5 mm under p0 = 1 GPa on n × n elements over 1.05 of it, as in set I."""
    x = RADIUS * 1.05 * ((2.0 * np.arange(n) + 1.0) / n - 1.0)
    return Transient(Gap(x, x, B * (x**2 + x[:, None] ** 2)), load=N, friction=mu, material=STEEL, **others)


@pytest.mark.parametrize("shift", [1e-6, 4e-6, 8e-6])
def test_a_shift_has_mindlins_force(shift):
    """Cattaneo and Mindlin: F/(mu N) = 1 - (1 - 8 G a W/(3 mu N (2 - nu)))^1.5, to the error of the elements."""
    G, nu = STEEL.shear_modulus, STEEL.poisson_ratio
    left = 1.0 - 8.0 * G * RADIUS * shift / (3.0 * MU * N * (2.0 - nu))
    for lateral in (False, True):
        motion = (0.0, shift) if lateral else (shift, 0.0)
        s = circle().shift(*motion)
        force = -(s.Fy if lateral else s.Fx) / (MU * N)
        assert force == pytest.approx(1.0 - left**1.5, rel=4e-3)
        assert s.status is contact.Status.OK


@pytest.mark.parametrize(("step", "force"), CIRC_XI)
def test_the_forces_of_the_steps_are_contacts(steps_of_circ_xi, step, force):
    assert steps_of_circ_xi[step].Fx / (MU * N) == pytest.approx(-force, abs=2e-6)


@pytest.fixture(scope="module")
def steps_of_circ_xi():
    patch = circle()
    steps = [patch.shift(-CIRC_SHIFT)]
    dx = 2.0 * 1.05 * RADIUS / 32.0
    return steps + [patch.roll(contact.Creepage(-CIRC_CREEPAGE), distance=dx) for _ in range(20)]


def test_rolling_ends_in_the_steady_state():
    """After four lengths of the contact the force is within 1e-3 of steady rolling on the same elements."""
    patch, creepage = circle(), contact.Creepage(6e-4, -4e-4, 0.1)
    x, y = patch.grid
    for _ in range(4 * 31):
        last = patch.roll(creepage, distance=x[1] - x[0])
    p = norm(B * (x**2 + x[:, None] ** 2), x[1] - x[0], x[1] - x[0], STEEL, load=N).p
    steady = tang(p, x, y, creepage, MU, STEEL)
    dA = (x[1] - x[0]) ** 2
    assert (last.Fx, last.Fy) == pytest.approx((steady.qx.sum() * dA, steady.qy.sum() * dA), abs=1e-3 * MU * N)
    assert patch.distance == pytest.approx(4 * 31 * (x[1] - x[0]))


@pytest.mark.parametrize("elements", [0.5, 1.5, 2.0, 3.0])
def test_the_length_of_a_step_matters_little(elements):
    """The force over the distance against that of steps of one element: errors of first order."""
    creepage = contact.Creepage(6e-4)
    x, _ = circle().grid
    dx = float(x[1] - x[0])
    one, other = circle(), circle()
    distance = 12.0 * dx
    fine = [one.roll(creepage, distance=dx) for _ in range(12)][-1]
    coarse = [other.roll(creepage, distance=elements * dx) for _ in range(round(distance / dx / elements))][-1]
    assert coarse.Fx == pytest.approx(fine.Fx, abs=0.02 * MU * N)


@pytest.mark.parametrize(("elements", "told"), [(1.0, False), (3.0, False), (3.2, True), (8.0, True)])
def test_a_step_of_more_than_a_tenth_of_the_contact_is_told_once(elements, told):
    """The contact is 31 elements long; 8 of them in one step are .07 of mu N off, 3 less than .05."""
    patch = circle()
    dx = float(patch.grid[0][1] - patch.grid[0][0])
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        for _ in range(2):
            patch.roll(contact.Creepage(6e-4), distance=elements * dx)
    assert [w.category for w in seen] == [ModelWarning] * told
    assert not told or f"is {elements:.3g} of the 30 elements of the contact's length; with more than 3 " in str(
        seen[0].message
    )


def test_one_element_is_no_long_step_however_few_there_are():
    patch = circle(n=6)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        patch.roll(contact.Creepage(6e-4), distance=2.0 * 1.05 * RADIUS / 6)


def test_a_shift_back_dissipates_and_leaves_traction():
    patch = circle()
    there, back = patch.shift(8e-6), patch.shift(-8e-6)
    assert there.power_per_metre > 0.0
    assert back.power_per_metre > 0.0
    assert abs(back.Fx) < abs(there.Fx)
    assert np.hypot(back.qx, back.qy).max() > 0.1 * MU * P0
    ux, uy = patch.displacement
    assert ux.shape == uy.shape == (32, 32)


@pytest.mark.parametrize("distance", [0.011, 1.0, 1e9])
def test_a_step_longer_than_the_grid_is_refused(distance):
    contact_patch = circle(n=8)
    with pytest.raises(contact.ContactError, match=r"distance = .* is outside the allowed range \]0, 0\.0105\]"):
        contact_patch.roll(contact.Creepage(1e-3), distance=distance)
    assert contact_patch.roll(contact.Creepage(1e-3), distance=0.0105).N > 0.0


def test_traction_leaves_with_the_load():
    """An element without pressure has no traction; full unloading forgets it."""
    patch = circle()
    patch.shift(8e-6)
    less = patch.roll(contact.Creepage(), distance=1e-5, load=0.3 * N)
    assert pytest.approx(0.3 * N, rel=1e-6) == less.N
    assert (np.hypot(less.qx, less.qy) <= MU * less.p * (1.0 + 1e-9)).all()
    assert patch.roll(contact.Creepage(), distance=1e-5, load=0.0).status is contact.Status.NO_CONTACT
    again = patch.roll(contact.Creepage(), distance=1e-5, load=N)
    assert abs(again.Fx) < 1e-9 * N


def test_a_large_shift_slides():
    s = circle().shift(1e-3, 5e-4)
    assert s.status is contact.Status.SATURATED
    assert math.hypot(s.Fx, s.Fy) == pytest.approx(MU * N, rel=1e-4)
    assert s.power_per_metre == pytest.approx(MU * N * math.hypot(1e-3, 5e-4), rel=0.02)


def test_a_separation_and_mirrored_motion():
    separation = contact.Separation.hertzian(1.1, 0.8)
    forces = []
    for sign in (1.0, -1.0):
        patch = Transient(separation, load=80e3, spacing=0.6e-3)
        patch.shift(2e-6, sign * 3e-6, sign * 1e-3)
        s = patch.roll(contact.Creepage(1e-3, sign * 5e-4, sign * 0.2), distance=0.6e-3)
        forces.append((s.Fx, sign * s.Fy, sign * s.Mz))
    np.testing.assert_allclose(forces[0], forces[1], atol=1e-5 * MU * 80e3)
