"""Creep forces looked up, in the style of Kalker's USETAB (1996; theory.md 2.6), in a table of our own half space.

Creepages enter as the forces of the linear theory over mu N,

    X = C11 G c² vx/(mu N),   Y = C22 G c² vy/(mu N),   Z = C23 G c³ phi/(mu N),

in spherical coordinates: sizes rho = r/(r + R0), r² = X² + Y² + (w Z)², direction alpha of (X, Y), elevation beta of the spin.
The weight w(a/b) makes spin count as the creepage that it is at the edges of the patch, so that slip comes about at r = 1 to 3
on every ellipse. X >= 0, Y >= 0 suffice, by the two symmetries of theory.md 2.6. With ln(a/b) there are four coordinates.

The file holds Fx/(mu N), Fy/(mu N), Mz/(mu N c) and the share of slip at Poisson's ratio 0.28, rho up to 1, which is full slip.
What is interpolated, by cubic convolution (Catmull and Rom), once continuously differentiable, is the difference to the
linear theory's force times R0 rho (1 - rho), with zero slope at rho = 0: the slopes at vanishing creepage are Kalker's exactly.
Beyond a/b of the table's ends the difference is that of the end. The resultant is cut at mu N, as interpolation may exceed it.

On 300 random ellipses and creepages that it has not seen the force differs from the half space by .0023 of mu N in the mean,
.0091 at the 95th percentile and .026 at most, the moment by .0025 of mu N c (`benchmarks/creep_table.py`).
"""

from __future__ import annotations

import functools
import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact import kalker
from contact._jit import kernel
from contact.errors import ContactError

Array = NDArray[np.float64]

#: The tables that come with the package, forces and effective creepages; `contact table build` and `effective` make them.
FILE = Path(__file__).parent / "creep_table.csv"
EFFECTIVE_FILE = Path(__file__).parent / "effective_creepage.csv"
NU = 0.28
#: Nodes of ln(a/b) from -LOG_ASPECT_MAX on, of alpha from 0 to 90°, of beta from -90° to 90°, of rho from 0 to 1.
N_ASPECT, N_ALPHA, N_BETA, N_RHO = 9, 5, 13, 9
LOG_ASPECT_MAX, R0 = math.log(10.0), 1.5
#: Of the array that kernels take: one node more on every side, and twice four numbers.
SHAPE = (N_ASPECT + 2, N_ALPHA + 2, N_BETA + 2, N_RHO + 2, 8)
#: First of the four numbers of the forces and of the effective creepages (`contact.tangential.effective`).
FORCES, EFFECTIVE = 0, 4


@kernel
def spin_weight(log_aspect, c11, c22, c23):
    """Rigid slip of spin at the edges, √((C11 b/2)² + (C22 a/2)²), over its lateral force C23 c."""
    root = math.exp(0.5 * log_aspect)  # a/c
    return 0.5 * math.sqrt((c11 / root) ** 2 + (c22 * root) ** 2) / c23


