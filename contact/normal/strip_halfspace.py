"""Strip half space: longitudinal strips with semi-elliptic pressure and exact half-space influence between them.

Unknown are the peak pressure and the half length of every strip and, for a prescribed load, the approach. Two conditions a
strip: the gap closes on the centre line and at the strip's ends (strip_halfspace.md 2, "C1"; after Knothe and Le The 1984).
Hertz's ellipse satisfies both exactly for every aspect ratio. Strips are cosine-spaced between moving ends, one panel of
strips for every patch of the start solution; all panels interact. No second derivative of the profile enters.
"""

import math

from contact._jit import kernel
from contact._layout import (
    APPROACH,
    CASE_G,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_NU,
    MAX_PATCHES,
    RES_APPROACH,
    RES_EDGES,
    RES_ITERATIONS,
    RES_N,
    RES_STATUS,
    RES_STIFFNESS,
    RES_TOUCH,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_DY,
    STRIP_P0,
    STRIP_PATCH,
    STRIP_XC,
    STRIP_Y,
)
from contact.normal.analyn import GAP_SLOPE, LOG_ASPECT, analyn
from contact.normal.lay import locate
from contact.normal.strip_system import (
    DEPTH,
    V_A,
    V_ACTIVE,
    V_CHANGES,
    V_CURVATURE,
    V_GAP,
    V_HALF,
    V_LN_A,
    V_P,
    V_Q1,
    V_R,
    V_R_OLD,
    V_STEP,
    V_STEPS,
    V_XC,
    V_Y,
    assemble,
    displacement_outside,
    distances,
    solve_active,
)

MAX_ITERATIONS = 25
#: Load-weighted mean change of ln a, and change of the ends over the width, at which the iteration stops.
TOLERANCE = 1e-4
#: An iterate that did not converge is returned if it changes by less than this; otherwise ANALYN's answer is.
USABLE = 0.02
#: From here on plain steps with ends that move less and less: on rough gaps the end rule has no steady answer.
_MIXED_ITERATIONS = 10
#: Share of an end's move that its rule asks for, and its weight in the mixing beside the loads of all strips.
_END_STEP, _END_WEIGHT = 0.6, 1.0
_END_VALUE, _END_SLOPE = 0.365, 0.108  # (p1/p2)² at the exact half width and its slope (strip_halfspace.md 2, step 4)
_END_RANGE = (-3.0, 20.0)  # of one move outwards before damping, in widths of the end strip
#: Overlap outside the panels, over the approach, that counts as missed contact, early and in the end.
_EARLY_GHOST, _GHOST = 2e-2, 1e-3

# memory[...]: what a later call may start from: number of panels, their ends, the outer ends of ANALYN's patches, then ln a
MEM_PANELS, MEM_ENDS, MEM_START, MEM_LN_A = 0, 1, 1 + 2 * MAX_PATCHES, 3 + 2 * MAX_PATCHES


@kernel
def _hermite_integral(h, f0, m0, f1, m1, t):
    """Integral of the cubic over its interval from 0 to t."""
    t2 = t * t
    t3, t4 = t2 * t, t2 * t2
    return h * (
        f0 * (t - t3 + 0.5 * t4)
        + h * m0 * (0.5 * t2 - 2.0 / 3.0 * t3 + 0.25 * t4)
        + f1 * (t3 - 0.5 * t4)
        + h * m1 * (0.25 * t4 - t3 / 3.0)
    )


@kernel
def _mean_gap(y, g, m, n, low, high, start):
    """Mean of the interpolated gap over [low, high], and the interval of `low`."""
    i = locate(y, n, low, start)
    first = i
    total = 0.0
    at = low
    while True:
        h = y[i + 1] - y[i]
        end = min(high, y[i + 1]) if i < n - 2 else high
        a, b = (at - y[i]) / h, (end - y[i]) / h
        total += _hermite_integral(h, g[i], m[i], g[i + 1], m[i + 1], b)
        total -= _hermite_integral(h, g[i], m[i], g[i + 1], m[i + 1], a)
        if end >= high or i >= n - 2:
            break
        at = end
        i += 1
    return total / (high - low), first


