"""The Hermite cubic on one interval: value, slope, integral, smallest value, crossing of a level; cubic convolution.

The interval has the length h. The cubic has the values f0, f1 and the slopes m0, m1 at its ends. t in [0, 1] is the
position within the interval.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Numbers


@entry
def value(h: float, f0: float, m0: float, f1: float, m1: float, t: float) -> float:
    """Return the value at t."""
    w = 1.0 - t
    return w * w * ((1.0 + 2.0 * t) * f0 + h * t * m0) + t * t * ((1.0 + 2.0 * w) * f1 - h * w * m1)


@entry
def value_and_slope(h: float, f0: float, m0: float, f1: float, m1: float, t: float) -> tuple[float, float]:
    """Return the value and the slope at t."""
    d = f1 - f0
    a = h * (m0 + m1) - 2.0 * d
    b = 3.0 * d - h * (2.0 * m0 + m1)
    return f0 + t * (h * m0 + t * (b + t * a)), m0 + t * (2.0 * b + 3.0 * t * a) / h


@entry
def basis(t: float) -> tuple[float, float, float, float]:
    """Return the weights of f0, h·m0, f1 and h·m1 at t. They serve several functions over one table."""
    w = 1.0 - t
    return (1.0 + 2.0 * t) * w * w, t * w * w, t * t * (3.0 - 2.0 * t), -t * t * w


@entry
def integral(h: float, f0: float, m0: float, f1: float, m1: float, t: float) -> float:
    """Return the integral from the start of the interval to t."""
    t2 = t * t
    t3, t4 = t2 * t, t2 * t2
    return h * (
        f0 * (t - t3 + 0.5 * t4)
        + h * m0 * (0.5 * t2 - 2.0 / 3.0 * t3 + 0.25 * t4)
        + f1 * (t3 - 0.5 * t4)
        + h * m1 * (0.25 * t4 - t3 / 3.0)
    )


@entry
def interior_minimum(h: float, f0: float, m0: float, f1: float, m1: float) -> tuple[float, float]:
    """Return position t in ]0, 1[ and value of the local minimum inside the interval, or (-1, 0) if there is none."""
    a = 3.0 * (2.0 * (f0 - f1) + h * (m0 + m1))  # h times the slope is a t² + b t + c
    b = 2.0 * (3.0 * (f1 - f0) - h * (2.0 * m0 + m1))
    c = h * m0
    discriminant = b * b - 4.0 * a * c
    if discriminant < 0.0:
        return -1.0, 0.0
    below = b + math.sqrt(discriminant)  # for the root with a rising slope; does not cancel for a = 0
    if below == 0.0:
        return -1.0, 0.0
    t = -2.0 * c / below
    if not 0.0 < t < 1.0:
        return -1.0, 0.0
    return t, value(h, f0, m0, f1, m1, t)


@entry
def least(h: float, f0: float, m0: float, f1: float, m1: float) -> tuple[float, float]:
    """Return position t in [0, 1] and value of the smallest value of the interval, ends included."""
    best_t, best = (1.0, f1) if f1 < f0 else (0.0, f0)
    if m0 < 0.0 < m1:
        t, inside = interior_minimum(h, f0, m0, f1, m1)
        if t > 0.0 and inside < best:
            return t, inside
    return best_t, best


@entry
def crossing(h: float, f0: float, m0: float, f1: float, m1: float, level: float, low: float, high: float) -> float:
    """Return t between `low` and `high` where the cubic passes `level`.

    The method is Newton's, kept in the bracket, with at most 60 iterations.
    """
    d = f1 - f0
    c3, c2, c1 = h * (m0 + m1) - 2.0 * d, 3.0 * d - h * (2.0 * m0 + m1), h * m0
    c0 = f0 - level
    low_is_negative = c0 + low * (c1 + low * (c2 + low * c3)) < 0.0
    t = 0.5 * (low + high)
    if c1 != 0.0 or d != 0.0:
        guess = -c0 / d if d != 0.0 else t
        if low < guess < high:
            t = guess
    for _ in range(60):
        difference = c0 + t * (c1 + t * (c2 + t * c3))
        if (difference < 0.0) == low_is_negative:
            low = t
        else:
            high = t
        slope = c1 + t * (2.0 * c2 + 3.0 * t * c3)
        new = t - difference / slope if slope != 0.0 else 0.5 * (low + high)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-15:
            return new
        t = new
    return t


@kernel
def convolution(t):
    """Return the weights of four equidistant values around t, which counts from the second one (Catmull and Rom)."""
    return (
        ((1.0 - 0.5 * t) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((2.0 - 1.5 * t) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    )


@kernel
def _slope_inside(y, f, i):
    """Return the three-point slope of f over y at sample i, which has neighbours."""
    h0, h1 = y[i] - y[i - 1], y[i + 1] - y[i]
    return (h1 * (f[i] - f[i - 1]) / h0 + h0 * (f[i + 1] - f[i]) / h1) / (h0 + h1)


@kernel
def slope_at(y, f, n, i):
    """Return the slope at sample i of n that `slopes` gives."""
    if i == 0:
        return 2.0 * (f[1] - f[0]) / (y[1] - y[0]) - _slope_inside(y, f, 1)
    if i == n - 1:
        return 2.0 * (f[n - 1] - f[n - 2]) / (y[n - 1] - y[n - 2]) - _slope_inside(y, f, n - 2)
    return _slope_inside(y, f, i)


@entry
def slopes(y: Numbers, f: Numbers, n: int, out: Numbers) -> None:
    """Fill `out` with three-point slopes of f over y. They are exact for a parabola and one-sided at the ends."""
    for i in range(1, n - 1):
        out[i] = _slope_inside(y, f, i)
    out[0] = 2.0 * (f[1] - f[0]) / (y[1] - y[0]) - out[1]
    out[n - 1] = 2.0 * (f[n - 1] - f[n - 2]) / (y[n - 1] - y[n - 2]) - out[n - 2]


@kernel
def locate(y, n, at, start):
    """Return the index i with y[i] <= at <= y[i+1], searched from `start` interval by interval.

    Outside the data it is the first or last interval.
    """
    i = start
    while i > 0 and y[i] > at:
        i -= 1
    while i < n - 2 and y[i + 1] < at:
        i += 1
    return i
