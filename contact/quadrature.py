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


# elements[ROW, k]: what kernels need of element k of a strip, from the leading edge, with x = x_c + a·s, s = cos(angle)
(
    EL_S,
    EL_SINE,  # √(1 - s²), the semi-elliptic pressure over its peak
    EL_DX,  # width over a
    EL_STEP,  # s of the element before (or of the edge) minus s
    EL_MIDDLE,  # s half-way to the element before
    EL_ATANH,  # ∫ds/(1 - s²) from the element before; infinite from the edge
    EL_ANGLE_END,  # angle of the trailing side of the element
    EL_LOAD_END,  # ∫√(1 - s²) ds from the leading edge to the trailing side
    EL_MOMENT_END,  # ∫s√(1 - s²) ds likewise
) = range(9)


@functools.lru_cache(maxsize=64)
def panel(n: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Edges, shape (n + 1,), of n cosine-spaced strips on [-1, 1] and ln|edge - middle|, shape (n, n + 1)."""
    edges = -np.cos(np.arange(n + 1) * np.pi / n)
    edges = 0.5 * (edges - edges[::-1])
    logs = np.log(np.abs(edges - 0.5 * (edges[1:] + edges[:-1])[:, None]))
    for array in (edges, logs):
        array.setflags(write=False)
    return edges, logs


@functools.lru_cache(maxsize=64)
def elements(n: int) -> NDArray[np.float64]:
    """Rows of constants of n elements along a strip, cosine-spaced; shape (9, n), rows EL_… of this module.

    The semi-elliptic pressure summed over these elements is exact for n >= 2.
    """
    angle = (np.arange(n) + 0.5) * np.pi / n
    end = np.arange(1, n + 1) * np.pi / n
    s, sine = np.cos(angle), np.sin(angle)
    before = np.r_[1.0, s[:-1]]
    with np.errstate(divide="ignore"):
        stretch = np.arctanh(before) - np.arctanh(s)
    rows = (
        s,
        sine,
        sine * np.pi / n,
        before - s,
        0.5 * (before + s),
        stretch,
        end,
        0.5 * (end - np.sin(end) * np.cos(end)),
        np.sin(end) ** 3 / 3.0,
    )
    result = np.ascontiguousarray(rows)
    result.setflags(write=False)
    return result
