"""Tangent of the strip half space: how its strips follow a small change of the gap or of the approach.

Of a patch at rest the unknowns are ln a of the inner strips and both ends of the panel. Their conditions, the residuals r of
the half lengths and the moves of the ends, depend on them, on the pressures p, and on gap g, curvature and approach:

    M p = delta - g,    r_i = 1/2 ln[(delta - g_i - sum E_im p_m)/(C_i a_i²)] = 0,    moves(p) = 0

with the influence M on the middles and E on the ends of strips, both with their factors (`factors`). `linearise` finds the
inverses of M and of the Jacobian of the conditions, once for a solution. `follow` then takes a neighbouring gap for the price
of a few products. A change of ln a_k changes column k of M and E, row k of E and, by the a/b of the panel, all factors alike.
So all columns together take about as long as two residuals.

This holds for a single panel of strips in line that has come to rest, with all inner strips loaded and none at a bound. Other
patches are iterated anew.
"""

import math

from contact.core import entry, kernel
from contact.kernels import cubic
from contact.kernels.arrays import Case, Result, Samples, Workspace
from contact.kernels.enumerations import Status
from contact.kernels.normal.analyn import prepare
from contact.kernels.normal.descent import END_LENGTH
from contact.kernels.normal.ends import end_move
from contact.kernels.normal.factors import fill_factor_slopes
from contact.kernels.normal.influence import (
    LN_T_LOW,
    N_T,
    PER_T_STEP,
    PER_X_STEP,
    T_STEP,
    X_MAX,
    column,
    logarithm,
    row_at,
)
from contact.kernels.normal.lay import least_point
from contact.kernels.normal.orientation import turn_back, turn_samples
from contact.kernels.normal.panels import lay_panels
from contact.kernels.normal.start import MEM_ENDS, MEM_IMAGE, MEM_PANELS
from contact.kernels.normal.strip_halfspace import write_strips
from contact.kernels.rows import Sample, Strip, Tangent, Vector

#: Steps of ln a, of an end over the width of the panel, and of the pressures in the rules of the ends.
_STEP, _END_STEP, _PRESSURE_STEP = 1e-6, 1e-6, 1e-6
#: Distance from a bound of a half length, over itself, below which it counts as at the bound.
_AT_BOUND = 1e-6


@kernel
def _invert(matrix, n, swaps):
    """Replace a matrix by its inverse. Return whether it has one."""
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[best, k]):
                best = i
        swaps[k] = best
        if best != k:
            for j in range(n):
                matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
        if not abs(matrix[k, k]) > 1e-300:
            return False
        inverse = 1.0 / matrix[k, k]
        matrix[k, k] = 1.0
        for j in range(n):
            matrix[k, j] *= inverse
        for i in range(n):
            if i != k:
                factor = matrix[i, k]
                matrix[i, k] = 0.0
                for j in range(n):
                    matrix[i, j] -= factor * matrix[k, j]
    for k in range(n - 1, -1, -1):
        best = int(swaps[k])
        if best != k:
            for i in range(n):
                matrix[i, k], matrix[i, best] = matrix[i, best], matrix[i, k]
    return True


@kernel
def _times(matrix, n, vector, out):
    """Fill `out` with the product of matrix and vector."""
    for i in range(n):
        total = 0.0
        for j in range(n):
            total += matrix[i, j] * vector[j]
        out[i] = total


@kernel
def _add_products(n, row, matrix, out):
    """Add the product of a row and a matrix to `out`."""
    for m in range(n):
        factor = row[m]
        for s in range(n):
            out[s] += factor * matrix[m, s]


@kernel
def _with_slopes(plane, i, u, log_t):
    """Return the value of `influence.in_row`, and its slopes by `log_t` and by `u`."""
    v = (log_t - LN_T_LOW) * PER_T_STEP
    before, beyond = not v > 0.0, max(v - (N_T - 1.0), 0.0)
    v = min(0.0 if before else v, N_T - 1.000001)
    k = int(v)
    v -= k
    rise, next_rise = plane[i, k + 1] - plane[i, k], plane[i + 1, k + 1] - plane[i + 1, k]
    low, high = plane[i, k] + v * rise, plane[i + 1, k] + v * next_rise
    by_t = 0.0 if before else PER_T_STEP * (rise + u * (next_rise - rise))
    far = 0.5 * math.pi
    return low + u * (high - low) + far * T_STEP * beyond, far if beyond > 0.0 else by_t, high - low


