"""Directional derivatives of the native FMUs, and creep stiffness."""

import numpy as np
import pytest
from contact_case import CREEPAGES, posed
from fmpy.fmi1 import FMICallException
from pair_case import MOTION

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
        (slope,), at = fmu.directional([unknown], [known], [1.0]), fmu[known]
        (wanted,) = fmu.quotient([unknown], [known], [1.0], 3e-10 if known == "geometry.g[23]" else 3e-6 * abs(at))
        # one-sided differences inside the core, and for the load the tangent of a solution with the tolerance 1e-4
        bound = 1e-3 * max(abs(wanted), 1e-3 * abs(fmu[unknown] / at))
        assert slope == pytest.approx(wanted, abs=bound), (unknown, known)
        if known in CREEPAGES:
            row, column = FORCES.index(unknown) + 1, list(CREEPAGES).index(known) + 1
            assert fmu[f"creep_stiffness[{row},{column}]"] == pytest.approx(slope, rel=1e-9)


def test_a_host_may_name_enumerations_with_seeds_of_zero(open_native):
    """OMSimulator hands over every dependency of an initial unknown, whatever its type."""
    fmu = posed(open_native())
    fmu.fmu.setupExperiment()
    fmu.fmu.enterInitializationMode()
    alone = fmu.directional(["force.x"], ["load.normal_force"], [1.0])
    assert fmu.directional(["force.x"], ["load.normal_force", "friction.law"], [1.0, 0.0]) == alone
    with pytest.raises(FMICallException):
        fmu.directional(["force.x"], ["friction.law"], [1.0])


def test_a_derivative_at_the_end_of_a_range_is_one_sided(open_native):
    """The minimum of friction is 0, where |F| grows with mu N."""
    fmu = posed(open_native()).initialize()
    fmu.update({"friction.coefficient": 0.0})
    (slope,) = fmu.directional(["force.x"], ["friction.coefficient"], [1.0])
    assert -8e4 <= slope < -1e4


WRENCH = ("force.x", "force.y", "force.z", "moment.x", "moment.y", "moment.z")


@pytest.mark.parametrize(
    ("known", "h"),
    [
        ("pose.y", 2e-8),
        ("pose.roll", 2e-8),
        ("pose.yaw", 2e-8),
        ("velocity.spin", 3e-6),
        ("velocity.yaw", 1e-7),
        ("load.normal_force", 30.0),
        ("friction.coefficient", 1e-6),
    ],
)
def test_the_wrench_of_a_pair_has_the_derivatives_of_its_outputs(open_pair, known, h):
    """Each component of the wrench is compared with central differences of other steps.

    Under a load the height follows from an iteration, whose tolerance is in the quotients: up to 6e-4 was measured. The
    columns of the pose are those of the height that the method itself finds, the outputs those of ANALYN's height. The
    quotient of the small vertical force changes by 3 % between steps of 2e-8 and 1e-6, .002 of the largest slope.
    """
    fmu = open_pair("ModelExchange")
    fmu.update({**MOTION, "pose.yaw": 1e-3})
    fmu.initialize()
    wanted = fmu.quotient(WRENCH, [known], [1.0], h)
    share, noise = (1e-2, 2e-3) if known.startswith("pose") else (1e-3, 0.0)
    found = fmu.directional(WRENCH, [known], [1.0])
    np.testing.assert_allclose(found, wanted, rtol=share, atol=noise * np.abs(wanted).max())
    assert wanted.all()
