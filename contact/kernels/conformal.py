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
from contact.kernels.layout import Field, Strip


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
def bend(sep, case, strips, n):
    """Give each of `n` strips the creepages of its place on the surface; `case.rolling` is κ [1/m]."""
    y, tilt, rolling = sep.y, sep.tilt, case.rolling
    vx, vy, phi = case.vx, case.vy, case.phi
    _, origin = surface_at(y, tilt, 0.0)
    for i in range(n):
        at = strips[Strip.Y, i]
        slope, height = surface_at(y, tilt, at)
        cosine = 1.0 / math.sqrt(1.0 + slope * slope)
        own = (phi + rolling * slope) * cosine
        strips[Strip.TILT, i], strips[Strip.PHI, i] = slope, own
        strips[Strip.VX, i] = vx - rolling * (height - origin) + (own - phi) * at
        strips[Strip.VY, i] = vy * cosine


@kernel
def project(strips, n, fields, result):
    """Turn resultants of the strips, as if they lay in the plane, into those of the surface."""
    for i in range(n):
        y, tilt = strips[Strip.Y, i], strips[Strip.TILT, i]
        more = math.sqrt(1.0 + tilt * tilt) - 1.0
        for k in range(fields.shape[2]):
            dA = fields[Field.DX, i, k] * strips[Strip.DY, i]
            fx, fy = more * fields[Field.QX, i, k] * dA, tilt * fields[Field.P, i, k] * dA
            result.Fx += fx
            result.Fy += fy
            result.pressure_y += fy
            result.Mz += fields[Field.X, i, k] * fy - y * fx
            power = fields[Field.QX, i, k] * fields[Field.SX, i, k] + fields[Field.QY, i, k] * fields[Field.SY, i, k]
            result.power -= more * power * dA
