"""Directional derivatives and creep stiffness of the native `WheelRailContact`."""

import pytest
from contact_case import CREEPAGES, posed
from differences import derivative, quotient
from fmpy.fmi1 import FMICallException


@pytest.fixture
def fmu(open_native):
    """Return an instance with the case of `contact_case`, ready to step."""
    return posed(open_native()).initialize(stop_time=1.0)


FORCES = ("force.x", "force.y", "moment.z")
DERIVATIVES = [
    *((unknown, known) for known in CREEPAGES for unknown in FORCES),
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
        if known in CREEPAGES:
            row, column = FORCES.index(unknown) + 1, list(CREEPAGES).index(known) + 1
            assert fmu[f"creep_stiffness[{row},{column}]"] == pytest.approx(slope, rel=1e-9)


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
