"""Ties between strips: one shape on an ellipse, more where a patch has a neck or a shoulder, and nothing jumps between."""

import numpy as np
import pytest

import contact
from contact.kernels.rows import Strip
from contact.kernels.tangential.ties import share_shape, tie_strips


def strips_of(half_length, n=20):
    """Return strips of equal width [m] over -1 cm … 1 cm with the half lengths of a function of y in cm."""
    strips = np.zeros((len(Strip), n))
    y = (np.arange(n) + 0.5) * 2.0 / n - 1.0
    strips[Strip.Y], strips[Strip.DY], strips[Strip.A] = 1e-2 * y, 2e-2 / n, 1e-2 * half_length(y)
    tie_strips(strips, 0, n)
    return y, strips


def lobes(y, neck):
    """Return the square of an ellipse less a dent in its middle, down to `neck` there."""
    return np.sqrt(np.maximum((1.0 - y**2) - (1.0 - neck**2) * np.exp(-((y / 0.35) ** 2)), 0.0))


@pytest.mark.parametrize("n", [4, 20, 41])
def test_an_ellipse_is_one_shape(n):
    _, strips = strips_of(lambda y: np.sqrt(1.0 - y**2), n)
    assert np.all(strips[Strip.TIE] == 1.0)
    share_shape(strips, 0, n, n // 2)
    assert np.all(strips[Strip.SHARE] == 1.0)


def test_strips_beyond_a_neck_have_a_smaller_share_the_narrower_it_is():
    shares = []
    for neck in (0.99, 0.7, 0.4, 0.1):
        y, strips = strips_of(lambda y, neck=neck: lobes(y, neck))
        share_shape(strips, 0, 20, 2)
        assert np.all(np.diff(strips[Strip.SHARE, 2:]) <= 0.0)
        assert np.all(strips[Strip.SHARE, y < -0.7] > 0.99)
        shares.append(strips[Strip.SHARE, 17])
    assert np.all(np.diff(shares) < 0.0)
    assert shares[0] > 0.8
    assert shares[-1] < 0.01


def test_a_shoulder_is_a_shape_of_its_own_though_it_has_no_neck():
    y, strips = strips_of(lambda y: np.where(y < -0.5, 1.0, 0.3) * np.sqrt(1.0 - y**2))
    share_shape(strips, 0, 20, 1)
    assert np.all(strips[Strip.SHARE, y > 0.5] < 0.05)
    assert np.all(strips[Strip.SHARE, y < -0.5] > 0.9)


def test_strips_of_no_length_leave_everything_finite():
    _, strips = strips_of(lambda y: np.where(abs(y) < 0.3, 0.0, np.sqrt(1.0 - y**2)))
    for i in range(20):
        share_shape(strips, 0, 20, i)
        assert np.isfinite(strips).all()


def test_forces_hardly_jump_where_a_neck_closes_and_two_patches_remain():
    """The jump was .024 of mu N when all strips of a patch had one equivalent ellipse."""
    solver, y = contact.Solver(), np.linspace(-15e-3, 15e-3, 301)

    def solved(dent):
        g = y**2 / 0.6 + dent * np.exp(-(((y - 1e-3) / 2.5e-3) ** 2)) + 4.0 * np.maximum(y - 4e-3, 0.0) ** 2
        return solver.solve(contact.Separation(y, g - g.min(), 1.1), contact.Creepage(6e-4, 4e-4, -0.4), load=60e3)

    dents = np.arange(42e-6, 45e-6, 0.15e-6)
    answers = [solved(dent) for dent in dents]
    patches = [s.n_patches for s in answers]
    assert patches[0] == 1
    assert patches[-1] == 2
    forces = np.array([(s.Fx, s.Fy) for s in answers]) / (0.3 * 60e3)
    assert np.hypot(*np.diff(forces, axis=0).T).max() < 0.0045
