"""The largest pressure between strips: strips around a sharp peak are divided, and the gap closes at every part.

A pressure peaks where the curvature of a profile jumps, over less than the width of a strip. Where pressures bend more over
three strips than those of an ellipse, these strips are divided into thirds. All other strips keep their pressures
(strip_halfspace.md 8).
"""

import math

from contact.core import kernel
from contact.kernels import cubic
from contact.kernels.cubic import locate
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.influence import at_centre
from contact.kernels.rows import Sample, Strip, Vector

#: Bend of the pressure over three strips, over that of an ellipse, from which on a peak counts as sharp, and from which on
#: only its parts count.
_SHARP, _SHARPEST = 1.25, 1.75
#: Share of the largest strip pressure from which on a peak counts.
_HIGH = 0.8
#: Difference of two neighbours' pressures, over the larger one, below which the parts of both count.
_ALIKE = 0.15
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
def _by_strip(at, j, unit, strips, centre):
    """Return the displacement at y = `at` by strip j in line [m]."""
    p = unit * strips[Strip.P0, j]
    return p * _influence(at, strips[Strip.Y, j], 0.5 * strips[Strip.DY, j], strips[Strip.A, j], centre)


@kernel
def _mean_gap(sep, slopes, low, high):
    """Return the mean gap from `low` to `high` [m]."""
    y, g, size = sep.y, sep.g, sep.y.size
    k = locate(y, size, low, 0)
    h = y[k + 1] - y[k]
    total = -cubic.integral(h, g[k], slopes[k], g[k + 1], slopes[k + 1], (low - y[k]) / h)
    while k < size - 2 and y[k + 1] < high:
        total += h * (0.5 * (g[k] + g[k + 1]) + h / 12.0 * (slopes[k] - slopes[k + 1]))
        k += 1
        h = y[k + 1] - y[k]
    total += cubic.integral(h, g[k], slopes[k], g[k + 1], slopes[k + 1], (high - y[k]) / h)
    return total / (high - low)


@kernel
def _parabola(i, at, row, strips):
    """Return at y = `at` the parabola through the numbers `row` of strip i and its neighbours."""
    y0, y1, y2 = strips[Strip.Y, i - 1], strips[Strip.Y, i], strips[Strip.Y, i + 1]
    d0, d1 = (row[i] - row[i - 1]) / (y1 - y0), (row[i + 1] - row[i]) / (y2 - y1)
    return row[i] + (at - y1) * (d0 + (d1 - d0) / (y2 - y0) * (at - y0))


@kernel
def _half_length(i, at, strips):
    """Return the half length at y = `at`: a² is linear between strip i and its neighbour on that side [m]."""
    k = i if at < strips[Strip.Y, i] else i + 1
    t = (at - strips[Strip.Y, k - 1]) / (strips[Strip.Y, k] - strips[Strip.Y, k - 1])
    square = (1.0 - t) * strips[Strip.A, k - 1] ** 2 + t * strips[Strip.A, k] ** 2
    return math.sqrt(max(square, 0.1 * min(strips[Strip.A, k - 1], strips[Strip.A, k]) ** 2))


