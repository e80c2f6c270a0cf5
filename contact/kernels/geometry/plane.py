"""Kernels that transform the curves of wheel and rail into a contact plane.

A frame is (y0, z0, c, s): origin in track coordinates, cosine and sine of the contact angle. The coordinate along the
plane is u = (y - y0) c + (z - z0) s. The height along its normal, from the wheel into the rail, is v = (z - z0) c - (y
- y0) s.
"""

import math

from contact.core import kernel
from contact.kernels.cubic import interior_minimum
from contact.kernels.geometry.curve import Array, advance, at
from contact.kernels.rows import Curve

Frame = tuple[float, float, float, float]

_STEEPEST = 0.17  # cosine of the largest angle between a surface and the contact plane, 80°
_NEAR = 50e-6  # [m] gap at which samples are half as dense as in contact, times `size_of`
_SPARSEST = 0.05  # least density of samples, relative to that in contact


@kernel
def along(frame: Frame, y: float, z: float) -> float:
    """Return the coordinate u [m] of a point in track coordinates."""
    y0, z0, c, s = frame
    return (y - y0) * c + (z - z0) * s


@kernel
def track_slope(frame: Frame, slope: float) -> float:
    """Return dz/dy in track coordinates of a direction with slope dv/du in the plane."""
    c, s = frame[2], frame[3]
    return (slope * c + s) / (c - slope * s)


@kernel
def cosine(frame: Frame, slope: float) -> float:
    """Return the cosine of the angle between a surface of slope dz/dy and the plane."""
    return (frame[2] + slope * frame[3]) / math.sqrt(1.0 + slope * slope)


@kernel
def _walk(
    curve: Array, start: int, end: int, j: int, ahead: int, dz: float, frame: Frame, limit: float
) -> tuple[int, float]:
    """Return the last node and the last u [m] of the part of `curve` that faces the plane.

    The search starts at node j and goes in the direction `ahead` (±1) up to `limit`. Where the curve turns away from
    the plane, the last u lies between two nodes, so that it moves smoothly with the frame.
    """
    c, s = frame[2], frame[3]
    while True:
        u = along(frame, curve[Curve.Y, j], curve[Curve.Z, j] + dz)
        if (u - limit) * ahead >= 0.0:
            return j, limit
        if not start <= j + ahead < end:
            return j, u
        slope = curve[Curve.SLOPE, j + ahead]
        facing = c + slope * s  # over the cosine of the slope: without root and division at every node
        if facing <= 0.0 or facing * facing < _STEEPEST * _STEEPEST * (1.0 + slope * slope):
            here, following = cosine(frame, curve[Curve.SLOPE, j]), cosine(frame, slope)
            if following < 0.5 * _STEEPEST:  # a corner: interpolation to the next node has no meaning
                return j, u
            beyond = along(frame, curve[Curve.Y, j + ahead], curve[Curve.Z, j + ahead] + dz)
            return j + ahead, u + (beyond - u) * (here - _STEEPEST) / (here - following)
        j += ahead


@kernel
def project(
    curve: Array, nodes: tuple[int, int, int], dz: float, frame: Frame, low: float, high: float, out: Array
) -> tuple[int, float, float]:
    """Fill `out` with the nodes of `curve`, lowered by dz, that face the plane. Return their number and a range of u [m].

    `out` is a curve v(u) with increasing u, out to just beyond low … high. `nodes` are the first, the end and the
    centre, around which the nodes are searched. The range of u is the part of low … high in which they face the plane.
    """
    start, end, centre = nodes
    if cosine(frame, curve[Curve.SLOPE, centre]) < _STEEPEST:
        return 0, 0.0, 0.0
    first, low = _walk(curve, start, end, centre, -1, dz, frame, low)
    last, high = _walk(curve, start, end, centre, 1, dz, frame, high)
    y0, z0, c, s = frame
    for j in range(first, last + 1):
        y, z, m = curve[Curve.Y, j] - y0, curve[Curve.Z, j] + dz - z0, curve[Curve.SLOPE, j]
        out[Curve.Y, j - first] = y * c + z * s
        out[Curve.Z, j - first] = z * c - y * s
        out[Curve.SLOPE, j - first] = (m * c - s) / (c + m * s)
    return last + 1 - first, low, high


@kernel
def normal_gap(wheel: Array, n_wheel: int, rail: Array, n_rail: int, low: float, high: float) -> float:
    """Fill the gap rows of the wheel's curve with rail minus wheel along the normal [m]. Return the smallest gap in low … high.

    A positive smallest gap counts as 0. Both curves are in the plane. Nodes beyond the rail's curve take the gap at its
    end.
    """
    i = 0
    for j in range(n_wheel):
        u = min(max(wheel[Curve.Y, j], rail[Curve.Y, 0]), rail[Curve.Y, n_rail - 1])
        i = advance(rail, n_rail, i, u)
        v, m = at(rail, i, u)
        wheel[Curve.GAP, j] = v - wheel[Curve.Z, j]
        wheel[Curve.OPENING, j] = m - wheel[Curve.SLOPE, j]
    lowest = 0.0
    for j in range(n_wheel - 1):
        if low <= wheel[Curve.Y, j] <= high:
            lowest = min(lowest, wheel[Curve.GAP, j])
        if (
            wheel[Curve.OPENING, j] < 0.0 < wheel[Curve.OPENING, j + 1]
            and wheel[Curve.Y, j] < high
            and wheel[Curve.Y, j + 1] > low
        ):
            h = wheel[Curve.Y, j + 1] - wheel[Curve.Y, j]
            t, g = interior_minimum(
                h, wheel[Curve.GAP, j], wheel[Curve.OPENING, j], wheel[Curve.GAP, j + 1], wheel[Curve.OPENING, j + 1]
            )
            if low <= wheel[Curve.Y, j] + t * h <= high and t > 0.0:
                lowest = min(lowest, g)
    return lowest


@kernel
def _share(wheel: Array, j: int, low: float, high: float, near: float) -> tuple[float, float, float]:
    """Return the ends of segment j within low … high and its share of the samples, width times density."""
    u0, u1 = max(wheel[Curve.Y, j], low), min(wheel[Curve.Y, j + 1], high)
    gap = max(0.5 * (wheel[Curve.GAP, j] + wheel[Curve.GAP, j + 1]), 0.0)
    return u0, u1, max(u1 - u0, 0.0) * max(near / (near + gap), _SPARSEST)


@kernel
def spread(wheel: Array, n_wheel: int, low: float, high: float, size: float, out: Array) -> None:
    """Fill `out` with sample positions over low … high, dense where the gap is small for a wheel of this `size`.

    Curvature jumps and narrow lobes may lie anywhere in a patch, but regions far from contact need few samples.
    """
    n, near = out.size, _NEAR * size
    total = 0.0
    for j in range(n_wheel - 1):
        total += _share(wheel, j, low, high, near)[2]
    step = total / (n - 1.0)
    passed, k = 0.0, 1
    for j in range(n_wheel - 1):
        u0, u1, share = _share(wheel, j, low, high, near)
        while k < n - 1 and k * step <= passed + share:
            out[k] = u0 + (u1 - u0) * (k * step - passed) / share
            k += 1
        passed += share
    out[0], out[n - 1] = low, high
