"""Root of a rising function of one variable that may be flat or jump."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

#: A step grows at most by this factor.
_GROWTH = 4.0


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
    low, high = ends
    x, value = start, residual(start)
    longest = 2.0 * abs(value) / slope
    for _ in range(most - 1):
        if value == 0.0:
            break
        low, high = (x, high) if value < 0.0 else (low, x)
        if high - low <= shortest:
            break
        ahead = x - min(max(value / slope, -longest), longest)
        if not low < ahead < high:
            known = low > ends[0] and high < ends[1]
            ahead = 0.5 * (low + high) if known else min(max(ahead, ends[0]), ends[1])
        other = residual(ahead)
        steeper = (other - value) / (ahead - x)
        # on a flat piece go further; the bracket keeps the search safe
        slope = steeper if steeper > 0.0 else slope / _GROWTH
        longest = max(_GROWTH * abs(ahead - x), longest)
        x, value = ahead, other
        if (x <= ends[0] and value > 0.0) or (x >= ends[1] and value < 0.0):
            return Root(x, value, beyond=True)
    return Root(x, value, beyond=False)
