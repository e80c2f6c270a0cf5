"""Mapped strip marching: FaStrip in one march, defined where the strip theory of the thesis is not.

Normalise a strip as x = x_c + a s, traction tau in a march with the parabolic bound 1 - s², u = tau/(1 - s²). With the
flexibilities of the amended strip theory the first stick zone |u| < 1 is identical to strip theory's, and
    q/(mu p) = o + (u - o) f(t)/t,  f(t) = 1 - (1 - t)^m,  o = (0, -psi),
maps the march onto the elliptic pressure, where t is the position of u on the ray from o to the unit circle; m = 1/2 is
strip theory exactly. March and map stay defined for |psi| >= 1, lateral creepage against spin, stick after slip, and any
pressure along the strip. Eight constants, of one half of the ellipses computed with CONTACT, let m, the spin and the turning
of the slip direction vary with spin and aspect ratio (mapped_strip.md, which measures every choice).

On a patch that is no ellipse the logarithm of the aspect ratio of a strip is .6 of the local one, from the curvatures, and
.4 of that of the equivalent ellipse. Strips roll with effective creepages (`effective`), which give the half space's forces
on ellipses: on set A the mean error of the force is .0025 of mu N, without them .0077; on real patches .0062 and .0114.
"""

import math

from contact._jit import kernel
from contact.kernels import kalker
from contact.kernels.layout import Element, Field, Strip
from contact.kernels.tangential.effective import set_effective
from contact.kernels.tangential.ellipses import equivalent_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.lanes import (
    FALL,
    FAR,
    FLUX,
    FREE_ROW,
    HEATING,
    LANES,
    N_LANE_ROWS,
    NOW_SLIDES,
    NOW_SLIP,
    NOW_STICK,
    NOW_X,
    NOW_Y,
    SLIP,
    decay_and_lag,
    keep,
    small_exp,
    turned,
)
from contact.kernels.tangential.mapping import edge_direction, elastic_centre, mapped, slid_at
from contact.kernels.tangential.varying import begin, soften, varies

_NOW_SHARE = NOW_STICK  # where `_fall` leaves the share of the traction that friction still bears
_LOG_ASPECT_FIT = 1.7  # ln(a/b) up to which the constants were fitted; frozen beyond


# rows of `lanes`: the strip's constants, its state, its sums over mu p0
(
    _X,  # rigid slip over flexibility in stick: (X, Y + 2 P s)
    _Y,
    _P,
    _XS,  # in slip, times the stiffness ratio: (XS, YS + 2 SPIN s)
    _YS,
    _SPIN,
    _R,  # C22/C11
    _RATE,
    _N,  # exponent of the map less 1/2
    _POLE,
    _FROM_EDGE,
    _TX,
    _TY,
    _SLIPS,
    _USED,  # |u|²
    _TRIAL_X,  # traction in stick, with its |u|²
    _TRIAL_Y,
    _TRIAL_USED,
    _LEFT,  # share of the step when a strip comes to slide
    _SUM_X,
    _SUM_Y,
    _SUM_M,
    _POWER,
    _STICK,  # length in stick, over a
    _EX,  # direction of slip
    _EY,
    _BOUND,  # mu p0
    _UNIT,  # of slip
    _TO_X,  # what effective creepages add to the rigid slip, in that unit: (_TO_X, _TO_Y + _TO_SPIN s)
    _TO_Y,
    _TO_SPIN,
) = (FREE_ROW + row * LANES for row in range(31))
# what the set-up reads, in rows that the march writes before it reads them
_HALF, _AT, _XC, _VX, _VY = NOW_X, NOW_Y, NOW_SLIP, NOW_SLIDES, NOW_STICK
_PHI, _C11, _C22, _C23, _ROOT_ASPECT, _FITTED = _TRIAL_X, _TRIAL_Y, _TRIAL_USED, _SUM_X, _SUM_Y, _SUM_M


