"""Fixed points of maps on which the plain iteration diverges."""

import numpy as np
import pytest

from contact_models.wheelset.iteration import fixed_point

UNIT = np.ones(4)


def test_steep_linear_map_is_solved_in_as_many_evaluations_as_it_has_directions():
    """The slopes are up to -40. The solution takes one initial evaluation, one for each direction and one to confirm."""
    rng = np.random.default_rng(4)
    frame = np.linalg.qr(rng.normal(size=(4, 4)))[0]
    slope, shift = frame @ np.diag([-40.0, -12.0, 0.0, 0.0]) @ frame.T, rng.normal(size=4)
    x, evaluations = fixed_point(lambda x: slope @ x + shift, np.zeros(4), UNIT, 1e-9, 20)
    assert x == pytest.approx(np.linalg.solve(np.eye(4) - slope, shift), abs=1e-8)
    assert evaluations <= 5


def test_result_is_measured_in_the_units_given():
    """The same map in other units takes the same path."""
    unit = np.array([1e5, 1e-4, 1.0, 1e3])
    slope = -3.0 * np.eye(4)
    plain, n = fixed_point(lambda x: slope @ x + 1.0, np.zeros(4), UNIT, 1e-9, 20)
    scaled, m = fixed_point(lambda x: slope @ x + unit, np.zeros(4), unit, 1e-9, 20)
    assert scaled == pytest.approx(plain * unit)
    assert n == m


def test_iteration_stops_for_a_map_without_a_fixed_point():
    x, evaluations = fixed_point(lambda x: np.where(x > 0.0, -1.0, 1.0), np.zeros(4), UNIT, 1e-9, 7)
    assert evaluations == 8
    assert np.isfinite(x).all()
