"""Kalker's creepage coefficients, interpolated in a table over the aspect ratio (theory.md 1.2)."""

import math

from contact.core import entry
from contact.kernels.arrays import Cube, Matrix
from contact.kernels.cubic import basis

#: Largest |ln(a/b)| of the table. Aspect ratios are clamped to [1/50, 50].
LOG_ASPECT_MAX = math.log(50.0)
N_TABLE = 129
_STEP = 2.0 * LOG_ASPECT_MAX / (N_TABLE - 1)


@entry
def fill_table(published: Cube, nu: float, table: Matrix) -> None:
    """Fill `table` of `coefficients` for one Poisson's ratio.

    A parabola in nu is interpolated through 1/C for C11, C22, C23 and through C for C33.
    """
    p, q, r = (4.0 * nu - 1.0) * (2.0 * nu - 1.0), 8.0 * nu * (1.0 - 2.0 * nu), nu * (8.0 * nu - 2.0)
    for c in range(4):
        for i in range(N_TABLE):
            C = published[i, c]
            if c < 3:
                table[i, c] = 1.0 / (p / C[0] + q / C[1] + r / C[2])
            else:
                table[i, c] = p * C[0] + q * C[1] + r * C[2]
        for i in range(1, N_TABLE - 1):
            table[i, 4 + c] = 0.5 * (table[i + 1, c] - table[i - 1, c])
        table[0, 4 + c] = table[1, c] - table[0, c]
        table[N_TABLE - 1, 4 + c] = table[N_TABLE - 1, c] - table[N_TABLE - 2, c]


@entry
def coefficients(table: Matrix, log_aspect: float) -> tuple[float, float, float, float]:
    """Return C11, C22, C23, C33 at ln(a/b) from `table`. C32 = -C23. The aspect ratio is clamped to [1/50, 50]."""
    u = (min(max(log_aspect, -LOG_ASPECT_MAX), LOG_ASPECT_MAX) + LOG_ASPECT_MAX) / _STEP
    i = min(int(u), N_TABLE - 2)
    t = u - i
    h00, h10, h01, h11 = basis(t)
    p, q = table[i], table[i + 1]
    c11 = h00 * p[0] + h10 * p[4] + h01 * q[0] + h11 * q[4]
    c22 = h00 * p[1] + h10 * p[5] + h01 * q[1] + h11 * q[5]
    c23 = h00 * p[2] + h10 * p[6] + h01 * q[2] + h11 * q[6]
    c33 = h00 * p[3] + h10 * p[7] + h01 * q[3] + h11 * q[7]
    return c11, c22, c23, c33
