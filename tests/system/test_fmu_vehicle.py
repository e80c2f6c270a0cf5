"""The FMUs of vehicles: with contacts, and without them in coupled_vehicle.ssp. Both give the run of the one kernel."""

import zipfile
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.ssd import read_ssd
from pyssp_standard.ssp import SSP

from contact_models.runs import scenario
from contact_models.vehicle.course import lay
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.simulation import ContactOptions, Simulation
from examples.coupled_vehicle.system import VehicleSystem
from reference.native import SCENARIO

STEP, START, MANY = 2e-4, 30.0, 100
FAST = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12)
COORDINATES = ("x", "y", "z", "roll", "pitch", "yaw")


@pytest.fixture(scope="module")
def folder(native_vehicles) -> Path:
    """Return the folder of the FMUs and the system of the vehicle."""
    return native_vehicles


def one_kernel(options: ContactOptions = FAST, start: float = START) -> Simulation:
    given = scenario.read(SCENARIO)
    d = given.declared
    rows = lay(d.track, d.length, given.speed, (d.seed,), d.recording.settling)
    return Simulation(given.vehicle, rows, given.wheel, given.rail, d.friction, options, start=start)


class Slave:
    """The FMU `Vehicle`, driven by fmpy."""

    def __init__(self, folder: Path, options: ContactOptions = FAST, start: float = START, **more: float) -> None:
        description = fmpy.read_model_description(str(folder / "Vehicle.fmu"))
        self.variables = {v.name: v for v in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=fmpy.extract(str(folder / "Vehicle.fmu")),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="vehicle",
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.time = 0.0
        self.set("initial.distance", start)
        self.set("resolution.step", STEP)
        for name, value in more.items():
            self.set(name, value)
        for name in ("method.normal", "method.tangential"):
            variable = self.variables[name]
            items = {item.name: int(item.value) for item in variable.declaredType.items}
            self.fmu.setInteger([variable.valueReference], [items[getattr(options, name.split(".")[1])]])
        for name in ("n_strips", "n_elements", "pace"):
            self.fmu.setInteger([self.variables[f"resolution.{name}"].valueReference], [getattr(options, name)])
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def set(self, name: str, value: float) -> None:
        self.fmu.setReal([self.variables[name].valueReference], [value])

    def get(self, *names: str) -> np.ndarray:
        return np.array(self.fmu.getReal([self.variables[name].valueReference for name in names]))

    def step(self, h: float) -> None:
        self.fmu.doStep(self.time, h)
        self.time += h

    @property
    def motion(self) -> np.ndarray:
        return np.array([self.get(*(f"body[{k}].{name}" for name in COORDINATES)) for k in range(1, 8)])

    @property
    def totals(self) -> np.ndarray:
        names = ("energy", "worn_volume", "T_gamma")
        return np.array([self.get(*(f"wheel[{k}].total.{name}" for name in names)) for k in range(1, 9)])

    @property
    def forces(self) -> np.ndarray:
        return np.array([self.get(*(f"wheel[{k}].force.{axis}" for axis in "xyz")) for k in range(1, 9)])


def forces_of(whole: Simulation) -> np.ndarray:
    wheels = whole.wheels
    return np.stack((wheels["longitudinal"], wheels["lateral"], -wheels["vertical"]), axis=1)


@pytest.mark.parametrize(
    ("options", "place", "force"),
    [
        (replace(FAST, pace=1), 1e-13, 1e-6),
        (ContactOptions(pace=1), 1e-13, 1e-6),
        (FAST, 1e-13, 1e-6),
        (ContactOptions(), 1e-13, 1e-6),
    ],
    ids=["analyn", "default", "analyn, paced", "default, paced"],
)
def test_the_fmu_gives_the_run_of_the_one_kernel(folder, options, place, force):
    """Communication steps of ten steps of the integration. The start amid irregularities lifts wheels."""
    whole, fmu = one_kernel(options), Slave(folder, options)
    many = MANY if options.pace == 1 else 4 * MANY  # until the vehicle is calm enough
    for _ in range(many // 10):
        whole.advance(STEP, 10)
        fmu.step(10 * STEP)
    if options.pace > 1:
        assert whole.wheel_arrays.last.solutions.mean() < 0.9 * many
    assert np.abs(np.diff(whole.wheels["vertical"])).max() > 100.0  # the wheels differ
    assert np.abs(fmu.motion - whole.state.q).max() <= place
    assert np.abs(fmu.forces - forces_of(whole)).max() <= force
    assert fmu.get("energy.residual")[0] == pytest.approx(whole.state.books[Book.RESIDUAL], abs=1e-6)
    assert fmu.get("energy.dissipated")[0] == pytest.approx(whole.state.books[Book.DISSIPATED], rel=1e-9)
    assert fmu.get("distance")[0] == pytest.approx(whole.distance, abs=1e-9)
    mirror = np.tile([-1.0, 1.0], 4)  # Y is positive outwards
    assert fmu.get(*(f"wheel[{k}].Y" for k in range(1, 9))) == pytest.approx(mirror * whole.wheels["lateral"], abs=1e-6)
    assert fmu.get(*(f"wheel[{k}].Q" for k in range(1, 9))) == pytest.approx(whole.wheels["vertical"], abs=1e-6)


def test_totals_add_up_what_the_wheels_do(folder):
    fmu = Slave(folder, start=-12.0)
    summed = 0.0
    for _ in range(20):
        fmu.step(STEP)
        summed += fmu.get("wheel[1].damage.T_gamma")[0] * 15.0 * STEP
    assert summed > 0.0
    assert fmu.get("wheel[1].total.T_gamma")[0] == pytest.approx(
        summed, rel=0.02
    )  # the speed of the axle itself differs
    assert fmu.get("wheel[1].total.energy")[0] > 0.0
    assert fmu.get("wheel[1].total.worn_volume")[0] > 0.0


def test_a_saved_state_continues_to_the_same_bits(folder):
    """In the same instance and, serialised, in another one. Step by step, so between two solutions of a contact too."""
    fmu = Slave(folder)
    fmu.step(40 * STEP)
    for _ in range(4):
        fmu.step(STEP)
        state, at = fmu.fmu.getFMUState(), fmu.time
        fmu.step(10 * STEP)
        there = fmu.motion, fmu.forces, fmu.totals
        other = Slave(folder)
        bytes_of_state = fmu.fmu.serializeFMUState(state)
        for one, its in ((fmu, state), (other, other.fmu.deserializeFMUState(bytes_of_state))):
            one.fmu.setFMUState(its)
            one.time = at
            one.step(10 * STEP)
            for found, expected in zip((one.motion, one.forces, one.totals), there, strict=True):
                assert np.array_equal(found, expected)
        fmu.fmu.setFMUState(state)
        fmu.time = at


def test_totals_do_not_depend_on_the_pace(folder):
    found = []
    for pace in (1, 4):
        fmu = Slave(folder, replace(FAST, pace=pace))
        fmu.step(400 * STEP)
        found.append(fmu.totals)
    each, paced = found
    assert (each[:, 0] > 0.0).all()
    assert np.abs(paced / each - 1.0).max() < 0.01


def test_the_fmu_brakes_to_rest_stands_and_rolls_back(folder):
    fmu = Slave(folder, start=-12.0, reference_speed=10.0, speed=3.0)
    speeds = np.concatenate((np.linspace(3.0, 0.0, 150), np.zeros(50), np.linspace(0.0, -2.0, 100)))
    places, forces, energies = [], [], []
    for speed in speeds:
        fmu.set("speed", speed)
        fmu.step(0.01)
        places.append(fmu.get("distance")[0])
        forces.append(fmu.forces)
        energies.append(fmu.totals[:, 0])
    assert places[150] == pytest.approx(places[199], abs=1e-9)
    assert places[-1] < places[199] - 0.5
    assert np.abs(np.array(forces)[:, :, 2] / -54.5e3 - 1.0).max() < 0.6  # the bogies pitch
    assert (np.diff(energies, axis=0) > -1e-9).all()  # friction spends, whatever the direction


def test_the_end_of_the_track_is_no_step(folder):
    """The track of the scenario ends at 240 m; 40 m more are kept for the bodies ahead."""
    fmu = Slave(folder, start=239.9)
    with pytest.raises(FMICallException):
        fmu.step(0.05)
    with pytest.raises(FMICallException):
        Slave(folder, start=-80.0).step(STEP)


def test_eight_pairs_and_the_open_vehicle_give_the_run_of_the_one_kernel(folder):
    whole = one_kernel(ContactOptions(pace=1), start=-12.0)
    with VehicleSystem(folder / "coupled_vehicle.ssp") as system:
        for _ in range(MANY):
            system.step(STEP)
            whole.advance(STEP)
        names = [[f"body[{k}].{name}" for name in COORDINATES] for k in range(1, 8)]
        found = np.array([[system.get("vehicle", name) for name in row] for row in names])
        lateral = np.array([system.get(name, "force.y") for name in system.fmus if name != "vehicle"])
    assert np.abs(found - whole.state.q).max() < 1e-13
    assert np.abs(lateral - whole.wheels["lateral"]).max() < 1e-6


def test_the_system_conforms_to_the_schema(folder, tmp_path):
    path = folder / "coupled_vehicle.ssp"
    with SSP(str(path), mode="r") as package, package.system_structure as ssd:
        ssd.check_compliance(ssd.schemas[ssd.identifier], ssd.namespaces)
        assert not ssd.check_connections()
        assert len(ssd.connections()) == 8 * (17 + 6)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path)
    for component in read_ssd(str(path)).system.elements:
        variables = {v.name: v for v in fmpy.read_model_description(str(tmp_path / component.source)).modelVariables}
        for connector in component.connectors:
            assert variables[connector.name].causality == connector.kind


@pytest.mark.filterwarnings("ignore")
def test_a_vehicle_that_nothing_carries_is_lost_and_not_simulated_for_ever(folder):
    """Before, OK was the answer to the end, with coordinates of 1e34 m. It falls 5 m in one second."""
    path = str(folder / "OpenVehicle.fmu")
    rows = fmpy.simulate_fmu(
        path, stop_time=5.0, step_size=1e-3, output_interval=1e-3, output=["body[1].z"], timeout=60
    )
    assert rows["time"][-1] == pytest.approx((2.0 * 5.0 / 9.81) ** 0.5, abs=0.02)
    assert np.abs(rows["body[1].z"]).max() <= 5.0
    described = fmpy.read_model_description(path)
    wheels = [v for v in described.modelVariables if v.causality == "output" and v.name.startswith("wheel[")]
    assert all(v.nominal is not None for v in wheels)
