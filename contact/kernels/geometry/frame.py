"""Kernels that describe one patch in its own plane: separation, positions and creepages.

The contact frame is the track frame turned about x by the contact angle. Its z axis points from the wheel into the
rail. Its origin, the reference point, lies on the rail. The corresponding point of the wheel lies opposite, along the
normal.
"""

import math

from contact.core import kernel
from contact.kernels.arrays import Search
from contact.kernels.geometry.beside import fit_beside, share_beside
from contact.kernels.geometry.curve import Array, Record, advance, at, segment
from contact.kernels.geometry.plane import Frame, along, normal_gap, project, spread, track_slope
from contact.kernels.geometry.search import axle, combine, join, lobes, on_wheel, shared, size_of, untie
from contact.kernels.records import SLOWEST
from contact.kernels.rows import Curve, Sep

Direction = tuple[float, float, float]
Axes = tuple[float, float, float, float, float, float, float, float, float]

#: Length [m], times `size_of`, and share of the interpenetration by which samples extend beyond it, the greater of both. It is
#: enough for the second difference there (`normal.curvature`).
_MARGIN, _MARGIN_SHARE = 3e-3, 0.15
_ARM = 0.2e-3  # [m], times `size_of`, to both sides of a point: the curvature of the trace line is taken over it
_MOST = 0.8  # upper limit of k s²/a in `half_curvature`; only noise of a profile exceeds it
_OPENING = 1.0  # slope at which the gap opens where a profile, or the patch's own range, ends


@kernel
def _motion_at(motion: Record, x: float, y: float, z: float) -> tuple[float, float, float, float, float, float]:
    """Return the velocity of the wheel's point (x, y, z) minus that of the rail there, and the wheel's turning (theory.md 9.4).

    The velocity is v + Omega × p. All components are in track coordinates.
    """
    lx, ly, lz = axle(motion.roll, motion.yaw)
    wx = motion.roll_rate * math.cos(motion.yaw) + motion.spin * lx
    wy = motion.roll_rate * math.sin(motion.yaw) + motion.spin * ly
    wz = motion.yaw_rate + motion.spin * lz
    py, pz = y - motion.y, z - motion.z + motion.radius
    vx = motion.vx + wy * pz - wz * py
    vy = motion.vy + wz * x - wx * pz - motion.rail_vy + motion.rail_roll_rate * (z - motion.rail_z)
    vz = motion.vz + wx * py - wy * x - motion.rail_vz - motion.rail_roll_rate * (y - motion.rail_y)
    return vx, vy, vz, wx, wy, wz


@kernel
def reference_speed(motion: Record) -> float:
    """Return the speed to which creepages refer [m/s]: the forward speed, not below `motion.slowest`."""
    slowest = motion.slowest if motion.slowest > 0.0 else SLOWEST
    return max(abs(motion.vx), slowest)


@kernel
def creepages(motion: Record, frame: Frame, x: float, y: float, z: float, patch: Record) -> None:
    """Fill the creepages of `patch` at the wheel's point (x, y, z): its velocity in the rail over `reference_speed`."""
    vx, vy, vz, _, wy, wz = _motion_at(motion, x, y, z)
    c, s = frame[2], frame[3]
    speed = reference_speed(motion)
    patch.vx = vx / speed
    patch.vy = (vy * c + vz * s) / speed
    patch.phi = (wz * c - wy * s) / speed  # the rail's roll rate is about x, across the normal


@kernel
def slip(motion: Record, axes: Axes, x: float, y: float, z: float, patch: Record) -> None:
    """Fill the creepages as `creepages`, in a frame with any axes x, y and z."""
    vx, vy, vz, wx, wy, wz = _motion_at(motion, x, y, z)
    speed = reference_speed(motion)
    patch.vx = (vx * axes[0] + vy * axes[1] + vz * axes[2]) / speed
    patch.vy = (vx * axes[3] + vy * axes[4] + vz * axes[5]) / speed
    patch.phi = ((wx - motion.rail_roll_rate) * axes[6] + wy * axes[7] + wz * axes[8]) / speed


