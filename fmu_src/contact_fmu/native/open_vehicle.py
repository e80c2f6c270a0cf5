"""Native OpenVehicle: a vehicle that asks for the forces at its wheels (`contact_models.vehicle.kernels.motion`)."""

from __future__ import annotations

from typing import Any

from numba import carray

from contact.compile.pointers import numbers_of
from contact.core import arranging
from contact.kernels.block import records
from contact.kernels.records import GIVEN
from contact_models.vehicle.kernels import motion
from contact_models.vehicle.kernels.layout import Axis
from ..tables.open_vehicle import table
from .component import places
from .failures import OpenFailure
from .vehicle_parts import arrange, fill, lay_kept, track_after, write_motion

_TABLE = table("manchester")  # its rows, of whatever size
_AT = places(_TABLE)
_N_PLACES, _N_GIVEN = len(_AT), GIVEN.itemsize // 8
_ENDED, _LOST = OpenFailure.ENDED, OpenFailure.LOST


@arranging
def _parts_of(values, work, given):
    """Return the values as an array, the record `places` in an array, the vehicle and the total size in numbers."""
    rows, _ = records(given.own, 0, 1, _AT)
    at = rows[0]
    track, n_track = track_after(given.resources, 0)
    begun, state, scratch, end = lay_kept(work, at)
    parts, end = arrange(work, end, begun, state, scratch, track, n_track, given.own, _N_PLACES, at)
    return carray(values, (at.n_values,)), rows, parts, end


@arranging
def _take_forces(v, at, parts):
    for w in range(2 * at.n_axles):
        wheel = parts.scratch.wheels[w]
        wheel.longitudinal, wheel.lateral = v[at.wheel_force_x + w], v[at.wheel_force_y + w]
        wheel.vertical = -v[at.wheel_force_z + w]
        wheel.moment_x, wheel.moment_y = v[at.wheel_moment_x + w], v[at.wheel_moment_y + w]
        wheel.moment_z = v[at.wheel_moment_z + w]
        # only for balances, which this FMU does not have
        wheel.normal, wheel.dissipation, wheel.elastic, wheel.T_gamma, wheel.status = 0.0, 0.0, 0.0, 0.0, 0.0


@arranging
def _report(v, at, parts):
    n_wheels = 2 * at.n_axles
    for w in range(n_wheels):
        numbers = carray(numbers_of(parts.scratch.given[w : w + 1]), (_N_GIVEN,))
        for i in range(_N_GIVEN):
            v[at.wheel_pose_y + n_wheels * i + w] = numbers[i]
        v[at.wheel_friction_coefficient + w] = parts.scratch.seats[w].friction
    write_motion(v, at.distance, at.body_x, parts)


def model_memory(values, given):
    return lay_kept(values, records(given.own, 0, 1, _AT)[0][0])[3]


def model_size(values, given):
    return _parts_of(values, values, given)[3]


def model_prepare(values, work, given):
    v, rows, parts, _ = _parts_of(values, work, given)
    at = rows[0]
    fill(parts, v[at.rail_origin_y], v[at.rail_origin_z], v[at.reference_speed])
    return 0


def model_outputs(values, work, h, given):
    v, rows, parts, _ = _parts_of(values, work, given)
    at = rows[0]
    model, state, scratch, motions, speed = parts.model, parts.state, parts.scratch, parts.motions, v[at.speed]
    model.surface[0], model.surface[1] = v[at.friction_coefficient], v[at.friction_coefficient]
    if parts.begun[0] == 0.0:
        motion.place(model, state, motions, v[at.initial_z : at.initial_z + at.n_axles], v[at.initial_distance], speed)
        for axle in range(at.n_axles):
            i = model.wheelsets[axle]
            state.q[i, Axis.Y], state.q[i, Axis.ROLL] = v[at.initial_y + axle], v[at.initial_roll + axle]
            state.u[i, Axis.PITCH] = -speed / v[at.initial_radius + axle]
        parts.begun[0] = 1.0
    if motion.has_ended(parts.model, parts.state):
        return _ENDED
    motion.prepare_contacts(model, state, motions, scratch, speed)
    if h > 0.0:
        _take_forces(v, at, parts)
        motion.move(model, state, motions, scratch, h, speed)
        if not motion.is_near_track(parts.state):
            return _LOST
        motion.prepare_contacts(model, state, motions, scratch, speed)
    _report(v, at, parts)
    return 0


def model_difference(values, reference, given):
    return 1e-6


def entries() -> dict[str, Any]:
    """Return the functions of this kind (`kinds`), for vehicles of any size."""
    called_by_c = (model_memory, model_size, model_prepare, model_outputs, model_difference)
    return {function.__name__: function for function in called_by_c}
