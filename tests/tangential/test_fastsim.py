"""FASTSIM with its choices of flexibility and bound, and strip theory, against closed forms, CONTACT and the thesis."""

import math

import numpy as np
import pytest

import contact
import reference
from contact.kernels.tangential.ellipses import flexibilities, weighted
from contact.study.ellipse import ellipse
from contact.theory import kalker

N, MU, G, NU = 8e4, 0.3, contact.STEEL.shear_modulus, contact.STEEL.poisson_ratio
ELLIPSES = [contact.Separation.hertzian(1.0, B) for B in (0.4, 1.0, 6.0)]


def solve(separation, vx=0.0, vy=0.0, phi=0.0, tangential="fastsim", **options):
    options = {"normal": "hertz", "n_strips": 60, "n_elements": 60} | options
    return contact.solve(
        separation, contact.Creepage(vx, vy, phi), load=N, friction=MU, tangential=tangential, **options
    )


def kalkers(separation):
    """Return c and Kalker's coefficients of the ellipse."""
    sol = solve(separation)
    return math.sqrt(sol.area / math.pi), kalker.coefficients(kalker.table(NU), math.log(sol.strips.aspect[0]))


@pytest.mark.parametrize("separation", ELLIPSES)
@pytest.mark.parametrize("x", [0.2, 0.7, 1.5, 4.0])
def test_pure_creepage_under_the_elliptic_bound_has_polachs_closed_form(x, separation):
    """A traction that grows linearly meets a semi-ellipse at s = (x² - 1)/(x² + 1), on every strip of an ellipse."""
    c, C = kalkers(separation)
    full = 4.0 * MU * N / (math.pi * G * c * c * C[0])
    sol = solve(separation, -x * full, tangential="fastsim_elliptic")
    assert sol.Fx / (MU * N) == pytest.approx(2.0 / math.pi * (x / (1 + x * x) + math.atan(x)), abs=2e-3)
    assert sol.slip_ratio == pytest.approx(x * x / (1 + x * x), abs=4e-3)
    assert (np.hypot(sol.qx, sol.qy) <= MU * sol.p * (1 + 1e-9)).all()


def test_one_flexibility_is_contacts():
    """CONTACT's own FASTSIM with one flexibility and the parabolic bound, 464 cases on ellipses."""
    rows = reference.ellipses()
    theirs = np.array([[row[f"{k}_fastsim_1flx_par"] for k in ("fx", "fy", "mz")] for row in rows])
    ours = np.empty_like(theirs)
    for aspect in sorted({row["aob"] for row in rows}):
        own = [i for i, row in enumerate(rows) if row["aob"] == aspect]
        creepage = tuple(np.array([rows[i][k] for i in own]) * s for k, s in (("xi", 1), ("eta", 1), ("phi", 1e3)))
        found = contact.forces(
            ellipse(aspect, 5e-3, reference.N_ELLIPSE), creepage, load=reference.N_ELLIPSE, friction=reference.MU,
            material=reference.STEEL, tangential="fastsim_one", n_strips=40, n_elements=40,
        )  # fmt: skip
        scale = reference.MU * reference.N_ELLIPSE
        ours[own] = np.stack([found.Fx / scale, found.Fy / scale, found.Mz / (scale * 5e-3)], axis=1)
    difference = np.abs(ours - theirs)  # reached: median .001, mean .002, max .021; CONTACT's march is of first order
    assert difference.mean() < 2.5e-3
    assert difference.max() < 0.025


def test_the_weighted_flexibility_is_each_of_the_three_for_its_own_creepage():
    L = flexibilities(G, 6e-3, 4e-3, kalker.table(NU))
    c = math.sqrt(24e-6)
    for creepage, wanted in zip(np.diag([1e-3, -2e-3, 0.3]), L, strict=True):
        assert weighted(*creepage, c, *L) == pytest.approx(wanted, rel=1e-14)
    assert weighted(0.0, 0.0, 0.0, c, *L) == L[0]


