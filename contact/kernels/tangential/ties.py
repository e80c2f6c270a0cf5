"""Ties between the strips of a patch: which of them are one shape, with an aspect ratio and effective creepages of its own.

A method that takes an ellipse for a patch needs a patch that resembles one. A neck or a shoulder between a long and a
short lobe makes two shapes, each with its own ellipse. A switch between one shape and two would make forces jump. So two
neighbouring strips have a tie t, 1 within a shape and 0 between separate ones, and strip j is part of the shape of strip i
with the share t t … t of the ties between them (mapped_strip.md 3, step 0).

On an ellipse a² is a concave function of y. With L² the smallest concave function that is nowhere below a²,

    -ln t = ∫ c max(L/a - 1/d, 0) dy/L

from one strip to the next. All ties are exactly 1 where a² is concave. The constants were chosen on set O and
checked on 40 other poses.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix
from contact.kernels.rows import Strip

#: c, and the share d of L that a must fall below.
_RATE, _DENT = 5.0, 0.95
#: Half length [m] in place of 0, of which the reciprocal is a trap.
_LEAST = 1e-12


@kernel
def _corner(strips, first, last, j):
    """Return y and a² of strip j, and of the edges of the patch for j = first - 1 and j = last."""
    i = min(max(j, first), last - 1)
    y, square = strips[Strip.Y, i], strips[Strip.A, i] ** 2
    return (y, square) if i == j else (y + (j - i) * 0.5 * strips[Strip.DY, i], 0.0)


@entry
def tie_strips(strips: Matrix, first: int, last: int) -> None:
    """Set the tie of every strip of a patch with the one before it."""
    k = first - 1
    y, square = _corner(strips, first, last, k)
    while k < last:  # from corner to corner of the concave function
        end, steepest = k + 1, -math.inf
        for j in range(k + 1, last + 1):
            y_j, square_j = _corner(strips, first, last, j)
            slope = (square_j - square) / (y_j - y)
            if slope > steepest:
                end, steepest = j, slope
        for j in range(k + 1, min(end + 1, last)):
            level = square + steepest * (strips[Strip.Y, j] - y) if j < end else 0.0
            strips[Strip.TIE, j] = 0.0
            if level > 0.0:
                dent = 1.0 / max(strips[Strip.A, j], _LEAST) - 1.0 / (_DENT * math.sqrt(level))
                strips[Strip.TIE, j] = _RATE * max(dent, 0.0) * strips[Strip.DY, j]
        k = end
        y, square = _corner(strips, first, last, k)
    before = 0.0
    for i in range(first, last):
        here = strips[Strip.TIE, i]
        way = 0.5 * (before + here)
        strips[Strip.TIE, i] = math.exp(-way) if way > 0.0 else 1.0
        before = here


@kernel
def end_of_shape(strips, last, i):
    """Return the index after the last of the strips that have the shape of strip i: all ties between them are 1."""
    end = i + 1
    while end < last and strips[Strip.TIE, end] == 1.0:
        end += 1
    return end


@entry
def share_shape(strips: Matrix, first: int, last: int, i: int) -> None:
    """Set the share of every strip of a patch in the shape of strip i."""
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
