"""Gaussian elimination of the strips' linear system."""

from contact.core import entry
from contact.kernels.arrays import Matrix, Numbers


@entry
def eliminate(lu: Matrix, m: int, first: Numbers, second: Numbers) -> None:
    """Solve lu·x = first and lu·x = second for `m` unknowns in place by Gaussian elimination.

    The influence matrix needs no pivoting. Two pivots and four rows are processed at a time, so a row is read and
    written half as often and there are fewer loops.
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
        one, other, one_below, other_below = first[k], second[k], first[k + 1], second[k + 1]
        i = k + 2
        while i + 3 < m:
            a, b, c, d = lu[i], lu[i + 1], lu[i + 2], lu[i + 3]
            fa, fb, fc, fd = a[k] * inverse, b[k] * inverse, c[k] * inverse, d[k] * inverse
            ha, hb = (a[k + 1] - fa * across) * next_inverse, (b[k + 1] - fb * across) * next_inverse
            hc, hd = (c[k + 1] - fc * across) * next_inverse, (d[k + 1] - fd * across) * next_inverse
            for j in range(k + 2, m):
                v, w = above[j], below[j]
                a[j] -= fa * v + ha * w
                b[j] -= fb * v + hb * w
                c[j] -= fc * v + hc * w
                d[j] -= fd * v + hd * w
            first[i] -= fa * one + ha * one_below
            second[i] -= fa * other + ha * other_below
            first[i + 1] -= fb * one + hb * one_below
            second[i + 1] -= fb * other + hb * other_below
            first[i + 2] -= fc * one + hc * one_below
            second[i + 2] -= fc * other + hc * other_below
            first[i + 3] -= fd * one + hd * one_below
            second[i + 3] -= fd * other + hd * other_below
            i += 4
        for r in range(i, m):
            row = lu[r]
            f = row[k] * inverse
            h = (row[k + 1] - f * across) * next_inverse
            for j in range(k + 2, m):
                row[j] -= f * above[j] + h * below[j]
            first[r] -= f * one + h * one_below
            second[r] -= f * other + h * other_below
    for k in range(m - 1, -1, -1):
        row = lu[k]
        one, other = first[k], second[k]
        for j in range(k + 1, m):
            one -= row[j] * first[j]
            other -= row[j] * second[j]
        first[k], second[k] = one / row[k], other / row[k]
