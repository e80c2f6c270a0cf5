"""The gap of a patch on surfaces as strips: a parabola along x for every row, and how well they fit."""

import math

from contact.core import kernel
from contact.kernels.geometry.curve import Array
from contact.kernels.geometry.section import AWAY
from contact.kernels.rows import Sep

#: A parabola is fitted where the gap of its row is below the approach, and at least up to this share of the approach above
#: its least value.
_LEAST_DEPTH = 0.15
_FLATTEST, _SHARPEST = 0.02, 500.0  # [1/m] range of A: a radius of 25 m, and one of 1 mm, for a usual wheel
#: A faint weight around the lowest point of a row, and its width over that of the grid, so that few points suffice.
_FAINT, _WIDE = 1e-3, 0.2
#: The best parabola over that by moments, in A: the first counts above the second value, the second below the first. Where
#: a row is hollow, the best parabola is nearly flat and much longer than the overlap.
_HOLLOW, _WHOLE = 0.4, 0.8
#: Share of a row's error in slope that counts as error of the parabolas: with it, pressures on the crossings and flats of
#: sets E and F that are more than 5 % off are told (docs/check/limits.md).
_OF_SLOPE = 0.8


@kernel
def _bend(
    moments: tuple[float, float, float, float, float], right: tuple[float, float, float], size: float
) -> tuple[float, float]:
    """Return c2 and t_c of the least-squares parabola c2 (t - t_c)² + c0, from the sums of w tⁿ and of w h tⁿ.

    c2 is kept in its range. Then t_c follows from the best parabola with this c2, so two ends of equal height have t_c in
    their middle.
    """
    m0, m1, m2, m3, m4 = moments
    r0, r1, r2 = right
    centre = m1 / m0
    a11, a12, a22 = m2 - m1 * centre, m3 - m2 * centre, m4 - m2 * m2 / m0
    b1, b2 = r1 - r0 * centre, r2 - r0 * m2 / m0
    determinant = a11 * a22 - a12 * a12
    c2 = (b2 * a11 - b1 * a12) / determinant if determinant > 1e-12 * a11 * a22 else 0.0
    c2 = min(max(c2, _FLATTEST / size), _SHARPEST / size)
    return c2, (c2 * a12 - b1) / (2.0 * c2 * a11) if a11 > 0.0 else centre


@kernel
def _by_moments(h: Array, x: Array, i: int, level: float, size: float) -> tuple[bool, float, float, float]:
    """Return whether a surface ends within the overlap of a row, and A, x_c and g of the parabola with its moments.

    The parabola has the volume, the middle and the spread of what overlaps at `level`: the depth D - A (x - x_c)² over the
    half length a has 4/3 D a, x_c, and the variance a²/5. For a whole parabola these are its own values. The last point
    before an end counts for half a step.
    """
    n, m0, m1, m2, cut = h.shape[1], 0.0, 0.0, 0.0, False
    for k in range(n):
        depth = level - h[i, k]
        if depth <= 0.0:
            continue
        ends = (k > 0 and h[i, k - 1] >= 0.5 * AWAY) or (k < n - 1 and h[i, k + 1] >= 0.5 * AWAY)
        cut = cut or ends
        w = 0.5 * depth if ends else depth
        m0, m1, m2 = m0 + w, m1 + w * x[i, k], m2 + w * x[i, k] ** 2
    if m0 <= 0.0:
        return False, _FLATTEST / size, 0.0, level
    step = (x[i, n - 1] - x[i, 0]) / (n - 1)
    x_c = m1 / m0
    a = math.sqrt(5.0 * max(m2 / m0 - x_c * x_c, step * step / 12.0))
    top = 0.75 * m0 * step / a
    return cut, min(max(top / (a * a), _FLATTEST / size), _SHARPEST / size), x_c, level - top


