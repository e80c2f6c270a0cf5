"""Creep forces from a table of our own half space, in the style of Kalker's USETAB (1996; theory.md 2.6).

Creepages enter as the forces of the linear theory over mu N,

    X = C11 G c² vx/(mu N),   Y = C22 G c² vy/(mu N),   Z = C23 G c³ phi/(mu N),

in spherical coordinates: size rho = r/(r + R0) with r² = X² + Y² + (w Z)², direction alpha of (X, Y), elevation beta of
the spin. The weight w(a/b) measures spin by the creepage that it causes at the edges of the patch, so that slip comes
about at r = 1 to 3 on every ellipse. X >= 0, Y >= 0 suffice, because of the two symmetries of theory.md 2.6. ln(a/b) is
the fourth coordinate.

The file holds Fx/(mu N), Fy/(mu N), Mz/(mu N c) and the share of slip at Poisson's ratio 0.28 for rho up to 1, which is
full slip. The interpolated quantity is the difference to the linear theory's force times R0 rho (1 - rho)/r. Its slope
at rho = 0 is zero, so the slopes at vanishing creepage are exactly Kalker's. The interpolation is cubic convolution
(Catmull and Rom), which is once continuously differentiable. Beyond the ends of the table's a/b the difference is that
of the end. The resultant is limited to mu N, because interpolation may exceed it.

On 300 random ellipses and creepages that are not in the table the force differs from that of the half space by .0011 of
mu N in the mean, .0044 at the 95th percentile and .017 at most. The moment differs by .0017 of mu N c
(`benchmarks/creep_table.py`).
"""

from __future__ import annotations

import math
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from contact.core import entry, kernel
from contact.kernels.arrays import FiveD
from contact.kernels.cubic import convolution

Array = NDArray[np.float64]
NU = 0.28
#: Number of nodes of ln(a/b) from LOG_ASPECT_MIN to LOG_ASPECT_MAX (a/b = .1 to 31.6; a third of the patches on flanges have 18
#: to 32), of alpha from 0 to 90°, of beta from -90° to 90°, of rho from 0 to 1.
N_ASPECT, N_ALPHA, N_BETA, N_RHO = 11, 6, 17, 16
LOG_ASPECT_MIN, LOG_ASPECT_MAX, R0 = -math.log(10.0), 1.5 * math.log(10.0), 1.5
#: Shape of the array that kernels take: one more node on every side, and twice four numbers.
SHAPE = (N_ASPECT + 2, N_ALPHA + 2, N_BETA + 2, N_RHO + 2, 8)


class Part(IntEnum):
    """First of the four numbers of a node that belong to forces, and to effective creepages (`tangential.effective`)."""

    FORCES = 0
    EFFECTIVE = 4


@entry
def spin_weight(log_aspect: float, c11: float, c22: float, c23: float) -> float:
    """Return the weight w of the spin [-].

    It is the rigid slip of spin at the edges, √((C11 b/2)² + (C22 a/2)²), over its lateral force C23 c.
    """
    root = math.exp(0.5 * log_aspect)  # a/c
    return 0.5 * math.sqrt((c11 / root) ** 2 + (c22 * root) ** 2) / c23


@kernel
def units(G, c, limit, log_aspect, coefficients):
    """Return X/vx, Y/vy, Z/phi and the weight w of Z; `limit` is mu N > 0."""
    c11, c22, c23, _ = coefficients
    unit = G * c * c / limit
    return c11 * unit, c22 * unit, c23 * unit * c, spin_weight(log_aspect, c11, c22, c23)


@kernel
def signs(X, Y, Z):
    """Return the signs of the two symmetries that make X and Y, or Z where Y is zero, 0 or more."""
    return 1.0 if X >= 0.0 else -1.0, 1.0 if Y > 0.0 or (Y == 0.0 and Z >= 0.0) else -1.0


@kernel
def is_beyond(log_aspect):
    """Return whether ln(a/b) lies beyond the table, which then answers with its outermost nodes."""
    return log_aspect < LOG_ASPECT_MIN or log_aspect > LOG_ASPECT_MAX