@pytest.mark.parametrize("method", ["fastsim_linder", "fastsim_stripes"])
def test_local_ellipses_are_the_ellipse_where_there_is_one(method):
    for separation in ELLIPSES:
        for creepage in [(1e-3, 0.0, 0.0), (5e-4, -8e-4, 0.3)]:
            one, other = solve(separation, *creepage), solve(separation, *creepage, tangential=method)
            difference = math.hypot(one.Fx - other.Fx, one.Fy - other.Fy)
            assert difference < 1e-3 * MU * N


def test_local_ellipses_differ_on_a_real_patch_and_carry_the_same_full_slip():
    case = reference.patches()[0]
    separation, forces = reference.separation_of(case), []
    for method in ("fastsim", "fastsim_linder", "fastsim_stripes"):
        sol = solve(separation, 3e-4, 0.0, 0.0, method, normal="analyn")
        forces.append(sol.Fx)
        full = solve(separation, -0.5, 0.0, 0.0, method, normal="analyn")
        assert pytest.approx(MU * N, rel=1e-6) == full.Fx
    assert np.ptp(forces) > 0.001 * MU * N
    assert np.ptp(forces) < 0.2 * MU * N


@pytest.mark.parametrize("separation", ELLIPSES)
def test_linear_theory_on_an_ellipse_gives_kalkers_flexibilities(separation):
    """`fastsim_knothe` uses no table. The rest is the error of the table (theory.md 1.2) and of 18 elements."""
    for creepage in [(3e-4, 0.0, 0.0), (2e-4, -4e-4, 0.2)]:
        one, other = solve(separation, *creepage), solve(separation, *creepage, tangential="fastsim_knothe")
        assert math.hypot(one.Fx - other.Fx, one.Fy - other.Fy) < 5e-3 * MU * N


@pytest.mark.slow
@pytest.mark.parametrize("index", [0, 3, 7])
def test_slopes_of_linear_theory_on_the_patch_itself(index):
    """`fastsim_knothe` has the slopes of boundary elements to 1.7 %; `fastsim` deviates by 20 %."""
    case = reference.patches()[index]
    truth = np.array(reference.linear_slopes()[index]["slopes"])
    tiny = 1e-8
    found = [
        contact.solve(
            reference.separation_of(case), contact.Creepage(*creepage), approach=case["delta"] * 1e-3, friction=MU,
            material=reference.STEEL, normal="strip_halfspace", tangential="fastsim_knothe", n_elements=60,
        )
        for creepage in tiny * np.eye(3)
    ]  # fmt: skip
    slopes = np.array([found[0].Fx, found[1].Fy, found[2].Fy]) / tiny
    np.testing.assert_allclose(slopes, [truth[0, 0], truth[1, 1], truth[2, 1]], rtol=0.02)


@pytest.mark.parametrize("separation", ELLIPSES)
@pytest.mark.parametrize("x", [0.2, 0.5, 0.9, 1.5])
def test_strip_theory_under_pure_creepage_is_haines_and_ollertons(x, separation):
    """F/(mu N) = 1 - 3/2 (t - t³/3 - x acos x), x the half length of slip over a, t² = 1 - x² (theory.md 2.4)."""
    t = math.sqrt(max(1.0 - x * x, 0.0))
    closed = 1.0 - 1.5 * (t - t**3 / 3.0 - x * math.acos(min(x, 1.0)))
    peak = solve(separation).max_pressure
    longitudinal = solve(separation, -x * (1 - NU) * 2.0 * MU * peak / G, tangential="strip_theory")
    lateral = solve(separation, 0.0, -x * 2.0 * MU * peak / G, tangential="strip_theory")
    assert longitudinal.Fx / (MU * N) == pytest.approx(closed, abs=3e-4)
    assert lateral.Fy / (MU * N) == pytest.approx(closed, abs=3e-4)


def test_strip_theory_under_pure_spin_sticks_along_the_middle():
    """Below |psi| = 1 the middle strip carries psi mu p across the rolling direction (thesis 4.16-4.19, xi = eta = 0)."""
    separation = ELLIPSES[1]
    a0, peak = solve(separation, n_strips=61).strips.a.max(), solve(separation).max_pressure
    sol = solve(separation, phi=-0.6 * 2.0 * MU * peak / (G * a0), tangential="strip_theory", n_strips=61)
    np.testing.assert_allclose(sol.qy[30], 0.6 * MU * sol.p[30], rtol=1e-3)
    assert sol.stick[30].all()
