"""`slip_ratio` and the elements that fields show as slipping are one answer."""

import numpy as np
import pytest

import contact

SEPARATION = contact.Separation.hertzian(1.0, 1.0)


def of_elements(sol):
    """Share of the area that its elements show as slipping; each stands for the length between its edges."""
    n = sol.stick.shape[1]
    edges = np.cos(np.arange(n + 1) * np.pi / n)
    area = sol.strips.a[:, None] * (edges[:-1] - edges[1:]) * sol.strips.dy[:, None]
    return (area * ~sol.stick).sum() / area.sum()


@pytest.mark.parametrize("tangential", ["fastrip", "strip_theory", "fastrip_mapped", "fastsim"])
def test_slip_ratio_is_the_share_of_elements_that_slip(tangential):
    """Lateral creepage against spin, where particles stick again: the share was up to .2 above that of the elements."""
    for lateral in (-2e-3, -1e-3, 0.0, 1e-3):
        for spin in (0.3, 0.8, 1.5):
            c = contact.Creepage(2e-4, lateral, spin)
            sol = contact.solve(SEPARATION, c, load=8e4, tangential=tangential, n_elements=100)
            assert sol.slip_ratio == pytest.approx(of_elements(sol), abs=0.012)


def test_it_changes_smoothly():
    ratios = [
        contact.solve(SEPARATION, contact.Creepage(2e-4, y, 0.8), load=8e4, tangential="fastrip").slip_ratio
        for y in np.linspace(-2.2e-3, -1.8e-3, 81)
    ]
    assert np.abs(np.diff(ratios)).max() < 5e-3
