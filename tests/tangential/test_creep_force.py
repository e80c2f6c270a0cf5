"""Creep force laws, which give only forces: closed forms, published numbers, their own tractions, missing fields."""

import math

import numpy as np
import pytest
from scipy import integrate

import contact
from contact.friction import Friction
from contact.kernels.tangential.carter import carter, creepage_of_full_slip
from contact.kernels.tangential.linear import smoothed
from contact.kernels.tangential.polach import polach
from contact.kernels.tangential.vermeulen_johnson import slopes, vermeulen_johnson
from contact.theory import kalker

LAWS = [name for name, method in contact.methods().tangential.items() if not method.fields]
N, MU, G, NU = 8e4, 0.3, contact.STEEL.shear_modulus, contact.STEEL.poisson_ratio


def solve(separation, vx=0.0, vy=0.0, phi=0.0, tangential="linear", **options):
    options = {"n_strips": 200, "load": N} | options
    return contact.solve(
        separation, contact.Creepage(vx, vy, phi), friction=MU, normal="hertz", tangential=tangential, **options
    )


def shape(separation):
    """Return a, b, c and Kalker's coefficients of the ellipse."""
    found = contact.hertz(separation.A[0], separation.g[-1] / separation.y[-1] ** 2, load=N)
    C = kalker.coefficients(kalker.table(NU), math.log(found.a / found.b))
    return found.a, found.b, math.sqrt(found.a * found.b), C


@pytest.fixture(params=[0.4, 1.0, 6.0])
def hertzian(request):
    return contact.Separation.hertzian(1.0, request.param)


def test_linear_theory_on_an_ellipse(hertzian):
    """Kalker 1967, with four coefficients. The equivalent ellipse of 200 strips agrees with Hertz to 1e-4."""
    *_, c, (c11, c22, c23, c33) = shape(hertzian)
    unit = G * c * c
    x, y, spin = (solve(hertzian, *creepage) for creepage in np.diag([1e-4, 1e-4, 1e-2]))
    wanted = [
        -c11 * unit * 1e-4,
        -c22 * unit * 1e-4,
        c23 * unit * c * 1e-4,
        -c23 * unit * c * 1e-2,
        -c33 * unit * c * c * 1e-2,
    ]
    np.testing.assert_allclose([x.Fx, y.Fy, y.Mz, spin.Fy, spin.Mz], wanted, rtol=2e-4)
    np.testing.assert_allclose([x.Fy, x.Mz, y.Fx, spin.Fx], 0.0, atol=1e-6)


def test_linear_theory_does_not_depend_on_friction(hertzian):
    sol = solve(hertzian, 0.05)
    assert abs(sol.Fx) > 10 * MU * N
    assert not contact.methods().tangential["linear"].saturates
    assert sol.slip_ratio == 0.0


#: Methods with Kalker's slopes, and how far they are off by their elements.
SLOPES = {"linear_saturated": 3e-4, "shen_hedrick_elkins": 3e-4, "polach": 3e-4, "fastrip": 2e-3, "fastsim": 6e-3}
SLOPES |= dict.fromkeys(("fastsim_elliptic", "fastsim_linder", "fastsim_stripes"), 6e-3)


@pytest.mark.parametrize("method", SLOPES)
@pytest.mark.parametrize("ratio", [0.03, 0.4, 1.0, 6.0, 30.0])
def test_slopes_at_vanishing_creepage_are_kalkers(method, ratio):
    """Thesis Eqs. 4.20-4.22 and 4.28-4.30 (theory.md 4.1)."""
    separation = contact.Separation.hertzian(1.0, ratio)
    *_, c, (c11, c22, c23, _) = shape(separation)
    tiny = 1e-6 * MU * N / (G * c * c)
    x, y, spin = (
        solve(separation, *creepage, tangential=method, n_elements=60) for creepage in np.diag([tiny, tiny, tiny / c])
    )
    np.testing.assert_allclose([x.Fx, y.Fy, spin.Fy], -1e-6 * MU * N * np.array([c11, c22, c23]), rtol=SLOPES[method])
    if method in LAWS:
        assert (x.Mz, y.Mz, spin.Mz) == pytest.approx((0.0,) * 3, abs=1e-12)


