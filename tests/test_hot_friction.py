"""Friction that falls with temperature (theory.md 8.5; CONTACT's law 6)."""

import math
from dataclasses import replace

import numpy as np
import pytest

import contact
from contact.damage.temperature import flash_temperature
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.inputs.material import Thermal
from contact.pair import WheelRailPair

SEPARATION = contact.Separation.hertzian(1.0, 2.0)
METHODS = contact.methods().batched.tangential
FIELDS = [name for name, method in METHODS.items() if method.fields]
HALF_SPACE = {"normal": "halfspace", "tangential": "halfspace", "spacing": 0.5e-3}
#: Partial slip, full slip, stick after slip, spin.
CREEPAGES = [(1e-3, 5e-4, 0.3), (2e-2, 5e-3, 0.0), (0.0, 2e-3, -0.9), (1e-4, 0.0, 4.0)]
#: The same slope as in CONTACT's examples (constants.md 8): .30 falls by .18 over 400 K.
HOT = Friction(0.3, hot_factor=0.4, temperature_range=400.0)


def solve(creepage, friction=HOT, speed=30.0, **options):
    return contact.solve(SEPARATION, contact.Creepage(*creepage), load=8e4, friction=friction, speed=speed, **options)


def forces(solution):
    return solution.Fx, solution.Fy, solution.Mz, solution.power_per_metre


def law(friction, rise):
    """Return the coefficient at a rise [K] above the temperature of the bodies."""
    over = friction.background_temperature + rise - friction.reference_temperature
    share = np.clip(over / friction.temperature_range, 0.0, 1.0)
    return friction.static * (1.0 - (1.0 - friction.hot_factor) * share)


@pytest.mark.parametrize("velocity", ["global", "local", "greatest"])
@pytest.mark.parametrize("tangential", FIELDS)
def test_a_reference_temperature_that_is_never_reached_changes_no_bit(tangential, velocity):
    cold = Friction.polach(velocity=velocity)
    for creepage in CREEPAGES:
        one = solve(creepage, cold, tangential=tangential)
        unreached = replace(cold, hot_factor=0.1, reference_temperature=9e4)
        same = solve(creepage, unreached, tangential=tangential)
        assert forces(one) == forces(same)
        assert (one.qx == same.qx).all()
        assert (one.stick == same.stick).all()


@pytest.mark.parametrize("options", [{"tangential": "fastrip"}, {"tangential": "fastrip_mapped"}, HALF_SPACE])
def test_in_fast_sliding_every_element_has_the_coefficient_of_its_own_temperature(options):
    """The temperature computed from the traction gives this traction again. The hottest element has the lowest."""
    sol = solve((0.05, 0.02, 0.0), **options)
    rise = flash_temperature(sol)
    assert rise.max() > 250.0
    inside = sol.p > 0.0
    used = np.hypot(sol.qx, sol.qy)[inside] / sol.p[inside]
    np.testing.assert_allclose(used, law(HOT, rise)[inside], rtol=3e-3 if options is HALF_SPACE else 1e-9)
    assert used.min() == pytest.approx(law(HOT, rise.max()), rel=3e-3)


def test_little_heat_lowers_the_force_by_the_closed_form_of_elliptic_heat():
    """To first order mu N - F = ∫ p mu' ΔT dA with the flash temperature of mu p, that is of unchanged elliptic heat.

    For a strip ∫∫ √(1-s²)√(1-t²)/√(t-s) dt ds = 1.43, here by Gauss-Chebyshev quadrature with 2000 points.
    """
    n = 2000
    angle = (np.arange(n) + 0.5) * math.pi / n
    s = np.cos(angle)
    edge = np.cos(np.arange(n + 1) * math.pi / n)
    inner = np.array(
        [
            (np.sin(angle[: k + 1]) * -np.diff(2.0 * np.sqrt(np.maximum(edge[: k + 2] - c, 0.0)))).sum()
            for k, c in enumerate(s)
        ]
    )
    number = (np.sin(angle) ** 2 * inner).sum() * math.pi / n
    xi, V = 0.3, 1e-3
    friction = replace(HOT, hot_factor=0.9)
    cold, warm = (solve((xi, 0.0, 0.0), f, V, n_strips=60, n_elements=200) for f in (Friction(0.3), friction))
    strips = cold.strips
    heat = 0.3 * strips.p0 * xi * V * np.sqrt(strips.a) * Thermal().heating / math.sqrt(V)
    expected = (0.3 * 0.1 / 400.0 * strips.p0 * strips.a * strips.dy * heat * number).sum()
    assert warm.Fx - cold.Fx == pytest.approx(expected, rel=5e-3)
    assert expected < 0.02 * abs(cold.Fx)


