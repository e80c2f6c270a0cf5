"""The coupled system of a wheelset and two contacts, as Python objects and as FMUs (readme of `contact_models.wheelset`)."""

import itertools
import math
from contextlib import ExitStack
from typing import get_args

import numpy as np
import pytest
from thesis_case import THESIS

import contact
from contact import STEEL, Creepage, Separation, hertz, solve
from contact.errors import ContactError
from contact_models.wheelset import master
from contact_models.wheelset.components import DirectWheelset, LinearContact, direct
from contact_models.wheelset.fmu import FmuComponent
from contact_models.wheelset.linear import LinearWheelset
from contact_models.wheelset.model import WheelsetModel
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CONTACT_PORTS, MOTION, REACTION, SIDES, WHEELSET_PORTS
from contact_models.wheelset.stability import critical_speed, growth, state_matrix
from reference import stability
from tests.models.rolling import RAIL_RADIUS, on_cones


def coupled(step: float, duration: float, parameters: WheelsetParameters, **options) -> master.History:
    wheelset, contacts = direct(parameters)
    return master.run(wheelset, contacts, speed=parameters.speed, step=step, duration=duration, **options)


def amplitude(history: master.History, start: float, end: float) -> float:
    """Return the largest lateral displacement [m] between two times."""
    window = (history["time"] >= start) & (history["time"] < end)
    return float(np.abs(history["lateral"][window]).max())


# Klingel's motion


@pytest.mark.parametrize(("conicity", "speed"), [(0.025, 10.0), (0.05, 20.0)])
def test_wavelength_on_cones_is_klingels(conicity, speed):
    p = on_cones(conicity, speed=speed, lateral=1e-3, lateral_stiffness=0.0, yaw_stiffness=0.0)
    _, half_base, radius, _ = WheelsetModel(p).frame("right")
    expected = 2.0 * math.pi * math.sqrt(radius * half_base / conicity)
    history = coupled(5e-4, 0.85 * expected / speed, p)
    x, y = history.distance, history["lateral"]
    k = np.flatnonzero(np.diff(np.sign(y)))
    crossings = x[k] - y[k] * (x[k + 1] - x[k]) / (y[k + 1] - y[k])
    assert crossings.size == 2
    assert 2.0 * (crossings[1] - crossings[0]) == pytest.approx(expected, rel=0.02)


# Stability


def test_state_matrix_holds_kalkers_coefficients():
    """Lateral damping 2 C22 G c²/V and yaw damping 2 C11 G c² b0²/V of cones (theory.md 9.4).

    The tolerance is 5 %, since the cone's contact angle causes spin, and a lateral motion also rolls the wheelset.
    """
    p = on_cones(0.025, speed=30.0)
    A = state_matrix(p)
    _, b0, r, angle = WheelsetModel(p).frame("right")
    load = 0.5 * p.axle_load / math.cos(angle)
    separation = Separation.hertzian(0.5 * math.cos(angle) / r, 0.5 / RAIL_RADIUS)
    small = 1e-6  # slope of the creep forces at the origin
    f11 = -solve(separation, Creepage(small), load=load).Fx / small
    f22 = -solve(separation, Creepage(lateral=small), load=load).Fy / small
    ellipse = hertz(0.5 * math.cos(angle) / r, 0.5 / RAIL_RADIUS, load=load)
    assert f11 > 3.0 * STEEL.shear_modulus * ellipse.a * ellipse.b  # C11 of Kalker's table is above 3
    assert -A[2, 2] * p.mass == pytest.approx(2.0 * f22 / p.speed, rel=0.05)
    assert -A[3, 3] * p.yaw_inertia == pytest.approx(2.0 * f11 * b0**2 / p.speed, rel=0.05)


def test_critical_speed_of_cones_is_that_of_the_linear_theory():
    """theory.md 9.4 neglects gravitational stiffness and spin. This costs 10 % here, since the suspension is stiffer."""
    p = on_cones(0.05)
    _, b0, r, _ = WheelsetModel(p).frame("right")
    linear = LinearWheelset(
        mass=p.mass,
        yaw_inertia=p.yaw_inertia,
        half_base=b0,
        radius=r,
        conicity=0.05,
        lateral_stiffness=p.lateral_stiffness,
        yaw_stiffness=p.yaw_stiffness,
        creep_coefficient=9e6,
    )
    assert critical_speed(p) == pytest.approx(linear.critical_speed, rel=0.1)


def test_offset_decays_below_the_critical_speed():
    """S1002 on 60E1."""
    p = WheelsetParameters(speed=18.0, lateral=3e-3)
    assert growth(p) < 0.0
    assert p.speed < critical_speed(p)
    history = coupled(5e-4, 2.5, p)
    assert amplitude(history, 2.0, 2.5) < 0.6 * amplitude(history, 0.0, 0.5)
    assert history["right.contact.angle"].min() > math.radians(-6.0)


@pytest.fixture(scope="module")
def hunting() -> master.History:
    """S1002 on 60E1 above the critical speed, at 1 ms."""
    return coupled(1e-3, 4.0, WheelsetParameters(speed=28.0, lateral=5e-3))


