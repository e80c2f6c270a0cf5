"""Panels of cosine-spaced strips that cover the patches of the strip half space: made, laid out and opened."""

import math

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.cubic import locate
from contact.kernels.normal.between_panels import is_shared
from contact.kernels.normal.descent import END_LENGTH
from contact.kernels.normal.strip_system import displacement_outside
from contact.kernels.records import MAX_PATCHES
from contact.kernels.rows import Sample, Strip, Vector

#: Largest offset of a strip's middle along x over the half length of the virtual penetration.
_WITHIN = 0.95
#: Overlap outside the panels, over the approach, that counts as missed contact: early, and at convergence.
EARLY_GHOST, GHOST = 2e-2, 1e-3
#: Logarithm of the half length of an end strip over that of its neighbour.
_LN_END = math.log(END_LENGTH)
#: Share of the overlap's width that a new panel leaves free at either end. An elastic patch is narrower than the overlap.
OPENED = 0.15


@kernel
def lay_panels(sep, g_least, skew, panels, n_panels, workspace):
    """Fill strip positions, mean gaps, curvatures and loci for the present ends of the panels.

    `skew` scales the loci.
    """
    y, g, A, xc, cosines, vectors = sep.y, sep.g, sep.A, sep.x_c, workspace.rule.cosines, workspace.space.vectors
    n = cosines.size - 1
    size = y.size
    m = workspace.space.grid[Sample.GAP_SLOPE]
    k = 0
    for p in range(n_panels):
        centre = 0.5 * (panels[2 * p] + panels[2 * p + 1])
        half = 0.5 * (panels[2 * p + 1] - panels[2 * p])
        low = centre + half * cosines[0]
        k = locate(y, size, low, k)
        middle = k
        h = y[k + 1] - y[k]
        before = cubic.integral(h, g[k], m[k], g[k + 1], m[k + 1], (low - y[k]) / h)
        for i in range(n):
            row = p * n + i
            high = centre + half * cosines[i + 1]
            at = 0.5 * (low + high)
            vectors[Vector.Y, row], vectors[Vector.HALF, row] = at, 0.5 * (high - low)
            integral = -before  # from the start of the interval in which the strip begins
            while k < size - 2 and y[k + 1] < high:
                integral += h * (0.5 * (g[k] + g[k + 1]) + h / 12.0 * (m[k] - m[k + 1]))
                k += 1
                h = y[k + 1] - y[k]
            before = cubic.integral(h, g[k], m[k], g[k + 1], m[k + 1], (high - y[k]) / h)
            vectors[Vector.GAP, row] = (integral + before) / (high - low) - g_least
            middle = locate(y, size, at, middle)
            t = (at - y[middle]) / (y[middle + 1] - y[middle])
            vectors[Vector.CURVATURE, row] = (1.0 - t) * A[middle] + t * A[middle + 1]
            vectors[Vector.XC, row] = skew * ((1.0 - t) * xc[middle] + t * xc[middle + 1])
            low = high


@kernel
def is_between_loaded(i, n, vectors):
    """Return whether strip i and both its neighbours in the panel bear pressure, so that it has a middle of its own."""
    place = i % n
    inner = 0 < place < n - 1
    return inner and min(vectors[Vector.P, i - 1], vectors[Vector.P, i], vectors[Vector.P, i + 1]) > 0.0


@kernel
def _middle(i, first, n, vectors):
    """Return the middle along x of a strip that has none of its own: in line with the nearest two that have one."""
    last = first + n - 1
    left, right = i - 1, i + 1
    while left >= first and not is_between_loaded(left, n, vectors):
        left -= 1
    while right <= last and not is_between_loaded(right, n, vectors):
        right += 1
    if left < first and right > last:
        return vectors[Vector.XC, i] + vectors[Vector.OFFSET, i]
    if left >= first and right <= last:
        near, far = left, right
    else:
        near, step = (right, 1) if left < first else (left, -1)
        far = near + step
        if not is_between_loaded(far, n, vectors):
            return vectors[Vector.XC, i] + vectors[Vector.OFFSET, near]
    at_near = vectors[Vector.XC, near] + vectors[Vector.OFFSET, near]
    at_far = vectors[Vector.XC, far] + vectors[Vector.OFFSET, far]
    share = (vectors[Vector.Y, i] - vectors[Vector.Y, near]) / (vectors[Vector.Y, far] - vectors[Vector.Y, near])
    return at_near + share * (at_far - at_near)


