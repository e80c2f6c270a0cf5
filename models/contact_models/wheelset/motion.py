"""Kernels of the whole wheelset: start, step and rates. Inputs are forces, outputs geometry, creepages and loads (readme.md).

Kernels that can fail return MET or a key of `MESSAGES`. After a failure the caller has to restore the state.
"""

from __future__ import annotations

from typing import NamedTuple

from contact.core import entry, group, kernel
from contact.kernels.arrays import Givens, Matrix, Numbers, Search
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.search import axle
from contact.kernels.geometry.settle import first_touch, locate
from contact.kernels.records import LARGEST_ANGLE
from contact.kernels.rows import Sep
from . import dynamics
from .dynamics import N_STATE, Constant, Energy, FrameRow, Side, StateRow
from .ports import LOAD, POINTS

MET, RIGHT_APART, LEFT_APART, NO_ROLL, TURNED = range(5)
MESSAGES = {
    RIGHT_APART: "the right wheel finds no contact: the profiles of wheel and rail do not overlap",
    LEFT_APART: "the left wheel finds no contact: the profiles of wheel and rail do not overlap",
    NO_ROLL: "no roll angle brings both wheels onto the rails",
    TURNED: f"the wheelset is rolled or yawed by more than {LARGEST_ANGLE:g} rad",
}

#: Least approach for the contact frames [m], so that an unloaded wheel has a contact frame too.
LEAST_APPROACH = 5e-6
_ROLL_RANGE = 0.1  # half range of the search for the roll [rad]; it lifts a wheel by 75 mm
_ROLL_TOLERANCE = 1e-13  # tolerance of the difference of the two wheels' heights [m]
_CREEPAGE = 2 * POINTS


@group
class Wheelset(NamedTuple):
    """All arrays of one wheelset.

    The owner sets `constants`, and curves, sizes and samples of both searches. `state` to `powers` carry over from one step
    to the next.
    """

    constants: Numbers  # as in `dynamics`
    state: Numbers
    energy: Numbers  # since the start [J]
    height: Numbers  # vertical [m], roll [rad]
    irregularity: Numbers  # of the centre line: lateral [m], slope [-]
    forces: Matrix  # of the contacts on the wheels, shape (2, 3)
    approach: Numbers  # of the contacts [m], shape (2,)
    frames: Matrix  # shape (2, 4)
    axle: Numbers  # direction to the right
    loads: Numbers  # [N], shape (2,)
    resultants: Numbers
    problems: Matrix  # inputs of the contacts in the order of `ports.PROBLEM`, shape (2, LOAD + 1)
    rates: Numbers  # time derivatives of `state` at the last report
    powers: Numbers  # time derivatives of `energy` [W] at the last report
    given: Givens  # of one wheel: pose, velocity, irregularity
    right: Search
    left: Search


#: Shapes of the arrays that carry over from one step to the next, in the order of the saved state.
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


@entry
def begin(w: Wheelset, lateral: float, yaw: float, lateral_velocity: float, yaw_rate: float, approach: float) -> int:
    """Put the wheelset onto the rails without forces. Its spin is V over the mean of both rolling radii."""
    w.energy[:] = 0.0
    w.height[:] = 0.0
    w.irregularity[:] = 0.0
    w.forces[:] = 0.0
    w.approach[:] = approach
    w.frames[:] = 0.0
    w.state[StateRow.LATERAL], w.state[StateRow.YAW] = lateral, yaw
    w.state[StateRow.LATERAL_VELOCITY], w.state[StateRow.YAW_RATE] = lateral_velocity, yaw_rate
    failure = meet_rails(w)
    if failure:
        return failure
    radius = 0.0
    for side in range(2):
        radius += 0.5 * (w.axle[1] * w.frames[side, FrameRow.Z] - w.axle[2] * w.frames[side, FrameRow.Y])
    w.state[StateRow.SPIN] = w.constants[Constant.SPEED] / radius
    balance(w)
    report(w)
    return MET


