"""Elastic-perfectly plastic limit of the pressure (theory.md 8.4)."""

import dataclasses
import math

import numpy as np
import pytest

import contact
from contact.kernels.normal.press import kept

SEPARATION = contact.Separation.hertzian(1.0, 2.0)
CREEPAGE = contact.Creepage(2e-3, 1e-3, 0.3)
NORMAL = contact.methods().batched.normal


def limited(limit, **options):
    material = dataclasses.replace(contact.STEEL, pressure_limit=limit)
    return contact.solve(SEPARATION, CREEPAGE, material=material, **{"load": 8e4} | options)


@pytest.mark.parametrize("c", [1e-3, 0.3, 0.9, 0.999])
def test_a_cut_semi_ellipse_keeps_the_closed_form_share_of_its_load(c):
    angle = (np.arange(200000) + 0.5) * math.pi / 200000
    cut = (np.minimum(np.sin(angle), c) * np.sin(angle)).sum() * math.pi / 200000
    assert kept(c) == pytest.approx(cut / (math.pi / 2), rel=1e-9)


@pytest.mark.parametrize("normal", NORMAL)
@pytest.mark.parametrize("share", [0.95, 0.6, 0.2])
def test_the_cut_pressure_carries_the_load_and_stays_below_the_limit(normal, share):
    elastic = contact.solve(SEPARATION, CREEPAGE, load=8e4, normal=normal)
    limit = share * elastic.max_pressure
    sol = limited(limit, normal=normal)
    assert sol.N == 8e4
    assert (sol.p * sol.dA).sum() == pytest.approx(8e4, rel=1e-9)
    assert (0.5 * math.pi * sol.strips.p0 * sol.strips.a * sol.strips.dy).sum() == pytest.approx(8e4, rel=1e-9)
    assert sol.max_pressure == limit
    assert sol.p.max() <= limit * (1.0 + 1e-9)
    assert sol.approach > elastic.approach
    assert sol.area > elastic.area
    again = limited(limit, load=None, approach=sol.approach, normal=normal)
    assert pytest.approx(8e4, rel=1e-3 if NORMAL[normal].interacting else 1e-9) == again.N


@pytest.mark.parametrize("share", [0.95, 0.6, 0.2])
def test_the_cut_ellipsoid_is_that_of_hertz_at_a_higher_load(share):
    """The limit leaves 3c/2 - c³/2 of a semi-ellipsoid's load, c = p_c/p0, and p0 ~ load^(1/3). Strips agree to 1e-3."""
    elastic = contact.solve(SEPARATION, CREEPAGE, load=8e4, normal="hertz")
    low, high = 1.0, 1e6
    for _ in range(200):
        times = math.sqrt(low * high)
        c = share / times ** (1.0 / 3.0)
        low, high = (times, high) if times * (1.5 * c - 0.5 * c**3) < 1.0 else (low, times)
    sol = limited(share * elastic.max_pressure, normal="hertz", n_strips=60)
    assert sol.approach / elastic.approach == pytest.approx(times ** (2.0 / 3.0), rel=1e-3)


@pytest.mark.parametrize("normal", NORMAL)
def test_a_limit_that_is_not_reached_changes_nothing(normal):
    one, other = (limited(limit, normal=normal) for limit in (math.inf, 1e11))
    for name in ("Fx", "Fy", "Mz", "N", "approach", "normal_stiffness", "max_pressure"):
        assert getattr(one, name) == getattr(other, name)
    assert (one.p == other.p).all()
    assert (one.qy == other.qy).all()


@pytest.mark.parametrize("normal", ["analyn", "stripes_a", "strip_halfspace"])
def test_the_load_is_continuous_where_the_limit_is_reached_and_rises_with_the_approach(normal):
    elastic = contact.solve(SEPARATION, CREEPAGE, load=8e4, normal=normal)
    material = dataclasses.replace(contact.STEEL, pressure_limit=elastic.max_pressure)
    approach = elastic.approach * np.linspace(0.9, 1.4, 101)
    N = contact.forces(SEPARATION, CREEPAGE, approach=approach, normal=normal, material=material).N
    slope = np.diff(N)
    assert (slope > 0.0).all()
    assert abs(np.diff(slope)).max() < 0.05 * slope.mean()


@pytest.mark.parametrize("normal", ["analyn", "stripes_a", "strip_halfspace"])
def test_the_stiffness_is_the_slope_of_the_cut_load(normal):
    limit = 0.6 * contact.solve(SEPARATION, CREEPAGE, load=8e4).max_pressure
    sol = limited(limit, normal=normal)
    step = 0.03 * sol.approach
    ahead, behind = (limited(limit, load=None, approach=sol.approach + s, normal=normal).N for s in (step, -step))
    assert sol.normal_stiffness == pytest.approx((ahead - behind) / (2.0 * step), rel=0.02)


@pytest.mark.parametrize("tangential", contact.methods().batched.tangential)
def test_friction_acts_on_the_cut_pressure(tangential):
    method = contact.methods().tangential[tangential]
    elastic = contact.solve(SEPARATION, CREEPAGE, load=8e4)
    for creepage in (CREEPAGE, contact.Creepage(0.3, 0.0, 0.0)):
        material = dataclasses.replace(contact.STEEL, pressure_limit=0.5 * elastic.max_pressure)
        sol = contact.solve(SEPARATION, creepage, load=8e4, material=material, tangential=tangential)
        if method.fields and method.admissible:
            assert (np.hypot(sol.qx, sol.qy) <= 0.3 * sol.p * (1.0 + 1e-12)).all()
    if method.saturates:
        assert sol.Fx == pytest.approx(-0.3 * 8e4, rel=2e-3)
        if method.fields and method.admissible:
            assert (sol.qx * sol.dA).sum() == pytest.approx(-0.3 * 8e4, rel=2e-3)


def test_the_pressure_at_points_is_the_cut_one():
    limit = 0.6 * contact.solve(SEPARATION, CREEPAGE, load=8e4).max_pressure
    sol = limited(limit, n_elements=200)
    inner = slice(10, -10)  # the first and last elements are averages over a steep pressure
    np.testing.assert_allclose(sol.pressure(sol.x, sol.y)[:, inner], sol.p[:, inner], atol=5e-3 * limit)


@pytest.mark.parametrize("limit", [1e3, 1e6])
def test_a_limit_too_low_for_the_load_is_reported_by_the_status(limit):
    y = np.linspace(-5e-3, 5e-3, 101)
    material = dataclasses.replace(contact.STEEL, pressure_limit=limit)
    sol = contact.solve(contact.Separation(y, y**2, 1.0), CREEPAGE, load=8e4, material=material, throw=False)
    assert sol.status in (contact.Status.OUT_OF_RANGE, contact.Status.NOT_CONVERGED)
    assert all(map(math.isfinite, (sol.Fx, sol.Fy, sol.N, sol.approach)))
