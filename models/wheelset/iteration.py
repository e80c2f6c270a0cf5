"""Fixed points of a map that may only be evaluated: what an iterated coupling has to find in each step."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FIRST_MOVE = 0.3  # of the change: on a steep map a full move ends where the slope is another one


def fixed_point(
    function: Callable[[Array], Array], start: Array, scale: Array, tolerance: float, most: int
) -> tuple[Array, int]:
    """Solve x = function(x) by Anderson's acceleration, which needs no contraction.

    From the values seen so far a linear map is fitted, and its fixed point is tried next; on a linear map of rank r it
    is found in r + 1 evaluations, however steep the map is. The plain iteration diverges where a slope exceeds one.
    (D. G. Anderson, J. ACM 12, 1965; in partitioned simulation known as interface quasi-Newton, IQN-ILS.)

    Parameters
    ----------
    function : callable
    start : ndarray, shape (n,)
    scale : ndarray, shape (n,)
        Unit of each number, positive.
    tolerance : float
        Largest change by `function`, in units of `scale`, at which x counts as found.
    most : int
        Evaluations at most.

    Returns
    -------
    x : ndarray, shape (n,)
        The value of `function` at the last point.
    evaluations : int
        `most` + 1 if it was not found.
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
