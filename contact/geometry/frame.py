"""Kernels that describe one patch in its own plane: separation, positions and creepages.

The contact frame is the track frame turned about x by the contact angle; its z axis points from the wheel into the rail. Its
origin, the reference point, lies on the rail; on the wheel it is the point opposite, along the normal.
"""

import math

from contact._jit import kernel
from contact.geometry.curve import Array, Y, advance, at
from contact.geometry.layout import (
    COMBINE_ANGLE,
    COMBINE_DISTANCE,
    LOBE_COS,
    LOBE_MOMENT,
    LOBE_SIN,
    LOBE_WEIGHT,
    LOBE_Y0,
    LOBE_Y1,
    MOST_PATCHES,
    PATCH_ANGLE,
    PATCH_APPROACH,
    PATCH_FROM,
    PATCH_LOAD,
    PATCH_PHI,
    PATCH_POINT_Y,
    PATCH_POINT_Z,
    PATCH_RADIUS,
    PATCH_RAIL_Y,
    PATCH_RAIL_Z,
    PATCH_TO,
    PATCH_VX,
    PATCH_VY,
    PATCH_WHEEL_Y,
    PATCH_WHEEL_Z,
    PATCH_X,
    PATCH_Y,
    PATCH_Z,
    POSE_ROLL,
    POSE_Y,
    POSE_YAW,
    POSE_Z,
    RADIUS,
    RAIL_ROLL,
    RAIL_VROLL,
    RAIL_VY,
    RAIL_VZ,
    RAIL_Y,
    RAIL_Z,
    SEP_A,
    SEP_G,
    SEP_TILT,
    SEP_XC,
    SEP_Y,
    TAPE,
    VEL_ROLL,
    VEL_SPIN,
    VEL_X,
    VEL_Y,
    VEL_YAW,
    VEL_Z,
)
from contact.geometry.plane import Frame, along, normal_gap, project, spread, track_slope
from contact.geometry.search import axle, combine, lobes, on_wheel

MARGIN = 3e-3  # [m] by which samples extend beyond the interpenetration: the room of a second difference there
_OPENING = 1.0  # slope at which the gap opens where a profile, or the patch's own range, ends


@kernel
def creepages(motion: Array, frame: Frame, x: float, y: float, z: float, patch: Array) -> None:
    """Creepages at the wheel's point (x, y, z): its velocity v + Omega × p less the rail's, over V (theory.md 9.4)."""
    lx, ly, lz = axle(motion[POSE_ROLL], motion[POSE_YAW])
    wx = motion[VEL_ROLL] * math.cos(motion[POSE_YAW]) + motion[VEL_SPIN] * lx
    wy = motion[VEL_ROLL] * math.sin(motion[POSE_YAW]) + motion[VEL_SPIN] * ly
    wz = motion[VEL_YAW] + motion[VEL_SPIN] * lz
    py, pz = y - motion[POSE_Y], z - motion[POSE_Z] + motion[RADIUS]
    vx = motion[VEL_X] + wy * pz - wz * py
    vy = motion[VEL_Y] + wz * x - wx * pz - motion[RAIL_VY] + motion[RAIL_VROLL] * (z - motion[RAIL_Z])
    vz = motion[VEL_Z] + wx * py - wy * x - motion[RAIL_VZ] - motion[RAIL_VROLL] * (y - motion[RAIL_Y])
    c, s = frame[2], frame[3]
    patch[PATCH_VX] = vx / motion[VEL_X]
    patch[PATCH_VY] = (vy * c + vz * s) / motion[VEL_X]
    patch[PATCH_PHI] = (wz * c - wy * s) / motion[VEL_X]  # the rail's roll rate is about x, across the normal


@kernel
def positions(motion: Array, frame: Frame, wheel: Array, n_wheel: int, patch: Array) -> None:
    """Where the reference point is, on the rail and opposite on the wheel, with the creepages there."""
    y0, z0, c, s = frame
    height, slope = at(wheel, advance(wheel, n_wheel, 0, 0.0), 0.0)
    y, z = y0 - height * s, z0 + height * c
    lx, ly, lz = axle(motion[POSE_ROLL], motion[POSE_YAW])
    py, pz = y - motion[POSE_Y], z - motion[POSE_Z] + motion[RADIUS]
    x, d, r = on_wheel(track_slope(frame, slope), py, pz, lx, ly, lz)
    patch[PATCH_X], patch[PATCH_Y], patch[PATCH_Z] = x, y0, z0
    patch[PATCH_POINT_Y], patch[PATCH_POINT_Z] = y, z
    cos_roll, sin_roll = math.cos(motion[RAIL_ROLL]), math.sin(motion[RAIL_ROLL])
    rail_y, rail_z = y0 - motion[RAIL_Y], z0 - motion[RAIL_Z]
    patch[PATCH_RAIL_Y] = cos_roll * rail_y + sin_roll * rail_z
    patch[PATCH_RAIL_Z] = cos_roll * rail_z - sin_roll * rail_y
    patch[PATCH_WHEEL_Y], patch[PATCH_WHEEL_Z] = d - motion[TAPE], r - motion[RADIUS]
    patch[PATCH_RADIUS] = r
    creepages(motion, frame, x, y, z, patch)


