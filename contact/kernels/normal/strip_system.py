"""The linear system of interacting strips: influence matrix, active-set solution, displacement at strip edges."""

import math

from contact._jit import kernel
from contact.kernels.layout import Vector
from contact.kernels.normal.influence import anywhere, at_centre, column, in_row, row_at


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
                        distance = abs(centre + half_q * cosines[k] - vectors[Vector.Y, row])
                        logs[row, q * (n + 1) + k] = math.log(max(distance, 1e-12 * half))


@kernel
def assemble(n, n_panels, panels, vectors, logs, centre, columns, plane, skewed, modulus, matrix):
    """Displacement on the centre line of strip i by unit peak pressure on strip j, into matrix[j, i]."""
    total = n * n_panels
    tabulated = not skewed and columns.shape[1] == n
    for j in range(total):
        panel = j // n
        first = panel * n
        a, k = vectors[Vector.A, j], j + panel  # k: the first of its two edges
        scale = a / (math.pi * modulus)
        ln_a = math.log(a)
        for i in range(total):
            if tabulated and i // n == panel:
                continue
            left, right = logs[i, k] - ln_a, logs[i, k + 1] - ln_a
            sign = 1.0 if i == j else -1.0
            offset = abs(vectors[Vector.XC, i] - vectors[Vector.XC, j]) / a
            if offset > 1e-9:
                low, high = anywhere(plane, offset, left), anywhere(plane, offset, right)
            else:
                low, high = at_centre(centre, left), at_centre(centre, right)
            matrix[j, i] = scale * abs(high + sign * low)
        if tabulated:
            half = 0.5 * (panels[2 * panel + 1] - panels[2 * panel])
            column(columns, j - first, ln_a - math.log(half), scale, matrix[j, first : first + n])


@kernel
def edge_displacements(n, n_panels, vectors, logs, plane, modulus):
    """Displacement at the ends of every loaded strip into Vector.U."""
    total = n * n_panels
    for j in range(total):
        vectors[Vector.Q1, j] = math.log(vectors[Vector.A, j])
        vectors[Vector.Q2, j] = 1.0 / vectors[Vector.A, j]
        vectors[Vector.R, j] = vectors[Vector.P, j] * vectors[Vector.A, j] / (math.pi * modulus)
    for i in range(total):
        vectors[Vector.U, i] = 0.0
        if vectors[Vector.P, i] == 0.0:
            continue
        a, ln_a = vectors[Vector.A, i], vectors[Vector.Q1, i]
        u = 0.0
        for p in range(n_panels):
            at = logs[i, p * (n + 1) : (p + 1) * (n + 1)]
            for j in range(n):
                J = p * n + j
                row, share, ln_X = row_at(a * vectors[Vector.Q2, J], ln_a - vectors[Vector.Q1, J])
                ln_X += vectors[Vector.Q1, J]
                low, high = in_row(plane, row, share, at[j] - ln_X), in_row(plane, row, share, at[j + 1] - ln_X)
                u += vectors[Vector.R, J] * (low + high if i == J else abs(high - low))
        vectors[Vector.U, i] = u


@kernel
def skewed_edge_displacements(n, n_panels, vectors, logs, plane, modulus):
    """As `edge_displacements` under yaw: the mean of both ends of strips that lie off each other's centre."""
    total = n * n_panels
    for i in range(total):
        vectors[Vector.U, i] = 0.0
        if vectors[Vector.P, i] == 0.0:
            continue
        u = 0.0
        for j in range(total):
            a, k = vectors[Vector.A, j], j + j // n
            ln_a = math.log(a)
            left, right = logs[i, k] - ln_a, logs[i, k + 1] - ln_a
            for side in (-1.0, 1.0):
                X = abs(vectors[Vector.A, i] + side * (vectors[Vector.XC, i] - vectors[Vector.XC, j])) / a
                low, high = anywhere(plane, X, left), anywhere(plane, X, right)
                u += 0.5 * vectors[Vector.P, j] * a * (low + high if i == j else abs(high - low))
        vectors[Vector.U, i] = u / (math.pi * modulus)


