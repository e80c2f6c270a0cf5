"""The coupled system of a wheelset and two contacts: its physics, as Python objects and as FMUs."""

import itertools
import math
from contextlib import ExitStack
from typing import get_args

import numpy as np
import pytest

from contact import STEEL, Creepage, Separation, hertz, solve
from contact.errors import ContactError
from contact_models.vehicle import linear
from contact_models.vehicle.coupling import OpenVehicle
from contact_models.vehicle.declared import SIDES
from contact_models.vehicle.kernels.layout import Axis
from contact_models.wheelset import master
from contact_models.wheelset.fmu import Fmu, FmuVehicle, InFmu
from contact_models.wheelset.system import at_start, python_contacts, scenario, simulation
from reference.linear_wheelset import LinearWheelset
from tests.models.rolling import HALF_BASE, RADIUS, RAIL_RADIUS, on_cones

WHEELSET = 1  # number of the body


def coupled(given, lateral: float, step: float, duration: float, **options) -> master.History:
    vehicle = OpenVehicle(simulation(given, lateral))
    return master.run(vehicle, python_contacts(given), step=step, duration=duration, **options)


def amplitude(time: np.ndarray, y: np.ndarray, start: float, end: float) -> float:
    """Return the largest lateral displacement [m] between two times."""
    return float(np.abs(y[(time >= start) & (time < end)]).max())


# Klingel's motion


# Stability


def test_state_matrix_holds_kalkers_coefficients():
    """Lateral damping 2 C22 G c²/V and yaw damping 2 C11 G c² b0²/V of cones (theory.md 9.4), at the spin of their angle."""
    speed, conicity = 30.0, 0.025
    given = on_cones(conicity, speed)
    (axle,), whole = given.vehicle.wheelsets, simulation(given, lateral=0.0)
    A, free = linear.state_matrix(whole), linear.coordinates(whole)
    y, yaw = (len(free) + free.index((WHEELSET, int(axis))) for axis in (Axis.Y, Axis.YAW))
    angle = math.atan(conicity)
    load = float(whole.model.bodies["load"][WHEELSET]) / math.cos(angle)
    curvatures = 0.5 * math.cos(angle) / RADIUS, 0.5 / RAIL_RADIUS
    separation, spin = Separation.hertzian(*curvatures), -math.sin(angle) / RADIUS
    small = 1e-6  # slope of the creep forces at rest

    def slope(axis: int) -> float:
        ends = [Creepage(*(s * small * (k == axis) for k in range(2)), spin) for s in (1.0, -1.0)]
        forces = [(f.Fx, f.Fy)[axis] for f in (solve(separation, each, load=load) for each in ends)]
        return (forces[1] - forces[0]) / (2.0 * small)

    f11, f22 = slope(0), slope(1)
    ellipse = hertz(*curvatures, load=load)
    assert f11 > 3.0 * STEEL.shear_modulus * ellipse.a * ellipse.b  # C11 of Kalker's table is above 3
    assert -A[y, y] * axle.mass == pytest.approx(2.0 * f22 / speed, rel=0.02)
    assert -A[yaw, yaw] * axle.inertia[2] == pytest.approx(2.0 * f11 * HALF_BASE**2 / speed, rel=0.02)


def test_critical_speed_of_cones_is_that_of_the_linear_theory():
    """theory.md 9.4 neglects gravitational stiffness and spin. This costs 10 % here, since the suspension is stiffer."""
    v = on_cones(0.05, 20.0).vehicle
    (axle,), (spring,) = v.wheelsets, v.springs
    theory = LinearWheelset(
        mass=axle.mass,
        yaw_inertia=axle.inertia[2],
        half_base=HALF_BASE,
        radius=RADIUS,
        conicity=0.05,
        lateral_stiffness=2.0 * spring.stiffness[1],
        yaw_stiffness=2.0 * spring.stiffness[0] * spring.at[1] ** 2,
        creep_coefficient=9e6,
    )
    found = linear.critical_speed(lambda speed: simulation(on_cones(0.05, speed), lateral=0.0))
    assert found == pytest.approx(theory.critical_speed, rel=0.1)


