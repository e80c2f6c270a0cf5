"""Lobes and patches displace each other along x: in full if they are separate, not at all within an ellipse."""

import math

import numpy as np
import pytest

import contact

LOAD, FRICTION = 40e3, 0.3
Y = np.linspace(-40e-3, 40e-3, 1281)
SMALL = 1e-6
BOTH = {"normal": "halfspace", "tangential": "halfspace", "n_strips": 64, "n_elements": 64}


def apart(distance, other=1.0):
    """Return a separation with two parabolas, the one on the right with `other` times the curvature."""
    g = np.minimum((Y + distance / 2) ** 2, other * (Y - distance / 2) ** 2) / 0.2
    return contact.Separation(Y, g, 1.1)


def dented(depth, width=3e-3):
    """Return a separation that a dent in the middle divides into lobes."""
    g = Y**2 / 0.6 + depth * np.exp(-((Y / width) ** 2)) + 4.0 * np.maximum(np.abs(Y) - 6e-3, 0.0) ** 2
    return contact.Separation(Y, g - g.min(), 1.1)


def solved(separation, creepage, **options):
    return contact.solve(separation, contact.Creepage(*creepage), load=LOAD, friction=FRICTION, throw=False, **options)


def forces_of_patches(s):
    """Return force (Fx, Fy) and middle of each patch."""
    which = s.strips.patch == np.array([[0], [1]])
    q = np.stack([(s.qx * s.dA).sum(axis=1), (s.qy * s.dA).sum(axis=1)])
    weight = s.strips.a * s.strips.dy * s.strips.p0
    return (which[:, None] * q).sum(axis=2), (which * weight * s.strips.y).sum(axis=1) / (which * weight).sum(axis=1)


def off(found, exact):
    return math.hypot(found.Fx - exact.Fx, found.Fy - exact.Fy) / (FRICTION * LOAD)


def test_lateral_force_of_a_patch_is_longitudinal_creepage_beside_it():
    """∂ux/∂x = ν y Fy/(πG r³) by Cerruti, where r is much longer than the patches."""
    separation, distance = apart(60e-3), 60e-3
    s = solved(separation, (0.0, SMALL))
    assert s.n_patches == 2
    (left, right), _ = forces_of_patches(s)
    per_creepage = forces_of_patches(solved(separation, (SMALL, 0.0)))[0][:, 0] / SMALL
    steel = contact.STEEL
    pull = steel.poisson_ratio * left[1] / (math.pi * steel.shear_modulus * distance**2)
    assert right[0] == pytest.approx(-per_creepage[1] * pull, rel=0.05)
    assert left[0] == pytest.approx(-right[0], rel=1e-3), "mirror image"


def test_a_patch_far_away_does_nothing():
    forces = [forces_of_patches(solved(apart(d), (2e-4, 1e-4)))[0] for d in (20e-3, 40e-3)]
    bound = FRICTION * LOAD
    near, far = (np.abs(f[0] - f[1]).max() / bound for f in forces)
    assert far < 0.3 * near


@pytest.mark.parametrize("creepage", [(3e-4, 3e-4, 0.0), (5e-4, -2e-4, 0.0), (2e-4, 6e-4, 0.0)])
def test_two_patches_have_the_forces_of_the_half_space(creepage):
    """A longitudinal force of one is lateral creepage of the other. Without it these were .0053, .0035 and .0091 off."""
    separation = apart(11e-3, 2.0)
    found, exact = solved(separation, creepage), solved(separation, creepage, **BOTH)
    assert found.n_patches == 2
    assert off(found, exact) < 0.0025


def test_the_pull_grows_from_nothing_as_an_ellipse_becomes_two_lobes():
    """Forces are continuous from one shape through two lobes to two patches."""
    depths = np.linspace(0.0, 60e-6, 241)
    answers = [solved(dented(depth), (4e-4, 3e-4, -0.3)) for depth in depths]
    assert [answers[0].n_patches, answers[-1].n_patches] == [1, 2]
    forces = np.array([(s.Fx, s.Fy) for s in answers]) / (FRICTION * LOAD)
    assert np.hypot(*np.diff(forces, axis=0).T).max() < 0.006
