"""Gaps as large as they may be give a finite result or a failure status, never inf or NaN with OK."""

import math

import numpy as np
import pytest

import contact
from contact.kernels.hertz import local_factors

BAD = (contact.Status.OUT_OF_RANGE, contact.Status.NOT_CONVERGED)


@pytest.mark.parametrize("B", [math.nan, math.inf, 0.0, 1e308])
def test_local_factors_are_numbers_whatever_the_curvature(B):
    assert all(map(math.isfinite, local_factors.function(1.0, B) if B else local_factors(1.0, 1e-300)))
    assert all(map(math.isfinite, local_factors(1.0, B if B else 1e-300)))


@pytest.mark.parametrize("tangential", ["fastrip", "fastrip_mapped", "fastsim"])
@pytest.mark.parametrize("size", [1e3, 1e5, 1e7])
def test_a_solution_is_finite_or_its_status_reports_failure(size, tangential):
    y = np.linspace(-1e-2, 1e-2, 101)
    for g in (size * np.abs(y), size * y**2, 1e-2 * size * np.abs(np.sin(1e3 * y))):
        sep = contact.Separation(y, g, 1.0)
        for amount in ({"load": 8e4}, {"approach": 1e-4}):
            sol = contact.solve(sep, contact.Creepage(1e-3, 1e-3, 0.1), tangential=tangential, throw=False, **amount)
            finite = all(map(math.isfinite, (sol.Fx, sol.Fy, sol.Mz, sol.N, sol.approach)))
            assert finite or sol.status in BAD
