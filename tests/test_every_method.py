"""Every registered pair of methods on every kind of patch that it supports, with all post-conditions.

Methods are read from the registry, so a new method is tested as soon as it is registered.
"""

import math

import numpy as np
import pytest

import contact
from reference import random_cases
from tests.post_conditions import assert_post_conditions
from tests.separations import KINDS, of_kind

NORMAL, TANGENTIAL = contact.methods().batched
PAIRS = random_cases.method_pairs()
CALIBRATED = [
    pytest.param("analyn", name, marks=pytest.mark.slow)
    for name, method in contact.methods().tangential.items()
    if method.calibrated
]
CREEPAGES = [(1e-3, 0.0, 0.0), (-5e-4, 2e-3, 0.4), (0.0, 0.0, -0.9), (3e-2, -2e-2, 0.0)]


def solve(kind, normal, tangential="fastrip", creepage=(0.0, 0.0, 0.0), **given):
    separation, load = of_kind(kind)
    given = given or {"load": load}
    return contact.solve(separation, contact.Creepage(*creepage), normal=normal, tangential=tangential, **given)


@pytest.mark.parametrize(("normal", "tangential"), [*PAIRS, *CALIBRATED])
@pytest.mark.parametrize("kind", KINDS)
def test_post_conditions(kind, normal, tangential):
    load = of_kind(kind)[1]
    for creepage in CREEPAGES:
        sol = solve(kind, normal, tangential, creepage)
        assert_post_conditions(sol)
        assert pytest.approx(load, rel=1e-9) == sol.N
    if NORMAL[normal].several_patches and kind == "two patches":
        assert sol.n_patches == 2


@pytest.mark.parametrize(("normal", "tangential"), PAIRS)
@pytest.mark.parametrize("kind", ["a/b = 0.2", "tread", "two patches", "yawed"])
def test_opposite_creepages_give_opposite_forces(kind, normal, tangential):
    for xi, eta, phi in CREEPAGES:
        one = solve(kind, normal, tangential, (xi, eta, phi))
        other = solve(kind, normal, tangential, (-xi, -eta, -phi))
        scale = max(one.friction * one.N, math.hypot(one.Fx, one.Fy))
        np.testing.assert_allclose((other.Fx, other.Fy), (-one.Fx, -one.Fy), atol=1e-12 * scale)
        assert other.Mz == pytest.approx(-one.Mz, abs=1e-12 * scale * math.sqrt(one.area))
        assert one.Fx * xi <= 0.0 or phi != 0.0, "positive creepage, negative force"


@pytest.mark.parametrize(("normal", "tangential"), PAIRS)
@pytest.mark.parametrize("kind", ["a/b = 5", "tread", "two patches", "yawed"])
def test_the_mirror_image_has_the_mirrored_forces(kind, normal, tangential):
    s, load = of_kind(kind)
    mirrored = contact.Separation(-s.y[::-1], s.g[::-1], s.A[::-1], s.x_c[::-1])
    tolerance = 1e-9 if NORMAL[normal].interacting else 1e-5
    for xi, eta, phi in CREEPAGES:
        one = solve(kind, normal, tangential, (xi, eta, phi))
        other = contact.solve(
            mirrored, contact.Creepage(xi, -eta, -phi), load=load, normal=normal, tangential=tangential
        )
        scale = max(one.friction * load, math.hypot(one.Fx, one.Fy))
        np.testing.assert_allclose((other.Fx, other.Fy), (one.Fx, -one.Fy), atol=tolerance * scale)
        assert other.Mz == pytest.approx(-one.Mz, abs=tolerance * scale * math.sqrt(one.area))


@pytest.mark.parametrize("normal", NORMAL)
@pytest.mark.parametrize("kind", KINDS)
def test_load_rises_with_the_approach(kind, normal):
    separation, _ = of_kind(kind)
    full = solve(kind, normal).approach
    touch = solve(kind, normal, load=0.0).approach
    approaches = touch + (full - touch) * np.geomspace(0.01, 1.0, 40)
    many = contact.forces(separation, contact.Creepage(), approach=approaches, normal=normal)
    if not NORMAL[normal].continuous and kind == "two patches":
        assert (many.N > 0).all()
        return
    solved = many.status != contact.Status.NOT_CONVERGED
    assert solved.sum() >= 36
    assert (np.diff(many.N[solved]) > 0).all()
    assert solve(kind, normal, approach=touch - 1e-6).status is contact.Status.NO_CONTACT, "lift-off"


@pytest.mark.parametrize("tangential", contact.methods().batched.tangential)
def test_without_creepage_or_friction_there_is_no_force(tangential):
    separation, load = of_kind("a/b = 1")
    given = {"load": load, "tangential": tangential}
    resting = [contact.solve(separation, contact.Creepage(), **given)]
    if TANGENTIAL[tangential].saturates:
        resting.append(contact.solve(separation, contact.Creepage(1e-3, 1e-3, 1.0), friction=0.0, **given))
    for sol in resting:
        assert (sol.Fx, sol.Fy, sol.Mz) == (0.0, 0.0, 0.0)
    assert resting[0].slip_ratio == 0.0
    assert not TANGENTIAL[tangential].fields or resting[0].stick.all()
