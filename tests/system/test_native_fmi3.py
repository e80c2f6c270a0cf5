"""The native FMUs of FMI 3.0. Their library is that of FMI 2.0; arrays are variables."""

import re

import fmpy
import numpy as np
import pytest
from contact_case import NAME, posed
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave
from fmu_instance import DISCARD, ERROR, Instance, Instance3, goes_on, refused
from runs import RUNS

import contact
from contact.inputs.options import N_STRIPS

TUNED = {"friction.kinetic": 0.1, "material.shear_modulus": 6e10}
#: A run on surfaces, which no FMU for hosts with Python has.
SURFACES = ({"pose.y": 2e-3, "pose.yaw": 1e-3, "pose.station": 0.5}, ("velocity.x", -1.0))


@pytest.fixture
def fmu(open_native_fmi3):
    return posed(open_native_fmi3()).initialize(stop_time=1.0)


class Talk:
    """What an instance answers: the status of each call, and all numbers after it, by their names of FMI 2.0."""

    def __init__(self, fmu: Instance, names: list[str]) -> None:
        self.fmu, self.names, self.said = fmu, names, []

    def __call__(self, call, *words) -> None:
        try:
            call(*words)
            self.said.append(0)
        except FMICallException as error:
            self.said.append(error.status)
        self.said.append(self.fmu.read(self.names))


def logged(fmu: Instance) -> list[tuple[int, str]]:
    """Return the messages without the names of functions, which have their version in them."""
    return [(status, re.sub(r"fmi\d\w+", "fmi", text)) for status, text in fmu.log]


def of_steps(fmu: Instance, other: Instance, name: str, names: list[str], fixed: str) -> list:
    """Return what is said in co-simulation, where the state goes on in the other instance, with the log."""
    values, (wrong, bad) = RUNS.get(name, SURFACES)
    talk = Talk(fmu, names)
    fmu.update(values)
    before = fmu.fmu.getFMUState()
    fmu.initialize(stop_time=1.0).step()
    talk.said.append(goes_on(fmu, other, lambda it: [(it.step(1e-3 * k), it.read(names))[1] for k in (1, 2)]))
    talk(fmu.update, {n: value for n, value in TUNED.items() if n in names})
    talk(fmu.step, 3e-3)
    talk(fmu.update, {fixed: 0.4})
    talk(fmu.step, 2.0)  # a gap in time
    talk(fmu.step, 4e-3, 2.0)  # beyond the stop time
    good = fmu[wrong]
    fmu.update({wrong: bad})
    talk(fmu.step, 4e-3)
    fmu.update({wrong: good})
    talk(fmu.step, 4e-3)
    talk(fmu.fmu.terminate)
    fmu.fmu.reset()
    talk(fmu.initialize)
    fmu.fmu.setFMUState(before)
    fmu.fmu.freeFMUState(before)
    talk(fmu.initialize)
    return [*talk.said, *logged(fmu)]


def of_events(fmu: Instance, name: str, names: list[str]) -> list:
    """Return what is said in model exchange, where outputs follow inputs at once and parameters change in events."""
    values, (wrong, _) = RUNS.get(name, SURFACES)
    talk, tuned = Talk(fmu, names), {n: value for n, value in TUNED.items() if n in names}
    fmu.update(values)
    fmu.initialize()
    talk(fmu.fmu.enterContinuousTimeMode)
    for k in (1, 2):
        fmu.fmu.setTime(1e-3 * k)
        talk(fmu.update, {wrong: 1e-3 * k})
        talk(fmu.fmu.completedIntegratorStep)
    talk(fmu.update, tuned)
    fmu.fmu.enterEventMode()
    talk(fmu.update, tuned)
    return [*talk.said, *logged(fmu), fmu.directional(["force.x", "force.y"], [wrong], [1.0]).tolist()]


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("name", [*RUNS, "WheelRailSurfaces"])
def test_every_function_answers_as_that_of_fmi_2(request, native, unzipped, freed, name, kind):
    """So what tests find of FMI 2.0 holds for FMI 3.0: numbers, arrays, states, refusals, messages, tunable parameters."""
    if name == "Wheelset" and kind == "ModelExchange":
        pytest.skip("the Wheelset is for co-simulation only")
    files = native.with_name(f"{name}.fmu"), native.parent / "fmi3" / f"{name}.fmu"
    if name not in RUNS:
        files = request.getfixturevalue("native_surfaces")
    two, three = (
        [freed(of(unzipped(file), kind=kind)) for _ in range(2)]
        for of, file in zip((Instance, Instance3), files, strict=True)
    )
    described = two[0].variables
    names = [n for n in described if three[0].element(n)[0] in three[0].variables]
    assert len(names) > 40
    if kind == "CoSimulation":
        fixed = next(n for n in names if (described[n].variability, described[n].type) == ("fixed", "Real"))
        found, wanted = (of_steps(*pair, name, names, fixed) for pair in (three, two))
    else:
        found, wanted = (of_events(pair[0], name, names) for pair in (three, two))
    np.testing.assert_equal(found, wanted)


