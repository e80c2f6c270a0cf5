"""Factors with which strips reproduce the ellipse of Hertz, straight or turned in its plane (strip_halfspace.md 1).

A strip has one pressure and one length over its width. With the load and the mean length of the ellipse within every strip,
the strips displace the surface .1 to 2 % more or less than the ellipse does. These factors of the displacement by a panel's own
strips, at the middles of the strips, at their ends in the mean, and of the difference of both ends, remove that. They depend
on a/b, on the shear of the ellipse and on the strip alone. `fill_exact` computes them with the same influence tables that the
solution reads. Other patches get the factors of the ellipse with their a/b and shear.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Cube, Matrix
from contact.kernels.hertz import elliptic_integrals
from contact.kernels.normal.descent import END_LENGTH, FEWEST
from contact.kernels.normal.influence import at_centre, in_row, logarithm, off_line, row_at
from contact.kernels.quadrature import on_circle
from contact.kernels.rows import Vector

#: Table: ln(a/b) of the first ratio, step, number; step of asinh(shear), number. The shear is the slope of the line of the
#: middles over a/b.
_LOW, _STEP, _N_RATIOS = -3.0, 0.7, 10
_SHEAR_STEP, _N_SHEARS = 0.4, 8
#: Layers of the table. Each has one row for each factor: Vector.OF_MIDDLE, OF_ENDS and OF_DIFFERENCE.
N_EXACT, N_FACTORS = _N_RATIOS * _N_SHEARS, 3


@kernel
def _at_middle(i, j, x, y, h, a, centre, plane):
    """Return the displacement at the middle of strip i by a unit pressure on strip j, with pi E* = 1."""
    near, far = math.log(abs(abs(y[j] - y[i]) - h[j]) / a[j]), math.log((abs(y[j] - y[i]) + h[j]) / a[j])
    if i == j:
        return a[j] * (at_centre(centre, far) + at_centre(centre, near))
    X = abs(x[i] - x[j]) / a[j]
    if X == 0.0:
        return a[j] * (at_centre(centre, far) - at_centre(centre, near))
    return a[j] * off_line(centre, plane, X, far, near)


@kernel
def _at_end(i, j, X, y, h, a, plane):
    """Return the displacement at y of strip i, x = X·a_j from the middle of strip j, by a unit pressure on strip j."""
    near, far = math.log(abs(abs(y[j] - y[i]) - h[j]) / a[j]), math.log((abs(y[j] - y[i]) + h[j]) / a[j])
    row, share, ln_X = row_at(X, logarithm(X))
    sign = 1.0 if i == j else -1.0
    return a[j] * (in_row(plane, row, share, far - ln_X) + sign * in_row(plane, row, share, near - ln_X))


@kernel
def _hertz(ratio, slope):
    """Return approach, curvature A, slope of the line of least gap and curvature B of a Hertz contact.

    Its ellipse has the half width 1, the half length `ratio` of the chord at y = 0 and chords with middles on x = `slope`·y.
    The peak pressure is 1, and pi E* = 1.
    """
    xx = 1.0 / (ratio * ratio)
    xy, yy = -slope * xx, 1.0 + slope * slope * xx
    large = 0.5 * (xx + yy) + math.sqrt(0.25 * (xx - yy) ** 2 + xy * xy)
    small = xx / large
    short, long = 1.0 / math.sqrt(large), 1.0 / math.sqrt(small)
    K, _, B, D = elliptic_integrals(short / long)
    along, across = math.pi * short / (long * long) * D, math.pi / short * B
    share = (across - along) / (large - small) if large - small > 1e-9 * large else 0.0
    A, off, other = along + share * (xx - small), share * xy, along + share * (yy - small)
    return math.pi * short * K, A, -off / A, other - off * off / A


@kernel
def _lay(n, rows):
    """Fill middles, half widths, mean chords and mean squared chords of the strips of the unit circle."""
    for i in range(n):
        low, high = math.pi * i / n, math.pi * (i + 1) / n
        left, right = -on_circle(i, n)[0], -on_circle(i + 1, n)[0]
        rows[0, i], rows[1, i] = 0.5 * (left + right), 0.5 * (right - left)
        chord = 0.5 * (high - low) - 0.25 * (math.sin(2.0 * high) - math.sin(2.0 * low))
        rows[2, i] = chord / (right - left)
        rows[3, i] = 1.0 - (left * left + left * right + right * right) / 3.0


@kernel
def _fill_layer(longest, slope, rows, centre, plane, layer):
    """Fill the factors for the ellipse whose longest strip has the half length `longest`."""
    n = layer.shape[1]
    y, h, a, p, x = rows[0], rows[1], rows[4], rows[5], rows[6]
    ratio = longest / rows[2, n // 2]
    for i in range(n):
        k = min(max(i, 1), n - 2)
        a[i] = ratio * rows[2, k] * (1.0 if i == k else END_LENGTH)
        p[i], x[i] = ratio * rows[3, i] / a[i], slope * y[i]
    approach, A, least, B = _hertz(ratio, slope)
    for i in range(n):
        middle, leading, trailing = 0.0, 0.0, 0.0
        for j in range(n):
            apart = x[i] - x[j]
            middle += p[j] * _at_middle(i, j, x, y, h, a, centre, plane)
            leading += p[j] * _at_end(i, j, abs(apart + a[i]) / a[j], y, h, a, plane)
            trailing += p[j] * _at_end(i, j, abs(apart - a[i]) / a[j], y, h, a, plane)
        offset = (slope - least) * y[i]
        closed = approach - B * (y[i] * y[i] + h[i] * h[i] / 3.0) - A * offset * offset
        layer[0, i] = closed / middle
        layer[1, i] = (closed - A * a[i] * a[i]) / (0.5 * (leading + trailing))
        # a strip at y = 0 has no difference
        layer[2, i] = -4.0 * A * a[i] * offset / (leading - trailing) if abs(y[i]) > 1e-9 else 1.0
    for i in range((n + 1) // 2):  # makes both halves mirror images to the last bit
        for r in range(N_FACTORS):
            mean = 0.5 * (layer[r, i] + layer[r, n - 1 - i])
            layer[r, i] = layer[r, n - 1 - i] = mean


@entry
def fill_exact(centre: Matrix, plane: Matrix, scratch: Cube, exact: Cube) -> None:
    """Fill the factors. `scratch` has a layer of at least seven rows, which are overwritten."""
    n = exact.shape[2]
    if n < FEWEST:
        return
    _lay(n, scratch[0])
    for m in range(_N_RATIOS):
        longest = math.exp(_LOW + m * _STEP)
        for q in range(_N_SHEARS):
            shear = 0.5 * (math.exp(q * _SHEAR_STEP) - math.exp(-q * _SHEAR_STEP))
            _fill_layer(longest, longest * shear, scratch[0], centre, plane, exact[m * _N_SHEARS + q])
        for i in range(n):  # without shear there is no difference; the factor has a limit
            exact[m * _N_SHEARS, 2, i] = exact[m * _N_SHEARS + 1, 2, i]


@kernel
def _place(u, nodes):
    """Return the node before u in [0, nodes - 1], and the weights of four nodes (Catmull and Rom)."""
    u = u if u > 0.0 else 0.0  # written so that NaN does not become an index
    u = min(u, nodes - 1.000001)
    i = int(u)
    t = u - i
    return (
        i,
        ((1.0 - 0.5 * t) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((2.0 - 1.5 * t) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    )


@kernel
def _add(weight, layer, first, n, vectors):
    """Add a layer's factors times `weight` to those of the strips from `first` on."""
    middle, ends = vectors[Vector.OF_MIDDLE, first : first + n], vectors[Vector.OF_ENDS, first : first + n]
    difference = vectors[Vector.OF_DIFFERENCE, first : first + n]
    for i in range(n):
        middle[i] += weight * layer[0, i]
        ends[i] += weight * layer[1, i]
        difference[i] += weight * layer[2, i]


