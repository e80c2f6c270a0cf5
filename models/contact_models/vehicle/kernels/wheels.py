"""Kernel of the contacts of all wheels: from the motion of axles and rails to forces, power and energy (vehicle.md, 3)."""

from __future__ import annotations

import math

from contact.core import entry, kernel
from contact.kernels.arrays import PairArrays, Search, SurfaceSearch
from contact.kernels.enumerations import Status
from contact.kernels.flexible import solve_rigid
from contact.kernels.geometry.search import axle
from .between import count_around, expect, keep_solution, take_expected
from .frames import linear, place_on, smooth
from .layout import ELASTIC, TO_LEFT, Axis, Book, Model, Scratch, Seat, State, Sum, TrackFrame, TrackRow, Wheel, Wheels
from .wheel_arrays import WheelArrays, arrays_of


@kernel
def fill_inputs(model, state, s, motions, scratch):
    """Fill the inputs of every contact: motion of axle and rail, and friction (`scratch.given`, `scratch.seats`).

    `motions` are the constants of the pairs, records MOTION.
    """
    track = model.track
    for axle_number in range(model.wheelsets.size):
        i = model.wheelsets[axle_number]
        q, u, gain = state.q[i], state.u[i], state.gains[axle_number]
        k, d, width = place_on(track, s + model.bodies[i].place)
        t, ramp = d / width, scratch.frames[i, TrackFrame.RATE_X]
        for side in range(2):
            w, row = 2 * axle_number + side, side * TO_LEFT
            rail, given, here, motion = state.rails[axle_number, side], scratch.given[w], scratch.seats[w], motions[w]
            y, along_y = smooth(track, TrackRow.RIGHT_Y + row, k, t, width)
            z, along_z = smooth(track, TrackRow.RIGHT_Z + row, k, t, width)
            here.along_y, here.along_z = along_y, along_z
            here.friction = linear(track, TrackRow.RIGHT_FRICTION + row, k, t) * model.surface[0]
            here.kinetic = linear(track, TrackRow.RIGHT_FRICTION + row, k, t) * model.surface[1]
            given.y, given.z, given.roll, given.yaw = q[Axis.Y], q[Axis.Z], q[Axis.ROLL], q[Axis.YAW] - along_y
            # velocities are those of half a step before: contacts are solved for where they will be at the positions
            given.vx = u[Axis.X] + 0.5 * gain[Axis.X]
            given.vy = u[Axis.Y] + 0.5 * gain[Axis.Y]
            given.vz = u[Axis.Z] + 0.5 * gain[Axis.Z]
            given.roll_rate = u[Axis.ROLL] + 0.5 * gain[Axis.ROLL]
            given.yaw_rate = u[Axis.YAW] + 0.5 * gain[Axis.YAW]
            given.spin = u[Axis.PITCH] + 0.5 * gain[Axis.PITCH]
            given.rail_y, given.rail_z, given.rail_roll = y + rail[0], z + rail[1], 0.0
            given.rail_vy, given.rail_vz = given.vx * along_y + rail[2], given.vx * along_z + rail[3]
            # on a ramp of the cant the rails climb: as if they turned with the frame
            given.rail_roll_rate = ramp
            given.rail_vy -= ramp * (motion.origin_z + given.rail_z)
            given.rail_vz += ramp * (motion.mirror * motion.origin_y + given.rail_y)


@entry
def solve_contact(arrays: PairArrays[SurfaceSearch], here: Seat, wheel: Wheel) -> int:
    """Solve the contact of one wheel for the inputs of `fill_inputs`. Fill `wheel`; return as `solve_pair`."""
    case = arrays.case[0]
    case.mu, case.kinetic, case.speed = here.friction, here.kinetic, abs(arrays.given[0].vx)
    n = solve_rigid(arrays)
    if n >= 0:
        report_wheel(arrays, n, wheel)
    return n


@kernel
def solve_wheel(wheel_arrays, scratch, w):
    """Solve the contact of wheel `w`; see `solve_contact`."""
    return solve_contact(arrays_of(wheel_arrays, scratch.given, w), scratch.seats[w], scratch.wheels[w])