@kernel
def _top_of_parts(sep, i, n, unit, workspace):
    """Return the largest pressure of the parts of strip i and its neighbours, which lie in the same patch [Pa].

    What closes the gap at these strips beside the pressure of the nearest ones, approach and all distant strips, is
    smooth: a parabola. The outer parts make up for the pressure of the strips beside them, which has a step there. They do
    not count.
    """
    strips, vectors, lu, centre = workspace.strips, workspace.space.vectors, workspace.space.lu, workspace.tables.centre
    slopes, rest, patch = workspace.space.grid[Sample.GAP_SLOPE], vectors[Vector.U], strips[Strip.PATCH]
    at, pressures, unused, logs = vectors[Vector.R], vectors[Vector.Q1], vectors[Vector.Q2], vectors[Vector.R_OLD]
    nearest, beyond = max(i - 2, 0), min(i + 3, n)
    for s in range(i - 1, i + 2):
        y, half = strips[Strip.Y, s], 0.5 * strips[Strip.DY, s]
        rest[s] = _mean_gap(sep, slopes, y - half, y + half)
        for j in range(nearest, beyond):
            rest[s] += _by_strip(y, j, unit, strips, centre)
    m = 3 * _PARTS
    for r in range(m):
        s = i - 1 + r // _PARTS
        half = 0.5 * strips[Strip.DY, s] / _PARTS
        at[r] = strips[Strip.Y, s] + (2 * (r % _PARTS) + 1 - _PARTS) * half
        pressures[r] = _parabola(i, at[r], rest, strips) - _mean_gap(sep, slopes, at[r] - half, at[r] + half)
        unused[r] = 0.0
        for j in range(nearest, beyond):
            if j < i - 1 or j > i + 1:
                pressures[r] -= _by_strip(at[r], j, unit, strips, centre)
    before = i - 1 if i > 1 and patch[i - 2] == patch[i] else i  # strips with two neighbours in the patch
    after = i + 1 if i < n - 2 and patch[i + 2] == patch[i] else i
    side = strips[Strip.Y, i - 1] - 0.5 * strips[Strip.DY, i - 1]
    for r in range(m):
        logs[r] = math.log(abs(at[r] - side))
    for c in range(m):  # parts lie side by side: the upper side of one is the lower side of the next
        s = i - 1 + c // _PARTS
        side, a = at[c] + 0.5 * strips[Strip.DY, s] / _PARTS, _half_length(min(max(s, before), after), at[c], strips)
        ln_a = math.log(a)
        for r in range(m):
            low = at_centre(centre, logs[r] - ln_a)
            logs[r] = math.log(abs(at[r] - side))
            high = at_centre(centre, logs[r] - ln_a)
            lu[c, r] = unit * a * (low + high if r == c else abs(high - low))
    eliminate(lu, m, pressures, unused)
    best = _PARTS - 1
    for r in range(_PARTS, 2 * _PARTS + 1):
        best = r if pressures[r] > pressures[best] else best
    here, left, right = pressures[best], pressures[best - 1], pressures[best + 1]
    bend = 2.0 * here - left - right
    return here + 0.125 * (right - left) ** 2 / bend if bend > 0.5 * abs(right - left) else here  # top of the parabola


@kernel
def _found(sep, i, n, unit, workspace):
    """Return the largest pressure around strip i, a peak. If a neighbour has nearly its pressure, both are divided.

    Otherwise the answer would jump where the peak moves from one strip to the next.
    """
    p, patch = workspace.strips[Strip.P0], workspace.strips[Strip.PATCH]
    top = _top_of_parts(sep, i, n, unit, workspace)
    k = i + 1 if p[i + 1] > p[i - 1] else i - 1
    apart = min((p[i] - p[k]) / (_ALIKE * p[i]), 1.0)
    if apart == 1.0 or not 0 < k < n - 1 or patch[k - 1] != patch[k + 1]:
        return top
    share = 0.5 + 0.5 * apart * apart * (3.0 - 2.0 * apart)
    return share * top + (1.0 - share) * _top_of_parts(sep, k, n, unit, workspace)


@kernel
def _beside(i, step, n, strips):
    """Return the pressure two strips away. Beyond the end of a patch it is that which continues an ellipse."""
    k = i + 2 * step
    within = 0 <= k < n and strips[Strip.PATCH, k] == strips[Strip.PATCH, i]
    return strips[Strip.P0, k] if within else -strips[Strip.P0, i + step]


@kernel
def peak_between_strips(sep, n, unit, workspace):
    """Return the largest pressure found between `n` strips where a peak is sharp [Pa]; 0 if none is."""
    strips, panel = workspace.strips, workspace.rule.cosines.size - 1
    if panel < _FEWEST:
        return 0.0
    p, patch, angle = strips[Strip.P0], strips[Strip.PATCH], math.pi / panel
    of_ellipse, top, largest = 2.0 * (math.cos(angle) - math.cos(2.0 * angle)), 0.0, 0.0
    for i in range(n):
        largest = max(largest, p[i])
    for i in range(1, n - 1):
        if patch[i - 1] == patch[i + 1] and p[i - 1] <= p[i] >= p[i + 1] and p[i] > _HIGH * largest:
            bend = (p[i - 1] - _beside(i, -1, n, strips) + p[i + 1] - _beside(i, 1, n, strips)) / p[i]
            share = min(max((bend / of_ellipse - _SHARP) / (_SHARPEST - _SHARP), 0.0), 1.0)
            if share > 0.0:
                found = _found(sep, i, n, unit, workspace)
                top = max(top, p[i] + share * share * (3.0 - 2.0 * share) * (found - p[i]))
    return top
