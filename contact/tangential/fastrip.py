"""FaStrip: strip theory amended by Kalker's coefficients, with FASTSIM's directions in the slip zone (theory.md 4).

Every strip is the central strip of a local ellipse with its own half length a(y), peak pressure p0(y) and aspect ratio, so
the method needs no elliptic patch; on an ellipse it is the published method. Stick-zone forces are integrated in closed
form; in the slip zone the magnitude mu·p is integrated exactly over each element and only the direction is the element's.

Departures from the thesis, each measured on elliptic cases against CONTACT (mean force error over mu N; docs/accuracy.md; the
published method has .0164):
* the longitudinal term of a strip is its C11-scaled local creepage vx - phi·y (moment error .0138 → .0122);
* the stick zone is continued through |psi| = 1 where lateral creepage opposes spin (`strip_theory.stick_zone`; .0175 → .0148);
* the single flexibility of a slipping leading edge is Vollebregt's weighted mean, L = (vx² + vy² + c²phi²)/(vx²/L1 + …)
  (theory.md 2.5, "crss"), blended in instead of switched, which removes a jump from strip to strip (.0148 → .0121);
* the direction pass is of second order (`march`): .0136, and the result no longer depends on the number of elements, where
  the first-order pass had gained the difference by its error;
* the factor 1 + (1 - a/b)⁴ on N in the direction pass is left out (no measurable benefit, theory.md 4.2).
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
from contact.quadrature import EL_ANGLE_END, EL_DX, EL_LOAD_END, EL_MOMENT_END, EL_S, EL_SINE
from contact.tangential.fastsim import NO_FRICTION, equivalent_ellipse
from contact.tangential.march import march
from contact.tangential.strip_theory import stick_resultants, stick_zone


@kernel
def directions(elements, vx, vy, phi, L1, L2, L3, a, y, xc, c, tau_x, tau_y, excess):
    """FASTSIM pass whose three stiffnesses pass into a single one as the leading edge comes to slip.

    L1, L2, L3 are a/(flexibility·bound), the normalised stiffnesses of the strip. `edge` is the utilisation of the bound at
    the leading edge, where both vanish; beyond 1 the edge slips and the thesis (4.4) repeats the strip with one flexibility.
    """
    x, z = vx * L1 - phi * y * L3, vy * L2 + phi * (xc + a) * L3
    edge = 0.5 * math.sqrt(x * x + z * z)
    if edge > 0.5:
        w = min(2.0 * edge - 1.0, 1.0)
        spin2 = (phi * c) ** 2
        single = (vx * vx + vy * vy + spin2) / (vx * vx * L1 + vy * vy * L2 + spin2 * L3)
        L1 = 1.0 / ((1.0 - w) / L1 + w * single)
        L2 = 1.0 / ((1.0 - w) / L2 + w * single)
        L3 = 1.0 / ((1.0 - w) / L3 + w * single)
    march(elements, vx * L1 - phi * y * L3, vy * L2 + phi * xc * L3, phi * a * L3, tau_x, tau_y, excess)


@kernel
def fastrip(strips, n, case, table, elements, fields, result):
    """Fill the traction, slip and stick fields of `n` strips and the tangential part of `result`."""
    mu, G, nu = case[CASE_MU], case[CASE_G], case[CASE_NU]
    m = elements.shape[1]
    vx0, vy0, phi = case[CASE_VX], case[CASE_VY], case[CASE_PHI]
    a0, b0 = equivalent_ellipse(strips, n)
    c_patch = math.sqrt(a0 * b0)
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        a, dy, y, xc = strips[STRIP_A, i], strips[STRIP_DY, i], strips[STRIP_Y, i], strips[STRIP_XC, i]
        row = min(i, fields.shape[1] - 1)  # one row serves all strips when only forces are asked for
        bound = mu * strips[STRIP_P0, i]
        if a <= 0.0 or bound <= NO_FRICTION * G:
            fields[FIELD_STICK, row, :] = 0.0
            fields[FIELD_QX : FIELD_SY + 1, row, :] = 0.0
            slip_area += 2.0 * a * dy
            continue
        c11, c22, c23, _ = kalker.coefficients(table, strips[STRIP_ASPECT, i])
        root_aspect = math.exp(0.5 * strips[STRIP_ASPECT, i])  # √(a/b) = a/c
        c = a / root_aspect
        vx, vy = vx0 - phi * y, vy0 + phi * xc

        # directions from the parabola of peak 4/3 mu p0 (theory.md 4.4)
        tau_x, tau_y, excess = fields[FIELD_QX, row], fields[FIELD_QY, row], fields[FIELD_SX, row]
        unit = 0.75 * G / bound
        L1, L2, L3 = unit * 0.375 * c11, unit * 0.375 * c22, unit * 4.0 / math.pi * c23 / root_aspect
        directions(elements, vx0, vy0, phi, L1, L2, L3, a, y, xc, c_patch, tau_x, tau_y, excess)

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
        load_from = outer  # integral of the pressure from the leading edge to the stick boundary
        moment_from = outer_s
        for k in range(m):
            s, sine = elements[EL_S, k], elements[EL_SINE, k]
            size = math.sqrt(tau_x[k] ** 2 + tau_y[k] ** 2)
            direction_x = tau_x[k] / size if size > 0.0 else 0.0
            direction_y = tau_y[k] / size if size > 0.0 else 0.0
            if elements[EL_ANGLE_END, k] > angle_boundary:  # the part of this element that slips, magnitude mu·p
                load_end, moment_end = elements[EL_LOAD_END, k], elements[EL_MOMENT_END, k]
                fx += strip * (load_end - load_from) * direction_x
                fy += strip * (load_end - load_from) * direction_y
                mz += strip * a * (moment_end - moment_from) * direction_y
                load_from, moment_from = load_end, moment_end
            if s > boundary:
                S = math.sqrt((1.0 - e) ** 2 - (s - e) ** 2)
                qx, qy = kappa * (sine - S), lam * sine - lam1 * S
                excess_traction = math.sqrt(qx * qx + qy * qy) / sine
                if excess_traction > 1.0:  # the field stays admissible; the closed-form resultants do not need it
                    qx, qy = qx / excess_traction, qy / excess_traction
                slip = 0.0
                fields[FIELD_STICK, row, k] = 1.0
            else:
                qx, qy = direction_x * sine, direction_y * sine
                if e < 1.0:
                    W = math.sqrt(max((s - e) ** 2 - (1.0 - e) ** 2, 0.0))
                    slip = W * math.sqrt((flexibility_x * kappa) ** 2 + (flexibility_y * lam1) ** 2)
                else:
                    sx = vx + flexibility_x * direction_x * s
                    sy = vy + phi * a * s + flexibility_y * direction_y * s
                    slip = max(0.0, -(sx * direction_x + sy * direction_y))
                fields[FIELD_STICK, row, k] = 0.0
                power += bound * sine * slip * a * elements[EL_DX, k] * dy
            fields[FIELD_QX, row, k], fields[FIELD_QY, row, k] = bound * qx, bound * qy
            fields[FIELD_SX, row, k], fields[FIELD_SY, row, k] = -slip * direction_x, -slip * direction_y
        Fx += fx
        Fy += fy
        Mz += mz + xc * fy - y * fx
    result[RES_FX], result[RES_FY], result[RES_MZ] = Fx, Fy, Mz
    result[RES_POWER], result[RES_SLIP_AREA] = power, slip_area
