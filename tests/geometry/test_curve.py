"""Cubic segments: value, minimum and root."""

import numpy as np
import pytest
from numba import njit

from contact.kernels.geometry import curve


def cubic(t):
    return 2.0 + t * (-3.0 + t * (1.0 + t * 1.5)), -3.0 + t * (2.0 + t * 4.5)


@pytest.mark.parametrize("h", [1.0, 0.1])
def test_a_cubic_is_reproduced_exactly(h):
    (f0, m0), (f1, m1) = cubic(0.0), cubic(h)
    for t in (0.0, 0.3, 1.0):
        np.testing.assert_allclose(curve.hermite(f0, f1, m0, m1, h, t), cubic(t * h), rtol=1e-13)


def test_least_finds_the_interior_minimum():
    (f0, m0), (f1, m1) = cubic(0.0), cubic(1.0)
    t, f = curve.least(f0, f1, m0, m1, 1.0)
    assert cubic(t)[1] == pytest.approx(0.0, abs=1e-12)
    assert f == pytest.approx(cubic(t)[0], rel=1e-13)


def test_least_of_a_parabola_whose_cubic_term_vanishes():
    t, f = curve.least(1.0, 1.0, -4.0, 4.0, 1.0)
    assert (t, f) == (0.5, 0.0)


def test_least_says_when_there_is_none():
    assert curve.least(0.0, 1.0, 1.0, 1.0, 1.0)[0] == -1.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_root_of_a_rising_and_of_a_falling_cubic(sign):
    t = curve.root(-sign, 3.0 * sign, 0.5 * sign, 9.0 * sign, 1.0, 0.0, 1.0)
    assert curve.hermite(-sign, 3.0 * sign, 0.5 * sign, 9.0 * sign, 1.0, t)[0] == pytest.approx(0.0, abs=1e-13)


def test_kernels_can_be_called_from_kernels():
    @njit
    def caller(table, y):
        return curve.at(table, curve.advance(table, table.shape[1], 0, y), y)[0]

    y = np.linspace(0.0, 1.0, 5)
    assert caller(np.stack((y, y**3, 3.0 * y**2)), 0.6) == pytest.approx(0.216, rel=1e-13)
