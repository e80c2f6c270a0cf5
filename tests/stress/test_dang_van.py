"""Dang Van's criterion: smallest spheres, a line contact in closed form, invariances, errors."""

import numpy as np
import pytest

import contact
from contact.stress import SurfaceLoad, below, dang_van
from contact.stress.fatigue import centres


def test_the_spheres_are_the_smallest():
    """Every centre is in the convex hull of the points that it touches: the condition for the least radius."""
    rng = np.random.default_rng(1)
    path = rng.normal(size=(40, 30, 6))
    path[:10] *= [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]  # flat
    path[10:20] = np.cumsum(path[10:20], axis=1)  # walks
    path[20] = path[20, 0]  # a point
    found = centres(path)
    distance = np.linalg.norm(path - found[:, None], axis=2)
    radius = distance.max(axis=1)
    for points, centre, own, r in zip(path, found, distance, radius, strict=True):
        arms = (points[own > r - 1e-6 * max(r, 1e-9)] - centre) / max(r, 1e-300)
        # any direction away from the centre must have a touched point on its far side
        for direction in np.concatenate((rng.normal(size=(200, 6)), -arms)):
            assert (arms @ direction).min() <= 1e-6 * np.linalg.norm(direction) + (0.0 if r > 1e-9 else 1.0)


def test_of_two_points_the_middle_and_of_a_triangle_the_circumcentre():
    a, b = np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 0.1]]), np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 1.9]])
    np.testing.assert_allclose(centres(a), (1.0, 0.0), atol=1e-12)
    np.testing.assert_allclose(centres(b), (1.0, (1.9**2 - 1.0) / 3.8), atol=1e-9)


def test_a_frictionless_line_contact_has_the_amplitude_of_its_orthogonal_shear():
    """Plane strain: the path has xz and xx - zz; at the depth .5 a the shear xz alternates by ±.25 p0 (Johnson 1985, 9.2)."""
    n, a, p0 = 160, 1e-3, 1e9
    x = a * ((np.arange(n) + 0.5) * 2.0 / n - 1.0)
    y = np.linspace(-40e-3, 40e-3, 41)
    load = SurfaceLoad(x, y, p0 * np.sqrt(1.0 - (x / a) ** 2) * np.ones((41, 1)))
    z = np.array([0.5 * a])
    assert np.abs(below(load, z, margin=0.0).xz[0, 20]).max() == pytest.approx(0.25 * p0, rel=5e-3)
    found = dang_van(load, z, slope=0.0, margin=1.0)
    assert found.amplitude[0, found.y.shape[1] // 2] >= 0.25 * p0 * (1.0 - 5e-3)
    assert found.equivalent[0, found.y.shape[1] // 2] == found.amplitude[0, found.y.shape[1] // 2]


def test_hydrostatic_stress_counts_by_the_slope():
    s = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(2e-3, 0.0, 0.1), load=80e3)
    z = np.array([0.0, 2e-3])
    one, pulled = (dang_van(s, z, slope=0.3, residual=r) for r in (0.0, 1e8))
    np.testing.assert_allclose(pulled.equivalent - one.equivalent, 0.3e8, rtol=1e-9)
    np.testing.assert_allclose(pulled.amplitude, one.amplitude)
    assert one.peak.value == one.equivalent.max()
    assert one.equivalent.shape == one.y.shape == one.z.shape == (2, one.y.shape[1])
