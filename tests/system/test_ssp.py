"""coupled.ssp, the wheelset and its two pairs in one file: it conforms and gives the results of the example master."""

import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd
from pyssp_standard.ssp import SSP

from contact_fmu.ssp import STEP
from contact_models.vehicle.coupling import ANSWER, QUESTION, OpenVehicle
from contact_models.vehicle.declared import SIDES
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset.system import python_contacts, scenario, simulation

N_ANSWERS = 6  # that a pair's FMU has
STEPS = 60


@pytest.fixture
def system(native) -> Path:
    """Return the file that is built in the folder of the FMUs."""
    return native.with_name("coupled.ssp")


@pytest.fixture(params=["coupled", "coupled_vehicle"])
def native_system(request, native, native_vehicles) -> Path:
    """Return the file of a wheelset, and of a vehicle, with native FMUs."""
    return (native.parent if request.param == "coupled" else native_vehicles) / f"{request.param}.ssp"


def jacobi(step: float, from_nothing: bool = False) -> np.ndarray:
    """Return lateral position and yaw after each step of Python objects. With `from_nothing` all connectors start at 0."""
    given = scenario()
    whole, contacts, rows = simulation(given), python_contacts(given), []
    opened = OpenVehicle(whole)
    questions, late = np.zeros((len(SIDES), len(QUESTION))), np.zeros((len(SIDES), len(ANSWER)))
    for k in range(STEPS):
        if from_nothing:
            answers = (
                late if k == 0 else np.array([c.answer(q, 0.0, step) for c, q in zip(contacts, questions, strict=True)])
            )
            opened.ask()
            opened.move(late, step)
            questions, late = opened.ask(), answers
        else:
            opened.run(contacts, step, 1, parallel=True)
        rows.append(whole.state.q[whole.model.wheelsets[0], [Axis.Y, Axis.YAW]])
    return np.array(rows)


def by_fmpy(system: Path, step: float) -> np.ndarray:
    (binding,) = read_ssd(str(system)).system.parameterBindings
    (parameters,) = binding.parameterValues
    rows = simulate_ssp(str(system), stop_time=(STEPS - 0.5) * step, step_size=step, parameter_set=parameters)
    return np.stack((rows["vehicle.body[2].y"], rows["vehicle.body[2].yaw"]), axis=1)


def test_structure_conforms_to_the_schema_and_connects_variables_of_the_fmus(native_system, tmp_path):
    """The schema is SSP 1.0. fmpy reads it with validation, and pyssp-standard also checks connections."""
    components = read_ssd(str(native_system)).system.elements
    with SSP(str(native_system), mode="r") as package, package.system_structure as ssd:
        ssd.check_compliance(ssd.schemas[ssd.identifier], ssd.namespaces)
        assert not ssd.check_connections()
        assert len(ssd.connections()) == (len(components) - 1) * (len(QUESTION) + N_ANSWERS)
    with zipfile.ZipFile(native_system) as archive:
        archive.extractall(tmp_path)
    for component in components:
        variables = {v.name: v for v in fmpy.read_model_description(str(tmp_path / component.source)).modelVariables}
        assert component.connectors
        for connector in component.connectors:
            assert variables[connector.name].causality == connector.kind


def test_the_master_of_omsimulator_has_the_step_of_the_other_annotation(system):
    with zipfile.ZipFile(system) as archive:
        root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
    (fixed,) = root.iterfind(".//{*}System/{*}Annotations/{*}Annotation[@type='org.openmodelica']//{*}FixedStepMaster")
    (algorithm,) = root.iterfind(".//{*}FixedStepAlgorithm")
    assert float(fixed.get("stepSize")) == float(algorithm.get("baseStepSize")) == STEP


def test_a_second_structure_has_connectors_of_the_whole(system, tmp_path):
    """fmpy runs it, and an input of the system reaches the wheelset."""
    connected = tmp_path / "connected.ssp"
    with zipfile.ZipFile(system) as old, zipfile.ZipFile(connected, "w") as new:
        for name in old.namelist():
            if name != "SystemStructure.ssd":
                new.writestr(name.replace("Connected.ssd", "SystemStructure.ssd"), old.read(name))
    found = read_ssd(str(connected)).system
    assert {c.name: c.kind for c in found.connectors} == {
        **dict.fromkeys(("speed", "friction.coefficient"), "input"),
        **dict.fromkeys(("distance", "body[2].y", "body[2].yaw"), "output"),
    }
    with SSP(str(connected), mode="r") as package, package.system_structure as ssd:
        ssd.check_compliance(ssd.schemas[ssd.identifier], ssd.namespaces)
    (binding,) = found.parameterBindings
    (parameters,) = binding.parameterValues
    options = {"stop_time": 2e-3, "step_size": 2e-4, "parameter_set": parameters}
    faster, usual = (
        simulate_ssp(
            str(connected), **options, input={"speed": lambda time, v=v: v, "friction.coefficient": lambda time: 0.3}
        )
        for v in (30.0, 28.0)
    )
    assert faster["distance"][-1] == faster["vehicle.distance"][-1] > usual["distance"][-1]


def test_libcosim_gives_the_answer_of_the_example_master(system):
    """It exchanges outputs in initialisation and uses Jacobi afterwards.

    The results agree within the tolerance of interacting strips, which start from the last step in the FMUs.
    """
    expected = jacobi(STEP)
    command = [sys.executable, Path(__file__).with_name("ssp_host.py"), system, str(STEP), str(STEPS)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    lines = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("result")]
    assert (len(lines), done.returncode) == (STEPS, 0), done.stderr[-2000:]
    found = np.array([[float.fromhex(value) for value in line] for line in lines])
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-7)


def test_fmpy_gives_the_answer_of_a_jacobi_master_that_starts_from_nothing(system):
    """Every connector is 0 in its first step. So nothing carries the wheelset, and it falls for two steps."""
    assert by_fmpy(system, STEP) == pytest.approx(jacobi(STEP, from_nothing=True), rel=1e-4, abs=1e-7)


def test_the_error_of_a_start_from_zero_vanishes_with_the_step():
    """It falls by g h² in the two steps, and moves aside for two steps without creep forces."""
    coarse, fine = (
        np.abs(jacobi(h, from_nothing=True) - jacobi(h))[int(STEPS * share) - 1]
        for h, share in ((STEP, 0.5), (0.5 * STEP, 1.0))
    )
    assert (fine < 0.7 * coarse).all()
