"""Cross-sections of surfaces, placed in a frame, and their heights over it.

A frame is a tuple of twelve numbers: its origin in track coordinates and its axes x, s (across) and n (from the wheel into
the rail), one after the other. A cross-section at constant u is a chain of parametric cubics y(v), z(v). Its place in the
frame is linear in y and z, `Placing` = (x0, x_y, x_z, s0, s_y, s_z, n0, n_y, n_z). So only the nodes are transformed.
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.arrays import Sheet
from contact.kernels.geometry.curve import Array, Record
from contact.kernels.rows import Node, Over, Section

Frame = tuple[float, float, float, float, float, float, float, float, float, float, float, float]
Rows = tuple[float, float, int, bool]
Placing = tuple[float, float, float, float, float, float, float, float, float]

AWAY = 1.0  # [m] height where a body is absent, far beyond every gap
_STEPS, _NEAR = 3, 1e-7  # Newton's iteration for v: steps, and [m] before the last one; a segment is nearly straight
_FULL = 2.0 * math.pi


@kernel
def about_x(x: float, y: float, z: float, angle: float) -> Frame:
    """Return the track frame moved to (x, y, z) [m] and turned about x by `angle` [rad]."""
    c, s = math.cos(angle), math.sin(angle)
    return x, y, z, 1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c


@kernel
def tilted(x: float, y: float, z: float, angle: float, pitch: float) -> Frame:
    """Return the frame `about_x`, tilted so that its normal inclines by `pitch` [rad] forward."""
    c, s, cp, sp = math.cos(angle), math.sin(angle), math.cos(pitch), math.sin(pitch)
    return x, y, z, cp, s * sp, -c * sp, 0.0, c, s, sp, -s * cp, c * cp


@kernel
def _product(frame: Frame, at: int, x: float, y: float, z: float) -> float:
    """Return the component of a vector of the track along the axis of a frame that begins at index `at`."""
    return frame[at] * x + frame[at + 1] * y + frame[at + 2] * z


@kernel
def _bracket(u: Array, at: float) -> int:
    """Return the index i with u[i] <= at < u[i + 1]; outside, the first or the last interval."""
    low, high = 0, u.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if u[middle] <= at:
            low = middle
        else:
            high = middle
    return low


@kernel
def deviation(table: Array, u: float) -> tuple[float, float]:
    """Return value and slope of the deviation at u. It is 0 beyond its table."""
    n = table.shape[1]
    if n < 2 or u < table[0, 0] or u > table[0, n - 1]:
        return 0.0, 0.0
    i = _bracket(table[0], u)
    h = table[0, i + 1] - table[0, i]
    return cubic.value_and_slope(h, table[1, i], table[2, i], table[1, i + 1], table[2, i + 1], (u - table[0, i]) / h)


@kernel
def section(sheet: Sheet, u: float, limits: tuple[int, int], rows: int, out: Array) -> tuple[int, int, float, float]:
    """Fill the first `rows` of `Node` in `out` with the cross-section at `u`; for a rail also y and z derived along u.

    Only the paths within `limits` are filled. Return the first, the end, and value and slope of the deviation, which is
    not yet added.
    """
    period, fold = sheet.period[0], sheet.period[1]
    if not math.isnan(fold):  # a wheel
        u -= _FULL * math.floor((u - fold) / _FULL + 0.5)
    value, slope = deviation(sheet.deviation, u)
    n = sheet.u.size
    if period > 0.0:
        u -= period * math.floor((u - sheet.u[0]) / period)
    inside = sheet.u[0] <= u <= sheet.u[n - 1]
    u = min(max(u, sheet.u[0]), sheet.u[n - 1])
    i = _bracket(sheet.u, u)
    h = sheet.u[i + 1] - sheet.u[i]
    t = (u - sheet.u[i]) / h
    # at a slice itself, only that slice needs to have the path
    first, end = limits
    if t < 1.0:
        first, end = max(first, int(sheet.runs[i, 0])), min(end, int(sheet.runs[i, 1]))
    if t > 0.0:
        first, end = max(first, int(sheet.runs[i + 1, 0])), min(end, int(sheet.runs[i + 1, 1]))
    b0, b1, b2, b3 = cubic.basis(t)
    b1, b3 = b1 * h, b3 * h
    half = len(Node)
    for row in range(rows):
        f, g = sheet.nodes[i, row], sheet.nodes[i + 1, row]
        f_u, g_u = sheet.nodes[i, row + half], sheet.nodes[i + 1, row + half]
        to = out[row]
        for j in range(first, end):
            to[j] = b0 * f[j] + b2 * g[j] + b1 * f_u[j] + b3 * g_u[j]
    if not math.isnan(fold):
        return first, end, value, slope
    d0, d1, d3 = 6.0 * t * (t - 1.0) / h, 1.0 + t * (3.0 * t - 4.0), t * (3.0 * t - 2.0)
    for row in range(2):
        f, g = sheet.nodes[i, row], sheet.nodes[i + 1, row]
        f_u, g_u = sheet.nodes[i, row + half], sheet.nodes[i + 1, row + half]
        to = out[Section.S_ALONG + row]
        for j in range(first, end):
            to[j] = d0 * (f[j] - g[j]) + d1 * f_u[j] + d3 * g_u[j] if inside else 0.0
    return first, end, value, slope


@kernel
def of_rail(u: float, motion: Record, frame: Frame) -> Placing:
    """Return the place of the rail's cross-section at `u`."""
    c, s = math.cos(motion.rail_roll), math.sin(motion.rail_roll)
    x, y, z = u - motion.station - frame[0], motion.rail_y - frame[1], motion.rail_z - frame[2]
    return (
        _product(frame, 3, x, y, z), _product(frame, 3, 0.0, c, s), _product(frame, 3, 0.0, -s, c),
        _product(frame, 6, x, y, z), _product(frame, 6, 0.0, c, s), _product(frame, 6, 0.0, -s, c),
        _product(frame, 9, x, y, z), _product(frame, 9, 0.0, c, s), _product(frame, 9, 0.0, -s, c),
    )  # fmt: skip


