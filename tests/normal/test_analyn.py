"""ANALYN: load and approach, the locus, robustness of the patch search."""

import functools

import numpy as np
import pytest

import contact

STEEL = contact.STEEL
NO_CREEP = contact.Creepage()
solve = functools.partial(contact.solve, **contact.THESIS)


@pytest.mark.parametrize("normal", list(contact.methods().batched.normal))
def test_approach_gives_the_load_back(normal, ellipse):
    by_load = contact.solve(ellipse, NO_CREEP, load=6e4, normal=normal)
    by_approach = contact.solve(ellipse, NO_CREEP, approach=by_load.approach, normal=normal)
    iterative = contact.methods().batched.normal[normal].interacting
    np.testing.assert_allclose(by_approach.N, 6e4, rtol=1e-4 if iterative else 1e-9)


@pytest.mark.parametrize("normal", list(contact.methods().batched.normal))
@pytest.mark.parametrize("load", [1e-300, 1e-100])
def test_a_load_whose_approach_is_round_off_is_no_contact(normal, load, ellipse):
    """The approach of the smaller load is 0 to the computer, by which the half width was divided: a trap (`make traps`)."""
    sol = contact.solve(ellipse, NO_CREEP, load=load, normal=normal)
    assert sol.status == contact.Status.NO_CONTACT
    assert sol.N == 0.0
    assert sol.strips.y.size == 0


def test_a_patch_narrower_than_the_sampling_is_resolved():
    # semi-width 0.01 mm between samples 1 mm apart, and off the samples
    y = np.linspace(-20e-3, 20e-3, 41) + 0.37e-3
    sol = solve(contact.Separation(y, 3.0 * y**2, 1.0), NO_CREEP, load=1e-3)
    exact = contact.hertz(1.0, 3.0, load=1e-3)
    assert sol.width < 1e-4
    assert sol.max_pressure == pytest.approx(exact.p0, rel=1e-5)


def test_contact_locus_carries_the_strips():
    y = np.linspace(-15e-3, 15e-3, 61)
    shifted = solve(contact.Separation(y, 2 * y**2, 1.0, x_c=0.1 * y), NO_CREEP, load=5e4)
    np.testing.assert_allclose(shifted.strips.x_c, 0.1 * shifted.strips.y, atol=1e-15)
    straight = solve(contact.Separation(y, 2 * y**2, 1.0), NO_CREEP, load=5e4)
    assert shifted.approach == straight.approach
    np.testing.assert_allclose(shifted.x, straight.x + 0.1 * straight.y, atol=1e-15)


def test_pressure_can_be_evaluated_anywhere(ellipse):
    sol = solve(ellipse, NO_CREEP, load=8e4)
    exact = contact.hertz(1.0, 2.0, load=8e4)
    x = np.linspace(-1.2, 1.2, 49)[:, None] * exact.a
    y = np.linspace(-1.2, 1.2, 47)[None, :] * exact.b
    p = exact.p0 * np.sqrt(np.maximum(1 - (x / exact.a) ** 2 - (y / exact.b) ** 2, 0))
    np.testing.assert_allclose(sol.pressure(x, y), p, atol=1e-4 * exact.p0)
    assert sol.pressure(0.0, 0.0) == pytest.approx(exact.p0, rel=1e-6)
