"""Kalker's coefficients: published table, smooth continuation, and boundary-element values outside the table."""

import math

import numpy as np
import pytest

from contact.theory import kalker


@pytest.mark.parametrize(("ratio", "nu", "row"), [
    (0.1, 0.25, (3.31, 2.52, 0.473, 8.28)),
    (0.8, 0.25, (3.91, 3.41, 1.25, 1.37)),  # C23 is 1.15 in a copy in USETAB's generator, which is a misprint (theory.md 1.2)
    (1.0, 0.0, (3.40, 3.40, 1.33, 1.21)),
    (1.0, 0.25, (4.12, 3.67, 1.47, 1.19)),
    (1 / 0.3, 0.5, (7.34, 7.51, 5.01, 0.446)),
    (10.0, 0.25, (11.7, 12.8, 14.6, 0.526)),
])  # fmt: skip
def test_published_rows_are_reproduced(ratio, nu, row):
    np.testing.assert_allclose(kalker.coefficients(kalker.table(nu), math.log(ratio)), row, rtol=3e-4)


def test_c33_at_large_aspect_agrees_with_boundary_elements():
    # theory.md 1.2: at a/b = 10, nu = 0.28 the boundary-element value is .500; the reciprocal parabola gives .476
    assert kalker.coefficients(kalker.table(0.28), math.log(10.0))[3] == pytest.approx(0.500, abs=0.010)


def test_coefficients_are_smooth_in_the_aspect_ratio():
    # CONTACT's piecewise table jumps by up to 5 % at a/b = 0.1 and 10 (theory.md 1.2); ours must not
    grid = np.linspace(-3.9, 3.9, 4001)
    values = np.log([kalker.coefficients(kalker.table(0.28), u) for u in grid])
    assert np.abs(np.diff(values, axis=0)).max() < 0.0035, "a jump between neighbouring aspect ratios"


def test_aspect_ratio_is_clamped_without_nan():
    table = kalker.table(0.28)
    assert kalker.coefficients(table, 100.0) == kalker.coefficients(table, kalker.LOG_ASPECT_MAX)
    assert np.isfinite(kalker.coefficients(table, -100.0)).all()
