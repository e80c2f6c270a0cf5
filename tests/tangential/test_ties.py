"""Ties between strips: one shape on an ellipse, more where a patch has a neck or a shoulder, and nothing jumps between."""

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
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
    assert np.all(strips[Strip.TIE, 1:] == 1.0)
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
    assert shares[-1] < 0.1  # a neck of less than half the length counts as half


def test_a_shoulder_is_a_shape_of_its_own_though_it_has_no_neck():
    y, strips = strips_of(lambda y: np.where(y < -0.5, 1.0, 0.3) * np.sqrt(1.0 - y**2))
    share_shape(strips, 0, 20, 1)
    assert np.all(strips[Strip.SHARE, y > 0.5] < 0.05)
    assert np.all(strips[Strip.SHARE, y < -0.5] > 0.9)


def two_circles(gap, ahead=0.0):
    """Return strips of two patches, circles with a radius of 1 cm, a `gap` [cm] apart; one lies `ahead` of the other."""
    strips = np.zeros((len(Strip), 40))
    y = (np.arange(20) + 0.5) * 0.1 - 1.0
    for k, side in enumerate((-1.0, 1.0)):
        one = slice(20 * k, 20 * k + 20)
        strips[Strip.Y, one], strips[Strip.A, one] = 1e-2 * (side * (1.0 + 0.5 * gap) + y), 1e-2 * np.sqrt(1.0 - y**2)
        strips[Strip.XC, one], strips[Strip.PATCH, one] = 0.5e-2 * side * ahead, k
    strips[Strip.DY] = 1e-3
    tie_strips(strips, 0, 40)
    return strips


def test_patches_are_tied_the_less_the_wider_their_gap_is_and_not_at_all_beyond_half_of_their_length():
    shares = []
    for gap in (0.0, 0.1, 0.3, 0.6, 0.9, 1.01, 3.0):
        strips = two_circles(gap)
        share_shape(strips, 0, 40, 10)
        shares.append((strips[Strip.SHARE, 30], strips[Strip.SHARE, 19]))
    shares = np.array(shares)
    assert np.all(np.diff(shares[:6, 0]) < 0.0)
    assert shares[0, 0] > 0.05
    assert np.all(shares[5:] == (0.0, 1.0))  # and each is one shape, as alone


def test_patches_that_lie_ahead_of_one_another_are_tied_less_than_patches_side_by_side():
    ties = [two_circles(0.2, ahead)[Strip.TIE, 20] for ahead in (0.0, 1.0, 2.0)]
    assert np.all(np.diff(ties) < -0.01)


@pytest.mark.parametrize("gap", [-0.1, -0.5, -2.0])
def test_patches_that_lie_in_each_other_are_not_tied(gap):
    """Ellipses of `multi_hertz` overlap, and two strips may lie at one y, by whose distance slopes are divided."""
    assert two_circles(gap)[Strip.TIE, 20] == 0.0


def test_patches_that_touch_have_the_ties_of_one_patch():
    strips = two_circles(0.0)
    apart = strips[Strip.TIE].copy()
    strips[Strip.PATCH] = 0.0
    tie_strips(strips, 0, 40)
    assert apart[1:] == pytest.approx(strips[Strip.TIE, 1:], abs=1e-12)


def test_strips_of_no_length_leave_everything_finite():
    _, strips = strips_of(lambda y: np.where(abs(y) < 0.3, 0.0, np.sqrt(1.0 - y**2)))
    for i in range(20):
        share_shape(strips, 0, 20, i)
        assert np.isfinite(strips).all()


def steps(separation, loads):
    """Return the steps of the force over mu N from load to load, and the numbers of patches."""
    solver, slip = contact.Solver(), contact.Creepage(1.5e-3, 1e-3, 0.2)
    answers = [solver.solve(separation, slip, load=load) for load in loads]
    forces = np.array([(s.Fx, s.Fy) for s in answers]) / (0.3 * loads[:, None])
    return np.hypot(*np.diff(forces, axis=0).T), [s.n_patches for s in answers]


@pytest.mark.parametrize(
    ("ahead", "loads", "patches", "most"),
    [
        (0.0, np.geomspace(200e3, 260e3, 24), [2, 1], 0.0035),
        (2e-3, np.geomspace(240e3, 420e3, 48), [2, 1], 0.004),
        (5e-3, np.geomspace(60e3, 130e3, 48), [2, 2], 0.008),
    ],
)
def test_forces_hardly_jump_where_two_lobes_on_a_thin_ridge_become_one_patch(ahead, loads, patches, most):
    """The jumps were .130, .041 and .022 of mu N: ties ended with a patch, and both lobes had the turn of the whole patch."""
    y = np.linspace(-12e-3, 12e-3, 481)
    one, other = 7.0 * (y + 1.45e-3) ** 2 + 14e-6, 8.0 * (y - 1.45e-3) ** 2
    g = np.minimum(one, other) - 3e-6 * np.log1p(np.exp(-np.abs(one - other) / 3e-6))
    middles = 0.5 * ahead * (1.0 + np.tanh(y / 1e-3))
    found, numbers = steps(contact.Separation(y, g - g.min(), np.full(y.size, 1.1), middles), loads)
    assert [numbers[0], numbers[-1]] == patches
    assert found.max() < most


def test_a_patch_that_parts_with_more_strips_has_the_same_forces():
    """20 strips were one patch, 40 and 80 two. They were .07 of mu N off 20 strips and the half space."""
    pair = Pair(profile.load("EN 15302 H", "wheel"), profile.load("55E1", "rail", inclination="1:20"))
    patch = max(pair.contacts(Pose(y=6.325e-3), load=72e3), key=lambda one: one.load)
    slip, given = contact.Creepage(1.5e-3, 1e-3, 0.2), {"load": patch.load, "throw": False}
    found = [contact.solve(patch.separation, slip, n_strips=n, **given) for n in (20, 40, 80)]
    assert [s.n_patches for s in found] == [2, 2, 2]
    forces = np.array([(s.Fx, s.Fy) for s in found]) / (0.3 * patch.load)
    assert np.hypot(*(forces[1:] - forces[0]).T).max() < 0.002
    assert np.hypot(*(forces - (-0.5337, -0.5722)).T).max() < 0.02  # 120 x 120 elements


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
