"""Exact Hertz contact compared with handbook tables and closed forms."""

import math

import numpy as np
import pytest
from scipy import special

import contact
from contact.kernels.hertz import _elliptic_integrals, coefficients, local_factors

# theta [deg] with cos theta = |A - B|/(A + B), m (major axis), n, r: table of theory.md 1.1, agrees with handbooks
HANDBOOK = [
    (0.5, 60.96898, 0.10219, 0.08121),
    (5, 11.23806, 0.23814, 0.29689),
    (20, 3.81601, 0.41215, 0.60384),
    (45, 1.92646, 0.60383, 0.85471),
    (70, 1.28507, 0.79990, 0.97264),
    (85, 1.06087, 0.94422, 0.99831),
    (90, 1.0, 1.0, 1.0),
]


@pytest.mark.parametrize(("theta", "m", "n", "r"), HANDBOOK)
def test_coefficients_equal_the_handbook_table(theta, m, n, r):
    c = math.cos(math.radians(theta))
    ours = coefficients((1 - c) / 2, (1 + c) / 2)
    np.testing.assert_allclose(ours, (m, n, r), atol=1.01e-5, err_msg="Hertz coefficients, printed digits")


@pytest.mark.parametrize("g", [1e-6, 1e-3, 0.1, 0.5, 0.9, 0.9995, 1.0])
def test_elliptic_integrals_equal_scipy(g):
    K, E, B, D = _elliptic_integrals(g)
    k2 = (1 - g) * (1 + g)
    np.testing.assert_allclose((K, E), (special.ellipkm1(g * g), special.ellipe(k2)), rtol=1e-14)
    np.testing.assert_allclose(B + D, K, rtol=1e-12, err_msg="B + D = K")
    np.testing.assert_allclose(g * g * D + B, E, rtol=1e-9, err_msg="B + g² D = E")


def test_local_factors_equal_the_exact_root_find():
    for u in np.linspace(-13.0, 13.0, 157):
        A, B = 2.0, 2.0 * math.exp(u)
        m, n, r = coefficients(A, B)
        exact = (r * (A + B) / (A * m * m), r * (A + B) / (B * n * n), n * r, math.log(m / n))
        np.testing.assert_allclose(local_factors(A, B), exact, rtol=2e-7, atol=2e-8, err_msg=f"ln(B/A) = {u}")


@pytest.mark.parametrize("B", [0.3, 1.0, 20.0])
def test_load_and_approach_are_inverse(B):
    by_load = contact.hertz(1.0, B, load=8e4)
    by_approach = contact.hertz(1.0, B, approach=by_load.approach)
    assert pytest.approx(8e4, rel=1e-12) == by_approach.N
    assert by_approach.a == pytest.approx(by_load.a, rel=1e-12)
    assert by_load.p0 == pytest.approx(1.5 * 8e4 / (math.pi * by_load.a * by_load.b), rel=1e-12)


def test_line_contact_limit():
    # peak pressure of a very long ellipse over its middle: p0 = a E*/(2R), R = 1/(2A) (theory.md 1.1)
    line = contact.hertz(1.0, 1e-6, load=5e4)
    assert line.p0 == pytest.approx(line.a * contact.STEEL.contact_modulus, rel=2e-5)
