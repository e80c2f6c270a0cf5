"""Kernels that describe one patch in its own plane: separation, positions and creepages.

The contact frame is the track frame turned about x by the contact angle; its z axis points from the wheel into the rail. Its
origin, the reference point, lies on the rail; on the wheel it is the point opposite, along the normal.
"""

import math

from contact._jit import kernel
from contact.kernels.geometry.curve import Array, Record, advance, at
from contact.kernels.geometry.plane import Frame, along, normal_gap, project, spread, track_slope
from contact.kernels.geometry.search import axle, combine, lobes, on_wheel
from contact.kernels.layout import Curve, Sep
from contact.kernels.memory import Search

MARGIN = 3e-3  # [m] by which samples extend beyond the interpenetration: the room of a second difference there
_OPENING = 1.0  # slope at which the gap opens where a profile, or the patch's own range, ends


@kernel
def creepages(motion: Record, frame: Frame, x: float, y: float, z: float, patch: Record) -> None:
    """Creepages at the wheel's point (x, y, z): its velocity v + Omega × p less the rail's, over V (theory.md 9.4)."""
    lx, ly, lz = axle(motion.roll, motion.yaw)
    wx = motion.roll_rate * math.cos(motion.yaw) + motion.spin * lx
    wy = motion.roll_rate * math.sin(motion.yaw) + motion.spin * ly
    wz = motion.yaw_rate + motion.spin * lz
    py, pz = y - motion.y, z - motion.z + motion.radius
    vx = motion.vx + wy * pz - wz * py
    vy = motion.vy + wz * x - wx * pz - motion.rail_vy + motion.rail_roll_rate * (z - motion.rail_z)
    vz = motion.vz + wx * py - wy * x - motion.rail_vz - motion.rail_roll_rate * (y - motion.rail_y)
    c, s = frame[2], frame[3]
    patch.vx = vx / motion.vx
    patch.vy = (vy * c + vz * s) / motion.vx
    patch.phi = (wz * c - wy * s) / motion.vx  # the rail's roll rate is about x, across the normal


@kernel
def positions(motion: Record, frame: Frame, wheel: Array, n_wheel: int, patch: Record) -> None:
    """Where the reference point is, on the rail and opposite on the wheel, with the creepages there."""
    y0, z0, c, s = frame
    height, slope = at(wheel, advance(wheel, n_wheel, 0, 0.0), 0.0)
    y, z = y0 - height * s, z0 + height * c
    lx, ly, lz = axle(motion.roll, motion.yaw)
    py, pz = y - motion.y, z - motion.z + motion.radius
    x, d, r = on_wheel(track_slope(frame, slope), py, pz, lx, ly, lz)
    patch.x, patch.y, patch.z = x, y0, z0
    patch.point_y, patch.point_z = y, z
    cos_roll, sin_roll = math.cos(motion.rail_roll), math.sin(motion.rail_roll)
    rail_y, rail_z = y0 - motion.rail_y, z0 - motion.rail_z
    patch.rail_y = cos_roll * rail_y + sin_roll * rail_z
    patch.rail_z = cos_roll * rail_z - sin_roll * rail_y
    patch.wheel_y, patch.wheel_z = d - motion.tape, r - motion.radius
    patch.radius = r
    creepages(motion, frame, x, y, z, patch)


