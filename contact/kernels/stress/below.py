"""Stresses in a half space z >= 0 under uniform tractions on rectangles, as differences of functions of their corners.

With the potentials of a uniform load on the rectangle, V = ∬1/R, L = ∬ln(R + z), K = ∬(z ln(R + z) - R), the stresses are
(Love 1929; Kalker 1990 [R]; written out and checked against CONTACT by this project, subsurface.md), times 1/(2π),

    pressure 1:    xx = -m L_xx - z V_xx + 2nu V_z         traction x:  xx = 2(1 + nu) V_x + 2nu K_xxx - z L_xxx
    (m = 1 - 2nu)  yy = -m L_yy - z V_yy + 2nu V_z         (y: exchange yy = 2nu V_x + 2nu K_xyy - z L_xyy
                   zz = V_z - z V_zz                        x and y)    zz = -z V_xz
                   xy = -m L_xy - z V_xy                                xy = V_y + 2nu K_xxy - z L_xxy
                   xz = -z V_xz                                         xz = V_z - z V_xx
                   yz = -z V_yz                                         yz = -z V_xy

Every derivative is f(X+, Y+) - f(X+, Y-) - f(X-, Y+) + f(X-, Y-) with X± = x - x_c ± dx/2, Y± likewise.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import FourD, LoadGrid, Matrix, Numbers

#: Loads (pressure, traction along x, traction along y) and stresses (xx, yy, zz, xy, xz, yz).
N_LOADS, N_STRESSES = 3, 6
#: A distance to an edge below this [m] counts as this. On an edge the stress xx is logarithmically infinite.
_EDGE = 1e-30


@kernel
def _sum(R, s, rest):
    """Return R + s without cancellation, where rest = R² - s²."""
    if s >= 0.0:
        return R + s + _EDGE**2
    return max(rest, _EDGE**2) / max(R - s, _EDGE) + _EDGE**2


@kernel
def _fill_corner(X, Y, z, nu, f):
    """Fill f[load, stress] with the functions of a corner at the distances X, Y [m], and the depth z [m]."""
    m, x2, y2, z2 = 1.0 - 2.0 * nu, X * X, Y * Y, z * z
    R = math.sqrt(x2 + y2 + z2)
    safe, deep = max(R, _EDGE), max(R + z, _EDGE)
    beyond_y, beyond_x = _sum(R, Y, x2 + z2), _sum(R, X, y2 + z2)  # R + Y, R + X
    shallow = (x2 + y2) / deep  # R - z
    V_x, V_y, V_z = math.log(beyond_y), math.log(beyond_x), -math.atan2(X * Y, z * R)
    V_xx, V_yy, V_xy = 0.0, 0.0, 1.0 / safe
    if z > 0.0:  # they only appear times z
        V_xx, V_yy = X / (safe * beyond_y), Y / (safe * beyond_x)
    V_xz, V_yz = z / (safe * beyond_y), z / (safe * beyond_x)
    L_xx = math.atan2(X * Y * shallow, x2 * R + z * y2)
    L_yy = math.atan2(X * Y * shallow, y2 * R + z * x2)
    L_xy, L_xxy, L_xyy = math.log(deep), X / (safe * deep), Y / (safe * deep)
    K_xxy, K_xyy = -X / deep, -Y / deep

    f[0, 0] = -m * L_xx - z * V_xx + 2.0 * nu * V_z
    f[0, 1] = -m * L_yy - z * V_yy + 2.0 * nu * V_z
    f[0, 2] = V_z + z * (V_xx + V_yy)
    f[0, 3] = -m * L_xy - z * V_xy
    f[0, 4] = -z * V_xz
    f[0, 5] = -z * V_yz

    f[1, 0] = 2.0 * V_x - 2.0 * nu * K_xyy + z * (L_xyy + V_xz)
    f[1, 1] = 2.0 * nu * (V_x + K_xyy) - z * L_xyy
    f[1, 2] = -z * V_xz
    f[1, 3] = V_y + 2.0 * nu * K_xxy - z * L_xxy
    f[1, 4] = V_z - z * V_xx
    f[1, 5] = -z * V_xy

    f[2, 0] = 2.0 * nu * (V_y + K_xxy) - z * L_xxy
    f[2, 1] = 2.0 * V_y - 2.0 * nu * K_xxy + z * (L_xxy + V_yz)
    f[2, 2] = -z * V_yz
    f[2, 3] = V_x + 2.0 * nu * K_xyy - z * L_xyy
    f[2, 4] = -z * V_xy
    f[2, 5] = V_z - z * V_yy

    for load in range(N_LOADS):
        for stress in range(N_STRESSES):
            f[load, stress] /= 2.0 * math.pi


@entry
def fill_corners(x: Numbers, y: Numbers, z: float, nu: float, one: Matrix, out: FourD) -> None:
    """Fill out[load, stress, i, j] with the functions of the corners at the distances x[j], y[i] [m]. `one` is scratch."""
    for i in range(y.size):
        for j in range(x.size):
            _fill_corner(x[j], y[i], z, nu, one)
            for load in range(N_LOADS):
                for stress in range(N_STRESSES):
                    out[load, stress, i, j] = one[load, stress]


@kernel
def _weight(field, i, j):
    """Return the weight of the corner before element (i, j): differences of the elements around it, 0 beyond the grid."""
    ny, nx = field.shape
    here = field[i, j] if i < ny and j < nx else 0.0
    left = field[i, j - 1] if i < ny and j > 0 else 0.0
    under = field[i - 1, j] if i > 0 and j < nx else 0.0
    both = field[i - 1, j - 1] if i > 0 and j > 0 else 0.0
    return (here - left) - (under - both)


@entry
def stresses_at(
    load: LoadGrid, sign: float, nu: float, x: Numbers, y: Numbers, z: Numbers, one: Matrix, out: Matrix
) -> None:
    """Fill out[k] with the stresses xx, yy, zz, xy, xz, yz [Pa] at the points x, y, z [m] of the half space.

    `sign` is 1 where the tractions of the load act on this body, -1 where the opposite ones do. `one` is scratch. The sum over
    elements of differences over their corners is done as a sum over corners of differences over elements.
    """
    ny, nx = load.p.shape
    dx, dy = (load.x[nx - 1] - load.x[0]) / (nx - 1), (load.y[ny - 1] - load.y[0]) / (ny - 1)
    out[:, :] = 0.0
    for i in range(ny + 1):
        at_y = load.y[i] - 0.5 * dy if i < ny else load.y[ny - 1] + 0.5 * dy
        for j in range(nx + 1):
            p, qx, qy = _weight(load.p, i, j), sign * _weight(load.qx, i, j), sign * _weight(load.qy, i, j)
            if p == 0.0 and qx == 0.0 and qy == 0.0:
                continue
            at_x = load.x[j] - 0.5 * dx if j < nx else load.x[nx - 1] + 0.5 * dx
            for k in range(x.size):
                _fill_corner(x[k] - at_x, y[k] - at_y, z[k], nu, one)
                for stress in range(N_STRESSES):
                    out[k, stress] += p * one[0, stress] + qx * one[1, stress] + qy * one[2, stress]