@kernel
def _lay_panels(y, g, A, xc, g_least, work, panels, n_panels, cosines, vectors):
    """Strip positions, mean gaps, curvatures and loci for the present ends of the panels."""
    n = cosines.size - 1
    size = y.size
    m = work[GAP_SLOPE]
    k = 0
    for p in range(n_panels):
        centre = 0.5 * (panels[2 * p] + panels[2 * p + 1])
        half = 0.5 * (panels[2 * p + 1] - panels[2 * p])
        for i in range(n):
            row = p * n + i
            low, high = centre + half * cosines[i], centre + half * cosines[i + 1]
            at = 0.5 * (low + high)
            vectors[V_Y, row] = at
            vectors[V_HALF, row] = 0.5 * (high - low)
            mean, k = _mean_gap(y, g, m, size, low, high, k)
            vectors[V_GAP, row] = mean - g_least
            j = locate(y, size, at, k)
            t = (at - y[j]) / (y[j + 1] - y[j])
            vectors[V_CURVATURE, row] = (1.0 - t) * A[j] + t * A[j + 1]
            vectors[V_XC, row] = (1.0 - t) * xc[j] + t * xc[j + 1]


@kernel
def _half_lengths(vectors, n, n_panels):
    """a from ln a; strips at the ends follow the square root of the edge, none collapses beside its neighbours."""
    for p in range(n_panels):
        first = p * n
        for i in range(first + 1, first + n - 1):
            vectors[V_A, i] = math.exp(vectors[V_LN_A, i])
        vectors[V_A, first] = 0.447 * vectors[V_A, first + 1]
        vectors[V_A, first + n - 1] = 0.447 * vectors[V_A, first + n - 2]
        for i in range(first + 1, first + n - 1):
            if vectors[V_ACTIVE, i] != 0.0:
                vectors[V_A, i] = max(vectors[V_A, i], 0.3 * max(vectors[V_A, i - 1], vectors[V_A, i + 1]))


@kernel
def _resample(old_low, old_high, low, high, cosines, vectors, first):
    """Carry a²(y) of one panel over to new ends, linear in y and constant beyond."""
    n = cosines.size - 1
    scale = 0.5 * (old_high - old_low)
    for i in range(n):
        vectors[V_R_OLD, first + i] = vectors[V_LN_A, first + i]
    for i in range(n):
        at = 0.5 * (low + high) + 0.25 * (high - low) * (cosines[i] + cosines[i + 1])
        unit = (at - 0.5 * (old_low + old_high)) / scale
        k = 1
        while k < n - 2 and 0.5 * (cosines[k + 1] + cosines[k + 2]) < unit:
            k += 1
        left, right = 0.5 * (cosines[k] + cosines[k + 1]), 0.5 * (cosines[k + 1] + cosines[k + 2])
        t = min(max((unit - left) / (right - left), 0.0), 1.0)
        square = (1.0 - t) * math.exp(2.0 * vectors[V_R_OLD, first + k]) + t * math.exp(
            2.0 * vectors[V_R_OLD, first + k + 1]
        )
        vectors[V_LN_A, first + i] = 0.5 * math.log(square)


@kernel
def _start_panels(n_strips, panel_strips, strips, result, panels, cosines, vectors):
    """One panel for each patch of the ANALYN solution, its half lengths carried over; return the number of panels."""
    n = cosines.size - 1
    count = int(strips[STRIP_PATCH, n_strips - 1]) + 1
    for p in range(count):
        low, high = result[RES_EDGES + 2 * p], result[RES_EDGES + 2 * p + 1]
        margin = 0.01 * (high - low)
        panels[2 * p], panels[2 * p + 1] = low - margin, high + margin
        if p > 0 and panels[2 * p] < panels[2 * p - 1]:
            panels[2 * p] = panels[2 * p - 1] = 0.5 * (low + result[RES_EDGES + 2 * p - 1])
        largest = 0.0
        for i in range(panel_strips):
            largest = max(largest, strips[STRIP_A, p * panel_strips + i])
        for i in range(n):
            a = max(strips[STRIP_A, p * panel_strips + i], 1e-3 * largest)
            if 0 < i < n - 1:
                a = max(
                    a, 0.4 * max(strips[STRIP_A, p * panel_strips + i - 1], strips[STRIP_A, p * panel_strips + i + 1])
                )
            vectors[V_LN_A, p * n + i] = math.log(a)
            vectors[V_ACTIVE, p * n + i] = 1.0
    return count