@kernel
def _edge(plane, X, of, near, far, inside):
    """Return the displacement at the end of a strip by a strip with half length `of`, with pi E* = 1, and its slopes.

    The end is `X` times `of` away along x, `near` and `far` are the logarithms of the distances of the sides over `of`. The
    slopes are those by ln X and by the logarithm of both distances.
    """
    row, share, ln_X = row_at(X, logarithm(X))
    low, low_t, low_u = _with_slopes(plane, row, share, near - ln_X)
    high, high_t, high_u = _with_slopes(plane, row, share, far - ln_X)
    sign = 1.0 if inside else -1.0
    value, by_t, by_u = high + sign * low, high_t + sign * low_t, high_u + sign * low_u
    by_X = by_u * X * PER_X_STEP if X < X_MAX else -2.0 * by_u / (X * X) - by_t
    scale = of if value >= 0.0 else -of
    return scale * value, scale * by_X, scale * by_t


@kernel
def _fits(n, workspace, status):
    """Return whether the last solution is of the kind that has a tangent."""
    vectors, memory = workspace.space.vectors, workspace.space.memory
    if workspace.space.tangent.shape[1] != n or workspace.rule.columns.shape[1] != n or memory[MEM_PANELS] != 1.0:
        return False
    if status != Status.OK and status != Status.SATURATED:
        return False
    for i in range(n):
        inner = 0 < i < n - 1
        if (
            vectors[Vector.XC, i] != 0.0
            or vectors[Vector.ACTIVE, i] == 0.0
            or (inner and not vectors[Vector.P, i] > 0.0)
        ):
            return False
        if inner and vectors[Vector.A, i] <= vectors[Vector.FLOOR, i] * (1.0 + _AT_BOUND):
            return False
    return True


@kernel
def loaded_strips(workspace):
    """Return the number of strips that the last solution, of a single panel, has written."""
    count = 0
    for i in range(workspace.rule.cosines.size - 1):
        count += 1 if workspace.space.vectors[Vector.P, i] > 0.0 else 0
    return count


@kernel
def _fill_end_slopes(n, p, cosines, vectors, tangent):
    """Fill the slopes of the moves of both ends by the four pressures beside each."""
    for end in range(2):
        first, step = (0, 1) if end == 0 else (n - 1, -1)
        row = tangent[tangent.shape[0] - len(Tangent) + Tangent.AT_LOW + end]
        size = _PRESSURE_STEP * p[first + step]
        before = 0.0
        for q in range(-1, 4):
            for k in range(4):
                at = first + k * step
                value = p[at] + (size if k == q else 0.0)
                vectors[Vector.P, at] = max(value, 0.0)
                if k == 0:
                    vectors[Vector.END, first] = value
            move = end_move(vectors, n, first, step, cosines, False, False, False, False)
            if q < 0:
                before = move
            else:
                row[q] = (move - before) / size
        for k in range(4):
            vectors[Vector.P, first + k * step] = max(p[first + k * step], 0.0)


@kernel
def _end_slope(tangent, end, n, p):
    """Return the change of the move of an end by changes `p` of the pressures."""
    row = tangent[tangent.shape[0] - len(Tangent) + Tangent.AT_LOW + end]
    first, step = (0, 1) if end == 0 else (n - 1, -1)
    total = 0.0
    for q in range(4):
        total += row[q] * p[first + q * step]
    return total


