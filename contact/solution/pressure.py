"""Pressure of a solution between its strips, and a sketch of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.notebook import Sketch

if TYPE_CHECKING:
    from contact.solution.solution import Solution, Strips

Array = NDArray[np.float64]


def pressure_at(solution: Solution, x: ArrayLike, y: ArrayLike) -> Array:
    """Return the contact pressure [Pa] at points of the contact plane: the work of `Solution.pressure`."""
    x, y = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    result = np.zeros(x.shape)
    for k in range(len(solution.patch_edges)):
        result += pressure_of_patch(solution, k, x, y)  # a sum, because the ellipses of multi_hertz may overlap
    return result


def pressure_of_patch(solution: Solution, k: int, x: ArrayLike, y: ArrayLike) -> Array:
    """Return the contact pressure [Pa] of patch `k` at points of the contact plane; 0 outside the patch."""
    x, y = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    result, limit = np.zeros(x.shape), solution.material.pressure_limit
    low, high = solution.patch_edges[k]
    own = solution.strips.patch == k
    knots = np.r_[low, solution.strips.y[own], high]
    a, p0 = solution.strips.a[own], solution.strips.p0[own]
    inside = (y > low) & (y < high)
    centre = np.interp(y[inside], solution.strips.y[own], solution.strips.x_c[own])
    a2 = np.maximum(_parabolic(knots, np.r_[0.0, a**2, 0.0], y[inside]), 0.0)
    load = np.maximum(_parabolic(knots, np.r_[0.0, p0 * a, 0.0], y[inside]), 0.0)
    square = a2 - (x[inside] - centre) ** 2
    load = load * _elastic_over_limited(load, a2, limit)
    result[inside] = np.where(
        square > 0.0,
        np.minimum(load * np.sqrt(np.maximum(square, 0.0)) / np.where(a2 > 0.0, a2, 1.0), limit),
        0.0,
    )
    return result


def _elastic_over_limited(load: Array, a2: Array, limit: float) -> Array | float:
    """Return the elastic load over the load of strips whose pressure is limited to `limit` [Pa].

    `load` is peak pressure times half length a of each strip [N/m], and `a2` is a² [m²]. The function inverts
    `contact.kernels.normal.press.kept` by interpolation, with an error of 1e-5.
    """
    if limit == np.inf:
        return 1.0
    c = np.sin(np.linspace(1e-3, 0.5 * np.pi, 2001))
    share = 2.0 / np.pi * (c * np.sqrt(1.0 - c * c) + np.arcsin(c))
    peak = load / np.sqrt(np.where(a2 > 0.0, a2, 1.0)) / limit
    return np.asarray(1.0 / np.interp(-peak, -share / c, share))


def _parabolic(knots: Array, values: Array, at: Array) -> Array:
    """Return, at each point of `at`, the parabola through the three nearest knots."""
    i = np.clip(np.searchsorted(knots, at) - 1, 0, knots.size - 2)
    closer = at - knots[i] > knots[i + 1] - at
    i = np.clip(i + closer, 1, knots.size - 2)
    u, v, w = knots[i - 1], knots[i], knots[i + 1]
    return (
        values[i - 1] * (at - v) * (at - w) / ((u - v) * (u - w))
        + values[i] * (at - u) * (at - w) / ((v - u) * (v - w))
        + values[i + 1] * (at - u) * (at - v) / ((w - u) * (w - v))
    )


def sketch(strips: Strips) -> str:
    """Return two SVGs: the strips, shaded by their peak pressure, and below them the peak pressure over y."""
    y, dy, x_c, a, p0 = (1e3 * value for value in (strips.y, strips.dy, strips.x_c, strips.a, 1e-9 * strips.p0))
    ends = float((y - 0.5 * dy).min()), float((y + 0.5 * dy).max())
    extent = float((x_c - a).min()), float((x_c + a).max())
    seen = Sketch(ends, extent, ("y [mm]", "x [mm], rolling direction"), "contact patch", width=200.0, equal=True)
    pressure = Sketch(
        ends, (0.0, float(p0.max())), ("y [mm]", "peak pressure [MPa]"), "peak pressure", width=200.0, height=70.0
    )
    seen.bars(y, dy, x_c - a, x_c + a, 0.1 + 0.8 * p0 / max(float(p0.max()), 1e-300))
    for k in np.unique(strips.patch):
        own = strips.patch == k
        seen.area(np.r_[y[own], y[own][::-1]], np.r_[(x_c - a)[own], (x_c + a)[own][::-1]], 0.0)
        pressure.area(np.r_[y[own][0], y[own], y[own][-1]], np.r_[0.0, p0[own], 0.0])
    return f"{seen.svg()}<br/>{pressure.svg()}"