@kernel
def _end_move(vectors, n, first, step, cosines):
    """How far one end of a panel should move outwards over its half width, and whether idle strips are cut off there.

    `first` is the strip at this end, `step` the way to its neighbour. On the exact half width the squared ratio q of the
    second and third pressures has a known value; a high second strip means that the panel is too narrow.
    """
    idle = 0
    while idle < n - 1 and vectors[V_P, first + idle * step] <= 0.0:
        idle += 1
    if idle >= 2:
        return -0.9 * (1.0 + cosines[idle]), True
    q = (vectors[V_P, first + step] / vectors[V_P, first + 2 * step]) ** 2
    wanted = min(max((q - _END_VALUE) / _END_SLOPE, _END_RANGE[0]), _END_RANGE[1])
    return _END_STEP * wanted * (1.0 + cosines[1]), False


@kernel
def _end_moves(y, n, n_panels, panels, cosines, vectors, damping):
    """Moves of all panels' ends into V_R of their end strips; return the largest over the width, and whether any was cut."""
    largest, cut = 0.0, False
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        low, high = panels[2 * p], panels[2 * p + 1]
        half = 0.5 * (high - low)
        move, is_cut = _end_move(vectors, n, first, 1, cosines)
        vectors[V_R, first] = max(low - half * damping * move, y[0]) - low
        cut = cut or is_cut
        move, is_cut = _end_move(vectors, n, last, -1, cosines)
        vectors[V_R, last] = min(high + half * damping * move, y[y.size - 1]) - high
        cut = cut or is_cut
        largest = max(largest, max(abs(vectors[V_R, first]), abs(vectors[V_R, last])) / (high - low))
    return largest, cut


@kernel
def _extend_to_ghosts(y, g, g_least, delta, least, modulus, n, n_panels, panels, cosines, vectors, centre):
    """Where the gap outside all panels would be overlapped, widen the nearest panel or open a new one.

    Without this a second patch that the start solution missed stays unseen (strip_halfspace.md 2, step 5). Returns the
    number of panels and whether anything changed.
    """
    size = y.size
    changed = False
    width = 0.0
    for p in range(n_panels):
        width = max(width, panels[2 * p + 1] - panels[2 * p])
    checked = -math.inf  # a fiftieth of the patch apart is near enough: a ghost is an overlap of the undeformed bodies
    i = 0
    while i < size:
        inside = g[i] - g_least >= delta * (1.0 - 1e-3)
        for p in range(n_panels):
            inside = inside or panels[2 * p] <= y[i] <= panels[2 * p + 1]
        if inside or (y[i] - checked < 0.02 * width and y[i] > y[0]):
            i += 1
            continue
        checked = y[i]
        u = displacement_outside(y[i], n, n_panels, panels, cosines, vectors, centre, modulus)
        if delta - (g[i] - g_least) - u <= least * delta:
            i += 1
            continue
        # overlap at y[i]: how far does it go
        k = i
        while k + 1 < size and g[k + 1] - g_least < delta:
            u = displacement_outside(y[k + 1], n, n_panels, panels, cosines, vectors, centre, modulus)
            if delta - (g[k + 1] - g_least) - u <= least * delta:
                break
            k += 1
        margin = 1 if least <= _GHOST else 0  # while the ends still move, no further than necessary
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
            panels[2 * p], panels[2 * p + 1] = low, high
            reference = 0.0
            for j in range(n):
                reference = max(reference, vectors[V_A, nearest * n + j])
            for j in range(n):
                unit = 0.5 * (cosines[j] + cosines[j + 1])
                a = max(
                    0.5 * reference * math.sqrt((high - low) / width) * math.sqrt(1.0 - unit * unit), 1e-3 * reference
                )
                vectors[V_LN_A, p * n + j] = math.log(a)
                vectors[V_ACTIVE, p * n + j] = 1.0
        else:
            p = nearest
            old_low, old_high = panels[2 * p], panels[2 * p + 1]
            panels[2 * p], panels[2 * p + 1] = min(low, old_low), max(high, old_high)
            _resample(old_low, old_high, panels[2 * p], panels[2 * p + 1], cosines, vectors, p * n)
            vectors[V_ACTIVE, p * n : p * n + n] = 1.0
        changed = True
        i = k + 2
    return n_panels, changed


@kernel
def _remove_panel(p, n, n_panels, panels, vectors):
    """Close the gap that panel p leaves in the lists."""
    for q in range(p, n_panels - 1):
        panels[2 * q], panels[2 * q + 1] = panels[2 * q + 2], panels[2 * q + 3]
        for i in range(n):
            for row in (V_LN_A, V_ACTIVE, V_P, V_A, V_HALF, V_R):
                vectors[row, q * n + i] = vectors[row, (q + 1) * n + i]