@kernel
def place_middles(vectors, n, n_panels, delta):
    """Move the strips along x by their offsets d from the line of least gap, which opens the gap by A d² (Eq. skew).

    A strip without pressure, or beside one, or at the end of a panel hardly feels where its middle is. It lies in line with
    its neighbours, as the middles of an ellipse's chords do. The pressures are those of the last iteration. The middle of
    every strip lies well inside the virtual penetration, A d² < delta - g.
    """
    for p in range(n_panels):
        first = p * n
        for i in range(first, first + n):
            if not is_between_loaded(i, n, vectors):
                vectors[Vector.OFFSET, i] = _middle(i, first, n, vectors) - vectors[Vector.XC, i]
        for i in range(first, first + n):
            square = max(delta - vectors[Vector.GAP, i], 0.0) / vectors[Vector.CURVATURE, i]
            bound = _WITHIN * math.sqrt(square)
            offset = min(max(vectors[Vector.OFFSET, i], -bound), bound)
            vectors[Vector.OFFSET, i] = offset
            vectors[Vector.XC, i] += offset
            vectors[Vector.GAP, i] += vectors[Vector.CURVATURE, i] * offset * offset


@entry
def half_lengths(panels: Numbers, vectors: Matrix, n: int, n_panels: int, delta: float) -> None:
    """Fill half lengths a and their logarithms, LN_LENGTH, from ln a, at the approach `delta` above first touch [m].

    Strips at the ends follow the square root of the edge, but have their neighbours' lengths where two panels meet. No strip
    may collapse beside its neighbours. None may be longer than the virtual penetration, A a² = delta - g: the pressure
    displaces its ends outwards. Without this bound the length of a strip with hardly any pressure, near the end of a skewed
    patch, can grow until it carries the load.
    """
    for p in range(n_panels):
        first = p * n
        for i in range(first + 1, first + n - 1):
            vectors[Vector.A, i] = math.exp(vectors[Vector.LN_A, i])
            square = (delta - vectors[Vector.GAP, i]) / vectors[Vector.CURVATURE, i]
            if 0.0 < square < vectors[Vector.A, i] ** 2:
                vectors[Vector.A, i], vectors[Vector.LN_A, i] = math.sqrt(square), 0.5 * math.log(square)
            vectors[Vector.FLOOR, i] = 0.0
        vectors[Vector.FLOOR, first] = vectors[Vector.FLOOR, first + n - 1] = 0.0
        for end, beside, number in ((first, first + 1, 2 * p), (first + n - 1, first + n - 2, 2 * p + 1)):
            shared = is_shared(number, n_panels, panels)
            vectors[Vector.A, end] = (1.0 if shared else END_LENGTH) * vectors[Vector.A, beside]
            vectors[Vector.LN_LENGTH, end] = (0.0 if shared else _LN_END) + vectors[Vector.LN_A, beside]
        for i in range(first + 1, first + n - 1):
            if vectors[Vector.ACTIVE, i] != 0.0:
                floor = 0.3 * max(vectors[Vector.A, i - 1], vectors[Vector.A, i + 1])
                vectors[Vector.FLOOR, i] = floor
                if vectors[Vector.A, i] <= floor:
                    vectors[Vector.A, i], vectors[Vector.LN_A, i] = floor, math.log(floor)
            vectors[Vector.LN_LENGTH, i] = vectors[Vector.LN_A, i]


@kernel
def _read(at, low, high, cosines, vectors, lengths, offsets, first):
    """Return ln a and offset of a panel from `low` to `high` at a place, with a² linear in y and constant beyond.

    The rows `lengths` and `offsets` hold them from strip `first` on.
    """
    n = cosines.size - 1
    scale = 0.5 * (high - low)
    unit = (at - 0.5 * (low + high)) / scale
    k = 1
    while k < n - 2 and 0.5 * (cosines[k + 1] + cosines[k + 2]) < unit:
        k += 1
    left, right = 0.5 * (cosines[k] + cosines[k + 1]), 0.5 * (cosines[k + 1] + cosines[k + 2])
    t = min(max((unit - left) / (right - left), 0.0), 1.0)
    square = (1.0 - t) * math.exp(2.0 * vectors[lengths, first + k]) + t * math.exp(
        2.0 * vectors[lengths, first + k + 1]
    )
    return 0.5 * math.log(square), (1.0 - t) * vectors[offsets, first + k] + t * vectors[offsets, first + k + 1]


@kernel
def _place(i, low, high, cosines):
    """Return the middle of strip i of a panel from `low` to `high`."""
    return 0.5 * (low + high) + 0.25 * (high - low) * (cosines[i] + cosines[i + 1])


