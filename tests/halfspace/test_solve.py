"""`contact.solve` with the element-wise half space: records, statuses, grids, pressure of other methods, errors."""

import numpy as np
import pytest

import contact
from contact.halfspace import Gap
from tests.post_conditions import assert_post_conditions
from tests.separations import KINDS, of_kind, two_lobes

BOTH = {"normal": "halfspace", "tangential": "halfspace"}
CREEPAGES = [(1e-3, 0.0, 0.0), (-5e-4, 2e-3, 0.4), (0.0, 0.0, -0.9), (3e-2, -2e-2, 0.0)]


@pytest.mark.parametrize("kind", KINDS)
def test_post_conditions(kind):
    separation, load = of_kind(kind)
    for creepage in CREEPAGES:
        sol = contact.solve(separation, contact.Creepage(*creepage), load=load, **BOTH)
        assert_post_conditions(sol)
        assert pytest.approx(load, rel=1e-9) == sol.N
        assert sol.status in (contact.Status.OK, contact.Status.SATURATED)
        np.testing.assert_allclose(sol.pressure(sol.x, sol.y), sol.p, atol=1e-6 * sol.max_pressure)
        assert np.isfinite(sol.damage.T_gamma)
    if kind == "two patches":
        assert sol.n_patches == 2


@pytest.mark.parametrize("normal", list(contact.methods().batched.normal))
def test_traction_on_the_pressure_of_any_method(normal):
    separation, load = of_kind("tread")
    first = contact.solve(separation, contact.Creepage(1e-3, 5e-4, 0.3), load=load, normal=normal)
    sol = contact.solve(separation, contact.Creepage(1e-3, 5e-4, 0.3), load=load, normal=normal, tangential="halfspace")
    assert_post_conditions(sol)
    assert (sol.approach, sol.normal, sol.tangential) == (first.approach, normal, "halfspace")
    assert pytest.approx(first.N, rel=1e-12) == sol.N
    assert sol.area == pytest.approx(first.area, rel=0.03)
    assert abs(sol.Fx - first.Fx) < 0.06 * 0.3 * load


def test_approach_and_load_agree():
    separation, load = of_kind("tread")
    creepage = contact.Creepage(1e-3, 0.0, 0.1)
    one = contact.solve(separation, creepage, load=load, spacing=0.4e-3, **BOTH)
    other = contact.solve(separation, creepage, approach=one.approach, spacing=0.4e-3, **BOTH)
    assert pytest.approx(load, rel=1e-5) == other.N
    assert other.Fx == pytest.approx(one.Fx, rel=1e-4)
    rate = contact.solve(separation, creepage, approach=1.001 * one.approach, spacing=0.4e-3, **BOTH).N - other.N
    assert one.normal_stiffness == pytest.approx(rate / (0.001 * one.approach), rel=0.02)


def test_a_gap_on_a_grid_is_solved_as_the_separation_it_came_from(ellipse):
    h = 0.4e-3
    x = y = (np.arange(-25, 25) + 0.5) * h
    creepage = contact.Creepage(1e-3, 5e-4, 0.2)
    by_gap = contact.solve(Gap(x, y, x**2 + 2.0 * y[:, None] ** 2), creepage, load=5e4, **BOTH)
    by_separation = contact.solve(ellipse, creepage, load=5e4, spacing=h, **BOTH)
    np.testing.assert_allclose(
        (by_gap.Fx, by_gap.Fy, by_gap.Mz), (by_separation.Fx, by_separation.Fy, by_separation.Mz), rtol=1e-4
    )
    assert by_gap.approach == pytest.approx(by_separation.approach, rel=1e-6)


def test_a_patch_at_the_end_of_the_data_is_out_of_range():
    y = np.linspace(-2e-3, 10e-3, 121)
    cut = contact.Separation(y, 2.0 * y**2, 1.0)
    sol = contact.solve(cut, contact.Creepage(), load=8e4, throw=False, **BOTH)
    assert sol.status is contact.Status.OUT_OF_RANGE
    with pytest.raises(contact.ContactError, match="reaches the end"):
        contact.solve(cut, contact.Creepage(), load=8e4, **BOTH)


def test_two_distant_lobes_share_the_load():
    sol = contact.solve(two_lobes(0.0, spacing=20e-3), contact.Creepage(), load=3e4, n_strips=80, **BOTH)
    assert sol.n_patches == 2
    shares = [(sol.p * sol.dA)[sol.strips.patch == k].sum() for k in range(2)]
    assert shares[0] == pytest.approx(shares[1], rel=1e-3)


def test_only_the_half_space_takes_a_grid_and_batches_do_without_it(ellipse):
    gap = Gap([0.0, 1e-3], [0.0, 1e-3], np.zeros((2, 2)))
    with pytest.raises(contact.ContactError, match=r"needs a contact\.Separation"):
        contact.solve(gap, contact.Creepage(), load=1.0)
    for kind in ("normal", "tangential"):
        with pytest.raises(contact.ContactError, match="not offered here"):
            contact.forces(ellipse, contact.Creepage(), load=8e4, **{kind: "halfspace"})
        assert "halfspace" not in getattr(contact.methods().batched, kind)
