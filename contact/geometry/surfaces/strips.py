"""The gap of a patch as strips: parabolas along x, as the fast methods need them, and how well they fit."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from contact.halfspace.gap import Gap
from contact.separation import Separation

Array = NDArray[np.float64]

#: A parabola is fitted where the gap of its strip is below the approach, and at least up to this share of the approach
#: above its least value.
_LEAST_DEPTH = 0.15
_FLATTEST, _SHARPEST = 0.02, 500.0  # [1/m] range of A: a radius of 25 m, and one of 1 mm
#: A faint weight around the lowest point of a row, and its width over that of the grid, so that few points suffice.
_FAINT, _WIDE = 1e-3, 0.2


def strips(gap: Gap, approach: float, wanted: float) -> tuple[Separation, float]:
    """Return the separation of a gap, and the error of its parabolas.

    Each row h(x) of the gap becomes A·(x - x_c)² + g, by least squares over the part of the row that overlaps at the
    approach, weighted with the depth. So A, x_c and g are those of both surfaces as they are at the pose: a flat makes A
    small, a ramp moves x_c.

    Parameters
    ----------
    gap : Gap
        It should reach beyond the overlap on all sides.
    approach, wanted : float
        Approach from the least gap, and the approach for which the separation is meant [m]. They differ if the least gap was
        sampled at other points; g is moved by the difference.

    Returns
    -------
    separation : Separation
    error : float
        Root mean square of h minus the parabolas over the overlap, weighted with the depth, over the approach [-]. 0 for
        parabolas. Where a strip touches at two places, as on both ends of a flat, it is large, and strips cannot describe
        the patch.
    """
    h, x = gap.h, gap.x
    least = h.min(axis=1)
    window = np.maximum(approach - least, _LEAST_DEPTH * approach)
    weight = np.maximum((least + window)[:, None] - h, 0.0)
    weight += (
        _FAINT * window[:, None] * np.exp(-((x - x[np.argmin(h, axis=1)][:, None]) ** 2) / (_WIDE * np.ptp(x)) ** 2)
    )
    scale = float(np.ptp(x))
    c = _parabolas(x / scale, h, weight)
    A = np.clip(c[:, 2] / scale**2, _FLATTEST, _SHARPEST)
    x_c = np.clip(-0.5 * c[:, 1] / (scale * A), x[0], x[-1])
    parabola = A[:, None] * (x - x_c[:, None]) ** 2
    g = ((h - parabola) * weight).sum(axis=1) / weight.sum(axis=1)
    depth = np.maximum(approach - h, 0.0)
    total = float(depth.sum())
    square = (depth * (g[:, None] + parabola - h) ** 2).sum()
    return Separation(gap.y, g + (wanted - approach), A, x_c), math.sqrt(
        float(square) / total
    ) / approach if total > 0.0 else 0.0


def _parabolas(x: Array, h: Array, weight: Array) -> Array:
    """Return the coefficients c0 + c1 x + c2 x² of each row of h by weighted least squares, shape (ny, 3)."""
    powers = np.stack((np.ones_like(x), x, x * x))
    matrix = np.einsum("yx,ix,jx->yij", weight, powers, powers)
    right = np.einsum("yx,yx,ix->yi", weight, h, powers)
    return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0])
