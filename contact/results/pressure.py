"""Pressure of a solution between its strips, and a sketch of it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, broadcast, require_numbers
from contact.kernels.arrays import PatchStrips
from contact.kernels.stress.load import add_pressures
from contact.view.notebook import Sketch

if TYPE_CHECKING:
    from contact.results.solution import Solution, Strips


def pressure_at(solution: Solution, x: ArrayLike, y: ArrayLike) -> Array:
    """Return the contact pressure [Pa] at points of the contact plane: the work of `Solution.pressure`."""
    x, y = broadcast({"x": require_numbers("x", x), "y": require_numbers("y", y)})
    result = np.zeros(x.size)
    for k, (low, high) in enumerate(solution.patch_edges):
        strips = strips_of(solution, k)
        add_pressures(strips, low, high, limit_of(solution), x.ravel(), y.ravel(), result)
    return result.reshape(x.shape)


def strips_of(solution: Solution, k: int) -> PatchStrips:
    """Return the strips of patch `k` for kernels."""
    inside, strips = solution.strips.patch == k, solution.strips
    return PatchStrips(strips.y[inside], strips.x_c[inside], strips.a[inside], strips.p0[inside])


def limit_of(solution: Solution) -> float:
    """Return the limit of the pressure [Pa] for kernels, 0.0 for none."""
    limit = solution.material.pressure_limit
    return limit if limit < math.inf else 0.0


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
        inside = strips.patch == k
        seen.area(np.r_[y[inside], y[inside][::-1]], np.r_[(x_c - a)[inside], (x_c + a)[inside][::-1]], 0.0)
        pressure.area(np.r_[y[inside][0], y[inside], y[inside][-1]], np.r_[0.0, p0[inside], 0.0])
    return f"{seen.svg()}<br/>{pressure.svg()}"