@kernel
def _set_block(strips, block, last, case, table, centres, lanes):
    """Steps 1 and 2 of mapped_strip.md 3 for the strips from `block` on; all zero for a strip that bears nothing."""
    G = case.G
    y_c, y_spin, rho33 = centres
    least = NO_FRICTION * G
    for l in range(LANES):
        i = min(block + l, last - 1)
        a, bound, log_aspect = strips[Strip.A, i], case.mu * strips[Strip.BOUND, i], strips[Strip.ASPECT, i]
        lanes[_BOUND + l] = bound if a > 0.0 and bound > least else 0.0
        lanes[_HALF + l], lanes[_AT + l], lanes[_XC + l] = a, strips[Strip.Y, i], strips[Strip.XC, i]
        to_x, to_y, to_phi = strips[Strip.TO_X, i], strips[Strip.TO_Y, i], strips[Strip.TO_PHI, i]
        lanes[_VX + l], lanes[_VY + l] = strips[Strip.VX, i] + to_x, strips[Strip.VY, i] + to_y
        lanes[_PHI + l] = strips[Strip.PHI, i] + to_phi
        lanes[_TO_X + l], lanes[_TO_Y + l], lanes[_TO_SPIN + l] = to_x, to_y, to_phi
        c11, c22, c23, _ = kalker.coefficients(table, log_aspect)
        lanes[_C11 + l], lanes[_C22 + l], lanes[_C23 + l] = c11, c22, c23
        lanes[_ROOT_ASPECT + l] = math.exp(0.5 * log_aspect)
        lanes[_FITTED + l] = min(max(log_aspect, -_LOG_ASPECT_FIT), _LOG_ASPECT_FIT)
        lanes[_N + l] = strips[Strip.TO_EXPONENT, i]
    edges = 0
    for l in range(lanes.size // N_LANE_ROWS):
        bound, a, y, xc = lanes[_BOUND + l], lanes[_HALF + l], lanes[_AT + l], lanes[_XC + l]
        vx, vy, phi, fitted = lanes[_VX + l], lanes[_VY + l], lanes[_PHI + l], lanes[_FITTED + l]
        c11, c22, c23 = lanes[_C11 + l], lanes[_C22 + l], lanes[_C23 + l]
        live = 1.0 if bound > 0.0 else 0.0
        r = c22 / c11
        rho23 = 0.75 * math.pi * c23 / (c22 * lanes[_ROOT_ASPECT + l])
        k11 = live * (4.0 / math.pi**2) * G * c11 / (bound + (1.0 - live))
        k22 = k11 * r
        translation = k11 * (vx - phi * y_c)
        rotation = -k11 * phi * (y - y_c)
        lateral = k22 * (vy + phi * xc)
        psi = 0.5 * k22 * rho23 * phi * a

        # how far from stick (T) and how much spin (psi) set exponent, stiffness, spin and turning rate
        T2 = 0.25 * ((translation + rotation) * (translation + rotation) + lateral * lateral)
        psi2 = psi * psi
        h, t = psi2 / (1.0 + psi2), T2 / (1.0 + T2)
        w = 1.0 / (1.0 + 100.0 * (T2 + psi2))  # the linear range, in which C23 and C33 of the moment are made exact
        n_map = (0.32 + 0.12 * fitted) * h
        n_map = (n_map if n_map < 0.45 else 0.45) + lanes[_N + l]
        n_map = n_map if n_map < 0.45 else 0.45
        n_map = n_map if n_map > -0.3 else -0.3
        stretch = small_exp(0.47 * h) / (1.0 + 2.0 * n_map)
        spin = psi * small_exp((0.19 - 0.07 * fitted) * h)
        shift = (1.0 - rho23) * w
        X = stretch * (translation + (1.0 + (rho33 - 1.0) * w) * rotation - w * k11 * phi * (y_spin - y_c))
        Y = stretch * lateral * (1.0 - shift)
        P = spin + (1.0 + 2.0 * n_map) * stretch * lateral * shift
        used = 0.25 * X * X + (0.5 * Y + P) * (0.5 * Y + P)
        from_edge = 1.0 if used > 1.0 else 0.0
        edges += 1 if used > 1.0 else 0
        pole = P if P < 1.0 else 1.0
        lanes[_X + l], lanes[_Y + l], lanes[_P + l] = X, Y, P
        lanes[_XS + l], lanes[_YS + l] = stretch * (translation + rotation) * r, stretch * lateral
        lanes[_SPIN + l], lanes[_R + l], lanes[_N + l] = spin, r, n_map
        lanes[_RATE + l] = small_exp(-0.43 + 0.79 * h - 0.54 * t)
        lanes[_POLE + l] = -(pole if pole > -1.0 else -1.0)
        lanes[_FROM_EDGE + l], lanes[_SLIPS + l], lanes[_USED + l] = from_edge, from_edge, used if used < 1.0 else 1.0
        lanes[_EX + l], lanes[_EY + l] = 0.0, 0.0
        per_unit, to_phi = stretch * k22, lanes[_TO_SPIN + l]
        lanes[_UNIT + l] = live / (per_unit + (1.0 - live))
        lanes[_TO_X + l] = per_unit * (lanes[_TO_X + l] - to_phi * y)
        lanes[_TO_Y + l] = per_unit * (lanes[_TO_Y + l] + to_phi * xc)
        lanes[_TO_SPIN + l] = per_unit * to_phi * a
    if edges > 0:
        _set_edges(lanes)
    for l in range(lanes.size // N_LANE_ROWS):
        lanes[_TX + l], lanes[_TY + l], lanes[_LEFT + l] = 0.0, 0.0, 1.0
        lanes[_SUM_X + l], lanes[_SUM_Y + l], lanes[_SUM_M + l] = 0.0, 0.0, 0.0
        lanes[_POWER + l], lanes[_STICK + l] = 0.0, 0.0


@kernel
def _set_edges(lanes):
    """Directions of the strips that slip from their leading edge."""
    for l in range(lanes.size // N_LANE_ROWS):
        ex, ey = edge_direction(lanes[_R + l], lanes[_XS + l], lanes[_YS + l] + 2.0 * lanes[_SPIN + l])
        lanes[_EX + l], lanes[_EY + l] = lanes[_FROM_EDGE + l] * ex, lanes[_FROM_EDGE + l] * ey


@kernel
def _march(elements, lanes, trace):
    """Steps 3 and 4: march a block of strips, map and sum; leave traction over mu p, slip, share in stick in `trace`."""
    s = 1.0
    for k in range(elements.shape[1]):
        before, s, step, middle = s, elements[Element.S, k], elements[Element.STEP, k], elements[Element.MIDDLE, k]
        bound = elements[Element.SINE, k] ** 2
        per_bound = 1.0 / bound
        come, slide, stick = 0, 0, 0
        for l in range(LANES):
            x = lanes[_TX + l] - step * lanes[_X + l]
            y = lanes[_TY + l] - step * (lanes[_Y + l] + 2.0 * lanes[_P + l] * middle)
            used = (x * x + y * y) * per_bound * per_bound
            lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l] = x, y, used
            slide += 1 if lanes[_SLIPS + l] > 0.5 else 0
            come += 1 if used > 1.0 and lanes[_SLIPS + l] < 0.5 else 0
        if come > 0:
            _come_to_slide(lanes)
        if come + slide > 0:
            # at the edge the direction is that of the equilibrium
            stop = _slide(s, step, middle, elements[Element.ATANH, k] if k > 0 else 0.0, bound, lanes)
            if stop > 0:
                _stop(before, s, step, per_bound, lanes)
        else:
            for l in range(LANES):
                lanes[_TX + l], lanes[_TY + l] = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l]
                lanes[_USED + l] = lanes[_TRIAL_USED + l]
                lanes[NOW_SLIP + l], lanes[NOW_SLIDES + l], lanes[NOW_STICK + l] = 0.0, 0.0, 1.0
        for l in range(LANES):
            stick += 1 if lanes[_SLIPS + l] < 0.5 else 0
            lanes[NOW_X + l], lanes[NOW_Y + l] = lanes[_EX + l], lanes[_EY + l]
        if stick > 0:
            _map(per_bound, lanes)
        weight = elements[Element.SINE, k] * elements[Element.DX, k]
        for l in range(LANES):
            lanes[_SUM_X + l] += weight * lanes[NOW_X + l]
            lanes[_SUM_Y + l] += weight * lanes[NOW_Y + l]
            lanes[_SUM_M + l] += weight * s * lanes[NOW_Y + l]
            lanes[_POWER + l] += weight * lanes[NOW_SLIP + l]
            lanes[_STICK + l] += step * lanes[NOW_STICK + l]
        keep(lanes, trace[k])


@kernel
def _map(per_bound, lanes):
    """Map the traction of the strips that stick.

    The count of lanes is LANES; unknown to the compiler, which would write out so short a loop instead of using vectors.
    """
    for l in range(lanes.size // N_LANE_ROWS):
        x, y, slides = lanes[_TX + l] * per_bound, lanes[_TY + l] * per_bound, lanes[_SLIPS + l]
        map_x, map_y = mapped(x, y, lanes[_POLE + l], lanes[_N + l])
        lanes[NOW_X + l] = map_x + slides * (lanes[_EX + l] - map_x)
        lanes[NOW_Y + l] = map_y + slides * (lanes[_EY + l] - map_y)


@kernel
def _come_to_slide(lanes):
    """As `march._come_to_slide`."""
    for l in range(LANES):
        x, y, used, before = lanes[_TX + l], lanes[_TY + l], lanes[_TRIAL_USED + l], lanes[_USED + l]
        comes = 1.0 - lanes[_SLIPS + l] if used > 1.0 else 0.0
        gap = used - before
        share = (1.0 - before) / (gap if gap > 1e-12 else 1.0)
        x, y = x + share * (lanes[_TRIAL_X + l] - x), y + share * (lanes[_TRIAL_Y + l] - y)
        per_size = 1.0 / (math.sqrt(x * x + y * y) + 1e-300)
        # sums, not choices: the compiler would put roots and divisions behind a branch
        lanes[_EX + l] += comes * (x * per_size - lanes[_EX + l])
        lanes[_EY + l] += comes * (y * per_size - lanes[_EY + l])
        lanes[_LEFT + l] = 1.0 - comes * share


@kernel
def _slide(s, step, middle, stretch, bound, lanes):
    """As `march._slide`, with unequal flexibilities."""
    stop = 0
    for l in range(LANES):
        Xs, Ys, spin, r = lanes[_XS + l], lanes[_YS + l], lanes[_SPIN + l], lanes[_R + l]
        slid, x, y, left = lanes[_SLIPS + l], lanes[_EX + l], lanes[_EY + l], lanes[_LEFT + l]
        trial_x, trial_y, used = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l]
        c = -middle * (1.0 - r)
        wx, wy = Xs + c * x, Ys + 2.0 * spin * middle - c * y
        rate = lanes[_RATE + l] * left * stretch / (r * y * y + x * x + 1e-300)
        far = rate * math.sqrt(wx * wx + wy * wy)
        rest, lag = decay_and_lag(far if far < FAR else FAR)
        at = s + left * step * (1.0 - lag)
        c = -at * (1.0 - r)
        wx, wy = Xs + c * x, Ys + 2.0 * spin * at - c * y
        w = math.sqrt(wx * wx + wy * wy) + 1e-300
        ex, ey = turned(x, y, wx, wy, w, rest)
        slip = -2.0 * s * (r * ex * ex + ey * ey) - (Xs * ex + (Ys + 2.0 * spin * s) * ey)
        slides = 1.0 if used > 1.0 else slid
        stop += 1 if slides > 0.5 and slip < 0.0 else 0
        shown = slid_at(s, (ex, ey), r, lanes[_POLE + l], (Xs, Ys, spin), lanes[_FROM_EDGE + l])
        lanes[_EX + l], lanes[_EY + l] = ex, ey
        lanes[_TX + l] = bound * ex if slides > 0.5 else trial_x
        lanes[_TY + l] = bound * ey if slides > 0.5 else trial_y
        lanes[_SLIPS + l], lanes[_USED + l], lanes[_LEFT + l] = slides, used, 1.0
        shown += lanes[_TO_X + l] * ex + (lanes[_TO_Y + l] + lanes[_TO_SPIN + l] * s) * ey
        lanes[NOW_SLIP + l], lanes[NOW_SLIDES + l] = 0.5 * (shown + abs(shown)) * slides, slides
        lanes[NOW_STICK + l] = (1.0 - slid) * (1.0 - left) if slides > 0.5 else 1.0
        lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l] = x, y, slid
    return stop


