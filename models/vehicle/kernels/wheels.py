"""Kernel of the contacts of all wheels: from the motion of axles and rails to forces, power and energy (docs/vehicle.md, 3)."""

from __future__ import annotations

import math

from contact._jit import kernel
from contact.kernels.enumerations import Height, Status
from contact.kernels.geometry.search import axle
from contact.kernels.pair import solve_pair
from models.vehicle.kernels.benches import bench_of
from models.vehicle.kernels.frames import linear, place_on, smooth
from models.vehicle.kernels.layout import TO_LEFT, Axis, Book, Frame, Row, Sum

#: Share of load times approach that a contact stores: exact for an elliptic one.
_ELASTIC = 0.4


@kernel
def press(model, state, s, benches, scratch):
    """Add the forces of all wheels to those of their axles; fill `scratch.wheels`.

    Returns 0, or the number of the wheel from 1 on whose contact has no answer, negative.
    """
    track, given, total_power = model.track, scratch.given[0], scratch.power
    for axle_number in range(model.wheelsets.size):
        i = model.wheelsets[axle_number]
        q, u, forces = state.q[i], state.u[i], scratch.forces[i]
        k, d = place_on(track, model.spacing, s + model.bodies[i].place)
        t, ramp = d / model.spacing[0], scratch.frames[i, Frame.RATE_X]
        for side in range(2):
            w, row = 2 * axle_number + side, side * TO_LEFT
            rail = state.rails[axle_number, side]
            y, along_y = smooth(track, Row.RIGHT_Y + row, k, t, model.spacing[0])
            z, along_z = smooth(track, Row.RIGHT_Z + row, k, t, model.spacing[0])
            yaw = q[Axis.YAW] - along_y
            given.y, given.z, given.roll, given.yaw = q[Axis.Y], q[Axis.Z], q[Axis.ROLL], yaw
            given.vx, given.vy, given.vz = u[Axis.X], u[Axis.Y], u[Axis.Z]
            given.roll_rate, given.yaw_rate, given.spin = u[Axis.ROLL], u[Axis.YAW], u[Axis.PITCH]
            bench = bench_of(benches, w)
            motion = bench.search.motion[0]
            given.rail_y, given.rail_z, given.rail_roll = y + rail[0], z + rail[1], 0.0
            given.rail_vy, given.rail_vz = u[Axis.X] * along_y + rail[2], u[Axis.X] * along_z + rail[3]
            # on a ramp of the cant the rails climb: as if they turned with the frame
            given.rail_roll_rate = ramp
            given.rail_vy -= ramp * (motion.origin_z + given.rail_z)
            given.rail_vz += ramp * (motion.mirror * motion.origin_y + given.rail_y)
            case, factor = bench.case[0], linear(track, Row.RIGHT_FRICTION + row, k, t)
            case.mu, case.kinetic, case.speed = factor * model.surface[0], factor * model.surface[1], u[Axis.X]
            n = solve_pair(Height.GIVEN.value, 0.0, given, bench)
            if n < 0:
                return -1 - w
            total = bench.total[0]
            lx, ly, lz = axle(q[Axis.ROLL], yaw)
            climbing = total.Mx + q[Axis.Y] * total.Fz - (q[Axis.Z] - motion.radius) * total.Fy
            forces[Axis.X] += total.Fx - total.Fy * along_y - total.Fz * along_z - ramp / u[Axis.X] * climbing
            forces[Axis.Y] += total.Fy
            forces[Axis.Z] += total.Fz
            forces[Axis.ROLL] += total.Mx * math.cos(yaw) + total.My * math.sin(yaw)
            forces[Axis.PITCH] += lx * total.Mx + ly * total.My + lz * total.Mz
            forces[Axis.YAW] += total.Mz
            _report(bench, n, u[Axis.X], scratch.wheels[w])
            total_power[1] += u[Axis.X] * scratch.wheels[w].dissipation
            for c in range(n):
                contact = bench.contacts[c]
                total_power[2] += _ELASTIC * contact.N * contact.approach
    return 0


@kernel
def _report(bench, n, speed, wheel):
    """Fill what one wheel does."""
    total, largest = bench.total[0], 0
    wheel.longitudinal, wheel.lateral, wheel.vertical = total.Fx, total.Fy, -total.Fz
    wheel.T_gamma, wheel.pmax = total.T_gamma, total.pmax
    wheel.patches, wheel.status = float(n), float(total.status)
    wheel.normal, wheel.dissipation = 0.0, 0.0
    for c in range(n):
        contact = bench.contacts[c]
        wheel.normal += contact.N
        wheel.dissipation -= (
            contact.Fx * contact.longitudinal + contact.Fy * contact.lateral + contact.Mz * contact.spin
        )
        largest = c if contact.N > bench.contacts[largest].N else largest
    contact = bench.contacts[largest]
    wheel.angle, wheel.creep_x, wheel.creep_y = contact.angle, contact.longitudinal, contact.lateral
    wheel.spin = contact.spin


@kernel
def count(model, state, wheels, most):
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
        sums[Sum.STEPS] += 1.0
        sums[Sum.LATERAL] += wheel.lateral
        sums[Sum.VERTICAL] += wheel.vertical
        sums[Sum.LONGITUDINAL] += wheel.longitudinal
        sums[Sum.T_GAMMA] += wheel.T_gamma
        sums[Sum.DISSIPATION] += wheel.dissipation


@kernel
def sink(model, state, wheels, h):
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
