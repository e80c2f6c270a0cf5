"""Multibody programs in Fortran trap invalid operations, divisions by zero and overflows: none occurs in the native FMUs."""

import ctypes
import faulthandler
import os
import sys

import pytest
from fmu_instance import Instance

import contact

INVALID, DIVISION_BY_ZERO, OVERFLOW = 1, 4, 8  # of fenv.h on x86-64
METHODS = [list(kind) for kind in contact.methods().batched]
CREEP = {"creepage.longitudinal": 1e-3, "creepage.lateral": -5e-4, "creepage.spin": 0.2}
#: A gap with two lobes, that is two patches.
TWO = {f"geometry.g[{i}]": 1e-6 * min((i - 12) ** 2, (i - 31) ** 2 + 1) for i in range(1, 42)}
CONTACTS = {
    "no creepage": {},
    "creepage": CREEP,
    "much spin": {"creepage.spin": -0.9},  # beyond the stick zone of strip theory
    "full slip": {"creepage.longitudinal": 0.1},
    "no friction": {**CREEP, "friction.coefficient": 0.0},
    "no contact": {"load.normal_force": 0.0},
    "standstill": {**CREEP, "speed": 0.0},
    "two patches": {**CREEP, **TWO},
    "ellipse": {**CREEP, "geometry.kind": 2},
    "plastic": {**CREEP, "material.pressure_limit": 5e8},
    "falling friction": {**CREEP, "friction.law": 3, "friction.velocity": 2, "friction.hot_factor": 0.6},
    "flat": dict.fromkeys((f"geometry.g[{i}]" for i in range(1, 42)), 0.0),
    "conformal": {**CREEP, "geometry.surface": 2, **{f"geometry.tilt[{i}]": 5e-3 * (i - 21) for i in range(1, 42)}},
}
PAIRS = {
    "tread": {"velocity.y": 0.02},
    "flange": {"pose.y": 7.5e-3, "pose.yaw": 5e-3},
    "both": {"pose.y": 6.4e-3, "load.kind": 3},
    "standstill": {"velocity.x": 0.0, "velocity.spin": 0.0},
    "backwards": {"velocity.x": -20.0, "velocity.spin": 44.0, "pose.yaw": 2e-3},
    "lift-off": {"load.normal_force": 0.0},
}


def trapped(fmu: Instance, values: dict) -> int:
    """Return the status of a process that initialises and steps its copy of an instance with traps: 0, or what ended it."""
    child = os.fork()
    if child == 0:
        fmu.update(values)
        fmu.fmu.setupExperiment(startTime=0.0)
        fmu.fmu.enterInitializationMode()
        libm, component = ctypes.CDLL("libm.so.6"), fmu.fmu.component
        libm.feenableexcept(INVALID | DIVISION_BY_ZERO | OVERFLOW)
        status = fmu.fmu.fmi2ExitInitializationMode(component)
        for k in range(2):
            status |= fmu.fmu.fmi2DoStep(component, 1e-3 * k, 1e-3, 1)
        libm.fedisableexcept(INVALID | DIVISION_BY_ZERO | OVERFLOW)
        os._exit(status > 1)  # a warning is fine
    return os.waitpid(child, 0)[1]


@pytest.fixture(scope="module")
def instances(native, unzipped):
    if not sys.platform.startswith("linux"):
        pytest.skip("TRAPS ARE NOT TESTED: feenableexcept is a function of glibc")
    return {name: Instance(unzipped(native.with_name(f"{name}.fmu"))) for name in ("WheelRailContact", "WheelRailPair")}


def test_a_trap_would_be_seen():
    child = os.fork()
    if child == 0:
        faulthandler.disable()
        libm = ctypes.CDLL("libm.so.6")
        libm.log.restype, libm.log.argtypes = ctypes.c_double, [ctypes.c_double]
        libm.feenableexcept(INVALID)
        libm.log(-1.0)
        os._exit(0)
    assert os.waitpid(child, 0)[1] != 0


@pytest.mark.parametrize("case", CONTACTS)
def test_no_method_traps(instances, case):
    normal, tangential = METHODS
    pairs = [(n, tangential.index("fastrip_mapped")) for n in range(len(normal))]
    pairs += [(normal.index("strip_halfspace"), t) for t in range(len(tangential))]
    ended = {}
    for n, t in pairs:
        chosen = {"method.normal": n + 1, "method.tangential": t + 1}
        if how := trapped(instances["WheelRailContact"], {**CONTACTS[case], **chosen}):
            ended[normal[n], tangential[t]] = how
    assert not ended


@pytest.mark.parametrize("case", PAIRS)
def test_no_position_of_a_wheel_traps(instances, case):
    assert trapped(instances["WheelRailPair"], PAIRS[case]) == 0