@kernel
def _add_ratio(weight, m, u, sheared, exact, first, n, vectors):
    """Add the factors of the ratio with number m, which lies on the parabola through three ratios beyond the table's ends."""
    if m < 0:
        _add_ratio_within(3.0 * weight, 0, u, sheared, exact, first, n, vectors)
        _add_ratio_within(-3.0 * weight, 1, u, sheared, exact, first, n, vectors)
        _add_ratio_within(weight, 2, u, sheared, exact, first, n, vectors)
    elif m >= _N_RATIOS:
        _add_ratio_within(3.0 * weight, _N_RATIOS - 1, u, sheared, exact, first, n, vectors)
        _add_ratio_within(-3.0 * weight, _N_RATIOS - 2, u, sheared, exact, first, n, vectors)
        _add_ratio_within(weight, _N_RATIOS - 3, u, sheared, exact, first, n, vectors)
    else:
        _add_ratio_within(weight, m, u, sheared, exact, first, n, vectors)


@kernel
def _add_ratio_within(weight, m, u, sheared, exact, first, n, vectors):
    """Add the factors of one ratio at the place u of the shear. They are even in the shear, and constant beyond the last."""
    if not sheared:
        _add(weight, exact[m * _N_SHEARS], first, n, vectors)
        return
    q, w0, w1, w2, w3 = _place(u, _N_SHEARS)
    last = _N_SHEARS - 1
    _add(weight * w0, exact[m * _N_SHEARS + abs(q - 1)], first, n, vectors)
    _add(weight * w1, exact[m * _N_SHEARS + q], first, n, vectors)
    _add(weight * w2, exact[m * _N_SHEARS + q + 1], first, n, vectors)
    _add(weight * w3, exact[m * _N_SHEARS + min(q + 2, last)], first, n, vectors)