@kernel
def _stop(before, s, step, per_bound, lanes):
    """As `march._stop`, with unequal flexibilities."""
    for l in range(LANES):
        Xs, Ys, spin, r = lanes[_XS + l], lanes[_YS + l], lanes[_SPIN + l], lanes[_R + l]
        x, y, ex, ey = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_EX + l], lanes[_EY + l]
        slid = lanes[_TRIAL_USED + l]
        slip_before = -2.0 * before * (r * x * x + y * y) - (Xs * x + (Ys + 2.0 * spin * before) * y)
        slip = -2.0 * s * (r * ex * ex + ey * ey) - (Xs * ex + (Ys + 2.0 * spin * s) * ey)
        share = slip_before / (slip_before - slip + 1e-300)
        share = share if slip_before > 0.0 else 0.0
        ux, uy = x + share * (ex - x), y + share * (ey - y)
        at, left = before - share * step, (1.0 - share) * step
        size = (1.0 - at * at) * (1.5 - 0.5 * (ux * ux + uy * uy))
        stick_x = size * ux - left * lanes[_X + l]
        stick_y = size * uy - left * (lanes[_Y + l] + lanes[_P + l] * (at + s))
        used = (stick_x * stick_x + stick_y * stick_y) * per_bound * per_bound
        stops = slip < 0.0 and slid > 0.5 and used < 1.0
        lanes[_TX + l] = stick_x if stops else lanes[_TX + l]
        lanes[_TY + l] = stick_y if stops else lanes[_TY + l]
        lanes[_USED + l] = used if stops else lanes[_USED + l]
        lanes[_SLIPS + l] = 0.0 if stops else lanes[_SLIPS + l]
        lanes[NOW_SLIP + l] = 0.0 if stops else lanes[NOW_SLIP + l]
        lanes[NOW_SLIDES + l] = 0.0 if stops else lanes[NOW_SLIDES + l]
        lanes[NOW_STICK + l] = 1.0 - share if stops else lanes[NOW_STICK + l]


