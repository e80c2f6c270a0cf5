"""Flash temperature: temperature rise of a surface by friction while it crosses the patch (theory.md 8.5).

Heat flows into a body much more slowly than the body moves (large Péclet number). Strips therefore do not exchange heat.
Half of the heat -q·s enters each body. A particle that entered the patch at x = a is hotter at x by

    ΔT(x) = 1/(2 β √(πV)) ∫_x^a -q·s/√(ξ - x) dξ,    β = √(λ ρ c),

with the slip velocity s in m/s and the rolling speed V. For elliptic heat, mu p0 √(1 - x²/a²) |s|, the maximum is
2.188 mu p0 |s| √a/(2 β √(πV)) at x = -.65 a.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.inputs.material import Thermal

if TYPE_CHECKING:
    from contact.results import Solution


def heating(flux: Array, edges: Array, speed: float, thermal: Thermal) -> Array:
    """Return the temperature rise [K] at the centre of each element of a strip, shape (n,).

    Parameters
    ----------
    flux : ndarray, shape (n,)
        Frictional power per area q|s| [W/m²] of each element, starting at the leading edge. Constant over an element.
    edges : ndarray, shape (n + 1,)
        x of the element edges [m], decreasing.
    speed : float
        Rolling speed [m/s].
    thermal : Thermal
        Thermal constants of the bodies.
    """
    middle = 0.5 * (edges[:-1] + edges[1:])
    roots = 2.0 * np.sqrt(np.maximum(edges[None, :] - middle[:, None], 0.0))  # ∫dξ/√(ξ - x) from x to each edge
    scale = thermal.heating / math.sqrt(speed)
    return scale * ((roots[:, :-1] - roots[:, 1:]) @ flux)


def flash_temperature(solution: Solution, thermal: Thermal | None = None) -> Array:
    """Return the temperature rise of the surfaces over the patch [K], shape (n_strips, n_elements).

    The rise is relative to the temperature of the bodies.

    Parameters
    ----------
    solution : Solution
        Slip velocities scale with its speed.
    thermal : Thermal
        Thermal constants; default steel.

    Raises
    ------
    ContactError
        If the tangential method gives forces only.
    """
    if not solution.has_fields:
        raise ContactError(f"solution.tangential = {solution.tangential!r} gives no slip; the heat needs it")
    flux = -(solution.qx * solution.sx + solution.qy * solution.sy) * solution.speed
    n = flux.shape[1]
    grid, strips = np.cos(np.arange(n + 1) * math.pi / max(n, 1)), solution.strips
    equal = getattr(solution, "grid", None) is not None  # GridSolution: elements of equal width, also outside the patch
    rise = np.empty_like(flux)
    for i, row in enumerate(flux):
        if equal:
            half = 0.5 * abs(solution.x[i, 0] - solution.x[i, 1]) if n > 1 else strips.a[i]
            edges = np.append(solution.x[i] + half, solution.x[i, -1] - half)
        else:
            edges = strips.x_c[i] + strips.a[i] * grid
        rise[i] = heating(row, edges, solution.speed, thermal or Thermal())
    return rise
