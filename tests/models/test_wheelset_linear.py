"""The linear theory of theory.md 9.4 compared with its own eigenvalues."""

import dataclasses
import math

import numpy as np
import pytest

from reference.linear_wheelset import LinearWheelset

# theory.md 9.4: the worked example
EXAMPLE = LinearWheelset(
    mass=1250.0,
    yaw_inertia=700.0,
    half_base=0.75,
    radius=0.46,
    conicity=0.1,
    lateral_stiffness=2e5,
    yaw_stiffness=3e5,
    creep_coefficient=8e6,
)


def growth(wheelset: LinearWheelset, speed: float) -> float:
    return float(np.linalg.eigvals(wheelset.matrix(speed)).real.max())


def test_critical_speed_of_the_worked_example():
    assert EXAMPLE.critical_speed == pytest.approx(31.85337, abs=5e-6)


def test_growth_vanishes_at_the_critical_speed_and_changes_sign_there():
    V = EXAMPLE.critical_speed
    scale = abs(np.linalg.eigvals(EXAMPLE.matrix(V))).max()
    assert abs(growth(EXAMPLE, V)) < 1e-12 * scale
    assert growth(EXAMPLE, 0.99 * V) < 0.0 < growth(EXAMPLE, 1.01 * V)


def test_large_creep_coefficient_gives_the_kinematic_limit():
    stiff = dataclasses.replace(EXAMPLE, creep_coefficient=1e12)
    w = math.sqrt((3e5 + 0.75**2 * 2e5) / (1250.0 * 0.75**2 + 700.0))
    assert stiff.critical_speed == pytest.approx(w * math.sqrt(0.75 * 0.46 / 0.1), rel=1e-9)


def test_slow_run_oscillates_with_the_klingel_wavelength():
    slow = dataclasses.replace(EXAMPLE, lateral_stiffness=0.0, yaw_stiffness=0.0)
    eigenvalues = np.linalg.eigvals(slow.matrix(1.0))
    frequency = eigenvalues.imag[np.argmax(eigenvalues.real)]
    assert 2.0 * math.pi / abs(frequency) == pytest.approx(slow.klingel_wavelength, rel=1e-3)


def test_no_critical_speed_without_destabilising_creep():
    assert dataclasses.replace(EXAMPLE, conicity=-0.1, creep_coefficient=1e6).critical_speed == math.inf
