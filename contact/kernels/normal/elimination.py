"""Gaussian elimination of the strips' linear system."""

from contact.core import entry
from contact.kernels.arrays import Matrix, Numbers


@entry
def eliminate(lu: Matrix, m: int, first: Numbers, second: Numbers) -> None:
    """Solve x·lu = first and x·lu = second for `m` unknowns in place by Gaussian elimination; `lu` becomes its factors.

    Row j of `lu` has what unknown j adds to all equations, as the influence matrix has it. So every loop runs along a row.
    The influence matrix needs no pivoting. Two pivots and four rows are processed at a time, so a row is read and
    written half as often and there are fewer loops.
    """
    for k in range(0, m - 1, 2):
        above, below = lu[k], lu[k + 1]
        inverse = 1.0 / above[k]
        factor = below[k] * inverse
        below[k] = factor
        for j in range(k + 1, m):
            below[j] -= factor * above[j]
        across, next_inverse = above[k + 1], 1.0 / below[k + 1]
        i = k + 2
        while i + 3 < m:
            a, b, c, d = lu[i], lu[i + 1], lu[i + 2], lu[i + 3]
            fa, fb, fc, fd = a[k] * inverse, b[k] * inverse, c[k] * inverse, d[k] * inverse
            ha, hb = (a[k + 1] - fa * across) * next_inverse, (b[k + 1] - fb * across) * next_inverse
            hc, hd = (c[k + 1] - fc * across) * next_inverse, (d[k + 1] - fd * across) * next_inverse
            a[k], b[k], c[k], d[k] = fa, fb, fc, fd
            a[k + 1], b[k + 1], c[k + 1], d[k + 1] = ha, hb, hc, hd
            for j in range(k + 2, m):
                v, w = above[j], below[j]
                a[j] -= fa * v + ha * w
                b[j] -= fb * v + hb * w
                c[j] -= fc * v + hc * w
                d[j] -= fd * v + hd * w
            i += 4
        for r in range(i, m):
            row = lu[r]
            f = row[k] * inverse
            h = (row[k + 1] - f * across) * next_inverse
            row[k], row[k + 1] = f, h
            for j in range(k + 2, m):
                row[j] -= f * above[j] + h * below[j]
    for k in range(m):
        row = lu[k]
        inverse = 1.0 / row[k]
        one, other = first[k] * inverse, second[k] * inverse
        first[k], second[k] = one, other
        for j in range(k + 1, m):
            first[j] -= row[j] * one
            second[j] -= row[j] * other
    for k in range(m - 1, 0, -1):
        row = lu[k]
        one, other = first[k], second[k]
        for j in range(k):
            first[j] -= row[j] * one
            second[j] -= row[j] * other
