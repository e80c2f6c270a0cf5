"""How derivatives of one contact are asked for, shaped and shown. `test_dual_numbers.py` proves their values."""

import json
import pickle

import numpy as np
import pytest

import contact
from contact import Creepage, Separation
from contact.errors import ContactError

MU = 0.3
HERTZ = Separation.hertzian(1.1, 0.8)
SKEWED = Separation(np.linspace(-6e-3, 6e-3, 81), 40.0 * np.linspace(-6e-3, 6e-3, 81) ** 2, 1.1)
STATES = [Creepage(4e-4, -3e-4, 0.2), Creepage(1.5e-3, 8e-4, -0.4), Creepage(0.0, 0.0, 0.0)]
RESULTS = ("Fx", "Fy", "Mz", "N", "approach", "power_per_metre")


def numbers(solution) -> np.ndarray:
    return np.array([getattr(solution, name) for name in RESULTS])


def test_the_solution_with_derivatives_is_that_without_them():
    one, other = (contact.solve(SKEWED, STATES[1], load=60e3, derivatives=asked) for asked in (True, False))
    assert numbers(one)[:4] == pytest.approx(numbers(other)[:4], abs=1e-4 * MU * 60e3)
    assert other.jacobian is None
    assert one.p == pytest.approx(other.p, abs=3e-3 * other.max_pressure)


def test_a_solver_gives_forces_with_derivatives_at_every_call():
    solver = contact.Solver(friction=MU)
    plain = solver.forces(HERTZ, STATES[0], load=80e3)
    first = solver.forces(HERTZ, STATES[0], load=80e3, derivatives=True)
    assert plain.jacobian is None
    assert first.Fx == pytest.approx(plain.Fx, rel=1e-3)
    assert (
        solver.forces(HERTZ, STATES[0], load=80e3, derivatives=True).jacobian.values.tolist()
        == first.jacobian.values.tolist()
    )
    assert solver.forces(HERTZ, STATES[0], load=80e3) == plain


def test_arrays_of_cases_have_the_derivatives_of_each_case():
    load = np.array([[40e3], [80e3]])
    found = contact.forces([HERTZ, SKEWED], (1e-3, [5e-4, 0.0], 0.2), load=load, friction=MU, derivatives=True).jacobian
    assert found.values.shape == (2, 2, 6, 5)
    for i, j in np.ndindex(2, 2):
        gap, creepage = (HERTZ, SKEWED)[j], Creepage(1e-3, (5e-4, 0.0)[j], 0.2)
        one = contact.solve(gap, creepage, load=float(load[i, 0]), friction=MU, derivatives=True).jacobian
        assert found.values[i, j] == pytest.approx(one.values, rel=1e-3, abs=1e-3 * abs(one.values).max(axis=0).min())
        assert found["Fx", "spin"][i, j] == found.values[i, j, 0, 2]
    assert "shape (2, 2, 6, 5)" in repr(found)
    assert contact.forces(HERTZ, Creepage(1e-3), load=8e4).jacobian is None


def test_without_contact_all_derivatives_are_zero():
    found = contact.solve(HERTZ, STATES[0], approach=-1e-5, derivatives=True)
    assert found.status == contact.Status.NO_CONTACT
    assert not found.jacobian.values.any()


@pytest.mark.parametrize("creepage", STATES)
@pytest.mark.parametrize("friction", [0.0, 1e-9, 0.3])
@pytest.mark.parametrize("load", [0.0, 1e-6, 1e3, 4e5])
def test_derivatives_are_finite(creepage, friction, load):
    found = contact.solve(HERTZ, creepage, load=load, friction=friction, derivatives=True, throw=False)
    assert np.isfinite(found.jacobian.values).all()


def test_a_jacobian_is_read_by_names_and_shown_with_units():
    found = contact.solve(HERTZ, STATES[0], load=80e3, derivatives=True).jacobian
    assert np.asarray(found).shape == (6, 5)
    assert found.columns == ("longitudinal", "lateral", "spin", "load", "friction")
    assert found.rows == RESULTS
    assert "longitudinal" in repr(found)
    assert "[1/m]" in found._repr_html_()
    with pytest.raises(ContactError, match="columns are longitudinal, lateral, spin, load, friction"):
        found["Fx", "speed"]
    copy = pickle.loads(pickle.dumps(found))
    assert json.dumps(copy.values.tolist()) == json.dumps(found.values.tolist())