@kernel
def _slope(first, n, vectors):
    """Return the slope of the strips' middles over y, by least squares weighted with the loads."""
    load, y, x = 0.0, 0.0, 0.0
    for i in range(first, first + n):
        weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
        load, y, x = load + weight, y + weight * vectors[Vector.Y, i], x + weight * vectors[Vector.XC, i]
    if not load > 0.0:
        return 0.0
    y, x = y / load, x / load
    square, product = 0.0, 0.0
    for i in range(first, first + n):
        weight = vectors[Vector.P, i] * vectors[Vector.A, i] * vectors[Vector.HALF, i]
        away = vectors[Vector.Y, i] - y
        square, product = square + weight * away * away, product + weight * away * (vectors[Vector.XC, i] - x)
    return product / square if square > 0.0 else 0.0


@kernel
def set_factors(panels, n_panels, skewed, exact, n, vectors):
    """Set the factors of all strips from the a/b and the shear of their panels; 1 if there is no table for `n` strips."""
    tabulated = exact.shape[2] == n
    for p in range(n_panels):
        first, longest, half = p * n, 0.0, 0.5 * (panels[2 * p + 1] - panels[2 * p])
        start = 0.0 if tabulated else 1.0
        for i in range(first, first + n):
            vectors[Vector.OF_MIDDLE, i] = vectors[Vector.OF_ENDS, i] = vectors[Vector.OF_DIFFERENCE, i] = start
            longest = max(longest, vectors[Vector.A, i])
        if not tabulated:
            continue
        shear = _slope(first, n, vectors) * half / longest if skewed else 0.0
        u = math.asinh(abs(shear)) * (1.0 / _SHEAR_STEP)
        m, w0, w1, w2, w3 = _place((math.log(longest / half) - _LOW) * (1.0 / _STEP), _N_RATIOS)
        _add_ratio(w0, m - 1, u, skewed, exact, first, n, vectors)
        _add_ratio(w1, m, u, skewed, exact, first, n, vectors)
        _add_ratio(w2, m + 1, u, skewed, exact, first, n, vectors)
        _add_ratio(w3, m + 2, u, skewed, exact, first, n, vectors)
