"""Root of a rising function of one variable that may be flat or jump, by secants that are kept inside a bracket.

The function is not an argument. `begin` sets the first point ``root.x``. The caller evaluates the function there and passes
the value to `advance`, which sets the next point, as long as this returns True.
"""

from contact.core import entry
from contact.kernels.arrays import Root

#: A step grows at most by this factor.
_GROWTH = 4.0


@entry
def begin(root: Root, start: float, slope: float, first: float, last: float) -> None:
    """Start a search at `start` [x] with the expected `slope` > 0 in the range from `first` to `last`."""
    root.x, root.before, root.value, root.slope = start, start, 0.0, slope
    root.first, root.last, root.low, root.high = first, last, first, last
    root.longest, root.evaluations, root.beyond = 0.0, 0, 0


@entry
def advance(root: Root, value: float, shortest: float, most: int) -> bool:
    """Set the next point from the `value` at ``root.x``. Return False at the end of the search.

    It ends at the value 0, at a bracket of the length `shortest` (the function jumps), after `most` evaluations, and with
    ``root.beyond`` = 1 if the function does not change its sign up to an end of the range.
    """
    root.evaluations += 1
    if root.evaluations == 1:
        root.longest = 2.0 * abs(value) / root.slope
    else:
        moved = root.x - root.before
        steeper = (value - root.value) / moved
        # on a flat piece go further; the bracket keeps the search safe
        root.slope = steeper if steeper > 0.0 else root.slope / _GROWTH
        root.longest = max(_GROWTH * abs(moved), root.longest)
    root.value = value
    if root.evaluations > 1 and ((root.x <= root.first and value > 0.0) or (root.x >= root.last and value < 0.0)):
        root.beyond = 1
        return False
    if value == 0.0 or root.evaluations >= most:
        return False
    if value < 0.0:
        root.low = root.x
    else:
        root.high = root.x
    if root.high - root.low <= shortest:
        return False
    ahead = root.x - min(max(value / root.slope, -root.longest), root.longest)
    if not root.low < ahead < root.high:
        known = root.low > root.first and root.high < root.last
        ahead = 0.5 * (root.low + root.high) if known else min(max(ahead, root.first), root.last)
    root.before, root.x = root.x, ahead
    return ahead != root.before
