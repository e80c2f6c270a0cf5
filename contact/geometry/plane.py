"""Kernels that turn the curves of wheel and rail into a contact plane.

A frame is (y0, z0, c, s): origin in track coordinates, cosine and sine of the contact angle. Along the plane runs
u = (y - y0) c + (z - z0) s; the height along its normal, from the wheel into the rail, is v = (z - z0) c - (y - y0) s.
"""

from contact._jit import kernel
from contact.geometry.curve import SLOPE, Array, Y, Z, advance, at, least

Frame = tuple[float, float, float, float]

_STEEPEST = 0.17  # cosine of the largest angle between a surface and the contact plane, 80°


@kernel
def along(frame: Frame, y: float, z: float) -> float:
    """Coordinate u of a point in track coordinates."""
    y0, z0, c, s = frame
    return (y - y0) * c + (z - z0) * s


@kernel
def track_slope(frame: Frame, slope: float) -> float:
    """dz/dy in track coordinates of a direction with slope dv/du in the plane."""
    c, s = frame[2], frame[3]
    return (slope * c + s) / (c - slope * s)


@kernel
def faces(frame: Frame, slope: float) -> bool:
    """Does a surface of slope dz/dy face the plane, within 80°?"""
    cosine = frame[2] + slope * frame[3]
    return cosine > 0.0 and cosine * cosine > _STEEPEST**2 * (1.0 + slope * slope)


@kernel
def project(
    curve: Array, start: int, end: int, centre: int, dz: float, frame: Frame, low: float, high: float, out: Array
) -> int:
    """Nodes of `curve`, lowered by dz, in the plane: those around node `centre` that face it, out to just beyond low … high.

    Returns their number; `out` is then a curve v(u) with u increasing.
    """
    y0, z0, c, s = frame
    first = last = centre
    while first > start and along(frame, curve[Y, first], curve[Z, first] + dz) > low:
        if not faces(frame, curve[SLOPE, first - 1]):
            break
        first -= 1
    while last < end - 1 and along(frame, curve[Y, last], curve[Z, last] + dz) < high:
        if not faces(frame, curve[SLOPE, last + 1]):
            break
        last += 1
    for j in range(first, last + 1):
        y, z, m = curve[Y, j] - y0, curve[Z, j] + dz - z0, curve[SLOPE, j]
        out[Y, j - first] = y * c + z * s
        out[Z, j - first] = z * c - y * s
        out[SLOPE, j - first] = (m * c - s) / (c + m * s)
    return last + 1 - first


@kernel
def depth(wheel: Array, n_wheel: int, rail: Array, n_rail: int, low: float, high: float) -> float:
    """Greatest depth of the wheel in the rail along the normal between `low` and `high`; both curves are in the plane."""
    i, j = advance(rail, n_rail, 0, low), advance(wheel, n_wheel, 0, low)
    u = low
    r, rm = at(rail, i, u)
    w, wm = at(wheel, j, u)
    g0, m0 = r - w, rm - wm
    lowest = g0
    while u < high:
        v = min(wheel[Y, j + 1], high) if j < n_wheel - 2 else high
        i = advance(rail, n_rail, i, v)
        r, rm = at(rail, i, v)
        w, wm = at(wheel, j, v)
        g1, m1 = r - w, rm - wm
        lowest = min(lowest, g1)
        if m0 < 0.0 < m1:
            t, g = least(g0, g1, m0, m1, v - u)
            if t > 0.0:
                lowest = min(lowest, g)
        u, g0, m0, j = v, g1, m1, min(j + 1, n_wheel - 2)
    return max(-lowest, 0.0)
