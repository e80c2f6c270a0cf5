"""The public contract of `contact.solve`: fields, post-conditions, errors."""

import math

import numpy as np
import pytest

import contact
from tests.post_conditions import FIELDS

NORMAL, TANGENTIAL = list(contact.methods().batched.normal), list(contact.methods().batched.tangential)


def test_solution_has_the_fields_of_the_contract(ellipse):
    sol = contact.solve(ellipse, contact.Creepage(1e-3, 0, 0.1), load=8e4, n_strips=12, n_elements=16)
    for name in FIELDS:
        assert getattr(sol, name).shape == (12, 16), name
    for name in ("y", "dy", "x_c", "a", "p0", "patch"):
        assert getattr(sol.strips, name).shape == (12,), name
    assert sol.converged
    assert sol.status is contact.Status.OK


@pytest.mark.parametrize("arguments", [{"load": 0.0}, {"approach": 0.0}, {"approach": -1e-3}])
@pytest.mark.parametrize(
    ("normal", "tangential"),
    [*((name, "fastrip_mapped") for name in NORMAL), ("analyn", "halfspace"), ("halfspace", "halfspace")],
)
def test_no_contact_is_a_valid_result(ellipse, arguments, normal, tangential):
    sol = contact.solve(ellipse, contact.Creepage(1e-3, 1e-3, 1.0), normal=normal, tangential=tangential, **arguments)
    assert sol.status is contact.Status.NO_CONTACT
    assert (sol.Fx, sol.Fy, sol.Mz, sol.N, sol.area, sol.max_pressure, sol.slip_ratio) == (0,) * 7
    assert sol.p.size == 0
    assert sol.pressure(0.0, 0.0) == 0.0
    assert sol.tangential == tangential


@pytest.mark.parametrize("tangential", [n for n, m in contact.methods().batched.tangential.items() if m.saturates])
def test_resolution_does_not_ripple(tangential, ellipse):
    """Doubling strips and elements changes forces by less than 0.05 % of mu N from 30 on with FaStrip (others: 0.5 %).

    In strip theory the force of a strip jumps when it begins to slip, by a part of its share of the load.
    """
    limit = {"fastrip": 0.0005, "strip_theory": 0.01}.get(tangential, 0.005)
    for creep in [(1e-3, 0, 0), (0, 1e-3, 0.3), (5e-4, -8e-4, 0.8), (2e-3, 1e-3, -0.5)]:
        a, b = (
            contact.solve(
                ellipse,
                contact.Creepage(*creep),
                load=8e4,
                normal="analyn",
                tangential=tangential,
                n_strips=n,
                n_elements=n,
            )
            for n in (30, 60)
        )
        assert math.hypot(a.Fx - b.Fx, a.Fy - b.Fy) < limit * 0.3 * 8e4, creep


def test_status_instead_of_error_when_asked(ellipse):
    sol = contact.solve(ellipse, contact.Creepage(), load=1e9, throw=False)
    assert sol.status is contact.Status.OUT_OF_RANGE
    assert "extend y" in sol.status.message


def test_material_from_a_pair_of_equal_bodies_is_that_body():
    E, nu = 210e9, 0.3
    pair = contact.Material.from_pair(E, nu, E, nu)
    assert pair.shear_modulus == pytest.approx(E / 2.6)
    assert pair.poisson_ratio == pytest.approx(nu)
    assert pair.contact_modulus == pytest.approx(E / (2 * (1 - nu**2)))
    with pytest.raises(contact.ContactError, match="poisson_ratio"):
        contact.Material(82e9, 0.6)


@pytest.mark.parametrize("given", [(1e-3, -5e-4, 0.2), [1e-3, -5e-4, 0.2], np.array([1e-3, -5e-4, 0.2])])
@pytest.mark.parametrize("options", [{}, {"force": (-5e3, None)}, {"conformal": True}, {"normal": "hertz"}])
def test_three_numbers_as_creepage_give_the_solution_of_the_creepage(given, options):
    held = contact.Separation.hertzian(1.1, 0.8)
    found, wanted = (contact.solve(held, each, load=8e4, **options) for each in (given, contact.Creepage(*given)))
    assert found.creepage == wanted.creepage
    assert str(found) == str(wanted)
    assert found.damage.T_gamma == wanted.damage.T_gamma