@kernel
def sample(
    motion: Array,
    frame: Frame,
    wheel: Array,
    n_wheel: int,
    rail: Array,
    n_rail: int,
    low: float,
    high: float,
    grid: Array,
    patch: Array,
    out: Array,
) -> None:
    """Fill the separation: at the positions `grid`, or, when that is empty, over low … high, dense where the gap is small.

    Beyond low … high, where a profile or the patch's own range ends, the gap opens at 45°.
    """
    y0, z0, c, s = frame
    lx, ly, lz = axle(motion[POSE_ROLL], motion[POSE_YAW])
    if grid.size > 0:
        for i in range(grid.size):
            out[SEP_Y, i] = grid[i]
    else:
        spread(wheel, n_wheel, low, high, out[SEP_Y])
    i, j = 0, 0
    for k in range(out.shape[1]):
        u = out[SEP_Y, k]
        v = min(max(u, low), high)
        i, j = advance(rail, n_rail, i, v), advance(wheel, n_wheel, j, v)
        height, slope = at(wheel, j, v)
        tilt = track_slope(frame, slope)
        py = y0 + v * c - height * s - motion[POSE_Y]
        pz = z0 + v * s + height * c - motion[POSE_Z] + motion[RADIUS]
        x, _, r = on_wheel(tilt, py, pz, lx, ly, lz)
        rail_height, rail_slope = at(rail, i, v)
        gap = rail_height - height + patch[PATCH_APPROACH]
        out[SEP_G, k] = max(gap, 0.0) + _OPENING * abs(u - v)
        # curvature cos/(2 r) of the ring along its own normal, seen along the plane's: cos(angle)/(2 r cos(angle - plane))
        out[SEP_A, k] = 0.5 / r * math.sqrt((1.0 + slope * slope) / (1.0 + tilt * tilt))
        out[SEP_XC, k] = x - patch[PATCH_X]
        out[SEP_TILT, k] = 0.5 * (slope + rail_slope)


@kernel
def describe(
    line: Array,
    first_node: int,
    start: int,
    end: int,
    placed: Array,
    lobe: Array,
    before: float,
    after: float,
    motion: Array,
    grid: Array,
    wheel: Array,
    rail: Array,
    patch: Array,
    separation: Array,
) -> bool:
    """Fill `patch` and `separation` of one combined lobe; False when too little of the profiles faces its plane.

    `before` and `after` bound the patch in track y where it has neighbours; `wheel` and `rail` are work arrays.
    """
    y0 = lobe[LOBE_MOMENT] / lobe[LOBE_WEIGHT]
    angle = math.atan2(lobe[LOBE_SIN], lobe[LOBE_COS])
    n_placed = placed.shape[1]
    centre = advance(placed, n_placed, 0, y0)
    frame = (y0, at(placed, centre, y0)[0], math.cos(angle), math.sin(angle))

    # the edges of the interpenetration lie on both curves; the middles between neighbours are taken on the rail
    i = advance(placed, n_placed, 0, lobe[LOBE_Y0])
    first = along(frame, lobe[LOBE_Y0], at(placed, i, lobe[LOBE_Y0])[0])
    i = advance(placed, n_placed, i, lobe[LOBE_Y1])
    last = along(frame, lobe[LOBE_Y1], at(placed, i, lobe[LOBE_Y1])[0])
    low, high = first - MARGIN, last + MARGIN
    if grid.size > 0:
        low, high = min(low, grid[0]), max(high, grid[grid.size - 1])
    if before > -math.inf:
        low = max(low, along(frame, before, at(placed, advance(placed, n_placed, 0, before), before)[0]))
    if after < math.inf:
        high = min(high, along(frame, after, at(placed, advance(placed, n_placed, 0, after), after)[0]))

    j = start
    while j < end - 2 and line[Y, j + 1] <= y0:
        j += 1
    n_wheel, low, high = project(line, first_node, line.shape[1], j, motion[POSE_Z], frame, low, high, wheel)
    n_rail, low, high = project(placed, 0, n_placed, centre, 0.0, frame, low, high, rail)
    first, last = max(first, low), min(last, high)
    if n_wheel < 3 or n_rail < 3 or not first < last:
        return False

    patch[PATCH_ANGLE], patch[PATCH_FROM], patch[PATCH_TO], patch[PATCH_LOAD] = angle, first, last, 0.0
    patch[PATCH_APPROACH] = -normal_gap(wheel, n_wheel, rail, n_rail, first, last)
    positions(motion, frame, wheel, n_wheel, patch)
    sample(motion, frame, wheel, n_wheel, rail, n_rail, low, high, grid, patch, separation)
    return True


@kernel
def describe_all(
    line: Array,
    first_node: int,
    start: int,
    end: int,
    placed: Array,
    lobe: Array,
    motion: Array,
    grid: Array,
    wheel: Array,
    rail: Array,
    patches: Array,
    separations: Array,
) -> int:
    """All patches at the pose in `motion`, from the field side to the flange; returns their number."""
    n = lobes(line, start, end, motion[POSE_Z], lobe)
    n = combine(lobe, n, motion[COMBINE_DISTANCE], motion[COMBINE_ANGLE], int(motion[MOST_PATCHES]))
    found = 0
    for k in range(n - 1, -1, -1):
        before = 0.5 * (lobe[k - 1, LOBE_Y1] + lobe[k, LOBE_Y0]) if k > 0 else -math.inf
        after = 0.5 * (lobe[k, LOBE_Y1] + lobe[k + 1, LOBE_Y0]) if k < n - 1 else math.inf
        if describe(
            line, first_node, start, end, placed, lobe[k], before, after, motion, grid, wheel, rail,
            patches[found], separations[found],
        ):  # fmt: skip
            found += 1
    return found
