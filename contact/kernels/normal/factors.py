"""Factors with which skewed strips reproduce Hertz's ellipse, whatever its angle to the rolling direction (Eq. factors).

A strip has one pressure, one length and one middle over its width. Where the middles of neighbours lie far apart over their
lengths, such strips displace the surface up to 3 % less than the turned ellipse with their loads and lengths does. The factors
of the displacement by a panel's own strips remove that: at the middles of the strips, at their ends in the mean, and of the
difference of both ends. They depend on the panel's a/b, its shear and the strip alone. The shear is the slope of the line of
the middles over a/b. Other patches get the factors of the ellipse with their a/b and shear. Strips in line have none.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Cube, Matrix
from contact.kernels.hertz import elliptic_integrals
from contact.kernels.normal.descent import END_LENGTH, END_VALUE, FEWEST
from contact.kernels.normal.influence import at_centre, in_row, logarithm, off_line, row_at
from contact.kernels.quadrature import on_circle
from contact.kernels.rows import Vector

#: Table: ln(a/b) of the first ratio, step, number; step of asinh(shear), number. The interpolation is cubic, so the outermost
#: ratios and the largest shear lie beyond its range.
_LOW, _STEP, _N_RATIOS = -4.0, 1.0, 9
_SHEAR_STEP, _N_SHEARS = 0.2, 16
#: Layers of the table. Each has one row for each factor: Vector.OF_MIDDLE, OF_ENDS and OF_DIFFERENCE.
N_LAYERS, N_FACTORS = _N_RATIOS * _N_SHEARS, 3
#: Pressure of an end strip over that of its neighbour.
_END_PRESSURE = 0.36


@kernel
def _by_strip(i, j, X, rows, centre, plane):
    """Return the displacement at y of strip i, x = X·a_j from the middle of strip j, by a unit pressure there; pi E* = 1."""
    y, h, a = rows[0], rows[1], rows[3, j]
    near = math.log(abs(abs(y[j] - y[i]) - h[j]) / a)
    far = math.log((abs(y[j] - y[i]) + h[j]) / a)
    if i != j:
        return a * (
            off_line(centre, plane, X, far, near) if X > 0.0 else at_centre(centre, far) - at_centre(centre, near)
        )
    if X == 0.0:
        return a * (at_centre(centre, far) + at_centre(centre, near))
    row, share, ln_X = row_at(X, logarithm(X))
    return a * (in_row(plane, row, share, far - ln_X) + in_row(plane, row, share, near - ln_X))


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
    share = (across - along) / max(large - small, 1e-9 * large)
    A, off, other = along + share * (xx - small), share * xy, along + share * (yy - small)
    return math.pi * short * K, A, -off / A, other - off * off / A


@kernel
def _lay_circle(n, rows):
    """Fill middles, half widths, half lengths and pressures of the strips of the unit circle in rows 0, 1, 2, 5.

    Half lengths are mean chords. Pressures are those of the middles, raised away from y = 0 so that they bear the load. Those
    at the ends are what the rule of the ends asks for.
    """
    y, h, p = rows[0], rows[1], rows[5]
    for i in range(n):
        left, right = -on_circle(i, n)[0], -on_circle(i + 1, n)[0]
        y[i], h[i] = 0.5 * (left + right), 0.5 * (right - left)
        low, high = math.pi * i / n, math.pi * (i + 1) / n
        chord = 0.5 * (high - low) - 0.25 * (math.sin(2.0 * high) - math.sin(2.0 * low))
        rows[2, i] = chord / (right - left)
    for end, inwards in ((0, 1), (n - 1, -1)):
        rows[2, end] = END_LENGTH * rows[2, end + inwards]
    for i in range(n):
        p[i] = math.sqrt(1.0 - y[i] * y[i])
    for end, inwards in ((0, 1), (n - 1, -1)):
        p[end + inwards] = math.sqrt(END_VALUE) * p[end + 2 * inwards]
        p[end] = _END_PRESSURE * p[end + inwards]
    missing, outwards = 2.0 / 3.0, 0.0
    for i in range(n):
        load = h[i] * rows[2, i] * p[i]
        missing, outwards = missing - load, outwards + load * y[i] * y[i]
    for i in range(n):
        p[i] *= 1.0 + missing / outwards * y[i] * y[i]


@kernel
def _fill_layer(ratio, slope, rows, centre, plane, layer):
    """Fill the factors for the ellipse whose chord at y = 0 is `ratio` times its width."""
    n = layer.shape[1]
    y, h, a, x, p = rows[0], rows[1], rows[3], rows[4], rows[5]
    for i in range(n):
        a[i], x[i] = ratio * rows[2, i], slope * y[i]
    approach, A, least, B = _hertz(ratio, slope)
    for i in range(n):
        middle, leading, trailing = 0.0, 0.0, 0.0
        for j in range(n):
            apart = x[i] - x[j]
            middle += p[j] * _by_strip(i, j, abs(apart) / a[j], rows, centre, plane)
            leading += p[j] * _by_strip(i, j, abs(apart + a[i]) / a[j], rows, centre, plane)
            trailing += p[j] * _by_strip(i, j, abs(apart - a[i]) / a[j], rows, centre, plane)
        offset = (slope - least) * y[i]
        closed = approach - B * (y[i] * y[i] + h[i] * h[i] / 3.0) - A * offset * offset
        layer[0, i] = closed / middle
        layer[1, i] = (closed - A * a[i] * a[i]) / (0.5 * (leading + trailing))
        # Without shear, and at y = 0, the ends do not differ. Compilers divide before they choose, and 0/0 would be a trap.
        layer[2, i] = -4.0 * A * a[i] * offset / (leading - trailing + 1e-300) if abs(offset) > 1e-9 else 1.0
    for i in range((n + 1) // 2):  # makes both halves mirror images to the last bit
        for r in range(N_FACTORS):
            layer[r, i] = layer[r, n - 1 - i] = 0.5 * (layer[r, i] + layer[r, n - 1 - i])


@entry
def fill_factors(centre: Matrix, plane: Matrix, scratch: Cube, table: Cube) -> None:
    """Fill the table. `scratch` has a layer of at least six rows, which are overwritten."""
    n = table.shape[2]
    if n < FEWEST:
        return
    _lay_circle(n, scratch[0])
    for m in range(_N_RATIOS):
        ratio = math.exp(_LOW + m * _STEP)
        for q in range(_N_SHEARS):
            asinh = q * _SHEAR_STEP
            shear = 0.5 * (math.exp(asinh) - math.exp(-asinh))
            _fill_layer(ratio, ratio * shear, scratch[0], centre, plane, table[m * _N_SHEARS + q])
        for i in range(n):  # the factor of a difference that vanishes has a limit
            table[m * _N_SHEARS, 2, i] = table[m * _N_SHEARS + 1, 2, i]


@kernel
def _place(u, least, most):
    """Return the node before u, within `least` and `most`, and the weights of the four nodes around (Catmull and Rom)."""
    u = u if u > least else least  # written so that NaN does not become an index
    u = min(u, most - 1e-6)
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
def _add_ratio(weight, layers, shear, first, n, vectors):
    """Add the factors of one ratio at the place of the shear, in which they are even, times `weight`."""
    q, w0, w1, w2, w3 = shear
    one, two, three, four = layers[abs(q - 1)], layers[q], layers[q + 1], layers[q + 2]
    for r in range(N_FACTORS):
        row = vectors[Vector.OF_MIDDLE + r, first : first + n]
        for i in range(n):
            row[i] += weight * (w0 * one[r, i] + w1 * two[r, i] + w2 * three[r, i] + w3 * four[r, i])


@kernel
def _slope(first, n, vectors):
    """Return the slope of the middles of a panel's strips over y, by least squares weighted with the loads."""
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
    return product / max(square, 1e-300)  # of one loaded strip 0/0, which would be a trap