@kernel
def _remove_unloaded(n, n_panels, panels, vectors):
    """Drop the panels that carry nothing; return the number of those left."""
    p = 0
    while p < n_panels:
        loaded = False
        for i in range(n):
            loaded = loaded or vectors[V_P, p * n + i] > 0.0
        if loaded:
            p += 1
        else:
            _remove_panel(p, n, n_panels, panels, vectors)
            n_panels -= 1
    return n_panels


@kernel
def _join_panels(n, n_panels, panels, cosines, vectors):
    """Join panels that overlap into one; returns the count and whether any were joined."""
    joined = False
    p = 0
    while p < n_panels:
        q = p + 1
        while q < n_panels:
            if panels[2 * q] < panels[2 * p + 1] and panels[2 * p] < panels[2 * q + 1]:
                wider = p if panels[2 * p + 1] - panels[2 * p] >= panels[2 * q + 1] - panels[2 * q] else q
                low, high = min(panels[2 * p], panels[2 * q]), max(panels[2 * p + 1], panels[2 * q + 1])
                _resample(panels[2 * wider], panels[2 * wider + 1], low, high, cosines, vectors, wider * n)
                for i in range(n):
                    vectors[V_LN_A, p * n + i] = vectors[V_LN_A, wider * n + i]
                vectors[V_ACTIVE, p * n : p * n + n] = 1.0
                panels[2 * p], panels[2 * p + 1] = low, high
                _remove_panel(q, n, n_panels, panels, vectors)
                n_panels -= 1
                joined = True
            else:
                q += 1
        p += 1
    return n_panels, joined