def test_small_offset_grows_above_the_critical_speed():
    p = WheelsetParameters(speed=28.0, lateral=1e-3)
    assert p.speed > critical_speed(p)
    assert growth(p) > 0.0
    history = coupled(1e-3, 2.0, p)
    assert amplitude(history, 1.5, 2.0) > 1.1 * amplitude(history, 0.0, 0.5)


def test_growth_ends_in_a_bounded_limit_cycle_with_flange_contact(hunting):
    assert amplitude(hunting, 3.0, 4.0) > 1.1 * 5e-3
    assert amplitude(hunting, 3.0, 3.5) == pytest.approx(amplitude(hunting, 3.5, 4.0), rel=0.01)
    # both wheels reach the flange root in turn
    assert hunting["right.contact.angle"].min() < math.radians(-25.0)
    assert hunting["left.contact.angle"].max() > math.radians(25.0)
    assert hunting["lateral"].max() < 6.5e-3
    for side in SIDES:
        assert hunting[f"{side}.load.normal_force"].min() > 0.0
        force = np.hypot(hunting[f"{side}.force.x"], hunting[f"{side}.force.y"])
        assert (force <= 0.3 * hunting[f"{side}.load.normal_force"] * (1.0 + 1e-9)).all()


# Energy


def test_friction_takes_the_energy_that_leaves_the_wheelset(hunting):
    """They agree within 1 % in a limit cycle with flange contact, at 1 ms. Stored elastic energy is included."""
    dissipated = float(hunting.creep_power[1:].sum() * hunting.step)
    assert dissipated > 500.0
    assert np.abs(hunting.power_residual).max() < 0.01 * dissipated
    # the power of the slip fields of the contacts is that of forces and creepages
    assert float(hunting.friction_power[1:].sum() * hunting.step) == pytest.approx(dissipated, rel=0.02)
    assert (hunting.friction_power >= 0.0).all()


def test_energy_balance_of_the_wheelset_closes(hunting):
    """Readme (10): its energy changes by the work of drive, dampers and contacts."""
    held, interface = hunting["energy.mechanical"], hunting["energy.interface"]
    defect = held - held[0] + interface - hunting["energy.drive"] + hunting["energy.damper"]
    assert np.abs(defect).max() < 2e-3 * np.abs(interface).max()


def test_on_cones_the_power_balance_is_exact_but_for_the_step():
    """Hertzian contact has no error of geometry or stored energy: 1e-4 of the dissipated energy after the start."""
    history = coupled(2.5e-4, 0.6, on_cones(0.05, speed=40.0, lateral=4e-3))
    settled = history["time"] > 0.1
    dissipated = float(history.creep_power[settled].sum() * history.step)
    assert dissipated > 0.2
    assert np.ptp(history.power_residual[settled]) < 1e-3 * dissipated


# Order of the coupling


def differences(scheme: str, steps: tuple[float, ...], duration: float = 0.15) -> list[np.ndarray]:
    """Return the largest differences of lateral [m], yaw [rad] and power residual [J] between successive step sizes."""
    runs = []
    for h in steps:
        history = coupled(h, duration, WheelsetParameters(lateral=3e-3), scheme=scheme)
        quantities = np.stack((history["lateral"], history["yaw"], history.power_residual))
        runs.append(quantities[:, :: round(max(steps) / h)])
    return [np.abs(a - b)[:, 2:].max(axis=1) for a, b in itertools.pairwise(runs)]


@pytest.mark.parametrize("scheme", ["gauss_seidel", "jacobi"])
def test_half_the_step_is_half_the_error(scheme):
    coarse, fine = differences(scheme, (5e-4, 2.5e-4, 1.25e-4))
    assert np.log2(coarse[:2] / fine[:2]) == pytest.approx(1.0, abs=0.12)


@pytest.mark.parametrize("scheme", ["gauss_seidel", "iterated"])
def test_power_residual_of_the_coupling_shrinks_with_the_step(scheme):
    """On real profiles a part remains, since a non-Hertzian contact stores not exactly 2/5 N times approach."""
    coarse, fine = differences(scheme, (2.5e-4, 1.25e-4, 0.625e-4))
    assert fine[2] < 0.8 * coarse[2]


def test_iterated_steps_are_of_second_order():
    """The order is slightly less, since the load follows the lateral force of the step before (a small first order part)."""
    coarse, fine = differences("iterated", (2e-3, 1e-3, 5e-4))
    assert (np.log2(coarse[:2] / fine[:2]) > 1.7).all()
    (gauss_seidel,) = differences("gauss_seidel", (2.5e-4, 1.25e-4))
    (iterated,) = differences("iterated", (2.5e-4, 1.25e-4))
    assert (iterated[:2] < 0.05 * gauss_seidel[:2]).all()


# Stability of the coupling