def test_arrays_move_with_time_with_fmpy(native_fmi3):
    """fmpy accepts signals of one size in a run, here both arrays. The gap falls linearly at a prescribed approach."""
    y = -0.02 + 0.001 * np.arange(41)
    kinds = [("time", float), ("geometry.g", float, (41,)), ("geometry.A", float, (41,))]
    gaps, A = (y**2, y**2 - 4e-5), np.full(41, 1.0)
    signals = np.array([(0.0, gaps[0], A), (1e-2, gaps[1], A)], dtype=kinds)
    start = {"load.kind": 2, "load.approach": 5e-5}
    result = fmpy.simulate_fmu(
        str(native_fmi3),
        fmi_type="ModelExchange",
        stop_time=1e-2,
        output_interval=1e-3,
        start_values=start,
        input=signals,
        output=["force.n"],
    )
    wanted = [
        contact.solve(contact.Separation(y, gaps[0] - 4e-6 * k, A), contact.Creepage(0.0), approach=5e-5).N
        for k in range(11)
    ]
    np.testing.assert_allclose(result["force.n"], wanted, rtol=1e-9)


def test_a_step_says_that_it_was_done_to_its_end(fmu):
    assert fmu.step(0.0, 0.25) == (False, False, False, 0.25)
    assert fmu["time"] == 0.25


def test_resolution_is_set_only_in_configuration_mode(open_native_fmi3):
    fmu = open_native_fmi3()
    refused(lambda: fmu.update({"resolution.n_strips": 12}), ERROR)
    assert fmu.log == [(ERROR, "fmi3SetUInt64: only structural parameters are set, and only in configuration mode")]
    fmu.configure(n_strips=12, n_elements=20)
    fmu.initialize().step()
    assert fmu["field.pressure"].shape == (4, 12, 20)
    refused(lambda: fmu.update({"resolution.n_strips": 13}), ERROR)
    refused(fmu.fmu.enterConfigurationMode, ERROR)
    fmu.fmu.reset()
    assert fmu["resolution.n_strips"] == N_STRIPS.usual
    fmu.configure(n_strips=2_000_000_000).log.clear()
    refused(fmu.initialize, DISCARD)
    assert fmu.log == [(DISCARD, "resolution.n_strips = 2e+09 is outside the allowed range [4, 1000]")]


def test_the_number_of_values_must_be_that_of_the_array(fmu):
    reference = [fmu.variables["geometry.g"].valueReference]
    for call in (lambda: fmu.fmu.setFloat64(reference, [0.0] * 40), lambda: fmu.fmu.getFloat64(reference, nValues=42)):
        fmu.log.clear()
        refused(call, ERROR)
        assert "values are given, but the variables have 41" in fmu.log[0][1]
    refused(
        lambda: fmu.fmu.getFloat64([reference[0] + 1]), ERROR
    )  # an element of the array: a variable only in FMI 2.0


def test_what_is_not_provided_is_refused(native_fmi3_folder):
    description = fmpy.read_model_description(str(native_fmi3_folder))
    said = []
    for options, why in (
        ({"eventModeUsed": True}, "event mode"),
        ({"requiredIntermediateVariables": [14]}, "intermediate"),
    ):
        slave = FMU3Slave(
            guid=description.guid, unzipDirectory=str(native_fmi3_folder), modelIdentifier=NAME, instanceName="instance"
        )
        with pytest.raises(Exception, match="Failed to instantiate"):
            slave.instantiate(logMessage=lambda *message: said.append(message[-1].decode()), **options)
        assert why in said[-1]


def test_starts_can_be_read_before_initialisation(open_native_fmi3, native_fmi3):
    """FMI 2.0 does not allow this. Calculated outputs have no value yet."""
    fmu = open_native_fmi3()
    for variable in fmpy.read_model_description(str(native_fmi3)).modelVariables:
        if variable.causality in ("parameter", "input", "structuralParameter"):
            assert np.ravel(fmu[variable.name]).tolist() == [float(word) for word in variable.start.split()]
    with pytest.raises(FMICallException):
        fmu["force.x"]