@pytest.fixture(scope="module")
def hunting() -> master.History:
    """S1002 on 60E1 above the critical speed, as Python objects."""
    return coupled(scenario(32.0), 5e-3, 2e-4, 1.2)


def test_growth_ends_in_a_bounded_limit_cycle_with_flange_contact(hunting):
    time, y = hunting["time"], hunting["pose.y"]
    assert amplitude(time, y, 0.6, 0.9) > 1.3 * 5e-3
    assert amplitude(time, y, 0.6, 0.9) == pytest.approx(amplitude(time, y, 0.9, 1.2), rel=0.01)
    # both wheels reach the flange root in turn
    assert hunting["right.angle"].min() < math.radians(-25.0)
    assert hunting["left.angle"].max() > math.radians(25.0)
    assert np.abs(y).max() < 8e-3
    for side in SIDES:
        creep = np.hypot(hunting[f"{side}.force.x"], 0.0)
        assert (creep <= 0.3 * hunting[f"{side}.normal"] * (1.0 + 1e-9)).all()


# Energy


def test_friction_takes_the_energy_that_leaves_wheelset_and_rails(hunting):
    """They agree within 1 % in a limit cycle with flange contact. Stored elastic energy is included."""
    dissipated = float(hunting.creep_power.sum() * hunting.step)
    assert dissipated > 200.0
    assert np.abs(hunting.power_residual).max() < 0.01 * dissipated
    # the power of the slip fields of the contacts is that of forces and creepages
    assert float(hunting.friction_power.sum() * hunting.step) == pytest.approx(dissipated, rel=0.02)
    assert (hunting.friction_power >= 0.0).all()


# Order of the coupling


def differences(steps: tuple[float, ...], duration: float, **options) -> list[np.ndarray]:
    """Return the largest differences of lateral position [m] and yaw [rad] between successive step sizes."""
    runs = []
    for h in steps:
        history = coupled(scenario(), 3e-3, h, duration, **options)
        runs.append(np.stack((history["pose.y"], history["pose.yaw"]))[:, :: round(max(steps) / h)])
    return [np.abs(a - b).max(axis=1) for a, b in itertools.pairwise(runs)]


@pytest.mark.parametrize(
    ("scheme", "steps", "duration"), [("gauss_seidel", (4e-4, 2e-4, 1e-4), 0.1), ("jacobi", (4e-5, 2e-5, 1e-5), 0.02)]
)
def test_half_the_step_is_half_the_error(scheme, steps, duration):
    """Of first order: velocities lie half a step before the positions at the start, and answers of Jacobi are late."""
    coarse, fine = differences(steps, duration, scheme=scheme)
    assert np.log2(coarse / fine) == pytest.approx(1.0, abs=0.2)


# FMUs


@pytest.mark.parametrize("scheme", get_args(master.Scheme))
def test_fmus_and_python_objects_give_the_same_result(native, scheme):
    """They have the same bits through FMI's C interface. The wheel reaches the flange root."""
    given, step = scenario(), 2e-4 if scheme == "gauss_seidel" else 2e-5
    options = {"step": step, "duration": 150 * step, "scheme": scheme}
    with ExitStack() as stack:
        vehicle = FmuVehicle(
            stack.enter_context(Fmu(native.with_name("Wheelset.fmu"), at_start(simulation(given, 5.5e-3))))
        )
        contacts = [stack.enter_context(InFmu(native.with_name("WheelRailPair.fmu"), side)) for side in SIDES]
        through_fmi = master.run(vehicle, contacts, **options)
    directly = coupled(given, 5.5e-3, **options)
    assert through_fmi["right.angle"].min() < math.radians(-15.0)
    for column in master.COLUMNS:
        scale = np.abs(directly[column]).max()
        assert through_fmi[column] == pytest.approx(directly[column], abs=1e-12 * scale), column


def test_fewer_contacts_than_wheels_are_refused():
    given = scenario()
    vehicle, contacts = OpenVehicle(simulation(given)), python_contacts(given)
    with pytest.raises(ContactError, match="1 contacts for 2 wheels"):
        master.run(vehicle, contacts[:1], step=2e-4, duration=1.0)
