"""The largest pressure between strips: strips around a sharp peak are divided, and the gap closes at every part.

A pressure peaks where the curvature of a profile jumps, over less than the width of a strip. On an ellipse of n
cosine-spaced strips every pressure is 1 - cos(pi/n) above the mean of its neighbours. Where this excess is much larger, the
strip at the peak and its neighbours are divided into thirds. All other strips keep their pressures (strip_halfspace.md 8).
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.cubic import locate
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.influence import at_centre
from contact.kernels.rows import Sample, Strip, Vector

#: Excess over that of an ellipse from which on a peak counts as sharp, and from which on only its parts count.
_SHARP, _SHARPEST = 1.5, 2.5
#: Share of the largest strip pressure from which on a peak counts.
_HIGH = 0.8
#: Parts of a strip.
_PARTS = 3
#: Least strips of a panel: the parts need room in the rows of `vectors`.
_FEWEST = 8


@kernel
def _influence(at, y, half, a, centre):
    """Return the displacement at y = `at` by unit pressure on a strip in line, times pi E* [m]."""
    away = abs(at - y)
    far, near = math.log((away + half) / a), math.log(max(abs(away - half), 1e-12 * half) / a)
    u = at_centre(centre, near)
    return a * (at_centre(centre, far) + (u if away < half else -u))


@kernel
def _mean_gap(sep, slopes, low, high, k):
    """Return the mean gap from `low` to `high` [m]. Sample `k` is where the search for `low` starts."""
    y, g, size = sep.y, sep.g, sep.y.size
    k = locate(y, size, low, k)
    h = y[k + 1] - y[k]
    total = -cubic.integral(h, g[k], slopes[k], g[k + 1], slopes[k + 1], (low - y[k]) / h)
    while k < size - 2 and y[k + 1] < high:
        total += h * (0.5 * (g[k] + g[k + 1]) + h / 12.0 * (slopes[k] - slopes[k + 1]))
        k += 1
        h = y[k + 1] - y[k]
    total += cubic.integral(h, g[k], slopes[k], g[k + 1], slopes[k + 1], (high - y[k]) / h)
    return total / (high - low)


@kernel
def _along(row, i, at, strips):
    """Return a number at `at` from those of strip i and its neighbour on that side, linear in y."""
    k = i if at < strips[Strip.Y, i] else i + 1
    t = (at - strips[Strip.Y, k - 1]) / (strips[Strip.Y, k] - strips[Strip.Y, k - 1])
    return (1.0 - t) * row[k - 1] + t * row[k]


@kernel
def _top_of_parts(sep, i, n, unit, skewed, approach, own):
    """Return the largest pressure of the parts of strip i and its neighbours, which lie in the same patch [Pa].

    The gap closes at the `approach`. If strips are `skewed`, the gap that their pressures leave, with the influence of strips
    in line, is left at the parts too.
    """
    strips, vectors, lu, centre = own.strips, own.space.vectors, own.space.lu, own.tables.centre
    slopes, left, squares = own.space.grid[Sample.GAP_SLOPE], vectors[Vector.U], vectors[Vector.R_OLD]
    at, pressures, unused = vectors[Vector.R], vectors[Vector.Q1], vectors[Vector.Q2]
    patch = strips[Strip.PATCH]
    before = i - 1 if i > 1 and patch[i - 2] == patch[i] else i  # a strip with two neighbours in the patch
    after = i + 1 if i < n - 2 and patch[i + 2] == patch[i] else i
    m = 3 * _PARTS
    for s in range(max(i - 2, 0), min(i + 3, n)):
        y, half = strips[Strip.Y, s], 0.5 * strips[Strip.DY, s]
        squares[s] = strips[Strip.A, s] ** 2
        left[s] = _mean_gap(sep, slopes, y - half, y + half, 0) if skewed else approach
        for j in range(n if skewed else 0):
            scale = unit * strips[Strip.P0, j]
            left[s] += scale * _influence(y, strips[Strip.Y, j], 0.5 * strips[Strip.DY, j], strips[Strip.A, j], centre)
    for r in range(m):
        s = i - 1 + r // _PARTS
        half = 0.5 * strips[Strip.DY, s] / _PARTS
        at[r] = strips[Strip.Y, s] + (2 * (r % _PARTS) + 1 - _PARTS) * half
        near = min(max(s, before), after)
        pressures[r] = _along(left, near, at[r], strips) - _mean_gap(sep, slopes, at[r] - half, at[r] + half, 0)
        unused[r] = 0.0
        for j in range(n):
            if j < i - 1 or j > i + 1:
                u = _influence(at[r], strips[Strip.Y, j], 0.5 * strips[Strip.DY, j], strips[Strip.A, j], centre)
                pressures[r] -= unit * strips[Strip.P0, j] * u
    for c in range(m):
        s = i - 1 + c // _PARTS
        half, near = 0.5 * strips[Strip.DY, s] / _PARTS, min(max(s, before), after)
        a = math.sqrt(max(_along(squares, near, at[c], strips), 0.1 * squares[s]))
        for r in range(m):
            lu[r, c] = unit * _influence(at[r], at[c], half, a, centre)
    eliminate(lu, m, pressures, unused)
    top = 0.0
    for r in range(m):
        top = max(top, pressures[r])
    return top


@kernel
def peak_between_strips(sep, n, unit, skewed, approach, own):
    """Return the largest pressure found between `n` strips where a peak is sharp [Pa]; 0 if none is.

    If strips are `skewed`, they do not lie in line.
    """
    strips, panel = own.strips, own.rule.cosines.size - 1
    if panel < _FEWEST:
        return 0.0
    p, patch = strips[Strip.P0], strips[Strip.PATCH]
    of_ellipse, top, largest = 1.0 - math.cos(math.pi / panel), 0.0, 0.0
    for i in range(n):
        largest = max(largest, p[i])
    for i in range(1, n - 1):
        within = patch[i - 1] == patch[i + 1] and p[i - 1] <= p[i] >= p[i + 1]
        excess = 1.0 - 0.5 * (p[i - 1] + p[i + 1]) / p[i] if within else 0.0
        share = min(max((excess / of_ellipse - _SHARP) / (_SHARPEST - _SHARP), 0.0), 1.0)
        if share > 0.0 and p[i] > _HIGH * largest:
            found = _top_of_parts(sep, i, n, unit, skewed, approach, own)
            top = max(top, p[i] + share * share * (3.0 - 2.0 * share) * (found - p[i]))
    return top