@entry
def linearise(sep: Samples, case: Case, workspace: Workspace, result: Result) -> bool:
    """Fill `workspace.space.tangent` for the solution that `press_case` has just found. Return whether it has a tangent.

    `sep` is its separation. If it has none, `tangent` says so to `follow`.
    """
    tangent, vectors = workspace.space.tangent, workspace.space.vectors
    memory, matrix = workspace.space.memory, workspace.space.matrix
    cosines, logs = workspace.rule.cosines, workspace.rule.cosine_logs
    columns, plane = workspace.rule.columns, workspace.tables.plane
    n = cosines.size - 1
    if not _fits(n, workspace, result.status):
        return False
    turned, work = workspace.space.turned, workspace.space.grid
    image = memory[MEM_IMAGE] > 0.0
    samples = turn_samples(sep, image, turned)
    cubic.slopes(samples.y, samples.g, samples.y.size, work[Sample.GAP_SLOPE])
    tail = tangent.shape[0] - len(Tangent)
    inverse, edges, by_x, conditions = tangent[:n], tangent[n : 2 * n], tangent[2 * n : 3 * n], tangent[3 * n : 4 * n]
    gap, curvature, overlap, p, a = (
        tangent[tail + Tangent.GAP],
        tangent[tail + Tangent.CURVATURE],
        tangent[tail + Tangent.OVERLAP],
        tangent[tail + Tangent.P],
        tangent[tail + Tangent.A],
    )
    one, other, numbers = tangent[tail + Tangent.ONE], tangent[tail + Tangent.OTHER], tangent[tail + Tangent.NUMBERS]
    ln_a, by_width, narrowed = vectors[Vector.STEP, :n], vectors[Vector.R_OLD, :n], vectors[Vector.U, :n]
    of_middle, of_ends = vectors[Vector.OF_MIDDLE, :n], vectors[Vector.OF_ENDS, :n]
    middles_by_ratio, ends_by_ratio, shares = vectors[Vector.Q1], vectors[Vector.Q2], vectors[Vector.DIFFERENCE]
    changes = workspace.space.lu
    low, high = memory[MEM_ENDS], memory[MEM_ENDS + 1]
    delta = result.approach - result.touch
    unit = 1.0 / (math.pi * (case.G / (1.0 - case.nu)))
    ln_half = math.log(0.5 * (high - low))
    panels = workspace.space.iterates[workspace.space.iterates.shape[0] - 1]
    panels[0], panels[1] = low, high
    lay_panels(samples, result.touch, 0.0, panels, 1, workspace)
    for i in range(n):
        gap[i], curvature[i] = vectors[Vector.GAP, i], vectors[Vector.CURVATURE, i]
        a[i], ln_a[i] = vectors[Vector.A, i], math.log(vectors[Vector.A, i])
        one[i] = delta - gap[i]
        for k in range(n):
            inverse[i, k] = matrix[k, i]
    if not _invert(inverse, n, other):
        return False
    _times(inverse, n, one, p)
    fill_factor_slopes(n, high - low, _STEP, workspace)
    # displacements of the ends, and their responses to the half lengths at the same pressures, in `conditions`
    for i in range(n):
        at, u, of_own, of_width, factor = logs[i], 0.0, 0.0, 0.0, unit * of_ends[i]
        for m in range(n):
            shift, bears = ln_half - ln_a[m], p[m] if p[m] > 0.0 else 0.0
            value, by_X, by_Y = _edge(plane, a[i] / a[m], a[m], at[m] + shift, at[m + 1] + shift, i == m)
            edges[i, m] = factor * value if bears > 0.0 else 0.0
            u += edges[i, m] * bears
            of_width += factor * by_Y * bears
            # all lengths together scale the displacement, so its slope by ln a of the other strip follows
            conditions[i, m] = factor * (value - by_Y - (0.0 if i == m else by_X)) * bears
            of_own += 0.0 if i == m else factor * by_X * bears
        conditions[i, i] += of_own
        by_ratio = ends_by_ratio[i] * u
        for m in range(n):
            conditions[i, m] += by_ratio * shares[m]
        overlap[i], by_width[i] = delta - gap[i] - u, of_width - by_ratio
        narrowed[i] = 0.0
    # responses of the pressures
    for s in range(n):
        column(columns, s, ln_a[s] + _STEP - ln_half, a[s] * math.exp(_STEP) * unit, of_middle, one)
        for i in range(n):
            change = (one[i] - matrix[s, i]) / _STEP * p[s] + middles_by_ratio[i] * (delta - gap[i]) * shares[s]
            narrowed[i] += matrix[s, i] * p[s] - change
            changes[i, s] = -change
    for i in range(n):
        for s in range(n):
            by_x[i, s] = 0.0
        _add_products(n, inverse[i], changes, by_x[i])
    for i in range(n):
        _add_products(n, edges[i], by_x, conditions[i])
    for i in range(n):  # the end strips follow their neighbours
        by_x[i, 1] += by_x[i, 0]
        by_x[i, n - 2] += by_x[i, n - 1]
        conditions[i, 1] += conditions[i, 0]
        conditions[i, n - 2] += conditions[i, n - 1]
        for s in range(1, n - 1):
            conditions[i, s] = -0.5 * conditions[i, s] / overlap[i] - (1.0 if i == s else 0.0)
    # responses to the ends, over the width
    width = high - low
    for end in range(2):
        s = 0 if end == 0 else n - 1
        panels[0], panels[1] = (
            low + (_END_STEP * width if end == 0 else 0.0),
            high + (_END_STEP * width if end == 1 else 0.0),
        )
        lay_panels(samples, result.touch, 0.0, panels, 1, workspace)
        wider = -1.0 if end == 0 else 1.0
        for i in range(n):
            one[i] = -(vectors[Vector.GAP, i] - gap[i]) / _END_STEP - wider * narrowed[i]
        _times(inverse, n, one, other)
        for i in range(n):
            by_x[i, s] = other[i]
        for i in range(1, n - 1):
            u = wider * by_width[i] + (vectors[Vector.GAP, i] - gap[i]) / _END_STEP
            for m in range(n):
                u += edges[i, m] * other[m]
            relative = (vectors[Vector.CURVATURE, i] - curvature[i]) / (_END_STEP * curvature[i])
            conditions[i, s] = -0.5 * (u / overlap[i] + relative)
    _fill_end_slopes(n, p, cosines, vectors, tangent)
    for s in range(n):
        for i in range(n):
            one[i] = by_x[i, s]
        conditions[0, s] = _end_slope(tangent, 0, n, one)
        conditions[n - 1, s] = _end_slope(tangent, 1, n, one)
    if not _invert(conditions, n, other):
        return False
    load = 0.0
    for i in range(n):
        half = 0.25 * width * (cosines[i + 1] - cosines[i])
        load += math.pi * max(p[i], 0.0) * a[i] * half
    numbers[0], numbers[1], numbers[2], numbers[3] = low, high, delta, result.N / load
    numbers[4] = 1.0 if image else 0.0
    return True


