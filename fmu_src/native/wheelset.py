"""Native Wheelset: the functions that C calls, on one array of all values and one of working memory.

The kernels of `models.wheelset.motion` do the work. This module converts values to their arguments and results to values.
"""

from __future__ import annotations

import math
from collections import namedtuple
from collections.abc import Callable
from typing import Any

import numpy as np
from numba import carray

from contact.geometry import profile
from contact.geometry.profile import Profile
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK
from contact.kernels.block import matrix, records, vector
from contact.kernels.geometry.prepare import facing, rail_origin, take_nodes, turn
from contact.kernels.memory import lay_search
from contact.kernels.records import GIVEN, MAX_PATCHES
from contact.kernels.rows import N_PROFILE_ROWS
from fmu_src.native.component import Component
from fmu_src.native.memory import compiled
from fmu_src.tables.wheelset import table
from fmu_src.variables import Table
from models.wheelset import dynamics, motion
from models.wheelset.parameters import WheelsetParameters
from models.wheelset.ports import CREEPAGE, LOAD, POINTS

_WHEEL, _RAIL = WheelsetParameters().wheel, profile.rail_60e1(inclination=0.0)
_N_WHEEL, _N_RAIL = _WHEEL.y.size, _RAIL.y.size
_GAUGE_POINT = WheelsetParameters().gauge_point
_REMEMBERED = 1 + sum(math.prod(shape) for shape in motion.REMEMBERED.values())
#: Unit → step of a variable for difference quotients. It is small against 0.1 mm, the distance in which a flange root changes
#: the geometry, and large against round-off. Forces enter linearly. Other units occur only in parameters.
_DIFFERENCES = {"m": 1e-7, "rad": 1e-6, "1": 1e-6, "m/s": 1e-5, "rad/s": 1e-4, "N": 1.0, "N.m": 1.0, "J": 1.0}
_STANDSTILL = np.zeros(1, GIVEN)
_OUT_OF_GAUGE = max(motion.MESSAGES) + 1


def component() -> Component:
    """Return the FMU."""
    interface = table()
    return Component(
        table=interface,
        entries=lambda: _entries(interface),
        data=lambda: (_rows(_WHEEL), _rows(_RAIL)),
        failures={
            **motion.MESSAGES,
            _OUT_OF_GAUGE: "the rail's side does not reach down to where the gauge is measured",
        },
    )


def _rows(shape: Profile) -> np.ndarray:
    return np.stack((shape.y, shape.z, shape.angle))


