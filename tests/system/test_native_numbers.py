"""Numbers of `WheelRailContact` compared with `contact.solve`."""

import ctypes
from pathlib import Path

import fmpy
import numpy as np
import pytest
from contact_case import CREEPAGES, NAME, posed, separation
from fmu_instance import goes_on
from random_cases import METHODS, OUTPUTS, POINTS, Case, random_case
from script_host import Script

import contact
from contact import Status
from contact.compile.objects import CPUS
from contact_fmu.tables.wheel_rail_contact import table
from reference.native import kernel_library


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return [random_case(seed) for seed in range(1000)]


def check(cases: list[Case], rows: np.ndarray, most: float = 1e-12) -> None:
    differences = np.array([case.differences(row) for case, row in zip(cases, rows, strict=True)])
    print(f"greatest difference {differences.max():.1e}, of {OUTPUTS[differences.max(axis=0).argmax()]}")
    wrong = {case.seed: f"{d.max():.1e}" for case, d in zip(cases, differences, strict=True) if not d.max() <= most}
    assert not wrong, wrong


def test_the_cases_have_everything_in_them(cases, open_native):
    stiffness = {f"creep_stiffness[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)}
    twins = {f"{name}_real" for name in ("patch.count", "status")}  # of test_fmu_inputs.py
    variables = open_native().variables
    outputs = {name for name, v in variables.items() if v.causality == "output"}
    assert {*variables} >= {*OUTPUTS}
    assert outputs == {*OUTPUTS} - {"patch.count", "status"} | twins | stiffness

    def values(*names):
        return {tuple(case.values[name] for name in names) for case in cases}

    wanted = {Status.OK, Status.NO_CONTACT, Status.SATURATED, Status.OUT_OF_RANGE}
    assert {case.solution.status for case in cases} >= wanted
    assert len(values("geometry.kind", "load.kind")) == 4
    assert len(values("method.normal")) == len(METHODS.normal)
    assert len(values("method.tangential")) == len(METHODS.tangential)


def answers(script: Script, folder: Path, cases: list[Case]) -> np.ndarray:
    """Return `OUTPUTS` of the FMU after one step from the start, one row for each case."""
    at = {v.name: v.valueReference for v in fmpy.read_model_description(str(folder)).modelVariables}
    read = [f"g {at.get(f'{name}_real', at[name])}" for name in OUTPUTS]
    lines: list[str] = []
    for case in cases:
        given = ((at[name], value) for name, value in case.values.items())
        lines += ["r", *(f"n {k} {v}" if isinstance(v, int) else f"s {k} {float(v)!r}" for k, v in given)]
        lines += ["i", "d 0 1e-3", *read]
    return script(folder, 1, "\n".join(lines)).reshape(len(cases), -1)


@pytest.mark.parametrize(("platform", "most"), [("linux64", 1e-12), ("win64", 1e-10)])
def test_native_packaging_equals_the_solver(request, native, unzipped, cases, tmp_path, platform, most):
    """Windows' sin and cos differ in the last digit, which the table of factors magnifies; exp, log and pow are ours."""
    if platform == "win64":
        request.getfixturevalue("wine")
    check(cases, answers(Script(platform, tmp_path), unzipped(native.with_name(f"{NAME}.fmu")), cases), most)


def test_strips_that_interact_go_on_from_the_last_step(open_native):
    """The warm start changes the result within the method's tolerance, and an FMU state holds it."""
    fmu = posed(open_native())
    fmu.update({"method.normal": list(METHODS.normal).index("strip_halfspace") + 1})
    fmu.initialize()
    for k in range(3):
        fmu.update({"load.normal_force": 8e4 + 2e3 * k})
        fmu.step(k * 1e-3)
    cold = contact.solve(
        separation(), contact.Creepage(*CREEPAGES.values()), load=8.4e4, speed=30.0, normal="strip_halfspace"
    )
    assert fmu["force.x"] == pytest.approx(cold.Fx, rel=1e-3)
    assert fmu["force.x"] != cold.Fx
    goes_on(fmu, open_native(), lambda one: (one.step(3e-3), one.all("output", "input", "parameter")))


def test_kernels_for_every_processor_agree_bit_by_bit(native, cases, tmp_path):
    """The wrapper chooses for the processor at run time. Here both versions run."""
    pointer = np.ctypeslib.ndpointer(np.float64)
    libraries = [ctypes.CDLL(str(kernel_library(tmp_path, cpu))) for cpu in CPUS]
    for library in libraries:
        library.size.argtypes, library.size.restype = [pointer], ctypes.c_int64
        library.prepare.argtypes = library.outputs.argtypes = [pointer] * 2
    scalars = table(POINTS).scalars
    for case in cases[:200]:
        start = np.array([float(case.values.get(s.name, s.first)) for s in scalars])
        answers = []
        for library in libraries:
            values = start.copy()
            work = np.zeros(library.size(values))
            library.prepare(values, work)
            library.outputs(values, work)
            answers.append(values)
        np.testing.assert_array_equal(*answers)
        assert not np.array_equal(answers[0], start)
