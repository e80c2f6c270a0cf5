"""The FMU `WheelRailContact` through the C interface of FMI."""

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from contact_case import CREEPAGES, NAME, posed, separation
from fmpy.validation import validate_fmu
from fmu_instance import DISCARD, ERROR, Instance, refused
from thesis_case import THESIS

import contact
from contact.theory import kalker
from contact_fmu.catalogue import models
from contact_fmu.python.packaging import (
    build,  # imported here, since an FMU that is loaded first brings its own pythonfmu
)

ROOT = Path(__file__).parents[2]


@pytest.fixture
def fmu(open_fmu):
    """Return an instance with `separation` and CREEPAGES, ready to step."""
    return posed(open_fmu(NAME)).initialize(stop_time=1.0)


def test_fmpy_finds_no_problem(fmus):
    assert validate_fmu(str(fmus / f"{NAME}.fmu")) == []


def test_the_build_is_reproducible(fmus, tmp_path):
    for model in models(41, accumulation=True):
        path = build(model, tmp_path)
        assert path.read_bytes() == (fmus / path.name).read_bytes()


def test_simulates_with_fmpy_at_its_start_values(fmus):
    result = fmpy.simulate_fmu(str(fmus / f"{NAME}.fmu"), stop_time=0.01, output=["force.n", "force.y", "total.energy"])
    np.testing.assert_allclose(result["force.n"], 80e3, rtol=1e-9)
    assert result["time"][-1] == pytest.approx(0.01)


def test_equals_the_solver(fmu):
    fmu.step()
    solution = contact.solve(separation(), contact.Creepage(*CREEPAGES.values()), load=80e3, speed=30.0)
    damage = contact.damage.evaluate(solution, 0.46)
    expected = {
        "force.x": solution.Fx,
        "force.y": solution.Fy,
        "force.n": solution.N,
        "moment.z": solution.Mz,
        "approach": solution.approach,
        "pressure.max": solution.max_pressure,
        "patch.area": solution.area,
        "patch.length": solution.length,
        "patch.width": solution.width,
        "patch.count_real": solution.n_patches,
        "slip.ratio": solution.slip_ratio,
        "power.friction": 30.0 * solution.power_per_metre,
        "damage.T_gamma": damage.T_gamma,
        "damage.wear_rate_pearce_sherratt": damage.pearce_sherratt,
        "damage.index_burstow": damage.burstow,
        "damage.wear_rate_usfd": damage.usfd,
        "damage.archard_depth_max": damage.archard.depth_max,
        "damage.archard_volume": damage.archard.volume,
        "damage.fatigue_index_surface": damage.fatigue_index,
        "damage.stress_index_max": damage.stress_index.max,
        "damage.energy_index_max": damage.energy_index.max,
        "gap_error": solution.gap_error,
        "bend": solution.bend,
        "stiffness.normal": solution.normal_stiffness,
        "status_real": solution.status,
        "total.energy": 30e-3 * solution.power_per_metre,
        "total.worn_volume": 30e-3 * damage.archard.volume,
    }
    outputs = fmu.all("output")
    assert set(outputs) == {*expected, *(f"creep_stiffness[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3))}
    for name, value in expected.items():
        np.testing.assert_allclose(outputs[name], value, rtol=1e-12, err_msg=name)
    assert all(outputs[name] != 0.0 for name in outputs if name not in ("damage.index_burstow", "bend"))


def test_every_option_reaches_the_solver(open_fmu):
    fmu = open_fmu(NAME)
    fmu.update({"geometry.kind": 2, "geometry.A0": 0.9, "geometry.B0": 2.1, "load.kind": 2, "load.approach": 7e-5})
    fmu.update({"method.normal": 2, "method.tangential": 2, "friction.coefficient": 0.4, **CREEPAGES})
    fmu.update({"resolution.n_strips": 12, "resolution.n_elements": 14, "material.shear_modulus": 79e9})
    fmu.update({"material.poisson_ratio": 0.3, "material.hardness": 3e9, "material.shear_yield": 25e7})
    fmu.update({"wheel.radius": 0.5, "speed": 7.0})
    fmu.initialize()
    solution = contact.solve(
        contact.Separation.hertzian(0.9, 2.1),
        contact.Creepage(*CREEPAGES.values()),
        approach=7e-5,
        normal="hertz",
        tangential="fastsim",
        friction=0.4,
        n_strips=12,
        n_elements=14,
        material=contact.Material(79e9, 0.3, hardness=3e9, shear_yield=25e7),
        speed=7.0,
    )
    damage = contact.damage.evaluate(solution, 0.5)
    for name, value in (
        ("force.n", solution.N),
        ("force.x", solution.Fx),
        ("force.y", solution.Fy),
        ("power.friction", 7.0 * solution.power_per_metre),
        ("damage.archard_depth_max", damage.archard.depth_max),
        ("damage.stress_index_max", damage.stress_index.max),
    ):
        np.testing.assert_allclose(fmu[name], value, rtol=1e-12, err_msg=name)


def test_totals_add_up_power_over_steps_of_any_length(fmu):
    fmu.step(0.0, 1e-3)
    power, worn = fmu["power.friction"], fmu["damage.archard_volume"] * 30.0
    fmu.update({"creepage.longitudinal": 3e-3})
    fmu.step(1e-3, 2e-3)
    assert fmu["total.energy"] == pytest.approx(power * 1e-3 + fmu["power.friction"] * 2e-3, rel=1e-12)
    assert fmu["total.worn_volume"] == pytest.approx(worn * 1e-3 + fmu["damage.archard_volume"] * 60e-3, rel=1e-12)


def test_creep_stiffness_of_an_ellipse_at_rest_is_kalkers(open_fmu):
    fmu = open_fmu(NAME)
    fmu.update({"geometry.kind": 2, "geometry.A0": 1.0, "geometry.B0": 2.0, **THESIS})
    fmu.initialize()
    fmu.step()
    got = [[fmu[f"creep_stiffness[{i},{j}]"] for j in (1, 2, 3)] for i in (1, 2, 3)]
    steel, ellipse = contact.STEEL, contact.hertz(1.0, 2.0, load=80e3)
    a, b = ellipse.a, ellipse.b
    C11, C22, C23, _ = kalker.coefficients(kalker.table(steel.poisson_ratio), math.log(a / b))
    G, c = steel.shear_modulus, math.sqrt(a * b)
    assert got[0][0] == pytest.approx(-G * c**2 * C11, rel=0.01)
    assert got[1][1] == pytest.approx(-G * c**2 * C22, rel=0.01)
    assert got[1][2] == pytest.approx(-G * c**3 * C23, rel=0.02)
    np.testing.assert_allclose([got[0][1], got[0][2], got[1][0], got[2][0]], 0.0, atol=1e-6 * G * c**2)


def test_creep_stiffness_is_the_slope_of_the_forces(fmu):
    fmu.step()
    slope = [fmu[f"creep_stiffness[{i},1]"] for i in (1, 2, 3)]
    h, forces = 1e-6, []
    for change in (h, -h):
        fmu.update({"creepage.longitudinal": CREEPAGES["creepage.longitudinal"] + change})
        fmu.step()
        forces.append([fmu["force.x"], fmu["force.y"], fmu["moment.z"]])
    np.testing.assert_allclose(slope, np.subtract(*forces) / (2.0 * h), rtol=1e-3, atol=1e-4 * abs(slope[0]))


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("geometry.dy", 0.0, "]0, inf["),
        ("geometry.dy", -1e-3, "]0, inf["),
        ("material.poisson_ratio", 0.6, "[0, 0.5]"),
        ("resolution.n_strips", 3, "[4, 1000]"),
        ("method.normal", 99, f"[1, {len(contact.methods().batched.normal)}]"),
    ],
)
def test_a_bad_parameter_is_discarded_by_name(open_fmu, name, value, allowed):
    fmu = open_fmu(NAME)
    fmu.update({name: value})
    refused(fmu.initialize, DISCARD)
    assert fmu.log == [(DISCARD, f"{name} = {value:g} is outside the allowed range {allowed}")]
    assert all(math.isfinite(v) for v in fmu.all("output").values())


