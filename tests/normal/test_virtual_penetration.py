"""The methods of virtual penetration on ellipses, where each promises a patch and a load in closed form."""

import math

import numpy as np
import pytest
from scipy.special import ellipk

import contact
from contact.normal.kik_piotrowski import PENETRATION
from tests.normal.test_analyn import two_lobes

NO_CREEP = contact.Creepage()
E = contact.STEEL.contact_modulus
RATIOS = [0.05, 0.28, 1.0, 3.0, 18.0, 80.0]


def overlap(share, A, B, delta):
    """Semi-axes of the ellipse at which paraboloids overlap at a share of the approach."""
    return math.sqrt(share * delta / A), math.sqrt(share * delta / B)


def pressed(a, b, delta):
    """Load of a semi-ellipsoid of pressure that displaces its centre by delta: u_z(0) = p00 b K(e)/E* (Johnson 1985, 3.53)."""
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


def stripes_a(A, B, delta):
    exact = contact.hertz(A, B, approach=delta)
    return exact.a, exact.b, exact.N


def stripes_ab(A, B, delta):
    """Hertz's a, and b = n0 √(delta/(r0 B0 (1 + (n0/m0)²))) (theory.md 5); strip pressures of Hertz on it."""
    exact = contact.hertz(A, B, approach=delta)
    share = (exact.b / exact.a) ** 2
    n2_over_r = exact.b**2 * (A + B) / delta  # b = n √(delta/(r (A + B)))
    b = math.sqrt(delta * n2_over_r / (B * (1 + share)))
    return exact.a, b, exact.N * b / exact.b


PROMISES = {
    "kik_piotrowski": kik_piotrowski,
    "kik_piotrowski_2008": kik_piotrowski_2008,
    "linder": kik_piotrowski,
    "stripes_a": stripes_a,
    "stripes_ab": stripes_ab,
    "winkler": hertzian_load(1.0),
    "srst": hertzian_load(0.5),
}


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("normal", PROMISES)
def test_patch_and_load_on_an_ellipse(normal, ratio):
    A, B = 4.0, 4.0 * ratio  # B above twice the floor
    separation = contact.Separation.hertzian(A, B)
    delta = contact.hertz(A, B, load=8e4).approach
    sol = contact.solve(separation, NO_CREEP, approach=delta, normal=normal)
    a, b, N = PROMISES[normal](A, B, delta)
    assert sol.width == pytest.approx(2 * b, rel=1e-7), "width of the patch"
    at = np.sqrt(1 - (sol.strips.y / b) ** 2)
    np.testing.assert_allclose(sol.strips.a, a * at, rtol=1e-6, err_msg="half lengths")
    assert pytest.approx(N, rel=1e-3) == sol.N, "load; the sum of displacements is off by 8e-4 at b/a = 6.8"
    assert sol.normal_stiffness == pytest.approx(1.5 * sol.N / delta, rel=1e-5)
    back = contact.solve(separation, NO_CREEP, load=sol.N, normal=normal)
    assert back.approach == pytest.approx(delta, rel=1e-9)


@pytest.mark.parametrize("normal", sorted(PROMISES.keys() - {"winkler"}))
def test_pressure_on_an_ellipse_is_a_semi_ellipsoid(normal, ellipse):
    sol = contact.solve(ellipse, NO_CREEP, load=8e4, normal=normal)
    b = 0.5 * sol.width
    p0 = 1.5 * sol.N / (math.pi * b * sol.strips.a[0] / math.sqrt(1 - (sol.strips.y[0] / b) ** 2))
    np.testing.assert_allclose(sol.strips.p0, p0 * np.sqrt(1 - (sol.strips.y / b) ** 2), rtol=1e-6)
    assert sol.max_pressure == pytest.approx(p0, rel=1e-6)


def test_winkler_strips_carry_the_load_of_their_parabola(ellipse):
    sol = contact.solve(ellipse, NO_CREEP, load=8e4, normal="winkler")
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
        sol = contact.solve(contact.Separation.hertzian(A, B), NO_CREEP, load=8e4, normal=normal)
        exact = contact.hertz(A, B, load=8e4)
        expected = aspect(A, B) if aspect else exact.a / exact.b
        np.testing.assert_allclose(sol.strips.aspect, expected, rtol=1e-6)


@pytest.mark.parametrize("normal", PROMISES)
def test_load_is_continuous_where_patches_are_born_and_merge(normal):
    separation = two_lobes(10e-6, spacing=8e-3)
    approaches = np.linspace(5e-6, 160e-6, 400)
    many = contact.forces(separation, NO_CREEP, approach=approaches, normal=normal)
    counts = {contact.solve(separation, NO_CREEP, approach=float(d), normal=normal).n_patches for d in approaches[::40]}
    assert counts == {1, 2}
    steps = np.diff(many.N)
    assert (steps > 0).all(), "N(approach) is monotone"
    # the patches of 2008 move where they merge: a step of 0.8 % of the load
    step = 0.01 * many.N.max() if normal == "kik_piotrowski_2008" else 0.3 * steps.max()
    assert np.abs(np.diff(steps)).max() < step
