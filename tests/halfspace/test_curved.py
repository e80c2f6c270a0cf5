"""Influence numbers of a bent surface: symmetry, the inclined plane, CONTACT's grooves."""

import math

import numpy as np
import pytest

import contact
from contact.halfspace.curved import BentCoupling, Curved
from contact.halfspace.influence import Influence
from contact.stress import SurfaceLoad

BOTH = {"normal": "halfspace", "tangential": "halfspace", "conformal": True}
BALL = 10e-3


def groove(radius):
    """A ball of 10 mm in a groove, on a wheel of 420 mm (set M)."""
    y = np.linspace(-8e-3, 8e-3, 801)
    wheel, rail = (np.sqrt(r**2 - y**2) - r for r in (BALL, radius))
    tilt = -0.5 * sum(y / np.sqrt(r**2 - y**2) for r in (BALL, radius))
    return contact.Separation(y, rail - wheel, 0.5 / (0.42 + wheel), tilt=tilt, rolling=1.0 / 0.42)


@pytest.mark.parametrize(
    ("radius", "Fx", "pmax", "approach"),
    # CONTACT 25.1 (rev 2707), influence on the bent surface, variant 4; Fx on the wheel
    [(10.25e-3, -26.74, 530.63e6, 21.965e-6), (10.10e-3, -571.47, 406.05e6, 18.912e-6)],
)
def test_a_ball_in_a_groove_has_the_force_and_pressure_of_contact(radius, Fx, pmax, approach):
    s = contact.solve(groove(radius), contact.Creepage(-2e-4), load=1e4, spacing=(0.2e-3, 0.25e-3), **BOTH)
    assert pytest.approx(1e4, rel=1e-6) == s.N
    assert s.Fx == pytest.approx(Fx, abs=1e-3 * 3e3)
    assert s.max_pressure == pytest.approx(pmax, rel=3e-3)
    assert s.approach == pytest.approx(approach, rel=1e-3)
    assert s.Fy == pytest.approx(0.0, abs=1e-6 * 3e3)
    flat = contact.solve(
        groove(radius), contact.Creepage(-2e-4), load=1e4, spacing=(0.2e-3, 0.25e-3), **BOTH | {"conformal": False}
    )
    assert abs(flat.Fx - Fx) > 0.15 * 3e3


def test_on_a_plane_that_is_inclined_the_patch_is_that_of_hertz():
    """All angles are equal, so there is no coupling; the load along the local normal is N/cos, the curvature B cos³."""
    slope, A, B, N = 0.3, 1.1, 0.8, 5e4
    y = np.linspace(-15e-3, 15e-3, 301)
    inclined = contact.Separation(y, B * y**2, A, tilt=slope)
    cosine = 1.0 / math.hypot(1.0, slope)
    level = contact.Separation(y, B * cosine**3 * y**2, A * cosine)
    options = {"friction": 0.0, "spacing": 0.2e-3, "normal": "halfspace", "tangential": "halfspace"}
    s = contact.solve(inclined, contact.Creepage(), load=N, conformal=True, **options)
    p = contact.solve(level, contact.Creepage(), load=N / cosine, **options)
    assert s.max_pressure == pytest.approx(p.max_pressure, rel=1e-4)
    assert s.approach * cosine == pytest.approx(p.approach, rel=1e-4)
    assert s.Fy == pytest.approx(slope * N, rel=1e-6)
    assert s.width == pytest.approx(p.width * cosine, rel=1e-3)


@pytest.fixture(scope="module")
def numbers():
    rng = np.random.default_rng(3)
    shape, angle = (7, 5), np.linspace(-0.6, 0.9, 7)
    size = shape, 1e-3, 2e-3, contact.STEEL
    return Curved(*size, angle), BentCoupling(*size, angle), Influence(*size), rng.normal(size=(4, *shape)), angle


def test_the_normal_numbers_are_symmetric(numbers):
    curved, _, flat, (p, other, *_), _ = numbers
    assert (other * curved.normal(p)).sum() == pytest.approx((p * curved.normal(other)).sum(), rel=1e-12)
    assert abs(curved.normal(p) - flat.normal(p)).max() > 0.05 * abs(flat.normal(p)).max()


def test_traction_opens_the_gap_by_the_work_of_the_pressure_on_its_displacement(numbers):
    """The displacement is summed from the slip: no traction reaches beyond the last column, so it fades ahead only."""
    _, coupling, _, (p, qx, qy, _), angle = numbers
    n, dx = 600, 1e-3
    long_ = BentCoupling((7, n), dx, 2e-3, contact.STEEL, angle)
    wide = [np.pad(f, ((0, 0), (0, n - 5))) for f in (p, qx, qy)]
    slip = long_.slip(wide[0], 0.0 * wide[1], 0.0 * wide[2])
    ux, uy = dx * np.cumsum(slip[:, :, ::-1], axis=2)[:, :, ::-1][:, :, :5]
    opening = coupling.opening(qx, qy) * np.cos(angle)[:, None]
    assert (ux * qx + uy * qy).sum() == pytest.approx((opening * p).sum(), rel=0.02)


def test_stresses_take_the_pressure_along_the_surface():
    s = contact.solve(groove(10.10e-3), contact.Creepage(-2e-4), load=1e4, spacing=0.4e-3, **BOTH)
    load = SurfaceLoad.of(s)
    assert load.steps == pytest.approx((0.4e-3, 0.4e-3), rel=1e-9)
    assert load.qx.sum() * 0.16e-6 == pytest.approx(s.Fx, rel=1e-9)
    along = s.dA * np.hypot(1.0, s.strips.tilt)[:, None]
    assert load.p.sum() * 0.16e-6 == pytest.approx((s.p * along).sum(), rel=1e-9)
    middle = s.pressure(s.x, s.y)
    np.testing.assert_allclose(middle, s.p, rtol=1e-6, atol=1e-6 * s.max_pressure)


def test_bad_input_is_refused():
    y = np.linspace(-8e-3, 8e-3, 41)
    gap = contact.halfspace.Gap(y, y, 0.5 * (y**2 + y[:, None] ** 2))
    with pytest.raises(contact.ContactError, match="conformal: a gap on a grid has only the contact plane"):
        contact.solve(gap, contact.Creepage(), load=1e4, **BOTH)
    for name, value in (("tilt", 1e4), ("tilt", math.nan), ("rolling", 2e3)):
        with pytest.raises(contact.ContactError, match=name):
            contact.Separation(y, 0.5 * y**2, 1.0, **{name: value})
