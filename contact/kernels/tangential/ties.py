"""Ties between the strips of a patch: which of them are one shape, with an aspect ratio and effective creepages of its own.

A method that takes an ellipse for a patch needs a patch that resembles one. A neck or a shoulder between a long and a
short lobe makes two shapes, each with its own ellipse. A switch between one shape and two would make forces jump. So two
neighbouring strips have a tie t, 1 within a shape and 0 between separate ones, and strip j is part of the shape of strip i
with the share t t … t of the ties between them (mapped_strip.md 3, step 0).

On an ellipse a² is a concave function of y. With L² the smallest concave function that is nowhere below a²,

    -ln t = ∫ c max(L/max(a, L/2) - 1/d, 0) ds/L

from one strip to the next. All ties are exactly 1 where a² is concave. The way s leads from the middle of one lobe to that of
the other: lobes of which one lies ahead of the other are further apart than lobes side by side. The constants were chosen on
set O and checked on 40 other poses.

A neck of less than half the length counts as half, and so does a gap: what the lobes do to each other depends on how far they
are apart, and where a neck closes, nothing happens to the forces. So neighbouring patches are tied as one patch would be, and
the ways mixed with those within each alone, by a factor that falls to 0 at a gap of half the length of the shorter one.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix
from contact.kernels.rows import Strip
from contact.kernels.tangential.ellipses import end_of_patch

#: c, the share d of L that a must fall below, and the least share that counts.
_RATE, _DENT, _LEAST = 5.0, 0.95, 0.5


@kernel
def _corner(strips, first, last, j):
    """Return y and a² of strip j, and of the edges of the patch for j = first - 1 and j = last."""
    i = min(max(j, first), last - 1)
    y, square = strips[Strip.Y, i], strips[Strip.A, i] ** 2
    return (y, square) if i == j else (y + (j - i) * 0.5 * strips[Strip.DY, i], 0.0)


@kernel
def _lean(strips, i, k):
    """Return by how much longer the way between the middles of strips i and k is than along y."""
    lean = (strips[Strip.XC, k] - strips[Strip.XC, i]) / (strips[Strip.Y, k] - strips[Strip.Y, i]) if k > i else 0.0
    return math.sqrt(1.0 + lean * lean)


@kernel
def _way(a, level, wide):
    """Return the way across a strip with the half length `a`, `wide` as ds. `level` is L²."""
    longest = math.sqrt(level)
    return _RATE * max(1.0 / max(a, _LEAST * longest) - 1.0 / (_DENT * longest), 0.0) * wide


@kernel
def _gap(strips, middle):
    """Return the width of the gap before strip `middle`."""
    wide = 0.5 * (strips[Strip.DY, middle - 1] + strips[Strip.DY, middle])
    return max(strips[Strip.Y, middle] - strips[Strip.Y, middle - 1] - wide, 0.0)


@kernel
def _set_ways(strips, first, middle, last, share):
    """Move the way across each strip, in the row TIE, by `share` to what it is in one patch; return that of the gap.

    The gap is before strip `middle`; there is none before the first.
    """
    k, through = first - 1, 0.0
    y, square = _corner(strips, first, last, k)
    while k < last:  # from corner to corner of the concave function
        end, steepest = k + 1, -math.inf
        for j in range(k + 1, last + 1):
            y_j, square_j = _corner(strips, first, last, j)
            slope = (square_j - square) / (y_j - y)
            if slope > steepest:
                end, steepest = j, slope
        lean = _lean(strips, max(k, first), min(end, last - 1)) if end > k + 1 else 1.0
        for j in range(k + 1, min(end + 1, last)):
            level = square + steepest * (strips[Strip.Y, j] - y) if j < end else 0.0
            way = _way(strips[Strip.A, j], level, lean * strips[Strip.DY, j]) if level > 0.0 else 0.0
            strips[Strip.TIE, j] += share * (way - strips[Strip.TIE, j])
        if middle > first and k < middle <= end:
            level = square + steepest * (0.5 * (strips[Strip.Y, middle - 1] + strips[Strip.Y, middle]) - y)
            through = _way(0.0, level, lean * _gap(strips, middle)) if level > 0.0 else 0.0
        k = end
        y, square = _corner(strips, first, last, k)
    return through


@kernel
def _nearness(strips, first, middle, last):
    """Return how near the patches `first` to `middle` and `middle` to `last` are: 1 where they touch, 0 where they overlap."""
    if not strips[Strip.Y, middle] > strips[Strip.Y, middle - 1]:
        return 0.0  # ellipses of `multi_hertz` may lie in each other
    one, other = 0.0, 0.0
    for i in range(first, last):
        if i < middle:
            one = max(one, strips[Strip.A, i])
        else:
            other = max(other, strips[Strip.A, i])
    gap, shorter = _gap(strips, middle), min(one, other)
    t = 1.0 - gap / shorter if gap < shorter else 0.0
    return t * t * (3.0 - 2.0 * t)


@entry
def tie_strips(strips: Matrix, first: int, last: int) -> None:
    """Set the tie of every strip of one or more patches with the one before it, 0 for the first."""
    for i in range(first, last):
        strips[Strip.TIE, i], strips[Strip.SHARE, i] = 0.0, 1.0
    before, begin = first, first
    while begin < last:
        end = end_of_patch(strips, last, begin)
        _set_ways(strips, begin, begin, end, 1.0)
        near = _nearness(strips, before, begin, end) if begin > first else 0.0
        through = _set_ways(strips, before, begin, end, near) if near > 0.0 else 0.0
        strips[Strip.SHARE, begin] = near * math.exp(-through)  # of the gap, until shares are asked for
        before, begin = begin, end
    across = 0.0
    for i in range(first, last):
        before_it, across = across, strips[Strip.TIE, i]
        way = 0.5 * (before_it + across)
        strips[Strip.TIE, i] = strips[Strip.SHARE, i] * math.exp(-way) if way > 0.0 else strips[Strip.SHARE, i]


@kernel
def end_of_shape(strips, last, i):
    """Return the index after the last of the strips that have the shape of strip i: all ties between them are 1."""
    end = i + 1
    while end < last and strips[Strip.TIE, end] == 1.0:
        end += 1
    return end


@entry
def share_shape(strips: Matrix, first: int, last: int, i: int) -> None:
    """Set the share of every strip from `first` to before `last` in the shape of strip i."""
    share = 1.0
    strips[Strip.SHARE, i] = share
    for j in range(i + 1, last):
        share *= strips[Strip.TIE, j]
        strips[Strip.SHARE, j] = share
    share = 1.0
    for j in range(i, first, -1):
        share *= strips[Strip.TIE, j]
        strips[Strip.SHARE, j - 1] = share


@kernel
def is_read(i, first, last):
    """Return whether the table is read for strip i: every other one from both ends, so that mirror images agree."""
    k = min(i - first, last - 1 - i)
    return k % 2 == 0 or 2 * (k + 1) == last - first  # the two in the middle