@kernel
def positions(motion: Record, frame: Frame, wheel: Array, n_wheel: int, patch: Record) -> None:
    """Fill the position of the reference point, and the creepages of the undeformed bodies there.

    The position is given on the rail and opposite on the wheel, in track coordinates and in those of the profiles [m]. The
    creepages, and the forces, are those of the wheel's point at the depth `patch.approach`, as in CONTACT: where the reference
    point lies between two lobes, the wheel overlaps the rail less there.
    """
    y0, z0, c, s = frame
    height, slope = at(wheel, segment(wheel, 0, n_wheel, 0.0), 0.0)
    y, z = y0 - height * s, z0 + height * c
    lx, ly, lz = axle(motion.roll, motion.yaw)
    py, pz = y - motion.y, z - motion.z + motion.radius
    x, d, r = on_wheel(track_slope(frame, slope), py, pz, lx, ly, lz)
    patch.x, patch.y, patch.z = x, y0, z0
    patch.point_y, patch.point_z = y0 - patch.approach * s, z0 + patch.approach * c
    cos_roll, sin_roll = math.cos(motion.rail_roll), math.sin(motion.rail_roll)
    rail_y, rail_z = y0 - motion.rail_y, z0 - motion.rail_z
    patch.rail_y = cos_roll * rail_y + sin_roll * rail_z
    patch.rail_z = cos_roll * rail_z - sin_roll * rail_y
    patch.wheel_y, patch.wheel_z = d - motion.tape, r - motion.radius
    py, pz = patch.point_y - motion.y, patch.point_z - motion.z + motion.radius
    _, _, patch.radius = on_wheel(track_slope(frame, slope), py, pz, lx, ly, lz)
    creepages(motion, frame, x, patch.point_y, patch.point_z, patch)


@kernel
def _arc_at(wheel: Array, n_wheel: int, j: int, u: float, arm: float) -> tuple[float, float, float, float]:
    """Return width, rise and both slopes of the trace line over `arm` on both sides of `u`, for `_outline`."""
    low, high = max(u - arm, wheel[Curve.Y, 0]), min(u + arm, wheel[Curve.Y, n_wheel - 1])
    while j > 0 and wheel[Curve.Y, j] > low:
        j -= 1
    v0, m0 = at(wheel, j, low)
    v1, m1 = at(wheel, advance(wheel, n_wheel, j, high), high)
    return high - low, v1 - v0, m0, m1


@kernel
def _outline(arcs: Array, n: int, out: Array) -> None:
    """Fill `out` with the curvature k of the trace line [1/m]: of the arc through its points at both ends of each of `arcs`.

    The profiles' own second derivatives are noise. Every sample is by itself, so that the compiler takes several at once.
    """
    widths, rises, begins, ends = arcs[0], arcs[1], arcs[2], arcs[3]
    for k in range(n):
        width, rise, m0, m1 = widths[k], rises[k], begins[k], ends[k]
        chord = math.sqrt(width**2 + rise**2)
        # the sine of half the angle between both tangents, from sine and cosine of the whole one
        per_length = 1.0 / math.sqrt((1.0 + m0 * m0) * (1.0 + m1 * m1))
        turn = (m0 - m1) * per_length / math.sqrt(2.0 + 2.0 * (1.0 + m0 * m1) * per_length)
        out[k] = 2.0 * turn / chord if chord > 0.0 else 0.0


