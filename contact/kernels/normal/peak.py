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
#: The same of the parts, from which on they are divided once more.
_SHARP_AGAIN, _SHARPEST_AGAIN = 1.75, 2.5
#: Share of the largest strip pressure from which on a peak counts.
_HIGH = 0.8
#: Difference of two neighbours' pressures, over the larger one, below which the parts of both count.
_ALIKE = 0.15
#: Half the difference of their tops, over their mean, up to which this mean counts, beyond it the higher one less this.
_SAME = 0.0025
#: Parts of a strip, and of three strips.
_PARTS, _NINE = 3, 9
#: Strips at either side of a divided one whose pressures are taken at every part. Those beyond act smoothly.
_NEAR = 4
#: Least strips of a panel: the parts need room in the rows of `vectors`.
FEWEST = 8


@kernel
def rise(value, low, high):
    """Return a smooth step from 0 at `low` to 1 at `high`."""
    t = min(max((value - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


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
def _lay_parts(i, begin, parent, before, after, strips, vectors):
    """Lay nine parts in the rows R (middle), DIFFERENCE (half width) and OFFSET_R (ln a) from `begin` on.

    They are thirds of strip i and its neighbours if `begin` is 0, else of the parts `parent` and its neighbours. Strips from
    `before` to `after` have two neighbours in the patch.
    """
    at, halves, logs_a, squares = (
        vectors[Vector.R], vectors[Vector.DIFFERENCE], vectors[Vector.OFFSET_R], vectors[Vector.SPREAD],
    )  # fmt: skip
    for r in range(_NINE):
        k = r // _PARTS - 1
        s = i + k if begin == 0 else i - 1 + (parent + k) // _PARTS
        middle = strips[Strip.Y, s] if begin == 0 else at[parent + k]
        half = (0.5 * strips[Strip.DY, s] if begin == 0 else halves[parent + k]) / _PARTS
        at[begin + r], halves[begin + r] = middle + (2 * (r % _PARTS) + 1 - _PARTS) * half, half
        logs_a[begin + r] = math.log(_half_length(min(max(s, before), after), at[begin + r], squares, strips))


@kernel
def _displacement_by_parts(at, parent, unit, vectors, centre):
    """Return the displacement at y = `at` by the nine first parts but `parent` and its neighbours, where the point lies [m]."""
    parts, halves, logs_a, pressures = (
        vectors[Vector.R], vectors[Vector.DIFFERENCE], vectors[Vector.OFFSET_R], vectors[Vector.Q1],
    )  # fmt: skip
    total = 0.0
    for c in range(_NINE):
        if c < parent - 1 or c > parent + 1:
            away = abs(parts[c] - at)
            near, far = math.log(away - halves[c]) - logs_a[c], math.log(away + halves[c]) - logs_a[c]
            total += pressures[c] * math.exp(logs_a[c]) * (at_centre(centre, far) - at_centre(centre, near))
    return unit * total


@kernel
def _close_parts(i, begin, parent, nearest, beyond, problem):
    """Find the pressures of the nine parts from `begin` on, in the row Q1. All else keeps its pressures."""
    workspace, sep, unit = problem.workspace, problem.sep, problem.unit
    strips, vectors, lu, centre = workspace.strips, workspace.space.vectors, workspace.space.lu, workspace.tables.centre
    slopes, rest, logs_a = workspace.space.grid[Sample.GAP_SLOPE], vectors[Vector.U], vectors[Vector.REACH]
    at, halves, logs = vectors[Vector.R, begin:], vectors[Vector.DIFFERENCE, begin:], vectors[Vector.R_OLD]
    logs_of_parts, pressures, unused = vectors[Vector.OFFSET_R, begin:], vectors[Vector.Q1, begin:], vectors[Vector.Q2]
    side = at[0] - halves[0]
    for r in range(_NINE):
        pressures[r] = _parabola(i, at[r], rest, strips) - _mean_gap(sep, slopes, at[r] - halves[r], at[r] + halves[r])
        pressures[r] -= _displacement(at[r], nearest, i - 1, unit, strips, logs_a, centre)
        pressures[r] -= _displacement(at[r], i + 2, beyond, unit, strips, logs_a, centre)
        if begin > 0:
            pressures[r] -= _displacement_by_parts(at[r], parent, unit, vectors, centre)
        unused[r], logs[r] = 0.0, math.log(abs(at[r] - side))
    for c in range(_NINE):  # parts lie side by side: the upper side of one is the lower side of the next
        side, ln_a = at[c] + halves[c], logs_of_parts[c]
        scale = unit * math.exp(ln_a)
        for r in range(_NINE):
            low = at_centre(centre, logs[r] - ln_a)
            logs[r] = math.log(abs(at[r] - side))
            high = at_centre(centre, logs[r] - ln_a)
            lu[c, r] = scale * (low + high if r == c else abs(high - low))
    eliminate(lu, _NINE, pressures, unused)


@kernel
def _highest_part(begin, vectors):
    """Return which of the nine parts from `begin` on, without the two at either side, has the largest pressure."""
    pressures = vectors[Vector.Q1]
    best = begin + _PARTS - 1
    for r in range(begin + _PARTS, begin + 2 * _PARTS + 1):
        best = r if pressures[r] > pressures[best] else best
    return best


@kernel
def _top(best, vectors):
    """Return the largest pressure around part `best`: the top of the parabola through it and its neighbours."""
    here, left, right = vectors[Vector.Q1, best], vectors[Vector.Q1, best - 1], vectors[Vector.Q1, best + 1]
    bend = 2.0 * here - left - right
    return here + 0.125 * (right - left) ** 2 / bend if bend > 0.5 * abs(right - left) else here


@kernel
def _top_of_parts(i, n, of_ellipse, problem):
    """Return the largest pressure of the parts of strip i and its neighbours, which lie in the same patch [Pa].

    What closes the gap at these strips beside the pressure of the nearest ones, approach and all distant strips, is
    smooth: a parabola. The outer parts make up for the pressure of the strips beside them, which has a step there. They do
    not count. Where the pressures of the parts are as sharp again, the highest three are divided once more.
    """
    strips, vectors = problem.workspace.strips, problem.workspace.space.vectors
    squares, pressures = vectors[Vector.SPREAD], vectors[Vector.Q1]
    nearest, beyond = max(i - _NEAR, 0), min(i + _NEAR + 1, n)
    _fill_logs(nearest, beyond, strips, vectors[Vector.REACH])
    _fill_rest(problem.sep, i, n, nearest, beyond, problem, vectors[Vector.REACH], vectors[Vector.U])
    before = i - 1 if _is_beside(i, i - 2, n, strips) else i  # strips with two neighbours in the patch
    after = i + 1 if _is_beside(i, i + 2, n, strips) else i
    for s in range(before - 1, after + 2):
        squares[s] = strips[Strip.A, s] ** 2
    _lay_parts(i, 0, 0, before, after, strips, vectors)
    _close_parts(i, 0, 0, nearest, beyond, problem)
    best = _highest_part(0, vectors)
    top = _top(best, vectors)
    bend = pressures[best - 1] - pressures[best - 2] + pressures[best + 1] - pressures[best + 2]
    share = rise(_PARTS * _PARTS * bend / (of_ellipse * pressures[best]), _SHARP_AGAIN, _SHARPEST_AGAIN)
    if share == 0.0:
        return top
    _lay_parts(i, _NINE, best, before, after, strips, vectors)
    _close_parts(i, _NINE, best, nearest, beyond, problem)
    return top + share * (_top(_highest_part(_NINE, vectors), vectors) - top)


@kernel
def _found(i, n, of_ellipse, problem):
    """Return the largest pressure around strip i, a peak. If a neighbour has nearly its pressure, both are divided.

    Otherwise the answer would jump where the peak moves from one strip to the next. The parts of only one of them may have it.
    """
    strips = problem.workspace.strips
    p = strips[Strip.P0]
    top = _top_of_parts(i, n, of_ellipse, problem)
    k = i + 1 if p[i + 1] > p[i - 1] else i - 1
    apart = min((p[i] - p[k]) / (_ALIKE * p[i]), 1.0)
    if apart == 1.0 or not (_is_beside(k, k - 1, n, strips) and _is_beside(k, k + 1, n, strips)):
        return top
    other = _top_of_parts(k, n, of_ellipse, problem)
    mean = 0.5 * (top + other)
    of_both = mean + max(0.5 * abs(other - top) - _SAME * mean, 0.0)
    return of_both + rise(apart, 0.0, 1.0) * (top - of_both)


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
    return rise(bend / of_ellipse, _SHARP, _SHARPEST)


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
            top = max(top, smooth + share * (_found(i, n, of_ellipse, problem) - smooth) if share > 0.0 else smooth)
    return top
