"""The FMUs of vehicles: with contacts, and without them in coupled_vehicle.ssp. Both give the run of the one kernel."""

from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmu_instance import DISCARD, Instance, goes_on, refused

from contact.friction import Friction
from contact_models.runs import scenario
from contact_models.vehicle.course import lay
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.simulation import ContactOptions, Simulation
from examples.coupled_vehicle.system import VehicleSystem
from reference.native import SCENARIO

STEP, START, MANY = 2e-4, 30.0, 100
FAST = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12)
COORDINATES = ("x", "y", "z", "roll", "pitch", "yaw")


def one_kernel(
    options: ContactOptions = FAST, start: float = START, path: Path = SCENARIO, friction: Friction | None = None
) -> Simulation:
    given = scenario.read(path)
    d = given.declared
    rows = lay(d.track, d.length, given.speed, (d.seed,), d.recording.settling)
    return Simulation(given.vehicle, rows, given.wheel, given.rail, friction or d.friction, options, start=start)


@pytest.fixture
def vehicle(native_vehicles, unzipped, freed):
    """Return a function that instantiates the FMU `Vehicle` with the options of a contact."""

    def vehicle(options: ContactOptions = FAST, start: float = START, **parameters: object) -> Instance:
        fmu = freed(Instance(unzipped(native_vehicles / "Vehicle.fmu")))
        for name in ("method.normal", "method.tangential"):
            items = {item.name: int(item.value) for item in fmu.variables[name].declaredType.items}
            fmu.update({name: items[getattr(options, name.split(".")[1])]})
        fmu.update({f"resolution.{name}": getattr(options, name) for name in ("n_strips", "n_elements", "pace")})
        fmu.update({"initial.distance": start, "resolution.step": STEP, "reference_speed": options.reference_speed})
        fmu.update(parameters)
        return fmu.initialize()

    return vehicle


def of_wheels(fmu: Instance, *names: str) -> np.ndarray:
    """Return outputs of the eight wheels, one row for each."""
    return np.array([list(fmu.read(f"wheel[{k}].{name}" for name in names).values()) for k in range(1, 9)])


def totals(fmu: Instance) -> np.ndarray:
    return of_wheels(fmu, "total.energy", "total.worn_volume", "total.T_gamma")


@pytest.mark.parametrize("options", [FAST, ContactOptions()], ids=["analyn", "default"])
@pytest.mark.parametrize("paced", [False, True])
def test_the_fmu_gives_the_run_of_the_one_kernel(vehicle, options, paced):
    """Communication steps of ten steps of the integration. The start amid irregularities lifts wheels."""
    options = options if paced else replace(options, pace=1)
    whole, fmu = one_kernel(options), vehicle(options)
    many = 40 if paced else 10  # until the vehicle is calm enough
    for _ in range(many):
        whole.advance(STEP, 10)
        fmu.step(h=10 * STEP)
    if paced:
        assert whole.wheel_arrays.last.solutions.mean() < 9 * many
    assert np.abs(np.diff(whole.wheels["vertical"])).max() > 100.0  # the wheels differ
    motion = [list(fmu.read(f"body[{k}].{name}" for name in COORDINATES).values()) for k in range(1, 8)]
    assert np.abs(motion - whole.state.q).max() <= 1e-13
    wheels = whole.wheels
    wanted = np.stack((wheels["longitudinal"], wheels["lateral"], -wheels["vertical"]), axis=1)
    assert np.abs(of_wheels(fmu, "force.x", "force.y", "force.z") - wanted).max() <= 1e-6
    assert fmu["energy.residual"] == pytest.approx(whole.state.books[Book.RESIDUAL], abs=1e-6)
    assert fmu["energy.dissipated"] == pytest.approx(whole.state.books[Book.DISSIPATED], rel=1e-9)
    assert fmu["distance"] == pytest.approx(whole.distance, abs=1e-9)
    mirror = np.tile([-1.0, 1.0], 4)  # Y is positive outwards
    assert of_wheels(fmu, "Y")[:, 0] == pytest.approx(mirror * wheels["lateral"], abs=1e-6)
    assert of_wheels(fmu, "Q")[:, 0] == pytest.approx(wheels["vertical"], abs=1e-6)


