"""Displacement of one point by many strips, or by one strip at many points: lookups of `influence` in loops of vectors.

The caller fills the rows of `pairs` (`Pair`) for every pair of a strip and a point. A first loop, without branches, replaces
them by places in the table; a second one reads the table. This takes half the time of `in_row` pair by pair.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.normal.influence import LN_T_LOW, N_T, N_X, PER_T_STEP, PER_X_STEP, T_STEP, X_MAX
from contact.kernels.rows import Pair

#: Indices of the table lie within this mask. It tells the compiler that they are not negative: none counts from the end.
_MASK = 0xFFFF


@entry
def fill_ln_X(n: int, pairs: Matrix) -> None:
    """Fill Pair.LN_X of `n` strips where the table needs it."""
    for m in range(n):
        pairs[Pair.LN_X, m] = 0.0
        if pairs[Pair.X, m] >= X_MAX:
            pairs[Pair.LN_X, m] = math.log(pairs[Pair.X, m] + 1e-300)  # as in `displacement`


@kernel
def _find_places(n, pairs, own):
    """Replace distances by places in the table: X by the share of the next row, ln X by what lies beyond the table."""
    along, logs, lows, highs, rows = pairs[Pair.X], pairs[Pair.LN_X], pairs[Pair.LOW], pairs[Pair.HIGH], pairs[Pair.ROW]
    for m in range(n):
        X, ln_X, low, high = along[m], logs[m], lows[m], highs[m]
        near = X < X_MAX
        start = LN_T_LOW + (0.0 if near else ln_X)
        at = min(X * PER_X_STEP, N_X - 1.000001)
        row = float(int(at))
        low, high = (low - start) * PER_T_STEP, (high - start) * PER_T_STEP
        sign = 1.0 if m == own else -1.0
        beyond = max(high - (N_T - 1.0), 0.0) + sign * max(low - (N_T - 1.0), 0.0)  # there U is logarithmic
        low = min(low if low > 0.0 else 0.0, N_T - 1.000001)  # written so that NaN does not become an index
        high = min(high if high > 0.0 else 0.0, N_T - 1.000001)
        far = 1.0 / (X * X + 1e-300)  # taken for X = 0 too, where compilers evaluate both ways of a choice
        along[m] = at - row if near else far
        logs[m] = 0.5 * math.pi * T_STEP * beyond
        lows[m], highs[m], rows[m] = low, high, row if near else float(N_X)


@entry
def displacement(plane: Matrix, forces: Numbers, pairs: Matrix, own: int) -> float:
    """Return the displacement by the strips with p0·a/(pi E*) = `forces` [m]; `pairs` is overwritten.

    Pair.X is the distance of the point along x from each strip's middle over a, Pair.LOW and Pair.HIGH the logarithms of the
    distances to its sides over a. Sides lie on the same side of the point, except for strip `own`; -1 if there is none.
    """
    n = forces.size
    _find_places(n, pairs, own)
    along, logs, lows, highs, rows = pairs[Pair.X], pairs[Pair.LN_X], pairs[Pair.LOW], pairs[Pair.HIGH], pairs[Pair.ROW]
    u = 0.0
    for m in range(n):
        share, low, high = along[m], lows[m], highs[m]
        row, i, j = int(rows[m]) & _MASK, int(low) & _MASK, int(high) & _MASK
        low -= i
        high -= j
        one, other = plane[row, i], plane[row + 1, i]
        one += low * (plane[row, i + 1] - one)
        other += low * (plane[row + 1, i + 1] - other)
        left = one + share * (other - one)
        one, other = plane[row, j], plane[row + 1, j]
        one += high * (plane[row, j + 1] - one)
        other += high * (plane[row + 1, j + 1] - other)
        right = one + share * (other - one) + logs[m]
        u += forces[m] * (right + left if m == own else abs(right - left))
    return u


@entry
def go_off_line(plane: Matrix, forces: Numbers, pairs: Matrix, row: Numbers) -> None:
    """Change what a strip displaces on its centre line, in `row`, to what it does at X = Pair.X; `pairs` is overwritten.

    `forces` are a/(pi E*) times the factor of each point. Sides lie as for `displacement`. Below `X_MAX` the table gives only
    what differs from the centre line, as in `influence.off_line`: nothing at X = 0. Beyond, it gives all.
    """
    n = row.size
    _find_places(n, pairs, -1)
    along, logs, lows, highs, rows = pairs[Pair.X], pairs[Pair.LN_X], pairs[Pair.LOW], pairs[Pair.HIGH], pairs[Pair.ROW]
    for m in range(n):
        share, low, high, near = along[m], lows[m], highs[m], 1.0 if rows[m] < N_X else 0.0
        sign = 1.0 if high >= low else -1.0
        place, i, j = int(rows[m]) & _MASK, int(low) & _MASK, int(high) & _MASK
        low -= i
        high -= j
        one, other, line = plane[place, i], plane[place + 1, i], plane[0, i]
        one += low * (plane[place, i + 1] - one)
        other += low * (plane[place + 1, i + 1] - other)
        line += low * (plane[0, i + 1] - line)
        left = one + share * (other - one) - near * line
        one, other, line = plane[place, j], plane[place + 1, j], plane[0, j]
        one += high * (plane[place, j + 1] - one)
        other += high * (plane[place + 1, j + 1] - other)
        line += high * (plane[0, j + 1] - line)
        right = one + share * (other - one) - near * line
        row[m] = near * row[m] + forces[m] * sign * (right - left + (1.0 - near) * logs[m])
