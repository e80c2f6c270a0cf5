"""The gap of a patch on surfaces as strips: a parabola along x for every row, and how well they fit."""

import math

from contact._jit import kernel
from contact.kernels.geometry.curve import Array
from contact.kernels.geometry.section import AWAY
from contact.kernels.rows import Sep

#: A parabola is fitted where the gap of its row is below the approach, and at least up to this share of the approach above
#: its least value.
_LEAST_DEPTH = 0.15
_FLATTEST, _SHARPEST = 0.02, 500.0  # [1/m] range of A: a radius of 25 m, and one of 1 mm
#: A faint weight around the lowest point of a row, and its width over that of the grid, so that few points suffice.
_FAINT, _WIDE = 1e-3, 0.2


@kernel
def _solve(moments: tuple[float, float, float, float, float], right: tuple[float, float, float]) -> tuple[float, float]:
    """Return the coefficients of t and t² of a least-squares parabola, from the sums of w tⁿ and of w h tⁿ."""
    m0, m1, m2, m3, m4 = moments
    r0, r1, r2 = right
    centre = m1 / m0
    a11, a12, a22 = m2 - m1 * centre, m3 - m2 * centre, m4 - m2 * m2 / m0
    b1, b2 = r1 - r0 * centre, r2 - r0 * m2 / m0
    determinant = a11 * a22 - a12 * a12
    if not determinant > 1e-12 * a11 * a22:
        return 0.0, 0.0
    return (b1 * a22 - b2 * a12) / determinant, (b2 * a11 - b1 * a12) / determinant


@kernel
def fit_rows(h: Array, x: Array, approach: float, wide: float, out: Array) -> float:
    """Fill G, A and XC of `out`: each row h(x) becomes A·(x - x_c)² + g. Return the error of the parabolas.

    The fit is by least squares over the part of the row that overlaps at the `approach`, weighted with the depth. So A, x_c
    and g are those of both surfaces at the pose: a flat makes A small, a ramp moves x_c. `h` is the gap from its least value,
    with AWAY where a body is absent, and `wide` the length of its grid [m]. The error is the root mean square of h minus the
    parabolas over the overlap, weighted with the depth, over the approach. Where a strip touches at two places, as on both
    ends of a flat, it is large, and strips cannot describe the patch.
    """
    n_x, total, square = h.shape[1], 0.0, 0.0
    for i in range(h.shape[0]):
        here = 0
        for k in range(n_x):
            if h[i, k] < h[i, here]:
                here = k
        least, middle = h[i, here], x[i, here]
        if least >= 0.5 * AWAY:  # no body in this row
            out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i] = AWAY, 1.0, 0.0
            continue
        window = max(approach - least, _LEAST_DEPTH * approach)
        m0, m1, m2, m3, m4, r0, r1, r2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(n_x):
            if h[i, k] >= 0.5 * AWAY:
                continue
            t = (x[i, k] - middle) / wide
            w = max(least + window - h[i, k], 0.0) + _FAINT * window * math.exp(-((t / _WIDE) ** 2))
            t2 = t * t
            m0, m1, m2, m3, m4 = m0 + w, m1 + w * t, m2 + w * t2, m3 + w * t2 * t, m4 + w * t2 * t2
            r0, r1, r2 = r0 + w * h[i, k], r1 + w * h[i, k] * t, r2 + w * h[i, k] * t2
        c1, c2 = _solve((m0, m1, m2, m3, m4), (r0, r1, r2))
        A = min(max(c2 / (wide * wide), _FLATTEST), _SHARPEST)
        t_c = min(max(-0.5 * c1 / (wide * wide * A), (x[i, 0] - middle) / wide), (x[i, n_x - 1] - middle) / wide)
        bend = A * wide * wide
        g = (r0 - bend * (m2 - 2.0 * t_c * m1 + t_c * t_c * m0)) / m0
        out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i] = g, A, middle + t_c * wide
        for k in range(n_x):
            depth = approach - h[i, k]
            if depth > 0.0:
                miss = g + bend * ((x[i, k] - middle) / wide - t_c) ** 2 - h[i, k]
                total += depth
                square += depth * miss * miss
    _open_beyond(out, 1, h.shape[0], 1)
    _open_beyond(out, h.shape[0] - 2, -1, -1)
    return math.sqrt(square / total) / approach if total > 0.0 else 0.0


@kernel
def _open_beyond(out: Array, first: int, end: int, step: int) -> None:
    """Let the gap open at 45° from the last row with both bodies over those without."""
    i = first
    while i != end:
        near = out[Sep.G, i - step] + abs(out[Sep.Y, i] - out[Sep.Y, i - step])
        if out[Sep.G, i] >= 0.5 * AWAY and out[Sep.G, i - step] < 0.5 * AWAY:
            out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i] = near, out[Sep.A, i - step], out[Sep.XC, i - step]
        i += step
