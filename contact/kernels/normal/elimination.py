"""Gaussian elimination of the strips' linear system."""

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers


@entry
def eliminate(lu: Matrix, m: int, first: Numbers, second: Numbers) -> None:
    """Solve x·lu = first and x·lu = second for `m` unknowns in place by Gaussian elimination; `lu` becomes its factors.

    Row j of `lu` has what unknown j adds to all equations, as the influence matrix has it. So every loop runs along a row.
    The influence matrix needs no pivoting. Two pivots are processed at a time, and two rows, so a row is read and written half
    as often and there are fewer loops. Loops run over slices from 0 on: of indices that begin elsewhere, and of more than two
    rows, the compiler cannot prove that it may take several numbers at once.
    """
    for k in range(0, m - 1, 2):
        inverse, across = 1.0 / lu[k, k], lu[k, k + 1]
        factor = lu[k + 1, k] * inverse
        lu[k + 1, k] = factor
        lu[k + 1, k + 1] -= factor * across
        next_inverse = 1.0 / lu[k + 1, k + 1]
        above, below = lu[k, k + 2 : m], lu[k + 1, k + 2 : m]
        for j in range(above.size):
            below[j] -= factor * above[j]
        i = k + 2
        while i + 1 < m:
            fa, fb = lu[i, k] * inverse, lu[i + 1, k] * inverse
            ha, hb = (lu[i, k + 1] - fa * across) * next_inverse, (lu[i + 1, k + 1] - fb * across) * next_inverse
            lu[i, k], lu[i, k + 1], lu[i + 1, k], lu[i + 1, k + 1] = fa, ha, fb, hb
            a, b = lu[i, k + 2 : m], lu[i + 1, k + 2 : m]
            for j in range(above.size):
                v, w = above[j], below[j]
                a[j] -= fa * v + ha * w
                b[j] -= fb * v + hb * w
            i += 2
        if i < m:
            f = lu[i, k] * inverse
            h = (lu[i, k + 1] - f * across) * next_inverse
            lu[i, k], lu[i, k + 1] = f, h
            row = lu[i, k + 2 : m]
            for j in range(above.size):
                row[j] -= f * above[j] + h * below[j]
    _substitute_forwards(lu, m, first, second)
    _substitute_backwards(lu, m, first, second)


@kernel
def _substitute_forwards(lu, m, first, second):
    """Solve x·u = first and x·u = second for the upper factor u."""
    for k in range(0, m - 1, 2):
        inverse, next_inverse, across = 1.0 / lu[k, k], 1.0 / lu[k + 1, k + 1], lu[k, k + 1]
        one, other = first[k] * inverse, second[k] * inverse
        next_one = (first[k + 1] - across * one) * next_inverse
        next_other = (second[k + 1] - across * other) * next_inverse
        first[k], first[k + 1], second[k], second[k + 1] = one, next_one, other, next_other
        above, below, a, b = lu[k, k + 2 : m], lu[k + 1, k + 2 : m], first[k + 2 : m], second[k + 2 : m]
        for j in range(above.size):
            v, w = above[j], below[j]
            a[j] = (a[j] - v * one) - w * next_one
            b[j] = (b[j] - v * other) - w * next_other
    if m % 2 == 1:
        inverse = 1.0 / lu[m - 1, m - 1]
        first[m - 1], second[m - 1] = first[m - 1] * inverse, second[m - 1] * inverse


@kernel
def _substitute_backwards(lu, m, first, second):
    """Solve x·l = first and x·l = second for the lower factor l, which has ones on its diagonal."""
    k = m - 1
    while k > 0:
        one, other, across = first[k], second[k], lu[k, k - 1]
        next_one, next_other = first[k - 1] - across * one, second[k - 1] - across * other
        first[k - 1], second[k - 1] = next_one, next_other
        below, above, a, b = lu[k, : k - 1], lu[k - 1, : k - 1], first[: k - 1], second[: k - 1]
        for j in range(below.size):
            v, w = below[j], above[j]
            a[j] = (a[j] - v * one) - w * next_one
            b[j] = (b[j] - v * other) - w * next_other
        k -= 2
