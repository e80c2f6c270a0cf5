"""TANG: CONTACT's forces and fields element for element, closed forms, symmetries, Coulomb's law, order of convergence."""

import math
import sys

import numpy as np
import pytest

import contact
import reference
from contact.halfspace import influence, norm, tang
from contact.study.ellipse import ellipse
from contact.theory import kalker

MU, STEEL = 0.3, reference.STEEL
TANG = sys.modules["contact.halfspace.tang"]


def elliptic(a, b, N, n, extra=4):
    """Return x, y and the Hertz pressure of load N on elements 2a/n × 2b/n."""
    s = (np.arange(n + extra) - 0.5 * (n + extra - 1)) * 2.0 / n
    x, y = a * s, b * s
    p = np.sqrt(np.maximum(1.0 - (x / a) ** 2 - (y[:, None] / b) ** 2, 0.0))
    return x, y, p * N / (p.sum() * (x[1] - x[0]) * (y[1] - y[0]))


def resultants(x, y, p, found, c, mu=MU):
    """Return Fx and Fy over mu N, Mz over mu N c."""
    bound = mu * p.sum()
    moment = (x * found.qy).sum() - (y[:, None] * found.qx).sum()
    return np.array([found.qx.sum(), found.qy.sum(), moment / c]) / bound


def on_ellipse(aspect, creepage, n, offset=TANG.OFFSET, c=5e-3, N=5e4):
    x, y, p = elliptic(c * math.sqrt(aspect), c / math.sqrt(aspect), N, n)
    found = tang(p, x, y, contact.Creepage(*creepage), MU, STEEL, offset=offset)
    assert found.converged
    return resultants(x, y, p, found, c)


def extrapolated(aspect, creepage, n=24):
    """Return the limit of vanishing elements, extrapolated from two grids with an error of first order."""
    return 2.0 * on_ellipse(aspect, creepage, 2 * n) - on_ellipse(aspect, creepage, n)


@pytest.mark.parametrize("row", reference.ellipses()[7::38], ids=lambda r: f"{r['curve']} {r['aob']:.2g}")
def test_forces_on_ellipses_are_contacts(row):
    """Set A on CONTACT's own grid, pressure included: 1e-5 of mu N, the digits of the reference."""
    a, b, n = 5e-3 * math.sqrt(row["aob"]), 5e-3 / math.sqrt(row["aob"]), 62
    separation = ellipse(row["aob"], 5e-3, reference.N_ELLIPSE)
    s = (np.arange(n + 4) - 0.5 * (n + 3)) * 2.0 / n
    x, y = a * s, b * s
    gap = separation.A[0] * x**2 + separation.g[0] / separation.y[0] ** 2 * y[:, None] ** 2
    p = norm(gap, x[1] - x[0], y[1] - y[0], STEEL, load=reference.N_ELLIPSE).p
    found = tang(p, x, y, contact.Creepage(row["xi"], row["eta"], row["phi"] * 1e3), MU, STEEL)
    assert found.converged
    true = [row[f"{k}_contact"] for k in ("fx", "fy", "mz")]
    np.testing.assert_allclose(resultants(x, y, p, found, 5e-3), true, atol=1.2e-5)
    assert found.stick.sum() / (p > 0).sum() == pytest.approx(row["adh_contact"], abs=1e-3)


@pytest.mark.parametrize("case", reference.fields(), ids=lambda case: case["name"])
def test_traction_fields_are_contacts(case):
    """Set B (mm, N) on CONTACT's grid, of which every third element is stored, with Hertz's pressure: 1 % in L2."""
    x, y = (v[0] + (np.arange(66) - 1.0) * (v[1] - v[0]) / 3.0 for v in (np.array(case["x"]), np.array(case["y"])))
    p = np.sqrt(np.maximum(1.0 - (x / case["aa"]) ** 2 - (y[:, None] / case["bb"]) ** 2, 0.0))
    p *= case["N"] / (p.sum() * (x[1] - x[0]) * (y[1] - y[0]))
    creepage = contact.Creepage(case["xi"], case["eta"], case["phi"])
    found = tang(p, x, y, creepage, case["mu"], contact.Material(case["G"], case["nu"]))
    assert found.converged
    own = np.stack([found.qx, found.qy])[:, 1::3, 1::3]
    true = np.array([case["qx"], case["qy"]])
    assert np.linalg.norm(own - true) < 0.01 * np.linalg.norm(true)


