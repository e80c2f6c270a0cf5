"""`rising_root`: the search of `contact.kernels.root` for a Python function."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from contact.kernels.records import ROOT
from contact.kernels.root import advance, begin


class Root(NamedTuple):
    """The last point `x` and the `residual` there. `beyond`: the residual does not change its sign up to that end."""

    x: float
    residual: float
    beyond: bool


def rising_root(
    residual: Callable[[float], float],
    start: float,
    slope: float,
    ends: tuple[float, float],
    *,
    shortest: float,
    most: int = 60,
) -> Root:
    """Return the root by secants that are kept inside a bracket.

    Parameters
    ----------
    residual : callable
        A rising function; it returns 0.0 where it is small enough.
    start, slope : float
        Where the search starts, and the slope expected there, positive.
    ends : (float, float)
        Ends of the range; they are evaluated only if the search gets there.
    shortest : float
        A bracket shorter than this ends the search: the function jumps.
    most : int
        Largest number of evaluations.
    """
    root = np.zeros(1, ROOT)[0]
    begin(root, start, slope, *ends)
    while advance(root, float(residual(float(root.x))), shortest, most):
        pass
    return Root(float(root.x), float(root.value), bool(root.beyond))
