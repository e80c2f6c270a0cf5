"""Stresses below the surface: Hertz's closed forms, CONTACT's values, equilibrium, both bodies, strips, errors."""

import numpy as np
import pytest

import contact
import reference
from contact.halfspace import norm, tang
from contact.stress import SurfaceLoad, at, below, largest
from contact.stress.field import CRITERIA

NU, P0 = 0.28, 1e9
BOTH = {"normal": "halfspace", "tangential": "halfspace"}


#: Set G, hz_slide_circ, CONTACT 25.1: x, y, z [mm]; xx, yy, zz, xy, xz, yz and von Mises stress [MPa] in the rail.
SLIDING = (
    ((0.357955, -0.119318, 0.0), (-742.308, -773.082, -997.206, -4.9501, 299.1617, -0.0576, 571.526)),
    ((0.357955, -0.119318, 0.25), (-648.689, -677.181, -993.561, -4.6224, 261.7017, 1.1399, 561.652)),
    ((0.357955, 1.7897727, 1.5), (-278.693, -292.524, -834.281, 38.191, 105.5573, -92.3183, 603.785)),
    ((2.2670455, -0.119318, 2.75), (-81.651, -113.264, -606.181, -0.404, -74.3655, 6.9155, 525.627)),
    ((0.357955, 0.357955, 2.75), (-133.769, -142.407, -755.117, 3.8298, 46.8351, -22.9654, 623.69)),
    ((-1.0738636, -2.5056818, 6.5), (-8.1503, -18.3934, -315.3295, -10.8479, 42.6376, 79.4199, 340.657)),
)


def hertz(a, b, n, p0=P0):
    """Return Hertz's pressure at the centres of n × n elements over the ellipse."""
    s = (np.arange(n) + 0.5) * 2.0 / n - 1.0
    return a * s, b * s, p0 * np.sqrt(np.maximum(1.0 - s**2 - s[:, None] ** 2, 0.0))


def test_the_axis_of_a_circle_has_the_closed_form():
    """Within 1e-3 of p0 (Johnson 1985, Eq. 3.45, as given in subsurface.md)."""
    a = 5e-3
    load = SurfaceLoad(*hertz(a, a, 101))
    ratio = np.array([0.1, 0.3, 0.474, 0.8, 1.5, 3.0])
    field = at(load, 0.0, 0.0, ratio * a)
    zz = -P0 / (1.0 + ratio**2)
    xx = -P0 * ((1.0 + NU) * (1.0 - ratio * np.arctan(1.0 / ratio)) - 0.5 / (1.0 + ratio**2))
    for mine, true in ((field.zz, zz), (field.xx, xx), (field.yy, xx), (field.xy, 0.0), (field.xz, 0.0)):
        np.testing.assert_allclose(mine, true, atol=1e-3 * P0)
    np.testing.assert_allclose(field.von_mises, np.abs(zz - xx), atol=1e-3 * P0)
    np.testing.assert_allclose(field.tresca, np.abs(zz - xx), atol=1e-3 * P0)
    np.testing.assert_allclose(field.principal[:, 2], np.minimum(zz, xx), atol=1e-3 * P0)
    np.testing.assert_allclose(field.hydrostatic, (zz + 2.0 * xx) / 3.0, atol=1e-3 * P0)


def test_the_largest_von_mises_stress_of_a_circle_is_that_of_the_closed_form():
    """Of the formula above for nu = .28: .6293 p0 at the depth .474 a."""
    a = 5e-3
    peak = largest(SurfaceLoad(*hertz(a, a, 101)))
    assert peak.value == pytest.approx(0.6293 * P0, rel=1e-3)
    assert peak.z == pytest.approx(0.474 * a, rel=0.01)
    assert (peak.x, peak.y) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_a_long_contact_is_a_line_contact():
    """Largest shear .300 p0 at the depth .786 a (Johnson 1985, 4.2)."""
    x, y, _ = hertz(1e-3, 200e-3, 81)  # the ends act on xx with the half width over their distance
    p = P0 * np.sqrt(1.0 - (x / 1e-3) ** 2) * np.ones((81, 1))
    peak = at(SurfaceLoad(x, y, p), 0.0, 0.0, np.linspace(0.5e-3, 1e-3, 101)).peak("tresca")  # far from the ends
    assert 0.5 * peak.value == pytest.approx(0.3003 * P0, rel=3e-3)
    assert peak.z == pytest.approx(0.786e-3, rel=0.02)