@pytest.mark.parametrize(
    ("k", "case"), list(enumerate(reference.patches())), ids=lambda v: v["name"] if isinstance(v, dict) else ""
)
def test_pressure_and_forces_on_real_patches_are_contacts(k, case):
    """Set D on CONTACT's grid at its approach: N, peak and pressure to the printed digits, forces in two of seven states."""
    separation, true, h = reference.separation_of(case), case["contact"], 0.2e-3
    x, y = ((np.arange(2 * len(case[k])) * h + 1e-3 * case[k][0]) for k in ("x_p", "y_p"))  # every second one is stored
    y = y[y < separation.y[-1] + 1e-9]
    g, A = (np.interp(y, separation.y, v) for v in (separation.g, separation.A))
    p = norm(g[:, None] + A[:, None] * x**2, h, h, STEEL, approach=case["delta"] * 1e-3).p
    assert p.sum() * h * h == pytest.approx(true["N"], rel=2e-5)
    assert p.max() * 1e-6 == pytest.approx(true["pmax"], rel=2e-5)
    stored = np.array(case["p"])
    own = 1e-6 * p[::2, ::2][: stored.shape[0], : stored.shape[1]]
    assert np.linalg.norm(own - stored) < 3e-4 * np.linalg.norm(stored)
    for state in (k % 7, (k + 3) % 7):
        creepage = contact.Creepage(case["xi"][state], case["eta"][state], case["phi"][state] * 1e3)
        found = resultants(x, y, p, tang(p, x, y, creepage, MU, STEEL), 1e-3)
        expected = np.array([true[n][state] for n in ("Fx", "Fy", "Mz")]) / (MU * true["N"])
        np.testing.assert_allclose(found, expected, atol=1e-4)


@pytest.mark.parametrize("creepage", [(1e-9, 0.0, 0.0), (0.0, 0.0, 2e-5), (0.0, -5e-4, 0.3)])
def test_the_tolerance_belongs_to_the_traction_not_to_the_friction_limit(creepage):
    """At vanishing creepage the traction is a small part of mu p. Its relative error is still 1e-5."""
    s = (np.arange(34) - 16.5) / 16.0
    x, y = 5e-3 * s, 3e-3 * s
    p = 1e9 * np.sqrt(np.maximum(1.0 - s**2 - s[:, None] ** 2, 0.0))
    rough, exact = (tang(p, x, y, contact.Creepage(*creepage), MU, STEEL, tolerance=t) for t in (1e-6, 1e-10))
    for one, other in ((rough.qx, exact.qx), (rough.qy, exact.qy)):
        assert np.linalg.norm(one - other) < 1e-5 * np.linalg.norm((exact.qx, exact.qy))


@pytest.mark.parametrize("aspect", [0.3, 1.0, 3.0])
def test_slopes_at_vanishing_creepage_are_kalkers(aspect):
    """C11, C22 within 1 %, C23 within 2 %, C33 within 3 % of the table; C32 = -C23 by reciprocity."""
    c, tiny, N = 5e-3, 1e-7, 5e4
    unit = tiny * STEEL.shear_modulus * c * c / (MU * N)
    C = [-extrapolated(aspect, tuple(v)) / unit for v in tiny * np.diag([1.0, 1.0, 1.0 / c])]
    c11, c22, c23, c33 = kalker.coefficients(kalker.table(0.28), math.log(aspect))
    assert C[0][0] == pytest.approx(c11, rel=0.01)
    assert C[1][1] == pytest.approx(c22, rel=0.01)
    assert C[2][1] == pytest.approx(c23, rel=0.02)
    assert C[2][2] == pytest.approx(c33, rel=0.03)
    assert C[1][2] == pytest.approx(-c23, rel=0.02)


def test_the_middle_of_a_long_contact_is_carters():
    """theory.md 2.1: f = 2X - X², X = v/(mu a/R), a/R = 2 p0/E*; b = 12 a."""
    a, b = 1e-3, 12e-3
    x, y, p = elliptic(a, b, 2e4, 60)
    limit = MU * 2.0 * p.max() / STEEL.contact_modulus
    for X in (0.2, 0.5, 0.8):
        found = tang(p, x, y, contact.Creepage(-X * limit), MU, STEEL)
        middle = p.shape[0] // 2
        f = found.qx[middle].sum() / (MU * p[middle].sum())
        assert f == pytest.approx(2 * X - X * X, abs=0.02)


HARD = {
    "large spin": (1.0, (0.0, 0.0, 3.0)),
    "lateral against spin": (5.0, (0.0, 8e-4, -0.3)),
    "a/b = 5, pure spin": (5.0, (0.0, 0.0, 0.8)),
    "a/b = 0.2, all": (0.2, (2e-3, -2e-3, 1.5)),
    "nothing": (1.0, (0.0, 0.0, 0.0)),
    "full slip": (1.5, (0.03, -0.04, 0.0)),
}


