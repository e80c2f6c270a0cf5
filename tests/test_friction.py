"""Falling friction and reduced creep stiffness (theory.md 8.1, 8.2; constants.md 6, 7)."""

import dataclasses
import math

import numpy as np
import pytest

import contact
from contact.friction import LAWS, Friction

FALLING = [law for law in LAWS if law != "coulomb"]
SEPARATION = contact.Separation.hertzian(1.0, 2.0)
TANGENTIAL = list(contact.methods().batched.tangential)


def solve(creepage, **options):
    return contact.solve(SEPARATION, contact.Creepage(*creepage), load=8e4, **options)


@pytest.mark.parametrize("law", FALLING)
def test_half_of_the_fall_is_at_the_half_speed(law):
    friction = Friction(0.5, 0.2, half_speed=1.5, law=law)
    assert friction.coefficient(0.0) == 0.5
    assert friction.coefficient(1.5) == pytest.approx(0.35, rel=1e-14)
    values = friction.coefficient(np.linspace(0.0, 30.0, 61))
    assert (np.diff(values) <= 0.0).all()
    assert 0.2 <= values[-1] < 0.23


def test_the_linear_law_is_kinetic_from_twice_the_half_speed_on():
    friction = Friction(0.5, 0.2, half_speed=1.5, law="linear")
    assert friction.coefficient(3.0) == 0.2


@pytest.mark.parametrize(("static", "A", "B"), [(0.55, 0.40, 0.60), (0.30, 0.40, 0.20)])
def test_polachs_dry_and_wet_rails_are_his_equation(static, A, B):
    w = np.array([0.0, 0.1, 1.0, 5.0])
    expected = static * ((1.0 - A) * np.exp(-B * w) + A)
    np.testing.assert_allclose(Friction.polach(static, A, B).coefficient(w), expected, rtol=1e-14)


@pytest.mark.parametrize("tangential", [*TANGENTIAL, "halfspace"])
def test_a_falling_law_gives_the_forces_of_its_coefficient_at_the_global_slip_velocity(tangential):
    creepage, speed = (4e-3, 3e-3, 0.2), 30.0
    friction = Friction.polach()
    options = {"tangential": tangential, "n_strips": 10, "n_elements": 10}
    if tangential == "halfspace":
        options["normal"] = "halfspace"
    one = solve(creepage, friction=friction, speed=speed, **options)
    assert one.friction == pytest.approx(friction.coefficient(30.0 * 5e-3), rel=1e-14)
    other = solve(creepage, friction=one.friction, speed=speed, **options)
    np.testing.assert_allclose((one.Fx, one.Fy, one.Mz), (other.Fx, other.Fy, other.Mz), rtol=1e-12)


def test_adhesion_over_creepage_has_a_maximum_and_falls_to_the_kinetic_part():
    xi = np.geomspace(1e-5, 1.0, 40)
    Fx = -contact.forces(SEPARATION, (xi, 0.0, 0.0), load=8e4, friction=Friction.polach(), speed=20.0).Fx / 8e4
    top = int(np.argmax(Fx))
    assert 0 < top < 39
    assert (np.diff(Fx[: top + 1]) > 0.0).all()
    assert (np.diff(Fx[top:]) < 0.0).all()
    assert Fx[-1] == pytest.approx(0.4 * 0.55, rel=1e-4)


@pytest.mark.parametrize("tangential", TANGENTIAL)
def test_the_slope_scales_the_linear_range_and_leaves_saturation(tangential):
    small, large = (1e-7, 1e-7, 1e-5), (0.1, 0.1, 0.0)
    clean, dirty = Friction(0.3), Friction(0.3, slope=0.4)
    for attribute in ("Fx", "Fy"):
        one, other = (getattr(solve(small, tangential=tangential, friction=f), attribute) for f in (clean, dirty))
        assert other == pytest.approx(0.4 * one, rel=2e-3)
    if contact.methods().tangential[tangential].saturates:
        one, other = (solve(large, tangential=tangential, friction=f) for f in (clean, dirty))
        assert math.hypot(other.Fx, other.Fy) == pytest.approx(math.hypot(one.Fx, one.Fy), rel=2e-2)


