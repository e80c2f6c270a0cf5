"""Contact search between one wheel and one rail: trace line, gap, lobes of interpenetration, patches.

All quantities are those of the right side in track coordinates (x forward, y right, z down), in metres. The wheel is
represented by its trace line, the curve of points whose normal has no x component. The rail is a prism along x, so
contact can lie nowhere else (Wang's trace line, theory.md 9.4). This makes the search one in the y-z plane.
"""

import math

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Lobes, Matrix
from contact.kernels.geometry.curve import Array, Record, advance, at
from contact.kernels.records import MAX_LOBES
from contact.kernels.rows import Curve

_COINCIDENT = 1e-9  # [m] distance below which points coincide
_FLAT = 1e-300  # square of a cosine in place of one that does not exist
_GAUSS_T = 0.5 * math.sqrt(0.6)  # outer nodes of three-point Gauss, from the middle of an interval of length 1
_USUAL_RADIUS = 0.46  # [m] of a tape circle, for which the lengths of the search are given
_BLOCK = 16  # nodes that are looked at together
_TRANSITION = 0.25  # of the limits of distance and angle: width of the transition from one plane to two


@kernel
def size_of(motion: Record) -> float:
    """Return the radius of the tape circle over the usual one. Lengths of the search are multiplied by it.

    So bodies of 1:k, as on a roller rig, are searched as bodies of 1:1.
    """
    return motion.radius / _USUAL_RADIUS


@entry
def axle(roll: float, yaw: float) -> tuple[float, float, float]:
    """Return the direction of the axle, towards the right wheel."""
    return -math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)


@kernel
def _trace_all(
    wheel: Array, n: int, radius: float, tape: float, y: float, axis: tuple[float, float, float], line: Array
) -> bool:
    """Fill the trace line as `trace` does, if no node is too steep and none folds back. Return whether that is so.

    In the first loop every node is by itself, so that the compiler takes several at once.
    """
    lx, ly, lz = axis
    c2 = 1.0 - lx * lx
    steepest, narrowest = 0.0, math.inf
    for j in range(n):
        d, r, rp = tape + wheel[Curve.Y, j], radius + wheel[Curve.Z, j], wheel[Curve.SLOPE, j]
        h = math.sqrt(max(c2 - (lx * rp) ** 2, _FLAT))
        line[Curve.Y, j] = y + d * ly - r * (rp * lx * lx * ly + h * lz) / c2
        line[Curve.Z, j] = -radius + d * lz + r * (h * ly - rp * lx * lx * lz) / c2
        line[Curve.SLOPE, j] = (rp * ly + h * lz) / (h * ly - rp * lz)
    for j in range(n - 1):
        steepest = max(steepest, abs(wheel[Curve.SLOPE, j]))
        narrowest = min(narrowest, line[Curve.Y, j + 1] - line[Curve.Y, j])
    steepest = max(steepest, abs(wheel[Curve.SLOPE, n - 1]))
    return c2 - (lx * steepest) ** 2 > 0.0 and narrowest > 2.0 * _COINCIDENT


@entry
def trace(wheel: Matrix, n: int, radius: float, tape: float, y: float, roll: float, yaw: float, line: Matrix) -> int:
    """Fill the trace line of the wheel profile `wheel` [m]. Return its first valid node.

    The wheelset is at (y, z = 0, roll, yaw). A point of the profile turns on a circle of radius r about the axle
    direction l. The point of that circle whose surface normal e_r - r'·l has no x component is at l_x·(d + r r')
    (theory.md 9.4, with its height factor), where d is the distance from the wheelset's centre. In a fillet that is too
    narrow for the yaw the trace line folds back on itself. There the lower branch is the outline of the wheel, and
    nodes above it are left out.
    """
    lx, ly, lz = axle(roll, yaw)
    c2 = 1.0 - lx * lx
    if _trace_all(wheel, n, radius, tape, y, (lx, ly, lz), line):
        return 0
    first = n
    for j in range(n - 1, -1, -1):
        d, r, rp = tape + wheel[Curve.Y, j], radius + wheel[Curve.Z, j], wheel[Curve.SLOPE, j]
        h2 = c2 - (lx * rp) ** 2
        if h2 <= 0.0:  # too steep for this yaw: the ring never faces the rail
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


