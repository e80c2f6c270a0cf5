"""Factors of strips: with them a panel on the exact strips of an ellipse closes its gap."""

import numpy as np
import pytest

from contact import workspace
from contact.kernels.normal.descent import FEWEST, MOST
from contact.kernels.normal.exact import _N_SHEARS, N_EXACT, N_FACTORS


@pytest.mark.parametrize("n", [FEWEST, 21, MOST])
def test_factors_are_near_1_and_mirror_symmetric(n):
    factors = workspace.rule(n, 10, True).exact
    assert factors.shape == (N_EXACT, N_FACTORS, n)
    np.testing.assert_array_equal(factors, factors[:, :, ::-1])
    assert np.isfinite(factors).all()
    assert np.abs(factors[::_N_SHEARS, :2] - 1.0).max() < 0.6 / n  # without shear


def test_factors_tend_to_1_with_the_number_of_strips():
    away = [np.abs(workspace.rule(n, 10, True).exact[:, :2] - 1.0).max(axis=2).mean() for n in (10, 20, 40)]
    assert away[1] < 0.6 * away[0]
    assert away[2] < 0.6 * away[1]


@pytest.mark.parametrize("n", [FEWEST - 1, MOST + 1])
def test_too_few_and_too_many_strips_have_no_factors(n):
    assert workspace.rule(n, 10, True).exact.size == 1
