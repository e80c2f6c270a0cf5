"""Kernels of the wheelset dynamics; the equation numbers are those of readme.md.

A contact frame is a row (x, y, z, angle): origin relative to the wheelset's centre in track axes [m] and contact angle
[rad]; row 0 is the right wheel, row 1 the left. Its forces on the wheel are a row (Fx, Fy, Mz) in contact axes [N, N,
N m].
"""

from __future__ import annotations

import math

from contact._jit import kernel

X, Y, Z, ANGLE = range(4)
FX, FY, MZ = range(3)
RIGHT, LEFT = range(2)

# state[...]
LATERAL, YAW, LATERAL_VELOCITY, YAW_RATE, SPIN = range(5)  # m, rad, m/s, rad/s, rad/s (positive when rolling forward)
N_STATE = 5
# constants[...]
(
    MASS,
    YAW_INERTIA,
    SPIN_INERTIA,
    LATERAL_STIFFNESS,
    YAW_STIFFNESS,
    LATERAL_DAMPING,
    YAW_DAMPING,
    AXLE_LOAD,
    SPEED,
    RADIUS,  # nominal rolling radius [m]
    CURVATURE,  # of the track, positive to the right [1/m]
    LATERAL_LOAD,  # of the surroundings on the wheelset [N]
    ROLL_LOAD,  # [N m]
    YAW_LOAD,
) = range(14)
N_CONSTANTS = 14
# energy[...] since start, all [J]
INTERFACE, DRIVE, DAMPER = range(3)  # left through the contacts, delivered by the drive, spent in the suspension
N_ENERGY = 3


@kernel
def arm(frame):
    """Roll moment per unit of -N about the centre, y cos δ + z sin δ [m] (5)."""
    return frame[Y] * math.cos(frame[ANGLE]) + frame[Z] * math.sin(frame[ANGLE])


@kernel
def locus(frame, axle):
    """x of the contact origin [m]: where on the wheel's circle the normal has no x component, l_x a/(l_y cos δ + l_z sin δ).

    There the spin moves the wheel along the rail's surface only (theory.md 9.4, the contact locus under yaw).
    """
    return axle[0] * arm(frame) / (axle[1] * math.cos(frame[ANGLE]) + axle[2] * math.sin(frame[ANGLE]))


@kernel
def normal_loads(frames, forces, axle_load, roll_load, loads):
    """Solve vertical and roll equilibrium (4, 5) for loads[side] [N]; a wheel that would pull is unloaded instead."""
    vertical, roll = axle_load, roll_load
    for side in range(2):
        sine, cosine = math.sin(frames[side, ANGLE]), math.cos(frames[side, ANGLE])
        vertical += forces[side, FY] * sine
        roll += forces[side, FY] * (frames[side, Y] * sine - frames[side, Z] * cosine)
    c_r, c_l = math.cos(frames[RIGHT, ANGLE]), math.cos(frames[LEFT, ANGLE])
    a_r, a_l = arm(frames[RIGHT]), arm(frames[LEFT])
    determinant = c_r * a_l - c_l * a_r
    loads[RIGHT] = (vertical * a_l - c_l * roll) / determinant
    loads[LEFT] = (c_r * roll - a_r * vertical) / determinant
    for side in range(2):
        if loads[side] < 0.0:  # the other wheel then carries the axle alone; roll equilibrium is lost
            loads[side] = 0.0
            loads[1 - side] = max(vertical / math.cos(frames[1 - side, ANGLE]), 0.0)


@kernel
def follow(frames, state):
    """Vertical velocity [m/s] and roll rate [rad/s] that keep both wheels on the rails (6): the transpose of (4, 5)."""
    sliding_r, sliding_l = _into_surface(frames[RIGHT], state), _into_surface(frames[LEFT], state)
    c_r, c_l = math.cos(frames[RIGHT, ANGLE]), math.cos(frames[LEFT, ANGLE])
    a_r, a_l = arm(frames[RIGHT]), arm(frames[LEFT])
    determinant = c_r * a_l - c_l * a_r
    return (sliding_r * a_l - sliding_l * a_r) / determinant, (c_r * sliding_l - c_l * sliding_r) / determinant


@kernel
def _into_surface(frame, state):
    """Velocity out of the rail's surface of a contact origin that moves with y and yaw alone [m/s]."""
    return math.sin(frame[ANGLE]) * (state[LATERAL_VELOCITY] + state[YAW_RATE] * frame[X])


