"""Kernels that describe one patch in its own plane: separation, positions and creepages.

The contact frame is the track frame turned about x by the contact angle: t = (0, cos, sin) along the tangent, n = (0, -sin,
cos) from the wheel into the rail. Its origin, the reference point, lies on the rail; on the wheel it is the point opposite.
"""

import math

from contact._jit import kernel
from contact.geometry.curve import SLOPE, Y, Z, advance, at, hermite, least
from contact.geometry.search import (
    LOBE_AREA,
    LOBE_COS,
    LOBE_MOMENT,
    LOBE_SIN,
    LOBE_Y0,
    LOBE_Y1,
    combine,
    lobes,
    on_wheel,
)

# motion[...]: pose, velocity and sizes, right-side track coordinates
(
    POSE_Y,
    POSE_Z,
    POSE_ROLL,
    POSE_YAW,
    VEL_X,
    VEL_Y,
    VEL_Z,
    VEL_ROLL,
    VEL_YAW,
    VEL_SPIN,
    RAIL_Y,  # of the placed profile's origin [m]
    RAIL_Z,
    RAIL_ROLL,
    RAIL_VY,
    RAIL_VZ,
    RAIL_VROLL,
    RADIUS,  # nominal rolling radius [m]
    TAPE,  # distance of the tape circle from the wheelset's centre [m]
) = range(18)
N_MOTION = 18

# patch[...]: one patch in right-side track coordinates
(
    PATCH_ANGLE,
    PATCH_X,
    PATCH_Y,
    PATCH_Z,
    PATCH_RAIL_Y,  # profile coordinates
    PATCH_RAIL_Z,
    PATCH_WHEEL_Y,
    PATCH_WHEEL_Z,
    PATCH_RADIUS,
    PATCH_APPROACH,
    PATCH_VX,
    PATCH_VY,
    PATCH_PHI,
    PATCH_AREA,  # overlap of the undeformed profiles [m²]
    PATCH_FROM,  # edges of the overlap along t [m]
    PATCH_TO,
) = range(16)
N_PATCH = 16

# separation[ROW, sample]
SEP_Y, SEP_G, SEP_A, SEP_XC = range(4)
N_SEP_ROWS = 4

MARGIN, MARGIN_RATIO = 3e-3, 0.15  # samples extend beyond the overlap by this [m] and this part of its width
_STEEPEST = 0.17  # cosine of the largest angle between a surface and the contact plane, 80°
_OPENING = 1.0  # slope at which the gap opens where a profile or the patch's own range ends


@kernel
def _into_plane(curve, j: int, dz: float, y0: float, z0: float, c: float, s: float) -> tuple[float, float, float]:
    """Node j of a curve, lowered by dz, in the contact plane: coordinate, height along n, slope (huge when too steep)."""
    y, z, m = curve[Y, j] - y0, curve[Z, j] + dz - z0, curve[SLOPE, j]
    along = c + m * s
    if along * along < _STEEPEST**2 * (1.0 + m * m) or along < 0.0:
        return y * c + z * s, z * c - y * s, math.inf
    return y * c + z * s, z * c - y * s, (m * c - s) / along


@kernel
def _reach(curve, n_low: int, n_high: int, j: int, dz: float, frame, ahead: int, limit: float) -> int:
    """Last node from j on in the direction `ahead` (±1) that increases along the plane and lies within `limit`."""
    y0, z0, c, s = frame
    u, _, m = _into_plane(curve, j, dz, y0, z0, c, s)
    while n_low <= j + ahead < n_high and (limit - u) * ahead > 0.0:
        v, _, m = _into_plane(curve, j + ahead, dz, y0, z0, c, s)
        if math.isinf(m) or (v - u) * ahead <= 0.0:
            break
        j, u = j + ahead, v
    return j


@kernel
def _project(curve, low: int, high: int, dz: float, frame, out) -> int:
    """Nodes low … high of a curve in the contact plane, as a curve; returns their number."""
    y0, z0, c, s = frame
    k = 0
    for j in range(low, high + 1):
        u, v, m = _into_plane(curve, j, dz, y0, z0, c, s)
        if not math.isinf(m):
            out[Y, k], out[Z, k], out[SLOPE, k] = u, v, m
            k += 1
    return k