def test_spiryagins_factor_falls_from_k0_to_its_limit():
    """k = k0 (α + (1 - α)/(1 + β eps)), where eps for longitudinal creepage is π/4 k0 times the linear force over mu N."""
    published = Friction(0.36, slope=0.54, slope_far=0.02, slope_rate=0.64)

    for xi in (1e-9, 1e-4, 1e-3, 1e-2, 1.0):
        clean = solve((xi, 0.0, 0.0), tangential="linear").Fx
        eps = 0.25 * math.pi * 0.54 * abs(clean) / (0.36 * 8e4)
        dirty = solve((xi, 0.0, 0.0), tangential="linear", friction=published).Fx
        assert dirty == pytest.approx(0.54 * (0.02 + 0.98 / (1.0 + 0.64 * eps)) * clean, rel=1e-9)


@pytest.mark.parametrize("tangential", TANGENTIAL)
@pytest.mark.parametrize("load", [1e-300, 1e-100, 1e-12])
def test_a_vanishing_load_gives_finite_forces(tangential, load):
    surface = Friction(0.36, slope=0.54, slope_far=0.02, slope_rate=0.64)
    for B in (1.0, 1e6):
        separation = contact.Separation.hertzian(1.0 / B, B)
        creepage = contact.Creepage(1e-3, 1e-3, 0.1)
        sol = contact.solve(separation, creepage, load=load, friction=surface, tangential=tangential, throw=False)
        assert all(map(math.isfinite, (sol.Fx, sol.Fy, sol.Mz, sol.power_per_metre, sol.slip_area)))


#: Falls by .18 over 400 K, as in CONTACT's examples (constants.md 8).
HOT = Friction(0.3, hot_factor=0.4, temperature_range=400.0)
FIELDS = [name for name in TANGENTIAL if contact.methods().tangential[name].fields]
LOCAL = ["local", "greatest"]
#: Partial slip, full slip, stick after slip.
CREEPAGES = [(1e-3, 5e-4, 0.3), (2e-2, 5e-3, 0.0), (0.0, 2e-3, -0.9)]


def numbers(sol):
    return (
        sol.Fx,
        sol.Fy,
        sol.Mz,
        sol.power_per_metre,
        sol.slip_area,
        *(f.sum() for f in (sol.qx, sol.qy, sol.sx, sol.sy)),
    )


@pytest.mark.parametrize("velocity", LOCAL)
@pytest.mark.parametrize("tangential", FIELDS)
@pytest.mark.parametrize("law", FALLING)
def test_local_friction_that_does_not_fall_is_coulombs_bit_for_bit(law, tangential, velocity):
    for creepage in CREEPAGES:
        coulomb = numbers(solve(creepage, tangential=tangential))
        for friction in (Friction(0.3, 0.3, 1e-3, law), Friction(0.3, 0.1, 1e300, law)):
            same = dataclasses.replace(friction, velocity=velocity)
            assert numbers(solve(creepage, tangential=tangential, friction=same)) == coulomb


@pytest.mark.parametrize("velocity", LOCAL)
@pytest.mark.parametrize("tangential", [*FIELDS, "halfspace"])
def test_full_sliding_has_the_coefficient_of_the_rigid_slip(tangential, velocity):
    """Far above saturation the elastic slip vanishes: F = μ(V √(ξ² + η²)) N, as with the global velocity."""
    options = {"normal": "halfspace", "spacing": 1e-3} if tangential == "halfspace" else {}
    one = solve(
        (0.3, 0.4, 0.0), tangential=tangential, friction=Friction.polach(velocity=velocity), speed=2.0, **options
    )
    assert math.hypot(one.Fx, one.Fy) == pytest.approx(Friction.polach().coefficient(1.0) * one.N, rel=3e-3)


