"""Kernels of springs, dampers and stops between two bodies (vehicle.md, 4).

The axes of an element are fixed in its first body, a. Place and velocity of the other end are exact for any turn of one
track frame against the other, and linear in the angles of a body in its frame. Forces and moments are the transpose of the
velocities, so an element neither makes nor loses energy but in its dampers.
"""

from __future__ import annotations

import math

from contact.core import kernel
from .frames import member
from .layout import Axis, Kind, TrackFrame


@kernel
def tie(links, frames):
    """Fill rotation and offset of all links: frame b as seen from frame a."""
    for k in range(links.size):
        link = links[k]
        a, b = frames[link.a], frames[link.b]
        c = a[TrackFrame.COS] * b[TrackFrame.COS] + a[TrackFrame.SIN] * b[TrackFrame.SIN]
        s = b[TrackFrame.SIN] * a[TrackFrame.COS] - b[TrackFrame.COS] * a[TrackFrame.SIN]
        ca, sa, cb, sb = a[TrackFrame.COS_CANT], a[TrackFrame.SIN_CANT], b[TrackFrame.COS_CANT], b[TrackFrame.SIN_CANT]
        turn, offset = link.turn, link.offset
        turn[0, 0], turn[0, 1], turn[0, 2] = c, -s * cb, s * sb
        turn[1, 0], turn[1, 1], turn[1, 2] = ca * s, ca * c * cb + sa * sb, -ca * c * sb + sa * cb
        turn[2, 0], turn[2, 1], turn[2, 2] = -sa * s, -sa * c * cb + ca * sb, sa * c * sb + ca * cb
        x, y = b[TrackFrame.X] - a[TrackFrame.X], b[TrackFrame.Y] - a[TrackFrame.Y]
        ahead, aside = a[TrackFrame.COS] * x + a[TrackFrame.SIN] * y, a[TrackFrame.COS] * y - a[TrackFrame.SIN] * x
        offset[0], offset[1], offset[2] = ahead, ca * aside, -sa * aside


@kernel
def _turned(q, body, arm):
    """Return an arm that turns with its body. The boxes of a wheelset do not turn with its spin."""
    roll, pitch, yaw = q[Axis.ROLL], q[Axis.PITCH], q[Axis.YAW]
    if body.wheelset != 0:
        pitch = 0.0
    x, y, z = arm[0], arm[1], arm[2]
    return x + pitch * z - yaw * y, y + yaw * x - roll * z, z + roll * y - pitch * x


@kernel
def _velocity(u, body, arm):
    """Return the velocity of the end of an arm."""
    wx, wy, wz = u[Axis.ROLL], u[Axis.PITCH], u[Axis.YAW]
    if body.wheelset != 0:
        wy = 0.0
    x, y, z = arm
    return u[Axis.X] + wy * z - wz * y, u[Axis.Y] + wz * x - wx * z, u[Axis.Z] + wx * y - wy * x


@kernel
def _push(forces, body, arm, force, sign):
    """Add the force at the end of an arm to the generalised forces of its body."""
    fx, fy, fz = sign * force[0], sign * force[1], sign * force[2]
    x, y, z = arm
    forces[Axis.X] += fx
    forces[Axis.Y] += fy
    forces[Axis.Z] += fz
    forces[Axis.ROLL] += y * fz - z * fy
    if body.wheelset == 0:
        forces[Axis.PITCH] += z * fx - x * fz
    forces[Axis.YAW] += x * fy - y * fx


@kernel
def _into_a(turn, v):
    """Return a vector of frame b along the axes of frame a."""
    return (
        turn[0, 0] * v[0] + turn[0, 1] * v[1] + turn[0, 2] * v[2],
        turn[1, 0] * v[0] + turn[1, 1] * v[1] + turn[1, 2] * v[2],
        turn[2, 0] * v[0] + turn[2, 1] * v[1] + turn[2, 2] * v[2],
    )


@kernel
def _into_b(turn, v):
    """Return a vector of frame a along the axes of frame b."""
    return (
        turn[0, 0] * v[0] + turn[1, 0] * v[1] + turn[2, 0] * v[2],
        turn[0, 1] * v[0] + turn[1, 1] * v[1] + turn[2, 1] * v[2],
        turn[0, 2] * v[0] + turn[1, 2] * v[1] + turn[2, 2] * v[2],
    )


@kernel
def _back(q, body, v):
    """Return a vector of the frame along the axes of the body; the transpose of `_turned`."""
    roll, pitch, yaw = q[Axis.ROLL], q[Axis.PITCH], q[Axis.YAW]
    if body.wheelset != 0:
        pitch = 0.0
    x, y, z = v
    return x - pitch * z + yaw * y, y - yaw * x + roll * z, z - roll * y + pitch * x