@kernel
def half_curvature(slope: float, k: float, tilt: float, r: float, axis: Direction) -> float:
    """Return A [1/m], half the second derivative along x of the gap at a point of the trace line, exact for any yaw and roll.

    The surface is F = rho - R(d) = 0, where d is the distance along the axle l and rho the distance from it. At a point
    of the trace line F_x = 0. So the height v along the plane's normal N has v_xx = -F_xx/F_v. With the ring's tangent
    t = l × e_r

            F_xx = t_x²/r - R'' l_x²,   t_x² = 1 - s²,   s² = l_x² (1 + R'²),   F_v = |grad F| cos D = √(1 + R'²) cos D,

    where D is the angle between surface and plane. Let a = 1/(r √(1 + R'²)) be the normal curvature of the ring and m =
    -R''/(1 + R'²)^(3/2) that of the profile. Then this is Euler's 2 A cos D = a (1 - s²) + m s². The trace line is the
    outline of the wheel seen along x. Its curvature k satisfies k (a (1 - s²) + m s²) = a m, because both sides are
    Gauss's curvature. This eliminates m:

            2 A cos D = a (1 - s²)/(1 - k s²/a).

    k is that of `_outline`, `slope` the slope of the trace line in the plane and `tilt` that in track coordinates, `axis` the
    direction of the axle.
    """
    lx, ly, lz = axis
    normal_y, normal_z = -tilt / math.sqrt(1.0 + tilt * tilt), 1.0 / math.sqrt(1.0 + tilt * tilt)
    nl = normal_y * ly + normal_z * lz  # -R'/√(1 + R'²)
    across2 = 1.0 / (1.0 - nl * nl)  # 1 + R'²
    ring, s2 = 1.0 / (r * math.sqrt(across2)), lx * lx * across2
    more = min(k * s2 / ring, _MOST)
    return 0.5 * ring * (1.0 - s2) / (1.0 - more) * math.sqrt(1.0 + slope * slope)


@kernel
def sample(
    frame: Frame, n_wheel: int, n_rail: int, low: float, high: float, patch: Record, out: Array, space: Search
) -> None:
    """Fill the separation `out` at the positions `grid` or, if that is empty, over low … high.

    Positions over low … high are dense where the gap is small. Beyond low … high, where a profile or the patch's own
    range ends, the gap opens at 45°. In the second loop every sample is by itself, so that the compiler takes several at once.
    """
    y0, z0, c, s = frame
    motion, grid, wheel, rail = space.motion[0], space.grid, space.wheel_plane, space.rail_plane
    lx, ly, lz = axle(motion.roll, motion.yaw)
    if grid.size > 0:
        for i in range(grid.size):
            out[Sep.Y, i] = grid[i]
    else:
        spread(wheel, n_wheel, low, high, size_of(motion), out[Sep.Y])
    i, j, arm, slopes, heights, arcs = 0, 0, _ARM * size_of(motion), space.work[0], space.work[1], space.work[2:6]
    for k in range(out.shape[1]):
        u = out[Sep.Y, k]
        v = min(max(u, low), high)
        i, j = advance(rail, n_rail, i, v), advance(wheel, n_wheel, j, v)
        height, slope = at(wheel, j, v)
        rail_height, rail_slope = at(rail, i, v)
        gap = rail_height - height + patch.approach
        out[Sep.G, k] = max(gap, 0.0) + _OPENING * abs(u - v)
        out[Sep.TILT, k] = 0.5 * (slope + rail_slope)
        heights[k], slopes[k] = height, slope
        arcs[0, k], arcs[1, k], arcs[2, k], arcs[3, k] = _arc_at(wheel, n_wheel, j, v, arm)
    _outline(arcs, out.shape[1], out[Sep.A])
    share = share_beside(patch, motion)
    across, down, x = motion.y, motion.z - motion.radius, patch.x
    for k in range(out.shape[1]):
        v, height, slope = min(max(out[Sep.Y, k], low), high), heights[k], slopes[k]
        tilt = track_slope(frame, slope)
        py = y0 + v * c - height * s - across
        pz = z0 + v * s + height * c - down
        at_x, _, r = on_wheel(tilt, py, pz, lx, ly, lz)
        out[Sep.A, k] = half_curvature(slope, out[Sep.A, k], tilt, r, (lx, ly, lz))
        out[Sep.XC, k] = at_x - x
    if share > 0.0:
        fit_beside(share, frame, patch, (low, high), out, space)


