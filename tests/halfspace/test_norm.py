"""NORM: influence functions, order of convergence, conditions of contact on rough gaps (CONTACT's patches: test_tang.py)."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad

import contact
from contact.halfspace import influence, norm


def paraboloid(A, B, half_x, half_y, n):
    """Return the gap A x² + B y² on n × n elements over ±half_x, ±half_y, and the size of an element."""
    s = (np.arange(n) + 0.5) * 2.0 / n - 1.0
    return B * (half_y * s[:, None]) ** 2 + A * (half_x * s) ** 2, 2.0 * half_x / n, 2.0 * half_y / n


@pytest.mark.parametrize(("X", "Y"), [(1.3, 0.0), (-0.9, 1.4), (3.0, -2.0)])
def test_influence_integrals_equal_quadrature(X, Y):
    exact = [
        dblquad(lambda t, s, f=f: f(X - s, Y - t), -0.5, 0.5, -0.35, 0.35, epsabs=1e-11)[0]
        for f in (
            lambda x, y: x * x / math.hypot(x, y) ** 3,
            lambda x, y: y * y / math.hypot(x, y) ** 3,
            lambda x, y: x * y / math.hypot(x, y) ** 3,
        )
    ]
    np.testing.assert_allclose(influence.integrals(X, Y, 1.0, 0.7), exact, rtol=1e-9, atol=1e-12)


def test_convolution_equals_the_sum_over_all_elements():
    shape, dx, dy = (6, 9), 0.5e-3, 0.3e-3
    p = np.random.default_rng(1).random(shape)
    y, x = (v.ravel() for v in np.meshgrid(np.arange(6) * dy, np.arange(9) * dx, indexing="ij"))
    I1, I2, _ = influence.integrals(x[:, None] - x, y[:, None] - y, dx, dy)
    direct = (I1 + I2) @ p.ravel() / (math.pi * contact.STEEL.contact_modulus)
    half_space = influence.Influence(shape, dx, dy, contact.STEEL)
    np.testing.assert_allclose(half_space.normal(p).ravel(), direct, rtol=1e-13)
    lone = np.zeros(shape)
    lone[0, 0] = 1.0
    assert half_space.own == pytest.approx(half_space.normal(lone)[0, 0], rel=1e-13)


def test_error_falls_with_the_element_size():
    """The load at given approach converges with an order above 1.5, while the edge moves through the grid."""
    exact = contact.hertz(2.0, 6.0, load=6e4)
    errors = []
    for n in (12, 24, 48, 96):
        gap, dx, dy = paraboloid(2.0, 6.0, 1.25 * exact.a, 1.25 * exact.b, n)
        errors.append(abs(norm(gap, dx, dy, contact.STEEL, approach=exact.approach).p.sum() * dx * dy / 6e4 - 1))
    assert errors[-1] < 2e-4
    assert np.log2(errors[0] / errors[-1]) / 3 > 1.5


def test_contact_conditions_hold_on_a_rough_gap():
    """p ≥ 0, e ≥ 0 and p·e = 0 hold on a gap with many separate patches for any start."""
    rng = np.random.default_rng(3)
    gap, dx, dy = paraboloid(2.0, 3.0, 9e-3, 9e-3, 60)
    gap = (
        gap + 8e-6 * np.cos(np.arange(60) * 0.9)[:, None] * np.cos(np.arange(60) * 1.1) + rng.normal(0, 1e-6, (60, 60))
    )
    found = norm(gap, dx, dy, contact.STEEL, load=5e4)
    e = gap - found.approach + influence.Influence(gap.shape, dx, dy, contact.STEEL).normal(found.p)
    assert found.converged
    assert (found.p >= 0).all()
    assert e.min() > -1e-5 * found.approach
    assert np.abs(e[found.p > 0]).max() < 1e-5 * found.approach
    start = rng.random((60, 60)) * found.p.max()
    other = norm(gap, dx, dy, contact.STEEL, load=5e4, start=start)
    np.testing.assert_allclose(other.p, found.p, atol=1e-4 * found.p.max())


@pytest.mark.parametrize("load", [1e-6, 1e-2, 1.0, 30.0, 3e3])
def test_any_load_is_carried_by_a_rough_gap(load):
    """This begins with one element in contact, where divisors could vanish."""
    rng = np.random.default_rng(5)
    gap, dx, dy = paraboloid(2.0, 3.0, 4e-3, 4e-3, 30)
    gap = gap + rng.normal(0, 2e-6, gap.shape)
    found = norm(gap, dx, dy, contact.STEEL, load=load)
    assert found.converged
    assert found.p.sum() * dx * dy == pytest.approx(load, rel=1e-12)
    assert found.approach > gap.min()


def test_no_overlap_and_no_load_give_no_pressure():
    gap, dx, dy = paraboloid(2.0, 3.0, 8e-3, 8e-3, 20)
    for given in ({"approach": -1e-6}, {"load": 0.0}, {"load": 1e-100}):
        found = norm(gap, dx, dy, contact.STEEL, **given)
        assert not found.p.any()
        assert found.converged
