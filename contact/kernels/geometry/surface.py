"""Patches between two surfaces: the frame of each, its separation as strips, its creepages."""

import math

from contact.core import kernel
from contact.kernels.arrays import SurfaceSearch
from contact.kernels.geometry import grids, regions
from contact.kernels.geometry.curve import Array, Record
from contact.kernels.geometry.frame import slip
from contact.kernels.geometry.parabolas import fit_rows
from contact.kernels.geometry.search import axle, combine, join, shared, size_of, untie
from contact.kernels.geometry.section import AWAY, Frame, about_x, column, tilted
from contact.kernels.rows import Box, Over, Sep

Paths = tuple[int, int, int, int]

_ROOM_X, _ROOM_Y = 0.15, 0.35  # of its length and width, by which samples extend beyond the overlap
_DEEPER = 1.3  # depth up to which grids are laid, over that of the pose
_LEAST_DEPTH = 5e-6  # [m] least depth for which they are, times `size_of`
_AGAIN = 0.2  # share of their depth below which they are laid anew


@kernel
def _same_place(a: Record, b: Record) -> bool:
    """Return whether two motions differ at most in z and in velocities."""
    wheel = a.y == b.y and a.roll == b.roll and a.yaw == b.yaw and a.rotation == b.rotation and a.radius == b.radius
    rail = a.rail_y == b.rail_y and a.rail_z == b.rail_z and a.rail_roll == b.rail_roll and a.station == b.station
    return wheel and rail


@kernel
def begin(space: SurfaceSearch) -> tuple[bool, float]:
    """Search the surfaces at the pose. Return whether they lie above each other, and z [m] at first touch."""
    motion, last, notes = space.motion[0], space.motion[1], space.boxes[0]
    motion.z = 0.0
    if not abs(motion.rail_z) < AWAY:  # heights that far away count as absent, or overflow
        return False, 0.0
    if not _same_place(motion, last) or notes[Box.ROUGH] != notes[Box.FIRST]:
        last.radius = 0.0
        if not regions.scan(space):
            return False, 0.0
        notes[Box.TOUCH] = regions.touch(space)
        notes[Box.FIRST] = notes[Box.ROUGH]
        space.motion[1] = motion
    notes[Box.LAID] = -math.inf
    return True, notes[Box.TOUCH]


@kernel
def renew(space: SurfaceSearch) -> None:
    """Forget the grids that were laid or refined for other heights."""
    begin(space)


@kernel
def _lay_for(z: float, space: SurfaceSearch) -> None:
    """Lay grids over the regions of overlap at the height z, unless those that are there serve."""
    notes = space.boxes[0]
    depth, laid = z - notes[Box.TOUCH], notes[Box.LAID] - notes[Box.TOUCH]
    if depth > laid or depth < _AGAIN * laid:
        space.motion[0].z = 0.0
        regions.lay_fine(notes[Box.TOUCH] + max(_DEEPER * depth, _LEAST_DEPTH * size_of(space.motion[0])), space)


@kernel
def _sample(
    x: tuple[float, float], y: tuple[float, float], frame: Frame, limits: Paths, space: SurfaceSearch, out: Array
) -> float:
    """Fill the gap `space.h` at `space.x` over a range of a frame, Y and TILT of `out`. Return the least gap [m]."""
    h, at, to = space.h, space.x, space.column
    n_y, n_x = h.shape
    dy = (y[1] - y[0]) / (n_y - 1)
    first, dx = grids.aligned(x[0] + frame[0], x[1] + frame[0], n_x, space.motion[0].station, space.rail)
    first -= frame[0]
    surfaces, rows = (space.wheel, space.rail), (y[0], dy, n_y, True)
    for k in range(n_x):
        column(first + k * dx, rows, limits, frame, surfaces, space.motion[0], space.section, to)
        for i in range(n_y):
            h[i, k], at[i, k] = to[Over.GAP, i], to[Over.WHEEL_X, i] if to[Over.GAP, i] < AWAY else first + k * dx
        if k == n_x // 2:
            for i in range(n_y):
                a, b = max(i - 1, 0), min(i + 1, n_y - 1)
                there = to[Over.GAP, a] < AWAY and to[Over.GAP, b] < AWAY
                rise = to[Over.RAIL, b] + to[Over.WHEEL, b] - to[Over.RAIL, a] - to[Over.WHEEL, a]
                out[Sep.Y, i] = y[0] + i * dy
                out[Sep.TILT, i] = 0.5 * rise / ((b - a) * dy) if there else 0.0
    return regions.least_gap(h)[0]


@kernel
def _heights_at_origin(frame: Frame, limits: Paths, space: SurfaceSearch) -> tuple[float, float]:
    """Return the heights of rail and wheel over the origin of a frame [m]; AWAY or -AWAY where they are absent."""
    surfaces, to = (space.wheel, space.rail), space.column
    column(0.0, (0.0, 1.0, 1, True), limits, frame, surfaces, space.motion[0], space.section, to)
    return to[Over.RAIL, 0], to[Over.WHEEL, 0]


@kernel
def _on_wheel(motion: Record, x: float, y: float, z: float) -> tuple[float, float]:
    """Return the distance of a point along the axle and from it [m]."""
    lx, ly, lz = axle(motion.roll, motion.yaw)
    px, py, pz = x, y - motion.y, z - motion.z + motion.radius
    d = px * lx + py * ly + pz * lz
    return d, math.sqrt(max(px * px + py * py + pz * pz - d * d, 0.0))