@kernel
def _least_gap(wheel, n_wheel: int, rail, n_rail: int, low: float, high: float) -> float:
    """Least gap rail minus wheel between `low` and `high`, where it is zero; both curves are in the contact plane."""
    lowest, i, j = 0.0, 0, advance(wheel, n_wheel, 0, low)
    i = advance(rail, n_rail, 0, low)
    u = low
    f, fm = at(rail, i, u)
    w, wm = at(wheel, j, u)
    g0, m0 = f - w, fm - wm
    while u < high:
        v = min(wheel[Y, j + 1], high) if j < n_wheel - 2 else high
        i = advance(rail, n_rail, i, v)
        f, fm = at(rail, i, v)
        w, wm = at(wheel, j, v)
        g1, m1 = f - w, fm - wm
        lowest = min(lowest, g1)
        if m0 < 0.0 < m1:
            t, g = least(g0, g1, m0, m1, v - u)
            if t > 0.0:
                lowest = min(lowest, g)
        u, g0, m0, j = v, g1, m1, j + 1
    return lowest


@kernel
def describe(line, start: int, end: int, placed, n_rail: int, lobe, before: float, after: float, motion, grid,
             wheel_plane, rail_plane, patch, separation) -> bool:  # fmt: skip
    """Fill `patch` and `separation` of one combined lobe; True when its overlap lies within the profiles' data.

    `before` and `after` bound the patch in track y where it has neighbours; `grid` holds prescribed sample positions, or is
    empty: then the samples spread over the overlap and a margin.
    """
    z = motion[POSE_Z]
    y0 = lobe[LOBE_MOMENT] / lobe[LOBE_AREA]
    angle = math.atan2(lobe[LOBE_SIN], lobe[LOBE_COS])
    i = advance(placed, n_rail, 0, y0)
    z0 = at(placed, i, y0)[0]
    c, s = math.cos(angle), math.sin(angle)
    frame = (y0, z0, c, s)
    patch[PATCH_ANGLE], patch[PATCH_AREA] = angle, lobe[LOBE_AREA]

    # the part of both curves that faces the plane, from the reference point outwards
    j = start
    while j < end - 2 and line[Y, j + 1] <= y0:
        j += 1
    span = 0.1
    n_wheel = _project(line, _reach(line, start, end, j, z, frame, -1, -span),
                       _reach(line, start, end, j, z, frame, 1, span), z, frame, wheel_plane)  # fmt: skip
    n_rail_plane = _project(placed, _reach(placed, 0, n_rail, i, 0.0, frame, -1, -span),
                            _reach(placed, 0, n_rail, i, 0.0, frame, 1, span), 0.0, frame, rail_plane)  # fmt: skip
    if n_wheel < 3 or n_rail_plane < 3:
        return False
    low = max(wheel_plane[Y, 0], rail_plane[Y, 0])
    high = min(wheel_plane[Y, n_wheel - 1], rail_plane[Y, n_rail_plane - 1])

    first, last = lobe[LOBE_Y0], lobe[LOBE_Y1]
    ends = (first, last, max(before, placed[Y, 0]), min(after, placed[Y, n_rail - 1]))
    u0, u1, bound_low, bound_high = 0.0, 0.0, low, high
    for k in range(4):  # where those y lie on the rail, along the plane
        i = advance(placed, n_rail, 0, ends[k])
        u = (ends[k] - y0) * c + (at(placed, i, ends[k])[0] - z0) * s
        if k == 0:
            u0 = max(u, low)
        elif k == 1:
            u1 = min(u, high)
        elif k == 2 and before > -math.inf:
            bound_low = max(bound_low, u)
        elif k == 3 and after < math.inf:
            bound_high = min(bound_high, u)
    if not u0 < u1:
        return False
    patch[PATCH_FROM], patch[PATCH_TO] = u0, u1
    patch[PATCH_APPROACH] = -_least_gap(wheel_plane, n_wheel, rail_plane, n_rail_plane, u0, u1)

    lx = -math.sin(motion[POSE_YAW]) * math.cos(motion[POSE_ROLL])
    ly, lz = math.cos(motion[POSE_YAW]) * math.cos(motion[POSE_ROLL]), math.sin(motion[POSE_ROLL])
    axle_y, axle_z = motion[POSE_Y], z - motion[RADIUS]

    # the reference point on the wheel
    j = advance(wheel_plane, n_wheel, 0, 0.0)
    height, slope = at(wheel_plane, j, 0.0)
    wheel_y, wheel_z = y0 - height * s, z0 + height * c
    px, d, r = on_wheel((slope * c + s) / (c - slope * s), wheel_y - axle_y, wheel_z - axle_z, lx, ly, lz)
    patch[PATCH_X], patch[PATCH_Y], patch[PATCH_Z] = px, y0, z0
    cr, sr = math.cos(motion[RAIL_ROLL]), math.sin(motion[RAIL_ROLL])
    ry, rz = y0 - motion[RAIL_Y], z0 - motion[RAIL_Z]
    patch[PATCH_RAIL_Y], patch[PATCH_RAIL_Z] = cr * ry + sr * rz, cr * rz - sr * ry
    patch[PATCH_WHEEL_Y], patch[PATCH_WHEEL_Z] = d - motion[TAPE], r - motion[RADIUS]
    patch[PATCH_RADIUS] = r

    # velocity of the wheel's point less that of the rail's (theory.md 9.4): v + Omega × p
    cy, sy = math.cos(motion[POSE_YAW]), math.sin(motion[POSE_YAW])
    wx = motion[VEL_ROLL] * cy + motion[VEL_SPIN] * lx
    wy = motion[VEL_ROLL] * sy + motion[VEL_SPIN] * ly
    wz = motion[VEL_YAW] + motion[VEL_SPIN] * lz
    py, pz = wheel_y - axle_y, wheel_z - axle_z
    rail_vy = motion[RAIL_VY] - motion[RAIL_VROLL] * (wheel_z - motion[RAIL_Z])
    rail_vz = motion[RAIL_VZ] + motion[RAIL_VROLL] * (wheel_y - motion[RAIL_Y])
    vx = motion[VEL_X] + wy * pz - wz * py
    vy = motion[VEL_Y] + wz * px - wx * pz - rail_vy
    vz = motion[VEL_Z] + wx * py - wy * px - rail_vz
    speed = motion[VEL_X]
    patch[PATCH_VX] = vx / speed
    patch[PATCH_VY] = (vy * c + vz * s) / speed
    patch[PATCH_PHI] = (wz * c - wy * s) / speed

    margin = MARGIN + MARGIN_RATIO * (u1 - u0)
    n = separation.shape[1]
    sample_low, sample_high = max(bound_low, u0 - margin), min(bound_high, u1 + margin)
    i, j = 0, 0
    for k in range(n):
        u = grid[k] if grid.size == n else sample_low + (sample_high - sample_low) * k / (n - 1)
        v = min(max(u, bound_low), bound_high)
        i, j = advance(rail_plane, n_rail_plane, i, v), advance(wheel_plane, n_wheel, j, v)
        height, slope = at(wheel_plane, j, v)
        track_slope = (slope * c + s) / (c - slope * s)
        x, d, r = on_wheel(track_slope, y0 + v * c - height * s - axle_y, z0 + v * s + height * c - axle_z, lx, ly, lz)
        g = at(rail_plane, i, v)[0] - height + patch[PATCH_APPROACH]
        separation[SEP_Y, k] = u
        separation[SEP_G, k] = max(g, 0.0) + _OPENING * abs(u - v)
        # curvature of the ring, cos/(2 r), seen along the plane's normal instead of its own (theory.md 3.4)
        separation[SEP_A, k] = 0.5 / r * math.sqrt((1.0 + slope * slope) / (1.0 + track_slope * track_slope))
        separation[SEP_XC, k] = x - px
    return True


@kernel
def describe_all(line, start: int, end: int, placed, lobe, distance: float, angle: float, motion, grid,
                 wheel_plane, rail_plane, patches, separations) -> int:  # fmt: skip
    """All patches at the pose in `motion`, from the field side to the flange; returns their number."""
    n = combine(lobe, lobes(line, start, end, motion[POSE_Z], lobe), distance, angle)
    found = 0
    for k in range(n - 1, -1, -1):
        before = 0.5 * (lobe[k - 1, LOBE_Y1] + lobe[k, LOBE_Y0]) if k > 0 else -math.inf
        after = 0.5 * (lobe[k, LOBE_Y1] + lobe[k + 1, LOBE_Y0]) if k < n - 1 else math.inf
        found += describe(line, start, end, placed, placed.shape[1], lobe[k], before, after, motion, grid,
                          wheel_plane, rail_plane, patches[found], separations[found])  # fmt: skip
    return found
