"""The linear system of interacting strips: influence matrix, active-set solution, displacement at strip edges."""

import math

from contact._jit import kernel
from contact.normal.influence import anywhere, at_centre, in_row, row_at

# vectors[ROW, i]: per strip of all panels
(
    V_Y,
    V_HALF,
    V_GAP,
    V_A,
    V_CURVATURE,
    V_XC,
    V_P,
    V_Q1,
    V_Q2,
    V_R,
    V_R_OLD,
    V_LN_A,
    V_STEP,
    V_ACTIVE,
    V_INDEX,
    V_FLOORED,  # the half length stands at its lower bound
) = range(16)
#: Steps and changes of the residual of the last iterations.
DEPTH = 3
V_STEPS, V_CHANGES = 16, 16 + DEPTH
N_VECTOR_ROWS = 16 + 2 * DEPTH


@kernel
def distances(panels, n_panels, cosines, cosine_logs, vectors, logs):
    """ln|Y_k - y_i| of every strip i to every panel edge k, into logs[i, k]; n + 1 edges a panel.

    Within a panel the strips sit at fixed cosines, so this is a constant table plus ln of the panel's half width.
    """
    n = cosines.size - 1
    for p in range(n_panels):
        half = 0.5 * (panels[2 * p + 1] - panels[2 * p])
        ln_half = math.log(half)
        for q in range(n_panels):
            centre = 0.5 * (panels[2 * q] + panels[2 * q + 1])
            half_q = 0.5 * (panels[2 * q + 1] - panels[2 * q])
            for i in range(n):
                row = p * n + i
                for k in range(n + 1):
                    if p == q:
                        logs[row, q * (n + 1) + k] = ln_half + cosine_logs[i, k]
                    else:
                        distance = abs(centre + half_q * cosines[k] - vectors[V_Y, row])
                        logs[row, q * (n + 1) + k] = math.log(max(distance, 1e-12 * half))


@kernel
def assemble(n, n_panels, vectors, logs, centre, plane, skewed, modulus, matrix, edges):
    """Displacement at strip i by unit peak pressure on strip j: on the centre line into matrix[i, j], at the ends into edges.

    Under yaw the latter is the mean of both ends. `edges` may be `logs`, whose entries are not needed any more then.
    """
    total = n * n_panels
    for j in range(total):
        vectors[V_Q1, j] = math.log(vectors[V_A, j])
        vectors[V_Q2, j] = 1.0 / vectors[V_A, j]
    for i in range(total):
        a_i, xc_i, ln_i = vectors[V_A, i], vectors[V_XC, i], vectors[V_Q1, i]
        for j in range(total):
            ln_a, inverse = vectors[V_Q1, j], vectors[V_Q2, j]
            k = j + j // n  # first of its two edges
            left, right = logs[i, k] - ln_a, logs[i, k + 1] - ln_a
            offset = (xc_i - vectors[V_XC, j]) * inverse if skewed else 0.0
            sign = 1.0 if i == j else -1.0
            if abs(offset) > 1e-9:
                low, high = anywhere(plane, abs(offset), left), anywhere(plane, abs(offset), right)
            else:
                low, high = at_centre(centre, left), at_centre(centre, right)
            scale = vectors[V_A, j] / (math.pi * modulus)
            matrix[i, j] = scale * abs(high + sign * low)
            if abs(offset) > 1e-9:
                X = abs(a_i * inverse + offset)
                total_end = abs(anywhere(plane, X, right) + sign * anywhere(plane, X, left))
                X = abs(a_i * inverse - offset)
                total_end += abs(anywhere(plane, X, right) + sign * anywhere(plane, X, left))
                edges[i, j] = 0.5 * scale * total_end
            else:
                row, share, ln_X = row_at(a_i * inverse, ln_i - ln_a)
                low, high = in_row(plane, row, share, left - ln_X), in_row(plane, row, share, right - ln_X)
                edges[i, j] = scale * abs(high + sign * low)


