"""Contact search between one wheel and one rail: trace line, gap, lobes of interpenetration, patches.

Everything here is the right side in track coordinates (x forward, y right, z down) and in metres. The wheel is shown to the
rail by its trace line, the curve of points whose normal has no x component: for a rail that is a prism along x, contact
can lie nowhere else (Wang's trace line, theory.md 9.4). With it the search is one in the y-z plane.
"""

import math

from contact._jit import kernel
from contact.kernels.geometry.curve import Array, Record, advance, at, hermite, least, root
from contact.kernels.layout import MAX_LOBES, Curve

_COINCIDENT = 1e-9  # [m]
_GAUSS_T = 0.5 * math.sqrt(0.6)


@kernel
def axle(roll: float, yaw: float) -> tuple[float, float, float]:
    """Direction of the axle, towards the right wheel."""
    return -math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)


@kernel
def trace(wheel: Array, n: int, radius: float, tape: float, y: float, roll: float, yaw: float, line: Array) -> int:
    """Trace line of the wheel profile `wheel` [m] of a wheelset at (y, z = 0, roll, yaw); returns its first valid node.

    A point of the profile turns on a circle of radius r about the axle direction l. Of that circle the point whose surface
    normal e_r - r'·l has no x component is at l_x·(d + r r') (theory.md 9.4, with its height factor); d is the distance from
    the wheelset's centre. In a fillet too narrow for the yaw the trace line folds back on itself: there the lower of its
    branches is the outline of the wheel, and nodes above it are left out.
    """
    lx, ly, lz = axle(roll, yaw)
    c2 = 1.0 - lx * lx
    first = n
    for j in range(n - 1, -1, -1):
        d, r, rp = tape + wheel[Curve.Y, j], radius + wheel[Curve.Z, j], wheel[Curve.SLOPE, j]
        h2 = c2 - (lx * rp) ** 2
        if h2 <= 0.0:  # steeper than the axle's own yaw allows: the ring never faces the rail
            continue
        h = math.sqrt(h2)
        py = y + d * ly - r * (rp * lx * lx * ly + h * lz) / c2
        pz = -radius + d * lz + r * (h * ly - rp * lx * lx * lz) / c2
        if first < n and py >= line[Curve.Y, first] - _COINCIDENT:
            k = first
            while k < n - 1 and line[Curve.Y, k + 1] <= py:
                k += 1
            slope = (
                (line[Curve.Z, k + 1] - line[Curve.Z, k]) / (line[Curve.Y, k + 1] - line[Curve.Y, k])
                if k < n - 1
                else 0.0
            )
            if pz <= line[Curve.Z, k] + slope * (py - line[Curve.Y, k]):
                continue
            while first < n and line[Curve.Y, first] <= py + _COINCIDENT:
                first += 1
        first -= 1
        line[Curve.Y, first] = py
        line[Curve.Z, first] = pz
        line[Curve.SLOPE, first] = (rp * ly + h * lz) / (h * ly - rp * lz)
    return first


@kernel
def on_wheel(slope: float, py: float, pz: float, lx: float, ly: float, lz: float) -> tuple[float, float, float]:
    """x, axial distance and rolling radius of the trace point (py, pz), relative to the wheelset centre, of given slope.

    The normal there is n = (0, -sin, cos) of the slope; e_r is its part across the axle, so both follow without the profile.
    """
    norm = 1.0 / math.sqrt(1.0 + slope * slope)
    ny, nz = -slope * norm, norm
    nl = ny * ly + nz * lz
    across = 1.0 / math.sqrt(1.0 - nl * nl)
    ey, ez = (ny - nl * ly) * across, (nz - nl * lz) * across
    determinant = ly * ez - lz * ey
    r = (ly * pz - lz * py) / determinant
    d = (py * ez - pz * ey) / determinant
    return lx * (d - r * nl * across), d, r


@kernel
def place(rail: Array, n: int, y: float, z: float, roll: float, placed: Array) -> None:
    """The rail profile in track coordinates: turned by `roll` about its origin, which lies at (y, z)."""
    c, s = math.cos(roll), math.sin(roll)
    for j in range(n):
        placed[Curve.Y, j] = y + c * rail[Curve.Y, j] - s * rail[Curve.Z, j]
        placed[Curve.Z, j] = z + s * rail[Curve.Y, j] + c * rail[Curve.Z, j]
        placed[Curve.SLOPE, j] = (s + c * rail[Curve.SLOPE, j]) / (c - s * rail[Curve.SLOPE, j])


@kernel
def vertical_gap(line: Array, first: int, n: int, placed: Array, n_rail: int) -> tuple[int, int]:
    """Fill the gap rows of the trace line; returns the range of nodes that lie above the rail."""
    start, i = n, 0
    for j in range(first, n):
        y = line[Curve.Y, j]
        if y < placed[Curve.Y, 0]:
            continue
        if y > placed[Curve.Y, n_rail - 1]:
            return min(start, j), j
        start = min(start, j)
        i = advance(placed, n_rail, i, y)
        z, slope = at(placed, i, y)
        line[Curve.GAP, j] = z - line[Curve.Z, j]
        line[Curve.OPENING, j] = slope - line[Curve.SLOPE, j]
    return start, n