def test_the_stress_on_the_surface_is_the_load():
    rng = np.random.default_rng(1)
    x, y = np.arange(7) * 1e-3, np.arange(5) * 2e-3
    load = SurfaceLoad(x, y, *rng.uniform(-1.0, 1.0, (3, 5, 7)))
    rail, wheel = (below(load, [0.0], body=body, margin=0.0) for body in ("rail", "wheel"))
    for field in (rail, wheel):  # sigma·n of the rail's surface is -q, of the wheel's surface q: the same stress
        np.testing.assert_allclose(field.zz[0], -load.p, atol=1e-12)
        np.testing.assert_allclose(field.xz[0], load.qx, atol=1e-12)
        np.testing.assert_allclose(field.yz[0], load.qy, atol=1e-12)


@pytest.mark.parametrize("body", ["rail", "wheel"])
def test_the_stresses_are_in_equilibrium_and_carry_the_load(body):
    """div sigma = 0 inside, and a deep plane carries N, Fx and Fy."""
    rng = np.random.default_rng(2)
    s = np.arange(6) * 1e-3
    load = SurfaceLoad(s, s, *rng.uniform(-1.0, 1.0, (3, 6, 6)))
    h = 1e-6
    centre = np.array([1.3e-3, 2.2e-3, 1.7e-3])
    steps = h * np.concatenate((np.eye(3), -np.eye(3)))
    points = centre + steps
    tensor = at(load, *points.T, body=body).tensor
    up = np.array([1.0, 1.0, -1.0 if body == "wheel" else 1.0])  # depth against the z axis
    slope = (tensor[:3] - tensor[3:]) / (2.0 * h) * up[:, None, None]
    scale = np.abs(slope).max()
    np.testing.assert_allclose(np.einsum("kik->i", slope), 0.0, atol=1e-5 * scale)
    wide = (np.arange(600) - 300) * 0.5e-3
    plane = at(load, wide + 2.5e-3, wide[:, None] + 2.5e-3, 3e-3, body=body)
    carried = [float(v.sum()) * 0.25e-6 for v in (-plane.zz, plane.xz, plane.yz)]
    wanted = [float(v.sum()) * 1e-6 for v in (load.p, load.qx, load.qy)]
    np.testing.assert_allclose(carried, wanted, atol=0.04 * np.abs(wanted).max())


def test_points_and_grid_agree():
    rng = np.random.default_rng(3)
    load = SurfaceLoad(np.arange(8) * 1e-3, np.arange(6) * 0.7e-3, *rng.normal(size=(3, 6, 8)))
    grid = below(load, [0.0, 1e-4, 3e-3], margin=0.5)
    assert grid.xx.shape == (3, 12, 16)
    points = at(load, grid.x, grid.y, grid.z)
    for name in ("xx", "yy", "zz", "xy", "xz", "yz"):
        np.testing.assert_allclose(getattr(points, name), getattr(grid, name), atol=1e-9)


def test_the_stresses_are_contacts():
    """A circle of 5 mm, p0 = 1 GPa, slides with mu = .3 along x on 44 × 44 elements: 1e-4 of p0."""
    h, a = 10.5e-3 / 44.0, 5e-3
    x = (np.arange(44) - 21.5) * h
    B = np.pi * P0 / (4.0 * a * reference.STEEL.contact_modulus)
    p = norm(B * (x**2 + x[:, None] ** 2), h, h, reference.STEEL, load=2.0 / 3.0 * np.pi * a**2 * P0).p
    sliding = tang(p, x, x, contact.Creepage(-0.05), 0.3, reference.STEEL)
    places, stresses = (np.array(column) for column in zip(*SLIDING, strict=True))
    field = at(SurfaceLoad(x, x, p, sliding.qx, sliding.qy), *places.T * 1e-3)
    mine = np.stack([getattr(field, name) for name in ("xx", "yy", "zz", "xy", "xz", "yz", "von_mises")], axis=1)
    np.testing.assert_allclose(mine, 1e6 * stresses, atol=1e-4 * P0)