@kernel
def displacement_outside(at, n, n_panels, panels, cosines, vectors, centre, modulus):
    """Displacement at a point of the centre line that lies in no panel."""
    u = 0.0
    for p in range(n_panels):
        middle = 0.5 * (panels[2 * p] + panels[2 * p + 1])
        half = 0.5 * (panels[2 * p + 1] - panels[2 * p])
        for k in range(n):
            j = p * n + k
            if vectors[V_P, j] == 0.0:
                continue
            a = vectors[V_A, j]
            near = max(abs(middle + half * cosines[k] - at), 1e-12 * half)
            far = max(abs(middle + half * cosines[k + 1] - at), 1e-12 * half)
            low, high = at_centre(centre, math.log(near / a)), at_centre(centre, math.log(far / a))
            u += vectors[V_P, j] * a / (math.pi * modulus) * abs(high - low)
    return u


@kernel
def _eliminate(lu, m, first, second):
    """Solve lu·x = first and = second in place by Gaussian elimination; the influence matrix needs no pivoting."""
    for k in range(m):
        inverse = 1.0 / lu[k, k]
        pivot = lu[k]
        for i in range(k + 1, m):
            row = lu[i]
            factor = row[k] * inverse
            for j in range(k + 1, m):
                row[j] -= factor * pivot[j]
            first[i] -= factor * first[k]
            second[i] -= factor * second[k]
    for k in range(m - 1, -1, -1):
        inverse = 1.0 / lu[k, k]
        first[k] *= inverse
        second[k] *= inverse
        for i in range(k):
            first[i] -= lu[i, k] * first[k]
            second[i] -= lu[i, k] * second[k]


@kernel
def solve_active(n, n_panels, vectors, matrix, lu, by_load, amount):
    """Peak pressures that close the gap of every loaded strip; return the approach above first touch.

    p = delta·q1 + q2 with q1 the answer to a unit approach, so load- and approach-prescribed differ in one line. Strips under
    tension leave the active set, separated strips that would overlap enter it; at most 20 rounds.
    """
    total = n * n_panels
    delta = 0.0
    for _ in range(20):
        m = 0
        for i in range(total):
            if vectors[V_ACTIVE, i] != 0.0:
                vectors[V_INDEX, m] = i
                m += 1
        for r in range(m):
            i = int(vectors[V_INDEX, r])
            vectors[V_Q1, r], vectors[V_Q2, r] = 1.0, -vectors[V_GAP, i]
            for c in range(m):
                lu[r, c] = matrix[i, int(vectors[V_INDEX, c])]
        _eliminate(lu, m, vectors[V_Q1], vectors[V_Q2])
        stiffness, offset = 0.0, 0.0
        for r in range(m):
            i = int(vectors[V_INDEX, r])
            w = math.pi * vectors[V_A, i] * vectors[V_HALF, i]  # pi/2 a times the full width
            stiffness += w * vectors[V_Q1, r]
            offset += w * vectors[V_Q2, r]
        delta = (amount - offset) / stiffness if by_load and stiffness > 0.0 else amount
        vectors[V_P, :total] = 0.0
        for r in range(m):
            vectors[V_P, int(vectors[V_INDEX, r])] = delta * vectors[V_Q1, r] + vectors[V_Q2, r]
        changed = False
        for i in range(total):
            place = i % n
            if vectors[V_ACTIVE, i] != 0.0:
                neighbour = i + 1 if place == 0 else i - 1
                at_end = place in (0, n - 1) and vectors[V_P, neighbour] > 0.0
                if vectors[V_P, i] < 0.0 and not at_end:
                    vectors[V_ACTIVE, i] = 0.0
                    changed = True
            else:
                u = 0.0
                for r in range(m):
                    j = int(vectors[V_INDEX, r])
                    u += matrix[i, j] * vectors[V_P, j]
                if delta - vectors[V_GAP, i] - u > 1e-4 * delta:
                    vectors[V_ACTIVE, i] = 1.0
                    changed = True
        if not changed:
            break
        if m == 0:
            break
    for i in range(total):  # ends kept in the set for smoothness do not pull
        if vectors[V_P, i] < 0.0:
            vectors[V_P, i] = 0.0
    return delta
