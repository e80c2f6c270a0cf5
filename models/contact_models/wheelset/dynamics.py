"""Kernels of the wheelset dynamics. The equation numbers are those of readme.md.

A contact frame is a row (x, y, z, angle): its origin relative to the wheelset's centre in track axes [m], and the contact
angle [rad]. Its forces on the wheel are a row (Fx, Fy, Mz) in contact axes [N, N, N m]. Row 0 is the right wheel, row 1 the
left wheel.
"""

from __future__ import annotations

import math
from enum import IntEnum

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers


class FrameRow(IntEnum):
    """A contact frame: origin relative to the wheelset's centre in track axes [m], and contact angle [rad]."""

    X = 0
    Y = 1
    Z = 2
    ANGLE = 3


class Force(IntEnum):
    """Forces on a wheel in contact axes [N, N, N m]."""

    FX = 0
    FY = 1
    MZ = 2


class Side(IntEnum):
    """Row of each side in arrays over both wheels."""

    RIGHT = 0
    LEFT = 1


class StateRow(IntEnum):
    """State of a wheelset [m, rad, m/s, rad/s, rad/s]. The spin is positive when rolling forward."""

    LATERAL = 0
    YAW = 1
    LATERAL_VELOCITY = 2
    YAW_RATE = 3
    SPIN = 4


class Constant(IntEnum):
    """Constants of a wheelset and its track."""

    MASS = 0
    YAW_INERTIA = 1
    SPIN_INERTIA = 2
    LATERAL_STIFFNESS = 3
    YAW_STIFFNESS = 4
    LATERAL_DAMPING = 5
    YAW_DAMPING = 6
    AXLE_LOAD = 7
    SPEED = 8
    RADIUS = 9  # nominal rolling radius [m]


class Energy(IntEnum):
    """Energies since the start [J]."""

    INTERFACE = 0  # energy that left the wheelset through the contacts
    DRIVE = 1  # energy from the drive
    DAMPER = 2  # energy dissipated in the suspension


N_STATE, N_CONSTANTS, N_ENERGY = len(StateRow), len(Constant), len(Energy)


@entry
def arm(frame: Numbers) -> float:
    """Return the roll moment about the centre per unit of -N, y cos δ + z sin δ [m] (5)."""
    return frame[FrameRow.Y] * math.cos(frame[FrameRow.ANGLE]) + frame[FrameRow.Z] * math.sin(frame[FrameRow.ANGLE])


@entry
def locus(frame: Numbers, axle: Numbers) -> float:
    """Return x of the contact origin [m], l_x a/(l_y cos δ + l_z sin δ).

    At this point of the wheel's circle the normal has no x component. The spin then moves the wheel only along the rail's
    surface (theory.md 9.4, the contact locus under yaw).
    """
    return (
        axle[0] * arm(frame) / (axle[1] * math.cos(frame[FrameRow.ANGLE]) + axle[2] * math.sin(frame[FrameRow.ANGLE]))
    )


@entry
def normal_loads(frames: Matrix, forces: Matrix, axle_load: float, loads: Numbers) -> None:
    """Solve vertical and roll equilibrium (4, 5) for loads[side] [N]. A negative load is replaced by 0."""
    vertical, roll = axle_load, 0.0
    for side in range(2):
        sine, cosine = math.sin(frames[side, FrameRow.ANGLE]), math.cos(frames[side, FrameRow.ANGLE])
        vertical += forces[side, Force.FY] * sine
        roll += forces[side, Force.FY] * (frames[side, FrameRow.Y] * sine - frames[side, FrameRow.Z] * cosine)
    c_r, c_l = math.cos(frames[Side.RIGHT, FrameRow.ANGLE]), math.cos(frames[Side.LEFT, FrameRow.ANGLE])
    a_r, a_l = arm(frames[Side.RIGHT]), arm(frames[Side.LEFT])
    determinant = c_r * a_l - c_l * a_r
    loads[Side.RIGHT] = (vertical * a_l - c_l * roll) / determinant
    loads[Side.LEFT] = (c_r * roll - a_r * vertical) / determinant
    for side in range(2):
        if loads[side] < 0.0:  # the other wheel then carries the whole axle; roll equilibrium is not satisfied
            loads[side] = 0.0
            loads[1 - side] = max(vertical / math.cos(frames[1 - side, FrameRow.ANGLE]), 0.0)


@entry
def follow(frames: Matrix, state: Numbers) -> tuple[float, float]:
    """Return the vertical velocity [m/s] and roll rate [rad/s] that keep both wheels on the rails.

    The equations (6) are the transpose of (4, 5).
    """
    sliding_r, sliding_l = _into_surface(frames[Side.RIGHT], state), _into_surface(frames[Side.LEFT], state)
    c_r, c_l = math.cos(frames[Side.RIGHT, FrameRow.ANGLE]), math.cos(frames[Side.LEFT, FrameRow.ANGLE])
    a_r, a_l = arm(frames[Side.RIGHT]), arm(frames[Side.LEFT])
    determinant = c_r * a_l - c_l * a_r
    return (sliding_r * a_l - sliding_l * a_r) / determinant, (c_r * sliding_l - c_l * sliding_r) / determinant


@kernel
def _into_surface(frame, state):
    """Return the velocity normal to the rail's surface [m/s] of a contact origin that moves only with y and yaw."""
    return math.sin(frame[FrameRow.ANGLE]) * (
        state[StateRow.LATERAL_VELOCITY] + state[StateRow.YAW_RATE] * frame[FrameRow.X]
    )


