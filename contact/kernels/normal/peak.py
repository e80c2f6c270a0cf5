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
#: Strips at either side of a divided one whose pressures are taken at every part. Those beyond act smoothly.
_NEAR = 4
#: Least strips of a panel: the parts need room in the rows of `vectors`.
FEWEST = 8


@kernel
def continues(j, strips):
    """Return whether strip j begins where the one before ends. Patches beyond the largest number of them share a number.

    The positions of some methods' strips are not quite their middles. A gap is as wide as a strip.
    """
    away = strips[Strip.Y, j] - strips[Strip.Y, j - 1]
    touches = away < 0.55 * (strips[Strip.DY, j] + strips[Strip.DY, j - 1])
    return touches and strips[Strip.PATCH, j] == strips[Strip.PATCH, j - 1]


@kernel
def _is_beside(i, k, n, strips):
    """Return whether strip k exists and lies in the patch of strip i."""
    beside = 0 <= k < n
    for j in range(min(i, k) + 1, max(i, k) + 1):
        beside = beside and continues(j, strips)
    return beside


@kernel
def _square_slope(i, n, strips):
    """Return the slope of p0² at strip i, from the parabola through it and its neighbours in a patch of three or more."""
    k = i + 1 if not _is_beside(i, i - 1, n, strips) else i - 1 if not _is_beside(i, i + 1, n, strips) else i
    y, left, right = strips[Strip.Y, k], strips[Strip.Y, k - 1], strips[Strip.Y, k + 1]
    top = strips[Strip.P0, k] ** 2
    d0 = (top - strips[Strip.P0, k - 1] ** 2) / (y - left)
    d1 = (strips[Strip.P0, k + 1] ** 2 - top) / (right - y)
    return d0 + (d1 - d0) / (right - left) * (2.0 * strips[Strip.Y, i] - left - y)


@kernel
def _is_peak(i, n, strips):
    """Return whether no neighbour in the patch has a larger pressure."""
    higher_before = _is_beside(i, i - 1, n, strips) and strips[Strip.P0, i - 1] > strips[Strip.P0, i]
    return not higher_before and not (_is_beside(i, i + 1, n, strips) and strips[Strip.P0, i + 1] > strips[Strip.P0, i])


@kernel
def _square_at(i, n, strips):
    """Return the largest p0² around strip i, a peak: the top of the cubics through p0². It is exact for an ellipse."""
    top = strips[Strip.P0, i] ** 2
    before, after = _is_beside(i, i - 1, n, strips), _is_beside(i, i + 1, n, strips)
    if not (before and after) and not _is_beside(i, i - 2, n, strips) and not _is_beside(i, i + 2, n, strips):
        return top  # fewer than three strips
    here = _square_slope(i, n, strips)
    for k in range(i - 1 if before else i, i + 1 if after else i):  # from strip k to the next one
        left = here if k == i else _square_slope(k, n, strips)
        right = here if k < i else _square_slope(k + 1, n, strips)
        if left > 0.0 > right:
            h, low, high = strips[Strip.Y, k + 1] - strips[Strip.Y, k], strips[Strip.P0, k], strips[Strip.P0, k + 1]
            _, least = cubic.least(h, -(low**2), -left, -(high**2), -right)
            top = max(top, -least)
    return top


@kernel
def peak_pressure(strips, n):
    """Return the largest pressure of `n` strips and between them."""
    top = 0.0
    for i in range(n):
        if _is_peak(i, n, strips):
            top = max(top, _square_at(i, n, strips))
    return math.sqrt(top)


@kernel
def _fill_logs(low, high, strips, logs):
    """Fill the logarithms of the half lengths of the strips from `low` to before `high`."""
    for j in range(low, high):
        logs[j] = math.log(strips[Strip.A, j])


