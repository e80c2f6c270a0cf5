"""Stresses in a half space z >= 0 under uniform tractions on a rectangle, as differences of functions of its corners.

With the potentials of a uniform load on the rectangle, V = ∬1/R, L = ∬ln(R + z), K = ∬(z ln(R + z) - R), the stresses are
(Love 1929; Kalker 1990 [R]; written out and checked against CONTACT by this project, subsurface.md), times 1/(2π),

    pressure 1:    xx = -m L_xx - z V_xx + 2nu V_z         traction x:  xx = 2(1 + nu) V_x + 2nu K_xxx - z L_xxx
    (m = 1 - 2nu)  yy = -m L_yy - z V_yy + 2nu V_z         (y: exchange yy = 2nu V_x + 2nu K_xyy - z L_xyy
                   zz = V_z - z V_zz                        x and y)    zz = -z V_xz
                   xy = -m L_xy - z V_xy                                xy = V_y + 2nu K_xxy - z L_xxy
                   xz = -z V_xz                                         xz = V_z - z V_xx
                   yz = -z V_yz                                         yz = -z V_xy

Every derivative is f(X+, Y+) - f(X+, Y-) - f(X-, Y+) + f(X-, Y-) with X± = x - x_c ± dx/2, Y± likewise. `of_corners` gives
the sum of these terms, f(X, Y, z).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: A distance to an edge below this [m] counts as this. On an edge the stress xx is logarithmically infinite.
_EDGE = 1e-30


def of_corners(X: Array, Y: Array, z: Array | float, poisson_ratio: float) -> Array:
    """Return the corner functions of the stresses, shape (3, 6, …), for distances `X`, `Y` [m] and depth `z` >= 0 [m].

    The first axis is the load: pressure, traction along x, traction along y. The second is the stress: xx, yy, zz, xy, xz,
    yz. All arguments broadcast.
    """
    nu, m = poisson_ratio, 1.0 - 2.0 * poisson_ratio
    X, Y, z = np.broadcast_arrays(X, Y, z)
    x2, y2, z2 = X * X, Y * Y, z * z
    R = np.sqrt(x2 + y2 + z2)
    safe = np.maximum(R, _EDGE)
    beyond_y, beyond_x = _sum(R, Y, x2 + z2), _sum(R, X, y2 + z2)  # R + Y, R + X
    deep = np.maximum(R + z, _EDGE)
    shallow = (x2 + y2) / deep  # R - z
    V_x, V_y, V_z = np.log(beyond_y), np.log(beyond_x), -np.arctan2(X * Y, z * R)
    V_xx, V_yy, V_xy = X / (safe * beyond_y), Y / (safe * beyond_x), 1.0 / safe
    V_xz, V_yz = z / (safe * beyond_y), z / (safe * beyond_x)
    V_xx, V_yy = (np.where(z > 0.0, v, 0.0) for v in (V_xx, V_yy))  # they only appear times z
    L_xx = np.arctan2(X * Y * shallow, x2 * R + z * y2)
    L_yy = np.arctan2(X * Y * shallow, y2 * R + z * x2)
    L_xy, L_xxy, L_xyy = np.log(deep), X / (safe * deep), Y / (safe * deep)
    K_xxy, K_xyy = -X / deep, -Y / deep
    pressed = (
        -m * L_xx - z * V_xx + 2.0 * nu * V_z,
        -m * L_yy - z * V_yy + 2.0 * nu * V_z,
        V_z + z * (V_xx + V_yy),
        -m * L_xy - z * V_xy,
        -z * V_xz,
        -z * V_yz,
    )
    along_x = (
        2.0 * V_x - 2.0 * nu * K_xyy + z * (L_xyy + V_xz),
        2.0 * nu * (V_x + K_xyy) - z * L_xyy,
        -z * V_xz,
        V_y + 2.0 * nu * K_xxy - z * L_xxy,
        V_z - z * V_xx,
        -z * V_xy,
    )
    along_y = (
        2.0 * nu * (V_y + K_xxy) - z * L_xxy,
        2.0 * V_y - 2.0 * nu * K_xxy + z * (L_xxy + V_yz),
        -z * V_yz,
        V_x + 2.0 * nu * K_xyy - z * L_xyy,
        -z * V_xy,
        V_z - z * V_yy,
    )
    return np.stack([np.stack(load) for load in (pressed, along_x, along_y)]) / (2.0 * math.pi)


def _sum(R: Array, s: Array, rest: Array) -> Array:
    """Return R + s without cancellation, where rest = R² - s²."""
    size = np.abs(s)
    return np.where(s >= 0.0, R + size, np.maximum(rest, _EDGE**2) / np.maximum(R + size, _EDGE)) + _EDGE**2
