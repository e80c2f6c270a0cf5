"""Methods of virtual penetration on ellipses, where patch and load of each have a closed form."""

import functools
import math

import numpy as np
import pytest
from scipy.special import ellipk

import contact
from contact.kernels.normal.kik_piotrowski import PENETRATION
from contact.kernels.normal.multi_hertz import _outside
from contact.kernels.normal.semi_winkler import _share, _strip
from tests.separations import two_lobes

NO_CREEP = contact.Creepage()
# the tolerances are for 30 strips; FaStrip leaves the strips' aspect ratios as the normal method gives them
solve, forces = (functools.partial(call, **contact.THESIS) for call in (contact.solve, contact.forces))
E = contact.STEEL.contact_modulus
RATIOS = [0.05, 0.28, 1.0, 3.0, 18.0, 80.0]


def overlap(share, A, B, delta):
    """Return the semi-axes of the ellipse in which paraboloids overlap at a share of the approach."""
    return math.sqrt(share * delta / A), math.sqrt(share * delta / B)


def pressed(a, b, delta):
    """Return the load of a semi-ellipsoid of pressure with centre displacement u_z(0) = p00 b K(e)/E* (Johnson 3.53)."""
    minor, major = min(a, b), max(a, b)
    return 2 / 3 * math.pi * a * b * delta * E / (minor * ellipk(1 - (minor / major) ** 2))


def kik_piotrowski(A, B, delta):
    a, b = overlap(PENETRATION, A, B, delta)
    return a, b, pressed(a, b, delta)


def kik_piotrowski_2008(A, B, delta):
    a, b = overlap(PENETRATION, A, B, delta)
    exact = contact.hertz(A, B, approach=delta)
    c, shape = math.sqrt(a * b), math.sqrt(exact.a / exact.b)
    return c * shape, c / shape, pressed(c * shape, c / shape, delta)


def hertzian_load(share):
    return lambda A, B, delta: (*overlap(share, A, B, delta), contact.hertz(A, B, approach=delta).N)


def hertz(A, B, delta):
    exact = contact.hertz(A, B, approach=delta)
    return exact.a, exact.b, exact.N


def stripes_ab(A, B, delta):
    """Return Hertz's a, b = n0 √(delta/(r0 B0 (1 + (n0/m0)²))) (theory.md 5) and the load of Hertz's strip pressures."""
    exact = contact.hertz(A, B, approach=delta)
    share = (exact.b / exact.a) ** 2
    n2_over_r = exact.b**2 * (A + B) / delta  # b = n √(delta/(r (A + B)))
    b = math.sqrt(delta * n2_over_r / (B * (1 + share)))
    return exact.a, b, exact.N * b / exact.b


PROMISES = {
    "kik_piotrowski": kik_piotrowski,
    "kik_piotrowski_2008": kik_piotrowski_2008,
    "linder": kik_piotrowski,
    "stripes_a": hertz,
    "stripes_ab": stripes_ab,
    "winkler": hertzian_load(1.0),
    "srst": hertzian_load(0.5),
    "kpec": hertz,
    "multi_hertz": hertz,
    "pascal_sauvage": hertz,
}


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("normal", PROMISES)
def test_patch_and_load_on_an_ellipse(normal, ratio):
    A, B = 4.0, 4.0 * ratio  # B above twice the floor
    separation = contact.Separation.hertzian(A, B)
    delta = contact.hertz(A, B, load=8e4).approach
    sol = solve(separation, NO_CREEP, approach=delta, normal=normal)
    a, b, N = PROMISES[normal](A, B, delta)
    assert sol.width == pytest.approx(2 * b, rel=1e-7), "width of the patch"
    at = np.sqrt(1 - (sol.strips.y / b) ** 2)
    np.testing.assert_allclose(sol.strips.a, a * at, rtol=1e-6, err_msg="half lengths")
    assert pytest.approx(N, rel=1e-3) == sol.N, "load; the sum of displacements is off by 8e-4 at b/a = 6.8"
    assert sol.normal_stiffness == pytest.approx(1.5 * sol.N / delta, rel=1e-5)
    back = solve(separation, NO_CREEP, load=sol.N, normal=normal)
    assert back.approach == pytest.approx(delta, rel=1e-9)