def test_an_invalid_step_is_an_error(fmu):
    for time, h, message in (
        (0.0, 0.0, "communicationStepSize = 0 is outside"),
        (0.0, -1e-3, "communicationStepSize = -0.001 is outside"),
        (0.0, 1.1, "end of the step = 1.1000000000000001 is after the stopTime = 1"),
        (1.0, 1e-3, "currentCommunicationPoint = 1 does not continue the last step"),
    ):
        refused(lambda time=time, h=h: fmu.step(time, h), ERROR)
        assert message in fmu.log[-1][1]
    fmu.step(0.0, 1.0)


def test_a_fixed_parameter_keeps_its_value_after_initialisation(fmu):
    refused(lambda: fmu.update({"geometry.dy": 0.002}), ERROR)
    assert fmu["geometry.dy"] == 0.001
    assert "geometry.dy cannot be set as Real after initialisation" in fmu.log[-1][1]


def test_a_start_value_out_of_range_is_not_answered_with_ok(open_fmu):
    """The instance stays in initialisation, where the value can be corrected."""
    instance = open_fmu(NAME)
    instance.fmu.setupExperiment(startTime=0.0)
    instance.fmu.enterInitializationMode()
    instance.update({"load.normal_force": -1e4})
    refused(instance.fmu.exitInitializationMode, DISCARD)
    assert any("load.normal_force = -1" in message for _, message in instance.log)
    instance.update({"load.normal_force": 8e4})
    instance.fmu.exitInitializationMode()
    instance.step()
    assert instance["status"] == contact.Status.OK


def test_instances_do_not_share_anything(open_fmu):
    one, two = open_fmu(NAME), open_fmu(NAME)
    one.update({"creepage.longitudinal": 1e-3})
    for fmu in (one, two):
        fmu.initialize()
        fmu.step()
    assert one["force.x"] < -1e3
    assert two["force.x"] == 0.0


