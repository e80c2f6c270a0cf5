"""Conformal geometry: a contact angle that varies over the patch (theory.md 8.6).

The surface in which the bodies touch is not the plane of the separation. Relative to this plane it has the slope `tilt`
= dz/dy = tan Δ and the height ζ = ∫ tan Δ dy. Let a wheel turn by κ radians per metre rolled (κ = cos(contact
angle)/rolling radius, about the y axis of the plane). By rigid kinematics it slides there

    longitudinally  ξ - κ ζ - phi y,    along the surface  η cos Δ + (phi cos Δ + κ sin Δ) x.

So each strip has its own creepages. κ ζ is the exact change of the rolling radius. In straight rolling phi cos Δ + κ
sin Δ = sin(angle + Δ)/r. Pressure and traction act in the surface, whose area is that of the plane divided by cos Δ.
The normal load remains that of the plane, the pressure gives the lateral force ∫ p tan Δ dA, and the traction grows by
1/cos Δ. Two effects are left out: the part of the traction along the plane's normal, and the effect of the surface's
curvature on the elastic bodies (about 5 %, thesis 8.1).
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Case, Matrix, Numbers, Samples
from contact.kernels.rows import Field, Strip


@entry
def surface_at(y: Numbers, tilt: Numbers, at: float) -> tuple[float, float]:
    """Return slope [-] and height [m] of the surface at y = `at`. The height counts from the first sample.

    The slope is linear between samples and constant beyond them.
    """
    n, height, k = y.size, 0.0, 1
    while k < n and y[k] <= at:
        height += 0.5 * (tilt[k] + tilt[k - 1]) * (y[k] - y[k - 1])
        k += 1
    if k == n or at <= y[0]:
        slope, end = (tilt[0], y[0]) if at <= y[0] else (tilt[n - 1], y[n - 1])
        return slope, height + slope * (at - end)
    slope = tilt[k - 1] + (tilt[k] - tilt[k - 1]) * (at - y[k - 1]) / (y[k] - y[k - 1])
    return slope, height + 0.5 * (slope + tilt[k - 1]) * (at - y[k - 1])


@entry
def bend(sep: Samples, case: Case, strips: Matrix, n: int) -> None:
    """Set slope and creepages of each of `n` strips by its position on the surface. `case.rolling` is κ [1/m]."""
    y, tilt, rolling = sep.y, sep.tilt, case.rolling
    vx, vy, phi = case.vx, case.vy, case.phi
    _, origin = surface_at(y, tilt, 0.0)
    for i in range(n):
        at = strips[Strip.Y, i]
        slope, height = surface_at(y, tilt, at)
        cosine = 1.0 / math.sqrt(1.0 + slope * slope)
        spin = (phi + rolling * slope) * cosine
        strips[Strip.TILT, i], strips[Strip.PHI, i] = slope, spin
        strips[Strip.VX, i] = vx - rolling * (height - origin) + (spin - phi) * at
        strips[Strip.VY, i] = vy * cosine


@kernel
def project(strips, n, fields, result):
    """Add to `result` what changes because tractions and pressure act in the surface and not in the plane.

    Before, the resultants are those of strips that lie in the plane.
    """
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
