"""Native Wheelset: the functions that C calls, on one array of all values and one of working memory.

The kernels of `contact_models.wheelset.motion` do the work. This module converts values to arguments and results to values.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import carray

from contact.core import arranging
from contact.geometry import profile
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.kernels.block import matrix, records, vector
from contact.kernels.geometry.prepare import facing, rail_origin, take_nodes, turn
from contact.kernels.memory import lay_search
from contact.kernels.records import GIVEN, MAX_PATCHES, SLOWEST
from contact.kernels.rows import N_PROFILE_ROWS
from contact_models.wheelset import dynamics, motion
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import CREEPAGE, LOAD, POINTS
from ..tables.wheelset import table
from .components import OUT_OF_GAUGE
from .wires import references

_WHEEL, _RAIL = WheelsetParameters().wheel, profile.rail_60e1(inclination=0.0)
_WHEEL_ROWS, _RAIL_ROWS = (np.stack((of.y, of.z, of.angle)) for of in (_WHEEL, _RAIL))
_N_WHEEL, _N_RAIL = _WHEEL.y.size, _RAIL.y.size
_GAUGE_POINT = WheelsetParameters().gauge_point
_REMEMBERED = 1 + sum(math.prod(shape) for shape in motion.REMEMBERED.values())
#: Unit → step of a variable for difference quotients. It is small against 0.1 mm, the distance in which a flange root changes
#: the geometry, and large against round-off. Forces enter linearly. Other units occur only in parameters.
_DIFFERENCES = {"m": 1e-7, "rad": 1e-6, "1": 1e-6, "m/s": 1e-5, "rad/s": 1e-4, "N": 1.0, "N.m": 1.0, "J": 1.0}
_STANDSTILL = np.zeros(1, GIVEN)
_TABLE = table()
_AT = references(_TABLE)
_N_VALUES = len(_TABLE.scalars)
_STEPS = np.array([_DIFFERENCES.get(s.unit, 1e-6 * abs(s.first)) for s in _TABLE.scalars])


@arranging
def _arrange(work, n_wheel, n_rail):
    """Lay out all arrays in `work` for curves of `n_wheel` and `n_rail` nodes. Return them and the total size in numbers.

    The warm start begins with a flag that is not zero after the wheelset has been placed on its rails.
    """
    begun, end = vector(work, 0, 1)
    state, end = vector(work, end, dynamics.N_STATE)
    energy, end = vector(work, end, dynamics.N_ENERGY)
    height, end = vector(work, end, 2)
    irregularity, end = vector(work, end, 2)
    forces, end = matrix(work, end, 2, 3)
    approach, end = vector(work, end, 2)
    frames, end = matrix(work, end, 2, 4)
    axle, end = vector(work, end, 3)
    loads, end = vector(work, end, 2)
    resultants, end = vector(work, end, 5)
    problems, end = matrix(work, end, 2, LOAD + 1)
    rates, end = vector(work, end, dynamics.N_STATE)
    powers, end = vector(work, end, dynamics.N_ENERGY)
    sizes, end = vector(work, end, 2)
    constants, end = vector(work, end, dynamics.N_CONSTANTS)
    given, end = records(work, end, 1, GIVEN)
    turned, end = matrix(work, end, N_PROFILE_ROWS, _N_RAIL)
    right, end = lay_search(work, end, n_wheel, n_rail, POINTS, POINTS)
    left, end = lay_search(work, end, n_wheel, n_rail, POINTS, POINTS)
    wheelset = motion.Wheelset(
        constants, state, energy, height, irregularity, forces, approach, frames, axle, loads, resultants, problems,
        rates, powers, given, right, left,
    )  # fmt: skip
    return wheelset, begun, turned, sizes, end


@arranging
def _prepared(work):
    """Return the wheelset as laid out by `model_prepare`, and the flag at the beginning of the warm start."""
    sizes, _ = vector(work, _REMEMBERED, 2)
    wheelset, begun, _, _, _ = _arrange(work, int(sizes[0]), int(sizes[1]))
    return wheelset, begun


@arranging
def _begin(v, w):
    """Place the wheelset on its rails; return a code of `motion`."""
    return motion.begin(
        w, v[_AT.initial_lateral], v[_AT.initial_yaw], v[_AT.initial_lateral_velocity], v[_AT.initial_yaw_rate],
        v[_AT.initial_approach],
    )  # fmt: skip


@arranging
def _take_inputs(v, w):
    for i in range(3):
        w.forces[0, i], w.forces[1, i] = v[_AT.right_force_x + i], v[_AT.left_force_x + i]
    w.approach[0], w.approach[1] = v[_AT.right_approach], v[_AT.left_approach]
    w.irregularity[0], w.irregularity[1] = v[_AT.irregularity_lateral], v[_AT.irregularity_slope]


@arranging
def _take_states(v, w):
    for i in range(dynamics.N_STATE):
        w.state[i] = v[_AT.lateral + i]
    for i in range(dynamics.N_ENERGY):
        w.energy[i] = v[_AT.energy_interface + i]


@arranging
def _report_side(v, w, side, first):
    """Write the outputs of one side. `first` are the references of its gap, curvatures, creepages, load and frame."""
    problem, (gap, curvature, creepage, load, frame) = w.problems[side], first
    for i in range(POINTS):
        v[gap + i], v[curvature + i] = problem[i], problem[POINTS + i]
    for i in range(3):
        v[creepage + i] = problem[CREEPAGE.start + i]
    v[load] = problem[LOAD]
    for i in range(4):
        v[frame + i] = w.frames[side, i]


@arranging
def _report(v, w):
    for i in range(dynamics.N_STATE):
        v[_AT.lateral + i] = w.state[i]
    v[_AT.vertical], v[_AT.roll] = w.height[0], w.height[1]
    for i in range(dynamics.N_ENERGY):
        v[_AT.energy_interface + i], v[_AT.power_interface + i] = w.energy[i], w.powers[i]
    v[_AT.energy_mechanical] = motion.mechanical_energy(w)
    for i in range(3):
        v[_AT.lateral_acceleration + i] = w.rates[dynamics.StateRow.LATERAL_VELOCITY + i]
    _report_side(
        v, w, dynamics.Side.RIGHT, (_AT.right_geometry_g, _AT.right_geometry_A, _AT.right_creepage_longitudinal,
        _AT.right_load_normal_force, _AT.right_contact_x),
    )  # fmt: skip
    _report_side(
        v, w, dynamics.Side.LEFT, (_AT.left_geometry_g, _AT.left_geometry_A, _AT.left_creepage_longitudinal,
        _AT.left_load_normal_force, _AT.left_contact_x),
    )  # fmt: skip


@arranging
def _prepare_search(v, found, mirror, origin_y, origin_z):
    """Fill what the search for contacts needs to know of one side: +1 right, −1 left."""
    pose = found.motion[0]
    pose.radius = v[_AT.wheel_radius]
    pose.tape = 0.5 * v[_AT.wheel_flange_back] + TAPE_FROM_FLANGE_BACK
    pose.combine_distance, pose.combine_angle = 1.0, math.radians(20.0)  # all lobes of a wheel share one plane
    pose.most_patches, pose.mirror = MAX_PATCHES, mirror
    pose.origin_y, pose.origin_z, pose.slowest = origin_y, origin_z, SLOWEST
    for i in range(POINTS):
        k = i if mirror > 0.0 else POINTS - 1 - i
        found.grid[i] = mirror * (v[_AT.geometry_y0] + v[_AT.geometry_dy] * k)


@arranging
def _fill_constants(v, c):
    """Fill the constants of the motion from the parameters."""
    c[dynamics.Constant.MASS] = v[_AT.mass]
    c[dynamics.Constant.YAW_INERTIA], c[dynamics.Constant.SPIN_INERTIA] = v[_AT.yaw_inertia], v[_AT.spin_inertia]
    c[dynamics.Constant.LATERAL_STIFFNESS] = v[_AT.suspension_lateral_stiffness]
    c[dynamics.Constant.YAW_STIFFNESS] = v[_AT.suspension_yaw_stiffness]
    c[dynamics.Constant.LATERAL_DAMPING] = v[_AT.suspension_lateral_damping]
    c[dynamics.Constant.YAW_DAMPING] = v[_AT.suspension_yaw_damping]
    c[dynamics.Constant.AXLE_LOAD], c[dynamics.Constant.SPEED] = v[_AT.axle_load], v[_AT.speed]
    c[dynamics.Constant.RADIUS] = v[_AT.wheel_radius]


def model_memory(values, given):
    return _REMEMBERED


def model_size(values, given):
    return _arrange(values, _N_WHEEL, _N_RAIL)[4]


def model_prepare(values, work, given):
    v = carray(values, (_N_VALUES,))
    _, _, turned, sizes, _ = _arrange(work, _N_WHEEL, _N_RAIL)
    turn(_RAIL_ROWS, -math.atan(v[_AT.rail_inclination]), turned)
    origin_y, origin_z, deepest = rail_origin(turned, v[_AT.track_gauge], _GAUGE_POINT)
    if deepest < _GAUGE_POINT:
        return OUT_OF_GAUGE
    wheel_from, wheel_to = facing(_WHEEL_ROWS, True)
    rail_from, rail_to = facing(turned, False)
    sizes[0], sizes[1] = wheel_to - wheel_from, rail_to - rail_from
    w, _ = _prepared(work)
    w.given[0] = _STANDSTILL[0]
    w.constants[:] = 0.0
    for found, mirror in ((w.right, 1.0), (w.left, -1.0)):
        take_nodes(_WHEEL_ROWS, wheel_from, wheel_to, found.wheel)
        take_nodes(turned, rail_from, rail_to, found.rail)
        _prepare_search(v, found, mirror, origin_y, origin_z)
    _fill_constants(v, w.constants)
    return 0


def model_start(values, work, given):
    v = carray(values, (_N_VALUES,))
    w, _ = _prepared(work)
    failure = _begin(v, w)
    if failure == motion.MET:
        _report(v, w)
    return failure


def model_outputs(values, work, h, given):
    v = carray(values, (_N_VALUES,))
    w, begun = _prepared(work)
    failure = motion.MET
    if h > 0.0:
        if begun[0] == 0.0:
            failure = _begin(v, w)
            begun[0] = 1.0
        _take_inputs(v, w)
        if failure == motion.MET:
            failure = motion.step(w, h, int(v[_AT.resolution_substeps]))
    else:
        _take_states(v, w)
        _take_inputs(v, w)
        failure = motion.observe(w)
    if failure == motion.MET:
        _report(v, w)
    return failure


def model_difference(values, reference, given):
    return _STEPS[reference]


def entries() -> dict[str, Any]:
    """Return the functions of this kind (`kinds`)."""
    called_by_c = (model_memory, model_size, model_prepare, model_start, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