def test_the_factors_of_the_track_multiply_both_coefficients_of_a_law(vehicle, native_vehicles):
    """Friction is .7 of the law's on the right and .5 on the left, at every sliding velocity."""
    options, start = replace(FAST, pace=1), 222.0
    law = Friction(0.3, law="linear", kinetic=0.1, half_speed=0.05)
    named = {"friction.law": 2, "friction.kinetic": law.kinetic, "friction.half_speed": law.half_speed}
    whole = one_kernel(options, start, native_vehicles.parent / "vehicle.toml", law)
    fmu = vehicle(options, start, **named)
    whole.advance(STEP, 20)
    fmu.step(h=20 * STEP)
    wanted = np.stack((whole.wheels["longitudinal"], whole.wheels["lateral"]), axis=1)
    assert np.abs(of_wheels(fmu, "force.x", "force.y") - wanted).max() <= 1e-6


def test_the_fmu_brakes_to_rest_stands_and_rolls_back(vehicle):
    fmu, found = vehicle(replace(FAST, reference_speed=10.0), start=-12.0), []
    for speed in (*np.linspace(3.0, 0.0, 150), *np.zeros(50), *np.linspace(0.0, -2.0, 100)):
        fmu.update({"speed": speed})
        fmu.step(h=0.01)
        found.append((fmu["distance"], *totals(fmu)[:, 0], *of_wheels(fmu, "force.z")[:, 0]))
    places, energies, forces = np.split(np.array(found), (1, 9), axis=1)
    assert places[150] == pytest.approx(places[199], abs=1e-9)
    assert places[-1] < places[199] - 0.5
    assert np.abs(forces / -54.5e3 - 1.0).max() < 0.6  # the bogies pitch
    assert (np.diff(energies, axis=0) > -1e-9).all()  # friction spends, whatever the direction


def test_totals_add_up_what_the_wheels_do(vehicle):
    fmu, summed = vehicle(start=-12.0), 0.0
    for _ in range(20):
        fmu.step(h=STEP)
        summed += fmu["wheel[1].damage.T_gamma"] * 15.0 * STEP
    assert fmu["wheel[1].total.T_gamma"] == pytest.approx(summed, rel=0.02)  # the speed of the axle itself differs
    assert (totals(fmu) > 0.0).all()


def test_a_saved_state_continues_to_the_same_bits(vehicle):
    """Step by step, so between two solutions of a contact too."""
    fmu, other = vehicle(), vehicle()
    fmu.step(h=40 * STEP)
    for _ in range(4):
        fmu.step(h=STEP)
        at = fmu.time

        def drive(one, at=at):
            one.step(at, 10 * STEP)
            return one.all("output")

        goes_on(fmu, other, drive)


def test_the_end_of_the_track_is_no_step(vehicle):
    """The track of the scenario ends at 240 m; 40 m more are kept for the bodies ahead."""
    fmu = vehicle(start=239.9)
    refused(lambda: fmu.step(h=0.05), DISCARD)
    refused(lambda: vehicle(start=-80.0), DISCARD)


def test_eight_pairs_and_the_open_vehicle_give_the_run_of_the_one_kernel(native_vehicles):
    whole = one_kernel(ContactOptions(pace=1), start=-12.0)
    with VehicleSystem(native_vehicles / "coupled_vehicle.ssp") as system:
        for _ in range(MANY):
            system.step(STEP)
            whole.advance(STEP)
        names = [[f"body[{k}].{name}" for name in COORDINATES] for k in range(1, 8)]
        found = np.array([[system.get("vehicle", name) for name in row] for row in names])
        lateral = np.array([system.get(name, "force.y") for name in system.fmus if name != "vehicle"])
    assert np.abs(found - whole.state.q).max() < 1e-13
    assert np.abs(lateral - whole.wheels["lateral"]).max() < 1e-6


@pytest.mark.filterwarnings("ignore")
def test_a_vehicle_that_nothing_carries_is_lost_and_not_simulated_for_ever(native_vehicles):
    """Before, OK was the answer to the end, with coordinates of 1e34 m. It falls 5 m in one second."""
    path = str(native_vehicles / "OpenVehicle.fmu")
    rows = fmpy.simulate_fmu(
        path, stop_time=5.0, step_size=1e-3, output_interval=1e-3, output=["body[1].z"], timeout=60
    )
    assert rows["time"][-1] == pytest.approx((2.0 * 5.0 / 9.81) ** 0.5, abs=0.02)
    assert np.abs(rows["body[1].z"]).max() <= 5.0
    described = fmpy.read_model_description(path)
    wheels = [v for v in described.modelVariables if v.causality == "output" and v.name.startswith("wheel[")]
    assert all(v.nominal is not None for v in wheels)
