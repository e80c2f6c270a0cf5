"""A layer between the bodies: full yield in closed form, CONTACT's creep curves, hardening law, limits, errors."""

import math

import numpy as np
import pytest

import contact
import reference
from contact.friction import Friction
from contact.halfspace import Gap

STEEL, MU, N = reference.STEEL, 0.35, 70685.835
BOTH = {"normal": "halfspace", "tangential": "halfspace"}
#: Half curvatures [1/m] of the gap of set K, whose Hertz ellipse is 5 mm × 7.5 mm under p0 = 900 MPa.
A, B = 1.35356580, 0.73602868
#: Set K, CONTACT 25.1: layer (G3 [MPa], thickness [mm], yield stress [MPa], hardening [N/mm³]), creepage, force of muN.
CURVES = [
    ((100.0, 0.02, 0.0, 0.0), 0.0012, -0.1031528),
    ((100.0, 0.02, 0.0, 0.0), 0.005, -0.4003753),
    ((100.0, 0.02, 120.0, 0.0), 0.0012, -0.1031528),
    ((100.0, 0.02, 120.0, 0.0), 0.005, -0.36567631),
    ((106.25, 0.02, 100.0, 200.0), 0.0012, -0.10826429),
    ((106.25, 0.02, 100.0, 200.0), 0.005, -0.34677892),
    ((176.63, 0.02, 200.0, -300.0), 0.0012, -0.157973),
    ((176.63, 0.02, 200.0, -300.0), 0.005, -0.55249045),
    ((176.63, 0.02, 200.0, -300.0), 0.08, -0.51975728),
    ((1.0, 0.0, 150.0, 0.0), 0.0012, -0.46372577),
    ((1.0, 0.0, 150.0, 0.0), 0.005, -0.65957927),
]


def gap(n=36):
    s = (2.0 * np.arange(n) + 1.0) / n - 1.0
    x, y = 1.05 * 5e-3 * s, 1.05 * 7.5e-3 * s
    return Gap(x, y, A * x**2 + B * y[:, None] ** 2)


def solve(creepage, layer, n=36):
    return contact.solve(gap(n), contact.Creepage(creepage), load=N, friction=MU, material=STEEL, layer=layer, **BOTH)


@pytest.mark.parametrize(("layer", "creepage", "force"), CURVES)
def test_the_creep_curves_are_contacts(layer, creepage, force):
    G3, thickness, strength, hardening = layer
    body = contact.ThirdBody(1e-9 * thickness / G3, 1e6 * strength or math.inf, 1e9 * hardening)
    assert solve(-creepage, body).Fx / (MU * N) == pytest.approx(-force, abs=5e-6)


def test_a_layer_that_yields_everywhere_carries_the_limited_traction():
    """F/(mu N) = (3c - c³)/2 with c = tau_c/(mu p0), on an ellipse."""
    c = 0.4
    s = solve(0.1, contact.ThirdBody(0.0, c * MU * 900e6))
    assert -s.Fx / (MU * N) == pytest.approx(0.5 * (3.0 * c - c**3), rel=3e-3)
    assert s.layer.plastic.any()
    assert (np.hypot(s.qx, s.qy) <= c * MU * 900e6 * (1.0 + 1e-9)).all()


@pytest.mark.parametrize("hardening", [2e11, -5e10])
def test_traction_yield_stress_and_shear_agree(hardening):
    """tau_c follows from the plastic shear, the traction is tau_c where the layer yields, and nothing slips there."""
    s = solve(4e-3, contact.ThirdBody(2e-13, 150e6, hardening))
    state, inside, size = s.layer, s.p > 0.0, np.hypot(s.qx, s.qy)
    yielding = state.plastic & (np.hypot(s.sx, s.sy) <= 1e-9)
    assert yielding.sum() > 20
    np.testing.assert_allclose(size[yielding], state.yield_stress[yielding], rtol=1e-4)
    # the path along x: plastic shear of each row grows monotonically, so its size is its sum
    shear = np.hypot(state.ux, state.uy)
    np.testing.assert_allclose(state.yield_stress[inside], (150e6 + hardening * shear)[inside], rtol=2e-3)
    assert (size <= MU * s.p * (1.0 + 1e-9)).all()
    assert state.power_per_metre > 0.0
    assert state.ux[yielding].max() <= 0.0


def test_no_layer_and_a_strong_stiff_layer_are_the_same():
    bare = solve(1e-3, None)
    assert bare.layer is None
    strong = solve(1e-3, contact.ThirdBody(0.0, 1e12))
    assert strong.Fx == pytest.approx(bare.Fx, rel=1e-6)
    assert not strong.layer.plastic.any()


def test_the_slope_of_a_layer_serves_the_fast_methods():
    separation, creepage = contact.Separation.hertzian(1.1, 0.8), contact.Creepage(2e-5)
    for flexibility in (4e-15, 2e-14, 2e-13):
        layer = contact.ThirdBody(flexibility)
        fast = contact.solve(separation, creepage, load=8e4)
        slope = layer.slope(fast.strips, fast.material)
        fast = contact.solve(separation, creepage, load=8e4, friction=Friction(0.3, slope=slope))
        full = contact.solve(separation, creepage, load=8e4, layer=layer, spacing=0.3e-3, **BOTH)
        assert fast.Fx == pytest.approx(full.Fx, rel=0.07)


def test_given_forces_and_pressure_of_other_methods_take_a_layer():
    separation, layer = contact.Separation.hertzian(1.1, 0.8), contact.ThirdBody(4e-15, 150e6)
    found = contact.solve(separation, contact.Creepage(), load=8e4, layer=layer, force=8e3, tangential="halfspace")
    assert found.Fx == pytest.approx(8e3, abs=0.1)
    much = contact.solve(separation, contact.Creepage(), load=8e4, layer=layer, force=23.9e3, tangential="halfspace")
    assert much.status is contact.Status.UNREACHABLE
    assert contact.solve(separation, contact.Creepage(), load=0.0, layer=layer, **BOTH).status.name == "NO_CONTACT"
