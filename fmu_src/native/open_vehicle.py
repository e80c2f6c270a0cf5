"""Native OpenVehicle: a vehicle that asks for the forces at its wheels (`models.vehicle.kernels.motion`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import carray

from contact.kernels.records import GIVEN
from fmu_src.native.component import Component, Resource
from fmu_src.native.memory import compiled, numbers_of
from fmu_src.native.vehicle_parts import ENDED, LOST, arrays, has_ended, is_finite, layout_of, track_after, write_motion
from fmu_src.native.wires import references
from fmu_src.tables.open_vehicle import table
from fmu_src.tables.vehicle import TRACK
from fmu_src.track import MAGIC, ROWS
from fmu_src.variables import Table
from models.vehicle.assembly import Assembly
from models.vehicle.declared import read
from models.vehicle.kernels import motion

_ENDED, _LOST = 1, 2


def component(vehicle: str) -> Component:
    """Return the FMU of a vehicle as `models.vehicle.declared.read` finds it."""
    interface = table(vehicle)
    made, constants = arrays(vehicle)
    return Component(
        table=interface,
        entries=lambda: _entries(interface, made, read(vehicle).radius),
        data=lambda: constants,
        resources=(Resource(TRACK, MAGIC, ROWS),),
        failures={_ENDED: ENDED, _LOST: f"{LOST}: the step is too long, or forces do not belong to the motion"},
        prefix="open_vehicle",
        exchange=False,
    )


def _entries(table: Table, made: Assembly, radius: float) -> dict[str, Callable[..., Any]]:
    """Return `Component.entries`. The data are those of `vehicle_parts.arrays`."""
    at, layout = references(table), layout_of(made)
    arrange, fill, kept = layout.arrange, layout.fill, layout.kept
    n_values, n_axles = len(table.scalars), made.wheelsets.size
    n_wheels, n_given = 2 * n_axles, GIVEN.itemsize // 8

    @compiled
    def parts_of(work, given):
        track, n_track = track_after(given.resources, 0)
        return arrange(work, kept, track, n_track, given.data)

    @compiled
    def take_forces(v, parts):
        for w in range(n_wheels):
            wheel = parts.scratch.wheels[w]
            wheel.longitudinal, wheel.lateral = v[at.wheel_force_x + w], v[at.wheel_force_y + w]
            wheel.vertical = -v[at.wheel_force_z + w]
            wheel.moment_x, wheel.moment_y = v[at.wheel_moment_x + w], v[at.wheel_moment_y + w]
            wheel.moment_z = v[at.wheel_moment_z + w]
            # only for balances, which this FMU does not have
            wheel.normal, wheel.dissipation, wheel.elastic, wheel.T_gamma, wheel.status = 0.0, 0.0, 0.0, 0.0, 0.0

    @compiled
    def report(v, parts):
        for w in range(n_wheels):
            numbers = carray(numbers_of(parts.scratch.given[w : w + 1]), (n_given,))
            for i in range(n_given):
                v[at.wheel_pose_y + n_wheels * i + w] = numbers[i]
            v[at.wheel_friction_coefficient + w] = parts.scratch.seats[w].friction
        write_motion(v, at.distance, at.body_x, parts)

    def model_memory(values, given):
        return kept

    def model_size(values, given):
        return parts_of(values, given)[1]

    def model_prepare(values, work, given):
        v = carray(values, (n_values,))
        parts = parts_of(work, given)[0]
        fill(parts, given.data, radius, v[at.rail_origin_y], v[at.rail_origin_z])
        return 0

    def model_outputs(values, work, h, given):
        v = carray(values, (n_values,))
        parts = parts_of(work, given)[0]
        model, state, scratch, motions, speed = parts.model, parts.state, parts.scratch, parts.motions, v[at.speed]
        model.surface[0], model.surface[1] = v[at.friction_coefficient], v[at.friction_coefficient]
        if parts.begun[0] == 0.0:
            motion.place(model, state, motions, v[at.initial_z : at.initial_z + n_axles], v[at.initial_distance], speed)
            parts.begun[0] = 1.0
        if has_ended(parts):
            return _ENDED
        motion.ask(model, state, motions, scratch, speed)
        if h > 0.0:
            take_forces(v, parts)
            motion.move(model, state, motions, scratch, h, speed)
            if not is_finite(parts):
                return _LOST
            motion.ask(model, state, motions, scratch, speed)
        report(v, parts)
        return 0

    def model_difference(values, reference, given):
        return 1e-6

    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
