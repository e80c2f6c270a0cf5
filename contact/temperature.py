"""Flash temperature: what friction heats a surface up to while it crosses the patch (theory.md 8.5).

Heat flows into a body much slower than the body moves (great Péclet number), so each strip is on its own: half of the heat
-q·s enters each body, and a particle that entered at x = a has at x been heated by

    ΔT(x) = 1/(2 β √(πV)) ∫_x^a -q·s/√(ξ - x) dξ,    β = √(λ ρ c),

with the slip velocity s in m/s and the rolling speed V. Elliptic heat, mu p0 √(1 - x²/a²) |s|, has its greatest value,
2.188 mu p0 |s| √a/(2 β √(πV)), at x = -.65 a.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError
from contact.material import Thermal
from contact.solution import Solution

Array = NDArray[np.float64]


def heating(flux: Array, edges: Array, speed: float, thermal: Thermal) -> Array:
    """Temperature rise [K] at the middle of each element of a strip.

    Parameters
    ----------
    flux : ndarray, shape (n,)
        Frictional power per area of each element q|s| [W/m²], from the leading edge on, constant over the element.
    edges : ndarray, shape (n + 1,)
        Where elements begin and end [m], falling.
    speed : float
        Rolling speed [m/s].
    thermal : Thermal
    """
    middle = 0.5 * (edges[:-1] + edges[1:])
    roots = 2.0 * np.sqrt(np.maximum(edges[None, :] - middle[:, None], 0.0))  # ∫dξ/√(ξ - x) from x to each edge
    scale = thermal.heating / math.sqrt(speed)
    return scale * ((roots[:, :-1] - roots[:, 1:]) @ flux)


def flash_temperature(solution: Solution, thermal: Thermal | None = None) -> Array:
    """Temperature rise of the surfaces over the patch [K], shape (n_strips, n_elements), above that of the bodies.

    Parameters
    ----------
    solution : Solution
        Slip velocities scale with its speed.
    thermal : Thermal
        Constants; default steel.

    Raises
    ------
    ContactError
        If the tangential method gives forces alone.
    """
    if not solution.has_fields:
        raise ContactError(f"solution.tangential = {solution.tangential!r} gives no slip, from which to take the heat")
    flux = -(solution.qx * solution.sx + solution.qy * solution.sy) * solution.speed
    n = flux.shape[1]
    grid, strips = np.cos(np.arange(n + 1) * math.pi / max(n, 1)), solution.strips
    equal = getattr(solution, "grid", None) is not None  # elements of one width, also beside the patch
    rise = np.empty_like(flux)
    for i, row in enumerate(flux):
        if equal:
            half = 0.5 * abs(solution.x[i, 0] - solution.x[i, 1]) if n > 1 else strips.a[i]
            edges = np.append(solution.x[i] + half, solution.x[i, -1] - half)
        else:
            edges = strips.x_c[i] + strips.a[i] * grid
        rise[i] = heating(row, edges, solution.speed, thermal or Thermal())
    return rise