@kernel
def _weights(t):
    """Cubic convolution between the second and the third of four nodes."""
    return (
        ((1.0 - 0.5 * t) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((2.0 - 1.5 * t) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    )


@kernel
def _cell(u, nodes):
    """First node of the four around u in [0, nodes - 1], with their weights."""
    i = max(min(int(u), nodes - 2), 0)
    return i, _weights(u - i)


@kernel
def interpolated(log_aspect, X, Y, spin, first, table):
    """The four numbers of the table from `first` on at X >= 0, Y >= 0 and the weighted spin, not all zero."""
    plane = math.sqrt(X * X + Y * Y)
    r = math.sqrt(plane * plane + spin * spin)
    share = min(max((log_aspect + LOG_ASPECT_MAX) / (2.0 * LOG_ASPECT_MAX), 0.0), 1.0)
    i, of_aspect = _cell(share * (N_ASPECT - 1), N_ASPECT)
    j, of_alpha = _cell(math.atan2(Y, X) / (0.5 * math.pi) * (N_ALPHA - 1), N_ALPHA)
    k, of_beta = _cell((math.atan2(spin, plane) / math.pi + 0.5) * (N_BETA - 1), N_BETA)
    l, of_rho = _cell(r / (r + R0) * (N_RHO - 1), N_RHO)
    v0, v1, v2, v3 = 0.0, 0.0, 0.0, 0.0
    for di in range(4):
        for dj in range(4):
            for dk in range(4):
                outer = of_aspect[di] * of_alpha[dj] * of_beta[dk]
                w0, w1, w2, w3 = 0.0, 0.0, 0.0, 0.0  # short sums side by side: one long one waits for every addition
                for dl in range(4):
                    node, weight = table[i + di, j + dj, k + dk, l + dl], of_rho[dl]
                    w0 += weight * node[first]
                    w1 += weight * node[first + 1]
                    w2 += weight * node[first + 2]
                    w3 += weight * node[first + 3]
                v0 += outer * w0
                v1 += outer * w1
                v2 += outer * w2
                v3 += outer * w3
    return v0, v1, v2, v3


@kernel
def lookup(vx, vy, phi, G, c, log_aspect, c11, c22, c23, c33, limit, table):
    """Fx, Fy, Mz and the share of slip; `limit` is mu N, `table` from `load`."""
    if limit <= 0.0 or (vx == 0.0 and vy == 0.0 and phi == 0.0):
        return 0.0, 0.0, 0.0, 0.0 if limit > 0.0 else 1.0
    unit = G * c * c / limit
    X, Y, Z = c11 * unit * vx, c22 * unit * vy, c23 * unit * c * phi
    sign_x, sign_y = 1.0 if X >= 0.0 else -1.0, 1.0 if Y > 0.0 or (Y == 0.0 and Z >= 0.0) else -1.0
    X, Y, Z = sign_x * X, sign_y * Y, sign_y * Z
    spin = spin_weight(log_aspect, c11, c22, c23) * Z
    Fx, Fy, Mz, slip = interpolated(log_aspect, X, Y, spin, FORCES, table)
    r = math.sqrt(X * X + Y * Y + spin * spin)
    linear = R0 * R0 / ((r + R0) * (r + R0))  # R0 rho (1 - rho) over r
    Fx, Fy = Fx - linear * X, Fy - linear * (Y + Z)
    Mz += linear * (c23 / c22 * Y - c33 / c23 * Z)
    size = math.sqrt(Fx * Fx + Fy * Fy)
    factor = limit / size if size > 1.0 else limit
    return sign_x * factor * Fx, sign_y * factor * Fy, sign_y * limit * c * Mz, min(max(slip, 0.0), 1.0)


def nodes() -> tuple[Array, Array, Array, Array]:
    """ln(a/b), alpha, beta [rad] and rho of the table's nodes."""
    return (
        np.linspace(-LOG_ASPECT_MAX, LOG_ASPECT_MAX, N_ASPECT),
        np.linspace(0.0, 0.5 * math.pi, N_ALPHA),
        np.linspace(-0.5 * math.pi, 0.5 * math.pi, N_BETA),
        np.linspace(0.0, 1.0, N_RHO),
    )


def rows() -> list[tuple[int, int, int]]:
    """Numbers of a/b, alpha and beta of the file's rows; spin alone, beta = ±90°, has one alpha."""
    return [
        (i, j, k) for i in range(N_ASPECT) for k in range(N_BETA) for j in range(1 if k in (0, N_BETA - 1) else N_ALPHA)
    ]


@functools.cache
def load(forces: Path = FILE, effective: Path = EFFECTIVE_FILE) -> Array:
    """Return the array that kernels take, shape SHAPE; read once.

    Raises
    ------
    ContactError
        A file that is missing or no table of these nodes.
    """
    of_forces, changes = numbers(forces), numbers(effective)
    of_forces[..., :3] -= _linear()
    result = np.concatenate([with_margins(of_forces), with_margins(changes)], axis=-1)
    result.setflags(write=False)
    return result


def numbers(path: Path) -> Array:
    """The four numbers of a file on the nodes; nothing at rho = 0.

    Raises
    ------
    ContactError
        A file that is missing or no table of these nodes.
    """
    try:
        content = np.loadtxt(path, delimiter=",", comments="#")
    except (OSError, ValueError) as error:
        raise ContactError(f"{path} is not a table of creep forces: {error}") from None
    expected = (len(rows()), 4 * (N_RHO - 1))
    if content.shape != expected:
        raise ContactError(f"{path} has {content.shape} numbers; a table of creep forces has {expected}")
    values = np.zeros((N_ASPECT, N_ALPHA, N_BETA, N_RHO, 4))
    for (i, j, k), row in zip(rows(), content, strict=True):
        own = slice(None) if k in (0, N_BETA - 1) else j
        values[i, own, k, 1:] = row.reshape(-1, 4)
    return values


def _linear() -> Array:
    """R0 rho (1 - rho) times the linear theory's Fx, Fy over mu N and Mz over mu N c, on the nodes."""
    log_aspect, alpha, beta, rho = nodes()
    C = np.array([kalker.coefficients(kalker.table(NU), value) for value in log_aspect])
    _, c22, c23, c33 = C.T[:, :, None, None]
    weight = np.array([spin_weight(u, *own[:3]) for u, own in zip(log_aspect, C, strict=True)])[:, None, None]
    x, y = np.cos(alpha)[:, None] * np.cos(beta), np.sin(alpha)[:, None] * np.cos(beta)
    z = np.sin(beta) / weight
    x = x + 0.0 * z
    force = np.stack([-x, -(y + z), c23 / c22 * y - c33 / c23 * z], axis=-1)
    return force[..., None, :] * (R0 * rho * (1.0 - rho))[:, None]


def with_margins(values: Array) -> Array:
    """One more node on every side: by symmetry in alpha, beta and at rho = 0, by extrapolation elsewhere.

    Changes of the creepages have the symmetries of the forces, the exponent that of the slip.
    """
    mirror, turned = np.array([1.0, -1.0, -1.0, 1.0]), np.array([-1.0, 1.0, 1.0, 1.0])
    # (X, -Y, Z) is the mirror image of (X, Y, -Z); (-X, Y, Z) has the opposite Fx
    v = np.concatenate([values[:, 1:2, ::-1] * mirror, values, values[:, -2:-1] * turned], axis=1)
    opposite = mirror * turned  # beyond spin alone: the creepage turned by 180°
    v = np.concatenate([v[:, :, -2:-1] * opposite, v, v[:, :, 1:2] * opposite], axis=2)
    at_zero = np.array([1.0, 1.0, 1.0, -1.0])  # forces leave the linear theory with zero slope, slip grows from zero
    v = np.concatenate([v[:, :, :, 1:2] * at_zero, v, _beyond(v[:, :, :, ::-1], 3)], axis=3)
    return np.concatenate([_beyond(v, 0), v, _beyond(v[::-1], 0)], axis=0)


def _beyond(v: Array, axis: int) -> Array:
    """The node before the first along an axis, on the parabola through the first three."""
    first, second, third = (v.take([n], axis=axis) for n in range(3))
    return 3.0 * first - 3.0 * second + third
