"""Kernels on curves f(y): rows of nodes with values and slopes, a cubic between each two (piecewise Hermite, C¹).

The profiles of the standards have exact tangents, so arcs are followed to fourth order of the spacing and a joint of two
arcs stays where it is; a spline through the points would ring there.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact._jit import kernel
from contact.kernels.layout import Curve

Array = NDArray[np.float64]
Record = Any  # of `contact.kernels.layout`


@kernel
def hermite(f0: float, f1: float, m0: float, m1: float, h: float, t: float) -> tuple[float, float]:
    """Value and slope at t in [0, 1] of the cubic with values f0, f1 and slopes m0, m1 at distance h."""
    d = f1 - f0
    a = h * (m0 + m1) - 2.0 * d
    b = 3.0 * d - h * (2.0 * m0 + m1)
    return f0 + t * (h * m0 + t * (b + t * a)), m0 + t * (2.0 * b + 3.0 * t * a) / h


@kernel
def least(f0: float, f1: float, m0: float, m1: float, h: float) -> tuple[float, float]:
    """Position t in ]0, 1[ and value of the interior minimum of that cubic; (-1, 0) when it has none."""
    a = 6.0 * (f0 - f1) + 3.0 * h * (m0 + m1)
    b = 6.0 * (f1 - f0) - h * (4.0 * m0 + 2.0 * m1)
    discriminant = b * b - 4.0 * a * h * m0
    if discriminant < 0.0:
        return -1.0, 0.0
    denominator = b + math.sqrt(discriminant)  # the root with a rising slope; finite for a = 0
    if denominator == 0.0:
        return -1.0, 0.0
    t = -2.0 * h * m0 / denominator
    if not 0.0 < t < 1.0:
        return -1.0, 0.0
    return t, hermite(f0, f1, m0, m1, h, t)[0]


@kernel
def root(f0: float, f1: float, m0: float, m1: float, h: float, low: float, high: float) -> float:
    """t in [low, high] where that cubic, of different signs at both, is zero: Newton's steps kept in the bracket."""
    rising = hermite(f0, f1, m0, m1, h, high)[0] > 0.0
    t = 0.5 * (low + high)
    for _ in range(60):
        f, m = hermite(f0, f1, m0, m1, h, t)
        if (f > 0.0) == rising:
            high = t
        else:
            low = t
        step = f / (m * h) if m != 0.0 else 2.0
        new = t - step
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-14:
            return new
        t = new
    return t


@kernel
def advance(curve: Array, n: int, j: int, y: float) -> int:
    """First node j of the segment that holds y, searched from node j up; curve[Curve.Y] increases."""
    while j < n - 2 and curve[Curve.Y, j + 1] <= y:
        j += 1
    return j


@kernel
def at(curve: Array, j: int, y: float) -> tuple[float, float]:
    """Value and slope of the curve at y in segment j.

    The slope stays between those of the nodes: where two branches of an outline meet in a corner, a cubic would overshoot.
    """
    h = curve[Curve.Y, j + 1] - curve[Curve.Y, j]
    m0, m1 = curve[Curve.SLOPE, j], curve[Curve.SLOPE, j + 1]
    value, slope = hermite(curve[Curve.Z, j], curve[Curve.Z, j + 1], m0, m1, h, (y - curve[Curve.Y, j]) / h)
    return value, min(max(slope, min(m0, m1)), max(m0, m1))
