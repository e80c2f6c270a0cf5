"""Fields of the native `WheelRailContact` of FMI 3.0, and their directional derivatives."""

import numpy as np
import pytest
from contact_case import posed
from fmu_instance import goes_on
from random_cases import random_case

import contact
from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.kernels.records import MAX_PATCHES

SHAPE = (MAX_PATCHES, N_STRIPS.usual, N_ELEMENTS.usual)
FIELDS = {
    "field.x": "x", "field.y": "y", "field.area": "dA", "field.pressure": "p", "field.traction_x": "qx",
    "field.traction_y": "qy", "field.slip_x": "sx", "field.slip_y": "sy", "field.stick": "stick",
}  # fmt: skip


@pytest.mark.parametrize("seed", [*range(25), 42])  # the last one has no contact
def test_fields_are_those_of_the_solver(open_native_fmi3, seed):
    case = random_case(seed)
    fmu, whole, solution = open_native_fmi3(), dict(case.values), case.solution
    resolution = {name: whole.pop(f"resolution.{name}") for name in ("n_strips", "n_elements")}
    fmu.configure(**resolution).update(whole)
    fmu.initialize().step()
    n = solution.strips.y.size
    for name, attribute in FIELDS.items():
        field = fmu[name]
        assert field.shape == (4, *resolution.values())
        field = field.reshape(-1, resolution["n_elements"])
        known = solution.has_fields or attribute in ("x", "y", "dA", "p")  # with a creep force law the others are zero
        wanted = getattr(solution, attribute) if known else np.zeros((n, resolution["n_elements"]))
        np.testing.assert_allclose(field[:n], wanted, rtol=1e-12, atol=1e-12 * np.max(np.abs(wanted), initial=0.0))
        assert not np.any(field[n:])
    patch = fmu["field.patch"].reshape(-1, resolution["n_elements"])
    np.testing.assert_array_equal(patch[:n, 0], solution.strips.patch + 1)
    assert not np.any(patch[n:])


def test_fields_belong_to_the_last_step_whatever_was_computed_since(open_native_fmi3):
    """Interacting strips start warm, so a repeated computation must start from the same memory as the step."""
    fmu = posed(open_native_fmi3())
    fmu.update({"method.normal": list(contact.methods().batched.normal).index("strip_halfspace") + 1})
    fmu.initialize()
    for k in range(3):
        fmu.update({"load.normal_force": 8e4 + 2e3 * k})
        fmu.step(k * 1e-3)
    wanted = {name: fmu[name] for name in (*FIELDS, "creep_stiffness")}
    fmu.directional(["force.x"], ["load.normal_force"], [1.0])
    fmu.update({"creepage.lateral": 5e-3, "friction.kinetic": 0.1})
    assert all(np.array_equal(fmu[name], field) for name, field in wanted.items())

    def fields(one):
        return {name: one[name].tolist() for name in wanted}

    now, _, later = goes_on(fmu, open_native_fmi3(), lambda one: (fields(one), one.step(3e-3), fields(one)))
    assert now == {name: field.tolist() for name, field in wanted.items()}
    assert now["field.traction_y"] != later["field.traction_y"]


@pytest.mark.parametrize("known", ["creepage.longitudinal", "load.normal_force"])
def test_fields_have_directional_derivatives(open_native_fmi3, known):
    """They are compared with differences in model exchange. In full slip no element changes between stick and slip."""
    fmu = posed(open_native_fmi3("ModelExchange"))
    fmu.update({"creepage.longitudinal": 0.05})
    fmu.initialize()
    slopes = fmu.directional(["creep_stiffness", "field.traction_x"], [known], [1.0])[9:].reshape(SHAPE)
    at, found = fmu[known], []
    for sign in (1.0, -1.0):
        fmu.update({known: at * (1.0 + sign * 1e-5)})
        found.append(fmu["field.traction_x"])
    wanted = (found[0] - found[1]) / (2e-5 * at)
    np.testing.assert_allclose(slopes, wanted, atol=2e-4 * np.max(np.abs(wanted)))