def test_the_cubic_law_is_one_minus_a_cube_and_smooth_where_it_ends():
    """Thesis Eq. 5.4: F/(mu N) = 1 - (1 - f/3)³, stick zone (1 - f/3)² of the patch."""
    for f in (0.1, 1.0, 2.5, 2.999):
        factor, slip = smoothed(f, 1.0)
        assert factor * f == pytest.approx(1.0 - (1.0 - f / 3.0) ** 3, rel=1e-14)
        assert slip == pytest.approx(1.0 - (1.0 - f / 3.0) ** 2, rel=1e-14)
    assert smoothed(3.0, 1.0) == (1.0 / 3.0, 1.0)
    assert smoothed(0.0, 0.0) == (1.0, 0.0)


def test_carter_is_contacts_example():
    """CONTACT's carter2d: R = 500 mm, a = 1 mm, mu = 0.3, F = .64 mu N at a creepage of 2.4e-4 (theory.md 2.1)."""
    force, slip = carter(2.4e-4, 0.3 * 1e-3 / 0.5)
    assert force == pytest.approx(-0.64, rel=1e-12)
    assert slip == pytest.approx(0.4, rel=1e-12)  # d = a X; sticks over √(1 - F/mu N) of the length


def test_carter_on_a_rectangle_is_hertz_and_carter():
    """mu a/R of the cylinder with that half length and load: a² = 4 N' R/(pi E*)."""
    a, width, load = 4e-3, 12e-3, 5e4
    R = math.pi * a * a * contact.STEEL.contact_modulus / (4.0 * load / width)
    assert creepage_of_full_slip(MU * load, 2 * a * width, G, NU) == pytest.approx(MU * a / R, rel=1e-12)


def test_carter_has_kalkers_slope_on_a_wide_ellipse():
    """pi²/(4 (1 - nu)): the limit a/b → 0 of C11 (theory.md 1.2), 2 % from the table's end at 1/50."""
    a, b = 1e-3, 50e-3
    full_slip = creepage_of_full_slip(1.0, math.pi * a * b, G, NU)
    slope = -carter(1e-6 * full_slip, full_slip)[0] / (1e-6 * full_slip) / (G * a * b)
    assert slope == pytest.approx(math.pi**2 / (4.0 * (1.0 - NU)), rel=1e-5)
    assert slope == pytest.approx(kalker.coefficients(kalker.table(NU), math.log(a / b))[0], rel=0.02)


