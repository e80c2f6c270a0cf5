"""Fixed points of a map without derivatives, as an iterated coupling needs them in each step."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from contact.arrays import Array

_FIRST_MOVE = 0.3  # share of the first change that is applied, because a steep map may be nonlinear over a full change


def fixed_point(
    function: Callable[[Array], Array], start: Array, scale: Array, tolerance: float, most: int
) -> tuple[Array, int]:
    """Solve x = function(x) by Anderson's acceleration, which does not need a contraction.

    A linear map is fitted to the values so far, and its fixed point is evaluated next. A linear map of rank r is solved in
    r + 1 evaluations, however steep it is. The plain iteration diverges if a slope exceeds one. (D. G. Anderson, J. ACM 12,
    1965; in partitioned simulation known as interface quasi-Newton, IQN-ILS.)

    Parameters
    ----------
    function : callable
        The map, from and to arrays of shape (n,).
    start : ndarray, shape (n,)
        First point.
    scale : ndarray, shape (n,)
        Positive scale of each number.
    tolerance : float
        Stop if no number changes by more than this, in units of `scale`.
    most : int
        Largest number of evaluations.

    Returns
    -------
    x : ndarray, shape (n,)
        The value of `function` at the last point.
    evaluations : int
        Number of evaluations; `most` + 1 if the iteration did not converge.
    """
    x = start / scale
    points: list[Array] = []
    changes: list[Array] = []
    for evaluation in range(1, most + 1):
        image = function(x * scale) / scale
        change = image - x
        if np.abs(change).max() <= tolerance:
            return image * scale, evaluation
        if changes:
            d_change = np.stack([change - c for c in changes], axis=1)
            d_image = np.stack([image - p - c for p, c in zip(points, changes, strict=True)], axis=1)
            weights = np.linalg.lstsq(d_change, change, rcond=1e-10)[0]
            following = image - d_image @ weights
        else:
            following = x + _FIRST_MOVE * change
        points.append(x)
        changes.append(change)
        x = following
    return image * scale, most + 1