@kernel
def _positions(motion: Record, frame: Frame, depth: float, patch: Record) -> None:
    """Fill reference point, opposite point of the wheel (`depth` [m] along the normal) and creepages of a patch.

    The creepages, and the forces, are those at the depth `patch.approach`, as in `frame.positions`.
    """
    patch.x, patch.y, patch.z = frame[0] + patch.approach * frame[9], frame[1], frame[2]
    cos_roll, sin_roll = math.cos(motion.rail_roll), math.sin(motion.rail_roll)
    rail_y, rail_z = frame[1] - motion.rail_y, frame[2] - motion.rail_z
    patch.rail_y = cos_roll * rail_y + sin_roll * rail_z
    patch.rail_z = cos_roll * rail_z - sin_roll * rail_y
    d, r = _on_wheel(motion, frame[0] + depth * frame[9], frame[1] + depth * frame[10], frame[2] + depth * frame[11])
    patch.wheel_y, patch.wheel_z = d - motion.tape, r - motion.radius
    y, z = frame[1] + patch.approach * frame[10], frame[2] + patch.approach * frame[11]
    patch.point_y, patch.point_z = y, z
    _, patch.radius = _on_wheel(motion, patch.x, y, z)
    slip(motion, frame[3:], patch.x, y, z, patch)


@kernel
def _describe(z: float, lobe: Record, neighbours: tuple[float, float], k: int, space: SurfaceSearch) -> bool:
    """Fill patch and separation `k` of one combined lobe. Return False if the bodies do not overlap in its frame.

    `neighbours` are the bounds of the patch in track y [m]. They are infinite on a side without neighbour.
    """
    motion, patch, out = space.motion[0], space.patches[k], space.separations[k]
    x, y = lobe.moment_x / lobe.weight, lobe.moment / lobe.weight
    angle = math.atan2(lobe.sine, lobe.cosine)
    pitch = math.atan2(lobe.slant, math.sqrt(lobe.sine**2 + lobe.cosine**2)) if motion.tilted else 0.0
    along, across = _ROOM_X * (lobe.x_high - lobe.x_low), _ROOM_Y * (lobe.high - lobe.low)
    origin = about_x(x, y, 0.0, 0.0)
    limits = grids.limits_of(
        (lobe.x_low - x - along, lobe.x_high - x + along),
        (lobe.low - y - across, lobe.high - y + across),
        origin,
        space,
    )
    height = _heights_at_origin(origin, limits, space)[0]
    if height >= AWAY:  # in a notch of the surface
        height = 0.5 * (lobe.low_z + lobe.high_z)
    frame = tilted(x, y, height, angle, pitch) if motion.tilted else about_x(x, y, height, angle)
    c, s = math.cos(angle), math.sin(angle)
    low = (lobe.low - y) * c + (lobe.low_z - height) * s
    high = (lobe.high - y) * c + (lobe.high_z - height) * s
    back, front = lobe.x_low - x, lobe.x_high - x
    across = _ROOM_Y * (high - low)
    y_low, y_high = low - across, high + across
    if neighbours[0] > -math.inf:
        y_low = max(y_low, (neighbours[0] - y) * c + (lobe.low_z - height) * s)
    if neighbours[1] < math.inf:
        y_high = min(y_high, (neighbours[1] - y) * c + (lobe.high_z - height) * s)
    if not y_low < y_high or not back < front:
        return False
    least = _sample((back - along, front + along), (y_low, y_high), frame, limits, space, out)
    if not least < 0.0:
        return False
    patch.angle, patch.pitch, patch.low, patch.high, patch.load = angle, pitch, low, high, 0.0
    patch.back, patch.front = back - lobe.step_x, front + lobe.step_x
    patch.left, patch.right = low - lobe.step_y, high + lobe.step_y
    patch.approach = -least
    for i in range(space.h.shape[0]):
        for j in range(space.h.shape[1]):
            if space.h[i, j] < AWAY:
                space.h[i, j] -= least
    patch.fit_error = fit_rows(space.h, space.x, -least, front - back + 2.0 * along, size_of(motion), out)
    wheel = _heights_at_origin(frame, limits, space)[1]
    _positions(motion, frame, wheel if wheel > -AWAY else 0.0, patch)
    return True


@kernel
def describe_at(z: float, space: SurfaceSearch) -> int:
    """Set motion.z to z, describe all patches there, from the field side to the flange, and return their number.

    While lobes pass from a common plane to planes of their own, they are described in both, with shares
    (`search.combine`). Lobes further apart than the limit of distance never share a plane, whatever their angle, because a
    strip is one parabola.
    """
    motion, lobe = space.motion[0], space.lobes
    _lay_for(z, space)
    n = regions.lobes(z, space)
    motion.z = z
    n = combine(lobe, n, motion.combine_distance, -1.0, motion.most_patches)
    untie(lobe, n, space.patches.size)
    count, spare = 0, lobe.size - 1
    for last in range(n - 1, -1, -1):
        for first in range(last, -1, -1):
            share = shared(lobe, n, first, last)
            if share <= 0.0:
                continue
            lobe[spare] = lobe[first]
            for k in range(first + 1, last + 1):
                join(lobe[k], lobe[spare])
            before, after = -math.inf, math.inf
            if first > 0 and lobe[first].low > lobe[first - 1].high:
                before = 0.5 * (lobe[first - 1].high + lobe[first].low)
            if last < n - 1 and lobe[last + 1].low > lobe[last].high:
                after = 0.5 * (lobe[last].high + lobe[last + 1].low)
            if _describe(z, lobe[spare], (before, after), count, space):
                space.patches[count].share = share
                count += 1
    return count