@entry
def step(w: Wheelset, h: float, substeps: int) -> int:
    """Advance by h [s] with constant forces."""
    balance(w)
    for _ in range(substeps):
        failure = _advance(w, h / substeps)
        if failure:
            return failure
    report(w)
    return MET


@kernel
def observe(w: Wheelset) -> int:
    """Compute all outputs from the present state, forces, approaches and irregularity, without any other memory."""
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
    energy, Q, speed = w.energy, w.resultants, w.constants[Constant.SPEED]
    dynamics.kick(w.state, w.constants, Q, 0.5 * dt, energy)
    dynamics.drift(w.state, dt)
    w.irregularity[0] += w.irregularity[1] * speed * dt
    z, roll, moment = w.height[0], w.height[1], Q[4]
    failure = meet_rails(w)
    if failure:
        return failure
    balance(w)
    roll_work = 0.5 * (moment + Q[4]) * (w.height[1] - roll)
    energy[Energy.INTERFACE] += w.constants[Constant.AXLE_LOAD] * (w.height[0] - z) - roll_work
    energy[Energy.DRIVE] -= roll_work
    dynamics.kick(w.state, w.constants, Q, 0.5 * dt, energy)
    return MET


@kernel
def meet_rails(w: Wheelset) -> int:
    """Compute roll, height and contact frames at the present position."""
    y, yaw = w.state[StateRow.LATERAL] - w.irregularity[0], w.state[StateRow.YAW] - w.irregularity[1]
    failure = _settle(w, y, yaw)
    if failure:
        return failure
    z, roll = w.height[0], w.height[1]
    w.axle[0], w.axle[1], w.axle[2] = axle(roll, yaw)
    if not _lay_frame(w, w.right, Side.RIGHT, y, z, roll, yaw):
        return RIGHT_APART
    if not _lay_frame(w, w.left, Side.LEFT, y, z, roll, yaw):
        return LEFT_APART
    return MET


@kernel
def _lay_frame(w: Wheelset, search: Search, side: int, y: float, z: float, roll: float, yaw: float) -> bool:
    """Compute contact frame and separation of one side. Return False without contact."""
    _pose(w, search, y, z, roll, yaw)
    if locate(search) <= 0:
        return False
    m = 1.0 if side == Side.RIGHT else -1.0  # the left side is the mirror image of the right
    patch, separation, frame, problem = search.patches[0], search.separations[0], w.frames[side], w.problems[side]
    frame[FrameRow.Y] = m * patch.point_y - y
    frame[FrameRow.Z] = patch.point_z - (z - w.constants[Constant.RADIUS])
    frame[FrameRow.ANGLE] = m * patch.angle
    frame[FrameRow.X] = dynamics.locus(frame, w.axle)
    for i in range(POINTS):
        k = i if side == Side.RIGHT else POINTS - 1 - i
        problem[i], problem[POINTS + i] = separation[Sep.G, k], separation[Sep.A, k]
    return True


@kernel
def _pose(w: Wheelset, search: Search, y: float, z: float, roll: float, yaw: float) -> None:
    given = w.given[0]
    given.y, given.z, given.roll, given.yaw = y, z, roll, yaw
    given.vx, given.spin = 1.0, -1.0 / w.constants[Constant.RADIUS]  # arbitrary: `report` computes the creepages
    move(given, search.motion[0])


@kernel
def _touch(w: Wheelset, search: Search, y: float, roll: float, yaw: float) -> tuple[bool, float]:
    _pose(w, search, y, 0.0, roll, yaw)
    return first_touch(search.wheel, search.rail, search.motion[0], search.line, search.placed)


@kernel
def _settle(w: Wheelset, y: float, yaw: float) -> int:
    """Find the height [m] and roll [rad] at which both wheels penetrate their rails by the approach (1).

    The difference of the wheels' heights decreases with roll while tan δ < 2 b0/r0 (73°). The method is a secant iteration
    within a bracket. It starts from the last roll and half base.
    """
    roll, half_base = w.height[1], abs(w.frames[Side.RIGHT, FrameRow.Y])
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
        z_right += max(w.approach[Side.RIGHT], LEAST_APPROACH)
        z_left += max(w.approach[Side.LEFT], LEAST_APPROACH)
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