@entry
def follow(sep: Samples, amount: float, workspace: Workspace, result: Result) -> int:
    """Fill strips and result for a neighbouring separation at the approach `amount`. Return the number of strips.

    `workspace.space.tangent` is that of `linearise`. `result` needs no more than what the tangential problem reads.
    """
    tangent, vectors = workspace.space.tangent, workspace.space.vectors
    n = workspace.rule.cosines.size - 1
    tail = tangent.shape[0] - len(Tangent)
    inverse, edges, by_x, conditions = tangent[:n], tangent[n : 2 * n], tangent[2 * n : 3 * n], tangent[3 * n : 4 * n]
    one, other, numbers = tangent[tail + Tangent.ONE], tangent[tail + Tangent.OTHER], tangent[tail + Tangent.NUMBERS]
    gap, curvature, overlap = (
        tangent[tail + Tangent.GAP],
        tangent[tail + Tangent.CURVATURE],
        tangent[tail + Tangent.OVERLAP],
    )
    low, high, delta = numbers[0], numbers[1], numbers[2]
    samples, work = turn_samples(sep, numbers[4] > 0.0, workspace.space.turned), workspace.space.grid
    y, g, size = samples.y, samples.g, samples.y.size
    cubic.slopes(y, g, size, work[Sample.GAP_SLOPE])
    _, touch = least_point(y, g, work[Sample.GAP_SLOPE], size)
    prepare(y, g, samples.A, size, touch, amount - touch, work)
    panels = workspace.space.iterates[workspace.space.iterates.shape[0] - 1]
    panels[0], panels[1] = low, high
    lay_panels(samples, touch, 0.0, panels, 1, workspace)
    deeper = amount - touch - delta
    for i in range(n):
        one[i] = deeper - (vectors[Vector.GAP, i] - gap[i])
    _times(inverse, n, one, other)  # the pressures, if lengths and ends stayed
    for i in range(1, n - 1):
        u = 0.0
        for m in range(n):
            u += edges[i, m] * other[m]
        relative = (vectors[Vector.CURVATURE, i] - curvature[i]) / curvature[i]
        one[i] = -0.5 * ((one[i] - u) / overlap[i] - relative)
    one[0], one[n - 1] = -_end_slope(tangent, 0, n, other), -_end_slope(tangent, 1, n, other)
    steps = vectors[Vector.STEP]
    _times(conditions, n, one, steps)
    width = high - low
    panels[0], panels[1] = low + width * steps[0], high + width * steps[n - 1]
    lay_panels(samples, touch, 0.0, panels, 1, workspace)
    for i in range(n):
        p, k = tangent[tail + Tangent.P, i] + other[i], min(max(i, 1), n - 2)
        for s in range(n):
            p += by_x[i, s] * steps[s]
        vectors[Vector.P, i] = max(p, 0.0) * numbers[3]
        a = tangent[tail + Tangent.A, k] * math.exp(steps[k])
        vectors[Vector.A, i] = a if i == k else END_LENGTH * a
    count = write_strips(samples, 1, panels, False, workspace, result)
    strips, N, area = workspace.strips, 0.0, 0.0
    for i in range(count):
        N += 0.5 * math.pi * strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        area += 2.0 * strips[Strip.A, i] * strips[Strip.DY, i]
    result.N, result.approach, result.touch, result.area = N, amount, touch, area
    if numbers[4] > 0.0:
        turn_back(count, strips, result.edges)
    return count