@kernel
def set_factors(panels, n_panels, skew, table, n, vectors):
    """Set the factors of all strips from the a/b and the shear of their panels. `skew` is the share that counts.

    They are 1 if strips are in line, and if there is no table for `n` strips.
    """
    share = skew if table.shape[2] == n and n >= FEWEST else 0.0
    for p in range(n_panels):
        first, half = p * n, 0.5 * (panels[2 * p + 1] - panels[2 * p])
        for r in range(N_FACTORS):
            for i in range(first, first + n):
                vectors[Vector.OF_MIDDLE + r, i] = 1.0 - share
        if share == 0.0:
            continue
        longest = 0.0
        for i in range(first, first + n):
            longest = max(longest, vectors[Vector.A, i])
        shear = math.asinh(abs(_slope(first, n, vectors)) * half / longest)
        at = _place(shear * (1.0 / _SHEAR_STEP), 0.0, _N_SHEARS - 2.0)
        m, w0, w1, w2, w3 = _place((math.log(longest / half) - _LOW) * (1.0 / _STEP), 1.0, _N_RATIOS - 2.0)
        for k in range(4):  # by comparisons, as the index of a tuple could raise
            weight = w0 if k == 0 else w1 if k == 1 else w2 if k == 2 else w3
            begin = (m - 1 + k) * _N_SHEARS
            _add_ratio(share * weight, table[begin : begin + _N_SHEARS], at, first, n, vectors)
