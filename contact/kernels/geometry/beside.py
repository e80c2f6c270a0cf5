"""The wheel beside its trace line: the parabolas along x of a wheel that is yawed on its flange (theory.md 9.4).

A separation has one parabola along x for every y. Taken from the trace line alone, with its curvature there, they invent a
crease: where the wheel's profile changes its curvature, x_c(y) bends at one y, while on the wheel this place runs obliquely
through the patch, along the ring. Where rings cross a good part of the patch's width, each parabola goes through three points
of the wheel instead.
"""

import math

from contact.core import kernel
from contact.kernels.arrays import Search
from contact.kernels.geometry.curve import Array, Record, advance, at
from contact.kernels.geometry.plane import Frame
from contact.kernels.geometry.search import axle
from contact.kernels.rows import Curve, Sep

Vector = tuple[float, float, float]

#: Way of a ring across the patch, from its middle to its end, over half the width: from the first number on points beside the
#: trace line count, from the second one on in full.
_LITTLE, _MUCH = 0.1, 0.2
#: Distance of the outer points from the middle of a row over its half length. With the row's depth as weight they are those
#: of Gauss, so the parabola is nearly the best one.
_NODE = math.sqrt(3.0 / 7.0)
#: A row is at least as long as at this share of the approach above its least gap.
_LEAST_DEPTH = 0.15
#: Longest half length of a row over the wheel's radius: where the wheel hardly curves, as in a profile's noise.
_LONGEST = 0.2
#: The curvature changes by this factor at most, either way.
_MOST = 4.0
#: Turns of the fit, each about the middle that the last one found.
_TURNS = 2
#: Least cosine of the contact angle in the way of a ring.
_STEEPEST = 0.05
#: Every how many-th row is held against the wheel at its ends. A polynomial t (t² - 3/7) (α + β t) is zero at the points of the
#: parabola. Its slope has the mean square `_CUBIC` α² + `_QUARTIC` β², weighted with the depth of the row. `_OF_SLOPE` of the
#: root is what `parabolas.fit_rows` counts as error of a row of a surface (correlation .99 on 66 patches of flanges).
_EVERY, _CUBIC, _QUARTIC, _OF_SLOPE = 3, 0.4408, 0.3211, 0.7


@kernel
def share_beside(patch: Record, motion: Record) -> float:
    """Return the share, from 0 to 1, with which points beside the trace line count."""
    cosine = max(math.cos(patch.angle), _STEEPEST)
    half_length = math.sqrt(2.0 * patch.approach * motion.radius / cosine)
    way = abs(axle(motion.roll, motion.yaw)[0]) / cosine * half_length
    t = min(max((2.0 * way / (patch.high - patch.low) - _LITTLE) / (_MUCH - _LITTLE), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


@kernel
def _drop(
    wheel: Array, j: int, motion: Record, point: Vector, normal: Vector, axis: Vector, first: float
) -> tuple[float, int]:
    """Return the distance of the wheel from a point, against the `normal` [m], and the node of its profile there.

    The point is relative to the wheelset's centre. `first` is about the distance; one step of Newton's leaves some nanometres.
    """
    x, py, pz = point
    _, ny, nz = normal
    lx, ly, lz = axis
    n = wheel.shape[1]
    y, z = py - first * ny, pz - first * nz
    d = lx * x + ly * y + lz * z
    r = math.sqrt(x * x + y * y + z * z - d * d)
    u = min(max(d - motion.tape, wheel[Curve.Y, 0]), wheel[Curve.Y, n - 1])
    while j > 0 and wheel[Curve.Y, j] > u:
        j -= 1
    j = advance(wheel, n, j, u)
    height, slope = at(wheel, j, u)
    above = r - motion.radius - height - slope * (d - motion.tape - u)
    along = ly * ny + lz * nz
    return first + above / ((y * ny + z * nz - d * along) / r - slope * along), j


@kernel
def _slope_error(front: float, back: float) -> float:
    """Return how far the slope of a row is off its parabola, times its half length [m], from the distances at both ends."""
    cubic, quartic = 0.5 * (front - back), 0.5 * (front + back)
    return math.sqrt(_CUBIC * cubic * cubic + _QUARTIC * quartic * quartic) / (1.0 - _NODE * _NODE)


@kernel
def fit_beside(
    share: float, frame: Frame, patch: Record, limits: tuple[float, float], out: Array, space: Search
) -> None:
    """Replace G, A and XC of the separation `out` by the parabolas through points beside the trace line, by `share`.

    `patch.fit_error` becomes what the worst row of the wheel is off its parabola, as on surfaces (`parabolas.fit_rows`).
    XC is relative to the patch's reference point. Positions beyond the `limits` have the wheel of the nearer end. The heights
    of the trace line in the frame are in `space.work[1]`.
    """
    low, high = limits
    y0, z0, c, s = frame
    motion, wheel, heights = space.motion[0], space.wheel, space.work[1]
    axis, normal = axle(motion.roll, motion.yaw), (0.0, -s, c)
    ahead, behind, longest, worst = 0, 0, _LONGEST * motion.radius, 0.0
    for k in range(out.shape[1]):
        u, v = min(max(out[Sep.Y, k], low), high), heights[k]
        py, pz = y0 + u * c - v * s - motion.y, z0 + u * s + v * c - motion.z + motion.radius
        A, x, level = out[Sep.A, k], out[Sep.XC, k] + patch.x, 0.0
        for turn in range(_TURNS):
            half = math.sqrt(max(patch.approach - out[Sep.G, k] - level, _LEAST_DEPTH * patch.approach) / A)
            half = min(half, longest)
            step = _NODE * half
            first, middle = level + A * step * step, 0.0
            if turn > 0:
                middle, ahead = _drop(wheel, ahead, motion, (x, py, pz), normal, axis, level)
            front, ahead = _drop(wheel, ahead, motion, (x + step, py, pz), normal, axis, first)
            back, behind = _drop(wheel, behind, motion, (x - step, py, pz), normal, axis, first)
            A = min(max((front + back - 2.0 * middle) / (2.0 * step * step), A / _MOST), A * _MOST)
            shift = min(max((back - front) / (4.0 * A * step), -half), half)
            x, level = x + shift, middle - A * shift * shift
        if not abs(level) + abs(A) + abs(x) < math.inf:  # beyond the wheel, far from all contact
            continue
        depth = patch.approach - out[Sep.G, k] - level
        if k % _EVERY == 0 and depth > 0.0:
            half = min(math.sqrt(depth / A), longest)
            end = level + A * half * half
            front, ahead = _drop(wheel, ahead, motion, (x + half, py, pz), normal, axis, end)
            back, behind = _drop(wheel, behind, motion, (x - half, py, pz), normal, axis, end)
            error = _slope_error(front - end, back - end) * math.sqrt(depth / patch.approach) / (2.0 * patch.approach)
            if error > worst:
                worst = error
        out[Sep.G, k] += share * level
        out[Sep.A, k] += share * (A - out[Sep.A, k])
        out[Sep.XC, k] += share * (x - patch.x - out[Sep.XC, k])
    patch.fit_error = share * _OF_SLOPE * worst