@pytest.mark.parametrize("normal", sorted(PROMISES.keys() - {"winkler"}))
def test_pressure_on_an_ellipse_is_a_semi_ellipsoid(normal, ellipse):
    sol = solve(ellipse, NO_CREEP, load=8e4, normal=normal)
    b = 0.5 * sol.width
    p0 = 1.5 * sol.N / (math.pi * b * sol.strips.a[0] / math.sqrt(1 - (sol.strips.y[0] / b) ** 2))
    np.testing.assert_allclose(sol.strips.p0, p0 * np.sqrt(1 - (sol.strips.y / b) ** 2), rtol=1e-6)
    assert sol.max_pressure == pytest.approx(p0, rel=1e-6)


@pytest.mark.parametrize("distance", [8e-3, 10e-3, 14e-3])
def test_kpec_cuts_no_strip_deeper_than_the_overlap(distance):
    """On a patch wider than long eps grows outwards. On a second lobe it would exceed 1 (up to 1.9 here)."""
    y, delta = np.linspace(-25e-3, 25e-3, 501), 2e-5
    separation = contact.Separation(y, np.minimum(0.3 * y**2, 11e-6 + 0.3 * (y - distance) ** 2), 4.0)
    sol = contact.solve(separation, NO_CREEP, approach=delta, normal="kpec")
    cut = separation.A[0] * sol.strips.a**2 + np.interp(sol.strips.y, y, separation.g)
    assert cut.max() == pytest.approx(delta, rel=1e-4), "eps is 1 on the second lobe"


def test_winkler_strips_carry_the_load_of_their_parabola(ellipse):
    sol = solve(ellipse, NO_CREEP, load=8e4, normal="winkler")
    exact = contact.hertz(1.0, 2.0, load=8e4)
    peak = 2 * sol.N / (math.pi * 0.25 * sol.width * 2 * exact.approach**0.5)  # a = √(delta/A), p = 2N/(pi a b)
    depth = 1 - (2 * sol.strips.y / sol.width) ** 2
    np.testing.assert_allclose(
        math.pi / 2 * sol.strips.p0 * sol.strips.a, 4 / 3 * peak * depth * sol.strips.a, rtol=1e-6
    )


@pytest.mark.parametrize(("normal", "aspect"), [("linder", lambda A, B: math.sqrt(B / A)), ("stripes_a", None)])
def test_local_ellipses_of_an_ellipse_are_that_ellipse(normal, aspect):
    for ratio in RATIOS:
        A, B = 4.0, 4.0 * ratio
        sol = solve(contact.Separation.hertzian(A, B), NO_CREEP, load=8e4, normal=normal)
        exact = contact.hertz(A, B, load=8e4)
        expected = aspect(A, B) if aspect else exact.a / exact.b
        np.testing.assert_allclose(sol.strips.aspect, expected, rtol=1e-6)


def test_semi_winkler_is_hertz_in_patch_and_load_on_a_circle():
    exact = contact.hertz(2.0, 2.0, load=8e4)
    sol = solve(contact.Separation.hertzian(2.0, 2.0), NO_CREEP, load=8e4, normal="semi_winkler")
    np.testing.assert_allclose(sol.strips.a, exact.a * np.sqrt(1 - (sol.strips.y / exact.b) ** 2), rtol=1e-6)
    assert sol.approach == pytest.approx(exact.approach, rel=1e-9)


@pytest.mark.parametrize("ratio", RATIOS)
def test_semi_winkler_carries_hertz_load_on_an_ellipse(ratio):
    A, B = 4.0, 4.0 * ratio
    exact = contact.hertz(A, B, load=8e4)
    sol = solve(contact.Separation.hertzian(A, B), NO_CREEP, approach=exact.approach, normal="semi_winkler")
    assert pytest.approx(exact.N, rel=1e-6) == sol.N
    assert sol.area == pytest.approx(math.pi * exact.a * exact.b, rel=0.2), "area of Hertz, roughly, at every aspect"