@kernel
def of_wheel(theta: float, motion: Record, frame: Frame) -> Placing:
    """Return the place of the wheel's meridian at the angle `theta`."""
    cr, sr = math.cos(motion.roll), math.sin(motion.roll)
    cy, sy = math.cos(motion.yaw), math.sin(motion.yaw)
    sine, cosine = math.sin(theta + motion.rotation), math.cos(theta + motion.rotation)
    # directions in track coordinates: outwards along the radius, and along the axle
    rx, ry, rz = cy * sine + sy * sr * cosine, sy * sine - cy * sr * cosine, cr * cosine
    ax, ay, az = -sy * cr, cy * cr, sr
    x = motion.radius * rx + motion.tape * ax - frame[0]
    y = motion.radius * ry + motion.tape * ay + motion.y - frame[1]
    z = motion.radius * rz + motion.tape * az + motion.z - motion.radius - frame[2]
    return (
        _product(frame, 3, x, y, z), _product(frame, 3, ax, ay, az), _product(frame, 3, rx, ry, rz),
        _product(frame, 6, x, y, z), _product(frame, 6, ax, ay, az), _product(frame, 6, rx, ry, rz),
        _product(frame, 9, x, y, z), _product(frame, 9, ax, ay, az), _product(frame, 9, rx, ry, rz),
    )  # fmt: skip


@kernel
def angle_near(x: float, motion: Record, frame: Frame) -> float:
    """Return the angle of the meridian near the position `x` [m] of the frame's plane."""
    cr, sr = math.cos(motion.roll), math.sin(motion.roll)
    cy, sy = math.cos(motion.yaw), math.sin(motion.yaw)
    px, py, pz = frame[0], frame[1] - motion.y, frame[2] - motion.z + motion.radius
    fx, fy, fz = frame[3], frame[4], frame[5]
    b0 = cy * px + sy * py
    b2 = sy * sr * px - cy * sr * py + cr * pz
    ahead = b0 + x * (cy * fx + sy * fy)
    reach = math.sqrt(b0 * b0 + b2 * b2) if fz == 0.0 else math.sqrt(ahead**2 + (b2 + x * fz * cr) ** 2)
    return math.asin(min(max(ahead / reach, -0.9), 0.9)) - motion.rotation


@kernel
def place(placing: Placing, run: tuple[int, int], rows: int, rise: tuple[float, float], out: Array) -> None:
    """Turn `rows` of nodes (y, z), and the derivatives, into (s, n).

    `rise` is what is added to z, and its derivative along u.
    """
    _, _, _, s0, s_y, s_z, n0, n_y, n_z = placing
    value, slope = rise
    first, end = run
    for row in range(0, 8, 2):
        if rows <= row < Section.S_ALONG:
            continue
        y, z = out[row], out[row + 1]
        add = value if row == 0 else slope if row == Section.S_ALONG else 0.0
        s_add, n_add = (s0, n0) if row == 0 else (0.0, 0.0)
        for j in range(first, end):
            a, b = y[j], z[j] + add
            y[j] = s_add + s_y * a + s_z * b
            z[j] = n_add + n_y * a + n_z * b


@kernel
def extent(nodes: Array, first: int, end: int) -> tuple[float, float]:
    """Return the least and the largest s [m] of a section; an empty one has infinity and its negative."""
    low, high = math.inf, -math.inf
    for j in range(first, end):
        low, high = min(low, nodes[Section.S, j]), max(high, nodes[Section.S, j])
    return low, high


@kernel
def cover(nodes: Array, first: int, end: int, low: float, high: float) -> tuple[int, int]:
    """Return the first path and the end of the part of a section that reaches into low … high [m]; else (end, first)."""
    a, b = end, first
    for j in range(first, end):
        if low <= nodes[Section.S, j] <= high:
            a, b = min(a, j), max(b, j + 1)
    return a, b