@pytest.mark.parametrize("name", HARD)
def test_coulombs_law_holds_by_direct_summation(name):
    """Check the conditions that define the unique solution. The slip is summed over all pairs of elements, without FFT."""
    aspect, creep = HARD[name]
    x, y, p = elliptic(5e-3 * math.sqrt(aspect), 5e-3 / math.sqrt(aspect), 5e4, 12)
    found = tang(p, x, y, contact.Creepage(*creep), MU, STEEL, offset=0.5, tolerance=1e-9)
    assert found.converged
    i, j = np.nonzero(p)
    X, Y, dx, dy = x[j], y[i], x[1] - x[0], y[1] - y[0]
    here = influence.tangential(X[:, None] - X, Y[:, None] - Y, dx, dy, STEEL)
    ahead = influence.tangential(X[:, None] - X + dx, Y[:, None] - Y, dx, dy, STEEL)
    xx, yy, xy = ((u - v) / dx for u, v in zip(here, ahead, strict=True))
    qx, qy, stick, bound = found.qx[i, j], found.qy[i, j], found.stick[i, j], MU * p[i, j]
    sx = creep[0] - creep[2] * Y + xx @ qx + xy @ qy
    sy = creep[1] + creep[2] * (X + 0.5 * dx) + xy @ qx + yy @ qy
    small = 1e-6 * MU * p.max() * float(xx[0, 0])
    assert (np.hypot(qx, qy) <= bound * (1 + 1e-12)).all()
    assert np.hypot(sx, sy)[stick].max(initial=0.0) < small
    np.testing.assert_allclose(np.hypot(qx, qy)[~stick], bound[~stick], rtol=1e-12)
    assert np.abs(sx * qy - sy * qx)[~stick].max(initial=0.0) < small * bound.max()
    assert (sx * qx + sy * qy)[~stick].max(initial=-1.0) <= 0.0
    np.testing.assert_allclose(found.sx[i, j], np.where(stick, 0.0, sx), atol=small)
    matrix = np.block([[xx, xy], [xy, yy]])
    assert np.linalg.eigvalsh(matrix + matrix.T).min() > 0.0, "positive definite: the solution is unique"


def test_error_is_of_first_order_in_the_element_length():
    limit = 2.0 * on_ellipse(1.0, (1e-3, 0, 0), 96) - on_ellipse(1.0, (1e-3, 0, 0), 48)
    errors = [abs((on_ellipse(1.0, (1e-3, 0, 0), n) - limit)[0]) for n in (12, 24, 48)]
    assert 0.8 < np.log2(errors[0] / errors[2]) / 2.0 < 1.3


def test_rigid_slip_of_spin_is_best_taken_near_the_centre():
    """theory.md 6: the error under spin is less at x + dx/6, CONTACT's choice, than at x or half an element ahead."""
    creep = (0.0, 0.0, 0.6)
    limit = extrapolated(1.0, creep, 48)
    errors = [abs((on_ellipse(1.0, creep, 24, offset=o) - limit)[1]) for o in (0.0, 1 / 6, 0.5)]
    assert errors[1] < 0.2 * min(errors[0], errors[2])


def test_transient_rolling_leads_to_the_same_steady_state(monkeypatch):
    """This is the fallback if Newton's iteration stalls, forced here by allowing too few steps."""
    x, y, p = elliptic(6e-3, 4e-3, 5e4, 24)
    creep = contact.Creepage(1e-3, -1.5e-3, 0.5)
    direct = tang(p, x, y, creep, MU, STEEL)
    monkeypatch.setattr(sys.modules["contact.halfspace.newton"], "MAX_NEWTON", 4)
    round_about = tang(p, x, y, creep, MU, STEEL)
    assert round_about.iterations > direct.iterations > 4
    assert round_about.converged
    np.testing.assert_allclose(round_about.qx, direct.qx, atol=1e-4 * MU * p.max())


def test_progress_is_reported_and_a_start_saves_steps():
    x, y, p = elliptic(6e-3, 4e-3, 5e4, 24)
    told = []
    one = tang(
        p, x, y, contact.Creepage(1e-3, 0, 0.5), MU, STEEL, progress=lambda step, residual: told.append(residual)
    )
    again = tang(p, x, y, contact.Creepage(1e-3, 0, 0.5), MU, STEEL, start=(one.qx, one.qy))
    assert len(told) == one.iterations + 1
    assert told[-1] <= 1e-6 < told[0]
    assert again.iterations <= 1


def test_without_contact_or_friction_there_is_no_traction():
    x, y, p = elliptic(6e-3, 4e-3, 5e4, 12)
    for pressure, mu in ((0.0 * p, MU), (p, 0.0), (p, 1e-300)):
        found = tang(pressure, x, y, contact.Creepage(1e-3, 0, 0.5), mu, STEEL)
        assert not found.qx.any()
        assert not found.stick.any()
