"""Kernels of the wheelset: equilibrium, kinematics and power are consistent."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from contact_models.wheelset import dynamics as d

W, V, R0 = 1.1e5, 30.0, 0.46


@pytest.fixture
def pose():
    """Return frames, state, axle direction and forces of a moving wheelset. Nothing is small or symmetric."""
    frames = np.array([[0.0, 0.748, 0.461, -0.35], [0.0, -0.752, 0.459, 0.06]])
    state = np.array([0.004, 0.006, 0.11, -0.4, V / R0 + 0.3])
    axle = np.array([-0.006, 0.99998, 0.003])
    axle /= np.linalg.norm(axle)
    for frame in frames:
        frame[d.FrameRow.X] = d.locus(frame, axle)
    forces = np.array([[-4e3, 9e3, 25.0], [5e3, -3e3, -12.0]])
    return frames, state, axle, forces


def axes(frame):
    """Return the lateral and normal unit vectors of a contact frame in track axes (normal from wheel into rail)."""
    c, s = np.cos(frame[d.FrameRow.ANGLE]), np.sin(frame[d.FrameRow.ANGLE])
    return np.array([0.0, c, s]), np.array([0.0, -s, c])


def force(frame, row, load):
    ey, ez = axes(frame)
    return np.array([row[d.Force.FX], 0.0, 0.0]) + row[d.Force.FY] * ey - load * ez


def solved(frames, forces):
    loads = np.empty(2)
    d.normal_loads(frames, forces, W, loads)
    return loads


def test_normal_loads_balance_weight_and_roll_moment(pose):
    frames, _, _, forces = pose
    loads = solved(frames, forces)
    total = sum(force(f, q, n) for f, q, n in zip(frames, forces, loads, strict=True))
    moment = sum(np.cross(f[:3], force(f, q, n)) for f, q, n in zip(frames, forces, loads, strict=True))
    assert total[2] + W == pytest.approx(0.0, abs=1e-9 * W)
    assert moment[0] == pytest.approx(0.0, abs=1e-9 * W)


def test_a_lifted_wheel_carries_nothing_and_the_other_everything(pose):
    frames, _, _, forces = pose
    forces[:] = [[0.0, 1.5e5, 0.0], [0.0, 0.0, 0.0]]
    loads = solved(frames, forces)
    assert loads.min() == 0.0
    total = sum(force(f, q, n) for f, q, n in zip(frames, forces, loads, strict=True))
    assert total[2] + W == pytest.approx(0.0, abs=1e-9 * W)


def rigid_velocity(frame, state, axle, z_rate, roll_rate):
    turning = np.array([roll_rate, 0.0, state[d.StateRow.YAW_RATE]]) - state[d.StateRow.SPIN] * axle
    return np.array([V, state[d.StateRow.LATERAL_VELOCITY], z_rate]) + np.cross(turning, frame[:3]), turning


def test_both_contact_points_stay_on_the_rails(pose):
    frames, state, axle, _ = pose
    z_rate, roll_rate = d.follow(frames, state)
    for frame in frames:
        velocity, _ = rigid_velocity(frame, state, axle, z_rate, roll_rate)
        assert velocity @ axes(frame)[1] == pytest.approx(0.0, abs=1e-12 * V)


def test_power_of_the_generalised_forces_is_the_power_at_the_contacts(pose):
    """Readme (9): normal loads do work only against the weight, so the rest is friction."""
    frames, state, axle, forces = pose
    loads = solved(frames, forces)
    z_rate, roll_rate = d.follow(frames, state)
    at_contacts = 0.0
    for frame, row, load in zip(frames, forces, loads, strict=True):
        velocity, turning = rigid_velocity(frame, state, axle, z_rate, roll_rate)
        at_contacts += force(frame, row, load) @ velocity + row[d.Force.MZ] * (turning @ axes(frame)[1])
    Q = np.empty(4)
    d.resultants(frames, forces, loads, axle, Q)
    generalised = (
        Q[0] * state[d.StateRow.LATERAL_VELOCITY]
        + Q[1] * state[d.StateRow.YAW_RATE]
        + Q[2] * state[d.StateRow.SPIN]
        + Q[3] * V
    )
    assert generalised - W * z_rate == pytest.approx(at_contacts, rel=1e-11)


def constants(**changes):
    values = dict(
        zip(
            ("MASS", "YAW_INERTIA", "SPIN_INERTIA", "LATERAL_STIFFNESS", "YAW_STIFFNESS", "LATERAL_DAMPING"),
            (1250.0, 700.0, 110.0, 2e5, 3e5, 3e4),
            strict=True,
        )
    )
    values |= {"YAW_DAMPING": 1e4, "AXLE_LOAD": W, "SPEED": V} | changes
    out = np.zeros(d.N_CONSTANTS)
    for name, value in values.items():
        out[d.Constant[name]] = value
    return out


def advance(state, c, Q, h, steps):
    energy = np.zeros(d.N_ENERGY)
    for _ in range(steps):
        d.kick(state, c, Q, h / 2, energy)
        d.drift(state, h)
        d.kick(state, c, Q, h / 2, energy)
    return state, energy


def test_integrator_converges_with_second_order_to_the_exact_motion():
    c, Q, T = constants(), np.array([900.0, -400.0, 15.0, 0.0]), 0.3
    start = np.array([0.005, -0.004, 0.0, 0.1, V / R0])

    def rhs(_, s):
        ddy = (Q[0] - c[d.Constant.LATERAL_STIFFNESS] * s[0] - c[d.Constant.LATERAL_DAMPING] * s[2]) / c[
            d.Constant.MASS
        ]
        ddpsi = (Q[1] - c[d.Constant.YAW_STIFFNESS] * s[1] - c[d.Constant.YAW_DAMPING] * s[3]) / c[
            d.Constant.YAW_INERTIA
        ]
        return [s[2], s[3], ddy, ddpsi, Q[2] / c[d.Constant.SPIN_INERTIA]]

    exact = solve_ivp(rhs, (0.0, T), start, rtol=1e-11, atol=1e-14).y[:, -1]
    errors = [abs(advance(start.copy(), c, Q, T / n, n)[0] - exact)[:4].max() for n in (50, 100, 200)]
    assert np.log2(errors[:-1] / np.array(errors[1:])) == pytest.approx(2.0, abs=0.05)
    assert advance(start.copy(), c, Q, T / 50, 50)[0][d.StateRow.SPIN] == pytest.approx(
        exact[d.StateRow.SPIN], rel=1e-12
    )


def test_energy_balance_is_complete():
    """The energy of the bodies changes by drive energy minus energy through the contacts and dampers."""
    c, Q = constants(), np.array([900.0, -400.0, 15.0, -700.0])
    start = np.array([0.005, -0.004, 0.0, 0.1, V / R0])

    def held(s):
        kinetic = (
            c[d.Constant.MASS] * s[2] ** 2
            + c[d.Constant.YAW_INERTIA] * s[3] ** 2
            + c[d.Constant.SPIN_INERTIA] * s[4] ** 2
        )
        return 0.5 * (kinetic + c[d.Constant.LATERAL_STIFFNESS] * s[0] ** 2 + c[d.Constant.YAW_STIFFNESS] * s[1] ** 2)

    defects = []
    for n in (200, 400):
        end, energy = advance(start.copy(), c, Q, 0.4 / n, n)
        change = held(end) - held(start)
        defects.append(abs(change + energy[d.Energy.INTERFACE] - energy[d.Energy.DRIVE] + energy[d.Energy.DAMPER]))
    assert defects[0] < 1e-2
    assert defects[1] == pytest.approx(defects[0] / 4.0, rel=0.1)
    assert energy[d.Energy.DAMPER] > 1.0


@pytest.mark.parametrize("damping", [0.0, 1e-3, 1.25e3, 2e7])
def test_kick_is_exact_for_any_damping(damping):
    c, Q, h = constants(LATERAL_DAMPING=damping, LATERAL_STIFFNESS=0.0), np.array([900.0, 0.0, 0.0, 0.0]), 1e-3
    state = np.array([0.0, 0.0, 0.2, 0.0, V / R0])
    d.kick(state, c, Q, h, np.zeros(d.N_ENERGY))
    exact = solve_ivp(
        lambda _, v: (900.0 - damping * v) / 1250.0, (0.0, h), [0.2], rtol=1e-12, atol=1e-15, method="LSODA"
    )
    assert state[d.StateRow.LATERAL_VELOCITY] == pytest.approx(exact.y[0, -1], rel=1e-9)