@pytest.mark.parametrize("velocity", LOCAL)
@pytest.mark.parametrize("tangential", [*FIELDS, "halfspace"])
def test_every_element_has_the_coefficient_of_its_slip_and_sticks_up_to_the_static_one(tangential, velocity):
    options = {"normal": "halfspace", "spacing": 1e-3} if tangential == "halfspace" else {}
    friction = Friction(0.5, 0.2, 0.05, "linear", velocity=velocity)
    for creepage in CREEPAGES:
        sol = solve(creepage, tangential=tangential, friction=friction, **options)
        p, q = sol.p, np.hypot(sol.qx, sol.qy)
        assert sol.friction == 0.5
        if contact.methods().tangential[tangential].admissible:
            assert (q <= 0.5 * p * (1.0 + 1e-12)).all()
            own = friction.coefficient(20.0 * np.hypot(sol.sx, sol.sy)) * p
            slips = ~sol.stick & (p > 0.0)
            slips[:, 1:] &= ~sol.stick[
                :, :-1
            ]  # where slip begins within an element, part of it keeps the static coefficient
            if velocity == "local":
                np.testing.assert_allclose(q[slips], own[slips], rtol=1e-2 if tangential == "halfspace" else 1e-9)
            else:
                assert (q[slips] <= own[slips] * (1.0 + (1e-2 if tangential == "halfspace" else 1e-9))).all()
        assert (q >= 0.0).all()
        assert sol.power_per_metre >= 0.0


@pytest.mark.parametrize("tangential", FIELDS)
def test_memory_never_raises_a_coefficient(tangential):
    for creepage in CREEPAGES:
        fields, slips = [], np.array(True)
        for velocity in LOCAL:
            friction = Friction(0.5, 0.2, 0.02, "exponential", velocity=velocity)
            sol = solve(creepage, tangential=tangential, friction=friction)
            fields.append(np.hypot(sol.qx, sol.qy))
            slips = slips & ~sol.stick  # with fastrip_mapped the stick zone bears what slip behind it lacks
        assert slips.any()
        assert (fields[1] <= fields[0] * (1.0 + 1e-12))[slips].all()


@pytest.mark.parametrize("friction", [Friction.polach(velocity="local"), Friction.polach(velocity="greatest"), HOT])
@pytest.mark.parametrize("tangential", FIELDS)
def test_friction_of_each_element_keeps_the_symmetries(tangential, friction):
    for xi, eta, phi in (*CREEPAGES, (1e-4, 0.0, 4.0)):
        one, negative, mirrored = (
            solve(c, tangential=tangential, friction=friction, speed=30.0)
            for c in ((xi, eta, phi), (-xi, -eta, -phi), (xi, -eta, -phi))
        )
        unit = friction.static * one.N
        assert (negative.Fx, negative.Fy) == pytest.approx((-one.Fx, -one.Fy), abs=1e-12 * unit)
        assert (mirrored.Fx, mirrored.Fy) == pytest.approx((one.Fx, -one.Fy), abs=1e-6 * unit)
        assert negative.Mz == pytest.approx(-one.Mz, abs=1e-14 * unit)


@pytest.mark.parametrize("tangential", FIELDS)
def test_forces_are_continuous_in_the_creepage_where_friction_falls_steeply(tangential):
    """In steps of 1e-5 in creepage the largest change of force stays near the mean one, also with memory and over 20 K."""
    xi = np.arange(1, 1200) * 1e-5
    steep = [(Friction(0.5, 0.1, 0.02, "exponential", velocity=velocity), 4e-3) for velocity in LOCAL]
    hot = {"hot_factor": 0.1, "temperature_range": 20.0}
    steep += [(Friction(0.5, 0.3, 0.1, "exponential", velocity=v, **hot), 5e-3) for v in ("global", *LOCAL)]
    for friction, most in steep:
        Fx = contact.forces(SEPARATION, (xi, 1e-3, 0.2), load=8e4, friction=friction, tangential=tangential).Fx / 4e4
        assert np.abs(np.diff(Fx)).max() < most