@kernel
def heights(nodes: Array, run: tuple[int, int], rows: Rows, sign: float, placing: Placing, to: Array) -> None:
    """Fill height and x over the rows of a grid: the least sign·n where several branches lie over a row.

    `rows` are the first row, the step [m], their number, and whether cubics count, or chords. `to` begins with the row for
    the height, then the one for x. For a rail (sign 1) the slopes along x and s follow. Rows without the body get the height
    sign·AWAY.
    """
    first, end = run
    low, step, n, fine = rows
    per_step, high = 1.0 / step, low + step * (n - 1)
    x0, x_y, x_z, s0, s_y, s_z, n0, n_y, n_z = placing
    determinant = s_y * n_z - s_z * n_y
    x_s, x_n = (x_y * n_z - x_z * n_y) / determinant, (x_z * s_y - x_y * s_z) / determinant
    x_first = x0 - x_s * s0 - x_n * n0
    for i in range(n):
        to[0, i], to[1, i] = sign * AWAY, 0.0
    for j in range(first, end - 1):
        s_a, s_b = nodes[Section.S, j], nodes[Section.S, j + 1]
        if max(s_a, s_b) < low or min(s_a, s_b) > high or s_a == s_b:
            continue
        i0 = math.ceil(max((min(s_a, s_b) - low) * per_step, 0.0))
        i1 = math.floor(min((max(s_a, s_b) - low) * per_step, n - 1.0))
        if i1 < i0:
            continue
        n_a, n_b, per_s = nodes[Section.N, j], nodes[Section.N, j + 1], 1.0 / (s_b - s_a)
        m_a, m_b, k_a, k_b = s_b - s_a, s_b - s_a, n_b - n_a, n_b - n_a
        if fine:
            m_a, m_b = nodes[Section.S_START, j], nodes[Section.S_END, j]
            k_a, k_b = nodes[Section.N_START, j], nodes[Section.N_END, j]
        for i in range(i0, i1 + 1):
            s = low + step * i
            t = (s - s_a) * per_s
            height, rise, rate = n_a + t * (n_b - n_a), k_a, m_a
            if fine:
                for _ in range(_STEPS):
                    at, rate = cubic.value_and_slope(1.0, s_a, m_a, s_b, m_b, t)
                    if rate * (s_b - s_a) <= 0.0:
                        break
                    t = min(max(t + (s - at) / rate, 0.0), 1.0)
                    if abs(s - at) < _NEAR:
                        break
                height, rise = cubic.value_and_slope(1.0, n_a, k_a, n_b, k_b, t)
            if sign * height >= sign * to[0, i]:
                continue
            to[0, i], to[1, i] = height, x_first + x_s * s + x_n * height
            if sign > 0.0:
                rate = rate if rate != 0.0 else s_b - s_a
                along_s = nodes[Section.S_ALONG, j] + t * (nodes[Section.S_ALONG, j + 1] - nodes[Section.S_ALONG, j])
                along_n = nodes[Section.N_ALONG, j] + t * (nodes[Section.N_ALONG, j + 1] - nodes[Section.N_ALONG, j])
                slope = rise / rate
                to[2, i], to[3, i] = along_n - slope * along_s, slope


@kernel
def column(
    x: float,
    rows: Rows,
    limits: tuple[int, int, int, int],
    frame: Frame,
    surfaces: tuple[Sheet, Sheet],
    motion: Record,
    nodes: Array,
    to: Array,
) -> None:
    """Fill the rows `Over` of one column near the position `x` [m] of the frame. `surfaces` are wheel and rail.

    `limits` are the first path and the end of the wheel, and of the rail.
    """
    wheel, rail = surfaces
    count = len(Node) if rows[3] else 2
    u = motion.station + frame[0] + frame[3] * x
    first, end, value, slope = section(rail, u, (limits[2], limits[3]), count, nodes)
    placing = of_rail(u, motion, frame)
    place(placing, (first, end), count, (value, slope), nodes)
    heights(nodes, (first, end), rows, 1.0, placing, to[Over.RAIL : Over.RAIL_SLOPE_S + 1])
    # d/du of a point is the track's x axis, which has the components frame[3], 0 and frame[9], plus that of y and z
    _, x_y, x_z, _, s_y, s_z, _, n_y, n_z = placing
    x_n = (x_z * s_y - x_y * s_z) / (s_y * n_z - s_z * n_y)
    theta = angle_near(x, motion, frame)
    first, end, value, slope = section(wheel, theta, (limits[0], limits[1]), count, nodes)
    placing = of_wheel(theta, motion, frame)
    place(placing, (first, end), count, (value, slope), nodes)
    heights(nodes, (first, end), rows, -1.0, placing, to[Over.WHEEL : Over.WHEEL_X + 1])
    for i in range(rows[2]):
        if to[Over.RAIL, i] >= AWAY or to[Over.WHEEL, i] <= -AWAY:
            to[Over.GAP, i] = AWAY
            continue
        rise = to[Over.RAIL_SLOPE_X, i]
        rise = (frame[9] + rise) / (frame[3] + x_n * rise)
        to[Over.RAIL_SLOPE_X, i] = rise
        to[Over.GAP, i] = to[Over.RAIL, i] + rise * (to[Over.WHEEL_X, i] - to[Over.RAIL_X, i]) - to[Over.WHEEL, i]
