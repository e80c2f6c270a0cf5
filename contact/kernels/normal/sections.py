"""The largest pressure of long skewed strips: it may lie beside their middles, where semi-ellipses have theirs.

Where a slender patch crosses its strips, the curvature across the patch changes over the length of a strip, and so does the
pressure. Across the patch, at one x, the gap of the strips' pressures is known. It is closed by changes of the pressures there,
which act along the strips like the pressures themselves. What this does to the largest pressure of three such sections counts
(strip_halfspace.md 8).
"""

import math

from contact.core import kernel
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.gap_error import displacement_at, fill_sides, summarise
from contact.kernels.normal.peak import FEWEST, continues, peak_between_strips, peak_pressure, rise
from contact.kernels.normal.turned import line_of_middles
from contact.kernels.rows import Strip, Vector

#: Half length of the strip with the largest pressure over half the width of its patch, from which on sections count, and from
#: which on they count in full. The pressures of shorter strips are semi-ellipses.
_LONG, _LONGEST = 6.0, 10.0
#: Slope of the line of the strips' middles over this ratio, up to which sections count in full, and from which on not at all:
#: few strips then reach a section.
_SHEARED, _MOST_SHEARED = 0.65, 0.9
#: Distance of the outer sections from the middle of that strip, over its half length.
_ASIDE = 0.15
#: Change of the largest pressure up to which sections are believed, and from which on they are not: they change it by less than
#: .02 where they are right. What many narrow strips leave open amplifies the errors of the tables.
_BELIEVED, _UNBELIEVED = 0.05, 0.1


@kernel
def _share(i, low, high, strips):
    """Return how far sections count, from 0 to 1, if strip i of those from `low` to before `high` has the largest pressure."""
    last = high - 1
    width = strips[Strip.Y, last] - strips[Strip.Y, low] + 0.5 * (strips[Strip.DY, last] + strips[Strip.DY, low])
    ratio = 2.0 * strips[Strip.A, i] / width
    if ratio <= _LONG:
        return 0.0
    _, _, slope = line_of_middles(
        strips[Strip.P0, low:high],
        strips[Strip.A, low:high],
        strips[Strip.DY, low:high],
        strips[Strip.Y, low:high],
        strips[Strip.XC, low:high],
    )
    return rise(ratio, _LONG, _LONGEST) * (1.0 - rise(abs(slope) / ratio, _SHEARED, _MOST_SHEARED))


@kernel
def _fill_gaps(i, low, high, n, problem):
    """Fill what the strips from `low` to before `high` leave open in the three sections around the middle of strip i [m].

    At the middle of each strip its gap is closed. The sections are rows of the vectors from STEPS on.
    """
    workspace, strips, vectors = problem.workspace, problem.workspace.strips, problem.workspace.space.vectors
    plane = workspace.tables.plane
    summarise(n, strips, vectors)
    for j in range(low, high):
        row, middle, at_middle = int(vectors[Vector.INDEX, j]), strips[Strip.XC, j], 0.0
        fill_sides(strips[Strip.Y, j], n, strips, vectors)
        for k in range(4):
            x = middle if k == 0 else strips[Strip.XC, i] + (k - 2) * _ASIDE * strips[Strip.A, i]
            u = problem.unit * displacement_at(x, j, n, strips, vectors, plane)
            if k == 0:
                at_middle = u
            else:
                opens = vectors[Vector.CURVATURE, row] * (x - middle) * (x - middle + 2.0 * strips[Strip.OFFSET, j])
                vectors[Vector.STEPS + k - 1, j] = -opens - vectors[Vector.OF_MIDDLE, row] * (u - at_middle)


@kernel
def _close(x, gaps, low, high, problem):
    """Fill the pressures at `x` of the strips from `low` to before `high`: of the semi-ellipses, and those that close the gap.

    They are the rows U and R of the vectors. R_OLD has the pressures at the middles of the strips.
    """
    workspace, strips, vectors = problem.workspace, problem.workspace.strips, problem.workspace.space.vectors
    matrix, lu = workspace.space.matrix, workspace.space.lu
    before, after = vectors[Vector.U], vectors[Vector.R]
    places, changes, unused = vectors[Vector.REACH], vectors[Vector.SPREAD], vectors[Vector.OFFSET_STEP]
    m = 0
    for j in range(low, high):
        square = 1.0 - ((x - strips[Strip.XC, j]) / strips[Strip.A, j]) ** 2
        before[j] = after[j] = vectors[Vector.R_OLD, j] * math.sqrt(max(square, 0.0))
        if square > 0.0:
            places[m], changes[m], unused[m] = j, gaps[j], 0.0
            m += 1
    for r in range(m):
        influence = matrix[int(vectors[Vector.INDEX, int(places[r])])]
        for c in range(m):
            lu[r, c] = influence[int(vectors[Vector.INDEX, int(places[c])])]
    eliminate(lu, m, changes, unused)
    for r in range(m):
        j = int(places[r])
        after[j] = max(before[j] + changes[r], 0.0)


@kernel
def _top(pressures, low, high, n, strips):
    """Return the largest of the `pressures` of the strips from `low` to before `high` and between them."""
    for j in range(n):
        strips[Strip.P0, j] = pressures[j] if low <= j < high else 0.0
    return peak_pressure(strips, n)


@kernel
def _highest(left, here, right):
    """Return the largest value of the parabola through three values between the outer ones."""
    bend = 2.0 * here - left - right
    return here + 0.125 * (right - left) ** 2 / bend if bend > 0.5 * abs(right - left) else max(left, right)


@kernel
def _ratio(i, low, high, n, problem):
    """Return the largest pressure of a patch with its gap closed around the middle of strip i, over that of its semi-ellipses.

    The patch has the strips from `low` to before `high`.
    """
    strips, vectors = problem.workspace.strips, problem.workspace.space.vectors
    kept = vectors[Vector.R_OLD]
    _fill_gaps(i, low, high, n, problem)
    for j in range(n):
        kept[j] = strips[Strip.P0, j]
    before, after, left_before, left_after, here_before, here_after = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(3):
        left_before, left_after, here_before, here_after = here_before, here_after, before, after
        x = strips[Strip.XC, i] + (k - 1) * _ASIDE * strips[Strip.A, i]
        _close(x, vectors[Vector.STEPS + k], low, high, problem)
        before = _top(vectors[Vector.U], low, high, n, strips)
        after = _top(vectors[Vector.R], low, high, n, strips)
    for j in range(n):
        strips[Strip.P0, j] = kept[j]
    return _highest(left_after, here_after, after) / _highest(left_before, here_before, before)


@kernel
def largest_pressure(n, problem):
    """Return the largest pressure of `n` strips, between them and, in slender skewed patches, beside their middles [Pa]."""
    strips, top = problem.workspace.strips, peak_between_strips(n, problem)
    if problem.skew == 0.0 or problem.workspace.rule.across.nodes.size < FEWEST:
        return top
    i = 0
    for j in range(n):
        i = j if strips[Strip.P0, j] > strips[Strip.P0, i] else i
    low, high = i, i + 1
    while low > 0 and continues(low, strips):
        low -= 1
    while high < n and continues(high, strips):
        high += 1
    share = problem.skew * _share(i, low, high, strips)
    change = _ratio(i, low, high, n, problem) - 1.0 if share > 0.0 else 0.0
    return top * (1.0 + share * change * (1.0 - rise(abs(change), _BELIEVED, _UNBELIEVED)))
