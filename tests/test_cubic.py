"""The Hermite cubic: value, slope, integral, least points, crossings."""

import pytest

from contact.kernels import cubic


def example(t):
    """Value and slope of a cubic."""
    return 2.0 + t * (-3.0 + t * (1.0 + t * 1.5)), -3.0 + t * (2.0 + t * 4.5)


@pytest.mark.parametrize("h", [1.0, 0.1])
def test_a_cubic_is_reproduced_exactly(h):
    ends = *example(0.0), *example(h)
    for t in (0.0, 0.3, 1.0):
        value, slope = example(t * h)
        assert cubic.value_and_slope(h, *ends, t) == pytest.approx((value, slope), rel=1e-13)
        assert cubic.value(h, *ends, t) == pytest.approx(value, rel=1e-13)
        integral = t * h * (2.0 + t * h * (-1.5 + t * h * (1.0 / 3.0 + t * h * 0.375)))
        assert cubic.integral(h, *ends, t) == pytest.approx(integral, rel=1e-13, abs=1e-300)
        weights = cubic.basis(t)
        numbers = ends[0], h * ends[1], ends[2], h * ends[3]
        assert sum(w * f for w, f in zip(weights, numbers, strict=True)) == pytest.approx(value, rel=1e-13)


def test_the_minimum_inside_is_found():
    ends = *example(0.0), *example(1.0)
    t, f = cubic.interior_minimum(1.0, *ends)
    assert example(t)[1] == pytest.approx(0.0, abs=1e-12)
    assert f == pytest.approx(example(t)[0], rel=1e-13)
    assert cubic.least(1.0, *ends) == (t, f)


def test_the_minimum_of_a_parabola_whose_cubic_term_vanishes():
    assert cubic.interior_minimum(1.0, 1.0, -4.0, 1.0, 4.0) == (0.5, 0.0)


def test_without_a_minimum_inside_the_least_point_is_an_end():
    assert cubic.interior_minimum(1.0, 0.0, 1.0, 1.0, 1.0)[0] == -1.0
    assert cubic.least(1.0, 0.0, 1.0, 1.0, 1.0) == (0.0, 0.0)
    assert cubic.least(1.0, 1.0, -1.0, 0.0, -1.0) == (1.0, 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("level", [0.0, 0.7])
def test_crossing_of_a_rising_and_of_a_falling_cubic(sign, level):
    ends = -sign, 0.5 * sign, 3.0 * sign, 9.0 * sign
    t = cubic.crossing(1.0, *ends, level, 0.0, 1.0)
    assert cubic.value(1.0, *ends, t) == pytest.approx(level, abs=1e-13)
