"""Directional derivatives and creep stiffness of the native `WheelRailContact`."""

import numpy as np
import pytest
from contact_case import CREEPAGES, geometry, posed
from differences import derivative, quotient
from fmpy.fmi1 import FMICallException


@pytest.fixture
def fmu(open_native):
    """Return an instance with the case of `contact_case`, ready to step."""
    return posed(open_native()).initialize(stop_time=1.0)


def test_creep_stiffness_belongs_to_the_last_step(fmu):
    fmu.step()
    first = fmu["creep_stiffness[1,1]"]
    fmu.update({"creepage.longitudinal": 5e-3})
    assert fmu["creep_stiffness[1,1]"] == first
    fmu.step(1e-3)
    assert abs(fmu["creep_stiffness[1,1]"]) < 0.9 * abs(first)


DERIVATIVES = [
    *((unknown, known) for known in CREEPAGES for unknown in ("force.x", "force.y", "moment.z")),
    *(("force.x", known) for known in ("load.normal_force", "friction.coefficient", "geometry.A[21]")),
    *((unknown, "load.normal_force") for unknown in ("force.y", "moment.z", "approach", "pressure.max", "patch.width")),
    ("power.friction", "speed"),
    ("pressure.max", "geometry.g[23]"),
]


@pytest.mark.parametrize("scale", [0.02, 0.5])
def test_directional_derivatives_are_those_of_the_solver(open_native, scale):
    """They are compared with fourth order differences of outputs in model exchange, at small and medium creepage."""
    fmu = posed(open_native("ModelExchange"))
    fmu.update({name: scale * value for name, value in CREEPAGES.items()})
    fmu.initialize()
    for unknown, known in DERIVATIVES:
        (slope,), at = derivative(fmu, [unknown], {known: 1.0}), fmu[known]
        (wanted,) = quotient(fmu, [unknown], {known: 1.0}, 3e-10 if known == "geometry.g[23]" else 3e-6 * abs(at))
        # one-sided differences inside the core, and for the load the tangent of a solution with the tolerance 1e-4
        bound = 1e-3 * max(abs(wanted), 1e-3 * abs(fmu[unknown] / at))
        assert slope == pytest.approx(wanted, abs=bound), (unknown, known)


@pytest.mark.parametrize("scale", [0.02, 0.5])
def test_forces_by_the_scale_of_the_geometry(open_native, scale):
    """The derivative is along (g, A) itself, all 82 samples at once: the contact becomes flatter or sharper."""
    fmu = posed(open_native("ModelExchange"))
    fmu.update({name: scale * value for name, value in CREEPAGES.items()})
    fmu.initialize()
    unknowns = ("force.x", "force.y", "moment.z", "approach", "pressure.max")
    wanted = quotient(fmu, unknowns, geometry(), 3e-6)
    np.testing.assert_allclose(derivative(fmu, unknowns, geometry()), wanted, rtol=1e-4)
    assert (np.abs(wanted) > 0.01 * np.abs(list(fmu.read(unknowns).values()))).all()


def test_a_host_may_name_enumerations_with_seeds_of_zero(open_native):
    """OMSimulator hands over every dependency of an initial unknown, whatever its type."""
    fmu = posed(open_native("CoSimulation"))
    fmu.fmu.setupExperiment()
    fmu.fmu.enterInitializationMode()
    unknowns = [fmu.variables["force.x"].valueReference]
    real, law = (fmu.variables[name].valueReference for name in ("load.normal_force", "friction.law"))
    alone = fmu.fmu.getDirectionalDerivative(unknowns, [real], [1.0])
    assert fmu.fmu.getDirectionalDerivative(unknowns, [real, law], [1.0, 0.0]) == alone
    with pytest.raises(FMICallException):
        fmu.fmu.getDirectionalDerivative(unknowns, [law], [1.0])


def test_a_derivative_at_the_end_of_a_range_is_one_sided(fmu):
    """The minimum of friction is 0, where |F| grows with mu N."""
    fmu.update({"friction.coefficient": 0.0})
    (slope,) = fmu.fmu.getDirectionalDerivative(
        [fmu.variables["force.x"].valueReference], [fmu.variables["friction.coefficient"].valueReference], [1.0]
    )
    assert -8e4 <= slope < -1e4