@entry
def balance(w: Wheelset) -> None:
    """Compute normal loads and generalised forces from the present frames and the held creep forces."""
    dynamics.normal_loads(w.frames, w.forces, w.constants[Constant.AXLE_LOAD], w.loads)
    dynamics.resultants(w.frames, w.forces, w.loads, w.axle, w.resultants)


@kernel
def report(w: Wheelset) -> None:
    """Compute creepages, loads, rates and powers of the present motion."""
    speed, state, relative = w.constants[Constant.SPEED], w.state, w.rates[:N_STATE]
    for i in range(N_STATE):
        relative[i] = state[i]
    relative[StateRow.LATERAL_VELOCITY] -= speed * w.irregularity[1]
    z_rate, roll_rate = dynamics.follow(w.frames, relative)
    for side in range(2):
        creepage = w.problems[side, _CREEPAGE:LOAD]
        dynamics.creepages(w.frames[side], relative, w.axle, z_rate, roll_rate, speed, creepage)
        w.problems[side, LOAD] = w.loads[side]
    change(w)
    Q, powers, constants = w.resultants, w.powers, w.constants
    carried = Q[3] * speed
    powers[Energy.INTERFACE] = constants[Constant.AXLE_LOAD] * z_rate - carried - Q[4] * roll_rate
    powers[Energy.INTERFACE] -= (
        Q[0] * state[StateRow.LATERAL_VELOCITY] + Q[1] * state[StateRow.YAW_RATE] + Q[2] * state[StateRow.SPIN]
    )
    powers[Energy.DRIVE] = -carried - Q[4] * roll_rate
    powers[Energy.DAMPER] = constants[Constant.LATERAL_DAMPING] * state[StateRow.LATERAL_VELOCITY] ** 2
    powers[Energy.DAMPER] += constants[Constant.YAW_DAMPING] * state[StateRow.YAW_RATE] ** 2


@entry
def change(w: Wheelset) -> None:
    """Compute the time derivatives of the state under the present generalised forces (2, 3)."""
    c, Q, state, rates = w.constants, w.resultants, w.state, w.rates
    y, yaw, v, yaw_rate = (
        state[StateRow.LATERAL],
        state[StateRow.YAW],
        state[StateRow.LATERAL_VELOCITY],
        state[StateRow.YAW_RATE],
    )
    rates[StateRow.LATERAL], rates[StateRow.YAW] = v, yaw_rate
    rates[StateRow.LATERAL_VELOCITY] = (Q[0] - c[Constant.LATERAL_STIFFNESS] * y - c[Constant.LATERAL_DAMPING] * v) / c[
        Constant.MASS
    ]
    rates[StateRow.YAW_RATE] = (Q[1] - c[Constant.YAW_STIFFNESS] * yaw - c[Constant.YAW_DAMPING] * yaw_rate) / c[
        Constant.YAW_INERTIA
    ]
    rates[StateRow.SPIN] = Q[2] / c[Constant.SPIN_INERTIA]


@entry
def mechanical_energy(w: Wheelset) -> float:
    """Return kinetic energy without that of V, energy of the springs, and potential energy of the weight [J] (10)."""
    c, s = w.constants, w.state
    kinetic = (
        c[Constant.MASS] * s[StateRow.LATERAL_VELOCITY] ** 2
        + c[Constant.YAW_INERTIA] * s[StateRow.YAW_RATE] ** 2
        + c[Constant.SPIN_INERTIA] * s[StateRow.SPIN] ** 2
    )
    springs = (
        c[Constant.LATERAL_STIFFNESS] * s[StateRow.LATERAL] ** 2 + c[Constant.YAW_STIFFNESS] * s[StateRow.YAW] ** 2
    )
    return 0.5 * (kinetic + springs) - c[Constant.AXLE_LOAD] * w.height[0]