def _entries(table: Table) -> dict[str, Callable[..., Any]]:
    """Return `Component.entries`. The data arguments are the profiles of the wheel and of the rail before it is inclined."""
    at = namedtuple("References", [name.replace(".", "_") for name in table.span])(
        *(span.start for span in table.span.values())
    )
    n_values = len(table.scalars)
    differences = np.array([_DIFFERENCES.get(s.unit, 1e-6 * abs(s.first)) for s in table.scalars])

    @compiled
    def arrange(work, n_wheel, n_rail):
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

    @compiled
    def prepared(work):
        """Return the wheelset as laid out by `model_prepare`, and the flag at the beginning of the warm start."""
        sizes, _ = vector(work, _REMEMBERED, 2)
        wheelset, begun, _, _, _ = arrange(work, int(sizes[0]), int(sizes[1]))
        return wheelset, begun

    @compiled
    def begin(v, w):
        return motion.begin(
            w, v[at.initial_lateral], v[at.initial_yaw], v[at.initial_lateral_velocity], v[at.initial_yaw_rate],
            v[at.initial_approach],
        )  # fmt: skip

    @compiled
    def take_inputs(v, w):
        for i in range(3):
            w.forces[0, i], w.forces[1, i] = v[at.right_force_x + i], v[at.left_force_x + i]
        w.approach[0], w.approach[1] = v[at.right_approach], v[at.left_approach]
        w.irregularity[0], w.irregularity[1] = v[at.irregularity_lateral], v[at.irregularity_slope]

    @compiled
    def report_side(v, w, side, gap, curvature, creepage, load, frame):
        problem = w.problems[side]
        for i in range(POINTS):
            v[gap + i], v[curvature + i] = problem[i], problem[POINTS + i]
        for i in range(3):
            v[creepage + i] = problem[CREEPAGE.start + i]
        v[load] = problem[LOAD]
        for i in range(4):
            v[frame + i] = w.frames[side, i]

    @compiled
    def report(v, w):
        for i in range(dynamics.N_STATE):
            v[at.lateral + i] = w.state[i]
        v[at.vertical], v[at.roll] = w.height[0], w.height[1]
        for i in range(dynamics.N_ENERGY):
            v[at.energy_interface + i], v[at.power_interface + i] = w.energy[i], w.powers[i]
        v[at.energy_mechanical] = motion.mechanical_energy(w)
        for i in range(3):
            v[at.lateral_acceleration + i] = w.rates[dynamics.State.LATERAL_VELOCITY + i]
        report_side(
            v, w, dynamics.Side.RIGHT, at.right_geometry_g, at.right_geometry_A, at.right_creepage_longitudinal,
            at.right_load_normal_force, at.right_contact_x,
        )  # fmt: skip
        report_side(
            v, w, dynamics.Side.LEFT, at.left_geometry_g, at.left_geometry_A, at.left_creepage_longitudinal,
            at.left_load_normal_force, at.left_contact_x,
        )  # fmt: skip

    def model_memory(values, wheel, rail):
        return _REMEMBERED

    def model_size(values, wheel, rail):
        return arrange(values, _N_WHEEL, _N_RAIL)[4]

    @compiled
    def prepare_search(v, found, mirror, origin_y, origin_z):
        pose = found.motion[0]
        pose.radius = v[at.wheel_radius]
        pose.tape = 0.5 * v[at.wheel_flange_back] + TAPE_FROM_FLANGE_BACK
        pose.combine_distance, pose.combine_angle = 1.0, math.radians(20.0)  # all lobes of a wheel share one plane
        pose.most_patches, pose.mirror = MAX_PATCHES, mirror
        pose.origin_y, pose.origin_z = origin_y, origin_z
        for i in range(POINTS):
            k = i if mirror > 0.0 else POINTS - 1 - i
            found.grid[i] = mirror * (v[at.geometry_y0] + v[at.geometry_dy] * k)

    def model_prepare(values, work, wheel, rail):
        v = carray(values, (n_values,))
        _, _, turned, sizes, _ = arrange(work, _N_WHEEL, _N_RAIL)
        wheel_rows = carray(wheel, (N_PROFILE_ROWS, _N_WHEEL))
        turn(carray(rail, (N_PROFILE_ROWS, _N_RAIL)), -math.atan(v[at.rail_inclination]), turned)
        origin_y, origin_z, deepest = rail_origin(turned, v[at.track_gauge], _GAUGE_POINT)
        if deepest < _GAUGE_POINT:
            return _OUT_OF_GAUGE
        wheel_from, wheel_to = facing(wheel_rows, True)
        rail_from, rail_to = facing(turned, False)
        sizes[0], sizes[1] = wheel_to - wheel_from, rail_to - rail_from
        w, _ = prepared(work)
        w.given[0] = _STANDSTILL[0]
        w.constants[:] = 0.0
        for found, mirror in ((w.right, 1.0), (w.left, -1.0)):
            take_nodes(wheel_rows, wheel_from, wheel_to, found.wheel)
            take_nodes(turned, rail_from, rail_to, found.rail)
            prepare_search(v, found, mirror, origin_y, origin_z)
        c = w.constants
        c[dynamics.Constant.MASS], c[dynamics.Constant.YAW_INERTIA], c[dynamics.Constant.SPIN_INERTIA] = (
            v[at.mass],
            v[at.yaw_inertia],
            v[at.spin_inertia],
        )
        c[dynamics.Constant.LATERAL_STIFFNESS] = v[at.suspension_lateral_stiffness]
        c[dynamics.Constant.YAW_STIFFNESS] = v[at.suspension_yaw_stiffness]
        c[dynamics.Constant.LATERAL_DAMPING] = v[at.suspension_lateral_damping]
        c[dynamics.Constant.YAW_DAMPING] = v[at.suspension_yaw_damping]
        c[dynamics.Constant.AXLE_LOAD], c[dynamics.Constant.SPEED], c[dynamics.Constant.RADIUS] = (
            v[at.axle_load],
            v[at.speed],
            v[at.wheel_radius],
        )
        return 0

    def model_start(values, work, wheel, rail):
        v = carray(values, (n_values,))
        w, _ = prepared(work)
        failure = begin(v, w)
        if failure == motion.MET:
            report(v, w)
        return failure

    def model_outputs(values, work, h, wheel, rail):
        v = carray(values, (n_values,))
        w, begun = prepared(work)
        failure = motion.MET
        if h > 0.0:
            if begun[0] == 0.0:
                failure = begin(v, w)
                begun[0] = 1.0
            take_inputs(v, w)
            if failure == motion.MET:
                failure = motion.step(w, h, int(v[at.resolution_substeps]))
        else:
            for i in range(dynamics.N_STATE):
                w.state[i] = v[at.lateral + i]
            for i in range(dynamics.N_ENERGY):
                w.energy[i] = v[at.energy_interface + i]
            take_inputs(v, w)
            failure = motion.observe(w)
        if failure == motion.MET:
            report(v, w)
        return failure

    def model_lazy(values, work, wheel, rail):
        return 0

    def model_field(values, work, k, wheel, rail):
        return 0

    def model_difference(values, reference, wheel, rail):
        return differences[reference]

    called_by_c = (
        model_memory,
        model_size,
        model_prepare,
        model_start,
        model_outputs,
        model_lazy,
        model_field,
        model_difference,
    )
    return {function.__name__: function for function in called_by_c}