def test_strips_have_the_stresses_of_the_elements():
    """Rolling with spin: 1 % of the largest von Mises stress between the default methods and the half space."""
    separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 5e-4, 0.3)
    fast = contact.solve(separation, creepage, load=80e3)
    exact = contact.solve(separation, creepage, load=80e3, **BOTH)
    z = np.array([1.0, 2.0, 3.0, 6.0])[:, None, None] * 1e-3
    x, y = np.linspace(-5e-3, 5e-3, 6), np.linspace(-6e-3, 6e-3, 6)[:, None]
    top = largest(exact).value
    assert largest(fast).value == pytest.approx(top, rel=5e-3)
    for body in ("rail", "wheel"):
        one, other = (at(s, x, y, z, body=body) for s in (fast, exact))
        assert np.abs(one.von_mises - other.von_mises).max() < 0.02 * top
    load = SurfaceLoad.of(fast)
    dx, dy = load.steps
    assert float(load.p.sum()) * dx * dy == pytest.approx(fast.N, rel=1e-12)
    assert float(load.qx.sum()) * dx * dy == pytest.approx(fast.Fx, rel=0.01)
    assert (np.hypot(load.qx, load.qy) <= 0.3 * load.p * (1.0 + 1e-9)).all()


def test_elements_of_a_solution_are_taken_as_they_are():
    separation = contact.Separation.hertzian(1.1, 0.8)
    s = contact.solve(separation, contact.Creepage(1e-3, 5e-4, 0.3), load=80e3, n_strips=24, n_elements=30, **BOTH)
    load = SurfaceLoad.of(s)
    dx, dy = load.steps
    force = dx * dy * np.array([load.p.sum(), load.qx.sum(), load.qy.sum()])
    np.testing.assert_allclose(force, (s.N, s.Fx, s.Fy), rtol=1e-9)
    assert dx * dy * float((load.x * load.qy - load.y[:, None] * load.qx).sum()) == pytest.approx(s.Mz, rel=1e-9)


def test_two_patches_have_two_stresses():
    from tests.separations import two_lobes

    s = contact.solve(two_lobes(2e-6), contact.Creepage(1e-3), load=2e4)
    assert s.n_patches == 2
    deep = below(s, [1e-3], margin=0.0).von_mises[0].max(axis=1)
    middle = deep.size // 2
    assert deep[middle] < 0.3 * min(deep[:middle].max(), deep[middle:].max())


@pytest.mark.parametrize("criterion", CRITERIA)
@pytest.mark.parametrize("creepage", [(0.0, 0.0, 0.0), (-2e-3, 1e-3, 0.1), (-8e-3, 0.0, 0.0)])
@pytest.mark.parametrize("aspect", [0.1, 1.0, 8.0])
def test_the_largest_value_is_that_of_a_dense_search(criterion, creepage, aspect):
    """No element has a larger value at any of 60 depths, within 1e-4."""
    solution = contact.solve(contact.Separation.hertzian(1.1, 1.1 * aspect), contact.Creepage(*creepage), load=8e4)
    load = SurfaceLoad.of(solution, 24)
    found = largest(load, criterion)
    dense = below(load, np.linspace(0.0, 1.6 * load.radius, 60), margin=0.0).peak(criterion)
    assert dense.value * (1.0 - 1e-9) <= found.value * (1.0 + 1e-4)
    assert at(load, found.x, found.y, found.z).peak(criterion).value == pytest.approx(found.value, rel=1e-9)
