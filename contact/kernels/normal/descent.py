"""Inverse Jacobians of Hertz contacts: response of half lengths and ends of the strip half space to the residuals.

If the residual of the half lengths is itself the step, it removes a fifth to a third of an error. On strips at fixed
cosines the Jacobian of a Hertz contact depends only on a/b. The Jacobian of another patch is near that of the ellipse
with its a/b. The inverse removes three quarters of an error or more at every step (strip_halfspace.md 2, step 6).
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Cube, Matrix, Numbers
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.influence import at_centre, in_row, logarithm, row_at
from contact.kernels.quadrature import on_circle
from contact.kernels.rows import Vector

#: Ratios of the table: ln(a/b) of the first one, step between them, their number.
_LOW, _STEP, N_RATIOS = -3.0, 0.7, 10
#: Layers of the table: half lengths and ends for every ratio, then the offsets of skewed strips.
N_LAYERS = 2 * N_RATIOS
#: Range of strips per panel that use the Jacobian. Otherwise the residuals are the steps.
FEWEST, MOST = 8, 64
#: Steps of the difference quotients: of ln a, and of an end over the width of the end strip.
_DIFFERENCE, _END_DIFFERENCE = 0.01, 0.05
#: From this move on, over the width, an end moves by the rule of the ends and not by the Jacobian.
_HOLD = 0.03
#: From this share of the rule for a peak at the end on, an end does so too.
_LOCAL = 0.5
#: Half length of an end strip over that of its neighbour.
END_LENGTH = 0.447
#: Weight of a strip's distance from the line through its neighbours' middles in the residual of its offset. Middles of an
#: ellipse's chords lie in line. Where strips are long and narrow, the conditions at their ends hardly tell zigzags.
STRAIGHTEN = 0.1
#: Number of strips of a panel from which on this weight grows, and the factor for middles that do not come to rest.
COARSE, STIFFER = 20, 30.0
#: Share of the move that the rule of the ends asks for; (p1/p2)² at the exact half width and its slope
#: (strip_halfspace.md 2, step 4).
END_STEP, END_VALUE, END_SLOPE = 0.6, 0.365, 0.108


@kernel
def straightening(n, stiff):
    """Return the weight of straightening for `n` strips in a panel.

    A strip's distance from the line through its neighbours' middles falls with 1/n². So the middles of 20 and of 160 strips are
    straightened alike. `stiff` middles are straightened more.
    """
    return STRAIGHTEN * max(1.0, (n / COARSE) ** 2) * (STIFFER if stiff != 0 else 1.0)


@kernel
def lay(n, low, high, y, h):
    """Fill middles and half widths of cosine-spaced strips from `low` to `high`."""
    centre, half = 0.5 * (low + high), 0.5 * (high - low)
    for i in range(n):
        left, right = centre - half * on_circle(i, n)[0], centre - half * on_circle(i + 1, n)[0]
        y[i], h[i] = 0.5 * (left + right), 0.5 * (right - left)


@kernel
def influence(i, j, X, y, h, a, centre, plane):
    """Return the displacement at strip i, x = X·a_j, by a unit pressure on strip j, with pi E* = 1."""
    near = max(abs(y[j] - h[j] - y[i]), 1e-12)
    far = max(abs(y[j] + h[j] - y[i]), 1e-12)
    near, far = math.log(near / a[j]), math.log(far / a[j])
    sign = 1.0 if i == j else -1.0
    if X == 0.0:
        return a[j] * abs(at_centre(centre, far) + sign * at_centre(centre, near))
    row, share, ln_X = row_at(X, logarithm(X))
    return a[j] * abs(in_row(plane, row, share, far - ln_X) + sign * in_row(plane, row, share, near - ln_X))


@kernel
def _residual(low, high, scratch, B, A, centre, plane, out):
    """Fill `out` with the residuals of a Hertz contact at its approach, but with other half lengths and ends."""
    n = scratch.shape[1]
    lu = scratch[0]
    ln_a, a, p, q = scratch[1, 0], scratch[1, 1], scratch[1, 2], scratch[1, 3]
    y, h, y0, g0 = scratch[2, 0], scratch[2, 1], scratch[2, 2], scratch[2, 3]
    lay(n, low, high, y, h)
    for i in range(1, n - 1):
        a[i] = math.exp(ln_a[i])
    a[0], a[n - 1] = END_LENGTH * a[1], END_LENGTH * a[n - 2]
    for i in range(n):
        p[i] = q[i] = -(g0[i] + B * (y[i] * y[i] + h[i] * h[i] / 3.0 - y0[i]))
        for j in range(n):
            lu[j, i] = influence(i, j, 0.0, y, h, a, centre, plane)
    eliminate(lu, n, p, q)
    for i in range(1, n - 1):
        u = 0.0
        for j in range(n):
            u += p[j] * influence(i, j, a[i] / a[j], y, h, a, centre, plane)
        overlap = -(g0[i] + B * (y[i] * y[i] + h[i] * h[i] / 3.0 - y0[i])) - u
        out[i] = 0.5 * math.log(max(overlap / (A * a[i] * a[i]), 1e-3))
    e = 0.5 * (1.0 - on_circle(1, n)[0])  # width of the end strip over that of the panel
    out[0] = END_STEP * e * ((p[1] / p[2]) ** 2 - END_VALUE) / END_SLOPE
    out[n - 1] = END_STEP * e * ((p[n - 2] / p[n - 3]) ** 2 - END_VALUE) / END_SLOPE


@kernel
def _hertz(aspect, scratch, centre, plane):
    """Fill half lengths and gap of the Hertz contact with half width 1, a/b = `aspect` and peak pressure 1.

    Return its half curvatures B, A.
    """
    n = scratch.shape[1]
    ln_a, a, p = scratch[1, 0], scratch[1, 1], scratch[1, 2]
    y, h, y0, g0 = scratch[2, 0], scratch[2, 1], scratch[2, 2], scratch[2, 3]
    lay(n, -1.0, 1.0, y, h)
    for i in range(n):
        root = math.sqrt(1.0 - y[i] * y[i])
        ln_a[i], p[i], a[i], y0[i] = math.log(aspect * root), root, aspect * root, y[i] * y[i] + h[i] * h[i] / 3.0
    a[0], a[n - 1] = END_LENGTH * a[1], END_LENGTH * a[n - 2]
    A, weight = 0.0, 0.0
    for i in range(n):
        g0[i] = 0.0
        edge = 0.0
        for j in range(n):
            g0[i] -= p[j] * influence(i, j, 0.0, y, h, a, centre, plane)
            edge -= p[j] * influence(i, j, a[i] / a[j], y, h, a, centre, plane)
        if 4 * i >= n and 4 * i < 3 * n:
            A += (edge - g0[i]) / (a[i] * a[i])
            weight += 1.0
    return (g0[n // 4] - g0[n // 2]) / (y0[n // 4] - y0[n // 2]), A / weight


@kernel
def _fill_layer(aspect, scratch, centre, plane, layer):
    """Fill `layer` with minus the inverse Jacobian of the Hertz contact with a/b = `aspect`."""
    n = scratch.shape[1]
    B, A = _hertz(aspect, scratch, centre, plane)
    ln_a, jacobian, r, before = scratch[1, 0], scratch[3], scratch[4, 0], scratch[4, 1]
    for k in range((n + 1) // 2):
        step = _END_DIFFERENCE * 0.5 * (1.0 - on_circle(1, n)[0]) if k == 0 else _DIFFERENCE
        for side in range(-1, 2, 2):
            move = side * step
            if k == 0:
                _residual(-1.0 - 2.0 * move, 1.0, scratch, B, A, centre, plane, r)
            else:
                kept = ln_a[k]
                ln_a[k] = kept + move
                _residual(-1.0, 1.0, scratch, B, A, centre, plane, r)
                ln_a[k] = kept
            if side < 0:
                for i in range(n):
                    before[i] = r[i]
        for i in range(n):
            jacobian[i, k] = -(r[i] - before[i]) / (2.0 * step)
            jacobian[n - 1 - i, n - 1 - k] = jacobian[i, k]
    lu, one, other = scratch[0], scratch[4, 0], scratch[4, 1]
    for k in range(0, n, 2):
        for i in range(n):
            one[i], other[i] = 0.0, 0.0
            for j in range(n):
                lu[j, i] = jacobian[i, j]
        one[k], other[min(k + 1, n - 1)] = 1.0, 1.0
        eliminate(lu, n, one, other)
        for i in range(n):
            layer[i, k] = one[i]
            layer[i, min(k + 1, n - 1)] = other[i]
    for i in range(n):  # makes both halves mirror images to the last bit
        for k in range((n + 1) // 2):
            mean = 0.5 * (layer[i, k] + layer[n - 1 - i, n - 1 - k])
            layer[i, k] = layer[n - 1 - i, n - 1 - k] = mean


@kernel
def _fill_offset_layer(aspect, scratch, centre, plane, layer):
    """Fill `layer` with minus the inverse Jacobian of the offsets' residuals, of the Hertz contact with a/b = `aspect`.

    Offsets of a straight ellipse change neither pressures nor half lengths at first order, because both ends of a strip are
    alike. So the Jacobian is that of the difference of the displacements at both ends. A strip that moves away from its
    neighbours feels their pressure, and they feel its own; moved together, strips feel nothing. End strips follow
    their neighbours as in `place_middles`.
    """
    n = scratch.shape[1]
    straighten = straightening(n, 0)
    _, A = _hertz(aspect, scratch, centre, plane)
    a, p, y, h = scratch[1, 1], scratch[1, 2], scratch[2, 0], scratch[2, 1]
    jacobian, lu, one, other = scratch[3], scratch[0], scratch[4, 0], scratch[4, 1]
    last = n - 1
    near = (y[0] - y[1]) / (y[1] - y[2])  # offset of an end strip: (1 + near)·d1 - near·d2
    for i in range(n):
        for k in range(n):
            jacobian[i, k] = 0.0
    for i in range(1, last):
        for k in range(n):
            if k != i:
                X, step = a[i] / a[k], _DIFFERENCE * a[i] / a[k]
                change = influence(i, k, X - step, y, h, a, centre, plane)
                change -= influence(i, k, X + step, y, h, a, centre, plane)
                # of (u+ - u-)/(4 A a) by an offset of strip k, and by one of strip i
                slope = p[k] * change / (_DIFFERENCE * a[i]) / (4.0 * A * a[i])
                jacobian[i, k] -= slope
                jacobian[i, i] += slope
        jacobian[i, i] -= 1.0 + straighten
        share = (y[i + 1] - y[i]) / (y[i + 1] - y[i - 1])
        jacobian[i, i - 1] += straighten * share
        jacobian[i, i + 1] += straighten * (1.0 - share)
        jacobian[i, 1] += (1.0 + near) * jacobian[i, 0]
        jacobian[i, 2] -= near * jacobian[i, 0]
        jacobian[i, last - 1] += (1.0 + near) * jacobian[i, last]
        jacobian[i, last - 2] -= near * jacobian[i, last]
    for k in range(0, n - 2, 2):
        for i in range(n - 2):
            one[i], other[i] = 0.0, 0.0
            for j in range(n - 2):
                lu[j, i] = -jacobian[i + 1, j + 1]
        one[k], other[min(k + 1, n - 3)] = 1.0, 1.0
        eliminate(lu, n - 2, one, other)
        for i in range(n - 2):
            layer[i + 1, k + 1] = one[i]
            layer[i + 1, min(k + 1, n - 3) + 1] = other[i]
    for i in range(n):
        layer[0, i] = layer[i, 0] = layer[last, i] = layer[i, last] = 0.0
    for i in range(n):  # makes both halves mirror images to the last bit
        for k in range((n + 1) // 2):
            mean = 0.5 * (layer[i, k] + layer[last - i, last - k])
            layer[i, k] = layer[last - i, last - k] = mean


@kernel
def descend_offsets(first, n, width, descent, vectors):
    """Replace the residuals of the offsets of the panel from strip `first` on by steps, as `descend` does for half lengths."""
    r, out = vectors[Vector.Q1, first : first + n], vectors[Vector.OFFSET_R, first : first + n]
    longest = 0.0
    for i in range(n):
        longest = max(longest, vectors[Vector.A, first + i])
        r[i] = out[i]
    u = (math.log(longest / (0.5 * width)) - _LOW) * (1.0 / _STEP)
    u = u if u > 0.0 else 0.0  # written so that NaN does not become an index
    u = min(u, N_RATIOS - 1.000001)
    m = int(u)
    t = u - m
    low, high = descent[N_RATIOS + m], descent[N_RATIOS + m + 1]
    for i in range(n):
        one, other = 0.0, 0.0
        for j in range(n):
            one += low[i, j] * r[j]
            other += high[i, j] * r[j]
        out[i] = (1.0 - t) * one + t * other


@entry
def fill_descent(centre: Matrix, plane: Matrix, scratch: Cube, descent: Cube) -> None:
    """Fill the inverse Jacobians. `scratch` has at least five layers of the same shape, which are overwritten."""
    if descent.shape[1] < FEWEST:
        return
    for m in range(N_RATIOS):
        _fill_layer(math.exp(_LOW + m * _STEP), scratch, centre, plane, descent[m])
        _fill_offset_layer(math.exp(_LOW + m * _STEP), scratch, centre, plane, descent[N_RATIOS + m])


@entry
def has_one_run(n: int, pressures: Numbers) -> bool:
    """Return whether no strip without pressure lies between loaded ones."""
    runs = 0
    for i in range(n):
        if pressures[i] > 0.0 and (i == 0 or pressures[i - 1] <= 0.0):
            runs += 1
    return runs == 1


@kernel
def _prescribe(low, high, t, moves, held, out):
    """Change the steps `out` so that the ends which are `held` make their `moves`, over the width.

    The half lengths change with them.
    """
    n = low.shape[0]
    last = n - 1
    aa, ab = (1.0 - t) * low[0, 0] + t * high[0, 0], (1.0 - t) * low[0, last] + t * high[0, last]
    ba, bb = (1.0 - t) * low[last, 0] + t * high[last, 0], (1.0 - t) * low[last, last] + t * high[last, last]
    miss_low, miss_high = moves[0] - out[0], moves[1] - out[last]
    one, other = 0.0, 0.0
    if held[0] and held[1]:
        determinant = aa * bb - ab * ba
        one, other = (bb * miss_low - ab * miss_high) / determinant, (aa * miss_high - ba * miss_low) / determinant
    elif held[0]:
        one = miss_low / aa
    else:
        other = miss_high / bb
    for i in range(n):
        out[i] += one * ((1.0 - t) * low[i, 0] + t * high[i, 0]) + other * (
            (1.0 - t) * low[i, last] + t * high[i, last]
        )


@entry
def descend(first: int, n: int, width: float, descent: Cube, vectors: Matrix, frozen: bool) -> None:
    """Replace the residuals Vector.R of the panel from strip `first` on by steps of half lengths and ends.

    The steps are the residuals times the inverse Jacobian of the Hertz contact with the panel's a/b. The entries of the
    end strips are the moves of the ends. Ends with large moves or a pressure peak beside them, and all if they are `frozen`,
    follow their own rule.
    """
    r, out = vectors[Vector.Q1, first : first + n], vectors[Vector.R, first : first + n]
    last = n - 1
    longest = 0.0
    for i in range(n):
        longest = max(longest, vectors[Vector.A, first + i])
        r[i] = out[i]
    u = (math.log(longest / (0.5 * width)) - _LOW) * (1.0 / _STEP)
    u = u if u > 0.0 else 0.0  # written so that NaN does not become an index
    u = min(u, N_RATIOS - 1.000001)
    m = int(u)
    t = u - m
    move_low, move_high = -r[0] / width, r[last] / width
    hold_low, hold_high = frozen or abs(move_low) > _HOLD, frozen or abs(move_high) > _HOLD
    hold_low = hold_low or vectors[Vector.END, first] > _LOCAL
    hold_high = hold_high or vectors[Vector.END, first + last] > _LOCAL
    r[0], r[last] = 0.0 if hold_low else move_low, 0.0 if hold_high else move_high
    low, high = descent[m], descent[m + 1]
    for i in range(n):
        one, other = 0.0, 0.0
        for j in range(n):
            one += low[i, j] * r[j]
            other += high[i, j] * r[j]
        out[i] = (1.0 - t) * one + t * other
    if hold_low or hold_high:
        _prescribe(low, high, t, (move_low, move_high), (hold_low, hold_high), out)
    out[0] *= -width
    out[last] *= width
