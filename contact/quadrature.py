"""Where strips and elements lie inside a patch: cosine nodes, dense at the edges where pressure and traction are steep."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray


@functools.lru_cache(maxsize=64)
def fejer(n: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes (ascending) and positive weights of Fejér's first rule on [-1, 1], exact for polynomials of degree n - 1.

    The nodes are the mid-angles of n cosine-spaced cells and the weights add up to 2, so strips with these widths fill the
    patch; the load of a Hertzian patch, a parabola across the strips, is integrated exactly.
    """
    angle = (np.arange(n) + 0.5) * np.pi / n
    k = np.arange(1, n // 2 + 1)
    weights = 2.0 / n * (1.0 - 2.0 * (np.cos(2.0 * np.outer(angle, k)) / (4.0 * k**2 - 1.0)).sum(axis=1))
    nodes = -np.cos(angle)
    nodes = 0.5 * (nodes - nodes[::-1])  # symmetric to round-off
    weights = 0.5 * (weights + weights[::-1])
    for array in (nodes, weights):
        array.setflags(write=False)
    return nodes, weights


@functools.lru_cache(maxsize=64)
def element_angles(n: int) -> NDArray[np.float64]:
    """Mid-angles theta of n elements along a strip, from the leading edge: x = x_c + a cos(theta), width a sin(theta) pi/n.

    The semi-elliptic pressure summed over these elements is exact for n >= 2.
    """
    angle = (np.arange(n) + 0.5) * np.pi / n
    angle.setflags(write=False)
    return angle
