"""Start of skewed strips: the Hertz contact that is turned in its plane, instead of the straight one that ANALYN finds.

ANALYN centres its strips on the line of least gap x = x_c(y). With a straight line x_c = s y and parabolas the separation is

    A (x - s y)² + B y²,

a Hertz contact with the half curvatures P < Q and the directions of the eigenvectors of this quadratic form. The chords of
its ellipse along x have their middles on another, steeper line x = k y. ANALYN's patch has the a/b of a pair A, B; with
the slope s that gives k, and by how much patch and strips are longer or shorter (strip_halfspace.md 2, step 0).
"""

import math

from contact.core import entry, kernel
from contact.kernels.cubic import locate
from contact.kernels.hertz import local_factors
from contact.kernels.rows import Strip, Vector

#: Largest change of widths and lengths, either way.
_MOST = 2.0


@kernel
def _curvature_ratio(log_aspect):
    """Return ln(B/A) of the Hertz contact with ln(a/b) = `log_aspect`, to 1e-5. Its slope lies between 1.5 and 2."""
    u = 1.5 * log_aspect
    for _ in range(8):
        u += 1.6 * (log_aspect - local_factors(1.0, math.exp(u))[3])
    return u


@entry
def turned_ellipse(A: float, log_aspect: float, slope: float, by_load: bool) -> tuple[float, float, float]:
    """Return slope of the chords' middles, and lengths and width over those of the ellipse with `slope` 0.

    The line of least gap has the `slope`. The load is the same if `by_load`, otherwise the approach is.
    """
    ln_ratio = min(max(_curvature_ratio(log_aspect), -15.0), 15.0)
    B = A * math.exp(ln_ratio)
    alpha, beta, nr, _ = local_factors(A, B)
    off, other = -A * slope, A * slope * slope + B
    root = math.sqrt(0.25 * (A - other) ** 2 + off * off)
    Q = 0.5 * (A + other) + root
    P = A * B / Q
    if not Q - P > 1e-9 * Q:
        return slope, 1.0, 1.0
    alpha_turned, beta_turned, nr_turned, _ = local_factors(P, Q)
    along, across = alpha_turned * P, beta_turned * Q  # 1/semi-axis², for an approach of 1
    xx = (along * (Q - A) + across * (A - P)) / (Q - P)
    xy = off * (across - along) / (Q - P)
    growth = 1.0  # of the approach, from N = 4/3 E* delta b/(n r)
    if by_load:
        growth = (nr_turned / nr * math.sqrt(across / (beta * B))) ** (2.0 / 3.0)
    length, width = math.sqrt(growth * alpha * A / xx), math.sqrt(growth * beta * B * xx / (along * across))
    return -xy / xx, min(max(length, 1.0 / _MOST), _MOST), min(max(width, 1.0 / _MOST), _MOST)


@kernel
def line_of_middles(pressures, lengths, widths, ys, xs):
    """Return load-weighted means of y and x of strips, and the slope of x over y by least squares."""
    load, y, x = 0.0, 0.0, 0.0
    for i in range(ys.size):
        weight = pressures[i] * lengths[i] * widths[i]
        load, y, x = load + weight, y + weight * ys[i], x + weight * xs[i]
    if not load > 0.0:
        return 0.0, 0.0, 0.0
    y, x = y / load, x / load
    square, product = 0.0, 0.0
    for i in range(ys.size):
        weight = pressures[i] * lengths[i] * widths[i]
        away = ys[i] - y
        square, product = square + weight * away * away, product + weight * away * (xs[i] - x)
    return y, x, product / max(square, 1e-300)  # of one loaded strip 0/0, which would be a trap


@kernel
def _line(first, last, strips):
    """Return `line_of_middles` of written strips."""
    return line_of_middles(
        strips[Strip.P0, first:last],
        strips[Strip.A, first:last],
        strips[Strip.DY, first:last],
        strips[Strip.Y, first:last],
        strips[Strip.XC, first:last],
    )


@kernel
def turn_panels(sep, n_panels, n, strips, skew, by_load, panels, vectors):
    """Give panels that start from ANALYN's `strips` the offsets, lengths and ends of turned ellipses.

    `skew` is the share of x_c that counts.
    """
    k = 0
    for p in range(n_panels):
        first = p * n
        at, middle, slope = _line(first, first + n, strips)
        longest = 0.0
        for i in range(first, first + n):
            longest = max(longest, strips[Strip.A, i])
        low, high = panels[2 * p], panels[2 * p + 1]
        half = 0.5 * (high - low)
        if not (slope != 0.0 and longest > 0.0 and half > 0.0):
            continue
        slope *= skew
        k = locate(sep.y, sep.y.size, at, k)
        steeper, length, width = turned_ellipse(sep.A[k], math.log(longest / half), slope, by_load)
        for i in range(first, first + n):
            vectors[Vector.LN_A, i] += math.log(length)
            vectors[Vector.OFFSET, i] = (steeper / slope - 1.0) * skew * (strips[Strip.XC, i] - middle)
        grow = (width - 1.0) * half
        panels[2 * p] = max(low - grow, sep.y[0])
        panels[2 * p + 1] = min(high + grow, sep.y[sep.y.size - 1])


@kernel
def _turned_aspect(a, b, slope):
    """Return how much ln(a/b) of a turned ellipse in its rolling direction exceeds that of ANALYN's straight one.

    The ellipse has the half length `a` of the middle strip, the half width `b` and strips with middles on x = `slope`·y. Its
    ln(a/b) of the axes counts with cos 2θ at the angle θ between long axis and rolling direction: in full at 0, not at all
    at 45°, reversed at 90°.
    """
    xx, xy, yy = 1.0 / (a * a), -slope / (a * a), 1.0 / (b * b) + slope * slope / (a * a)
    root = math.sqrt(0.25 * (xx - yy) ** 2 + xy * xy)
    large = 0.5 * (xx + yy) + root
    small = 1.0 / (a * a * b * b * large)
    if not large - small > 1e-9 * large:
        return 0.0
    axes = 0.5 * math.log(large / small)
    turned = (yy - xx) / (large - small)  # cos 2θ
    ratio = math.exp(min(_curvature_ratio(axes), 15.0))  # Q/P
    A = 0.5 * (1.0 + turned) + 0.5 * (1.0 - turned) * ratio  # for P = 1, and B = PQ/A
    return axes * turned - local_factors(A, ratio / A)[3]


@kernel
def turn_aspects(n, skew, strips):
    """Add to Strip.LN_ASPECT what the turn of each patch makes of it, times `skew`. `n` is the number of strips."""
    first = 0
    while first < n:
        last, longest, width = first, 0.0, 0.0
        while last < n and strips[Strip.PATCH, last] == strips[Strip.PATCH, first]:
            longest, width = max(longest, strips[Strip.A, last]), width + strips[Strip.DY, last]
            last += 1
        _, _, slope = _line(first, last, strips)
        change = skew * _turned_aspect(longest, 0.5 * width, slope)
        for i in range(first, last):
            strips[Strip.LN_ASPECT, i] += change
        first = last