@kernel
def _displacement(at, low, high, unit, strips, logs, centre):
    """Return the displacement at y = `at` by the strips in line from `low` to before `high`, whose ln a are `logs` [m]."""
    total, beyond = 0.0, 0.0
    for j in range(low, high):
        y, half = strips[Strip.Y, j], 0.5 * strips[Strip.DY, j]
        if j == low or not continues(j, strips):
            beyond = math.log(max(abs(at - y + half), 1e-12 * half))
        before, beyond = beyond, math.log(max(abs(at - y - half), 1e-12 * half))
        first, last = at_centre(centre, before - logs[j]), at_centre(centre, beyond - logs[j])
        u = first + last if abs(at - y) < half else abs(last - first)
        total += unit * strips[Strip.P0, j] * strips[Strip.A, j] * u
    return total


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
def _half_length(i, at, squares, strips):
    """Return the half length at y = `at`: a² is the parabola through the `squares` of strip i and its neighbours [m].

    It is at least .9 of that which is linear between strips, as the parabola falls below 0 where lengths multiply.
    """
    k = i if at < strips[Strip.Y, i] else i + 1
    t = (at - strips[Strip.Y, k - 1]) / (strips[Strip.Y, k] - strips[Strip.Y, k - 1])
    linear = max((1.0 - t) * squares[k - 1] + t * squares[k], 0.1 * min(squares[k - 1], squares[k]))
    return math.sqrt(max(_parabola(i, at, squares, strips), 0.9 * linear))


@kernel
def _fill_rest(sep, i, n, nearest, beyond, problem, logs, rest):
    """Fill `rest` of strip i and its neighbours: what closes the gap there beside the pressures of the nearest strips [m].

    The displacement by a panel's own strips has a factor (Eq. factors). Parts, which are narrower, need none, so what it adds
    to the strips' is taken away here.
    """
    workspace, strips, vectors = problem.workspace, problem.workspace.strips, problem.workspace.space.vectors
    slopes, centre = workspace.space.grid[Sample.GAP_SLOPE], workspace.tables.centre
    for s in range(i - 1, i + 2):
        y, half = strips[Strip.Y, s], 0.5 * strips[Strip.DY, s]
        gap = _mean_gap(sep, slopes, y - half, y + half)
        factor = vectors[Vector.OF_MIDDLE, int(vectors[Vector.INDEX, s])]
        by_factor = (1.0 - 1.0 / factor) * (problem.result.approach - gap)
        rest[s] = gap + by_factor + _displacement(y, nearest, beyond, problem.unit, strips, logs, centre)


