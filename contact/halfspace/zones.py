"""Coulomb's law for the Newton iteration of TANG: stick and slip of each element, for fields of shape (2, ny, nx)."""

import math

from contact.core import entry
from contact.kernels.arrays import Cube, FourD, Matrix

#: Values of the array `zone`
OUTSIDE, STICK, SLIP = 0.0, 1.0, 2.0


@entry
def linearise(q: Cube, s: Cube, bound: Matrix, rho: float, zone: Matrix, step: FourD, stiffness: Matrix) -> float:
    """Set up the Newton step for q = projection of q - s/rho on the disc of radius `bound`. Return the squared residual.

    Let z = q - s/rho. An element with |z| <= bound sticks, and the step has to make its s zero. All others slip, against
    the direction z/|z|: `correction` moves q onto the circle, and the rest of the step, along `tangent`, turns q until the
    slip has no component along the tangent. `stiffness` = rho (|z|/bound - 1) is slip over bound at the solution. `step`,
    shape (3, 2, ny, nx), holds tangent, correction and right-hand side.
    """
    tangent, correction, rhs = step[0], step[1], step[2]
    total = 0.0
    for i in range(bound.shape[0]):
        for j in range(bound.shape[1]):
            g = bound[i, j]
            zone[i, j], stiffness[i, j] = OUTSIDE, 0.0
            for k in range(2):
                tangent[k, i, j], correction[k, i, j], rhs[k, i, j] = 0.0, 0.0, 0.0
            if g <= 0.0:
                continue
            qx, qy, sx, sy = q[0, i, j], q[1, i, j], s[0, i, j], s[1, i, j]
            zx, zy = qx - sx / rho, qy - sy / rho
            z = math.sqrt(zx * zx + zy * zy)
            if z <= g:
                zone[i, j] = STICK
                rhs[0, i, j], rhs[1, i, j] = -sx, -sy
                total += (sx * sx + sy * sy) / (rho * rho)
                continue
            zone[i, j] = SLIP
            nx, ny = zx / z, zy / z
            total += (qx - g * nx) ** 2 + (qy - g * ny) ** 2
            beyond = nx * qx + ny * qy - g
            across = (ny * sx - nx * sy) * z / g
            tangent[0, i, j], tangent[1, i, j] = -ny, nx
            correction[0, i, j], correction[1, i, j] = -beyond * nx, -beyond * ny
            rhs[0, i, j], rhs[1, i, j] = -ny * across, nx * across
            stiffness[i, j] = rho * (z / g - 1.0)
    return total


@entry
def restrict(v: Cube, zone: Matrix, tangent: Cube) -> None:
    """Restrict `v` in place: unchanged in stick, its component along `tangent` in slip, zero outside."""
    for i in range(zone.shape[0]):
        for j in range(zone.shape[1]):
            if zone[i, j] == SLIP:
                tx, ty = tangent[0, i, j], tangent[1, i, j]
                along = tx * v[0, i, j] + ty * v[1, i, j]
                v[0, i, j], v[1, i, j] = along * tx, along * ty
            elif zone[i, j] == OUTSIDE:
                v[0, i, j], v[1, i, j] = 0.0, 0.0


@entry
def accumulate(
    v: Cube, u: Cube, zone: Matrix, stiffness: Matrix, own: float, gain: float, share: float, out: Cube
) -> None:
    """Precondition `v` into `out`: in stick the sum of `gain`·`u` from the leading edge, in slip `v` over a flexibility.

    The flexibility is that of the element itself (`own`) plus `stiffness`. From one element to the next the sum is
    multiplied by `share` (1 in steady rolling, 0 in a time step).
    """
    nx = zone.shape[1]
    for i in range(zone.shape[0]):
        sum_x, sum_y = 0.0, 0.0
        for j in range(nx - 1, -1, -1):
            sum_x, sum_y = share * sum_x, share * sum_y
            if zone[i, j] == STICK:
                sum_x += gain * u[0, i, j]
                sum_y += gain * u[1, i, j]
                out[0, i, j], out[1, i, j] = sum_x, sum_y
            else:
                flexibility = own + stiffness[i, j]
                out[0, i, j], out[1, i, j] = v[0, i, j] / flexibility, v[1, i, j] / flexibility


@entry
def admit(q: Cube, zone: Matrix, bound: Matrix) -> None:
    """Scale the traction of slipping elements back onto the circle |q| = bound."""
    for i in range(bound.shape[0]):
        for j in range(bound.shape[1]):
            if zone[i, j] == SLIP:
                # compilers divide before the condition, where q may be zero; the bound over 1e-290 Pa is still a number
                size = math.sqrt(q[0, i, j] ** 2 + q[1, i, j] ** 2) + 1e-290
                q[0, i, j] *= bound[i, j] / size
                q[1, i, j] *= bound[i, j] / size


@entry
def settle(q: Cube, s: Cube, zone: Matrix, bound: Matrix) -> None:
    """Make the last iterate admissible: |q| <= bound, slip opposite to q, and no slip outside the slip zone."""
    for i in range(bound.shape[0]):
        for j in range(bound.shape[1]):
            g = bound[i, j]
            size = math.sqrt(q[0, i, j] ** 2 + q[1, i, j] ** 2)
            if size > g or (zone[i, j] == SLIP and size > 0.0):
                q[0, i, j] *= g / size
                q[1, i, j] *= g / size
            slip = 0.0
            if zone[i, j] == SLIP and g > 0.0:
                slip = max(-(q[0, i, j] * s[0, i, j] + q[1, i, j] * s[1, i, j]) / g, 0.0)
            for k in range(2):
                s[k, i, j] = -slip * q[k, i, j] / g if slip > 0.0 else 0.0