def test_carter_uses_only_longitudinal_creepage(ellipse):
    only = solve(ellipse, 1e-3, tangential="carter")
    with_all = solve(ellipse, 1e-3, 2e-3, 0.3, tangential="carter")
    assert (with_all.Fx, with_all.Fy, with_all.Mz) == pytest.approx((only.Fx, 0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("nu", [0.0, 0.28, 0.5])
@pytest.mark.parametrize("aspect", [0.05, 0.3, 1.0003, 2.0, 30.0])
def test_slopes_of_vermeulen_and_johnson_are_their_integrals(aspect, nu):
    """theory.md 2.2, for b = 1."""

    def integral(cosine2, sine2):
        def integrand(t):
            alpha = math.cos(t) ** 2 / aspect**2 + math.sin(t) ** 2
            return (
                (1 - nu + nu * (cosine2 * math.cos(t) ** 2 + sine2 * math.sin(t) ** 2)) * math.sin(t) ** 2 / alpha**1.5
            )

        return integrate.quad(integrand, 0.0, math.pi, points=[math.pi / 2], limit=500, epsabs=0, epsrel=1e-12)[0]

    wanted = [2.0 * math.pi * aspect / integral(1, 0), 2.0 * math.pi * aspect / integral(0, 1)]
    np.testing.assert_allclose(slopes(aspect, nu), wanted, rtol=1e-10)


def test_slopes_on_a_circle_are_johnsons():
    """16/(4 - 3 nu), 16/(4 - nu): 4.92 and 4.27 at nu = 1/4, which is 19 and 16 per cent above Kalker (thesis 4.2)."""
    np.testing.assert_allclose(slopes(1.0, 0.25), (16 / 3.25, 16 / 3.75), rtol=1e-14)


def test_creep_law_of_vermeulen_and_johnson_is_its_inverse():
    """v = -3 mu N/(C G c²) (1 - (1 - F/(mu N))^(1/3)) (theory.md 2.2)."""
    a, b, limit = 6e-3, 4e-3, MU * N
    c11, c22 = slopes(a / b, NU)
    for F in (0.1, 0.5, 0.9, 0.999):
        v = -3.0 * limit * (1.0 - (1.0 - F) ** (1 / 3)) / (G * a * b)
        Fx, _, _, slip = vermeulen_johnson(v / c11, 0.0, G, a, b, NU, limit)
        assert Fx / limit == pytest.approx(F, rel=1e-12)
        assert slip == pytest.approx(1.0 - (1.0 - F) ** (2 / 3), rel=1e-12)
        assert vermeulen_johnson(0.0, v / c22, G, a, b, NU, limit)[1] / limit == pytest.approx(F, rel=1e-12)


def test_moment_of_vermeulen_and_johnson_is_that_of_their_traction():
    a, b, limit = 6e-3, 4e-3, MU * N
    Fx, Fy, Mz, slip = vermeulen_johnson(5e-4, -8e-4, G, a, b, NU, limit)
    k = math.sqrt(1.0 - slip)
    x, y = np.meshgrid(np.linspace(-a, a, 2001), np.linspace(-b, b, 2001))
    whole = np.sqrt(np.maximum(1 - (x / a) ** 2 - (y / b) ** 2, 0.0))
    stick = np.sqrt(np.maximum(k * k - ((x - (1 - k) * a) / a) ** 2 - (y / b) ** 2, 0.0))
    q = whole - stick
    assert q.sum() / whole.sum() == pytest.approx(math.hypot(Fx, Fy) / limit, rel=1e-4)
    assert (x * q).sum() / whole.sum() * limit * Fy / math.hypot(Fx, Fy) == pytest.approx(Mz, rel=1e-3)


def test_johnson_sees_the_circle_of_equal_area(ellipse):
    a, b, c, _ = shape(ellipse)
    sol = solve(ellipse, 3e-4, 4e-4, tangential="johnson")
    circle = vermeulen_johnson(3e-4, 4e-4, G, c, c, NU, MU * N)
    np.testing.assert_allclose((sol.Fx, sol.Fy, sol.Mz), circle[:3], rtol=2e-4)
    assert a != pytest.approx(b, rel=0.1)


def polach_by_the_book(vx, vy, phi, a, b, C, limit, k_A=1.0, k_S=1.0):
    """Return Polach's forces directly from the equations of theory.md 2.3."""
    c11, c22, c23, _ = C
    vyC = vy + phi * a if abs(vy + phi * a) > abs(vy) else vy
    v, vC = math.hypot(vx, vy), math.hypot(vx, vyC)
    Cjj = math.hypot(c11 * vx / v, c22 * vy / v) if v > 0 else 0.0
    eps = G * math.pi * a * b * Cjj * vC / (4 * limit)
    F = 2 * limit / math.pi * (k_A * eps / (1 + (k_A * eps) ** 2) + math.atan(k_S * eps))
    kappa = 1 + 6.3 * (1 - math.exp(-a / b))
    eps_s = 8 / 3 * G * b * math.sqrt(a * b) * c23 * abs(vyC) / (kappa * limit)
    D = (eps_s**2 - 1) / (eps_s**2 + 1)
    K = eps_s * (D**3 / 3 - D**2 / 2 + 1 / 6) - (1 - D**2) ** 1.5 / 3
    spin = 9 / 16 * a * limit * kappa * K
    return -F * vx / vC, -F * vy / vC + spin * phi / vC


@pytest.mark.parametrize("reduced", [(1.0, 1.0), (1.0, 0.4), (0.3, 0.1)])
def test_polach_equals_his_formula(reduced):
    rng = np.random.default_rng(3)
    C, inside = kalker.coefficients(kalker.table(NU), math.log(1.5)), 0
    for creepage in rng.normal(0.0, (1e-3, 1e-3, 0.3), (200, 3)):
        wanted = polach_by_the_book(*creepage, 6e-3, 4e-3, C, MU * N, *reduced)
        Fx, Fy, Mz, _ = polach(tuple(creepage), G, 6e-3, 4e-3, C, MU * N, *reduced)
        share = math.hypot(*wanted) / (MU * N)
        inside += share < 1.0
        np.testing.assert_allclose((Fx, Fy), np.array(wanted) / max(1.0, share), rtol=1e-9, atol=1e-6)
        assert Mz == 0.0
    assert inside > 150


def test_polachs_factors_come_with_the_friction(hertzian):
    """With typical values of dry and wet rails, (k_A + k_S)/2 scales the slope at zero creepage; the limit stays mu N."""
    for k_A, k_S in ((1.0, 0.4), (0.3, 0.1)):
        surface = Friction(MU, k_A=k_A, k_S=k_S)
        solve_on = [
            [
                contact.solve(
                    hertzian, contact.Creepage(xi, 0, 0), load=N, friction=f, normal="hertz", tangential="polach"
                )
                for f in (MU, surface)
            ]
            for xi in (1e-8, 1e3)
        ]
        (clean, real), (full, slipping) = ([s.Fx for s in pair] for pair in solve_on)
        assert real == pytest.approx(0.5 * (k_A + k_S) * clean, rel=1e-6)
        assert slipping == pytest.approx(full, rel=1e-3)
        assert full == pytest.approx(-MU * N, rel=1e-3)


def test_polach_has_a_lateral_force_from_spin_alone(ellipse):
    """It would be zero if the test of v_yC were inverted (theory.md 2.3). It vanishes again as spin grows."""
    *_, c, C = shape(ellipse)
    spin = MU * N / (G * c**3 * C[2])
    force = [-solve(ellipse, phi=s * spin, tangential="polach").Fy / (MU * N) for s in (0.1, 1.0, 1e3)]
    assert force[0] == pytest.approx(0.1, abs=0.01)
    assert 0.3 < force[1] < 1.0
    assert force[2] < 0.01


@pytest.mark.parametrize("law", LAWS)
def test_what_a_law_without_fields_leaves_out_is_an_error_that_says_so(law, ellipse):
    sol = solve(ellipse, 1e-3, 5e-4, 0.1, tangential=law)
    assert not sol.has_fields
    for name in ("qx", "qy", "sx", "sy", "stick"):
        with pytest.raises(contact.ContactError, match=f"there is no {name}: tangential = '{law}' gives forces only"):
            getattr(sol, name)
    damage = sol.damage
    for name in ("archard", "stress_index", "energy_index"):
        with pytest.raises(contact.ContactError, match=f"no {name}"):
            getattr(damage, name)
    assert damage.T_gamma == pytest.approx(abs(sol.Fx) * 1e-3 + abs(sol.Fy) * 5e-4, rel=1e-12)
    assert damage.usfd > 0.0
    assert repr(sol)
    assert repr(damage)
    assert sol.pressure(0.0, 0.0) == pytest.approx(sol.max_pressure, rel=1e-6)


@pytest.mark.parametrize("law", LAWS)
def test_power_is_that_of_force_and_moment(law, ellipse):
    sol = solve(ellipse, 1e-3, -7e-4, 0.05, tangential=law)
    power = -(sol.Fx * 1e-3 - sol.Fy * 7e-4 + sol.Mz * 0.05)
    assert sol.power_per_metre == pytest.approx(power, rel=1e-9)
    assert power > 0.0
