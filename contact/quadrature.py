"""Where strips and elements lie inside a patch: cosine nodes, dense at the edges where pressure and traction are steep."""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import NDArray

from contact._jit import kernel


@kernel
def on_circle(k, n):
    """Cosine and sine of pi k/n, without libm: where strips lie is the same on every platform to the last digit.

    Taylor's series within an eighth of the circle, to which whole numbers reduce k/n exactly; within 2e-16.
    """
    k %= 2 * n
    lower, left = k > n, False
    if lower:
        k = 2 * n - k
    if 2 * k > n:
        k, left = n - k, True
    steep = 4 * k > n
    angle = math.pi * (n - 2 * k) / (2 * n) if steep else math.pi * k / n
    square = angle * angle
    cosine, sine = 1.0, 1.0
    for i in range(18, 0, -2):
        cosine = 1.0 - square / (i * (i - 1)) * cosine
        sine = 1.0 - square / (i * (i + 1)) * sine
    sine *= angle
    if steep:
        cosine, sine = sine, cosine
    return -cosine if left else cosine, -sine if lower else sine


@kernel
def fill_fejer(nodes, weights):
    """Fill both with `fejer` of their length."""
    n = nodes.size
    for i in range((n + 1) // 2):  # the other half mirrors it: symmetric to round-off
        total = 0.0
        for k in range(1, n // 2 + 1):
            total += on_circle((2 * i + 1) * k, n)[0] / (4.0 * k * k - 1.0)
        nodes[i] = -on_circle(2 * i + 1, 2 * n)[0]
        weights[i] = 2.0 / n * (1.0 - 2.0 * total)
        nodes[n - 1 - i], weights[n - 1 - i] = -nodes[i], weights[i]


@functools.lru_cache(maxsize=64)
def fejer(n: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes (ascending) and positive weights of Fejér's first rule on [-1, 1], exact for polynomials of degree n - 1.

    The nodes are the mid-angles of n cosine-spaced cells and the weights add up to 2, so strips with these widths fill the
    patch; the load of a Hertzian patch, a parabola across the strips, is integrated exactly.
    """
    nodes, weights = np.empty(n), np.empty(n)
    fill_fejer(nodes, weights)
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
    EL_END,  # s of the trailing side
) = range(10)
N_EL = 10


@kernel
def fill_panel(edges, logs):
    """Fill both with `panel` of the length of `logs`."""
    n = logs.shape[0]
    for k in range(n // 2 + 1):
        edges[k] = -on_circle(k, n)[0]
        edges[n - k] = -edges[k]
    for i in range(n):
        for k in range(n + 1):
            logs[i, k] = math.log(abs(edges[k] - 0.5 * (edges[i + 1] + edges[i])))


@kernel
def fill_elements(rows):
    """Fill the rows with `elements` of their length."""
    n = rows.shape[1]
    before, half_angle = 1.0, 0.0  # its tangent; atanh(cos) is minus its logarithm
    for k in range(n):
        end = (k + 1) * math.pi / n
        (s, sine), (end_s, end_sine) = on_circle(2 * k + 1, 2 * n), on_circle(k + 1, n)
        rows[EL_S, k], rows[EL_SINE, k], rows[EL_DX, k] = s, sine, sine * math.pi / n
        rows[EL_STEP, k], rows[EL_MIDDLE, k] = before - s, 0.5 * (before + s)
        rows[EL_ATANH, k] = math.log(sine / (1.0 + s) / half_angle) if k > 0 else math.inf
        rows[EL_ANGLE_END, k], rows[EL_LOAD_END, k] = end, 0.5 * (end - end_sine * end_s)
        rows[EL_MOMENT_END, k], rows[EL_END, k] = end_sine**3 / 3.0, end_s
        before, half_angle = s, sine / (1.0 + s)


@functools.lru_cache(maxsize=64)
def panel(n: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Edges, shape (n + 1,), of n cosine-spaced strips on [-1, 1] and ln|edge - middle|, shape (n, n + 1)."""
    edges, logs = np.empty(n + 1), np.empty((n, n + 1))
    fill_panel(edges, logs)
    for array in (edges, logs):
        array.setflags(write=False)
    return edges, logs


@functools.lru_cache(maxsize=64)
def elements(n: int) -> NDArray[np.float64]:
    """Rows of constants of n elements along a strip, cosine-spaced; shape (10, n), rows EL_… of this module.

    The semi-elliptic pressure summed over these elements is exact for n >= 2.
    """
    result = np.empty((N_EL, n))
    fill_elements(result)
    result.setflags(write=False)
    return result
