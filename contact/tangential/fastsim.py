"""FASTSIM (Kalker 1982) on any patch, three flexibilities, parabolic bound (theory.md 2.5).

The flexibilities are those of the equivalent ellipse: the patch's area with the longest strip as semi-axis a. The bound of
a strip is the parabola with peak proportional to its p0·a, scaled so that the bounds carry the normal load: on an ellipse
this is Kalker's paraboloid exactly, on any patch full slip gives mu N.
"""

import math

from contact import kalker
from contact._jit import kernel
from contact._layout import (
    CASE_G,
    CASE_MU,
    CASE_PHI,
    CASE_VX,
    CASE_VY,
    FIELD_QX,
    FIELD_QY,
    FIELD_STICK,
    FIELD_SX,
    FIELD_SY,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_N,
    RES_POWER,
    RES_SLIP_AREA,
    STRIP_A,
    STRIP_DY,
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.quadrature import EL_DX, EL_S, EL_SINE, EL_STEP
from contact.tangential.lanes import LANES, NOW_SLIDES, NOW_SLIP, NOW_STICK, NOW_X, NOW_Y
from contact.tangential.march import ROW_X, ROW_Y, ROW_Z, march

#: A traction bound below this fraction of G is none: creepage over it would overflow.
NO_FRICTION = 1e-15


@kernel
def equivalent_ellipse(strips, n):
    """Semi-axes of the ellipse with the longest strip as a and the area of the patch."""
    a = 0.0
    area = 0.0
    for i in range(n):
        a = max(a, strips[STRIP_A, i])
        area += 2.0 * strips[STRIP_A, i] * strips[STRIP_DY, i]
    return a, (area / (math.pi * a) if a > 0.0 else 0.0)


@kernel
def fastsim(strips, n, case, table, elements, lanes, trace, fields, result):
    """Fill the traction, slip and stick fields of `n` strips and the tangential part of `result`."""
    mu, G = case[CASE_MU], case[CASE_G]
    vx, vy, phi = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    a0, b0 = equivalent_ellipse(strips, n)
    L1, L2, L3, spread = 1.0, 1.0, 1.0, 1.0
    if a0 > 0.0:
        c11, c22, c23, _ = kalker.coefficients(table, math.log(a0 / b0))
        L1 = 8.0 * a0 / (3.0 * G * c11)
        L2 = 8.0 * a0 / (3.0 * G * c22)
        L3 = math.pi * a0 * a0 / (4.0 * G * math.sqrt(a0 * b0) * c23)
        cubes = 0.0
        for k in range(elements.shape[1]):
            cubes += elements[EL_SINE, k] ** 2 * elements[EL_DX, k]
        spread = 0.0  # load of parabolas of peak p0·a, by the quadrature of the fields
        for i in range(n):
            spread += cubes * strips[STRIP_P0, i] * strips[STRIP_A, i] ** 2 * strips[STRIP_DY, i]
    for block in range(0, n, LANES):
        for l in range(LANES):
            i = min(block + l, n - 1)
            a = strips[STRIP_A, i]
            peak = mu * result[RES_N] / spread * strips[STRIP_P0, i] * a
            scale = a / peak if peak > NO_FRICTION * G else 0.0
            lanes[ROW_X + l] = scale * (vx / L1 - phi * strips[STRIP_Y, i] / L3)
            lanes[ROW_Y + l] = scale * (vy / L2 + phi * strips[STRIP_XC, i] / L3)
            lanes[ROW_Z + l] = scale * a * phi / L3
        march(elements, lanes, trace)
        for l in range(min(LANES, n - block)):
            i = block + l
            row = min(i, fields.shape[1] - 1)  # one row serves all strips when only forces are asked for
            a, y, dy = strips[STRIP_A, i], strips[STRIP_Y, i], strips[STRIP_DY, i]
            peak = mu * result[RES_N] / spread * strips[STRIP_P0, i] * a
            frictionless = peak <= NO_FRICTION * G
            if frictionless:
                peak = 0.0
            for k in range(elements.shape[1]):
                ex, ey = trace[k, NOW_X + l], trace[k, NOW_Y + l]
                stick, slip = trace[k, NOW_STICK + l], trace[k, NOW_SLIP + l]
                size = peak * elements[EL_SINE, k] ** 2
                qx, qy = size * ex, size * ey
                slip *= peak / a if a > 0.0 else 0.0
                sx, sy = -L1 * slip * ex, -L2 * slip * ey
                stick = 0.0 if frictionless else stick
                fields[FIELD_QX, row, k], fields[FIELD_QY, row, k] = qx, qy
                fields[FIELD_SX, row, k], fields[FIELD_SY, row, k] = sx, sy
                fields[FIELD_STICK, row, k] = 0.0 if frictionless else 1.0 - trace[k, NOW_SLIDES + l]
                dA = a * elements[EL_DX, k] * dy
                Fx += qx * dA
                Fy += qy * dA
                Mz += ((strips[STRIP_XC, i] + a * elements[EL_S, k]) * qy - y * qx) * dA
                power -= (qx * sx + qy * sy) * dA
                slip_area += (1.0 - stick) * elements[EL_STEP, k] * a * dy
            slides = 1.0 if frictionless else trace[elements.shape[1] - 1, NOW_SLIDES + l]
            slip_area += slides * (1.0 + elements[EL_S, -1]) * a * dy  # behind the last element's middle
    result[RES_FX], result[RES_FY], result[RES_MZ] = Fx, Fy, Mz
    result[RES_POWER], result[RES_SLIP_AREA] = power, slip_area
