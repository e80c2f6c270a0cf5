"""`contact.forces`: equal to `contact.solve`, broadcasting, independent of threads."""

import numpy as np
import pytest

import contact
from contact.errors import ContactError
from contact.friction import Friction
from reference import random_cases

NAMES = ("Fx", "Fy", "Mz", "N", "approach", "max_pressure", "area", "slip_ratio", "power_per_metre", "status")


@pytest.mark.parametrize(("normal", "tangential"), random_cases.method_pairs())
def test_equals_solve_case_by_case(normal, tangential, ellipse):
    other = contact.Separation.hertzian(2.0, 0.7)
    creep = np.linspace(-2e-3, 2e-3, 5)
    many = contact.forces([ellipse, other], (creep[:, None], 1e-3, 0.4), load=7e4, normal=normal, tangential=tangential)
    assert many.Fx.shape == (5, 2)
    for i, vx in enumerate(creep):
        for k, separation in enumerate((ellipse, other)):
            one = contact.solve(
                separation, contact.Creepage(vx, 1e-3, 0.4), load=7e4, normal=normal, tangential=tangential
            )
            for name in NAMES:
                assert getattr(many, name)[i, k] == getattr(one, name), name


Y = np.linspace(-15e-3, 15e-3, 121)
OPTIONS = {
    "bent": {"conformal": True},
    "gauge face": {"friction": Friction(0.4, 0.2, 0.1, "linear", velocity="local", gauge_factor=0.25, border=-1e-3)},
    "hot": {"friction": Friction(0.3, hot_factor=0.4, temperature_range=400.0), "speed": 30.0},
    "plastic": {"material": contact.Material(70e9, 0.3, pressure_limit=6e8)},
}


@pytest.mark.parametrize("tangential", [n for n, m in contact.methods().batched.tangential.items() if m.fields])
@pytest.mark.parametrize("name", OPTIONS)
def test_every_option_means_the_same_in_a_batch_in_solve_and_in_a_solver(name, tangential):
    """Bit for bit, and not what it is without the option; on separations with and without tilt."""
    options, creepage = OPTIONS[name] | {"tangential": tangential}, contact.Creepage(5e-3, -1e-3, 0.3)
    gaps = [contact.Separation(Y, 2.0 * Y**2, 1.1, 0.02 * Y, tilt, 1.0 / 0.46) for tilt in (0.05 + 20.0 * Y, 0.0)]
    many, solver = contact.forces(gaps, creepage, load=8e4, **options), contact.Solver(**options)
    plain = contact.solve(gaps[0], creepage, load=8e4, tangential=tangential)
    for k, gap in enumerate(gaps):
        one, prepared = contact.solve(gap, creepage, load=8e4, **options), solver.forces(gap, creepage, load=8e4)
        for result in NAMES:
            assert getattr(many, result)[k] == getattr(one, result) == getattr(prepared, result), result
    assert abs(many.Fy[0] - plain.Fy) > 1.0


def test_answer_does_not_depend_on_the_number_of_threads(ellipse):
    rng = np.random.default_rng(7)
    creep = tuple(rng.normal(0, scale, 3000) for scale in (1e-3, 1e-3, 0.3))
    one = contact.forces(ellipse, creep, load=7e4, threads=1)
    two = contact.forces(ellipse, creep, load=7e4, threads=2)
    for name in NAMES:
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name), err_msg=name)


def test_scalars_give_scalars_and_no_contact_is_a_valid_result(ellipse):
    none = contact.forces(ellipse, contact.Creepage(1e-3), load=0.0)
    assert none.Fx.shape == ()
    assert none.status == contact.Status.NO_CONTACT
    assert (none.Fx, none.slip_ratio) == (0.0, 0.0)


def test_arguments_with_other_labels_are_not_paired_by_position(ellipse):
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    over, along = xarray.DataArray([0.0, 1e-3], dims="slip"), xarray.DataArray([60e3, 80e3], dims="wheel")
    both = (over * (along / along)).transpose("slip", "wheel")
    sorted_otherwise = pandas.Series([60e3, 80e3], index=[1, 0])
    for creepage, load in ((over, along), (both, over), (pandas.Series([0.0, 1e-3]), sorted_otherwise)):
        with pytest.raises(ContactError, match=r"(dims|index) of longitudinal and load differ"):
            contact.forces(ellipse, (creepage, 0.0, 0.0), load=load)
    expected = contact.forces(ellipse, ([[0.0], [1e-3]], 0.0, 0.0), load=[60e3, 80e3])
    np.testing.assert_array_equal(contact.forces(ellipse, (both, 0.0, 0.0), load=along).Fx, expected.Fx)
    frame = pandas.DataFrame({"slip": [0.0, 1e-3], "load": [60e3, 80e3]})
    assert contact.forces(ellipse, (frame["slip"], 0.0, 0.0), load=frame["load"]).Fx.shape == (2,)