@kernel
def describe(
    first_node: int, start: int, end: int, lobe: Record, neighbours: tuple[float, float], k: int, space: Search
) -> bool:
    """Fill patch and separation `k` of one combined lobe. Return False if too little of the profiles faces its plane.

    `neighbours` are the bounds of the patch in track y [m]. They are infinite on a side without neighbour.
    """
    before, after = neighbours
    line, placed, grid, motion = space.line, space.placed, space.grid, space.motion[0]
    wheel, rail, patch = space.wheel_plane, space.rail_plane, space.patches[k]
    y0 = lobe.moment / lobe.weight
    angle = math.atan2(lobe.sine, lobe.cosine)
    n_placed = placed.shape[1]
    centre = segment(placed, 0, n_placed, y0)
    frame = (y0, at(placed, centre, y0)[0], math.cos(angle), math.sin(angle))

    # the edges of the interpenetration lie on both curves; the bounds between neighbours are points of the rail
    i = segment(placed, 0, n_placed, lobe.low)
    first = along(frame, lobe.low, at(placed, i, lobe.low)[0])
    i = segment(placed, 0, n_placed, lobe.high)
    last = along(frame, lobe.high, at(placed, i, lobe.high)[0])
    margin = max(_MARGIN * size_of(motion), _MARGIN_SHARE * (last - first))
    low, high = first - margin, last + margin
    if grid.size > 0:
        low, high = min(low, grid[0]), max(high, grid[grid.size - 1])
    if before > -math.inf:
        low = max(low, along(frame, before, at(placed, segment(placed, 0, n_placed, before), before)[0]))
    if after < math.inf:
        high = min(high, along(frame, after, at(placed, segment(placed, 0, n_placed, after), after)[0]))

    j = segment(line, start, end, y0)
    n_wheel, low, high = project(line, (first_node, line.shape[1], j), motion.z, frame, low, high, wheel)
    n_rail, low, high = project(placed, (0, n_placed, centre), 0.0, frame, low, high, rail)
    first, last = max(first, low), min(last, high)
    if n_wheel < 3 or n_rail < 3 or not first < last:
        return False

    patch.angle, patch.low, patch.high, patch.load = angle, first, last, 0.0
    patch.pitch, patch.fit_error = 0.0, 0.0
    patch.approach = -normal_gap(wheel, n_wheel, rail, n_rail, first, last)
    positions(motion, frame, wheel, n_wheel, patch)
    sample(frame, n_wheel, n_rail, low, high, patch, space.separations[k], space)
    return True


@kernel
def describe_all(first_node: int, start: int, end: int, space: Search) -> int:
    """Describe all patches at the pose in `space.motion`, from the field side to the flange. Return their number.

    While lobes pass from a common plane to planes of their own, they are described in both, with shares
    (`search.combine`).
    """
    motion, lobe = space.motion[0], space.lobes
    n = lobes(space.line, start, end, motion.z, lobe)
    n = combine(lobe, n, motion.combine_distance, motion.combine_angle, motion.most_patches)
    untie(lobe, n, space.patches.size)
    count, spare = 0, lobe.size - 1  # no more lobes than patches are left, so the last one is free
    for last in range(n - 1, -1, -1):
        for first in range(last, -1, -1):
            share = shared(lobe, n, first, last)
            if share <= 0.0:
                continue
            lobe[spare] = lobe[first]
            for k in range(first + 1, last + 1):
                join(lobe[k], lobe[spare])
            before = 0.5 * (lobe[first - 1].high + lobe[first].low) if first > 0 else -math.inf
            after = 0.5 * (lobe[last].high + lobe[last + 1].low) if last < n - 1 else math.inf
            if describe(first_node, start, end, lobe[spare], (before, after), count, space):
                space.patches[count].share = share
                count += 1
    return count