@kernel
def creepages(frame, state, axle, z_rate, roll_rate, speed, out):
    """Creepages of the rigid motion at one contact origin, wheel minus rail: out = (ξ, η [-], spin [1/m]) (7)."""
    sine, cosine = math.sin(frame[ANGLE]), math.cos(frame[ANGLE])
    omega_x = roll_rate - state[SPIN] * axle[0]
    omega_y = -state[SPIN] * axle[1]
    omega_z = state[YAW_RATE] - state[SPIN] * axle[2]
    v_x = speed + omega_y * frame[Z] - omega_z * frame[Y]
    v_y = state[LATERAL_VELOCITY] + omega_z * frame[X] - omega_x * frame[Z]
    v_z = z_rate + omega_x * frame[Y] - omega_y * frame[X]
    out[0] = v_x / speed
    out[1] = (v_y * cosine + v_z * sine) / speed
    out[2] = (omega_z * cosine - omega_y * sine) / speed


@kernel
def resultants(frames, forces, loads, axle, out):
    """Generalised forces of both contacts: out = (lateral [N], yaw, spin [N m], longitudinal [N],
    roll [N m]) (2, 3). The last is the roll load, reversed, while both wheels carry (5)."""
    out[:] = 0.0
    for side in range(2):
        x, y, z = frames[side, X], frames[side, Y], frames[side, Z]
        sine, cosine = math.sin(frames[side, ANGLE]), math.cos(frames[side, ANGLE])
        fx, fy, mz = forces[side, FX], forces[side, FY], forces[side, MZ]
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
    """Velocity after `h` under constant force and linear damping, and its mean over `h`; exact (8)."""
    rate = damping * h / mass
    if rate > 1e-3:
        phi1 = -math.expm1(-rate) / rate
        phi2 = (1.0 - phi1) / rate
    else:  # the same by series, free of 0/0; the next term is below round-off of phi1
        phi1 = 1.0 - rate / 2.0 * (1.0 - rate / 3.0 * (1.0 - rate / 4.0 * (1.0 - rate / 5.0)))
        phi2 = 0.5 * (1.0 - rate / 3.0 * (1.0 - rate / 4.0 * (1.0 - rate / 5.0)))
    gain = h * (force - damping * velocity) / mass
    return velocity + phi1 * gain, velocity + phi2 * gain


@kernel
def along_track(Q, constants, lateral):
    """Force of the contacts along the track's centre line [N]: what moves with V is Q_x (1 - κ y) + κ Q_ψ (11)."""
    return Q[3] * (1.0 - constants[CURVATURE] * lateral) + Q[1] * constants[CURVATURE]


@kernel
def kick(state, constants, Q, h, energy):
    """Advance the velocities by `h` [s] with positions and contact forces `Q` held; book the work done."""
    lateral, yaw = state[LATERAL], state[YAW]
    load_y, load_psi = constants[LATERAL_LOAD], constants[YAW_LOAD]
    spring_y = load_y - constants[LATERAL_STIFFNESS] * lateral
    spring_psi = load_psi - constants[YAW_STIFFNESS] * yaw
    c_y, c_psi = constants[LATERAL_DAMPING], constants[YAW_DAMPING]
    m, inertia, spin_inertia = constants[MASS], constants[YAW_INERTIA], constants[SPIN_INERTIA]
    before = m * state[LATERAL_VELOCITY] ** 2 + inertia * state[YAW_RATE] ** 2
    v, mean_v = _kicked(state[LATERAL_VELOCITY], m, Q[0] + spring_y, c_y, h)
    w, mean_w = _kicked(state[YAW_RATE], inertia, Q[1] + spring_psi, c_psi, h)
    spin_gain = Q[2] * h / spin_inertia
    work = (Q[0] + spring_y) * mean_v * h + (Q[1] + spring_psi) * mean_w * h
    carried = along_track(Q, constants, lateral) * constants[SPEED]
    energy[INTERFACE] -= (Q[0] * mean_v + Q[1] * mean_w + Q[2] * (state[SPIN] + 0.5 * spin_gain) + carried) * h
    energy[DRIVE] += (load_y * mean_v + load_psi * mean_w - carried) * h
    energy[DAMPER] += work - 0.5 * (m * v * v + inertia * w * w - before)
    state[LATERAL_VELOCITY], state[YAW_RATE] = v, w
    state[SPIN] += spin_gain


@kernel
def drift(state, h):
    """Advance the positions by `h` [s]."""
    state[LATERAL] += h * state[LATERAL_VELOCITY]
    state[YAW] += h * state[YAW_RATE]
