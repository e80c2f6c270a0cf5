"""Heights between the nodes of a mesh, as CONTACT interpolates them: bilinearly, and bicubically for a wheel with slices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array

#: Steps of Newton's iterations, a distance below which they are at rest, and one above which they have missed [m].
STEPS, REST, MISSED = 20, 1e-13, 1e-9


def bilinear(nodes: Array, x: Array, y: Array, i: Array, j: Array) -> Array:
    """Return the heights at x, y between the nodes of a mesh, NaN where they are not found.

    `nodes` has the shape (n, m, 3); `i` and `j` are about the places there, counted in nodes.
    """
    i, j, z, there = _found(nodes, x, y, i, j)
    return np.asarray(np.where(there, z, np.nan))


def bicubic(nodes: Array, x: Array, y: Array, i: Array, j: Array) -> Array:
    """Return the same by the cubic over two and two nodes whose slopes are those between their neighbours.

    The places between the nodes are those of the bilinear interpolation.
    """
    i, j, _, there = _found(nodes, x, y, i, j)
    z = nodes[..., 2]
    a, b = _cells(z.shape, i, j)
    by_rows, by_columns = _weights(i - a), _weights(j - b)
    padded = _extended(_extended(z).T).T
    out = np.zeros_like(x)
    for k in range(4):
        row = sum(by_columns[n] * padded[a + k, b + n] for n in range(4))
        out += by_rows[k] * row
    return np.asarray(np.where(there, out, np.nan))


def solved(first: Array, second: Array, right: Array) -> tuple[Array, Array]:
    """Return a and b with a·first + b·second = right."""
    across = first[0] * second[1] - first[1] * second[0]
    return (
        (right[0] * second[1] - right[1] * second[0]) / across,
        (first[0] * right[1] - first[1] * right[0]) / across,
    )


def _weights(t: Array) -> tuple[Array, Array, Array, Array]:
    """Return the weights of four nodes of which the middle two are at 0 and 1."""
    return (
        0.5 * t * (-1.0 + t * (2.0 - t)),
        1.0 + 0.5 * t * t * (3.0 * t - 5.0),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
        0.5 * t * t * (t - 1.0),
    )


def _extended(z: Array) -> Array:
    """Return heights with a row before and after, so that slopes at the ends are those of the last step."""
    return np.concatenate((2.0 * z[:1] - z[1:2], z, 2.0 * z[-1:] - z[-2:-1]))


def _cells(shape: tuple[int, ...], i: Array, j: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    a, b = (np.clip(np.floor(k).astype(np.int64), 0, most - 2) for k, most in zip((i, j), shape[:2], strict=True))
    return a, b


def _found(nodes: Array, x: Array, y: Array, i: Array, j: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return the places in nodes at x, y, the bilinear heights there, and whether they were found."""
    for _ in range(STEPS):
        a, b = _cells(nodes.shape, i, j)
        t, r = (i - a)[..., None], (j - b)[..., None]
        low, high = (1.0 - r) * nodes[a, b] + r * nodes[a, b + 1], (1.0 - r) * nodes[a + 1, b] + r * nodes[a + 1, b + 1]
        here, by_i = (1.0 - t) * low + t * high, high - low
        by_j = (1.0 - t) * (nodes[a, b + 1] - nodes[a, b]) + t * (nodes[a + 1, b + 1] - nodes[a + 1, b])
        miss = np.stack((x, y)) - np.moveaxis(here[..., :2], -1, 0)
        if float(np.abs(miss).max()) < REST:
            break
        di, dj = solved(np.moveaxis(by_i[..., :2], -1, 0), np.moveaxis(by_j[..., :2], -1, 0), miss)
        i, j = i + np.clip(di, -1.0, 1.0), j + np.clip(dj, -1.0, 1.0)
    return i, j, here[..., 2], np.asarray(np.abs(miss).max(axis=0) < MISSED)