@kernel
def displacement_outside(at, n, n_panels, panels, cosines, vectors, centre, modulus):
    """Displacement at a point of the centre line that lies in no panel."""
    u = 0.0
    for p in range(n_panels):
        middle = 0.5 * (panels[2 * p] + panels[2 * p + 1])
        half = 0.5 * (panels[2 * p + 1] - panels[2 * p])
        for k in range(n):
            j = p * n + k
            if vectors[Vector.P, j] == 0.0:
                continue
            a = vectors[Vector.A, j]
            near = max(abs(middle + half * cosines[k] - at), 1e-12 * half)
            far = max(abs(middle + half * cosines[k + 1] - at), 1e-12 * half)
            low, high = at_centre(centre, math.log(near / a)), at_centre(centre, math.log(far / a))
            u += vectors[Vector.P, j] * a / (math.pi * modulus) * abs(high - low)
    return u


@kernel
def _eliminate(lu, m, first, second):
    """Solve lu·x = first and = second in place by Gaussian elimination; the influence matrix needs no pivoting.

    Two pivots at a time: a row is read and written half as often.
    """
    for k in range(0, m - 1, 2):
        above, below = lu[k], lu[k + 1]
        inverse = 1.0 / above[k]
        factor = below[k] * inverse
        for j in range(k + 1, m):
            below[j] -= factor * above[j]
        first[k + 1] -= factor * first[k]
        second[k + 1] -= factor * second[k]
        across, next_inverse = above[k + 1], 1.0 / below[k + 1]
        for i in range(k + 2, m):
            row = lu[i]
            f = row[k] * inverse
            h = (row[k + 1] - f * across) * next_inverse
            for j in range(k + 2, m):
                row[j] -= f * above[j] + h * below[j]
            first[i] -= f * first[k] + h * first[k + 1]
            second[i] -= f * second[k] + h * second[k + 1]
    for k in range(m - 1, -1, -1):
        row = lu[k]
        one, other = first[k], second[k]
        for j in range(k + 1, m):
            one -= row[j] * first[j]
            other -= row[j] * second[j]
        first[k], second[k] = one / row[k], other / row[k]


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
            if vectors[Vector.ACTIVE, i] != 0.0:
                vectors[Vector.INDEX, m] = i
                m += 1
        for r in range(m):
            i = int(vectors[Vector.INDEX, r])
            vectors[Vector.Q1, r], vectors[Vector.Q2, r] = 1.0, -vectors[Vector.GAP, i]
            for c in range(m):
                lu[r, c] = matrix[int(vectors[Vector.INDEX, c]), i]
        _eliminate(lu, m, vectors[Vector.Q1], vectors[Vector.Q2])
        stiffness, offset = 0.0, 0.0
        for r in range(m):
            i = int(vectors[Vector.INDEX, r])
            w = math.pi * vectors[Vector.A, i] * vectors[Vector.HALF, i]  # pi/2 a times the full width
            stiffness += w * vectors[Vector.Q1, r]
            offset += w * vectors[Vector.Q2, r]
        delta = (amount - offset) / stiffness if by_load and stiffness > 0.0 else amount
        vectors[Vector.P, :total] = 0.0
        for r in range(m):
            vectors[Vector.P, int(vectors[Vector.INDEX, r])] = delta * vectors[Vector.Q1, r] + vectors[Vector.Q2, r]
        changed = False
        for i in range(total):
            place = i % n
            if vectors[Vector.ACTIVE, i] != 0.0:
                neighbour = i + 1 if place == 0 else i - 1
                at_end = place in (0, n - 1) and vectors[Vector.P, neighbour] > 0.0
                if vectors[Vector.P, i] < 0.0 and not at_end:
                    vectors[Vector.ACTIVE, i] = 0.0
                    changed = True
            else:
                u = 0.0
                for r in range(m):
                    j = int(vectors[Vector.INDEX, r])
                    u += matrix[j, i] * vectors[Vector.P, j]
                if delta - vectors[Vector.GAP, i] - u > 1e-4 * delta:
                    vectors[Vector.ACTIVE, i] = 1.0
                    changed = True
        if not changed:
            break
        if m == 0:
            break
    for i in range(total):  # ends kept in the set for smoothness do not pull
        if vectors[Vector.P, i] < 0.0:
            vectors[Vector.P, i] = 0.0
    return delta
