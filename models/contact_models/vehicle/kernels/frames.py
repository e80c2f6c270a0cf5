"""Kernels of the track frames at the bodies, and of the motion in them (vehicle.md, 1 and 2)."""

from __future__ import annotations

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers
from .layout import Axis, Body, Model, TrackFrame, TrackRow


@kernel
def member(v, j):
    """Return v[j] of three numbers. An index that varies into a tuple could raise an exception."""
    if j == 0:
        return v[0]
    return v[1] if j == 1 else v[2]


@kernel
def place_on(track, s):
    """Return the number of the place before `s` [m], the distance from it and that to the next place [m].

    Beyond the ends the last interval counts.
    """
    n = track.shape[1]
    first = track[TrackRow.PLACE, 0]
    width = (track[TrackRow.PLACE, n - 1] - first) / (n - 1)
    k = math.floor((s - first) / width)
    k = min(max(k, 0), n - 2)
    return k, s - first - k * width, width


@kernel
def linear(track, row, k, t):
    """Return the value of a row, interpolated linearly at the share t of the interval k."""
    return track[row, k] + t * (track[row, k + 1] - track[row, k])


@kernel
def smooth(track, row, k, t, width):
    """Return value and slope of a row, interpolated by a cubic with the slopes of the row after it."""
    a, b, ma, mb = track[row, k], track[row, k + 1], width * track[row + 1, k], width * track[row + 1, k + 1]
    second, third = 3.0 * (b - a) - 2.0 * ma - mb, 2.0 * (a - b) + ma + mb
    return a + t * (ma + t * (second + t * third)), (ma + t * (2.0 * second + 3.0 * t * third)) / width


@entry
def speed_at(track: Matrix, s: float) -> float:
    """Return the speed [m/s] that is given at `s` [m]."""
    k, d, width = place_on(track, s)
    return linear(track, TrackRow.SPEED, k, d / width)


@entry
def lay_frames(model: Model, s: float, speed: float, frames: Matrix) -> None:
    """Fill the frames of all bodies, of which that of the reference is at `s` [m]."""
    track, bodies = model.track, model.bodies
    for i in range(bodies.size):
        k, d, width = place_on(track, s + bodies[i].place)
        t = d / width
        direction, curvature = track[TrackRow.DIRECTION, k], track[TrackRow.CURVATURE, k]
        growth = (track[TrackRow.CURVATURE, k + 1] - curvature) / width
        c, sn = math.cos(direction), math.sin(direction)
        ahead, aside = d, d * d * (0.5 * curvature + growth * d / 6.0)
        frame = frames[i]
        frame[TrackFrame.X] = track[TrackRow.X, k] + c * ahead - sn * aside
        frame[TrackFrame.Y] = track[TrackRow.Y, k] + sn * ahead + c * aside
        direction += d * (curvature + 0.5 * growth * d)
        cant, cant_slope = smooth(track, TrackRow.CANT, k, t, width)
        turning = speed * (curvature + growth * d)
        frame[TrackFrame.DIRECTION], frame[TrackFrame.CANT], frame[TrackFrame.CANT_SLOPE] = direction, cant, cant_slope
        frame[TrackFrame.COS], frame[TrackFrame.SIN] = math.cos(direction), math.sin(direction)
        frame[TrackFrame.COS_CANT], frame[TrackFrame.SIN_CANT] = math.cos(cant), math.sin(cant)
        frame[TrackFrame.RATE_X] = speed * cant_slope
        frame[TrackFrame.RATE_Y] = turning * frame[TrackFrame.SIN_CANT]
        frame[TrackFrame.RATE_Z] = turning * frame[TrackFrame.COS_CANT]


@entry
def carried(frame: Numbers, body: Body, q: Numbers, speed: float, axis: int) -> float:
    """Return the absolute velocity along or about `axis` of a body that stands still in its frame."""
    x, y, z = q[Axis.X], q[Axis.Y], q[Axis.Z] - body.height
    wx, wy, wz = frame[TrackFrame.RATE_X], frame[TrackFrame.RATE_Y], frame[TrackFrame.RATE_Z]
    if axis == Axis.X:
        return speed + wy * z - wz * y
    if axis == Axis.Y:
        return wz * x - wx * z
    if axis == Axis.Z:
        return wx * y - wy * x
    if axis == Axis.ROLL:
        return wx
    return wy if axis == Axis.PITCH else wz


@kernel
def drift(frames, bodies, q, u, speed, h):
    """Advance the coordinates by `h` [s]. The angle of a wheelset about its axle is not counted."""
    for i in range(bodies.size):
        body = bodies[i]
        before = (
            carried(frames[i], body, q[i], speed, 0),
            carried(frames[i], body, q[i], speed, 1),
            carried(frames[i], body, q[i], speed, 2),
            carried(frames[i], body, q[i], speed, 3),
            carried(frames[i], body, q[i], speed, 4),
            carried(frames[i], body, q[i], speed, 5),
        )
        for j in range(6):
            if body.held[j] == 0 and not (body.wheelset != 0 and j == Axis.PITCH):
                q[i, j] += h * (u[i, j] - (member(before[:3], j) if j < 3 else member(before[3:], j - 3)))


@kernel
def gyrate(frames, bodies, u, forces):
    """Add the forces of gravity and those by which the frames turn (2, 3). Return nothing."""
    for i in range(bodies.size):
        body, frame = bodies[i], frames[i]
        m, ix, iy, iz = body.mass, body.inertia[0], body.inertia[1], body.inertia[2]
        wx, wy, wz = frame[TrackFrame.RATE_X], frame[TrackFrame.RATE_Y], frame[TrackFrame.RATE_Z]
        ux, uy, uz = u[i, Axis.X], u[i, Axis.Y], u[i, Axis.Z]
        forces[i, Axis.X] -= m * (wy * uz - wz * uy)
        forces[i, Axis.Y] -= m * (wz * ux - wx * uz)
        forces[i, Axis.Z] -= m * (wx * uy - wy * ux)
        rx, ry, rz = u[i, Axis.ROLL], u[i, Axis.PITCH], u[i, Axis.YAW]
        if body.wheelset != 0:  # axes that follow the axle but not its spin
            forces[i, Axis.ROLL] -= wy * iz * rz - rz * iy * ry
            forces[i, Axis.YAW] -= rx * iy * ry - wy * ix * rx
        else:
            forces[i, Axis.ROLL] -= (iz - iy) * ry * rz
            forces[i, Axis.PITCH] -= (ix - iz) * rz * rx
            forces[i, Axis.YAW] -= (iy - ix) * rx * ry