@kernel
def resample(old_low, old_high, low, high, cosines, vectors, first):
    """Transfer a²(y) and offsets of one panel to new ends, linear in y and constant beyond."""
    n = cosines.size - 1
    for i in range(n):
        vectors[Vector.R_OLD, first + i] = vectors[Vector.LN_A, first + i]
        vectors[Vector.OFFSET_R_OLD, first + i] = vectors[Vector.OFFSET, first + i]
    for i in range(n):
        vectors[Vector.LN_A, first + i], vectors[Vector.OFFSET, first + i] = _read(
            _place(i, low, high, cosines), old_low, old_high, cosines, vectors, Vector.R_OLD, Vector.OFFSET_R_OLD, first
        )


@kernel
def take_over(other, panels, low, high, cosines, vectors, first):
    """Take a² and offsets of strips that lie in panel `other` from there. `low` and `high` are the ends of their own panel."""
    n = cosines.size - 1
    begin, end = panels[2 * other], panels[2 * other + 1]
    for i in range(n):
        at = _place(i, low, high, cosines)
        if begin < at < end:
            vectors[Vector.LN_A, first + i], vectors[Vector.OFFSET, first + i] = _read(
                at, begin, end, cosines, vectors, Vector.LN_A, Vector.OFFSET, other * n
            )


@kernel
def start_panels(n_strips, panel_strips, strips, result, panels, cosines, vectors):
    """Make one panel for each patch of the ANALYN solution, with its half lengths. Return the number of panels."""
    n = cosines.size - 1
    count = int(strips[Strip.PATCH, n_strips - 1]) + 1
    for p in range(count):
        low, high = result.edges[2 * p], result.edges[2 * p + 1]
        margin = 0.01 * (high - low)
        panels[2 * p], panels[2 * p + 1] = low - margin, high + margin
        if p > 0 and panels[2 * p] < panels[2 * p - 1]:
            panels[2 * p] = panels[2 * p - 1] = 0.5 * (low + result.edges[2 * p - 1])
        largest = 0.0
        for i in range(panel_strips):
            largest = max(largest, strips[Strip.A, p * panel_strips + i])
        for i in range(n):
            a = max(strips[Strip.A, p * panel_strips + i], 1e-3 * largest)
            if 0 < i < n - 1:
                a = max(
                    a, 0.4 * max(strips[Strip.A, p * panel_strips + i - 1], strips[Strip.A, p * panel_strips + i + 1])
                )
            vectors[Vector.LN_A, p * n + i], vectors[Vector.OFFSET, p * n + i] = math.log(a), 0.0
            vectors[Vector.ACTIVE, p * n + i] = vectors[Vector.P, p * n + i] = 1.0
    return count


@entry
def _summarise(n: int, n_panels: int, vectors: Matrix, unit: float) -> None:
    """Fill reach and spread of strips and of whole panels."""
    for p in range(n_panels):
        first = p * n
        load, moment, along, square = 0.0, 0.0, 0.0, 0.0
        for j in range(first, first + n):
            a, h, at, locus = vectors[Vector.A, j], vectors[Vector.HALF, j], vectors[Vector.Y, j], vectors[Vector.XC, j]
            load_of_strip, spread = math.pi * unit * vectors[Vector.P, j] * a * h, 0.25 * a * a + h * h / 3.0
            vectors[Vector.REACH, j], vectors[Vector.SPREAD, j] = load_of_strip, spread
            load += load_of_strip
            moment += load_of_strip * at
            along += load_of_strip * locus
            square += load_of_strip * (at * at + locus * locus + spread)
        middle, locus = (moment / load, along / load) if load > 0.0 else (0.0, 0.0)
        vectors[Vector.REACH_OF_PANEL, first], vectors[Vector.MIDDLE_OF_PANEL, first] = load, middle
        spread = max(square / load - middle * middle - locus * locus, 1e-300) if load > 0.0 else 1.0
        vectors[Vector.SPREAD_OF_PANEL, first], vectors[Vector.LOCUS_OF_PANEL, first] = spread, locus


