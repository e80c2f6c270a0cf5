"""The undeformed gap on a grid of equal elements, given or sampled from a separation."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.core import entry
from contact.errors import ContactError
from contact.inputs.separation import Separation
from contact.kernels import cubic
from contact.kernels.arrays import Numbers
from contact.kernels.cubic import locate, slopes
from contact.kernels.normal.lay import find_patches, least_point
from contact.kernels.records import MAX_PATCHES

#: Most elements along one side of a grid.
MAX_SIDE = 2000


class Gap:
    """Undeformed distance of the bodies at the centres of equal rectangular elements.

    Parameters
    ----------
    x, y : array_like, shape (nx,), (ny,)
        Centres of the elements along the rolling direction and across [m], increasing in equal steps; 2 to 2000 each.
    h : array_like, shape (ny, nx)
        Undeformed distance [m]. The approach is measured from h = 0.

    Raises
    ------
    ContactError
        For wrong shapes, values that are not finite, or steps that are not equal or not positive.
    """

    __slots__ = ("dx", "dy", "h", "x", "y")

    def __init__(self, x: ArrayLike, y: ArrayLike, h: ArrayLike) -> None:
        self.x, self.dx = even("x", x)
        self.y, self.dy = even("y", y)
        self.h = as_array("h", h)
        wanted = self.y.size, self.x.size
        if self.h.shape != wanted:
            raise ContactError(f"h has shape {self.h.shape}; {wanted} is needed")
        if not np.isfinite(self.h).all():
            i, j = (int(k) for k in np.argwhere(~np.isfinite(self.h))[0])
            raise ContactError(f"h[{i}, {j}] = {self.h[i, j]} is not finite")

    def __repr__(self) -> str:
        return f"Gap({self.y.size} × {self.x.size} elements of {self.dx:g} × {self.dy:g} m, least {self.h.min():g} m)"


def even(name: str, values: ArrayLike) -> tuple[Array, float]:
    """Return centres of elements [m] as an array, and their step [m]. They must increase in equal steps."""
    array = as_array(name, values)
    if array.ndim != 1 or not 2 <= array.size <= MAX_SIDE:
        raise ContactError(f"{name} has shape {array.shape}; (n,) with n in [2, {MAX_SIDE}] is needed")
    step = float(array[-1] - array[0]) / (array.size - 1)
    # the condition is also false for NaN
    if not (step > 0.0 and math.isfinite(step) and (np.abs(np.diff(array) - step) <= 1e-6 * step).all()):
        raise ContactError(f"{name} = {array[0]:g} … {array[-1]:g} does not increase in equal steps")
    return array, step


class Division(NamedTuple):
    """Division of a box into elements: by rows and columns, or by the size (dx, dy) of an element [m]."""

    rows: int
    columns: int
    spacing: tuple[float, float] | None = None

    def centres(self, box: tuple[float, float, float, float]) -> tuple[Array, Array]:
        """Return x and y [m] of the centres of the elements on the box (x_low, x_high, y_low, y_high) [m].

        Elements of given size have their edges at multiples of the size, so they lie at the same places for every box.
        """
        back, front, low, high = box
        if self.spacing is None:
            return _divide(back, front, self.columns), _divide(low, high, self.rows)
        return _raster(back, front, self.spacing[0]), _raster(low, high, self.spacing[1])


def _divide(low: float, high: float, n: int) -> Array:
    return low + (np.arange(n, dtype=np.float64) + 0.5) * ((high - low) / n)


def _raster(low: float, high: float, step: float) -> Array:
    count = high / step - low / step
    if not count <= MAX_SIDE - 2:
        raise ContactError(
            f"spacing = {step:g} makes {count:.3g} elements along a side; at most {MAX_SIDE - 2} are allowed"
        )
    first, last = math.floor(low / step), math.ceil(high / step)
    return (np.arange(first, max(last, first + 2), dtype=np.float64) + 0.5) * step


@entry
def _sample(y: Numbers, g: Numbers, m: Numbers, at: Numbers, out: Numbers) -> None:
    """Write to `out` the cubic interpolant of g (values g, slopes m) at the increasing positions `at`."""
    k = 0
    for i in range(at.size):
        k = locate(y, y.size, at[i], k)
        h = y[k + 1] - y[k]
        out[i] = cubic.value(h, g[k], m[k], g[k + 1], m[k + 1], (at[i] - y[k]) / h)


def _rows(separation: Separation, y: Array) -> tuple[Array, Array, Array]:
    """Return g [m], A [1/m] and x_c [m] at the positions `y`."""
    m, g = np.empty(separation.y.size), np.empty(y.size)
    slopes(separation.y, separation.g, separation.y.size, m)
    _sample(separation.y, separation.g, m, y, g)
    return g, np.interp(y, separation.y, separation.A), np.interp(y, separation.y, separation.x_c)


def least(gap: Separation | Gap) -> float:
    """Return the approach at which the bodies first touch [m]."""
    if isinstance(gap, Gap):
        return float(gap.h.min())
    m = np.empty(gap.y.size)
    slopes(gap.y, gap.g, gap.y.size, m)
    return float(least_point(gap.y, gap.g, m, gap.y.size)[1])


def overlap(separation: Separation, approach: float) -> tuple[float, float, float, float] | None:
    """Return the least box (x_low, x_high, y_low, y_high) [m] that contains all points with a gap less than `approach`.

    Without such a point the result is None.
    """
    m, edges = np.empty(separation.y.size), np.empty(2 * MAX_PATCHES)
    slopes(separation.y, separation.g, separation.y.size, m)
    count = find_patches(separation.y, separation.g, m, separation.y.size, approach, edges)
    if count == 0:
        return None
    low, high = float(edges[0]), float(edges[2 * count - 1])
    y = np.union1d(np.linspace(low, high, 201), separation.y[(separation.y > low) & (separation.y < high)])
    g, A, centre = _rows(separation, y)
    half = np.sqrt(np.maximum(approach - g, 0.0) / A)
    inside = half > 0.0
    if not inside.any() or high <= low:
        return None
    return float((centre - half)[inside].min()), float((centre + half)[inside].max()), low, high


def lay(separation: Separation, x: Array, y: Array) -> Gap:
    """Return the gap of a separation at the centres `x`, `y` of elements."""
    g, A, centre = _rows(separation, y)
    return Gap(x, y, g[:, None] + A[:, None] * (x - centre[:, None]) ** 2)
