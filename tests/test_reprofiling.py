"""The example that cuts a worn wheel by the gradient of pressure and conicity (docs/use/implicit.md)."""

import numpy as np
import pytest

from examples.reprofiling.optimise import Goal, N, optimise


@pytest.fixture(scope="module")
def goal():
    return Goal()


def test_the_gradient_is_that_of_the_goal(goal):
    """Elements that come into contact leave two per cent of one of them."""
    c = 0.1 + 0.02 * np.sin(np.arange(N))
    _, slope = goal(c)
    for k in (2, 3, 9, 10, 13):
        ends = [goal(c + sign * 1e-3 * (np.arange(N) == k), False)[0] for sign in (1.0, -1.0)]
        assert (ends[0] - ends[1]) / 2e-3 == pytest.approx(slope[k], rel=0.03)


@pytest.mark.slow
def test_ten_steps_make_the_wheel_better(goal):
    worn, goal.solutions = goal(np.zeros(N), False)[0], 0
    found = optimise(goal, True, 10)
    assert found.fun < 0.9 * worn
    assert goal.solutions < 9 * 40
    assert (found.x >= 0.0).all()