@entry
def follow_wheel(wheel_arrays: WheelArrays[Search], scratch: Scratch, w: int) -> int:
    """Fill the forces of wheel `w`: from the last solution of its contact if that is near enough, else by `solve_wheel`.

    ``wheel_arrays.settings[w].distance`` is the distance of this step whose damage is counted [m]. A solution counts for the
    steps around it. Returns as `solve_wheel`.
    """
    last, given, wheel, setting = wheel_arrays.last, scratch.given[w], scratch.wheels[w], wheel_arrays.settings[w]
    if last.limits[0] <= 1.0:
        return solve_wheel(wheel_arrays, scratch, w)
    total, n_before, rolled = wheel_arrays.totals[w], int(wheel.patches), setting.distance
    arrays = arrays_of(wheel_arrays, scratch.given, w)
    near = expect(last, w, given, scratch.seats[w].friction, arrays, arrays.contacts, share_of_stick(total), n_before)
    if near and take_expected(last, w, rolled, wheel):
        return n_before
    setting.distance = count_around(last, w, rolled)
    n = solve_wheel(wheel_arrays, scratch, w)
    setting.distance = rolled
    if n >= 0:
        keep_solution(last, w, given, wheel, near and n == n_before)
    return n


@kernel
def solve_contacts(wheel_arrays, scratch):
    """Fill the forces of all wheels, each by `follow_wheel`.

    Return 0, or minus the number, from 1 on, of the wheel whose contact has no solution.
    """
    for w in range(scratch.wheels.size):
        if follow_wheel(wheel_arrays, scratch, w) < 0:
            return -1 - w
    return 0


