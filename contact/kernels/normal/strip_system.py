"""Linear system of interacting strips: influence matrix, active-set solution, displacement at the ends of strips."""

import math

from contact.core import kernel
from contact.kernels.normal.between_panels import IN_LINE, add_others, assemble_others
from contact.kernels.normal.elimination import eliminate
from contact.kernels.normal.influence import at_centre, column, off_line
from contact.kernels.normal.many_strips import displacement, fill_ln_X, go_off_line
from contact.kernels.rows import Pair, Vector

#: Overlap of an idle strip, over the approach, from which on it is loaded again in the first rounds and in later ones. Narrow
#: strips at an end overlap by little, and the pressure beside a strip that is left out is singular.
_OVERLAP = (1e-6, 1e-5, 1e-4)


@kernel
def _fill_off_line(first, n, half, workspace, unit):
    """Fill the influence of a panel's strips on each other where they lie off each other's centre.

    The panel begins at strip `first` and has the half width `half`. Strips in line are filled only if there is no table
    of columns.
    """
    cosine_logs, vectors, matrix = workspace.rule.cosine_logs, workspace.space.vectors, workspace.space.matrix
    centre, plane = workspace.tables.centre, workspace.tables.plane
    tabulated = workspace.rule.columns.shape[1] == n
    loci, ln_half = vectors[Vector.XC, first : first + n], math.log(half)
    factors, forces = vectors[Vector.OF_MIDDLE, first : first + n], vectors[Vector.Q1, :n]
    pairs = vectors[Vector.PAIRS : Vector.PAIRS + len(Pair)]
    for k in range(n):
        a, row = vectors[Vector.A, first + k], matrix[first + k, first : first + n]
        ln_a, scale, inverse, locus = vectors[Vector.LN_LENGTH, first + k] - ln_half, a * unit, 1.0 / a, loci[k]
        for i in range(n):
            X = abs(loci[i] - locus) * inverse
            pairs[Pair.X, i] = X if X > IN_LINE else 0.0
            pairs[Pair.LOW, i], pairs[Pair.HIGH, i] = cosine_logs[i, k] - ln_a, cosine_logs[i, k + 1] - ln_a
            forces[i] = factors[i] * scale
        if not tabulated:
            for i in range(n):
                low, high = at_centre(centre, pairs[Pair.LOW, i]), at_centre(centre, pairs[Pair.HIGH, i])
                row[i] = forces[i] * abs(high + (low if i == k else -low))
        fill_ln_X(n, pairs)
        go_off_line(plane, forces, pairs, row)


@kernel
def assemble(panels, n_panels, workspace, skewed, unit):
    """Fill `workspace.space.matrix[j, i]` with the displacement on the centre line of strip i by unit peak pressure on strip j.

    `unit` is 1/(pi E*). `skewed` says whether strips lie off each other's centre.
    """
    columns, vectors, matrix = workspace.rule.columns, workspace.space.vectors, workspace.space.matrix
    n, factors = workspace.rule.cosines.size - 1, vectors[Vector.OF_MIDDLE]
    tabulated = columns.shape[1] == n
    for p in range(n_panels):
        first, half = p * n, 0.5 * (panels[2 * p + 1] - panels[2 * p])
        ln_half = math.log(half)
        for k in range(n if tabulated else 0):
            ln_a, scale = vectors[Vector.LN_LENGTH, first + k] - ln_half, vectors[Vector.A, first + k] * unit
            column(columns, k, ln_a, scale, factors[first : first + n], matrix[first + k, first : first + n])
        if skewed or not tabulated:
            _fill_off_line(first, n, half, workspace, unit)
    if n_panels > 1:
        assemble_others(panels, n_panels, workspace, unit)


@kernel
def _add_panel(first, n, logs, ln_unit, skewed, vectors, plane):
    """Add to Vector.U the displacement at the ends of a panel's strips by the panel itself.

    `first` is the panel's first strip. `logs` + `ln_unit` are ln|Y_k - y_i|. The end strips are left out: their lengths
    follow from their neighbours. If strips are `skewed`, the mean of both ends is taken, and Vector.DIFFERENCE gets their
    difference.
    """
    last = first + n
    logs_a, inverses = vectors[Vector.LN_LENGTH, first:last], vectors[Vector.Q2, first:last]
    forces, loci = vectors[Vector.R, first:last], vectors[Vector.XC, first:last]
    pairs = vectors[Vector.PAIRS : Vector.PAIRS + len(Pair)]
    for k in range(1, n - 1):
        i = first + k
        if vectors[Vector.P, i] == 0.0:
            continue
        a, ln_a, x, at = vectors[Vector.A, i], logs_a[k], vectors[Vector.XC, i], logs[k]
        u, trailing = 0.0, 0.0
        for end in range(2 if skewed else 1):
            for m in range(n):
                shift = ln_unit - logs_a[m]
                pairs[Pair.X, m], pairs[Pair.LN_X, m] = a * inverses[m], ln_a - logs_a[m]
                pairs[Pair.LOW, m], pairs[Pair.HIGH, m] = at[m] + shift, at[m + 1] + shift
            if skewed:
                side = a if end == 0 else -a
                for m in range(n):
                    pairs[Pair.X, m] = abs(side + loci[m] - x) * inverses[m]
                fill_ln_X(n, pairs)
            trailing = u  # end 0, once the leading one is known
            u = displacement(plane, forces, pairs, k)
        vectors[Vector.U, i] += vectors[Vector.OF_ENDS, i] * (0.5 * (trailing + u) if skewed else u)
        vectors[Vector.DIFFERENCE, i] += vectors[Vector.OF_DIFFERENCE, i] * (u - trailing) if skewed else 0.0


