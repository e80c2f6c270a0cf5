"""The example of a wheelset with the contact inside an implicit integrator (docs/use/implicit.md)."""

import numpy as np
import pytest

from examples.implicit.wheelset import UNITS, Wheelset, a_step_late, by_scipy, fixed_steps

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheelset():
    return Wheelset()


def test_the_jacobian_is_that_of_the_rates(wheelset):
    x = wheelset.start() + np.array([1e-3, 2e-6, 1e-5, 1e-3, 0.02, 1e-3, 0.01, 0.01, 0.02])
    for pair in wheelset.pairs:
        pair.arrays.case["tolerance"] = 1e-10
    found = wheelset.jacobian(0.02, x)
    steps = 1e-5 * UNITS * np.array([1.0, 0.1, 0.1, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    for k, step in enumerate(steps):
        move = np.zeros(9)
        move[k] = step
        wanted = (wheelset.rates(0.02, x + move) - wheelset.rates(0.02, x - move)) / (2.0 * step)
        assert found[:, k] == pytest.approx(wanted, abs=1e-2 * np.abs(wanted).max() + 1e-9), k
    for pair in wheelset.pairs:
        pair.arrays.case["tolerance"] = 0.0


def test_long_steps_are_stable_and_near_short_ones(wheelset):
    short, long = fixed_steps(wheelset, 0.1, 1e-3), fixed_steps(wheelset, 0.1, 5e-3)
    assert short.size == 100
    assert long == pytest.approx(short[4::5], abs=2e-5)


def test_scipy_with_the_jacobian_takes_long_steps(wheelset):
    wheelset.calls = wheelset.jacobians = 0
    found = by_scipy(wheelset, 0.1, wheelset.jacobian, 1e-3)
    assert found.success
    assert wheelset.jacobians < 30
    assert found.y[0, -1] == pytest.approx(fixed_steps(wheelset, 0.1, 1e-3)[-1], abs=1e-5)


def test_forces_a_step_late_are_unstable(wheelset):
    assert a_step_late(wheelset, 0.1, 1e-3).size < 100
