"""Conformal geometry: a contact angle that varies over the patch (theory.md 8.6).

The surface in which the bodies touch is not the plane of the separation, but has the slope `tilt` = dz/dy = tan Δ against it
and the height ζ = ∫ tan Δ dy over it. A wheel that turns by κ radians per metre rolled (κ = cos(contact angle)/rolling radius,
about the y axis of the plane) slides there, by rigid kinematics,

    longitudinally  ξ - κ ζ - phi y,    along the surface  η cos Δ + (phi cos Δ + κ sin Δ) x,

so each strip has its own creepages: κ ζ is the exact change of the rolling radius, and phi cos Δ + κ sin Δ = sin(angle + Δ)/r
in straight rolling. Pressure and traction act in the surface, whose area is that of the plane over cos Δ: the normal load stays
that of the plane, the pressure gives the lateral force ∫ p tan Δ dA, the traction grows by 1/cos Δ. Left out are the part of
the traction along the plane's normal, and what the curvature of the surface does to the elastic bodies (about 5 %, thesis 8.1).
"""

import math

from contact._jit import kernel
from contact._layout import (
    CASE_PHI,
    CASE_VX,
    CASE_VY,
    FIELD_DX,
    FIELD_P,
    FIELD_QX,
    FIELD_QY,
    FIELD_SX,
    FIELD_SY,
    FIELD_X,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_POWER,
    RES_PRESSURE_Y,
    STRIP_DY,
    STRIP_PHI,
    STRIP_TILT,
    STRIP_VX,
    STRIP_VY,
    STRIP_Y,
)


@kernel
def surface_at(y, tilt, at):
    """Slope, and height from the first sample, of the surface whose slope is linear between samples; constant beyond them."""
    n, height, k = y.size, 0.0, 1
    while k < n and y[k] <= at:
        height += 0.5 * (tilt[k] + tilt[k - 1]) * (y[k] - y[k - 1])
        k += 1
    if k == n or at <= y[0]:
        slope, own = (tilt[0], y[0]) if at <= y[0] else (tilt[n - 1], y[n - 1])
        return slope, height + slope * (at - own)
    slope = tilt[k - 1] + (tilt[k] - tilt[k - 1]) * (at - y[k - 1]) / (y[k] - y[k - 1])
    return slope, height + 0.5 * (slope + tilt[k - 1]) * (at - y[k - 1])


@kernel
def bend(y, tilt, rolling, case, strips, n):
    """Give each of `n` strips the creepages of its place on the surface; `rolling` is κ [1/m]."""
    vx, vy, phi = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
    _, origin = surface_at(y, tilt, 0.0)
    for i in range(n):
        at = strips[STRIP_Y, i]
        slope, height = surface_at(y, tilt, at)
        cosine = 1.0 / math.sqrt(1.0 + slope * slope)
        own = (phi + rolling * slope) * cosine
        strips[STRIP_TILT, i], strips[STRIP_PHI, i] = slope, own
        strips[STRIP_VX, i] = vx - rolling * (height - origin) + (own - phi) * at
        strips[STRIP_VY, i] = vy * cosine


@kernel
def project(strips, n, fields, result):
    """Turn resultants of the strips, as if they lay in the plane, into those of the surface."""
    for i in range(n):
        y, tilt = strips[STRIP_Y, i], strips[STRIP_TILT, i]
        more = math.sqrt(1.0 + tilt * tilt) - 1.0
        for k in range(fields.shape[2]):
            dA = fields[FIELD_DX, i, k] * strips[STRIP_DY, i]
            fx, fy = more * fields[FIELD_QX, i, k] * dA, tilt * fields[FIELD_P, i, k] * dA
            result[RES_FX] += fx
            result[RES_FY] += fy
            result[RES_PRESSURE_Y] += fy
            result[RES_MZ] += fields[FIELD_X, i, k] * fy - y * fx
            power = fields[FIELD_QX, i, k] * fields[FIELD_SX, i, k] + fields[FIELD_QY, i, k] * fields[FIELD_SY, i, k]
            result[RES_POWER] -= more * power * dA
