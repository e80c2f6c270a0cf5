"""Panels of lobes: they meet at a ridge of the gap, so strips do not jump where a neck between lobes closes."""

import numpy as np
import pytest

import contact

CREEPAGE = contact.Creepage(1.5e-3, 1e-3, 0.2)
Y = np.linspace(-12e-3, 12e-3, 961)


def lobes(distance, deeper, width):
    """Return two parabolas `distance` [m] apart, one `deeper` by some metres, on a ridge that is rounded over `width` [m]."""
    one, other = 7.0 * (Y + 0.5 * distance) ** 2 + deeper, 8.0 * (Y - 0.5 * distance) ** 2
    g = np.minimum(one, other) - width * np.log1p(np.exp(-np.abs(one - other) / width))
    return contact.Separation(Y, g - g.min(), 1.1)


@pytest.mark.parametrize(
    ("distance", "deeper", "width", "loads"),
    [
        (2.9e-3, 3e-6, 1e-6, (50e3, 60e3, 80e3, 120e3, 200e3)),
        (2.9e-3, 3e-6, 3e-6, (50e3, 80e3, 120e3, 300e3, 400e3)),
        (4e-3, 14e-6, 1e-6, (80e3, 90e3, 150e3, 300e3)),
    ],
)
def test_lobes_have_the_strips_of_a_finer_solution_before_and_after_their_neck_closes(distance, deeper, width, loads):
    """One panel of 20 strips over both had 4.7 % more area, and forces .015 of mu N off."""
    separation = lobes(distance, deeper, width)
    for load in loads:
        few, many = (contact.solve(separation, CREEPAGE, load=load, n_strips=n) for n in (20, 80))
        assert few.area == pytest.approx(many.area, rel=0.006)
        assert few.n_patches == many.n_patches
        assert few.max_pressure == pytest.approx(many.max_pressure, rel=0.002)
        assert np.hypot(few.Fx - many.Fx, few.Fy - many.Fy) < 0.0025 * 0.3 * load


def test_a_patch_with_a_neck_has_two_panels_that_meet_on_the_ridge():
    solution = contact.solve(lobes(2.9e-3, 3e-6, 3e-6), CREEPAGE, load=350e3)
    strips = solution.strips
    ends = strips.y + 0.5 * strips.dy
    assert (solution.n_patches, len(strips.y)) == (1, 40)
    np.testing.assert_allclose(ends[:-1], strips.y[1:] - 0.5 * strips.dy[1:], atol=1e-12)
    ridge = Y[np.argmax(np.where(np.abs(Y) < 1e-3, lobes(2.9e-3, 3e-6, 3e-6).g, 0.0))]
    assert ends[19] == pytest.approx(ridge, abs=2e-5)
    assert strips.dy[19] < 0.1 * strips.dy[10]


def test_shallow_ridges_leave_a_patch_whole():
    """Below .02 of the approach one panel does as well."""
    for height, strips in ((8e-6, 20), (25e-6, 40)):  # ridges of .015 and .12 of the approach
        g = 4.0 * Y**2 + height * np.exp(-((Y / 1e-3) ** 2))
        separation = contact.Separation(Y, g - g.min(), 1.1)
        assert len(contact.solve(separation, CREEPAGE, load=100e3).strips.y) == strips


def test_a_rough_gap_with_more_ridges_than_panels_stays_whole():
    g = 0.5 * Y**2 + 3e-6 * np.cos(2.0 * np.pi * Y / 1e-3)
    solution = contact.solve(contact.Separation(Y, g - g.min(), 1.1), CREEPAGE, load=80e3, throw=False)
    assert len(solution.strips.y) <= 20


def test_forces_of_lobes_do_not_jump_though_their_panels_begin_to_be_near():
    """Beside a near panel a polynomial through six strips swings: lobes ahead of each other had steps of .017 of mu N."""
    separation = lobes(2.9e-3, 14e-6, 3e-6)
    ahead = contact.Separation(Y, separation.g, np.full(Y.size, 1.1), 2.5e-3 * (1.0 + np.tanh(Y / 1e-3)))
    solutions = [contact.solve(ahead, CREEPAGE, load=load) for load in np.geomspace(100e3, 125e3, 16)]
    forces = np.array([(s.Fx, s.Fy) for s in solutions]) / np.geomspace(100e3, 125e3, 16)[:, None] / 0.3
    assert np.hypot(*np.diff(forces, axis=0).T).max() < 0.006
    assert max(s.iterations for s in solutions) < 30