@pytest.mark.parametrize(
    ("creepage", "kinetic", "half_speed", "law"),
    [
        ((2.2e-3, -3e-4, 0.0), 0.15, 0.5, "rational"),
        ((1.5e-3, 1.5e-3, 0.2), 0.15, 0.5, "rational"),
        ((0.0, 3e-3, 0.0), 0.25, 0.3, "linear"),
    ],
)
def test_the_stick_zone_bears_what_falling_friction_behind_it_lacks(creepage, kinetic, half_speed, law):
    """With the slip under the static coefficient alone the forces were .021, .018 and .014 of mu N off."""
    friction = Friction(0.35, kinetic, half_speed, law, velocity="local")
    options = {"friction": friction, "speed": 60.0}
    one = solve(creepage, **options)
    true = solve(creepage, normal="halfspace", tangential="halfspace", **options)
    assert math.hypot(one.Fx - true.Fx, one.Fy - true.Fy) < 0.01 * 0.35 * one.N


def test_methods_with_forces_only_use_the_global_velocity():
    one, other = (
        solve((1e-2, 0.0, 0.0), tangential="polach", friction=Friction.polach(velocity=v)) for v in ("local", "global")
    )
    assert one.Fx == other.Fx
    assert one.friction == other.friction < 0.55


def sided(**options):
    return Friction(0.4, gauge_factor=0.25, border=-1e-3, border_width=4e-3, **options)


def test_the_factor_over_the_profile_is_smooth_between_its_two_values():
    y = np.linspace(-5e-3, 3e-3, 801)
    factor = sided().factor(y)
    assert (factor[y <= -3e-3] == 0.25).all()
    assert (factor[y >= 1e-3] == 1.0).all()
    assert factor[400] == pytest.approx(0.625)
    assert abs(np.diff(factor, 2)).max() <= 1.001 * 6.0 * 0.75 * (1e-5 / 4e-3) ** 2
    np.testing.assert_allclose(dataclasses.replace(sided(), border_width=-4e-3).factor(-2e-3 - y), factor, rtol=1e-12)
    assert dataclasses.replace(sided(), border_width=0.0).factor([-1.1e-3, -1e-3]).tolist() == [0.25, 1.0]


@pytest.mark.parametrize("tangential", [*TANGENTIAL, "halfspace"])
def test_full_slip_has_the_friction_of_each_place(tangential):
    """F = ∫ mu(y) p dA for laws that saturate."""
    options = {"normal": "halfspace", "spacing": 0.5e-3} if tangential == "halfspace" else {}
    sol = solve((0.3, 0.0, 0.0), tangential=tangential, friction=sided(), **options)
    expected = 0.4 * (sided().factor(sol.y) * sol.p * sol.dA).sum()
    if contact.methods().tangential[tangential].saturates:
        # the parabolic bound has another share of the load on each strip
        admissible = contact.methods().tangential[tangential].admissible
        assert -sol.Fx == pytest.approx(expected, rel=2e-3 if admissible else 3e-2)
    if contact.methods().tangential[tangential].admissible and tangential in FIELDS:
        assert (np.hypot(sol.qx, sol.qy) <= 0.4 * sided().factor(sol.y) * sol.p * (1.0 + 1e-12)).all()


@pytest.mark.parametrize("tangential", TANGENTIAL)
def test_a_border_far_away_leaves_one_coefficient(tangential):
    creepage = (1e-3, 5e-4, 0.3)
    for border, coefficient in ((-1.0, 0.4), (1.0, 0.1)):
        one = solve(creepage, tangential=tangential, friction=dataclasses.replace(sided(), border=border))
        other = solve(creepage, tangential=tangential, friction=coefficient)
        np.testing.assert_allclose((one.Fx, one.Fy, one.Mz), (other.Fx, other.Fy, other.Mz), rtol=1e-12)
