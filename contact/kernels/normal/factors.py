"""Factors with which strips reproduce Hertz's ellipse, whatever its angle to the rolling direction (Eq. factors).

A strip has one pressure, one length and one middle over its width. So strips with the pressures and lengths of an ellipse
displace the surface up to .5 % more or less than the ellipse does, and up to 3 % less where the middles of neighbours lie far
apart over their lengths. The factors of the displacement by a panel's own strips remove that: at the middles of the strips, at
their ends in the mean, and of the difference of both ends. They depend on the panel's a/b, its shear and the strip alone. The
shear is the slope of the line of the middles over a/b. Other patches get the factors of the ellipse with their area, width and
shear.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Cube, Matrix
from contact.kernels.cubic import convolution
from contact.kernels.hertz import elliptic_integrals
from contact.kernels.normal.descent import END_LENGTH, END_VALUE, influence, lay
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.influence import off_line
from contact.kernels.normal.turned import line_of_middles
from contact.kernels.rows import Vector

#: Table: ln(a/b) of the first ratio, step, number; step of asinh(shear), number. The interpolation is cubic, so the outermost
#: ratios and the largest shear lie beyond its range.
_LOW, _STEP, _N_RATIOS = -3.5, 0.5, 15
_SHEAR_STEP, _N_SHEARS = 0.2, 16
#: Least number of strips of a panel. With fewer the factors beside its ends swing by a per cent, and the ends find no rest.
LEAST = 14
#: Rounds in which pressures at the ends and the load come to agree. Each divides what is left by about 20.
_ROUNDS = 6
#: Layers of the table. Each has one row for each factor: Vector.OF_MIDDLE, OF_ENDS and OF_DIFFERENCE.
N_LAYERS, N_FACTORS = _N_RATIOS * _N_SHEARS, 3


@kernel
def _at_middle(i, j, X, rows, centre, plane):
    """Return the displacement at the middle of strip i, X·a_j along x from that of strip j, as `influence` but more exact."""
    y, h, a = rows[0], rows[1], rows[3]
    if i == j or X == 0.0:
        return influence(i, j, 0.0, y, h, a, centre, plane)
    away = abs(y[j] - y[i])
    return a[j] * off_line(centre, plane, X, math.log((away + h[j]) / a[j]), math.log((away - h[j]) / a[j]))


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
    """Fill middles, half widths and half lengths (mean chords) of the strips of the unit circle in rows 0, 1 and 2."""
    lay(n, -1.0, 1.0, rows[0], rows[1])
    for i in range(n):
        low, high = math.pi * i / n, math.pi * (i + 1) / n
        chord = 0.5 * (high - low) - 0.25 * (math.sin(2.0 * high) - math.sin(2.0 * low))
        rows[2, i] = 0.5 * chord / rows[1, i]
    for end, inwards in ((0, 1), (n - 1, -1)):
        rows[2, end] = END_LENGTH * rows[2, end + inwards]


@kernel
def _fill_pressures(closed, rows, lu, centre, plane):
    """Fill row 5 with the pressures that close the gap, times a factor 1 + c + d·y²; `closed` is the displacement that does so.

    With the factor they bear the load, and that at the middle is the ellipse's. Those beside the ends are what the rule of the
    ends asks for.
    """
    n = closed.size
    y, h, x, p, unused = rows[0], rows[1], rows[4], rows[5], rows[6]
    for j in range(n):
        p[j] = unused[j] = closed[j]
        for i in range(n):
            lu[j, i] = _at_middle(i, j, abs(x[i] - x[j]) / rows[3, j], rows, centre, plane)
    eliminate(lu, n, p, unused)
    square = y[n // 2] * y[n // 2]
    rise = math.sqrt(1.0 - square) / p[n // 2]
    for _ in range(_ROUNDS):
        load, outwards = 0.0, 0.0
        for i in range(n):
            load += h[i] * rows[2, i] * p[i]
            outwards += h[i] * rows[2, i] * p[i] * (y[i] * y[i] - square)
        slope = (2.0 / 3.0 - rise * load) / outwards
        for end, inwards in ((1, 1), (n - 2, -1)):
            beside = end + inwards
            raised = p[beside] * (rise + slope * (y[beside] * y[beside] - square))
            p[end] = math.sqrt(END_VALUE) * raised / (rise + slope * (y[end] * y[end] - square))
    for i in range(n):
        p[i] *= rise + slope * (y[i] * y[i] - square)


@kernel
def _fill_layer(ratio, slope, rows, lu, centre, plane, layer):
    """Fill the factors for the ellipse whose chord at y = 0 is `ratio` times its width."""
    n = layer.shape[1]
    y, h, a, x, p, closed = rows[0], rows[1], rows[3], rows[4], rows[5], rows[7, :n]
    approach, A, least, B = _hertz(ratio, slope)
    for i in range(n):
        a[i], x[i] = ratio * rows[2, i], slope * y[i]
        closed[i] = approach - B * (y[i] * y[i] + h[i] * h[i] / 3.0) - A * ((slope - least) * y[i]) ** 2
    _fill_pressures(closed, rows, lu, centre, plane)
    for i in range(n):
        middle, leading, trailing = 0.0, 0.0, 0.0
        for j in range(n):
            apart = x[i] - x[j]
            middle += p[j] * _at_middle(i, j, abs(apart) / a[j], rows, centre, plane)
            leading += p[j] * influence(i, j, abs(apart + a[i]) / a[j], y, h, a, centre, plane)
            trailing += p[j] * influence(i, j, abs(apart - a[i]) / a[j], y, h, a, centre, plane)
        offset = (slope - least) * y[i]
        layer[0, i] = closed[i] / middle
        layer[1, i] = (closed[i] - A * a[i] * a[i]) / (0.5 * (leading + trailing))
        # Without shear, and at y = 0, the ends do not differ. Compilers divide before they choose, and 0/0 would be a trap.
        layer[2, i] = -4.0 * A * a[i] * offset / (leading - trailing + 1e-300) if abs(offset) > 1e-9 else 1.0
    for i in range((n + 1) // 2):  # makes both halves mirror images to the last bit
        for r in range(N_FACTORS):
            layer[r, i] = layer[r, n - 1 - i] = 0.5 * (layer[r, i] + layer[r, n - 1 - i])


@entry
def fill_factors(centre: Matrix, plane: Matrix, scratch: Cube, table: Cube) -> None:
    """Fill the table. `scratch` has two layers of at least eight rows, which are overwritten."""
    n = table.shape[2]
    if n < LEAST:
        return
    _lay_circle(n, scratch[0])
    for m in range(_N_RATIOS):
        ratio = math.exp(_LOW + m * _STEP)
        for q in range(_N_SHEARS):
            asinh = q * _SHEAR_STEP
            shear = 0.5 * (math.exp(asinh) - math.exp(-asinh))
            _fill_layer(ratio, ratio * shear, scratch[0], scratch[1], centre, plane, table[m * _N_SHEARS + q])
        for i in range(n):  # the factor of a difference that vanishes has a limit
            table[m * _N_SHEARS, 2, i] = table[m * _N_SHEARS + 1, 2, i]


@kernel
def _place(u, least, most):
    """Return the node before u, within `least` and `most`, and the weights of the four nodes around."""
    u = u if u > least else least  # written so that NaN does not become an index
    u = min(u, most - 1e-6)
    i = int(u)
    return i, convolution(u - i)


@kernel
def _add_ratio(weight, layers, shear, first, n, vectors):
    """Add the factors of one ratio at the place of the shear, in which they are even, times `weight`."""
    q, (w0, w1, w2, w3) = shear
    one, two, three, four = layers[abs(q - 1)], layers[q], layers[q + 1], layers[q + 2]
    for r in range(N_FACTORS):
        row = vectors[Vector.OF_MIDDLE + r, first : first + n]
        for i in range(n):
            row[i] += weight * (w0 * one[r, i] + w1 * two[r, i] + w2 * three[r, i] + w3 * four[r, i])


@kernel
def _add_straight(weight, layer, first, n, vectors):
    """Add the factors of one ratio without shear, where both ends of a strip are alike, times `weight`."""
    of_middle, of_ends = vectors[Vector.OF_MIDDLE, first : first + n], vectors[Vector.OF_ENDS, first : first + n]
    for i in range(n):
        of_middle[i] += weight * layer[0, i]
        of_ends[i] += weight * layer[1, i]


@kernel
def set_panel_factors(first, n, ln_ratio, slope, skewed, table, vectors):
    """Set the factors of a panel with the logarithm of its a/b and, if it is `skewed`, the `slope` of its middles over y."""
    for r in range(N_FACTORS):
        for i in range(first, first + n):
            vectors[Vector.OF_MIDDLE + r, i] = 0.0
    m, (w0, w1, w2, w3) = _place((ln_ratio - _LOW) * (1.0 / _STEP), 1.0, _N_RATIOS - 2.0)
    shear = math.asinh(abs(slope) * math.exp(-ln_ratio)) if skewed else 0.0
    at = _place(shear * (1.0 / _SHEAR_STEP), 0.0, _N_SHEARS - 2.0)
    for k in range(4):  # by comparisons, as the index of a tuple could raise
        weight = w0 if k == 0 else w1 if k == 1 else w2 if k == 2 else w3
        begin = (m - 1 + k) * _N_SHEARS
        if skewed:
            _add_ratio(weight, table[begin : begin + _N_SHEARS], at, first, n, vectors)
        else:
            _add_straight(weight, table[begin], first, n, vectors)


@kernel
def log_aspect(first, n, half, vectors):
    """Return ln(a/b) of the ellipse with the area and the width of a panel, whose half width is `half`."""
    area = 0.0
    for i in range(first, first + n):
        area += vectors[Vector.A, i] * vectors[Vector.HALF, i]
    return math.log(4.0 / math.pi * area / (half * half))


@kernel
def set_factors(panels, n_panels, skewed, table, n, vectors):
    """Set the factors of all strips from the a/b and the shear of their panels.

    They are 1 if there is no table for `n` strips.
    """
    if not has_factors(n, table):
        for r in range(N_FACTORS):
            for i in range(n_panels * n):
                vectors[Vector.OF_MIDDLE + r, i] = 1.0
        return
    for p in range(n_panels):
        first, last, slope = p * n, p * n + n, 0.0
        if skewed:
            _, _, slope = line_of_middles(
                vectors[Vector.P, first:last],
                vectors[Vector.A, first:last],
                vectors[Vector.HALF, first:last],
                vectors[Vector.Y, first:last],
                vectors[Vector.XC, first:last],
            )
        ratio = log_aspect(first, n, 0.5 * (panels[2 * p + 1] - panels[2 * p]), vectors)
        set_panel_factors(first, n, ratio, slope, skewed, table, vectors)


@kernel
def has_factors(n, table):
    """Return whether there is a table for `n` strips."""
    return table.shape[2] == n and n >= LEAST


@kernel
def fill_factor_slopes(n, width, step, workspace):
    """Fill the slopes of the logarithms of both factors of a straight panel by its ln(a/b): the rows Q1 and Q2 of the vectors.

    The row DIFFERENCE gets the slopes of ln(a/b) by the ln a of each strip. `step` is that of ln(a/b).
    """
    vectors, table = workspace.space.vectors, workspace.rule.factors
    of_middle, of_ends = vectors[Vector.OF_MIDDLE], vectors[Vector.OF_ENDS]
    middles, ends, shares = vectors[Vector.Q1], vectors[Vector.Q2], vectors[Vector.DIFFERENCE]
    area = 0.0
    for i in range(n):
        shares[i], middles[i], ends[i] = vectors[Vector.A, i] * vectors[Vector.HALF, i], 0.0, 0.0
        area += shares[i]
    for i in range(n):
        shares[i] /= area
    if not has_factors(n, table):
        return
    ratio = log_aspect(0, n, 0.5 * width, vectors)
    set_panel_factors(0, n, ratio + step, 0.0, False, table, vectors)
    for i in range(n):
        middles[i], ends[i] = of_middle[i], of_ends[i]
    set_panel_factors(0, n, ratio, 0.0, False, table, vectors)
    for i in range(n):
        middles[i], ends[i] = (middles[i] / of_middle[i] - 1.0) / step, (ends[i] / of_ends[i] - 1.0) / step
