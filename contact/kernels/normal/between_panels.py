"""Displacement of each panel of strips by the other panels: found at a few probes, interpolated between them.

The displacement by panels that are not near is smooth across a panel. It is calculated at `PROBES` strips that lie nearly at
Chebyshev's nodes. The polynomial through them serves the other strips. If a panel is near, every strip is a probe.
"""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.normal.influence import at_centre, off_line
from contact.kernels.normal.many_strips import displacement, fill_ln_X
from contact.kernels.rows import Pair, Vector

#: Number of strips of a panel at which the displacement by other panels is calculated.
PROBES = 6
#: Distance of another panel over the half length in a panel's middle below which it is calculated at every strip.
_NEAR = 0.1
#: Offset along x over the half length below which strips count as in line. The table off the centre line is not more exact.
IN_LINE = 0.01


@entry
def fill_probes(cosines: Numbers, probes: Numbers, spread: Matrix) -> None:
    """Fill the numbers of the strips that are probes, and spread[k, i].

    This is the polynomial that is 1 at probe k and 0 at the other probes, at the middle of strip i. Probes lie
    symmetrically. With fewer strips than probes, those left over count nothing.
    """
    n = spread.shape[1]
    count = min(n, PROBES)
    for k in range(PROBES):  # the memory of an FMU holds anything at first
        probes[k] = 0.0
        for i in range(n):
            spread[k, i] = 0.0
    for k in range((count + 1) // 2):
        probes[k] = (2 * k + 1) * n // (2 * count)
        probes[count - 1 - k] = n - 1 - probes[k]
    for k in range(count):
        at_own = cosines[int(probes[k])] + cosines[int(probes[k]) + 1]
        for i in range(n):
            at, value = cosines[i] + cosines[i + 1], 1.0
            for m in range(count):
                at_other = cosines[int(probes[m])] + cosines[int(probes[m]) + 1]
                value *= (at - at_other) / (at_own - at_other) if m != k else 1.0
            spread[k, i] = value


@kernel
def _spread(u, spread, out):
    """Fill `out` with the displacement at all strips of a panel, from `u` at its probes."""
    u0, u1, u2, u3, u4, u5 = u[0], u[1], u[2], u[3], u[4], u[5]
    s0, s1, s2, s3, s4, s5 = spread[0], spread[1], spread[2], spread[3], spread[4], spread[5]
    for i in range(out.size):
        out[i] = u0 * s0[i] + u1 * s1[i] + u2 * s2[i] + u3 * s3[i] + u4 * s4[i] + u5 * s5[i]


@entry
def is_shared(end: int, n_panels: int, panels: Numbers) -> bool:
    """Return whether two panels meet in an end: number 2p is the lower one of panel p, 2p + 1 the upper one."""
    shared = False
    for p in range(n_panels):
        shared = shared or panels[2 * p + 1 - end % 2] == panels[end]
    return shared


@kernel
def _probes_of(p, n_panels, panels, n, vectors):
    """Return the number of probes of a panel: all its strips if another panel is near, where a polynomial would swing."""
    near = _NEAR * vectors[Vector.A, p * n + n // 2]
    for q in range(n_panels):
        if q != p and max(panels[2 * q] - panels[2 * p + 1], panels[2 * p] - panels[2 * q + 1]) < near:
            return n
    return PROBES


@kernel
def _probe(m, n, count, probes):
    """Return the strip that is probe m of `count` in its panel of n strips."""
    return m if count == n else int(probes[m])


@kernel
def distances(panels, n_panels, workspace):
    """Fill `workspace.space.logs[i, k]` with ln|Y_k - y_i| of each probe i to each edge k of other panels, n + 1 a panel."""
    cosines, vectors, logs = workspace.rule.cosines, workspace.space.vectors, workspace.space.logs
    n = cosines.size - 1
    for p in range(n_panels):
        least = 0.5e-12 * (panels[2 * p + 1] - panels[2 * p])
        count = _probes_of(p, n_panels, panels, n, vectors)
        for q in range(n_panels):
            if p == q:
                continue
            centre, half = 0.5 * (panels[2 * q] + panels[2 * q + 1]), 0.5 * (panels[2 * q + 1] - panels[2 * q])
            for m in range(count):
                at = vectors[Vector.Y, p * n + _probe(m, n, count, workspace.rule.probes)]
                for k in range(n + 1):
                    logs[p * n + m, q * (n + 1) + k] = math.log(max(abs(centre + half * cosines[k] - at), least))


@kernel
def assemble_others(panels, n_panels, workspace, unit):
    """Fill `workspace.space.matrix[j, i]` for every strip j and the strips i of the other panels.

    It is the displacement on the centre line of strip i by unit peak pressure on strip j. `unit` is 1/(pi E*).
    """
    vectors, logs = workspace.space.vectors, workspace.space.logs
    matrix, at_probes = workspace.space.matrix, workspace.space.vectors[Vector.Q1]
    probes, spread = workspace.rule.probes, workspace.rule.spread
    centre, plane = workspace.tables.centre, workspace.tables.plane
    n = spread.shape[1]
    for q in range(n_panels):
        for j in range(q * n, q * n + n):
            a, row = vectors[Vector.A, j], matrix[j]
            scale, ln_a, inverse = a * unit, vectors[Vector.LN_LENGTH, j], 1.0 / a
            for p in range(n_panels):
                count = _probes_of(p, n_panels, panels, n, vectors) if p != q else 0
                for m in range(count):
                    at = logs[p * n + m]
                    left, right = at[j + q] - ln_a, at[j + q + 1] - ln_a
                    X = abs(vectors[Vector.XC, p * n + _probe(m, n, count, probes)] - vectors[Vector.XC, j]) * inverse
                    if X > IN_LINE:
                        at_probes[m] = scale * off_line(centre, plane, X, max(right, left), min(right, left))
                    else:
                        at_probes[m] = scale * abs(at_centre(centre, right) - at_centre(centre, left))
                if count == n:
                    for m in range(n):
                        row[p * n + m] = at_probes[m]
                elif p != q:
                    _spread(at_probes, spread, row[p * n : p * n + n])


@kernel
def add_others(p, panels, n_panels, workspace, skewed):
    """Add to Vector.U the displacement at the ends of panel p's strips by the other panels, the mean of both ends.

    The rows Q2 and R of the vectors hold 1/a and p0·a/(pi E*). Both ends differ if strips are `skewed`. Then
    Vector.DIFFERENCE gets their difference.
    """
    vectors, logs = workspace.space.vectors, workspace.space.logs
    spread, plane = workspace.rule.spread, workspace.tables.plane
    n = spread.shape[1]
    U, difference = vectors[Vector.U, p * n : p * n + n], vectors[Vector.DIFFERENCE, p * n : p * n + n]
    logs_a, inverses = vectors[Vector.LN_LENGTH], vectors[Vector.Q2]
    forces, loci = vectors[Vector.R], vectors[Vector.XC]
    pairs = vectors[Vector.PAIRS : Vector.PAIRS + len(Pair)]
    count = _probes_of(p, n_panels, panels, n, vectors)
    for m in range(count):
        strip = p * n + _probe(m, n, count, workspace.rule.probes)
        a, x, at = vectors[Vector.A, strip], loci[strip], logs[p * n + m]
        trailing, leading = 0.0, 0.0
        for q in range(n_panels):
            for end in range(0 if q == p else 2 if skewed else 1):
                side = a if end == 0 else -a
                for j in range(n):
                    k = q * n + j
                    pairs[Pair.X, j] = abs(side + loci[k] - x) * inverses[k]
                    pairs[Pair.LOW, j], pairs[Pair.HIGH, j] = at[k + q] - logs_a[k], at[k + q + 1] - logs_a[k]
                fill_ln_X(n, pairs)
                by_panel = displacement(plane, forces[q * n : q * n + n], pairs, -1)
                if end == 0:
                    trailing += by_panel
                else:
                    leading += by_panel
        u = 0.5 * (trailing + leading) if skewed else trailing
        if count == n:
            U[m] += u
            difference[m] += leading - trailing if skewed else 0.0
            continue
        for i in range(n):
            U[i] += spread[m, i] * u
        if skewed:
            for i in range(n):
                difference[i] += spread[m, i] * (leading - trailing)
