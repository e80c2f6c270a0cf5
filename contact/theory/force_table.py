"""Read the half space's tables of creep forces and effective creepages, and make the array that kernels use."""

from __future__ import annotations

import functools
import math
from pathlib import Path

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.kernels.tangential.table import (
    LOG_ASPECT_MAX,
    LOG_ASPECT_MIN,
    N_ALPHA,
    N_ASPECT,
    N_BETA,
    N_RHO,
    NU,
    R0,
    spin_weight,
)
from contact.theory import kalker

#: The tables in the package: creep forces (made by `contact table build`) and effective creepages (`table effective`).
FILE = Path(__file__).parents[1] / "data" / "creep_table.csv"
EFFECTIVE_FILE = Path(__file__).parents[1] / "data" / "effective_creepage.csv"


def nodes() -> tuple[Array, Array, Array, Array]:
    """Return ln(a/b), alpha [rad], beta [rad] and rho of the table's nodes."""
    return (
        np.linspace(LOG_ASPECT_MIN, LOG_ASPECT_MAX, N_ASPECT),
        np.linspace(0.0, 0.5 * math.pi, N_ALPHA),
        np.linspace(-0.5 * math.pi, 0.5 * math.pi, N_BETA),
        np.linspace(0.0, 1.0, N_RHO),
    )


def rows() -> list[tuple[int, int, int]]:
    """Return the indices of a/b, alpha and beta of each row of the file. Pure spin, beta = ±90°, has only one alpha."""
    return [
        (i, j, k) for i in range(N_ASPECT) for k in range(N_BETA) for j in range(1 if k in (0, N_BETA - 1) else N_ALPHA)
    ]


@functools.cache
def load(forces: Path = FILE, effective: Path = EFFECTIVE_FILE) -> Array:
    """Return the table as the array that kernels use, shape `contact.kernels.tangential.table.SHAPE`. Cached.

    Raises
    ------
    ContactError
        If a file is missing or is not a table on these nodes.
    """
    of_forces, changes = numbers(forces), numbers(effective)
    # without Y, (X, -Z) is the mirror image of (X, Z); the fit finds another of several solutions that are as good
    changes[:, 0] = 0.5 * (changes[:, 0] + changes[:, 0, ::-1] * np.array([1.0, -1.0, -1.0, 1.0]))
    changes[:, :, [0, -1]] = changes[:, :1, [0, -1]]
    of_forces[..., :3] -= _linear()
    result = np.concatenate([with_margins(of_forces), with_margins(changes)], axis=-1)
    result.setflags(write=False)
    return result


def numbers(path: Path) -> Array:
    """Return the four numbers of each node from a file, shape (N_ASPECT, N_ALPHA, N_BETA, N_RHO, 4); 0 at rho = 0.

    Raises
    ------
    ContactError
        If the file is missing or is not a table on these nodes.
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
        alphas = slice(None) if k in (0, N_BETA - 1) else j
        values[i, alphas, k, 1:] = row.reshape(-1, 4)
    return values


def _linear() -> Array:
    """Return R0 rho (1 - rho) times linear theory's Fx/(mu N), Fy/(mu N), Mz/(mu N c) at the nodes."""
    log_aspect, alpha, beta, rho = nodes()
    C = np.array([kalker.coefficients(kalker.table(NU), value) for value in log_aspect])
    _, c22, c23, c33 = C.T[:, :, None, None]
    weight = np.array([spin_weight(u, *row[:3]) for u, row in zip(log_aspect, C, strict=True)])[:, None, None]
    x, y = np.cos(alpha)[:, None] * np.cos(beta), np.sin(alpha)[:, None] * np.cos(beta)
    z = np.sin(beta) / weight
    x = x + 0.0 * z
    force = np.stack([-x, -(y + z), c23 / c22 * y - c33 / c23 * z], axis=-1)
    return force[..., None, :] * (R0 * rho * (1.0 - rho))[:, None]


def with_margins(values: Array) -> Array:
    """Return `values` with one more node at each end of each axis.

    The new nodes follow from symmetry in alpha, in beta and at rho = 0, and from extrapolation elsewhere. Changes of the
    creepages have the symmetries of the forces; the exponent has that of the slip.
    """
    mirror, turned = np.array([1.0, -1.0, -1.0, 1.0]), np.array([-1.0, 1.0, 1.0, 1.0])
    # (X, -Y, Z) is the mirror image of (X, Y, -Z). (-X, Y, Z) has the opposite Fx.
    v = np.concatenate([values[:, 1:2, ::-1] * mirror, values, values[:, -2:-1] * turned], axis=1)
    opposite = mirror * turned  # beyond pure spin the creepage is turned by 180°
    v = np.concatenate([v[:, :, -2:-1] * opposite, v, v[:, :, 1:2] * opposite], axis=2)
    at_zero = np.array([1.0, 1.0, 1.0, -1.0])  # forces minus linear theory are even in rho at 0, slip is odd
    v = np.concatenate([v[:, :, :, 1:2] * at_zero, v, _beyond(v[:, :, :, ::-1], 3)], axis=3)
    return np.concatenate([_beyond(v, 0), v, _beyond(v[::-1], 0)], axis=0)


def _beyond(v: Array, axis: int) -> Array:
    """Return the node before the first along `axis`, on the parabola through the first three nodes."""
    first, second, third = (v.take([n], axis=axis) for n in range(3))
    return 3.0 * first - 3.0 * second + third
