"""Swings of the panels' ends, and their brackets: the last places from which the rule moved an end outwards and inwards.

The place of rest lies between them. Where a pressure peak at the end of a patch is narrower than a few strips, a step of
the end is several times too long. Without a bracket the end swings until it is fixed somewhere.
"""

from contact.core import kernel
from contact.kernels.rows import Vector

#: An end that reverses and moves further than this, over the width, moves half the way.
_TURN = 0.02
#: Width of a bracket over that of the panel below which one of its sides is forgotten: the other unknowns have moved the
#: place of rest out of it.
_LEAST = 1e-3
#: A step out of the bracket goes here instead, from the outer side over its width. Too wide a panel does less harm.
_SHARE = 0.35
#: Place [m] that stands for a side which is not known. An infinite one could become NaN, a trap.
_FAR = 1e9


@kernel
def damp_turns(n, n_panels, panels, vectors):
    """Halve the moves of ends that reverse."""
    for p in range(n_panels):
        least = _TURN * (panels[2 * p + 1] - panels[2 * p])
        for side in range(2):
            end = p * n + side * (n - 1)
            move = vectors[Vector.R, end]
            if vectors[Vector.STEP, end] * move < 0.0 and abs(move) > least:
                vectors[Vector.R, end] = 0.5 * move


@kernel
def note_sides(n, n_panels, panels, vectors, afresh):
    """Note the place of every end as a side of its bracket, by the sign of its move Vector.R. `afresh` empties it first."""
    for p in range(n_panels):
        for side in range(2):
            end, outwards = p * n + side * (n - 1), 2.0 * side - 1.0
            if afresh:
                vectors[Vector.INSIDE, end], vectors[Vector.OUTSIDE, end] = -outwards * _FAR, outwards * _FAR
            row = Vector.INSIDE if outwards * vectors[Vector.R, end] > 0.0 else Vector.OUTSIDE
            vectors[row, end] = panels[2 * p + side]


@kernel
def keep_between(n, n_panels, panels, vectors):
    """Change the steps Vector.STEP of the ends that leave their brackets."""
    for p in range(n_panels):
        width = panels[2 * p + 1] - panels[2 * p]
        for side in range(2):
            end, outwards, at = p * n + side * (n - 1), 2.0 * side - 1.0, panels[2 * p + side]
            inside, outside = vectors[Vector.INSIDE, end], vectors[Vector.OUTSIDE, end]
            between = outwards * (outside - inside)
            if between < _LEAST * width:
                if at == inside:
                    vectors[Vector.OUTSIDE, end] = outwards * _FAR
                else:
                    vectors[Vector.INSIDE, end] = -outwards * _FAR
            elif between < 0.5 * _FAR:
                new = outwards * (at + vectors[Vector.STEP, end])
                if not outwards * inside < new < outwards * outside:
                    vectors[Vector.STEP, end] = outside + _SHARE * (inside - outside) - at
