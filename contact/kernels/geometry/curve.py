"""Kernels on curves f(y): nodes with values and slopes, and a cubic between each two (piecewise Hermite, C¹).

The profiles of the standards have exact tangents. So arcs are followed to fourth order of the spacing, and the joint of
two arcs keeps its position. A spline through the points would oscillate there.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix
from contact.kernels.cubic import value_and_slope
from contact.kernels.rows import Curve

Array = NDArray[np.float64]
Record = Any  # a record of `contact.kernels.records`


@kernel
def advance(curve: Array, n: int, j: int, y: float) -> int:
    """Return the first node j of the segment that holds y, searched upwards from node j. curve[Curve.Y] increases."""
    while j < n - 2 and curve[Curve.Y, j + 1] <= y:
        j += 1
    return j


@kernel
def segment(curve: Array, first: int, n: int, y: float) -> int:
    """Return what `advance` returns from node `first`, by bisection."""
    low, high = first, n - 1
    while high - low > 1:
        middle = (low + high) // 2
        if curve[Curve.Y, middle] <= y:
            low = middle
        else:
            high = middle
    return low


@entry
def at(curve: Matrix, j: int, y: float) -> tuple[float, float]:
    """Return value and slope of the curve at y in segment j.

    The slope stays between those of the nodes, because a cubic would overshoot where two branches of an outline meet in
    a corner.
    """
    h = curve[Curve.Y, j + 1] - curve[Curve.Y, j]
    m0, m1 = curve[Curve.SLOPE, j], curve[Curve.SLOPE, j + 1]
    t = (y - curve[Curve.Y, j]) / h
    value, slope = value_and_slope(h, curve[Curve.Z, j], m0, curve[Curve.Z, j + 1], m1, t)
    return value, min(max(slope, min(m0, m1)), max(m0, m1))
