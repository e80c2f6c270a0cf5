"""Flash temperature of the strips (theory.md 8.5)."""

import math

import numpy as np
import pytest

import contact
from contact.damage.temperature import Thermal, flash_temperature, heating


def elliptic(n, a, flux):
    edges = a * np.cos(np.arange(n + 1) * math.pi / n)
    x = 0.5 * (edges[:-1] + edges[1:])
    return x, flux * np.sqrt(1.0 - (x / a) ** 2), edges


def test_elliptic_heat_has_its_published_maximum_behind_the_middle():
    """2.188 times mu p0 s √a over 2 β √(πV), at x = -.65 a."""
    x, flux, edges = elliptic(400, 1.0, 1.0)
    rise = heating(flux, edges, 1.0, Thermal()) * 2.0 * Thermal().penetration * math.sqrt(math.pi)
    assert rise.max() == pytest.approx(2.188, abs=5e-4)
    assert x[rise.argmax()] == pytest.approx(-0.65, abs=0.01)


@pytest.mark.parametrize(("n", "error"), [(30, 2e-3), (120, 3e-4)])
def test_the_example_of_ertz_and_knothe_heats_up_by_150_kelvin(n, error):
    """a = 5.88 mm, p0 = 770.6 MPa, mu = .3, s = 1 m/s, V = 30 m/s: 150.3 K with rigid slip."""
    _, flux, edges = elliptic(n, 5.88e-3, 0.3 * 770.6e6)
    assert heating(flux, edges, 30.0, Thermal()).max() == pytest.approx(150.3, rel=error)


def test_constant_heat_rises_with_the_square_root_of_the_way():
    edges = np.linspace(1.0, -1.0, 2001)
    middle = 0.5 * (edges[:-1] + edges[1:])
    rise = heating(np.full(2000, 3.0), edges, 4.0, Thermal())
    np.testing.assert_allclose(rise, 3.0 * np.sqrt(1.0 - middle) / (Thermal().penetration * math.sqrt(4.0 * math.pi)))


@pytest.mark.parametrize(
    "options", [{"tangential": "fastrip"}, {"tangential": "fastrip_mapped"}, {"normal": "halfspace"}]
)
def test_a_sliding_patch_is_as_hot_as_its_hottest_strip_by_the_closed_form(options):
    """Creepage is far above saturation, so only the rigid slip heats."""
    if "normal" in options:
        options |= {"tangential": "halfspace", "spacing": 0.25e-3}
    xi, V = 0.3, 10.0
    sol = contact.solve(contact.Separation.hertzian(1.0, 1.0), contact.Creepage(xi), load=8e4, speed=V, **options)
    exact = contact.hertz(1.0, 1.0, load=8e4)
    unit = 0.3 * exact.p0 * xi * V * math.sqrt(exact.a) / (2.0 * Thermal().penetration * math.sqrt(math.pi * V))
    assert flash_temperature(sol).max() == pytest.approx(2.188 * unit, rel=2e-2)


def test_adhesion_stays_cold_and_temperature_grows_with_the_root_of_the_speed():
    slow, fast = (
        contact.solve(contact.Separation.hertzian(1.0, 1.0), contact.Creepage(1e-3), load=8e4, speed=V)
        for V in (5.0, 20.0)
    )
    cold, hot = flash_temperature(slow), flash_temperature(fast)
    assert (cold[slow.stick] == 0.0).all()
    assert (cold >= 0.0).all()
    np.testing.assert_allclose(hot, 2.0 * cold)


def test_a_law_without_slip_is_refused():
    sol = contact.solve(contact.Separation.hertzian(1.0, 1.0), contact.Creepage(1e-3), load=8e4, tangential="polach")
    with pytest.raises(contact.ContactError, match="'polach' gives no slip"):
        flash_temperature(sol)
