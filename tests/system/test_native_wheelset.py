"""The native `Wheelset`: co-simulation compared with the Python model, model exchange with co-simulation."""

import ctypes
import math
import shutil
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_instance import DISCARD, ERROR, Instance, refused
from script_host import Script
from thesis_case import THESIS
from wheelset_case import NUMBERS, PARAMETERS, STATES, commands, inputs, reactions, reported, trajectory

from contact_fmu.tables.wheelset import table
from contact_models.wheelset import master
from contact_models.wheelset.fmu import FmuComponent
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import (
    CONTACT_PORTS,
    CREEPAGE,
    MOTION,
    PROBLEM,
    REACTION,
    SIDES,
    WHEELSET_PORTS,
)

NAME = "Wheelset"
DERIVATIVES = [row.name for row in table().derivatives]
IN_MOTION = {"lateral": 4e-3, "yaw": 2e-3, "lateral_velocity": 0.03, "yaw_rate": -0.05, "spin": 60.9}


@pytest.fixture(scope="module")
def folder(native_wheelset, unzipped) -> Path:
    return unzipped(native_wheelset)


@pytest.fixture
def open_wheelset(folder):
    """Return a function that instantiates the native Wheelset. All instances are freed at the end."""
    instances = []

    def open_wheelset(kind: str = "CoSimulation", **start: float) -> Instance:
        instances.append(Instance(folder, kind=kind))
        instances[-1].update({name.replace("__", "."): value for name, value in start.items()})
        return instances[-1]

    yield open_wheelset
    for instance in instances:
        instance.free()


@pytest.fixture
def fmu(open_wheelset):
    return open_wheelset().initialize()


@pytest.fixture
def exchanged(open_wheelset):
    """Return an instance in continuous-time mode of model exchange."""
    return continuous(open_wheelset("ModelExchange"))


def continuous(fmu):
    fmu.initialize()
    fmu.fmu.newDiscreteStates()
    fmu.fmu.enterContinuousTimeMode()
    return fmu


def references(fmu, *names: str) -> list[int]:
    return [fmu.variables[name].valueReference for name in names]


# ---------------------------------------------------------------- co-simulation


@pytest.mark.parametrize(
    ("name", "value"), [("initial.yaw", 2e-3), ("speed", 40.0), ("initial.lateral", -5e-3), *PARAMETERS]
)
def test_equals_the_python_packaging_for_every_parameter(open_wheelset, open_fmu, name, value):
    native, python = open_wheelset(), open_fmu(NAME)
    for fmu in (native, python):
        fmu.update({"initial.yaw": 1e-3, name: value})
        fmu.initialize()
    assert native.all("output") == pytest.approx(python.all("output"), rel=1e-12, abs=1e-13)
    for ours, theirs in zip(trajectory(native, 0), trajectory(python, 0), strict=True):
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-13)


