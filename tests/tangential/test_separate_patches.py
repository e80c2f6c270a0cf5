"""Separate patches roll independently: two patches have the forces of each one alone, referred to one origin.

`fastrip_mapped` is the exception (`test_pulls.py`).
"""

import numpy as np
import pytest

import contact

METHODS = [name for name in contact.methods().batched.tangential if name != "fastrip_mapped"]
APART, APPROACH = 15e-3, 6e-5  # [m] distance of each patch from the origin; approach of the bodies
SAMPLES = np.linspace(-APART, APART, 241)
SMALL, LARGE = 1e-5, 2e-3
SOFT = contact.friction.Friction(0.3, slope=0.54, slope_far=0.02, slope_rate=0.64)


def separation(centres, stretch):
    """Return parabolas about `centres`. Those on the right are `stretch` times as steep."""
    g = [np.where(np.array(c) > 0.0, stretch, 1.0) * 3.0 * SAMPLES**2 for c in centres]
    y = np.concatenate([SAMPLES + c for c in centres])
    keep = np.r_[True, np.diff(y) > 1e-9]
    return contact.Separation(y[keep], np.concatenate(g)[keep], 1.2)


def solved(centres, creepage, stretch, tangential, friction):
    sep = separation(centres, stretch)
    options = contact.THESIS | {"tangential": tangential}  # patches of ANALYN do not press on each other
    return contact.solve(sep, creepage, approach=APPROACH, friction=friction, **options)


def together_and_alone(creepage, tangential, stretch, friction=0.3):
    both = solved((-APART, APART), creepage, stretch, tangential, friction)
    assert both.n_patches == 2
    sums = np.zeros(5)
    for centre in (-APART, APART):
        own = solved((centre,), creepage, stretch, tangential, friction)
        sums += own.Fx, own.Fy, own.Mz / APART, own.power_per_metre, own.slip_area
    return both, np.array([both.Fx, both.Fy, both.Mz / APART, both.power_per_metre, both.slip_area]), sums


@pytest.mark.parametrize("tangential", METHODS)
@pytest.mark.parametrize("friction", [0.3, SOFT], ids=["clean", "soft"])
@pytest.mark.parametrize("size", [SMALL, LARGE])
def test_two_patches_bear_what_each_bears_alone(tangential, friction, size):
    for creepage in (contact.Creepage(size, 0.0), contact.Creepage(0.0, size), contact.Creepage(size, -0.7 * size)):
        for stretch in (1.0, 3.0):
            both, found, expected = together_and_alone(creepage, tangential, stretch, friction)
            scale = max(np.abs(expected[:2]).max(), 1e-300)
            assert found[:3] == pytest.approx(expected[:3], abs=1e-6 * scale)
            assert found[3] == pytest.approx(expected[3], rel=1e-5, abs=1e-6 * scale * size)
            assert found[4] == pytest.approx(expected[4], rel=1e-5, abs=1e-6 * both.area)


@pytest.mark.parametrize("tangential", METHODS)
@pytest.mark.parametrize("size", [SMALL, 5e-4])
def test_with_spin_two_equal_patches_bear_what_each_bears_at_its_own_place(tangential, size):
    """Each rolls with the creepage at its middle: a patch at y has vx - phi y, and the moment -y Fx about the origin."""
    spin = 0.3 * size / 1e-3
    both = solved((-APART, APART), contact.Creepage(size, -0.5 * size, spin), 1.0, tangential, 0.3)
    expected = np.zeros(3)
    for centre in (-APART, APART):
        own = solved((0.0,), contact.Creepage(size - spin * centre, -0.5 * size, spin), 1.0, tangential, 0.3)
        expected += own.Fx, own.Fy, own.Mz - centre * own.Fx
    found = np.array([both.Fx, both.Fy, both.Mz]) / (1.0, 1.0, APART)
    scale = np.abs(expected / (1.0, 1.0, APART)).max()
    assert found == pytest.approx(expected / (1.0, 1.0, APART), abs=2e-6 * scale)
