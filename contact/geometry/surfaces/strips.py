"""The gap of a patch as strips: parabolas along x, as the fast methods need them, and how well they fit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact.halfspace.gap import Gap
from contact.separation import Separation

Array = NDArray[np.float64]

#: A parabola is fitted where the gap of its strip is below the approach, and at least up to this share of the approach
#: above its least value.
_LEAST_DEPTH = 0.15
_FEWEST = 5  # points of a fit
_FLATTEST, _SHARPEST = 0.02, 500.0  # [1/m] range of A: a radius of 25 m, and one of 1 mm
_ROUNDS = 3


def strips(gap: Gap, approach: float, tilt: float = 0.0) -> tuple[Separation, float]:
    """Return the separation of a gap, and the error of its parabolas.

    Each row h(x) of the gap becomes A·(x - x_c)² + g, by least squares over the part of the row that overlaps at the
    approach. So A, x_c and g are those of both surfaces as they are at the pose: a flat makes A small, a ramp moves x_c.

    Parameters
    ----------
    gap : Gap
        It should reach beyond the overlap on all sides.
    approach : float
        [m], from the least gap.
    tilt : float
        As for `contact.Separation`.

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
    inside = h <= (least + window)[:, None]
    inside |= np.argsort(np.argsort(h, axis=1), axis=1) < _FEWEST
    scale = float(np.ptp(x))
    for _ in range(_ROUNDS):
        c = _parabolas(x / scale, h, inside)
        A = np.clip(c[:, 2] / scale**2, _FLATTEST, _SHARPEST)
        x_c = np.clip(-0.5 * c[:, 1] / (scale * A), x[0], x[-1])
        g = ((h - A[:, None] * (x - x_c[:, None]) ** 2) * inside).sum(axis=1) / inside.sum(axis=1)
        lowest = g.min()
        reach = np.sqrt(np.maximum(approach - (g - lowest), _LEAST_DEPTH * approach) / A)
        near = np.abs(x - x_c[:, None]) <= reach[:, None]
        near |= np.argsort(np.argsort(np.abs(x - x_c[:, None]), axis=1), axis=1) < _FEWEST
        if (near == inside).all():
            break
        inside = near
    fitted = g[:, None] + A[:, None] * (x - x_c[:, None]) ** 2
    depth = np.maximum(approach - h, 0.0)
    weight = float((depth > 0.0).sum() and depth.sum())
    error = float(np.sqrt((depth * (fitted - h) ** 2).sum() / weight)) / approach if weight > 0.0 else 0.0
    return Separation(gap.y, g, A, x_c, tilt), error


def _parabolas(x: Array, h: Array, inside: NDArray[np.bool_]) -> Array:
    """Return the coefficients c0 + c1 x + c2 x² of each row of h by least squares over `inside`, shape (ny, 3)."""
    powers = np.stack((np.ones_like(x), x, x * x))
    weight = inside.astype(np.float64)
    matrix = np.einsum("yx,ix,jx->yij", weight, powers, powers)
    right = np.einsum("yx,yx,ix->yi", weight, h, powers)
    return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0])
