"""Mapped strip marching: FaStrip in one march, defined where the strip theory of the thesis is not.

Normalise a strip as x = x_c + a s, traction tau in a march with the parabolic bound 1 - s², u = tau/(1 - s²). With the
flexibilities of the amended strip theory the first stick zone |u| < 1 is identical to strip theory's, and
    q/(mu p) = o + (u - o) f(t)/t,  f(t) = 1 - (1 - t)^m,  o = (0, -psi),
maps the march onto the elliptic pressure, where t is the position of u on the ray from o to the unit circle; m = 1/2 is
strip theory exactly. March and map stay defined for |psi| >= 1, lateral creepage against spin, stick after slip, and any
pressure along the strip. Eight constants, of one half of the ellipses computed with CONTACT, let m, the spin and the turning
of the slip direction vary with spin and aspect ratio (mapped_strip.md, which measures every choice).

On a patch that is no ellipse the aspect ratio of a strip is the geometric mean of the local one, from the curvatures, and
that of the equivalent ellipse.
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
    RES_POWER,
    RES_SLIP_AREA,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_DY,
    STRIP_P0,
    STRIP_XC,
    STRIP_Y,
)
from contact.quadrature import EL_ATANH, EL_DX, EL_MIDDLE, EL_S, EL_SINE, EL_STEP
from contact.tangential.fastsim import NO_FRICTION, equivalent_ellipse

_LOG_ASPECT_FIT = 1.7  # ln(a/b) up to which the constants were fitted; frozen beyond


@kernel
def edge_direction(r, wx, wy):
    """Direction of slip at a slipping leading edge, where bound and traction start from zero."""
    size = math.sqrt(wx * wx + wy * wy)
    ex, ey = -wx / size, -wy / size
    for _ in range(3):
        slip = max(0.0, size - 2.0 * (r * ex * ex + ey * ey))
        ex, ey = -wx / (slip + 2.0 * r), -wy / (slip + 2.0)
        length = math.sqrt(ex * ex + ey * ey)
        ex, ey = ex / length, ey / length
    return ex, ey


@kernel
def turned(ex, ey, wx, wy, r, middle, rate, stretch):
    """Slip direction after a step: towards -W, with unequal flexibilities, exact for constant coefficients."""
    c = -middle * (1.0 - r)
    wx, wy = wx + c * ex, wy - c * ey
    w = math.sqrt(wx * wx + wy * wy)
    if w == 0.0:
        return ex, ey
    dx, dy = -wx / w, -wy / w
    cosine, sine = dx * ex + dy * ey, dx * ey - dy * ex
    if cosine < -1.0 + 1e-14:
        return ex, ey
    t = sine / (1.0 + cosine) * math.exp(-rate * w * stretch / (r * ey * ey + ex * ex))
    scale = 1.0 / (1.0 + t * t)
    cosine, sine = (1.0 - t * t) * scale, 2.0 * t * scale
    return dx * cosine - dy * sine, dy * cosine + dx * sine


@kernel
def mapped(ux, uy, o, m):
    """Traction over mu·p from the utilisation u of the parabolic bound in stick; `o` is the y component of the pole."""
    dx, dy = ux, uy - o
    square = dx * dx + dy * dy
    if square < 1e-28:
        return m * dx, o + m * dy
    along = o * dy
    t = min(square / (-along + math.sqrt(along * along + square * (1.0 - o * o))), 1.0)
    n = m - 0.5
    above = 1.0 - 0.5 * (2.0 + n) * t + (2.0 + n) * (1.0 + n) / 12.0 * t * t
    below = 1.0 - 0.5 * (2.0 - n) * t + (2.0 - n) * (1.0 - n) / 12.0 * t * t
    f = (1.0 - math.sqrt(1.0 - t) * above / below) / t if t > 1e-8 else m
    return dx * f, o + dy * f


@kernel
def slid(s, ex, ey, r, pole, Xs, Ys, spin, from_edge):
    """Slip of a particle at s that slides along (ex, ey), over the lateral flexibility; 0 or more.

    Where the strip slips from its edge this is the march's own slip. Behind a stick zone that ends at s_b the march has
    (1 - s) + (s_b - s), which belongs to the parabola, and strip theory 2√((1 - s)(s_b - s)), both times the traction
    without its spin part e - o (theory.md 4.3); the two agree, with their slopes, where the strip comes to slip as a whole.
    """
    fx, fy = ex, ey - pole
    stiffness = r * fx * fx + fy * fy
    ahead = -(Xs * fx + Ys * fy)
    if from_edge or ahead >= 2.0 * stiffness:  # s_b >= 1
        return max(-(Xs * ex + (Ys + 2.0 * spin * s) * ey) - 2.0 * s * (r * ex * ex + ey * ey), 0.0)
    back = ahead / stiffness - 1.0 - s if stiffness > 0.0 else 0.0
    return 2.0 * math.sqrt((1.0 - s) * max(back, 0.0)) * max(r * ex * fx + ey * fy, 0.0)


@kernel
def elastic_centre(strips, n, table, log_equivalent):
    """Blend the aspect ratios in place; return the centres of longitudinal stiffness and of spin, and the C33 factor.

    Weights C11·a·dy and C11·a²·dy; on an ellipse both centres are its own (mapped_strip.md 3, step 0).
    """
    stiffness, first, stiffness2, first2, spin = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        a, y = strips[STRIP_A, i], strips[STRIP_Y, i]
        log_aspect = 0.5 * (strips[STRIP_ASPECT, i] + log_equivalent)
        strips[STRIP_ASPECT, i] = log_aspect
        c11, _, _, c33 = kalker.coefficients(table, log_aspect)
        weight = c11 * a * strips[STRIP_DY, i]
        stiffness += weight
        first += weight * y
        stiffness2 += weight * a
        first2 += weight * a * y
        spin += weight * 4.0 * c33 * math.exp(log_aspect) / c11
    return first / stiffness, first2 / stiffness2, spin / stiffness


@kernel
def fastrip_mapped(strips, n, case, table, elements, lanes, trace, fields, result):
    """Fill the traction, slip and stick fields of `n` strips and the tangential part of `result`."""
    mu, G = case[CASE_MU], case[CASE_G]
    vx, phi = case[CASE_VX], case[CASE_PHI]
    n_el = elements.shape[1]
    Fx, Fy, Mz, power, slip_area = 0.0, 0.0, 0.0, 0.0, 0.0
    a_e, b_e = equivalent_ellipse(strips, n)
    y_c, y_spin, rho33 = 0.0, 0.0, 1.0
    if a_e > 0.0:
        y_c, y_spin, rho33 = elastic_centre(strips, n, table, math.log(a_e / b_e))
    for i in range(n):
        a, dy, y, xc = strips[STRIP_A, i], strips[STRIP_DY, i], strips[STRIP_Y, i], strips[STRIP_XC, i]
        row = min(i, fields.shape[1] - 1)  # one row serves all strips when only forces are asked for
        bound = mu * strips[STRIP_P0, i]
        if a <= 0.0 or bound <= NO_FRICTION * G:
            fields[FIELD_STICK, row, :] = 0.0
            fields[FIELD_QX : FIELD_SY + 1, row, :] = 0.0
            slip_area += 2.0 * a * dy
            continue
        log_aspect = strips[STRIP_ASPECT, i]
        c11, c22, c23, _ = kalker.coefficients(table, log_aspect)
        r = c22 / c11
        rho23 = 0.75 * math.pi * c23 / (c22 * math.exp(0.5 * log_aspect))
        k11 = 4.0 * G / (math.pi**2 * bound) * c11
        k22 = k11 * r
        translation = k11 * (vx - phi * y_c)
        rotation = -k11 * phi * (y - y_c)
        lateral = k22 * (case[CASE_VY] + phi * xc)
        psi = 0.5 * k22 * rho23 * phi * a

        # how far from stick (T) and how much spin (psi) set exponent, stiffness, spin and turning rate
        T2 = 0.25 * ((translation + rotation) ** 2 + lateral * lateral)
        psi2 = psi * psi
        h, t = psi2 / (1.0 + psi2), T2 / (1.0 + T2)
        w = 1.0 / (1.0 + 100.0 * (T2 + psi2))  # the linear range, in which C23 and C33 of the moment are made exact
        clipped = min(max(log_aspect, -_LOG_ASPECT_FIT), _LOG_ASPECT_FIT)
        m = min(0.95, 0.5 + (0.32 + 0.12 * clipped) * h)
        stretch = math.exp(0.47 * h) / (2.0 * m)
        spin = psi * math.exp((0.19 - 0.07 * clipped) * h)
        rate = math.exp(-0.43 + 0.79 * h - 0.54 * t)
        shift = (1.0 - rho23) * w
        X = stretch * (translation + (1.0 + (rho33 - 1.0) * w) * rotation - w * k11 * phi * (y_spin - y_c))
        Y = stretch * lateral * (1.0 - shift)
        P = spin + 2.0 * m * stretch * lateral * shift
        Xs, Ys = stretch * (translation + rotation) * r, stretch * lateral
        pole = -min(max(P, -1.0), 1.0)

        tau_x, tau_y, ex, ey, g = 0.0, 0.0, 0.0, 0.0, 0.0
        used = 0.0  # |u|² at the element before
        from_edge = 0.25 * X * X + (0.5 * Y + P) ** 2 > 1.0
        slips = from_edge
        sum_x, sum_y, sum_m = 0.0, 0.0, 0.0
        slip_scale = 1.0 / (stretch * k22)
        for k in range(n_el):
            s, step, middle = elements[EL_S, k], elements[EL_STEP, k], elements[EL_MIDDLE, k]
            sine = elements[EL_SINE, k]
            before, g = g, sine * sine
            wx, wy = Xs, Ys + 2.0 * spin * middle
            stick_share = 0.0
            if slips:
                slip = -2.0 * middle * (r * ex * ex + ey * ey) - (wx * ex + wy * ey)
                if k == 0:
                    ex, ey = edge_direction(r, wx, Ys + 2.0 * spin)
                elif slip <= 0.0:
                    slips = False
                    tau_x, tau_y, used = before * ex, before * ey, 1.0
                else:
                    ex, ey = turned(ex, ey, wx, wy, r, middle, rate, elements[EL_ATANH, k])
            if not slips:
                x, y_new = tau_x - step * X, tau_y - step * (Y + 2.0 * P * middle)
                size2 = x * x + y_new * y_new
                now = size2 / (g * g)
                if now > 1.0:  # the bound is reached within this step; the direction turns over the rest of it
                    slips = True
                    stick_share = (1.0 - used) / (now - used) if now > used else 0.0
                    tx, ty = tau_x + stick_share * (x - tau_x), tau_y + stick_share * (y_new - tau_y)
                    size = math.sqrt(tx * tx + ty * ty)
                    if k == 0 or size == 0.0:
                        size = math.sqrt(size2)
                        ex, ey = x / size, y_new / size
                    else:
                        ex, ey = turned(
                            tx / size, ty / size, wx, wy, r, middle, rate, (1.0 - stick_share) * elements[EL_ATANH, k]
                        )
                else:
                    tau_x, tau_y, used = x, y_new, now
                    stick_share = 1.0
            if slips:
                qx, qy = ex, ey
                slip = slip_scale * slid(s, ex, ey, r, pole, Xs, Ys, spin, from_edge)
                fields[FIELD_SX, row, k], fields[FIELD_SY, row, k] = -slip * ex, -slip * ey
                power += bound * sine * slip * a * elements[EL_DX, k] * dy
                fields[FIELD_STICK, row, k] = 0.0
            else:
                qx, qy = mapped(tau_x / g, tau_y / g, pole, m)
                fields[FIELD_SX, row, k], fields[FIELD_SY, row, k] = 0.0, 0.0
                fields[FIELD_STICK, row, k] = 1.0
            slip_area += (1.0 - stick_share) * a * elements[EL_DX, k] * dy
            weight = sine * elements[EL_DX, k]
            sum_x += weight * qx
            sum_y += weight * qy
            sum_m += weight * s * qy
            fields[FIELD_QX, row, k], fields[FIELD_QY, row, k] = bound * sine * qx, bound * sine * qy
        load = bound * a * dy
        Fx += load * sum_x
        Fy += load * sum_y
        Mz += load * (a * sum_m + xc * sum_y - y * sum_x)
    result[RES_FX], result[RES_FY], result[RES_MZ] = Fx, Fy, Mz
    result[RES_POWER], result[RES_SLIP_AREA] = power, slip_area