def test_equals_the_model_on_an_irregular_track(fmu):
    model = WheelsetModel()
    for k in range(20):
        fmu.update(inputs(k))
        fmu.update({"irregularity.lateral": 1e-3 * math.sin(k), "irregularity.slope": 2e-3 * math.cos(k)})
        model.set_irregularity(1e-3 * math.sin(k), 2e-3 * math.cos(k))
        for side, forces in reactions(k).items():
            model.set_forces(side, *forces.values())
        fmu.step(k * 1e-3)
        model.step(1e-3)
        assert fmu.all("output") == pytest.approx(reported(model), rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("scheme", ["gauss_seidel", "jacobi", "iterated"])
def test_native_and_python_fmus_give_the_same_coupled_run(native, native_wheelset, fmus, scheme):
    """One process runs two different native FMUs with three instances. The wheel reaches the flange root."""
    wheelset = {"initial.lateral": 5.5e-3, "initial.yaw": 2e-3, "suspension.lateral_damping": 1e3}
    histories = []
    for wheelset_fmu, contact_fmu in (
        (native_wheelset, native),
        (fmus / "Wheelset.fmu", fmus / "WheelRailContact.fmu"),
    ):
        with ExitStack() as stack:
            first, *contacts = (
                stack.enter_context(FmuComponent(path, ports, {"speed": 28.0, **start}))
                for path, ports, start in (
                    (wheelset_fmu, WHEELSET_PORTS, wheelset),
                    *((contact_fmu, CONTACT_PORTS, THESIS) for _ in SIDES),
                )
            )
            histories.append(master.run(first, contacts, speed=28.0, step=1e-3, duration=0.06, scheme=scheme))
    ours, theirs = histories
    assert ours["right.contact.angle"].min() < math.radians(-15.0)
    for column in master.COLUMNS:
        scale = np.abs(theirs[column]).max()
        assert ours[column] == pytest.approx(theirs[column], abs=1e-12 * scale), column


def test_a_start_off_the_rails_is_discarded_with_its_reason(open_wheelset):
    fmu = open_wheelset(initial__lateral=0.2)
    refused(fmu.initialize, DISCARD)
    assert "wheel finds no contact" in fmu.log[-1][1]
    fmu.update({"initial.lateral": 0.0})
    fmu.fmu.exitInitializationMode()
    assert fmu["lateral"] == 0.0


# ---------------------------------------------------------------- model exchange

FORCED = {"right.force.x": -400.0, "left.force.x": 300.0, "right.force.y": 600.0, "left.moment.z": 3.0}


@pytest.mark.parametrize("lateral", [3e-3, 5.9e-3])
def test_model_exchange_with_cvode_equals_co_simulation(native_wheelset, lateral):
    """Forces are constant, on the tread and in the flange root. Co-simulation has an error of second order in its substeps."""
    options = {
        "stop_time": 0.15,
        "output_interval": 1e-3,
        "output": [*MOTION, "energy.drive", "energy.damper"],
        "relative_tolerance": 1e-10,
    }
    start = {"initial.lateral": lateral, "suspension.lateral_damping": 2e3, **FORCED}
    exchanged = fmpy.simulate_fmu(str(native_wheelset), fmi_type="ModelExchange", start_values=start, **options)
    errors = []
    for substeps in (5, 10):
        start["resolution.substeps"] = substeps
        stepped = fmpy.simulate_fmu(str(native_wheelset), fmi_type="CoSimulation", start_values=start, **options)
        assert stepped["time"] == pytest.approx(exchanged["time"], abs=1e-12)
        errors.append([np.abs(stepped[n] - exchanged[n]).max() / np.ptp(exchanged[n]) for n in options["output"]])
    assert max(errors[1]) < 3e-5
    assert np.linalg.norm(errors[1]) < 0.35 * np.linalg.norm(errors[0])


def test_the_start_follows_inputs_at_once(open_wheelset):
    """The states do not follow inputs, since they depend only on parameters."""
    fmu = open_wheelset("ModelExchange", initial__yaw=1e-3)
    fmu.fmu.setupExperiment(startTime=0.0)
    fmu.fmu.enterInitializationMode()
    before = fmu.all("output")
    fmu.update({"right.force.y": 1e3, "left.approach": 9e-5})
    after = fmu.all("output")
    assert {name for name in STATES if before[name] != after[name]} == set()
    assert {"right.load.normal_force", "roll", "lateral_acceleration", "left.geometry.g[21]"} <= {
        name for name in before if before[name] != after[name]
    }


def test_states_derivatives_and_nominals_are_those_of_the_description(exchanged):
    exchanged.update(FORCED)
    wanted = [*IN_MOTION.values(), 1.0, 2.0, 3.0]
    exchanged.fmu.setContinuousStates(*numbers(wanted))
    got, nominals, slopes = (numbers([0.0] * len(STATES)) for _ in range(3))
    exchanged.fmu.getContinuousStates(*got)
    exchanged.fmu.getNominalsOfContinuousStates(*nominals)
    exchanged.fmu.getDerivatives(*slopes)
    assert list(got[0]) == wanted == [exchanged[name] for name in STATES]
    assert list(nominals[0]) == [float(exchanged.variables[name].nominal) for name in STATES]
    assert list(slopes[0]) == [exchanged[name] for name in DERIVATIVES]
    assert [exchanged.variables[name].derivative.name for name in DERIVATIVES] == STATES


def test_a_state_may_be_set_by_its_value_reference(exchanged):
    """The standard has fmi2SetContinuousStates for it, but CasADi stays in event mode and uses fmi2SetReal."""
    exchanged.update(IN_MOTION)
    by_reference = exchanged.all("output")
    exchanged.fmu.setContinuousStates(*numbers([0.0] * len(STATES)))
    assert exchanged.all("output") != by_reference
    exchanged.fmu.setContinuousStates(*numbers([*IN_MOTION.values(), 0.0, 0.0, 0.0]))
    assert exchanged.all("output") == by_reference
    exchanged.fmu.enterEventMode()
    exchanged.update({"lateral": 0.0})
    assert exchanged["lateral"] == 0.0


def numbers(values):
    """Return a C array of doubles and its length."""
    return (ctypes.c_double * len(values))(*values), len(values)


def test_a_wrong_number_of_states_is_an_error(exchanged):
    for call in ("setContinuousStates", "getContinuousStates", "getDerivatives", "getNominalsOfContinuousStates"):
        array, n = numbers([0.0] * (len(STATES) + 1))
        refused(lambda call=call, array=array, n=n: getattr(exchanged.fmu, call)(array, n), ERROR)
        assert f"there are {len(STATES)}, but {len(STATES) + 1} were requested" in exchanged.log[-1][1]


def test_a_state_that_is_no_number_is_discarded_by_name(exchanged):
    states, n = numbers([*IN_MOTION.values(), 0.0, 0.0, 0.0])
    slopes = numbers([0.0] * n)
    states[1] = math.nan
    exchanged.fmu.setContinuousStates(states, n)
    refused(lambda: exchanged.fmu.getDerivatives(*slopes), DISCARD)
    assert exchanged.log[-1] == (DISCARD, "yaw = nan is not finite")
    states[1] = 0.3
    exchanged.fmu.setContinuousStates(states, n)
    refused(lambda: exchanged.fmu.getDerivatives(*slopes), DISCARD)
    assert "yawed" in exchanged.log[-1][1]
    states[1] = 1e-3
    exchanged.fmu.setContinuousStates(states, n)
    exchanged.fmu.getDerivatives(*slopes)


def test_the_power_at_the_interface_is_that_of_the_creep_forces(exchanged):
    """Readme (9) holds without an integration error in model exchange."""
    exchanged.update(FORCED | {"irregularity.lateral": 1e-3})
    exchanged.fmu.setContinuousStates(*numbers([*IN_MOTION.values(), 0.0, 0.0, 0.0]))
    names = zip(PROBLEM[CREEPAGE], REACTION[:3], strict=True)
    creep = sum(exchanged[f"{s}.{c}"] * exchanged[f"{s}.{f}"] for c, f in names for s in SIDES)
    assert exchanged["power.interface"] == pytest.approx(-28.0 * creep, rel=1e-9)
    assert abs(exchanged["power.interface"]) > 10.0


def test_an_fmu_state_of_model_exchange_holds_the_continuous_states(exchanged):
    exchanged.fmu.setContinuousStates(*numbers([*IN_MOTION.values(), 0.0, 0.0, 0.0]))
    wanted = exchanged.all("output")
    state = exchanged.fmu.getFMUstate()
    exchanged.fmu.setContinuousStates(*numbers([0.0] * len(STATES)))
    exchanged.fmu.setFMUstate(state)
    exchanged.fmu.freeFMUstate(state)
    assert exchanged.all("output") == wanted


KNOWNS = (*STATES[:5], *(f"{s}.{n}" for s in SIDES for n in REACTION), "irregularity.lateral", "irregularity.slope")
UNKNOWNS = (
    *DERIVATIVES,
    *(f"{s}.{n}" for s in SIDES for n in ("load.normal_force", "creepage.lateral", "contact.angle")),
    "right.geometry.g[21]",
)


@pytest.mark.parametrize("lateral", [0.0, 4e-3, 5.8e-3])
def test_directional_derivatives_are_central_differences(exchanged, lateral):
    """Derivatives and outputs by states and inputs are compared with fourth order differences of other steps."""
    states = [*(IN_MOTION | {"lateral": lateral}).values(), 0.0, 0.0, 0.0]
    exchanged.update(FORCED)
    exchanged.fmu.setContinuousStates(*numbers(states))
    steps = {"force": 10.0, "moment": 1.0, "approach": 4e-7, "spin": 1e-2, "rate": 1e-3, "velocity": 1e-3}
    for known in KNOWNS:
        h = next((h for key, h in steps.items() if key in known), 4e-7)
        slopes = exchanged.fmu.getDirectionalDerivative(
            references(exchanged, *UNKNOWNS), references(exchanged, known), [1.0]
        )
        at, found = exchanged[known], []
        for k in (-2, -1, 1, 2):
            if known in STATES:
                moved = list(states)
                moved[STATES.index(known)] += k * h
                exchanged.fmu.setContinuousStates(*numbers(moved))
            else:
                exchanged.update({known: at + k * h})
            found.append(np.array([exchanged[name] for name in UNKNOWNS]))
        exchanged.update({} if known in STATES else {known: at})
        exchanged.fmu.setContinuousStates(*numbers(states))
        wanted = (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)
        noise = 1e-10 * np.maximum(np.abs([exchanged[name] for name in UNKNOWNS]), 1.0) / h
        bound = 1e-4 * np.abs(wanted) + noise
        worst = np.argmax(np.abs(slopes - wanted) / bound)
        assert (np.abs(slopes - wanted) <= bound).all(), (known, UNKNOWNS[worst], slopes[worst], wanted[worst])


# ---------------------------------------------------------------- other platforms


@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.usefixtures("wine")
def test_the_windows_library_gives_the_same_numbers_under_wine(folder, tmp_path, kind):
    linux, windows = (Script(p, tmp_path)(folder, kind, commands(kind)) for p in ("linux64", "win64"))
    assert linux.size == (3 * len(NUMBERS) if kind else 3 * len(STATES))
    assert windows == pytest.approx(linux, rel=1e-10, abs=1e-12)


def test_a_host_in_c_gets_what_fmpy_gets(folder, tmp_path, open_wheelset):
    printed = Script("linux64", tmp_path)(folder, 1, commands(1)).reshape(3, -1)
    fmu = open_wheelset(initial__lateral=0.005).initialize()
    for row, wanted in zip(printed, trajectory(fmu, 0), strict=True):
        assert row.tolist() == [value for name, value in wanted.items() if name in NUMBERS]


def test_valgrind_finds_nothing(folder, tmp_path):
    """No result depends on uninitialised memory, in model exchange and co-simulation."""
    if not shutil.which("valgrind"):
        pytest.skip("valgrind is not installed")
    check = ("valgrind", "--error-exitcode=9", "--leak-check=full", "-q")
    for kind in (0, 1):
        Script("linux64", tmp_path)(folder, kind, commands(kind), before=check)


def test_python_reports_the_same_defaults(fmu):
    assert fmu.all("output") == reported(WheelsetModel(WheelsetParameters()))
