"""Properties of every method for any separation, with cases from hypothesis (issue "Smoothness and robustness")."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import contact
from reference import random_cases

NORMAL, METHODS = list(contact.methods().batched.normal), contact.methods().batched.tangential
TANGENTIAL = [name for name, method in METHODS.items() if method.saturates]  # tolerances are relative to mu N
MU = 0.3
few = settings(max_examples=40, deadline=None)
normals, tangentials = st.sampled_from(NORMAL), st.sampled_from(TANGENTIAL)
loads = st.floats(1.0, 5.2).map(lambda u: 10.0**u)
creepages = st.builds(
    lambda signs, sizes: tuple(s * 10.0**u for s, u in zip(signs, sizes, strict=True)),
    st.tuples(*[st.sampled_from([-1.0, 0.0, 1.0])] * 3),
    st.tuples(st.floats(-8, 0), st.floats(-8, 0), st.floats(-6, 0.7)),
)


@st.composite
def separations(draw, kinds=tuple(random_cases.KINDS)):
    """Draw real, worn, near-conformal, nearly flat, two-lobed, asymmetric and noisy separations."""
    kind = draw(st.sampled_from(kinds))
    return random_cases.KINDS[kind](np.random.default_rng(draw(st.integers(0, 10_000))))


def solve(separation, creepage=(0.0, 0.0, 0.0), **options):
    return contact.solve(separation, contact.Creepage(*creepage), friction=MU, throw=False, **options)


def force(sol):
    """(Fx, Fy)/(mu N) and Mz/(mu N √(area/pi))."""
    scale = MU * sol.N
    return np.array([sol.Fx / scale, sol.Fy / scale, sol.Mz / (scale * math.sqrt(sol.area / math.pi))])


@few
@given(st.floats(2.4, 3.5), creepages, st.floats(0.0, 2.0), normals, tangentials)
def test_millimetres_and_newtons_give_the_same_forces(ratio, creepage, load, normal, tangential):
    """ANALYN's two fixed lengths have no effect: the base of B not on a parabola, the floor not for B > 0.2 /mm."""
    si = contact.Separation.hertzian(300.0, 10.0**ratio)
    mm = contact.Separation(si.y * 1e3, si.g * 1e3, si.A * 1e-3)
    xi, eta, phi = creepage
    options = {"load": 10.0**load, "normal": normal, "tangential": tangential}
    one = solve(si, creepage, **options)
    other = solve(mm, (xi, eta, phi * 1e-3), material=contact.Material(82e3, 0.28), **options)
    np.testing.assert_allclose(force(other), force(one), atol=1e-6 if normal != "strip_halfspace" else 1e-3)


@pytest.mark.parametrize(
    ("normal", "kinds", "least_step"),
    [
        ("analyn", tuple(random_cases.KINDS), 1e-6),
        ("hertz", tuple(random_cases.KINDS), 1e-6),
        ("strip_halfspace", ("pose", "worn", "ellipse", "near-conformal"), 1e-3),  # solved to 1e-4
    ],
)
@few
@given(st.data(), st.floats(-7.0, -4.0), st.floats(0.0, 1.0))
def test_load_rises_with_the_approach(normal, kinds, least_step, data, depth, share):
    separation = data.draw(separations(kinds=kinds))
    step = least_step ** (1.0 - share) * 0.5**share
    touch = solve(separation, load=0.0, normal=normal).approach
    first = solve(separation, approach=touch + 10.0**depth, normal=normal).N
    second = solve(separation, approach=touch + (1.0 + step) * 10.0**depth, normal=normal).N
    assert second > first > 0.0


@few
@given(separations(), loads, tangentials, st.tuples(*[st.floats(-1, 1)] * 3))
def test_forces_are_continuous_at_zero_creepage(separation, load, tangential, direction):
    """Halving a tiny creepage halves the force, so there is no jump and no dead band."""
    tiny = tuple(1e-9 * d for d in direction)
    whole = force(solve(separation, tiny, load=load, tangential=tangential))
    half = force(solve(separation, tuple(0.5 * t for t in tiny), load=load, tangential=tangential))
    assert np.abs(whole).max() < 0.05
    np.testing.assert_allclose(half, 0.5 * whole, atol=0.02 * np.abs(whole).max() + 1e-12)


@few
@given(separations(kinds=("pose", "worn", "ellipse")), st.floats(-5, 5), st.floats(-3e-3, 3e-3), st.floats(-3e-3, 3e-3))
def test_mapped_forces_are_continuous_in_spin(separation, spin, xi, eta):
    """This holds where strips pass |psi| = 1. The published FaStrip jumps there (`fastrip`: tests/tangential)."""
    options = {"load": 8e4, "tangential": "fastrip_mapped"}
    one = force(solve(separation, (xi, eta, spin), **options))
    other = force(solve(separation, (xi, eta, spin + 1e-6), **options))
    np.testing.assert_allclose(other, one, atol=2e-3)