@pytest.mark.parametrize("scheme", ["jacobi", "gauss_seidel"])
def test_largest_stable_step_is_that_of_the_axles_spin(scheme):
    """h < m/c (Jacobi) or 2 m/c (Gauss–Seidel) with m = I_s/r², c = 2 f11/V. This is shorter than for lateral motion."""
    lateral, yaw, spin = stability.modes(WheelsetParameters(speed=10.0))
    h, grows = stability.measured(10.0, scheme)
    assert grows == "spin"
    assert h == pytest.approx(stability.EXPLICIT[scheme] * spin.mass / spin.damping, rel=0.05)
    assert h < 0.3 * min(lateral.mass / lateral.damping, yaw.mass / yaw.damping) * stability.EXPLICIT[scheme]


def test_iterated_scheme_is_stable_where_the_others_are_not():
    """At 5 m/s it runs at five times the limit of Gauss–Seidel, and the power balance closes."""
    p = WheelsetParameters(speed=5.0, lateral=2e-3)
    histories = {s: coupled(1e-3, 0.2, p, scheme=s) for s in get_args(master.Scheme)}
    swing = {s: float(np.ptp(h["right.force.x"][-50:])) for s, h in histories.items()}
    assert swing["iterated"] < 200.0
    assert min(swing["jacobi"], swing["gauss_seidel"]) > 20e3  # alternates at the limit of friction
    history = histories["iterated"]
    assert history.rounds.max() <= master.MOST_ROUNDS
    assert np.abs(history.power_residual).max() < 0.1 * np.abs(histories["gauss_seidel"].power_residual).max()


def test_jacobi_runs_with_the_answers_to_the_step_before():
    p = WheelsetParameters(lateral=3e-3)
    history = coupled(1e-4, 1e-3, p, scheme="jacobi")
    wheelset, _ = direct(p)
    for k in range(history["time"].size):
        assert np.array_equal(wheelset.read("motion"), history.values[k, 1 : 1 + len(MOTION)])
        for side in SIDES:
            wheelset.write(f"{side}.reaction", [history[f"{side}.{name}"][max(k - 1, 0)] for name in REACTION])
        wheelset.step(k * 1e-4, 1e-4)


# FMUs


@pytest.mark.parametrize("packaging", ["python", "native"])
@pytest.mark.parametrize("scheme", get_args(master.Scheme))
def test_fmus_and_python_objects_give_the_same_result(fmus, request, scheme, packaging):
    """They agree to round-off through FMI's C interface with saved and restored states. The wheel reaches the flange root."""
    contact_fmu = fmus / "WheelRailContact.fmu" if packaging == "python" else request.getfixturevalue("native")
    p = WheelsetParameters(speed=28.0, lateral=5.5e-3, yaw=2e-3, lateral_damping=1e3)
    start = {"speed": p.speed, "initial.lateral": p.lateral, "initial.yaw": p.yaw, "suspension.lateral_damping": 1e3}
    options = {"speed": p.speed, "step": 1e-3, "duration": 0.06, "scheme": scheme}
    with ExitStack() as stack:
        wheelset = stack.enter_context(FmuComponent(fmus / "Wheelset.fmu", WHEELSET_PORTS, start))
        contacts = [
            stack.enter_context(FmuComponent(contact_fmu, CONTACT_PORTS, {"speed": p.speed, **THESIS})) for _ in SIDES
        ]
        through_fmi = master.run(wheelset, contacts, **options)
    wheelset, contacts = direct(p, **contact.THESIS)
    directly = master.run(wheelset, contacts, **options)
    assert through_fmi["right.contact.angle"].min() < math.radians(-15.0)
    for column in master.COLUMNS:
        scale = np.abs(directly[column]).max()
        assert through_fmi[column] == pytest.approx(directly[column], abs=1e-12 * scale), column
    assert np.array_equal(through_fmi.problems, directly.problems)


def test_irregular_track_reaches_the_contacts_and_is_followed():
    """The wheelset follows a bend of the track over 5 m."""
    p = WheelsetParameters(speed=20.0, lateral=0.0, lateral_stiffness=0.0, yaw_stiffness=0.0)
    wheelset = DirectWheelset(WheelsetModel(p))
    contacts = [LinearContact(8e6) for _ in SIDES]

    def bend(time):
        return (1e-3 * min(time / 0.25, 1.0), 1e-3 / 5.0 if time < 0.25 else 0.0)

    history = master.run(wheelset, contacts, speed=p.speed, step=5e-4, duration=0.6, irregularity=bend)
    assert history["lateral"][history["time"] > 0.15].min() > 0.0
    assert history["lateral"].max() == pytest.approx(1e-3, rel=0.6)


def test_unknown_scheme_and_empty_run_are_refused():
    wheelset, contacts = direct(WheelsetParameters())
    with pytest.raises(ContactError, match="scheme = 'euler' is none of gauss_seidel, jacobi, iterated"):
        master.run(wheelset, contacts, speed=28.0, step=1e-3, duration=1.0, scheme="euler")
    with pytest.raises(ContactError, match="step = 0"):
        master.run(wheelset, contacts, speed=28.0, step=0.0, duration=1.0)
