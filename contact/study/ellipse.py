"""Separations with a given Hertz ellipse."""

from __future__ import annotations

import math

from contact.inputs.material import STEEL, Material
from contact.inputs.separation import Separation
from contact.theory.hertz import hertz


def ellipse(aspect: float, c: float, load: float, material: Material = STEEL) -> Separation:
    """Return the separation whose Hertz ellipse under `load` [N] has a/b = `aspect` and √(ab) = `c` [m].

    It is for a/b from 1e-2 to 1e2. The ratio of curvatures is found by bisection.
    """
    low, high = -12.0, 12.0  # ln(B/A): a/b increases with it
    for _ in range(100):
        u = 0.5 * (low + high)
        shape = hertz(1.0, math.exp(u), load=load, material=material)
        low, high = (u, high) if shape.a < aspect * shape.b else (low, u)
    # lengths scale with the cube root of N over curvature
    A = (math.sqrt(shape.a * shape.b) / c) ** 3
    return Separation.hertzian(A, A * math.exp(u))
