"""Kernels of the wheelset as a whole: start, step, rates. Forces come in, geometry, creepages and loads go out (readme.md).

Those that may fail return MET or one of `MESSAGES`; what they have changed by then is for the caller to put back.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.kernels.layout import Sep
from contact._jit import kernel
from contact.kernels.geometry.prepare import move
from contact.geometry.records import LARGEST_ANGLE
from contact.kernels.geometry.search import axle
from contact.kernels.geometry.settle import first_touch, locate
from contact.geometry.workspace import Search
from models.wheelset import dynamics
from models.wheelset.dynamics import (
    ANGLE,
    AXLE_LOAD,
    CURVATURE,
    DAMPER,
    DRIVE,
    INTERFACE,
    LATERAL,
    LATERAL_DAMPING,
    LATERAL_LOAD,
    LATERAL_STIFFNESS,
    LATERAL_VELOCITY,
    LEFT,
    MASS,
    N_STATE,
    RADIUS,
    RIGHT,
    ROLL_LOAD,
    SPEED,
    SPIN,
    SPIN_INERTIA,
    YAW,
    YAW_DAMPING,
    YAW_INERTIA,
    YAW_LOAD,
    YAW_RATE,
    YAW_STIFFNESS,
    X,
    Y,
    Z,
)
from models.wheelset.ports import LOAD, POINTS

Array = NDArray[np.float64]

MET, RIGHT_APART, LEFT_APART, NO_ROLL, TURNED = range(5)
MESSAGES = {
    RIGHT_APART: "the right wheel finds no contact: the profiles of wheel and rail do not overlap",
    LEFT_APART: "the left wheel finds no contact: the profiles of wheel and rail do not overlap",
    NO_ROLL: "no roll angle brings both wheels onto the rails",
    TURNED: f"the wheelset is rolled or yawed by more than {LARGEST_ANGLE:g} rad",
}

#: Least approach that a contact frame is laid out for [m]; an unloaded wheel still has a place where it would touch.
LEAST_APPROACH = 5e-6
_ROLL_RANGE = 0.1  # [rad] lifts a wheel by 75 mm
_ROLL_TOLERANCE = 1e-13  # [m] difference of the two wheels' heights
_CREEPAGE = 2 * POINTS


class Wheelset(NamedTuple):
    """All arrays of one wheelset. `constants` are set by the owner, as are curves, sizes and samples of both searches.

    What is remembered from one step to the next lies in `state` … `powers`.
    """

    constants: Array  # as in `dynamics`
    state: Array
    energy: Array  # since start [J]
    height: Array  # vertical [m], roll [rad]
    irregularity: Array  # of the centre line: lateral [m], slope [-]
    forces: Array  # of the contacts on the wheels, shape (2, 3)
    approach: Array  # of the contacts [m], shape (2,)
    frames: Array  # shape (2, 4)
    axle: Array  # direction to the right
    loads: Array  # [N], shape (2,)
    resultants: Array
    problems: Array  # what the contacts have to solve, in the order of `ports.PROBLEM`, shape (2, LOAD + 1)
    rates: Array  # time derivatives of `state`, reported last
    powers: Array  # time derivatives of `energy` [W], likewise
    given: Array  # of one wheel: pose, velocity, irregularity
    right: Search
    left: Search


#: Shapes of what is remembered, in this order.
REMEMBERED = {
    "state": (N_STATE,),
    "energy": (dynamics.N_ENERGY,),
    "height": (2,),
    "irregularity": (2,),
    "forces": (2, 3),
    "approach": (2,),
    "frames": (2, 4),
    "axle": (3,),
    "loads": (2,),
    "resultants": (5,),
    "problems": (2, LOAD + 1),
    "rates": (N_STATE,),
    "powers": (dynamics.N_ENERGY,),
}


@kernel
def begin(w: Wheelset, lateral: float, yaw: float, lateral_velocity: float, yaw_rate: float, approach: float) -> int:
    """Put the wheelset onto the rails, without forces, and let it roll with V over the mean of both rolling radii."""
    w.energy[:] = 0.0
    w.height[:] = 0.0
    w.irregularity[:] = 0.0
    w.forces[:] = 0.0
    w.approach[:] = approach
    w.frames[:] = 0.0
    w.state[LATERAL], w.state[YAW] = lateral, yaw
    w.state[LATERAL_VELOCITY], w.state[YAW_RATE] = lateral_velocity, yaw_rate
    failure = meet_rails(w)
    if failure:
        return failure
    radius = 0.0
    for side in range(2):
        radius += 0.5 * (w.axle[1] * w.frames[side, Z] - w.axle[2] * w.frames[side, Y])
    w.state[SPIN] = w.constants[SPEED] / radius
    balance(w)
    report(w)
    return MET


@kernel
def step(w: Wheelset, h: float, substeps: int) -> int:
    """Advance by h [s] with the forces held."""
    balance(w)
    for _ in range(substeps):
        failure = _advance(w, h / substeps)
        if failure:
            return failure
    report(w)
    return MET


@kernel
def observe(w: Wheelset) -> int:
    """Everything at the present state, forces, approaches and irregularity; nothing that was remembered counts."""
    w.height[:] = 0.0
    w.frames[:] = 0.0
    failure = meet_rails(w)
    if failure:
        return failure
    balance(w)
    report(w)
    return MET


@kernel
def _advance(w: Wheelset, dt: float) -> int:
    """One step of the Strang splitting: kick, drift, kick (8)."""
    energy, Q, speed = w.energy, w.resultants, w.constants[SPEED]
    dynamics.kick(w.state, w.constants, Q, 0.5 * dt, energy)
    dynamics.drift(w.state, dt)
    w.irregularity[0] += w.irregularity[1] * speed * dt
    z, roll, moment = w.height[0], w.height[1], Q[4]
    failure = meet_rails(w)
    if failure:
        return failure
    balance(w)
    roll_work = 0.5 * (moment + Q[4]) * (w.height[1] - roll)
    energy[INTERFACE] += w.constants[AXLE_LOAD] * (w.height[0] - z) - roll_work
    energy[DRIVE] -= roll_work
    dynamics.kick(w.state, w.constants, Q, 0.5 * dt, energy)
    return MET


@kernel
def meet_rails(w: Wheelset) -> int:
    """Roll, height and contact frames at the present position."""
    y, yaw = w.state[LATERAL] - w.irregularity[0], w.state[YAW] - w.irregularity[1]
    failure = _settle(w, y, yaw)
    if failure:
        return failure
    z, roll = w.height[0], w.height[1]
    w.axle[0], w.axle[1], w.axle[2] = axle(roll, yaw)
    if not _lay_frame(w, w.right, RIGHT, y, z, roll, yaw):
        return RIGHT_APART
    if not _lay_frame(w, w.left, LEFT, y, z, roll, yaw):
        return LEFT_APART
    return MET


@kernel
def _lay_frame(w: Wheelset, search: Search, side: int, y: float, z: float, roll: float, yaw: float) -> bool:
    """Contact frame and separation of one side; False without contact."""
    _pose(w, search, y, z, roll, yaw)
    if locate(search) <= 0:
        return False
    m = 1.0 if side == RIGHT else -1.0  # the left side is the mirror image of the right
    patch, separation, frame, problem = search.patches[0], search.separations[0], w.frames[side], w.problems[side]
    frame[Y] = m * patch.point_y - y
    frame[Z] = patch.point_z - (z - w.constants[RADIUS])
    frame[ANGLE] = m * patch.angle
    frame[X] = dynamics.locus(frame, w.axle)
    for i in range(POINTS):
        k = i if side == RIGHT else POINTS - 1 - i
        problem[i], problem[POINTS + i] = separation[Sep.G, k], separation[Sep.A, k]
    return True


@kernel
def _pose(w: Wheelset, search: Search, y: float, z: float, roll: float, yaw: float) -> None:
    given = w.given
    given.y, given.z, given.roll, given.yaw = y, z, roll, yaw
    given.vx, given.spin = 1.0, -1.0 / w.constants[RADIUS]  # only creepages need it, which are computed here
    move(given, search.motion)


@kernel
def _touch(w: Wheelset, search: Search, y: float, roll: float, yaw: float) -> tuple[bool, float]:
    _pose(w, search, y, 0.0, roll, yaw)
    return first_touch(search.wheel, search.rail, search.motion, search.line, search.placed)


@kernel
def _settle(w: Wheelset, y: float, yaw: float) -> int:
    """Roll [rad] at which both wheels sink into their rails by the approach at one height, and that height [m] (1).

    The difference of heights falls with roll while tan δ < 2 b0/r0 (73°), so a secant is kept in a bracket. It starts
    from the last roll and half base.
    """
    roll, half_base = w.height[1], abs(w.frames[RIGHT, Y])
    low, high = roll - _ROLL_RANGE, roll + _ROLL_RANGE
    slope = -2.0 * half_base if half_base > 0.0 else -1.5
    f_before, roll_before = 0.0, 0.0
    for iteration in range(60):
        if abs(roll) > LARGEST_ANGLE or abs(yaw) > LARGEST_ANGLE:
            return TURNED
        over_right, z_right = _touch(w, w.right, y, roll, yaw)
        over_left, z_left = _touch(w, w.left, y, roll, yaw)
        if not over_right:
            return RIGHT_APART
        if not over_left:
            return LEFT_APART
        z_right += max(w.approach[RIGHT], LEAST_APPROACH)
        z_left += max(w.approach[LEFT], LEAST_APPROACH)
        f = z_right - z_left
        if abs(f) <= _ROLL_TOLERANCE or high - low <= _ROLL_TOLERANCE:
            w.height[0], w.height[1] = 0.5 * (z_right + z_left), roll
            return MET
        if f > 0.0:
            low = roll
        else:
            high = roll
        if iteration > 0 and f != f_before:
            slope = (f - f_before) / (roll - roll_before)
        f_before, roll_before = f, roll
        roll -= f / slope
        if not low < roll < high:
            roll = 0.5 * (low + high)
    return NO_ROLL


@kernel
def balance(w: Wheelset) -> None:
    """Normal loads and generalised forces of the present frames and held creep forces, and what follows from them."""
    dynamics.normal_loads(w.frames, w.forces, w.constants[AXLE_LOAD], w.constants[ROLL_LOAD], w.loads)
    dynamics.resultants(w.frames, w.forces, w.loads, w.axle, w.resultants)


@kernel
def report(w: Wheelset) -> None:
    """Creepages and loads of the present motion; rates and powers."""
    speed, state, relative = w.constants[SPEED], w.state, w.rates[:N_STATE]
    for i in range(N_STATE):
        relative[i] = state[i]
    relative[LATERAL_VELOCITY] -= speed * w.irregularity[1]
    z_rate, roll_rate = dynamics.follow(w.frames, relative)
    relative[YAW_RATE] += speed * w.constants[CURVATURE]
    forward = speed * (1.0 - w.constants[CURVATURE] * state[LATERAL])
    for side in range(2):
        creepage = w.problems[side, _CREEPAGE:LOAD]
        dynamics.creepages(w.frames[side], relative, w.axle, z_rate, roll_rate, forward, creepage)
        w.problems[side, LOAD] = w.loads[side]
    change(w)
    Q, powers, constants = w.resultants, w.powers, w.constants
    carried = dynamics.along_track(Q, constants, state[LATERAL]) * speed
    powers[INTERFACE] = constants[AXLE_LOAD] * z_rate - carried - Q[4] * roll_rate
    powers[INTERFACE] -= Q[0] * state[LATERAL_VELOCITY] + Q[1] * state[YAW_RATE] + Q[2] * state[SPIN]
    powers[DRIVE] = -carried - Q[4] * roll_rate
    powers[DRIVE] += constants[LATERAL_LOAD] * state[LATERAL_VELOCITY] + constants[YAW_LOAD] * state[YAW_RATE]
    powers[DAMPER] = constants[LATERAL_DAMPING] * state[LATERAL_VELOCITY] ** 2
    powers[DAMPER] += constants[YAW_DAMPING] * state[YAW_RATE] ** 2


@kernel
def change(w: Wheelset) -> None:
    """Time derivatives of the state under the present generalised forces (2, 3)."""
    c, Q, state, rates = w.constants, w.resultants, w.state, w.rates
    y, yaw, v, yaw_rate = state[LATERAL], state[YAW], state[LATERAL_VELOCITY], state[YAW_RATE]
    rates[LATERAL], rates[YAW] = v, yaw_rate
    force, moment = Q[0] + c[LATERAL_LOAD], Q[1] + c[YAW_LOAD]
    rates[LATERAL_VELOCITY] = (force - c[LATERAL_STIFFNESS] * y - c[LATERAL_DAMPING] * v) / c[MASS]
    rates[YAW_RATE] = (moment - c[YAW_STIFFNESS] * yaw - c[YAW_DAMPING] * yaw_rate) / c[YAW_INERTIA]
    rates[SPIN] = Q[2] / c[SPIN_INERTIA]


@kernel
def mechanical_energy(w: Wheelset) -> float:
    """Kinetic energy (without that of V), of the springs, and of the weight [J] (10)."""
    c, s = w.constants, w.state
    kinetic = c[MASS] * s[LATERAL_VELOCITY] ** 2 + c[YAW_INERTIA] * s[YAW_RATE] ** 2 + c[SPIN_INERTIA] * s[SPIN] ** 2
    springs = c[LATERAL_STIFFNESS] * s[LATERAL] ** 2 + c[YAW_STIFFNESS] * s[YAW] ** 2
    return 0.5 * (kinetic + springs) - c[AXLE_LOAD] * w.height[0]