def test_runs_from_a_folder_with_spaces(open_fmu):
    fmu = open_fmu(NAME, "with some spaces").initialize()
    fmu.step()
    assert fmu["force.n"] == pytest.approx(80e3)


def test_two_builds_and_two_versions_live_in_one_process(open_fmu, tmp_path):
    """If their scripts had the same name, pythonfmu would run the first for both."""
    command = [sys.executable, ROOT / "build_fmu.py", "--packaging", "python", "--out", tmp_path, "--points", "7"]
    said = subprocess.run(command, check=True, timeout=120, capture_output=True, text=True).stdout
    assert "not made, WheelRailContact.fmu does not take the 41 samples of a separation that Wheelset.fmu gives" in said
    fmpy.extract(str(tmp_path / "python" / f"{NAME}.fmu"), str(tmp_path / "seven"))
    large, small = open_fmu(NAME), Instance(tmp_path / "seven")
    for fmu in (large, small):
        fmu.initialize()
        fmu.step()
        assert fmu["force.n"] == pytest.approx(80e3)
    assert "geometry.g[41]" in large.variables
    assert "geometry.g[8]" not in small.variables
    small.fmu.freeInstance()


def test_an_fmu_of_another_version_is_refused_with_a_reason(fmus, tmp_path):
    fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path / "old"))
    (script,) = (tmp_path / "old" / "resources").glob("wheelrailcontact_*.py")
    old = script.with_name("wheelrailcontact_old.py")
    old.write_text(script.read_text().replace('guid="{', 'guid="{old-'))
    (tmp_path / "old" / "resources" / "slavemodule.txt").write_text(old.stem)
    log: list = []
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance(tmp_path / "old", log=log)
    assert "built with another version of wheelrail-contact" in log[0][1]


def test_a_process_ends_without_touching_freed_memory(fmus, tmp_path):
    """pythonfmu's library wrote into a freed block at the end, and now and then glibc ended the process with an error."""
    if not shutil.which("valgrind"):
        pytest.skip("THE END OF A PROCESS IS NOT CHECKED: valgrind is not installed (apt-get install valgrind)")
    code = (
        "import sys, fmpy\n"
        "folder = fmpy.extract(sys.argv[1], unzipdir=sys.argv[2])\n"
        "fmpy.instantiate_fmu(folder, fmpy.read_model_description(folder), 'CoSimulation')\n"
        "print('instantiated')\n"
    )
    log, folder = tmp_path / "log", tmp_path / "fmu"
    done = subprocess.run(
        ["valgrind", f"--log-file={log}", sys.executable, "-c", code, fmus / f"{NAME}.fmu", folder],
        check=False,
        capture_output=True,
        text=True,
        timeout=600,
        env=os.environ | {"PYTHONMALLOC": "malloc"},
    )
    assert (done.returncode, done.stdout.strip()) == (0, "instantiated"), done.stderr[-2000:]
    assert "finalizePythonInterpreter" not in log.read_text()


def test_runs_in_libcosim(fmus):
    """libcosim is an independent XML parser and host. It supports only Reals and Integers of the FMU."""
    host = subprocess.run(
        [sys.executable, Path(__file__).with_name("cosim_host.py"), fmus / f"{NAME}.fmu"],
        check=False,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert host.returncode == 0, host.stdout[-2000:] + host.stderr[-4000:]
    lines = [line.split()[1:] for line in host.stdout.splitlines() if line.startswith("result")]
    rows = [[float.fromhex(number) for number in line] for line in lines]
    y = -0.02 + 0.001 * np.arange(41)
    energy = 0.0
    for load, (N, Fx, total) in zip((80e3, 50e3), rows, strict=True):
        solution = contact.solve(contact.Separation(y, y**2, 0.5 / 0.46), contact.Creepage(1e-3), load=load)
        energy += 2e-3 * 20.0 * solution.power_per_metre
        assert [N, Fx, total] == pytest.approx([solution.N, solution.Fx, energy], rel=1e-9)


def test_without_the_package_no_instance_is_made_and_the_reason_is_logged(fmus, tmp_path):
    """An exception at this point would end a host that is not in Python."""
    folder = Path(fmpy.extract(str(fmus / f"{NAME}.fmu"), str(tmp_path)))
    (script,) = (folder / "resources").glob("wheelrailcontact_*.py")
    alone = script.with_name("wheelrailcontact_alone.py")
    alone.write_text(script.read_text().replace("from contact_fmu.python", "from contact_of_nobody"))
    (folder / "resources" / "slavemodule.txt").write_text(alone.stem)
    log: list = []
    with pytest.raises(Exception, match="Failed to instantiate"):
        Instance(folder, log=log)
    assert log[0][0] == ERROR
    assert log[0][1].startswith(f"the FMU {NAME} needs the package wheelrail-contact")
