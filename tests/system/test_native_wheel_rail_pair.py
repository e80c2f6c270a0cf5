"""Derivatives of the native `WheelRailPair`, and what it does at extreme inputs."""

import numpy as np
import pytest
from differences import derivative, quotient
from pair_case import MOTION

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
def test_directional_derivatives_are_those_of_the_outputs(open_pair, known, h):
    """Each component of the wrench is compared with central differences of other steps.

    Under a load the height follows from an iteration, whose tolerance is in the quotients: up to 6e-4 was measured. The
    columns of the pose are those of the height that the method itself finds, the outputs those of ANALYN's height. The
    quotient of the small vertical force changes by 3 % between steps of 2e-8 and 1e-6, .002 of the largest slope.
    """
    fmu = open_pair("ModelExchange")
    fmu.update({**MOTION, "pose.yaw": 1e-3})
    fmu.initialize()
    wanted = quotient(fmu, WRENCH, {known: 1.0}, h)
    share, noise = (1e-2, 2e-3) if known.startswith("pose") else (1e-3, 0.0)
    np.testing.assert_allclose(
        derivative(fmu, WRENCH, {known: 1.0}), wanted, rtol=share, atol=noise * np.abs(wanted).max()
    )
    assert wanted.all()