@pytest.mark.parametrize("creepage", [(0.1, 0.0, 0.0), (0.04, 0.03, 0.0), (0.05, 0.0, 2.0)])
def test_gross_sliding_agrees_with_the_half_space(creepage):
    """The strips agree within 2 % of the fall from mu N, which is 20 to 60 % here."""
    full = solve(creepage, **HALF_SPACE)
    fall = 0.3 * full.N - math.hypot(full.Fx, full.Fy)
    for tangential in ("fastrip", "fastrip_mapped"):
        sol = solve(creepage, tangential=tangential)
        assert 0.3 * sol.N - math.hypot(sol.Fx, sol.Fy) == pytest.approx(fall, rel=0.03)


@pytest.mark.parametrize("tangential", FIELDS)
def test_heat_is_the_frictional_power(tangential):
    for creepage in CREEPAGES:
        sol = solve(creepage, tangential=tangential, n_elements=60)
        flux = -(sol.qx * sol.sx + sol.qy * sol.sy)
        if METHODS[tangential].admissible:
            assert (np.hypot(sol.qx, sol.qy) <= 0.3 * sol.p * (1.0 + 1e-12)).all()
        assert (flux >= 0.0).all()
        assert (flux * sol.dA).sum() == pytest.approx(sol.power_per_metre, rel=1e-9)


@pytest.mark.parametrize("tangential", FIELDS)
def test_force_falls_with_temperature_to_the_hot_friction(tangential):
    """Over the temperature of the bodies it is monotone, continuous where heating begins to act, and has both limits."""
    unreached, hottest, until = Friction(0.3), Friction(0.3 * 0.4), replace(HOT, reference_temperature=1600.0)
    for creepage in ((0.05, 0.0, 0.0), (0.0, 0.02, 0.2)):
        cold = np.hypot(*forces(solve(creepage, unreached, tangential=tangential))[:2])
        sweep = np.linspace(600.0, 2000.0, 141)
        found = [
            np.hypot(*forces(solve(creepage, replace(until, background_temperature=t), tangential=tangential))[:2])
            for t in sweep
        ]
        assert found[0] == cold
        change = -np.diff(found) / cold
        assert (change >= -1e-12).all()
        assert change.max() < 0.02
        last = np.hypot(*forces(solve(creepage, hottest, tangential=tangential))[:2])
        assert found[-1] == pytest.approx(last, rel=1e-9)


@pytest.mark.parametrize("tangential", [*METHODS, "halfspace"])
def test_warm_bodies_have_less_friction_everywhere(tangential):
    """Bodies above the range have the hot coefficient, also in stick and for laws that give only forces."""
    options = HALF_SPACE if tangential == "halfspace" else {"tangential": tangential}
    for background, coefficient in ((2000.0, 0.12), (293.15 + 200.0, 0.21)):
        bodies = replace(HOT, background_temperature=background)
        for creepage in CREEPAGES[:2]:
            one = solve(creepage, bodies, speed=1e-12, **options)  # no frictional heating
            other = solve(creepage, Friction(coefficient), speed=1e-12, **options)
            np.testing.assert_allclose(forces(one), forces(other), rtol=1e-5, atol=1e-6)


def test_pairs_apply_hot_friction():
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)))
    cold, hot = (pair.solve(Pose(y=3e-3, yaw=2e-2), load=8e4, friction=f).force for f in (0.3, HOT))
    assert np.hypot(hot[0], hot[1]) < 0.97 * np.hypot(cold[0], cold[1])


@pytest.mark.parametrize("tangential", FIELDS)
def test_extreme_values_leave_no_nan(tangential):
    thermal = Thermal(1e-6, 1e-6, 1e-6)
    for speed in (5e-324, 1e-300, 1e300):
        for creepage in ((1e6, 0.0, 0.0), (0.0, -1e6, 1e6), (1e-300, 0.0, 1e-300)):
            for options in ({"temperature_range": 5e-324}, {"hot_factor": 0.0, "background_temperature": 1e5}, {}):
                friction = replace(Friction(1e6, hot_factor=0.5), thermal=thermal, **options)
                for f in (friction, replace(friction, law="linear", velocity="greatest", kinetic=0.0)):
                    sol = solve(creepage, f, speed, tangential=tangential, throw=False)
                    assert all(map(math.isfinite, (sol.Fx, sol.Fy, sol.Mz, sol.slip_area)))