@kernel
def _top_of_parts(i, n, problem):
    """Return the largest pressure of the parts of strip i and its neighbours, which lie in the same patch [Pa].

    What closes the gap at these strips beside the pressure of the nearest ones, approach and all distant strips, is
    smooth: a parabola. The outer parts make up for the pressure of the strips beside them, which has a step there. They do
    not count.
    """
    workspace, sep, unit = problem.workspace, problem.sep, problem.unit
    strips, vectors, lu, centre = workspace.strips, workspace.space.vectors, workspace.space.lu, workspace.tables.centre
    slopes, rest = workspace.space.grid[Sample.GAP_SLOPE], vectors[Vector.U]
    at, pressures, unused, logs = vectors[Vector.R], vectors[Vector.Q1], vectors[Vector.Q2], vectors[Vector.R_OLD]
    logs_a, squares = vectors[Vector.REACH], vectors[Vector.SPREAD]
    nearest, beyond = max(i - _NEAR, 0), min(i + _NEAR + 1, n)
    _fill_logs(nearest, beyond, strips, logs_a)
    _fill_rest(sep, i, n, nearest, beyond, problem, logs_a, rest)
    m = 3 * _PARTS
    for r in range(m):
        s = i - 1 + r // _PARTS
        half = 0.5 * strips[Strip.DY, s] / _PARTS
        at[r] = strips[Strip.Y, s] + (2 * (r % _PARTS) + 1 - _PARTS) * half
        pressures[r] = _parabola(i, at[r], rest, strips) - _mean_gap(sep, slopes, at[r] - half, at[r] + half)
        pressures[r] -= _displacement(at[r], nearest, i - 1, unit, strips, logs_a, centre)
        pressures[r] -= _displacement(at[r], i + 2, beyond, unit, strips, logs_a, centre)
        unused[r] = 0.0
    before = i - 1 if _is_beside(i, i - 2, n, strips) else i  # strips with two neighbours in the patch
    after = i + 1 if _is_beside(i, i + 2, n, strips) else i
    for s in range(before - 1, after + 2):
        squares[s] = strips[Strip.A, s] ** 2
    side = strips[Strip.Y, i - 1] - 0.5 * strips[Strip.DY, i - 1]
    for r in range(m):
        logs[r] = math.log(abs(at[r] - side))
    for c in range(m):  # parts lie side by side: the upper side of one is the lower side of the next
        s = i - 1 + c // _PARTS
        side = at[c] + 0.5 * strips[Strip.DY, s] / _PARTS
        a = _half_length(min(max(s, before), after), at[c], squares, strips)
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
def _found(i, n, problem):
    """Return the largest pressure around strip i, a peak. If a neighbour has nearly its pressure, both are divided.

    Otherwise the answer would jump where the peak moves from one strip to the next.
    """
    strips = problem.workspace.strips
    p = strips[Strip.P0]
    top = _top_of_parts(i, n, problem)
    k = i + 1 if p[i + 1] > p[i - 1] else i - 1
    apart = min((p[i] - p[k]) / (_ALIKE * p[i]), 1.0)
    if apart == 1.0 or not (_is_beside(k, k - 1, n, strips) and _is_beside(k, k + 1, n, strips)):
        return top
    share = 0.5 + 0.5 * apart * apart * (3.0 - 2.0 * apart)
    return share * top + (1.0 - share) * _top_of_parts(k, n, problem)


@kernel
def _beyond(i, step, n, strips):
    """Return the pressure two strips away. Beyond the end of a patch it is that which continues an ellipse."""
    k = i + 2 * step
    return strips[Strip.P0, k] if _is_beside(i, k, n, strips) else -strips[Strip.P0, i + step]


@kernel
def _sharpness(i, n, of_ellipse, strips):
    """Return how far the parts of strip i and its neighbours count, from 0 to 1. `of_ellipse` is the bend of an ellipse."""
    if not (_is_beside(i, i - 1, n, strips) and _is_beside(i, i + 1, n, strips)):
        return 0.0
    p = strips[Strip.P0]
    bend = (p[i - 1] - _beyond(i, -1, n, strips) + p[i + 1] - _beyond(i, 1, n, strips)) / p[i]
    share = min(max((bend / of_ellipse - _SHARP) / (_SHARPEST - _SHARP), 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


@kernel
def peak_between_strips(n, problem):
    """Return the largest pressure of `n` strips and between them [Pa]. Where a peak is sharp, that of its parts counts alone.

    The row INDEX of the vectors says where each strip's number in the panels is.
    """
    workspace, strips = problem.workspace, problem.workspace.strips
    p, panel = strips[Strip.P0], workspace.rule.cosines.size - 1
    if panel < FEWEST:
        return peak_pressure(strips, n)
    angle = math.pi / panel
    of_ellipse, top, largest = 2.0 * (math.cos(angle) - math.cos(2.0 * angle)), 0.0, 0.0
    for i in range(n):
        largest = max(largest, p[i])
    for i in range(n):
        if p[i] > _HIGH * largest and _is_peak(i, n, strips):
            smooth, share = math.sqrt(_square_at(i, n, strips)), _sharpness(i, n, of_ellipse, strips)
            top = max(top, smooth + share * (_found(i, n, problem) - smooth) if share > 0.0 else smooth)
    return top