@kernel
def _advance(n, n_panels, panels, vectors, load, known, gram):
    """Next half lengths and ends by Anderson's mixing over the last `DEPTH` of the `known` steps, weighted with strip loads.

    The end strips' entries of the residual V_R and of the steps stand for the ends of their panel. Steps and changes of the
    residual are kept in rings of rows.
    """
    total = n * n_panels
    if known > 0:
        row = (known - 1) % DEPTH
        for i in range(total):
            vectors[V_STEPS + row, i] = vectors[V_STEP, i]
            vectors[V_CHANGES + row, i] = vectors[V_R, i] - vectors[V_R_OLD, i]
    depth = min(known, DEPTH)
    for i in range(total):
        weight = vectors[V_P, i] * vectors[V_A, i] * vectors[V_HALF, i] / load
        place = i % n
        if place == 0 or place == n - 1:
            width = panels[2 * (i // n) + 1] - panels[2 * (i // n)]
            weight = _END_WEIGHT / (width * width)
        vectors[V_Q1, i] = weight
        vectors[V_STEP, i] = vectors[V_R, i]
        vectors[V_R_OLD, i] = vectors[V_R, i]
    for k in range(depth):
        for m in range(depth):
            product = 0.0
            for i in range(total):
                product += vectors[V_Q1, i] * vectors[V_CHANGES + k, i] * vectors[V_CHANGES + m, i]
            gram[k, m] = product
        product = 0.0
        for i in range(total):
            product += vectors[V_Q1, i] * vectors[V_CHANGES + k, i] * vectors[V_R, i]
        gram[k, depth] = product
        gram[k, k] *= 1.0 + 1e-8
        gram[k, k] += 1e-30
    for k in range(depth):
        for m in range(k + 1, depth):
            factor = gram[m, k] / gram[k, k]
            for c in range(k, depth + 1):
                gram[m, c] -= factor * gram[k, c]
    for k in range(depth - 1, -1, -1):
        for m in range(k + 1, depth):
            gram[k, depth] -= gram[k, m] * gram[m, depth]
        gram[k, depth] /= gram[k, k]
    for k in range(depth):
        for i in range(total):
            vectors[V_STEP, i] -= gram[k, depth] * (vectors[V_STEPS + k, i] + vectors[V_CHANGES + k, i])
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        for i in range(first + 1, last):
            vectors[V_STEP, i] = min(max(vectors[V_STEP, i], -0.8), 0.8)
            vectors[V_LN_A, i] += vectors[V_STEP, i]
        bound = 0.25 * (panels[2 * p + 1] - panels[2 * p])
        vectors[V_STEP, first] = min(max(vectors[V_STEP, first], -bound), bound)
        vectors[V_STEP, last] = min(max(vectors[V_STEP, last], -bound), bound)
        panels[2 * p] += vectors[V_STEP, first]
        panels[2 * p + 1] += vectors[V_STEP, last]
        vectors[V_LN_A, first], vectors[V_LN_A, last] = vectors[V_LN_A, first + 1], vectors[V_LN_A, last - 1]


@kernel
def _write(n, n_panels, panels, cosines, vectors, y, work, strips, result):
    """Loaded strips in ascending order of y into `strips`; runs of neighbours are the patches. Returns their number."""
    size = y.size
    count, patch = 0, -1
    done = -math.inf
    k = 0
    for _ in range(n_panels):  # panels in ascending order
        p = -1
        for q in range(n_panels):
            if panels[2 * q] > done and (p < 0 or panels[2 * q] < panels[2 * p]):
                p = q
        if p < 0:
            break
        done = panels[2 * p]
        centre, half = 0.5 * (panels[2 * p] + panels[2 * p + 1]), 0.5 * (panels[2 * p + 1] - panels[2 * p])
        contiguous = False
        for i in range(n):
            row = p * n + i
            if vectors[V_P, row] <= 0.0:
                contiguous = False
                continue
            if not contiguous and patch < MAX_PATCHES - 1:
                patch += 1
                result[RES_EDGES + 2 * patch] = centre + half * cosines[i]
            contiguous = True
            result[RES_EDGES + 2 * patch + 1] = centre + half * cosines[i + 1]
            at = vectors[V_Y, row]
            k = locate(y, size, at, k)
            t = (at - y[k]) / (y[k + 1] - y[k])
            strips[STRIP_Y, count] = at
            strips[STRIP_DY, count] = 2.0 * vectors[V_HALF, row]
            strips[STRIP_XC, count] = vectors[V_XC, row]
            strips[STRIP_A, count] = vectors[V_A, row]
            strips[STRIP_P0, count] = vectors[V_P, row]
            strips[STRIP_ASPECT, count] = (1.0 - t) * work[LOG_ASPECT, k] + t * work[LOG_ASPECT, k + 1]
            strips[STRIP_PATCH, count] = patch
            count += 1
    return count


@kernel
def strip_halfspace(y, g, A, xc, case, rule, tables, space, strips, result):
    """Solve the normal problem; same answers as `analyn`, which gives the start and the local aspect ratios.

    A filled `space.memory` is the start instead of ANALYN's patch; it is left filled for the next call. With status 5, not
    converged, the answer is the last iterate if that was nearly at rest, and ANALYN's otherwise.
    """
    memory, vectors = space.memory, space.vectors
    n_strips = analyn(y, g, A, xc, case, rule.nodes, rule.weights, space.grid, strips, result)
    if n_strips == 0:
        memory[MEM_PANELS] = 0.0
        return 0
    n = rule.nodes.size
    size = y.size
    modulus = case[CASE_G] / (1.0 - case[CASE_NU])
    by_load = case[CASE_LOAD_KIND] != APPROACH
    g_least = result[RES_TOUCH]
    amount = case[CASE_LOAD] if by_load else case[CASE_LOAD] - g_least
    panels = memory[MEM_ENDS : MEM_ENDS + 2 * MAX_PATCHES]
    start_low, start_high = result[RES_EDGES], result[RES_EDGES + 2 * int(strips[STRIP_PATCH, n_strips - 1]) + 1]
    skewed = False
    for i in range(1, size):
        skewed = skewed or abs(xc[i] - xc[0]) > 1e-9 * (y[size - 1] - y[0])
    n_panels = int(memory[MEM_PANELS])
    if n_panels > 0:
        vectors[V_ACTIVE, : n_panels * n] = 1.0
        for i in range(n_panels * n):
            vectors[V_LN_A, i] = memory[MEM_LN_A + i]
        # the panels move as ANALYN's patch has moved: a mean shift, small against the patch or not to be believed
        shift = 0.5 * (start_low + start_high - memory[MEM_START] - memory[MEM_START + 1])
        shift = shift if abs(shift) < 0.02 * (start_high - start_low) else 0.0
        for p in range(n_panels):
            panels[2 * p] += shift
            panels[2 * p + 1] += shift
            panels[2 * p], panels[2 * p + 1] = max(panels[2 * p], y[0]), min(panels[2 * p + 1], y[size - 1])
            if not panels[2 * p] < panels[2 * p + 1]:
                n_panels = 0  # the memory is of another place
    if n_panels == 0:
        n_panels = _start_panels(n_strips, n, strips, result, panels, rule.cosines, vectors)

    converged = False
    delta, iteration, known, error, load = 0.0, 0, 0, math.inf, 0.0
    for iteration in range(MAX_ITERATIONS):
        total = n * n_panels
        _lay_panels(y, g, A, xc, g_least, space.grid, panels, n_panels, rule.cosines, vectors)
        distances(panels, n_panels, rule.cosines, rule.cosine_logs, vectors, space.logs)
        _half_lengths(vectors, n, n_panels)
        assemble(
            n, n_panels, vectors, space.logs, tables.centre, tables.plane, skewed, modulus, space.matrix, space.logs
        )
        delta = solve_active(n, n_panels, vectors, space.matrix, space.lu, by_load, amount, iteration < 8)
        error, load = math.inf, 0.0
        if not abs(delta) < math.inf:
            break
        # the strip ends: stretch each strip by the ratio of the overlap at its ends to the one that a parabola leaves
        error, load = 0.0, 0.0
        for i in range(total):
            vectors[V_R, i] = 0.0
            if vectors[V_P, i] > 0.0:
                u = 0.0
                for j in range(total):
                    u += space.logs[i, j] * vectors[V_P, j]
                ratio = (delta - vectors[V_GAP, i] - u) / (vectors[V_CURVATURE, i] * vectors[V_A, i] ** 2)
                r = 0.5 * math.log(min(max(ratio, 0.2), 5.0))
                vectors[V_R, i] = r
                weight = vectors[V_P, i] * vectors[V_A, i] * vectors[V_HALF, i]
                load += weight
                error += 0.0 if i % n in (0, n - 1) else weight * abs(r)
        damping = 0.75 ** max(iteration - _MIXED_ITERATIONS, 0)
        before = n_panels
        n_panels = _remove_unloaded(n, n_panels, panels, vectors)
        if n_panels == 0:
            break
        moved, restructured = _end_moves(y, n, n_panels, panels, rule.cosines, vectors, damping)
        if restructured or n_panels < before:
            known = 0
        settled = not restructured and error < TOLERANCE * load and moved < 2.0 * TOLERANCE
        ghosts = False
        if settled or iteration == 1:
            least = _GHOST if settled else _EARLY_GHOST
            n_panels, ghosts = _extend_to_ghosts(
                y, g, g_least, delta, least, modulus, n, n_panels, panels, rule.cosines, vectors, tables.centre
            )
            if settled and not ghosts:
                converged = True
                break
        if ghosts:
            known = 0
        else:
            _advance(n, n_panels, panels, vectors, load, known, space.lu)
            known += 1
        if restructured:
            vectors[V_ACTIVE, : n_panels * n] = 1.0
        n_panels, joined = _join_panels(n, n_panels, panels, rule.cosines, vectors)
        if restructured or joined or iteration >= _MIXED_ITERATIONS:
            known = 0

    result[RES_ITERATIONS] = iteration + 1.0
    if not converged and not (n_panels > 0 and error < USABLE * load):  # ANALYN's answer is still in place
        result[RES_STATUS] = 5.0
        memory[MEM_PANELS] = 0.0
        return n_strips
    memory[MEM_PANELS], memory[MEM_START], memory[MEM_START + 1] = n_panels, start_low, start_high
    for i in range(n_panels * n):
        memory[MEM_LN_A + i] = vectors[V_LN_A, i]
    count = _write(n, n_panels, panels, rule.cosines, vectors, y, space.grid, strips, result)
    N = 0.0
    for i in range(count):
        N += 0.5 * math.pi * strips[STRIP_P0, i] * strips[STRIP_A, i] * strips[STRIP_DY, i]
    if by_load and N > 0.0:  # end strips that would pull carry nothing: 1e-5 of the load goes to the others
        for i in range(count):
            strips[STRIP_P0, i] *= amount / N
    if not converged:
        result[RES_STATUS] = 5.0
    elif result[RES_STATUS] == 4.0 and not (panels[0] <= y[0] or panels[2 * n_panels - 1] >= y[size - 1]):
        result[RES_STATUS] = 1.0
    N = amount if by_load else N
    # d(ln N)/d(ln delta) of ANALYN, exact in Hertz contact: the strips' semi-ellipses cannot show a punch's edge pressure
    result[RES_STIFFNESS] *= (result[RES_APPROACH] - g_least) / result[RES_N] * N / delta if delta > 0.0 else 0.0
    result[RES_N] = N
    result[RES_APPROACH] = delta + g_least
    return count
