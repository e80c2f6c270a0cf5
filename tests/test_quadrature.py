"""Positions and weights of strips and elements."""

import math

import numpy as np
import pytest

from contact.instance import workspace
from contact.kernels import quadrature
from contact.kernels.rows import Element


@pytest.mark.parametrize("n", [1, 2, 3, 4, 7, 40, 41, 1000])
def test_points_on_the_circle_are_those_of_libm(n):
    """They agree with libm to one digit, since its angle is rounded. They are exact on the axes and exactly symmetric."""
    for k in range(0, 2 * n + 1):
        cosine, sine = quadrature.on_circle(k, n)
        angle = math.pi * k / n
        assert cosine == pytest.approx(math.cos(angle), abs=4e-16 * max(1.0, angle))
        assert sine == pytest.approx(math.sin(angle), abs=4e-16 * max(1.0, angle))
        assert (cosine, sine) == quadrature.on_circle(k + 2 * n, n)
        assert (cosine, -sine) == quadrature.on_circle(2 * n - k, n)
    assert quadrature.on_circle(0, n) == (1.0, 0.0)
    assert quadrature.on_circle(n, 2 * n) == (0.0, 1.0)


@pytest.mark.parametrize("n", [4, 5, 30, 41, 1000])
def test_fejer_integrates_polynomials_and_elements_the_semi_ellipse(n):
    nodes, weights = workspace.rule(n, 4, False).across
    for power in range(0, min(n, 9), 2):
        assert weights @ nodes**power == pytest.approx(2.0 / (power + 1), rel=1e-14)
    elements = workspace.rule(4, n, False).elements
    s = elements[Element.S]
    assert elements[Element.SINE] @ elements[Element.DX] == pytest.approx(0.5 * math.pi, rel=1e-14)
    assert elements[Element.LOAD_END, -1] == pytest.approx(0.5 * math.pi, rel=1e-14)
    np.testing.assert_allclose(
        elements[Element.ATANH, 1:], np.arctanh(s[:-1]) - np.arctanh(s[1:]), rtol=1e-11, atol=1e-13
    )