@kernel
def _fall(case, elements, lanes, trace):
    """Let friction vary along the strips of a block: what it bears of the traction into `trace`, new sums."""
    for l in range(LANES):
        lanes[_SUM_X + l], lanes[_SUM_Y + l], lanes[_SUM_M + l] = 0.0, 0.0, 0.0
        lanes[_POWER + l], lanes[_STICK + l] = 0.0, 0.0
    for k in range(elements.shape[1]):
        sine = elements[Element.SINE, k]
        weight = sine * elements[Element.DX, k]
        for l in range(LANES):
            slip = trace[k, NOW_SLIP + l] * lanes[_UNIT + l]
            lanes[SLIP + l], lanes[FLUX + l] = slip, lanes[HEATING + l] * sine * slip
            lanes[NOW_STICK + l] = trace[k, NOW_STICK + l]
        soften(case, k, elements, lanes, trace)
        for l in range(LANES):
            qx, qy, slip, fall = trace[k, NOW_X + l], trace[k, NOW_Y + l], trace[k, NOW_SLIP + l], lanes[FALL + l]
            used, share = math.sqrt(qx * qx + qy * qy), 1.0
            if fall < 1.0 and used > fall:
                share = fall / used
                trace[k, NOW_SLIDES + l], trace[k, NOW_STICK + l] = 1.0, 0.0
            lanes[_SUM_X + l] += weight * (qx * share)
            lanes[_SUM_Y + l] += weight * (qy * share)
            lanes[_SUM_M + l] += weight * elements[Element.S, k] * (qy * share)
            lanes[_POWER + l] += weight * slip * share
            lanes[_STICK + l] += elements[Element.STEP, k] * trace[k, NOW_STICK + l]
            trace[k, _NOW_SHARE + l] = share


