"""The page documentation/index.html in each FMU: its first steps have the numbers of the FMU itself."""

import re
from zipfile import ZipFile

import fmpy
import pytest

from contact_fmu.first_steps import FIRST, STEPS

VEHICLES = ("Vehicle", "OpenVehicle")


def page(file) -> str:
    with ZipFile(file) as archive:
        return archive.read("documentation/index.html").decode()


def numbers(cell: str) -> dict[str, float]:
    """Return the values of a cell `name = value<br>…`."""
    return {name: float(value) for name, value in re.findall(r"([\w.\[\]]+) = ([-+.\de]+)", cell)}


@pytest.fixture(params=FIRST)
def file(request):
    """Return the file of each native FMU."""
    name = request.param
    if name == "WheelRailSurfaces":
        return request.getfixturevalue("native_surfaces")[0]
    native = request.getfixturevalue("native")
    return (request.getfixturevalue("native_vehicles") if name in VEHICLES else native.parent) / f"{name}.fmu"


def test_the_examples_on_the_page_are_what_the_fmu_answers(file):
    """The page has four digits."""
    (table,) = re.findall(r'<table class="example">(.*?)</table>', page(file), re.DOTALL)
    rows = re.findall(r"<tr><td>(.*?)</td><td>(.*?)</td>", table)
    assert rows
    step = float(fmpy.read_model_description(str(file)).defaultExperiment.stepSize)
    for given, found in rows:
        outputs = numbers(found)
        assert outputs
        result = fmpy.simulate_fmu(
            str(file),
            fmi_type="CoSimulation",
            start_values=numbers(given),
            output=list(outputs),
            stop_time=STEPS * step,
            output_interval=step,
        )
        last = result[-1]
        assert last["time"] == pytest.approx(STEPS * step)
        assert {name: last[name] for name in outputs} == pytest.approx(outputs, rel=6e-4, abs=1e-12)


def test_inputs_to_connect_first_are_inputs_of_the_fmu(file):
    inputs = {
        re.sub(r"\[1\]$", "", v.name)
        for v in fmpy.read_model_description(str(file)).modelVariables
        if v.causality == "input"
    }
    (named,) = re.findall(r"Connect these inputs first: (.*?)</p>", page(file))
    assert {*re.findall(r"<b>(.*?)</b>", named)} <= inputs


def test_the_page_has_the_sketch_and_the_status_values(file):
    text = page(file)
    assert "<svg" in text
    assert "velocity of the wheel minus that of the rail" in text
    assert ("<li>2 NoContact" in text) == ("Real: 1 OK" in text)
