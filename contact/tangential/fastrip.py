"""FaStrip: strip theory amended by Kalker's coefficients, with FASTSIM's directions in the slip zone (theory.md 4).

Every strip is the central strip of a local ellipse with its own half length a(y), peak pressure p0(y) and aspect ratio, so
the method needs no elliptic patch; on an ellipse it is the published method. Stick-zone forces are integrated in closed
form; in the slip zone the magnitude mu·p is integrated exactly over each element and only the direction is the element's.

Departures from the thesis, each measured on 695 elliptic cases against CONTACT (docs/accuracy.md):
the longitudinal term of a strip is its C11-scaled local creepage vx - phi·y; the factor 1 + (1 - a/b)⁴ on N in the
direction pass is left out (no measurable benefit, theory.md 4.2).
"""

import math

from contact import kalker
from contact._jit import kernel
from contact._layout import (
    CASE_G,
    CASE_MU,
    CASE_NU,
    CASE_PHI,
    CASE_VX,
    CASE_VY,
    FIELD_DX,
    FIELD_QX,
    FIELD_QY,
    FIELD_STICK,
    FIELD_SX,
    FIELD_SY,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_POWER,
    RES_SLIP_AREA,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_DY,
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.tangential.fastsim import equivalent_ellipse
from contact.tangential.march import PARABOLIC, march
from contact.tangential.strip_theory import stick_resultants, stick_zone


@kernel
def directions(angles, vx, vy, phi, L1, L2, L3, a, y, xc, c, tau_x, tau_y, excess):  # type: ignore[no-untyped-def]
    """FASTSIM pass with three flexibilities, repeated with one when the leading element slips (thesis 4.4).

    L1, L2, L3 are a/(flexibility·bound), the normalised stiffness of the strip; the single one is the thesis' mean
    (4.31-4.32) of flexibilities weighted by |vx|, |vy| and |phi| c.
    """
    march(angles, vx * L1 - phi * y * L3, vy * L2 + phi * xc * L3, phi * a * L3, PARABOLIC, tau_x, tau_y, excess)
    size = math.sqrt(vx * vx + vy * vy + (phi * c) ** 2)
    if excess[0] > 0.0 and size > 0.0:
        L = size / (abs(vx) / L1 + abs(vy) / L2 + abs(phi) * c / L3)
        march(angles, (vx - phi * y) * L, (vy + phi * xc) * L, phi * a * L, PARABOLIC, tau_x, tau_y, excess)


@kernel
def load_to(angle):  # type: ignore[no-untyped-def]
    """∫√(1-s²) ds from the leading edge to s = cos(angle)."""
    return 0.5 * (angle - math.sin(angle) * math.cos(angle))


@kernel
def fastrip(strips, n, case, table, angles, fields, result):  # type: ignore[no-untyped-def]
    """Fill the traction, slip and stick fields of `n` strips and the tangential part of `result`."""
    mu, G, nu = case[CASE_MU], case[CASE_G], case[CASE_NU]
    m = angles.size
    half_cell = 0.5 * math.pi / m
    vx0, vy0, phi = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
    a0, b0 = equivalent_ellipse(strips, n)
    c_patch = math.sqrt(a0 * b0)
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        a, dy, y, xc = strips[STRIP_A, i], strips[STRIP_DY, i], strips[STRIP_Y, i], strips[STRIP_XC, i]
        bound = mu * strips[STRIP_P0, i]
        if a <= 0.0 or bound <= 0.0:
            fields[FIELD_STICK, i, :] = 0.0
            fields[FIELD_QX : FIELD_SY + 1, i, :] = 0.0
            slip_area += 2.0 * a * dy
            continue
        c11, c22, c23, _ = kalker.coefficients(table, strips[STRIP_ASPECT, i])
        root_aspect = math.exp(0.5 * strips[STRIP_ASPECT, i])  # √(a/b) = a/c
        c = a / root_aspect
        vx, vy = vx0 - phi * y, vy0 + phi * xc

        # directions from the parabola of peak 4/3 mu p0 (theory.md 4.4)
        tau_x, tau_y, excess = fields[FIELD_QX, i], fields[FIELD_QY, i], fields[FIELD_SX, i]
        unit = 0.75 * G / bound
        L1, L2, L3 = unit * 0.375 * c11, unit * 0.375 * c22, unit * 4.0 / math.pi * c23 / root_aspect
        directions(angles, vx0, vy0, phi, L1, L2, L3, a, y, xc, c_patch, tau_x, tau_y, excess)

        # amended strip theory (theory.md 4.1)
        amended = -2.0 * (1.0 - nu) / math.pi**2 * G / bound
        psi = -1.5 * c * c23 / math.pi * G * phi / bound
        e, kappa, lam, lam1 = stick_zone(amended * c11 * vx, amended * c22 * vy, psi, nu)
        outer, inner, outer_s, inner_s = stick_resultants(e)
        strip = bound * a * dy
        fx = strip * kappa * (outer - inner)
        fy = strip * (lam * outer - lam1 * inner)
        mz = strip * a * (lam * outer_s - lam1 * inner_s)
        slip_area += 2.0 * a * e * dy

        flexibility_x = 0.5 * math.pi**2 * bound / (G * c11)  # strain over s of a traction mu·p (theory.md 4.3)
        flexibility_y = 0.5 * math.pi**2 * bound / (G * c22)
        boundary = -1.0 + 2.0 * e
        angle_boundary = math.acos(boundary)
        for k in range(m):
            s = math.cos(angles[k])
            sine = math.sin(angles[k])
            size = math.sqrt(tau_x[k] ** 2 + tau_y[k] ** 2)
            direction_x = tau_x[k] / size if size > 0.0 else 0.0
            direction_y = tau_y[k] / size if size > 0.0 else 0.0
            first, last = angles[k] - half_cell, angles[k] + half_cell
            if last > angle_boundary:  # the part of this element that slips, magnitude mu·p
                first = max(first, angle_boundary)
                share = strip * (load_to(last) - load_to(first))
                share_s = strip * a * (math.sin(last) ** 3 - math.sin(first) ** 3) / 3.0
                fx += share * direction_x
                fy += share * direction_y
                mz += share_s * direction_y
            if s > boundary:
                S = math.sqrt((1.0 - e) ** 2 - (s - e) ** 2)
                qx, qy = kappa * (sine - S), lam * sine - lam1 * S
                excess_traction = math.sqrt(qx * qx + qy * qy) / sine
                if excess_traction > 1.0:  # the field stays admissible; the closed-form resultants do not need it
                    qx, qy = qx / excess_traction, qy / excess_traction
                slip = 0.0
                fields[FIELD_STICK, i, k] = 1.0
            else:
                qx, qy = direction_x * sine, direction_y * sine
                if e < 1.0:
                    W = math.sqrt(max((s - e) ** 2 - (1.0 - e) ** 2, 0.0))
                    slip = W * math.sqrt((flexibility_x * kappa) ** 2 + (flexibility_y * lam1) ** 2)
                else:
                    sx = vx + flexibility_x * direction_x * s
                    sy = vy + phi * a * s + flexibility_y * direction_y * s
                    slip = max(0.0, -(sx * direction_x + sy * direction_y))
                fields[FIELD_STICK, i, k] = 0.0
                power += bound * sine * slip * fields[FIELD_DX, i, k] * dy
            fields[FIELD_QX, i, k], fields[FIELD_QY, i, k] = bound * qx, bound * qy
            fields[FIELD_SX, i, k], fields[FIELD_SY, i, k] = -slip * direction_x, -slip * direction_y
        Fx += fx
        Fy += fy
        Mz += mz + xc * fy - y * fx
    result[RES_FX], result[RES_FY], result[RES_MZ] = Fx, Fy, Mz
    result[RES_POWER], result[RES_SLIP_AREA] = power, slip_area