@kernel
def _write_fields(block, last, elements, falling, lanes, trace, fields):
    """Traction, slip and stick flag of a block's strips, element by element: so `trace` is read as it lies in memory."""
    for k in range(elements.shape[1]):
        for l in range(min(LANES, last - block)):
            i, bound = block + l, lanes[_BOUND + l]
            qx, qy, slip = trace[k, NOW_X + l], trace[k, NOW_Y + l], trace[k, NOW_SLIP + l] * lanes[_UNIT + l]
            size = bound * elements[Element.SINE, k] * (trace[k, _NOW_SHARE + l] if falling else 1.0)
            fields[Field.QX, i, k], fields[Field.QY, i, k] = size * qx, size * qy
            fields[Field.SX, i, k], fields[Field.SY, i, k] = -slip * qx, -slip * qy
            fields[Field.STICK, i, k] = 1.0 - trace[k, NOW_SLIDES + l] if bound > 0.0 else 0.0


@kernel
def roll_patch(first, last, case, centres, own, result):
    """Add what the strips of a patch bear to `result`; fill their fields if there is room. `centres`: `elastic_centre`."""
    strips, fields, elements = own.strips, own.fields, own.rule.elements
    lanes, trace = own.space.lanes, own.space.trace
    behind = 1.0 + elements[Element.S, -1]  # the middle of the last element
    falling = varies(case)
    for block in range(first, last, LANES):
        _set_block(strips, block, last, case, own.tables.kalker, centres, lanes)
        _march(elements, lanes, trace)
        if falling:
            begin(strips, block, last, case, _BOUND, lanes)
            _fall(case, elements, lanes, trace)
        for l in range(min(LANES, last - block)):
            i = block + l
            a, dy, y, xc = strips[Strip.A, i], strips[Strip.DY, i], strips[Strip.Y, i], strips[Strip.XC, i]
            bound, unit = lanes[_BOUND + l], lanes[_UNIT + l]
            load = bound * a * dy
            Fx, Fy = load * lanes[_SUM_X + l], load * lanes[_SUM_Y + l]
            result.Fx += Fx
            result.Fy += Fy
            result.Mz += load * a * lanes[_SUM_M + l] + xc * Fy - y * Fx
            result.power += load * lanes[_POWER + l] * unit
            stick = lanes[_STICK + l] + behind * (1.0 - lanes[_SLIPS + l]) if bound > 0.0 else 0.0
            result.slip_area += max(2.0 - stick, 0.0) * a * dy
        if fields.shape[1] >= last:  # else only forces are asked for
            _write_fields(block, last, elements, falling, lanes, trace, fields)


@kernel
def fastrip_mapped(part, case, own, result):
    """Fill the traction, slip and stick fields of one patch and add what it bears to `result`."""
    strips, tables = own.strips, own.tables
    a, b = equivalent_ellipse(strips, part.first, part.last)
    centres = 0.0, 0.0, 1.0
    if a > 0.0:
        centres = elastic_centre(strips, part.first, part.last, tables.kalker, math.log(a / b))
        set_effective(strips, part.first, part.last, case, centres[0], tables)
    roll_patch(part.first, part.last, case, centres, own, result)