@kernel
def creepages(frame, state, axle, z_rate, roll_rate, speed, out):
    """Write the creepages at one contact origin, wheel minus rail: out = (ξ [-], η [-], spin [1/m]) (7)."""
    sine, cosine = math.sin(frame[FrameRow.ANGLE]), math.cos(frame[FrameRow.ANGLE])
    omega_x = roll_rate - state[StateRow.SPIN] * axle[0]
    omega_y = -state[StateRow.SPIN] * axle[1]
    omega_z = state[StateRow.YAW_RATE] - state[StateRow.SPIN] * axle[2]
    v_x = speed + omega_y * frame[FrameRow.Z] - omega_z * frame[FrameRow.Y]
    v_y = state[StateRow.LATERAL_VELOCITY] + omega_z * frame[FrameRow.X] - omega_x * frame[FrameRow.Z]
    v_z = z_rate + omega_x * frame[FrameRow.Y] - omega_y * frame[FrameRow.X]
    out[0] = v_x / speed
    out[1] = (v_y * cosine + v_z * sine) / speed
    out[2] = (omega_z * cosine - omega_y * sine) / speed


@entry
def resultants(frames: Matrix, forces: Matrix, loads: Numbers, axle: Numbers, out: Numbers) -> None:
    """Write the generalised forces of both contacts to `out` (2, 3).

    out = (lateral [N], yaw [N m], spin [N m], longitudinal [N], roll [N m]). While both wheels carry load, the last is
    zero (5).
    """
    out[:] = 0.0
    for side in range(2):
        x, y, z = frames[side, FrameRow.X], frames[side, FrameRow.Y], frames[side, FrameRow.Z]
        sine, cosine = math.sin(frames[side, FrameRow.ANGLE]), math.cos(frames[side, FrameRow.ANGLE])
        fx, fy, mz = forces[side, Force.FX], forces[side, Force.FY], forces[side, Force.MZ]
        track_y = fy * cosine + loads[side] * sine
        track_z = fy * sine - loads[side] * cosine
        moment_x = y * track_z - z * track_y
        moment_y = z * fx - x * track_z - mz * sine
        moment_z = x * track_y - y * fx + mz * cosine
        out[0] += track_y
        out[1] += moment_z
        out[2] -= moment_x * axle[0] + moment_y * axle[1] + moment_z * axle[2]  # forward rolling turns about -axle
        out[3] += fx
        out[4] += moment_x


@kernel
def _kicked(velocity, mass, force, damping, h):
    """Return the exact velocity after `h` [s] under constant force and linear damping, and its mean over `h` (8)."""
    rate = damping * h / mass
    if rate > 1e-3:
        phi1 = -math.expm1(-rate) / rate
        phi2 = (1.0 - phi1) / rate
    else:  # series of the same functions, without 0/0; the next term is below round-off of phi1
        phi1 = 1.0 - rate / 2.0 * (1.0 - rate / 3.0 * (1.0 - rate / 4.0 * (1.0 - rate / 5.0)))
        phi2 = 0.5 * (1.0 - rate / 3.0 * (1.0 - rate / 4.0 * (1.0 - rate / 5.0)))
    gain = h * (force - damping * velocity) / mass
    return velocity + phi1 * gain, velocity + phi2 * gain


@entry
def kick(state: Numbers, constants: Numbers, Q: Numbers, h: float, energy: Numbers) -> None:
    """Advance the velocities by `h` [s] with constant positions and contact forces `Q`, and add the work to `energy`."""
    lateral, yaw = state[StateRow.LATERAL], state[StateRow.YAW]
    spring_y, spring_psi = -constants[Constant.LATERAL_STIFFNESS] * lateral, -constants[Constant.YAW_STIFFNESS] * yaw
    c_y, c_psi = constants[Constant.LATERAL_DAMPING], constants[Constant.YAW_DAMPING]
    m, inertia, spin_inertia = (
        constants[Constant.MASS],
        constants[Constant.YAW_INERTIA],
        constants[Constant.SPIN_INERTIA],
    )
    before = m * state[StateRow.LATERAL_VELOCITY] ** 2 + inertia * state[StateRow.YAW_RATE] ** 2
    v, mean_v = _kicked(state[StateRow.LATERAL_VELOCITY], m, Q[0] + spring_y, c_y, h)
    w, mean_w = _kicked(state[StateRow.YAW_RATE], inertia, Q[1] + spring_psi, c_psi, h)
    spin_gain = Q[2] * h / spin_inertia
    work = (Q[0] + spring_y) * mean_v * h + (Q[1] + spring_psi) * mean_w * h
    carried = Q[3] * constants[Constant.SPEED]
    energy[Energy.INTERFACE] -= (
        Q[0] * mean_v + Q[1] * mean_w + Q[2] * (state[StateRow.SPIN] + 0.5 * spin_gain) + carried
    ) * h
    energy[Energy.DRIVE] -= carried * h
    energy[Energy.DAMPER] += work - 0.5 * (m * v * v + inertia * w * w - before)
    state[StateRow.LATERAL_VELOCITY], state[StateRow.YAW_RATE] = v, w
    state[StateRow.SPIN] += spin_gain


@entry
def drift(state: Numbers, h: float) -> None:
    """Advance the positions by `h` [s]."""
    state[StateRow.LATERAL] += h * state[StateRow.LATERAL_VELOCITY]
    state[StateRow.YAW] += h * state[StateRow.YAW_RATE]