@kernel
def _stop(table, first, end, deformation):
    """Return force and energy of a stop at a deformation of either sign. Beyond the table its last slope goes on."""
    d, energy, k = abs(deformation), 0.0, first
    while k < end - 2 and table[0, k + 1] < d:
        energy += 0.5 * (table[1, k] + table[1, k + 1]) * (table[0, k + 1] - table[0, k])
        k += 1
    slope = (table[1, k + 1] - table[1, k]) / (table[0, k + 1] - table[0, k])
    beyond = max(d - table[0, k], 0.0)
    force = table[1, k] + slope * beyond
    return math.copysign(force, deformation), energy + beyond * (table[1, k] + 0.5 * slope * beyond)


@kernel
def pull(model, state, h, scratch):
    """Add the forces of all elements, their damping power [W] and their elastic energy [J]. Series elements advance by `h`."""
    bodies, q, u = model.bodies, state.q, state.u
    frames, forces, power = scratch.frames, scratch.forces, scratch.power
    tie(model.links, frames)
    for e in range(model.elements.size):
        element = model.elements[e]
        link = model.links[element.link]
        a, b, turn, offset = link.a, link.b, link.turn, link.offset
        arm_a, arm_b = _turned(q[a], bodies[a], element.on_a), _turned(q[b], bodies[b], element.on_b)
        end = _into_a(
            turn, (q[b, Axis.X] + arm_b[0], q[b, Axis.Y] + arm_b[1], q[b, Axis.Z] + arm_b[2] - bodies[b].height)
        )
        x, y, z = (
            end[0] + offset[0] - q[a, Axis.X],
            end[1] + offset[1] - q[a, Axis.Y],
            end[2] + offset[2] - q[a, Axis.Z],
        )
        reach = (x, y, z + bodies[a].height)  # from the centre of gravity of a to the end on b
        d = _back(q[a], bodies[a], (reach[0] - arm_a[0], reach[1] - arm_a[1], reach[2] - arm_a[2]))
        of_b, of_a = _into_a(turn, _velocity(u[b], bodies[b], arm_b)), _velocity(u[a], bodies[a], reach)
        rate = _back(q[a], bodies[a], (of_b[0] - of_a[0], of_b[1] - of_a[1], of_b[2] - of_a[2]))
        if element.kind == Kind.STOP:
            side, energy = _stop(model.table, element.table, element.table_end, d[1])
            force = (0.0, side, 0.0)
            power[2] += energy
        elif element.kind == Kind.SERIES:
            force = (
                _series(element, state.inner[e], 0, d[0], h, power),
                _series(element, state.inner[e], 1, d[1], h, power),
                _series(element, state.inner[e], 2, d[2], h, power),
            )
        else:
            k, c, f = element.stiffness, element.damping, element.preload
            force = (
                f[0] + k[0] * d[0] + c[0] * rate[0],
                f[1] + k[1] * d[1] + c[1] * rate[1],
                f[2] + k[2] * d[2] + c[2] * rate[2],
            )
            for j in range(3):
                rate_j, d_j = member(rate, j), member(d, j)
                power[0] += c[j] * rate_j * rate_j
                power[2] += (f[j] + 0.5 * k[j] * d_j) * d_j
            if element.turning[0] + element.turning[1] + element.turning[2] > 0.0:
                _turn(element, link, frames, q, forces, power)
        pulled = _turned(q[a], bodies[a], force)
        _push(forces[a], bodies[a], reach, pulled, 1.0)
        _push(forces[b], bodies[b], arm_b, _into_b(turn, pulled), -1.0)


@kernel
def _series(element, inner, j, d, h, power):
    """Return the force of a spring in series with a damper along one axis; the damper by the implicit Euler rule."""
    k, c = element.stiffness[j], element.damping[j]
    if k <= 0.0:
        return 0.0
    rate = h * k / c
    inner[j] = (inner[j] + rate * d) / (1.0 + rate)
    force = k * (d - inner[j])
    power[0] += force * force / c
    power[2] += 0.5 * force * force / k
    return force


@kernel
def _turn(element, link, frames, q, forces, power):
    """Add the moments of springs about the axes."""
    a, b, turn = link.a, link.b, link.turn
    roll = q[b, Axis.ROLL] + frames[b, TrackFrame.CANT] - q[a, Axis.ROLL] - frames[a, TrackFrame.CANT]
    pitch = q[b, Axis.PITCH] - q[a, Axis.PITCH]
    yaw = q[b, Axis.YAW] + frames[b, TrackFrame.DIRECTION] - q[a, Axis.YAW] - frames[a, TrackFrame.DIRECTION]
    k = element.turning
    moment = (k[0] * roll, k[1] * pitch, k[2] * yaw)
    power[2] += 0.5 * (moment[0] * roll + moment[1] * pitch + moment[2] * yaw)
    back = _into_b(turn, moment)
    for j in range(3):
        forces[a, Axis.ROLL + j] += member(moment, j)
        forces[b, Axis.ROLL + j] -= member(back, j)