@entry
def _is_overlapped(
    at: float,
    locus: float,
    allowed: float,
    n: int,
    n_panels: int,
    vectors: Matrix,
    centre: Matrix,
    plane: Matrix,
    unit: float,
) -> bool:
    """Return whether the displacement at y = at, x = locus outside the panels is less than `allowed`.

    Two cheap lower bounds are tried first. They take the load of every panel, then of every strip, at the root mean
    square of its distances. This displaces the point no more than the load does.
    """
    u = 0.0
    for p in range(n_panels):
        first = p * n
        away, aside = at - vectors[Vector.MIDDLE_OF_PANEL, first], locus - vectors[Vector.LOCUS_OF_PANEL, first]
        square = away * away + aside * aside + vectors[Vector.SPREAD_OF_PANEL, first]
        u += vectors[Vector.REACH_OF_PANEL, first] / math.sqrt(square)
    if allowed <= u:
        return False
    middles, loci, reaches, spreads, by_strip = (
        vectors[Vector.Y], vectors[Vector.XC], vectors[Vector.REACH], vectors[Vector.SPREAD], vectors[Vector.Q1],
    )  # fmt: skip
    for j in range(n * n_panels):  # each by itself, so that the compiler takes several at once
        away, aside = at - middles[j], locus - loci[j]
        by_strip[j] = reaches[j] / math.sqrt(away * away + aside * aside + spreads[j])
    u = 0.0
    for j in range(n * n_panels):
        u += by_strip[j]
    return allowed > u and allowed > displacement_outside(at, locus, n, n_panels, vectors, centre, plane, unit)


@kernel
def extend_to_ghosts(sep, g_least, delta, least, unit, skew, n_panels, panels, workspace):
    """Widen the nearest panel or open a new one where the gap outside all panels would be overlapped.

    It is sought on the line of least gap. `skew` scales its offsets along x, as in `lay_panels`. Return the number of
    panels and whether anything changed. Without this a second patch that the start solution missed would not be found
    (strip_halfspace.md 2, step 5).
    """
    y, g, cosines, vectors = sep.y, sep.g, workspace.rule.cosines, workspace.space.vectors
    centre, plane = workspace.tables.centre, workspace.tables.plane
    size, n = y.size, cosines.size - 1
    known = n_panels  # new panels displace nothing during the search for further ghosts
    changed = False
    _summarise(n, n_panels, vectors, unit)
    highest = (1.0 - least) * delta + g_least
    i = 0
    while i < size:
        inside = g[i] >= highest
        for p in range(n_panels):
            inside = inside or panels[2 * p] <= y[i] <= panels[2 * p + 1]
        if inside or not _is_overlapped(
            y[i], skew * sep.x_c[i], highest - g[i], n, known, vectors, centre, plane, unit
        ):
            i += 1
            continue
        k = i  # the overlap goes from sample i to k
        while (
            k + 1 < size
            and g[k + 1] < highest
            and _is_overlapped(
                y[k + 1], skew * sep.x_c[k + 1], highest - g[k + 1], n, known, vectors, centre, plane, unit
            )
        ):
            k += 1
        margin = 1 if least <= GHOST else 0  # no margin while the ends still move
        low, high = y[max(i - margin, 0)], y[min(k + margin, size - 1)]
        nearest, distance = 0, math.inf
        for p in range(n_panels):
            d = max(panels[2 * p] - high, low - panels[2 * p + 1])
            if d < distance:
                nearest, distance = p, d
        width = panels[2 * nearest + 1] - panels[2 * nearest]
        if distance > 0.05 * width and n_panels < MAX_PATCHES:
            p = n_panels
            n_panels += 1
            low, high = y[max(i - 1, 0)], y[min(k + 1, size - 1)]
            low, high = low + OPENED * (high - low), high - OPENED * (high - low)
            panels[2 * p], panels[2 * p + 1] = low, high
            reference = 0.0
            for j in range(n):
                reference = max(reference, vectors[Vector.A, nearest * n + j])
            for j in range(n):
                unit_y = 0.5 * (cosines[j] + cosines[j + 1])
                a = 0.5 * reference * math.sqrt((high - low) / width * (1.0 - unit_y * unit_y))
                vectors[Vector.LN_A, p * n + j] = math.log(max(a, 1e-3 * reference))
                vectors[Vector.A, p * n + j], vectors[Vector.OFFSET, p * n + j] = reference, 0.0
                vectors[Vector.ACTIVE, p * n + j] = 1.0
                vectors[Vector.P, p * n + j] = 0.0
        else:
            p = nearest
            old_low, old_high = panels[2 * p], panels[2 * p + 1]
            panels[2 * p], panels[2 * p + 1] = min(low, old_low), max(high, old_high)
            resample(old_low, old_high, panels[2 * p], panels[2 * p + 1], cosines, vectors, p * n)
            vectors[Vector.ACTIVE, p * n : p * n + n] = 1.0
        changed = True
        i = k + 2
    return n_panels, changed