@kernel
def touch(line: Array, start: int, end: int) -> float:
    """Least vertical gap at pose.z = 0: the z of the wheelset at which the rigid wheel just touches."""
    lowest = line[Curve.GAP, start]
    for j in range(start, end - 1):
        lowest = min(lowest, line[Curve.GAP, j + 1])
        if line[Curve.OPENING, j] < 0.0 < line[Curve.OPENING, j + 1]:
            h = line[Curve.Y, j + 1] - line[Curve.Y, j]
            t, g = least(
                line[Curve.GAP, j], line[Curve.GAP, j + 1], line[Curve.OPENING, j], line[Curve.OPENING, j + 1], h
            )
            if t > 0.0:
                lowest = min(lowest, g)
    return lowest


@kernel
def _weigh(line: Array, j: int, z: float, t0: float, t1: float, lobe: Record, k: int) -> None:
    """Add segment j between t0 and t1 to the moments of lobe k, by three Gauss points."""
    h = line[Curve.Y, j + 1] - line[Curve.Y, j]
    for i in range(3):
        t = 0.5 * (t0 + t1) + (i - 1) * (t1 - t0) * _GAUSS_T
        share = (4.0 / 9.0 if i == 1 else 5.0 / 18.0) * (t1 - t0) * h
        g = (
            hermite(
                line[Curve.GAP, j], line[Curve.GAP, j + 1], line[Curve.OPENING, j], line[Curve.OPENING, j + 1], h, t
            )[0]
            - z
        )
        weight = share * g * g * math.sqrt(max(-g, 0.0))
        wheel = line[Curve.SLOPE, j] + t * (line[Curve.SLOPE, j + 1] - line[Curve.SLOPE, j])
        slope = wheel + line[Curve.OPENING, j] + t * (line[Curve.OPENING, j + 1] - line[Curve.OPENING, j])
        cosine = 1.0 / math.sqrt(1.0 + slope * slope)
        lobe[k].weight += weight
        lobe[k].moment += weight * (line[Curve.Y, j] + t * h)
        lobe[k].cosine += weight * cosine
        lobe[k].sine += weight * slope * cosine


@kernel
def lobes(line: Array, start: int, end: int, z: float, lobe: Record) -> int:
    """Runs of y in which the wheel, lowered by z, lies inside the rail; returns their number.

    Points are weighted with depth^(5/2), which is the square of the interpenetration integrated along x. The mean position
    becomes the reference point and the mean direction of the rail the contact angle, so both move smoothly with the pose
    and a new lobe enters without a jump. The weight is CONTACT's: with it, and with no other power, its printed reference
    points come out (benchmarks/geometry_table.py).
    """
    k, inside = -1, False
    for j in range(start, end - 1):
        g0, g1 = line[Curve.GAP, j] - z, line[Curve.GAP, j + 1] - z
        m0, m1, h = line[Curve.OPENING, j], line[Curve.OPENING, j + 1], line[Curve.Y, j + 1] - line[Curve.Y, j]
        t0, t1 = 0.0, 1.0
        if g0 >= 0.0 and g1 >= 0.0:
            if not m0 < 0.0 < m1:
                continue
            t, g = least(g0, g1, m0, m1, h)
            if t < 0.0 or g >= 0.0:
                continue
            t0, t1 = root(g0, g1, m0, m1, h, 0.0, t), root(g0, g1, m0, m1, h, t, 1.0)
        elif g0 >= 0.0:
            t0 = root(g0, g1, m0, m1, h, 0.0, 1.0)
        elif g1 >= 0.0:
            t1 = root(g0, g1, m0, m1, h, 0.0, 1.0)
        if not inside:
            if k == MAX_LOBES - 1:
                return MAX_LOBES
            k += 1
            lobe[k].weight, lobe[k].moment, lobe[k].cosine, lobe[k].sine = 0.0, 0.0, 0.0, 0.0
            lobe[k].low = line[Curve.Y, j] + t0 * h
        _weigh(line, j, z, t0, t1, lobe, k)
        lobe[k].high = line[Curve.Y, j] + t1 * h
        inside = g1 < 0.0
    return k + 1


@kernel
def combine(lobe: Record, n: int, distance: float, angle: float, most: int) -> int:
    """Merge neighbouring lobes in place into at most `most` patches; returns the number of patches.

    Two lobes stay separate patches when they are further apart than `distance` [m] (along the mean of their tangents) and
    their angles differ by more than `angle` [rad]; nearer ones share one plane, as with CONTACT's D_COMB.
    """
    k = 0
    last = math.atan2(lobe[0].sine, lobe[0].cosine) if n > 0 else 0.0
    for i in range(1, n):
        own = math.atan2(lobe[i].sine, lobe[i].cosine)
        apart = (lobe[i].low - lobe[k].high) / math.cos(0.5 * (own + last)) > distance
        if apart and abs(own - last) > angle and k < most - 1:
            k += 1
            lobe[k] = lobe[i]
        else:
            lobe[k].high = lobe[i].high
            lobe[k].weight += lobe[i].weight
            lobe[k].moment += lobe[i].moment
            lobe[k].cosine += lobe[i].cosine
            lobe[k].sine += lobe[i].sine
        last = own
    return k + 1 if n > 0 else 0
