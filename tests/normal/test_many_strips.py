"""Displacement of a point by many strips at once, against the lookups strip by strip."""

import numpy as np
import pytest

from contact.kernels.normal.influence import anywhere
from contact.kernels.normal.many_strips import displacement, fill_ln_X
from contact.kernels.rows import Pair
from contact.theory import strips


@pytest.fixture(scope="module")
def plane():
    return strips.tables()[1]


@pytest.mark.parametrize("own", [-1, 3])
def test_many_strips_equal_the_lookups_of_each(plane, own):
    rng = np.random.default_rng(1)
    n = 21
    pairs = np.empty((len(Pair), n + 4))
    X = np.append(10 ** rng.uniform(-3, 2, n - 3), [0.0, 3.999, 4.0])  # X = 4 is the border of the table
    low = rng.uniform(-13, 7, n)  # ln t from below the table to beyond it
    high = low + 10 ** rng.uniform(-2, 0.5, n)
    forces = rng.uniform(0.0, 1.0, n)
    expected = 0.0
    for j in range(n):
        near, far = anywhere(plane, X[j], low[j]), anywhere(plane, X[j], high[j])
        expected += forces[j] * (far + near if j == own else far - near)
    pairs[Pair.X, :n], pairs[Pair.LOW, :n], pairs[Pair.HIGH, :n] = X, low, high
    fill_ln_X(n, pairs)
    assert displacement(plane, forces, pairs, own) == pytest.approx(expected, rel=1e-12)


@pytest.mark.nan
def test_a_distance_that_is_no_number_reads_inside_the_table(plane):
    pairs = np.full((len(Pair), 4), np.nan)
    assert not np.isfinite(displacement(plane, np.ones(4), pairs, -1))