@kernel
def sample(
    frame: Frame, n_wheel: int, n_rail: int, low: float, high: float, patch: Record, out: Array, space: Search
) -> None:
    """Fill the separation: at the positions `grid`, or, when that is empty, over low … high, dense where the gap is small.

    Beyond low … high, where a profile or the patch's own range ends, the gap opens at 45°.
    """
    y0, z0, c, s = frame
    motion, grid, wheel, rail = space.motion[0], space.grid, space.wheel_plane, space.rail_plane
    lx, ly, lz = axle(motion.roll, motion.yaw)
    if grid.size > 0:
        for i in range(grid.size):
            out[Sep.Y, i] = grid[i]
    else:
        spread(wheel, n_wheel, low, high, out[Sep.Y])
    i, j = 0, 0
    for k in range(out.shape[1]):
        u = out[Sep.Y, k]
        v = min(max(u, low), high)
        i, j = advance(rail, n_rail, i, v), advance(wheel, n_wheel, j, v)
        height, slope = at(wheel, j, v)
        tilt = track_slope(frame, slope)
        py = y0 + v * c - height * s - motion.y
        pz = z0 + v * s + height * c - motion.z + motion.radius
        x, _, r = on_wheel(tilt, py, pz, lx, ly, lz)
        rail_height, rail_slope = at(rail, i, v)
        gap = rail_height - height + patch.approach
        out[Sep.G, k] = max(gap, 0.0) + _OPENING * abs(u - v)
        # curvature cos/(2 r) of the ring along its own normal, seen along the plane's: cos(angle)/(2 r cos(angle - plane))
        out[Sep.A, k] = 0.5 / r * math.sqrt((1.0 + slope * slope) / (1.0 + tilt * tilt))
        out[Sep.XC, k] = x - patch.x
        out[Sep.TILT, k] = 0.5 * (slope + rail_slope)


@kernel
def describe(
    first_node: int, start: int, end: int, lobe: Record, neighbours: tuple[float, float], k: int, space: Search
) -> bool:
    """Fill patch and separation `k` of one combined lobe. Return False when too little of the profiles faces its plane.

    `neighbours` bound the patch in track y; infinite where it has none.
    """
    before, after = neighbours
    line, placed, grid, motion = space.line, space.placed, space.grid, space.motion[0]
    wheel, rail, patch = space.wheel_plane, space.rail_plane, space.patches[k]
    y0 = lobe.moment / lobe.weight
    angle = math.atan2(lobe.sine, lobe.cosine)
    n_placed = placed.shape[1]
    centre = advance(placed, n_placed, 0, y0)
    frame = (y0, at(placed, centre, y0)[0], math.cos(angle), math.sin(angle))

    # the edges of the interpenetration lie on both curves; the middles between neighbours are taken on the rail
    i = advance(placed, n_placed, 0, lobe.low)
    first = along(frame, lobe.low, at(placed, i, lobe.low)[0])
    i = advance(placed, n_placed, i, lobe.high)
    last = along(frame, lobe.high, at(placed, i, lobe.high)[0])
    low, high = first - MARGIN, last + MARGIN
    if grid.size > 0:
        low, high = min(low, grid[0]), max(high, grid[grid.size - 1])
    if before > -math.inf:
        low = max(low, along(frame, before, at(placed, advance(placed, n_placed, 0, before), before)[0]))
    if after < math.inf:
        high = min(high, along(frame, after, at(placed, advance(placed, n_placed, 0, after), after)[0]))

    j = start
    while j < end - 2 and line[Curve.Y, j + 1] <= y0:
        j += 1
    n_wheel, low, high = project(line, (first_node, line.shape[1], j), motion.z, frame, low, high, wheel)
    n_rail, low, high = project(placed, (0, n_placed, centre), 0.0, frame, low, high, rail)
    first, last = max(first, low), min(last, high)
    if n_wheel < 3 or n_rail < 3 or not first < last:
        return False

    patch.angle, patch.low, patch.high, patch.load = angle, first, last, 0.0
    patch.approach = -normal_gap(wheel, n_wheel, rail, n_rail, first, last)
    positions(motion, frame, wheel, n_wheel, patch)
    sample(frame, n_wheel, n_rail, low, high, patch, space.separations[k], space)
    return True


@kernel
def describe_all(first_node: int, start: int, end: int, space: Search) -> int:
    """Describe all patches at the pose in `space.motion`, from the field side to the flange; return their number."""
    motion, lobe = space.motion[0], space.lobes
    n = lobes(space.line, start, end, motion.z, lobe)
    n = combine(lobe, n, motion.combine_distance, motion.combine_angle, motion.most_patches)
    found = 0
    for k in range(n - 1, -1, -1):
        before = 0.5 * (lobe[k - 1].high + lobe[k].low) if k > 0 else -math.inf
        after = 0.5 * (lobe[k].high + lobe[k + 1].low) if k < n - 1 else math.inf
        if describe(first_node, start, end, lobe[k], (before, after), found, space):
            found += 1
    return found