def test_semi_winkler_strip_solves_its_equation():
    """The edge of a strip lies where the depth is l times the slope of the gap (docstring of the method)."""
    A, B, delta, length = 1.3, 2.1, 8e-5, 2e-3
    for gap in np.linspace(0.0, 0.9, 10) * _share(B, length / math.sqrt(delta)) * delta:
        a, mean = _strip(gap, A, B, delta, length)
        slope = math.hypot(2 * A * a, math.sqrt(4 * B * gap))
        assert delta - gap - A * a**2 == pytest.approx(length * slope, rel=1e-9)
        x = np.linspace(-a, a, 2001)
        bed = delta - gap - A * x**2 + 2 * length**2 * (A + B)
        assert mean == pytest.approx(np.trapezoid(bed, x) / (2 * a), rel=1e-6)


@pytest.mark.parametrize("aspect", [0.2, 1.0, 5.0])
def test_displacement_outside_an_ellipse_is_that_of_its_pressure(aspect):
    """Compare the gutter of multi_hertz with the sum over the semi-ellipsoid of pressure."""
    a, b = aspect, 1.0
    c, w = np.polynomial.legendre.leggauss(400)
    angle, radius = (c + 1) * math.pi, (c + 1) / 2
    r, th = np.meshgrid(radius, angle, indexing="ij")
    weight = np.outer(w / 2, w * math.pi) * a * b * r * np.sqrt(1 - r**2)

    def summed(y):
        return (weight / np.hypot(a * r * np.cos(th), y - b * r * np.sin(th))).sum() / math.pi

    for y in (1.05, 1.5, 3.0, 10.0):
        # half the interval [-1, 1] of the Gauss rule: the factor 1/2
        assert a * b * 0.5 * _outside(y, a**2, b**2) == pytest.approx(summed(y), rel=3e-3)


def test_the_equivalent_ellipse_keeps_the_load_of_the_contacts():
    separation = two_lobes(5e-6)
    several = solve(separation, NO_CREEP, approach=9e-5, normal="multi_hertz")
    one = solve(separation, NO_CREEP, approach=9e-5, normal="pascal_sauvage")
    assert (several.n_patches, one.n_patches) == (2, 1)
    assert pytest.approx(several.N, rel=1e-9) == one.N
    weights = several.strips.p0 * several.strips.a * several.strips.dy
    assert one.patch_edges.mean() == pytest.approx(np.average(several.strips.y, weights=weights), abs=1e-9)


def test_pressures_of_overlapping_ellipses_add_up():
    y = np.linspace(-20e-3, 20e-3, 401)
    separation = contact.Separation(y, 2.0 * y**2 * np.where(y > 0, 0.2, 1.0), 1.0)
    sol = solve(separation, NO_CREEP, load=8e4, normal="multi_hertz")
    assert sol.n_patches > 1
    (low, high), (low2, high2) = sol.patch_edges[:2]
    assert max(low, low2) < min(high, high2), "they overlap"
    grid = np.linspace(-20e-3, 20e-3, 801)
    assert sol.pressure(grid[:, None], grid[None, :]).sum() * (grid[1] - grid[0]) ** 2 == pytest.approx(8e4, rel=2e-3)


@pytest.mark.parametrize(
    "normal", [name for name, method in contact.methods().batched.normal.items() if method.continuous]
)
def test_load_is_continuous_where_patches_are_born_and_merge(normal):
    if normal in ("hertz", "strip_halfspace"):
        pytest.skip("follows one lobe; iterates to a tolerance")
    separation = two_lobes(10e-6, spacing=8e-3)
    approaches = np.linspace(5e-6, 160e-6, 400)
    many = forces(separation, NO_CREEP, approach=approaches, normal=normal)
    counts = {solve(separation, NO_CREEP, approach=float(d), normal=normal).n_patches for d in approaches[::40]}
    assert counts == {1, 2}
    steps = np.diff(many.N)
    assert (steps > 0).all(), "N(approach) is monotone"
    assert np.abs(np.diff(steps)).max() < 0.3 * steps.max()


def test_the_step_of_the_shape_correction_where_patches_merge_is_small():
    """The patches of kik_piotrowski_2008 move where they merge. This makes a jump of 0.8 % of the load, the only one."""
    approaches = np.linspace(5e-6, 160e-6, 400)
    many = forces(two_lobes(10e-6, spacing=8e-3), NO_CREEP, approach=approaches, normal="kik_piotrowski_2008")
    steps = np.diff(many.N)
    assert (steps > 0).all()
    uneven = np.abs(np.diff(steps))
    assert np.sort(uneven)[-3] < 0.1 * steps.max()
    assert uneven.max() < 0.01 * many.N.max()
