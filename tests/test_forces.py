"""`contact.forces`: equal to `contact.solve`, broadcasting, independent of threads."""

import numpy as np
import pytest

import contact
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