@kernel
def add_wheel_forces(model, state, motions, scratch):
    """Add the forces of all wheels, `scratch.wheels`, to those of their axles, and their power and energy to the step's."""
    power = scratch.power
    for w in range(scratch.wheels.size):
        i = model.wheelsets[w // 2]
        q, forces, wheel, here = state.q[i], scratch.forces[i], scratch.wheels[w], scratch.seats[w]
        yaw = scratch.given[w].yaw
        # creepages refer to this speed, so that times the dissipation per metre is the power
        speed = max(abs(state.u[i, Axis.X]), motions[w].slowest)
        Fx, Fy, Fz = wheel.longitudinal, wheel.lateral, -wheel.vertical
        Mx, My, Mz = wheel.moment_x, wheel.moment_y, wheel.moment_z
        lx, ly, lz = axle(q[Axis.ROLL], yaw)
        climbing = Mx + q[Axis.Y] * Fz - (q[Axis.Z] - motions[w].radius) * Fy
        slope = scratch.frames[i, TrackFrame.CANT_SLOPE]
        forces[Axis.X] += Fx - Fy * here.along_y - Fz * here.along_z - slope * climbing
        forces[Axis.Y] += Fy
        forces[Axis.Z] += Fz
        forces[Axis.ROLL] += Mx * math.cos(yaw) + My * math.sin(yaw)
        forces[Axis.PITCH] += lx * Mx + ly * My + lz * Mz
        forces[Axis.YAW] += Mz
        power[1] += speed * wheel.dissipation
        power[2] += wheel.elastic


@kernel
def share_of_stick(total):
    """Return the share of the area of all patches that sticks, 1 without any."""
    return 1.0 - total.slip_area / total.area if total.area > 0.0 else 1.0


@kernel
def report_wheel(arrays, n, wheel):
    """Fill forces, power and energy of one wheel from its `n` patches."""
    total, largest = arrays.total[0], 0
    wheel.longitudinal, wheel.lateral, wheel.vertical = total.Fx, total.Fy, -total.Fz
    wheel.moment_x, wheel.moment_y, wheel.moment_z = total.Mx, total.My, total.Mz
    wheel.T_gamma, wheel.pmax = total.T_gamma, total.pmax
    wheel.patches, wheel.status = float(n), float(total.status)
    wheel.normal, wheel.dissipation, wheel.elastic = total.N, 0.0, 0.0
    for c in range(n):
        contact = arrays.contacts[c]
        wheel.elastic += ELASTIC * contact.N * contact.approach
        wheel.dissipation -= (
            contact.Fx * contact.longitudinal + contact.Fy * contact.lateral + contact.Mz * contact.spin
        )
        largest = c if contact.N > arrays.contacts[largest].N else largest
    contact = arrays.contacts[largest]
    wheel.angle, wheel.creep_x, wheel.creep_y = contact.angle, contact.longitudinal, contact.lateral
    wheel.spin = contact.spin


@entry
def count(model: Model, state: State, wheels: Wheels, most: float) -> None:
    """Count impacts (rises above `most` static loads), lifted wheels and untrustworthy contacts; add to the sums."""
    books = state.books
    for w in range(wheels.size):
        before, now = state.loads[w // 2, w % 2], wheels[w].normal
        high = most * model.bodies[model.wheelsets[w // 2]].load
        if now > high and before <= high:
            books[Book.IMPACTS] += 1.0
        if now <= 0.0 and before > 0.0:
            books[Book.LIFTED] += 1.0
        if wheels[w].status >= Status.OUT_OF_RANGE.value:
            books[Book.UNTRUSTED] += 1.0
        state.loads[w // 2, w % 2] = now
        sums, wheel = state.sums[w], wheels[w]
        if sums[Sum.STEPS] == 0.0:
            sums[Sum.LEAST_LATERAL], sums[Sum.LARGEST_LATERAL] = wheel.lateral, wheel.lateral
            sums[Sum.LEAST_VERTICAL], sums[Sum.LARGEST_VERTICAL] = wheel.vertical, wheel.vertical
        sums[Sum.LEAST_LATERAL] = min(sums[Sum.LEAST_LATERAL], wheel.lateral)
        sums[Sum.LARGEST_LATERAL] = max(sums[Sum.LARGEST_LATERAL], wheel.lateral)
        sums[Sum.LEAST_VERTICAL] = min(sums[Sum.LEAST_VERTICAL], wheel.vertical)
        sums[Sum.LARGEST_VERTICAL] = max(sums[Sum.LARGEST_VERTICAL], wheel.vertical)
        sums[Sum.STEPS] += 1.0
        sums[Sum.LATERAL] += wheel.lateral
        sums[Sum.VERTICAL] += wheel.vertical
        sums[Sum.LONGITUDINAL] += wheel.longitudinal
        sums[Sum.T_GAMMA] += wheel.T_gamma
        sums[Sum.DISSIPATION] += wheel.dissipation


@kernel
def advance_rails(model, state, wheels, h):
    """Advance the rails by `h` [s], their dampers implicitly. Return the energy spent in them [J]."""
    m, ky, cy, kz, cz = model.rail[0], model.rail[1], model.rail[2], model.rail[3], model.rail[4]
    if m <= 0.0:
        return 0.0
    spent = 0.0
    for w in range(wheels.size):
        rail, load = state.rails[w // 2, w % 2], model.bodies[model.wheelsets[w // 2]].load
        vy = (rail[2] + h * (-wheels[w].lateral - ky * rail[0]) / m) / (1.0 + h * cy / m)
        vz = (rail[3] + h * (wheels[w].vertical - load - kz * rail[1]) / m) / (1.0 + h * cz / m)
        spent += 0.5 * h * (cy * vy * (vy + rail[2]) + cz * vz * (vz + rail[3]))
        rail[2], rail[3] = vy, vz
        rail[0] += h * vy
        rail[1] += h * vz
    return spent


@kernel
def rail_energy(model, state):
    """Return kinetic and elastic energy of the rails, with that of their static load [J]."""
    kinetic, elastic = 0.0, 0.0
    if model.rail[0] > 0.0:
        for w in range(2 * model.wheelsets.size):
            rail = state.rails[w // 2, w % 2]
            kinetic += 0.5 * model.rail[0] * (rail[2] * rail[2] + rail[3] * rail[3])
            elastic += 0.5 * (model.rail[1] * rail[0] * rail[0] + model.rail[3] * rail[1] * rail[1])
            elastic += model.bodies[model.wheelsets[w // 2]].load * rail[1]
    return kinetic, elastic