@kernel
def _cell(u, nodes):
    """Return the first of the four nodes around u in [0, nodes - 1], and their weights."""
    i = max(min(int(u), nodes - 2), 0)
    return i, convolution(u - i)


@kernel
def interpolated(log_aspect, X, Y, spin, first, table):
    """Return the four numbers of the table from `first` on at X >= 0, Y >= 0 and the weighted spin.

    The three creepages must not all be zero.
    """
    plane = math.sqrt(X * X + Y * Y)
    r = math.sqrt(plane * plane + spin * spin)
    share = min(max((log_aspect - LOG_ASPECT_MIN) / (LOG_ASPECT_MAX - LOG_ASPECT_MIN), 0.0), 1.0)
    i, of_aspect = _cell(share * (N_ASPECT - 1), N_ASPECT)
    j, of_alpha = _cell(math.atan2(Y, X) / (0.5 * math.pi) * (N_ALPHA - 1), N_ALPHA)
    k, of_beta = _cell((math.atan2(spin, plane) / math.pi + 0.5) * (N_BETA - 1), N_BETA)
    l, of_rho = _cell(r / (r + R0) * (N_RHO - 1), N_RHO)
    v0, v1, v2, v3 = 0.0, 0.0, 0.0, 0.0
    # & 3 tells a compiler that does not unroll these loops (WebAssembly) that no index leaves its tuple.
    for di in range(4):
        for dj in range(4):
            for dk in range(4):
                outer = of_aspect[di & 3] * of_alpha[dj & 3] * of_beta[dk & 3]
                w0, w1, w2, w3 = 0.0, 0.0, 0.0, 0.0  # short sums side by side: in a long one every addition waits
                for dl in range(4):
                    node, weight = table[i + di, j + dj, k + dk, l + dl], of_rho[dl & 3]
                    w0 += weight * node[first]
                    w1 += weight * node[first + 1]
                    w2 += weight * node[first + 2]
                    w3 += weight * node[first + 3]
                v0 += outer * w0
                v1 += outer * w1
                v2 += outer * w2
                v3 += outer * w3
    return v0, v1, v2, v3


@entry
def lookup(
    creepage: tuple[float, float, float],
    G: float,
    c: float,
    log_aspect: float,
    coefficients: tuple[float, float, float, float],
    limit: float,
    table: FiveD,
) -> tuple[float, float, float, float]:
    """Return Fx, Fy, Mz [N, N, N m] and the share of slip. `limit` is mu N, `table` is from `contact.theory.force_table`."""
    vx, vy, phi = creepage
    _, c22, c23, c33 = coefficients
    if limit <= 0.0 or (vx == 0.0 and vy == 0.0 and phi == 0.0):
        return 0.0, 0.0, 0.0, 0.0 if limit > 0.0 else 1.0
    unit_x, unit_y, unit_z, weight = units(G, c, limit, log_aspect, coefficients)
    X, Y, Z = unit_x * vx, unit_y * vy, unit_z * phi
    sign_x, sign_y = signs(X, Y, Z)
    X, Y, Z = sign_x * X, sign_y * Y, sign_y * Z
    spin = weight * Z
    Fx, Fy, Mz, slip = interpolated(log_aspect, X, Y, spin, Part.FORCES, table)
    r = math.sqrt(X * X + Y * Y + spin * spin)
    linear = R0 * R0 / ((r + R0) * (r + R0))  # R0 rho (1 - rho) over r
    Fx, Fy = Fx - linear * X, Fy - linear * (Y + Z)
    Mz += linear * (c23 / c22 * Y - c33 / c23 * Z)
    size = math.sqrt(Fx * Fx + Fy * Fy)
    factor = limit / size if size > 1.0 else limit
    return sign_x * factor * Fx, sign_y * factor * Fy, sign_y * limit * c * Mz, min(max(slip, 0.0), 1.0)