@kernel
def _row_error(h: Array, x: Array, i: int, approach: float, out: Array) -> float:
    """Return by how much the slope of row i differs from that of its parabola, over the slope at the parabola's end [-].

    It is the root mean square over the overlap, weighted with the depth. A corner of the surface, which bears a peak of
    pressure, hardly moves the gap of a patch, but turns its slope.
    """
    total, square, before, miss_before = 0.0, 0.0, 0.0, 0.0
    g, A, x_c = out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i]
    for k in range(h.shape[1]):
        depth, miss = approach - h[i, k], g + A * (x[i, k] - x_c) ** 2 - h[i, k]
        least = min(depth, before)
        if least > 0.0:
            total += least
            square += least * ((miss - miss_before) / (x[i, k] - x[i, k - 1])) ** 2
        before, miss_before = depth, miss
    half = math.sqrt(max(approach - g, 0.0) / A)
    return math.sqrt(square / total) * half / (2.0 * approach) if total > 0.0 else 0.0


@kernel
def fit_rows(h: Array, x: Array, approach: float, wide: float, size: float, out: Array) -> float:
    """Fill G, A and XC of `out`: each row h(x) becomes A·(x - x_c)² + g. Return the error of the parabolas.

    The fit is by least squares over the part of the row that overlaps at the `approach`, weighted with the depth. So A, x_c
    and g are those of both surfaces at the pose: a flat makes A small, a ramp moves x_c. `h` is the gap from its least value,
    with AWAY where a body is absent, `wide` the length of its grid [m], and `size` that of the wheel (`search.size_of`). The
    error is the root mean square of h minus the parabolas over the overlap, weighted with the depth, over the approach, or that
    in slope of one row (`_row_error`), if it is larger. Where a strip touches at two places, as on both ends of a flat, it is
    large, and strips cannot describe the patch. There, and where a surface ends within the overlap, the parabola has the
    moments of the overlap (`_by_moments`).
    """
    n_x, total, square, steepest = h.shape[1], 0.0, 0.0, 0.0
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
            t = x[i, k] - middle
            w = max(least + window - h[i, k], 0.0) + _FAINT * window * math.exp(-((t / (_WIDE * wide)) ** 2))
            t2 = t * t
            m0, m1, m2, m3, m4 = m0 + w, m1 + w * t, m2 + w * t2, m3 + w * t2 * t, m4 + w * t2 * t2
            r0, r1, r2 = r0 + w * h[i, k], r1 + w * h[i, k] * t, r2 + w * h[i, k] * t2
        cut, A, x_c, g = _by_moments(h, x, i, least + window, size)
        if not cut:
            bend, t_c = _bend((m0, m1, m2, m3, m4), (r0, r1, r2), size)
            share = min(max((bend / A - _HOLLOW) / (_WHOLE - _HOLLOW), 0.0), 1.0)
            share *= share * (3.0 - 2.0 * share)
            level = (r0 - bend * (m2 - 2.0 * t_c * m1 + t_c * t_c * m0)) / m0
            A, x_c, g = A + share * (bend - A), x_c + share * (middle + t_c - x_c), g + share * (level - g)
        out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i] = g, A, min(max(x_c, x[i, 0]), x[i, n_x - 1])
        for k in range(n_x):
            depth = approach - h[i, k]
            if depth > 0.0:
                miss = g + A * (x[i, k] - x_c) ** 2 - h[i, k]
                total += depth
                square += depth * miss * miss
        steepest = max(steepest, _row_error(h, x, i, approach, out) * math.sqrt(max(approach - least, 0.0) / approach))
    _open_beyond(out, 1, h.shape[0], 1)
    _open_beyond(out, h.shape[0] - 2, -1, -1)
    return max(math.sqrt(square / total) / approach, _OF_SLOPE * steepest) if total > 0.0 else 0.0


@kernel
def _open_beyond(out: Array, first: int, end: int, step: int) -> None:
    """Let the gap open at 45° from the last row with both bodies over those without."""
    i = first
    while i != end:
        near = out[Sep.G, i - step] + abs(out[Sep.Y, i] - out[Sep.Y, i - step])
        if out[Sep.G, i] >= 0.5 * AWAY and out[Sep.G, i - step] < 0.5 * AWAY:
            out[Sep.G, i], out[Sep.A, i], out[Sep.XC, i] = near, out[Sep.A, i - step], out[Sep.XC, i - step]
        i += step