@kernel
def edge_displacements(panels, n_panels, workspace, skewed, unit):
    """Fill Vector.U with the displacement at the ends of every loaded strip between the end strips of its panel [m]."""
    cosine_logs, vectors, plane = workspace.rule.cosine_logs, workspace.space.vectors, workspace.tables.plane
    n = cosine_logs.shape[0]
    for j in range(n * n_panels):
        vectors[Vector.Q2, j] = 1.0 / vectors[Vector.A, j]
        vectors[Vector.R, j] = vectors[Vector.P, j] * vectors[Vector.A, j] * unit
        vectors[Vector.U, j] = vectors[Vector.DIFFERENCE, j] = 0.0
    for p in range(n_panels):
        ln_half = math.log(0.5 * (panels[2 * p + 1] - panels[2 * p]))
        _add_panel(p * n, n, cosine_logs, ln_half, skewed, vectors, plane)
        if n_panels > 1:
            add_others(p, panels, n_panels, workspace, skewed)


@kernel
def displacement_outside(at, locus, n, n_panels, vectors, centre, plane, unit):
    """Return the displacement at y = at, x = locus, which lies in no panel [m]."""
    u = 0.0
    for p in range(n_panels):
        first = p * n
        side = 1.0 if at < vectors[Vector.Y, first] else -1.0
        ln_away = math.log(
            max(abs(vectors[Vector.Y, first] - at - vectors[Vector.HALF, first]), 1e-12 * vectors[Vector.HALF, first])
        )
        for j in range(first, first + n):
            before = ln_away
            ln_away = math.log(
                max(abs(vectors[Vector.Y, j] - at + vectors[Vector.HALF, j]), 1e-12 * vectors[Vector.HALF, j])
            )
            if vectors[Vector.P, j] > 0.0:
                ln_a, a = vectors[Vector.LN_LENGTH, j], vectors[Vector.A, j]
                X = abs(vectors[Vector.XC, j] - locus) / a
                if X > IN_LINE:
                    beyond = off_line(centre, plane, X, max(ln_away, before) - ln_a, min(ln_away, before) - ln_a)
                else:
                    beyond = side * (at_centre(centre, ln_away - ln_a) - at_centre(centre, before - ln_a))
                u += vectors[Vector.P, j] * a * unit * beyond
    return u


@kernel
def solve_active(n, n_panels, space, by_load, amount):
    """Fill the peak pressures that close the gap of every loaded strip. Return the approach above first touch [m].

    p = delta·q1 + q2 with the response q1 to a unit approach. So a prescribed load and a prescribed approach differ in
    one line. Strips under tension leave the active set. Separated strips that would overlap enter it. There are at most
    20 rounds.
    """
    vectors, matrix, lu = space.vectors, space.matrix, space.lu
    total = n * n_panels
    delta = 0.0
    for turn in range(20):
        overlap = _OVERLAP[min(turn, len(_OVERLAP) - 1)]
        m = 0
        for i in range(total):
            if vectors[Vector.ACTIVE, i] != 0.0:
                vectors[Vector.INDEX, m] = i
                m += 1
        for r in range(m):
            i = int(vectors[Vector.INDEX, r])
            vectors[Vector.Q1, r], vectors[Vector.Q2, r] = 1.0, -vectors[Vector.GAP, i]
            to, influence = lu[r, :m], matrix[i, :total]
            if m == total:
                for c in range(total):
                    to[c] = influence[c]
            else:
                for c in range(m):
                    to[c] = influence[int(vectors[Vector.INDEX, c])]
        eliminate(lu, m, vectors[Vector.Q1], vectors[Vector.Q2])
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
                if delta - vectors[Vector.GAP, i] - u > overlap * delta:
                    vectors[Vector.ACTIVE, i] = 1.0
                    changed = True
        if not changed:
            break
        if m == 0:
            break
    for i in range(total):  # end strips that are kept in the set for smoothness carry no tension
        vectors[Vector.END, i] = vectors[Vector.P, i]
        if vectors[Vector.P, i] < 0.0:
            vectors[Vector.P, i] = 0.0
    return delta