@entry
def on_wheel(slope: float, py: float, pz: float, lx: float, ly: float, lz: float) -> tuple[float, float, float]:
    """Return x, axial distance and rolling radius [m] of the trace point (py, pz) with the given slope.

    The point is relative to the wheelset's centre. Its normal is n = (0, -sin, cos) of the slope. e_r is the part of n
    perpendicular to the axle. So the profile is not needed.
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
    """Fill `placed` with the rail profile in track coordinates: turned by `roll` about its origin, which lies at (y, z)."""
    c, s = math.cos(roll), math.sin(roll)
    for j in range(n):
        placed[Curve.Y, j] = y + c * rail[Curve.Y, j] - s * rail[Curve.Z, j]
        placed[Curve.Z, j] = z + s * rail[Curve.Y, j] + c * rail[Curve.Z, j]
        placed[Curve.SLOPE, j] = (s + c * rail[Curve.SLOPE, j]) / (c - s * rail[Curve.SLOPE, j])


@kernel
def vertical_gap(line: Array, first: int, n: int, placed: Array, n_rail: int) -> tuple[int, int]:
    """Fill the gap rows of the trace line. Return the range of nodes that lie above the rail."""
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
    """Return the smallest vertical gap at pose.z = 0 [m].

    It is the z of the wheelset at which the rigid wheel just touches.
    """
    lowest = line[Curve.GAP, start]
    for j in range(start, end - 1):
        lowest = min(lowest, line[Curve.GAP, j + 1])
        if line[Curve.OPENING, j] < 0.0 < line[Curve.OPENING, j + 1]:
            h = line[Curve.Y, j + 1] - line[Curve.Y, j]
            t, g = cubic.interior_minimum(
                h, line[Curve.GAP, j], line[Curve.OPENING, j], line[Curve.GAP, j + 1], line[Curve.OPENING, j + 1]
            )
            if t > 0.0:
                lowest = min(lowest, g)
    return lowest


@kernel
def _add_moments(line: Array, j: int, z: float, t0: float, t1: float, lobe: Record, k: int) -> None:
    """Add segment j between t0 and t1 to the moments of lobe k, by three Gauss points."""
    h = line[Curve.Y, j + 1] - line[Curve.Y, j]
    g0, m0 = line[Curve.GAP, j], line[Curve.OPENING, j]
    g1, m1 = line[Curve.GAP, j + 1], line[Curve.OPENING, j + 1]
    for i in range(3):
        t = 0.5 * (t0 + t1) + (i - 1) * (t1 - t0) * _GAUSS_T
        share = (4.0 / 9.0 if i == 1 else 5.0 / 18.0) * (t1 - t0) * h
        g = cubic.value(h, g0, m0, g1, m1, t) - z
        weight = share * g * g * math.sqrt(max(-g, 0.0))
        wheel = line[Curve.SLOPE, j] + t * (line[Curve.SLOPE, j + 1] - line[Curve.SLOPE, j])
        slope = wheel + line[Curve.OPENING, j] + t * (line[Curve.OPENING, j + 1] - line[Curve.OPENING, j])
        cosine = 1.0 / math.sqrt(1.0 + slope * slope)
        lobe[k].weight += weight
        lobe[k].moment += weight * (line[Curve.Y, j] + t * h)
        lobe[k].cosine += weight * cosine
        lobe[k].sine += weight * slope * cosine


@kernel
def _are_apart(gap: Array, opening: Array, z: float) -> bool:
    """Return whether the gap is at least z at all nodes, and no interval between two of them has its least gap inside."""
    near = 0
    for i in range(gap.size - 1):
        near |= (gap[i] < z) | (gap[i + 1] < z) | ((opening[i] < 0.0) & (opening[i + 1] > 0.0))
    return near == 0


@entry
def lobes(line: Matrix, start: int, end: int, z: float, lobe: Lobes) -> int:
    """Fill `lobe` with the runs of y in which the wheel, lowered by z, lies inside the rail. Return their number.

    Points are weighted with depth^(5/2), which is the square of the interpenetration integrated along x. The mean
    position becomes the reference point, and the mean direction of the rail becomes the contact angle. So both move
    smoothly with the pose, and a new lobe enters without a jump. The weight is that of CONTACT: its printed reference
    points are reproduced with this power and with no other (tests/geometry/test_against_contact.py).
    """
    k, inside = -1, False
    gap, opening = line[Curve.GAP, start:end], line[Curve.OPENING, start:end]
    apart = False
    for i in range(end - start - 1):
        if i % _BLOCK == 0:
            apart = _are_apart(gap[i : i + _BLOCK + 1], opening[i : i + _BLOCK + 1], z)
        if apart or (gap[i] >= z and gap[i + 1] >= z and not opening[i] < 0.0 < opening[i + 1]):  # nearly everywhere
            continue
        j = start + i
        g0, g1 = line[Curve.GAP, j] - z, line[Curve.GAP, j + 1] - z
        m0, m1, h = line[Curve.OPENING, j], line[Curve.OPENING, j + 1], line[Curve.Y, j + 1] - line[Curve.Y, j]
        t0, t1 = 0.0, 1.0
        if g0 >= 0.0 and g1 >= 0.0:
            t, g = cubic.interior_minimum(h, g0, m0, g1, m1)
            if t < 0.0 or g >= 0.0:
                continue
            t0 = cubic.crossing(h, g0, m0, g1, m1, 0.0, 0.0, t)
            t1 = cubic.crossing(h, g0, m0, g1, m1, 0.0, t, 1.0)
        elif g0 >= 0.0:
            t0 = cubic.crossing(h, g0, m0, g1, m1, 0.0, 0.0, 1.0)
        elif g1 >= 0.0:
            t1 = cubic.crossing(h, g0, m0, g1, m1, 0.0, 0.0, 1.0)
        if not inside:
            if k == MAX_LOBES - 1:
                return MAX_LOBES
            k += 1
            lobe[k].weight, lobe[k].moment, lobe[k].cosine, lobe[k].sine = 0.0, 0.0, 0.0, 0.0
            lobe[k].x_low, lobe[k].x_high, lobe[k].moment_x, lobe[k].slant = 0.0, 0.0, 0.0, 0.0
            lobe[k].step_x, lobe[k].step_y = 0.0, 0.0
            lobe[k].low = line[Curve.Y, j] + t0 * h
            lobe[k].low_z = at(line, j, lobe[k].low)[0] + z
        _add_moments(line, j, z, t0, t1, lobe, k)
        lobe[k].high = line[Curve.Y, j] + t1 * h
        lobe[k].high_z = at(line, j, lobe[k].high)[0] + z
        inside = g1 < 0.0
    return k + 1


@kernel
def _transition(value: float, limit: float) -> float:
    """Return 0 up to the limit, 1 from 5/4 of it on, and a smooth step between; always 1 for a limit below 0."""
    if limit <= 0.0:
        return 1.0 if value > 0.0 or limit < 0.0 else 0.0
    t = min(max((value - limit) / (_TRANSITION * limit), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


@entry
def combine(lobe: Lobes, n: int, distance: float, angle: float, most: int) -> int:
    """Merge neighbouring lobes in place into at most `most` patches. Return the number of patches.

    Two lobes become separate patches if their nearest edges are further apart than `distance` [m], in a straight line,
    and their angles differ by more than `angle` [rad]. Otherwise they share one plane. From 1 to 5/4 of these limits
    they count in both ways, each with a share (`shared`). No normal method has the same result for two lobes in one
    plane and for each alone, so only a mean of both passes smoothly from one to the other. CONTACT lets the interaction
    of lobes fade from 4 to 8 mm and uses separate planes from there on, whatever the angle.

    The angle of each side is that of all lobes near it on this side. So it does not matter whether these are one lobe
    or two.
    """
    for i in range(1, n):
        dy, dz = lobe[i].low - lobe[i - 1].high, lobe[i].low_z - lobe[i - 1].high_z
        dx = max(lobe[i].x_low - lobe[i - 1].x_high, lobe[i - 1].x_low - lobe[i].x_high, 0.0)
        if dx > 0.0 and dy < 0.0:  # surfaces that touch one behind the other
            dy, dz = 0.0, 0.0
        lobe[i].tie = 1.0 - _transition(math.sqrt(dx * dx + dy * dy + dz * dz), distance)
    k, tie, cosine, sine = 0, 0.0, 0.0, 0.0
    for i in range(1, n):
        cosine, sine = lobe[i - 1].cosine + tie * cosine, lobe[i - 1].sine + tie * sine
        tie = lobe[i].tie
        share, cosine_ahead, sine_ahead = 1.0, 0.0, 0.0
        for j in range(i, n):
            share *= lobe[j].tie if j > i else 1.0
            cosine_ahead += share * lobe[j].cosine
            sine_ahead += share * lobe[j].sine
        turn = abs(math.atan2(sine_ahead, cosine_ahead) - math.atan2(sine, cosine))
        apart = (1.0 - tie) * _transition(turn, angle)
        if apart > 0.0 and k < most - 1:
            k += 1
            lobe[k] = lobe[i]
            lobe[k].tie = 1.0 - apart
        else:
            join(lobe[i], lobe[k])
    return k + 1 if n > 0 else 0


@kernel
def join(lobe: Record, patch: Record) -> None:
    """Add a lobe to the patch on its left."""
    if lobe.high > patch.high:
        patch.high, patch.high_z = lobe.high, lobe.high_z
    patch.low = min(patch.low, lobe.low)
    patch.x_low, patch.x_high = min(patch.x_low, lobe.x_low), max(patch.x_high, lobe.x_high)
    patch.step_x, patch.step_y = max(patch.step_x, lobe.step_x), max(patch.step_y, lobe.step_y)
    patch.moment_x += lobe.moment_x
    patch.slant += lobe.slant
    patch.weight += lobe.weight
    patch.moment += lobe.moment
    patch.cosine += lobe.cosine
    patch.sine += lobe.sine


@entry
def shared(lobe: Lobes, n: int, first: int, last: int) -> float:
    """Return the share with which the patches first … last of `n` count as one. The shares of each patch add up to 1."""
    share = 1.0 if first == 0 else 1.0 - lobe[first].tie
    for k in range(first + 1, last + 1):
        share *= lobe[k].tie
    return share if last == n - 1 else share * (1.0 - lobe[last + 1].tie)


@entry
def untie(lobe: Lobes, n: int, most: int) -> None:
    """Round ties until `n` patches, with all patches that they form together, are at most `most`.

    The tie nearest to 0 or 1 is rounded first.
    """
    for _ in range(n):
        count = 0
        for last in range(n):
            for first in range(last + 1):
                count += 1 if shared(lobe, n, first, last) > 0.0 else 0
        if count <= most:
            return
        nearest, least_rest = 0, 2.0
        for k in range(1, n):
            rest = min(lobe[k].tie, 1.0 - lobe[k].tie)
            if 0.0 < rest < least_rest:
                nearest, least_rest = k, rest
        lobe[nearest].tie = 1.0 if lobe[nearest].tie >= 0.5 else 0.0
