"""Under a pressure limit, resultants, power and fields are consistent: in stick by stiffness, in slip by friction."""

import dataclasses
from functools import cache

import numpy as np
import pytest

import contact

SEPARATION = contact.Separation.hertzian(1.0, 2.0)
LOAD, MU = 8e4, 0.3
WITH_FIELDS = [name for name, m in contact.methods().batched.tangential.items() if m.fields]


def solved(creepage, share, tangential, **options):
    material = dataclasses.replace(contact.STEEL, pressure_limit=share * peak()) if share < 1.0 else contact.STEEL
    return contact.solve(SEPARATION, creepage, load=LOAD, material=material, tangential=tangential, **options)


@cache
def peak() -> float:
    return contact.solve(SEPARATION, contact.Creepage(), load=LOAD).max_pressure


def misfits(sol):
    """Return sums over the fields minus the resultants: forces over mu N, power relative to itself."""
    power = -((sol.qx * sol.sx + sol.qy * sol.sy) * sol.dA).sum()
    return np.array(
        [
            ((sol.qx * sol.dA).sum() - sol.Fx) / (MU * LOAD),
            ((sol.qy * sol.dA).sum() - sol.Fy) / (MU * LOAD),
            ((sol.x * sol.qy - sol.y * sol.qx) * sol.dA).sum() - sol.Mz,
            power - sol.power_per_metre,
        ]
    )


@pytest.mark.parametrize("tangential", WITH_FIELDS)
@pytest.mark.parametrize("share", [0.9, 0.6, 0.4])
def test_the_fields_add_up_to_the_resultants_and_to_the_power(tangential, share):
    for creepage in (contact.Creepage(1e-4), contact.Creepage(1e-3, 5e-4, 0.2), contact.Creepage(0.0, 0.0, 0.5)):
        sol = solved(creepage, share, tangential)
        forces = misfits(sol)
        assert np.abs(forces[:2]).max() < 2e-3  # as without a limit: `fastrip` integrates stick in closed form
        assert abs(forces[2]) < 2e-3 * MU * LOAD * 5e-3
        assert abs(forces[3]) < 1e-6 * sol.power_per_metre


@pytest.mark.parametrize("tangential", WITH_FIELDS)
def test_nothing_jumps_where_the_limit_begins(tangential):
    creepage = contact.Creepage(1e-3, 5e-4, 0.2)
    elastic, limited = solved(creepage, 1.0, tangential), solved(creepage, 1.0 - 1e-6, tangential)
    assert limited.Fx == pytest.approx(elastic.Fx, rel=1e-4)
    assert limited.power_per_metre == pytest.approx(elastic.power_per_metre, rel=1e-3)


@pytest.mark.parametrize("tangential", ["fastrip", "fastrip_mapped"])
@pytest.mark.parametrize("creepage", [(1e-4, 0.0, 0.0), (1e-3, 5e-4, 0.0), (0.0, 0.0, 0.5), (2e-3, 1e-3, 0.3)])
def test_forces_are_those_of_the_half_space_under_the_cut_pressure(tangential, creepage):
    """Compare with 50 x 50 elements of the half space. The pressure is limited to .7 of its peak."""
    reference = {
        (1e-4, 0.0, 0.0): (-0.0589, 0.0),
        (1e-3, 5e-4, 0.0): (-0.4980, -0.2318),
        (0.0, 0.0, 0.5): (0.0, -0.6751),
        (2e-3, 1e-3, 0.3): (-0.6746, -0.6407),
    }[creepage]
    sol = solved(contact.Creepage(*creepage), 0.7, tangential)
    assert np.hypot(sol.Fx / (MU * LOAD) - reference[0], sol.Fy / (MU * LOAD) - reference[1]) < 0.025
