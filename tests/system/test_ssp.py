"""coupled.ssp, the wheelset and its contacts in one file: it conforms and gives the results of the example master."""

import subprocess
import sys
import zipfile
from importlib.util import find_spec
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd
from pyssp_standard.ssp import SSP

from contact_fmu.ssp import STEP
from contact_models.wheelset import master
from contact_models.wheelset.components import direct
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import IRREGULARITY, LOAD, MOTION, PROBLEM, REACTION, SIDES

PACKAGINGS = ["python", *(["native"] if find_spec("contact_fmu.native.wheelset") else [])]
STEPS = 60


@pytest.fixture(params=PACKAGINGS)
def system(request) -> Path:
    """Return the file that is built in the folder of the FMUs."""
    python = request.param == "python"
    folder = request.getfixturevalue("fmus") if python else request.getfixturevalue("native").parent
    return folder / "coupled.ssp"


def jacobi(step: float, from_nothing: bool = False) -> np.ndarray:
    """Return lateral position and yaw after each step of Python objects. With `from_nothing` all connectors start at 0."""
    p = WheelsetParameters()
    wheelset, contacts = direct(p)
    if not from_nothing:
        history = master.run(wheelset, contacts, speed=p.speed, step=step, duration=(STEPS + 1) * step, scheme="jacobi")
        return np.stack((history["lateral"], history["yaw"]), axis=1)[1:]
    rows, problems = [], [np.zeros(len(PROBLEM))] * len(SIDES)
    reactions = [np.zeros(len(REACTION))] * len(SIDES)
    for k in range(STEPS):
        answers = []
        for contact, problem in zip(contacts, problems, strict=True):
            if problem[LOAD] > 0.0:
                contact.write("problem", problem)
                contact.step(k * step, step)
            answers.append(contact.read("reaction") if problem[LOAD] > 0.0 else np.zeros(len(REACTION)))
        for side, reaction in zip(SIDES, reactions, strict=True):
            wheelset.write(f"{side}.reaction", reaction)
        wheelset.step(k * step, step)
        problems, reactions = [wheelset.read(f"{side}.problem") for side in SIDES], answers
        rows.append(wheelset.read("motion")[:2])
    return np.array(rows)


def by_fmpy(system: Path, step: float) -> np.ndarray:
    (binding,) = read_ssd(str(system)).system.parameterBindings
    (parameters,) = binding.parameterValues
    rows = simulate_ssp(str(system), stop_time=(STEPS - 0.5) * step, step_size=step, parameter_set=parameters)
    return np.stack((rows["wheelset.lateral"], rows["wheelset.yaw"]), axis=1)


def test_structure_conforms_to_the_schema(system):
    """The schema is SSP 1.0. fmpy reads it with validation, and pyssp-standard also checks connections."""
    assert len(read_ssd(str(system)).system.elements) == 3
    with SSP(str(system), mode="r") as package, package.system_structure as ssd:
        ssd.check_compliance(ssd.schemas[ssd.identifier], ssd.namespaces)
        assert not ssd.check_connections()
        assert len(ssd.connections()) == len(SIDES) * (len(PROBLEM) + len(REACTION))


def test_the_master_of_omsimulator_has_the_step_of_the_other_annotation(system):
    with zipfile.ZipFile(system) as archive:
        root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
    (fixed,) = root.iterfind(".//{*}System/{*}Annotations/{*}Annotation[@type='org.openmodelica']//{*}FixedStepMaster")
    (algorithm,) = root.iterfind(".//{*}FixedStepAlgorithm")
    assert float(fixed.get("stepSize")) == float(algorithm.get("baseStepSize")) == STEP


def test_connectors_are_variables_of_the_fmus_with_their_causality_and_unit(system, tmp_path):
    components = read_ssd(str(system)).system.elements
    with zipfile.ZipFile(system) as archive:
        archive.extractall(tmp_path)
    for component in components:
        variables = {v.name: v for v in fmpy.read_model_description(str(tmp_path / component.source)).modelVariables}
        assert component.connectors
        for connector in component.connectors:
            assert variables[connector.name].causality == connector.kind


def test_a_second_structure_has_connectors_of_the_whole(system, tmp_path):
    """fmpy runs it, and an input of the system reaches the wheelset."""
    connected = tmp_path / "connected.ssp"
    with zipfile.ZipFile(system) as old, zipfile.ZipFile(connected, "w") as new:
        for name in old.namelist():
            if name != "SystemStructure.ssd":
                new.writestr(name.replace("Connected.ssd", "SystemStructure.ssd"), old.read(name))
    found = read_ssd(str(connected)).system
    assert {c.name: c.kind for c in found.connectors} == {
        **dict.fromkeys(IRREGULARITY, "input"),
        **dict.fromkeys(MOTION, "output"),
    }
    with SSP(str(connected), mode="r") as package, package.system_structure as ssd:
        ssd.check_compliance(ssd.schemas[ssd.identifier], ssd.namespaces)
    (binding,) = found.parameterBindings
    (parameters,) = binding.parameterValues
    signals = {"irregularity.lateral": lambda time: 2e-3, "irregularity.slope": lambda time: 0.0}
    options = {"stop_time": 2e-3, "step_size": 2e-4, "parameter_set": parameters}
    moved, still = (simulate_ssp(str(connected), **options, **given) for given in ({"input": signals}, {}))
    assert moved["lateral"][-1] == moved["wheelset.lateral"][-1]
    assert moved["lateral"][-1] != still["lateral"][-1]


def test_libcosim_gives_the_answer_of_the_example_master(system):
    """It exchanges outputs in initialisation and uses Jacobi afterwards.

    The results agree within the tolerance of interacting strips, which start from the last step in the FMUs.
    """
    expected = jacobi(2e-4)
    command = [sys.executable, Path(__file__).with_name("ssp_host.py"), system, "2e-4", str(STEPS)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    lines = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("result")]
    assert (len(lines), done.returncode) == (STEPS, 0), done.stderr[-2000:]
    found = np.array([[float.fromhex(value) for value in line] for line in lines])
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-7)


def test_fmpy_gives_the_answer_of_a_jacobi_master_that_starts_from_nothing(system):
    """Every connector is 0 in its first step. So there is no load and no contact, and two steps have no creep forces."""
    assert by_fmpy(system, 2e-4) == pytest.approx(jacobi(2e-4, from_nothing=True), rel=1e-4, abs=1e-7)


def test_the_error_of_a_start_from_zero_vanishes_with_the_step():
    """It lies within the error of the scheme, which is also of first order: half the step gives half the error."""
    coarse, fine = (
        np.abs(jacobi(h, from_nothing=True) - jacobi(h))[int(STEPS * share) - 1]
        for h, share in ((2e-4, 0.5), (1e-4, 1.0))
    )
    assert fine / coarse == pytest.approx(0.5, abs=0.1)
