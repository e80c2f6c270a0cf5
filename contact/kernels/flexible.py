"""A wheel that is displaced and turned against its wheelset by the flexibility of axle and web (other_wheels.md).

The datum Q of a wheel lies on the axle, at its tape circle. Without flexibility Q = C + t l, with the wheelset's centre C, the
direction l of the axle and t = ± the distance of the tape circle. The flexible wheel has Q' = Q + d and the axle direction l'
of the angles roll + δroll and yaw + δyaw. A wheel is a body of revolution, so it has the same contact as the wheel of a rigid
wheelset with the centre C' = Q + d - t l' and these angles.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import PairArrays, Search, SurfaceSearch
from contact.kernels.elastic_rail import solve_on_rail
from contact.kernels.enumerations import Height, NoAnswer
from contact.kernels.geometry.search import axle
from contact.kernels.pair import solve_briefly
from contact.kernels.records import LARGEST_ANGLE


@kernel
def _turning(roll, yaw, roll_rate, yaw_rate):
    """Return the rate of the direction of the axle [1/s], the derivative of `axle`."""
    by_roll, by_yaw = math.sin(roll) * roll_rate, math.cos(roll) * yaw_rate
    x = math.sin(yaw) * by_roll - math.cos(yaw) * by_yaw
    y = -math.cos(yaw) * by_roll - math.sin(yaw) * by_yaw
    return x, y, math.cos(roll) * roll_rate


@kernel
def displace(given, offset, tape, displaced):
    """Fill `displaced` with the motion of the rigid wheelset that has this wheel. Return C' - C [m]."""
    displaced[0] = given
    moved = displaced[0]
    moved.roll, moved.yaw = given.roll + offset.roll, given.yaw + offset.yaw
    moved.roll_rate, moved.yaw_rate = given.roll_rate + offset.roll_rate, given.yaw_rate + offset.yaw_rate
    moved.spin = given.spin + offset.pitch_rate
    ax, ay, az = axle(given.roll, given.yaw)
    bx, by, bz = axle(moved.roll, moved.yaw)
    dx, dy, dz = offset.x + tape * (ax - bx), offset.y + tape * (ay - by), offset.z + tape * (az - bz)
    moved.y, moved.z = given.y + dy, given.z + dz
    ax, ay, az = _turning(given.roll, given.yaw, given.roll_rate, given.yaw_rate)
    bx, by, bz = _turning(moved.roll, moved.yaw, moved.roll_rate, moved.yaw_rate)
    moved.vx = given.vx + offset.x_rate + tape * (ax - bx)
    moved.vy = given.vy + offset.y_rate + tape * (ay - by)
    moved.vz = given.vz + offset.z_rate + tape * (az - bz)
    return dx, dy, dz


@kernel
def reflect(given, offset):
    """Reflect the motion of a wheelset and the offset of its wheel in the plane across the track, x to -x.

    A wheel that rolls backwards is one that rolls forwards in that mirror.
    """
    given.yaw, given.yaw_rate, given.spin, given.vx = -given.yaw, -given.yaw_rate, -given.spin, -given.vx
    offset.x, offset.pitch, offset.yaw = -offset.x, -offset.pitch, -offset.yaw
    offset.x_rate, offset.pitch_rate, offset.yaw_rate = -offset.x_rate, -offset.pitch_rate, -offset.yaw_rate


@kernel
def _reflect_answer(n, contacts, total):
    """Reflect the forces, moments and creepages of `n` patches likewise."""
    total.Fx, total.My, total.Mz = -total.Fx, -total.My, -total.Mz
    for k in range(n):
        contact = contacts[k]
        contact.x, contact.pitch = -contact.x, -contact.pitch
        contact.Fx, contact.My, contact.Mz = -contact.Fx, -contact.My, -contact.Mz
        contact.longitudinal, contact.spin = -contact.longitudinal, -contact.spin


@kernel
def turn_memory(memory, backwards):
    """Forget the last solution if it rolled in the other direction. Backwards its number of patches is kept as negative."""
    if (memory[0] < 0.0) != backwards:
        memory[:] = 0.0
    memory[0] = abs(memory[0])


@kernel
def solve_flexible(mode, amount, arrays):
    """As `_solve_forwards`, also for a wheelset that rolls backwards on a rail that is constant along the track."""
    return _solve_either_way(mode, amount, False, arrays)


@kernel
def solve_rigid(arrays):
    """As `solve_flexible` at a given height, undisplaced on a rigid rail, with what `solve_briefly` gives."""
    given = arrays.given[0]
    if abs(given.roll) > LARGEST_ANGLE or abs(given.yaw) > LARGEST_ANGLE:
        return NoAnswer.TURNED.value
    return _solve_either_way(Height.GIVEN.value, 0.0, True, arrays)


@kernel
def _solve_either_way(mode, amount, rigid, arrays):
    """Solve as `solve_flexible` or, if all is `rigid`, as `solve_rigid`."""
    memory, given = arrays.memory, arrays.given[0]
    backwards = given.vx < 0.0
    turn_memory(memory, backwards)
    if backwards:
        reflect(given, arrays.offset[0])
    code = solve_briefly(given, arrays) if rigid else _solve_forwards(mode, amount, given, arrays)
    if not backwards:
        return code
    reflect(given, arrays.offset[0])
    _reflect_answer(max(code, 0), arrays.contacts, arrays.total[0])
    memory[0] = -memory[0]
    return code


@kernel
def _solve_forwards(mode, amount, given, arrays):
    """As `solve_on_rail`, for the wheel with the displacement `arrays.offset` against its wheelset.

    Moment and height are those of the wheelset. Without displacement the results are those of `solve_on_rail`, bit for bit.
    """
    motion, total = arrays.search.motion[0], arrays.total[0]
    x, y, z = displace(given, arrays.offset[0], motion.mirror * motion.tape, arrays.displaced)
    moved = arrays.displaced[0]
    if abs(moved.roll) > LARGEST_ANGLE or abs(moved.yaw) > LARGEST_ANGLE:
        return NoAnswer.TURNED.value
    station = motion.station
    motion.station = station + x
    code = solve_on_rail(mode, amount, moved, arrays)
    motion.station = station
    total.Mx += y * total.Fz - z * total.Fy
    total.My += z * total.Fx - x * total.Fz
    total.Mz += x * total.Fy - y * total.Fx
    total.z -= z
    return code


@entry
def solve_on_profiles(mode: int, amount: float, arrays: PairArrays[Search]) -> int:
    """As `solve_flexible`, of constant profiles."""
    return solve_flexible(mode, amount, arrays)


@entry
def solve_on_surfaces(mode: int, amount: float, arrays: PairArrays[SurfaceSearch]) -> int:
    """As `solve_flexible`, of surfaces that change along the way."""
    return solve_flexible(mode, amount, arrays)
