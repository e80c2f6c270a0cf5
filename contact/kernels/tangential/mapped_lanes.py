"""Mapped strip marching before its march: rigid slip over flexibility, constants of a strip (mapped_strip.md 3, steps 1, 2)."""

import math
from enum import auto

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.rows import Strip
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.lanes import Now, Row, after, marching, small_exp
from contact.kernels.tangential.mapping import edge_direction, end_of_stick
from contact.kernels.tangential.march import March

_LOG_ASPECT_FIT = 1.7  # ln(a/b) up to which the constants were fitted; they stay constant beyond
#: Where the slip of spin counts: of the way from the middle of a strip to the line of least gap (mapped_strip.md 7).
_TO_LINE = 0.7


class Lane(Row):
    """Rows of `lanes` after those of the march: the strip's constants, and its sums over mu p0."""

    XS = after(March)  # rigid slip in slip, times the stiffness ratio: (XS, YS + 2 SPIN s)
    YS = auto()
    SPIN = auto()
    R = auto()  # C22/C11
    RATE = auto()
    N = auto()  # exponent of the map less 1/2
    POLE = auto()
    FROM_EDGE = auto()
    SUM_X = auto()
    SUM_Y = auto()
    SUM_M = auto()
    POWER = auto()
    STICK = auto()  # length in stick, over a
    BOUND = auto()  # mu p0
    UNIT = auto()  # of slip
    TO_X = auto()  # change of the rigid slip by effective creepages, in that unit: (TO_X, TO_Y + TO_SPIN s)
    TO_Y = auto()
    TO_SPIN = auto()
    ARC = auto()  # share of ∫ds/g of a step in which a strip begins to slide
    # the first stick zone (`stick_zone`)
    FROM = auto()  # s at its leading end
    FROM_X = auto()  # traction there
    FROM_Y = auto()
    TO = auto()  # 1 + s at its trailing end
    NEXT = auto()  # s of the element behind it: 2 before the zone, -2 within it
    NEXT_X = auto()  # direction of slip there
    NEXT_Y = auto()
    LAST = auto()  # s of the element ahead of it, or 2
    LAST_X = auto()
    LAST_Y = auto()


class _Input(Row):
    """Inputs of the set-up. Their rows are scratch of the march, which needs nothing of what stood there."""

    HALF = Now.X
    AT = Now.Y
    XC = Now.SLIP
    VX = Now.SLIDES
    VY = Now.STICK
    PHI = March.TRIAL_X
    C11 = March.TRIAL_Y
    C22 = March.TRIAL_USED
    C23 = Lane.SUM_X
    ROOT_ASPECT = Lane.SUM_Y
    FITTED = Lane.SUM_M
    CENTRE = Lane.POWER
    RHO33 = Lane.STICK


@kernel
def set_block(strips, block, last, case, table, lanes):
    """Fill `lanes` for the strips from `block` on: steps 1 and 2 of mapped_strip.md 3.

    All rows are zero for a strip that carries no load. The rigid slip of spin is that near the line of least gap: on a skewed
    patch, strips hold each other back (mapped_strip.md 7).
    """
    G = case.G
    least = NO_FRICTION * G
    for l in range(marching(lanes)):
        i = min(block + l, last - 1)
        a, bound, log_aspect = strips[Strip.A, i], case.mu * strips[Strip.BOUND, i], strips[Strip.ASPECT, i]
        lanes[Lane.BOUND + l] = bound if a > 0.0 and bound > least else 0.0
        lanes[_Input.HALF + l], lanes[_Input.AT + l] = a, strips[Strip.Y, i]
        lanes[_Input.XC + l] = strips[Strip.XC, i] - _TO_LINE * strips[Strip.OFFSET, i]
        to_x, to_y = (
            strips[Strip.TO_X, i] + strips[Strip.BY_PULL_X, i],
            strips[Strip.TO_Y, i] + strips[Strip.BY_PULL_Y, i],
        )
        to_phi = strips[Strip.TO_PHI, i]
        lanes[_Input.VX + l] = strips[Strip.VX, i] + strips[Strip.BY_FALL_X, i] + to_x
        lanes[_Input.VY + l] = strips[Strip.VY, i] + strips[Strip.BY_FALL_Y, i] + to_y
        lanes[_Input.PHI + l] = strips[Strip.PHI, i] + to_phi
        lanes[Lane.TO_X + l], lanes[Lane.TO_Y + l], lanes[Lane.TO_SPIN + l] = to_x, to_y, to_phi
        c11, c22, c23, _ = kalker.coefficients(table, log_aspect)
        lanes[_Input.C11 + l], lanes[_Input.C22 + l], lanes[_Input.C23 + l] = c11, c22, c23
        lanes[_Input.ROOT_ASPECT + l] = math.exp(0.5 * (log_aspect - strips[Strip.TURN, i]))  # of chord and width
        lanes[_Input.FITTED + l] = min(max(log_aspect, -_LOG_ASPECT_FIT), _LOG_ASPECT_FIT)
        lanes[Lane.N + l] = strips[Strip.TO_EXPONENT, i]
        lanes[_Input.CENTRE + l], lanes[_Input.RHO33 + l] = strips[Strip.CENTRE, i], strips[Strip.SPIN_FACTOR, i]
    edges = 0
    for l in range(marching(lanes)):
        bound, a, y, xc = lanes[Lane.BOUND + l], lanes[_Input.HALF + l], lanes[_Input.AT + l], lanes[_Input.XC + l]
        vx, vy, phi, fitted = (
            lanes[_Input.VX + l],
            lanes[_Input.VY + l],
            lanes[_Input.PHI + l],
            lanes[_Input.FITTED + l],
        )
        c11, c22, c23 = lanes[_Input.C11 + l], lanes[_Input.C22 + l], lanes[_Input.C23 + l]
        y_c, rho33 = lanes[_Input.CENTRE + l], lanes[_Input.RHO33 + l]
        live = 1.0 if bound > 0.0 else 0.0
        r = c22 / c11
        rho23 = 0.75 * math.pi * c23 / (c22 * lanes[_Input.ROOT_ASPECT + l])
        k11 = live * (4.0 / math.pi**2) * G * c11 / (bound + (1.0 - live))
        k22 = k11 * r
        translation = k11 * (vx - phi * y_c)
        rotation = -k11 * phi * (y - y_c)
        lateral = k22 * (vy + phi * xc)
        psi = 0.5 * k22 * rho23 * phi * a

        # T, the distance from stick, and psi, the spin, set exponent, stiffness, spin and turning rate
        T2 = 0.25 * ((translation + rotation) * (translation + rotation) + lateral * lateral)
        psi2 = psi * psi
        h, t = psi2 / (1.0 + psi2), T2 / (1.0 + T2)
        w = 1.0 / (1.0 + 100.0 * (T2 + psi2))  # the linear range, in which C23 and C33 of the moment are made exact
        n_map = (0.32 + 0.12 * fitted) * h
        n_map = (n_map if n_map < 0.45 else 0.45) + lanes[Lane.N + l]
        n_map = n_map if n_map < 0.45 else 0.45
        n_map = n_map if n_map > -0.3 else -0.3
        stretch = small_exp(0.47 * h) / (1.0 + 2.0 * n_map)
        spin = psi * small_exp((0.19 - 0.07 * fitted) * h)
        shift = (1.0 - rho23) * w
        X = stretch * (translation + (1.0 + (rho33 - 1.0) * w) * rotation)
        Y = stretch * lateral * (1.0 - shift)
        P = spin + (1.0 + 2.0 * n_map) * stretch * lateral * shift
        used = 0.25 * X * X + (0.5 * Y + P) * (0.5 * Y + P)
        from_edge = 1.0 if used > 1.0 else 0.0
        edges += 1 if used > 1.0 else 0
        pole = P if P < 1.0 else 1.0
        lanes[March.X + l], lanes[March.Y + l], lanes[March.Z + l] = X, Y, 2.0 * P
        lanes[Lane.XS + l], lanes[Lane.YS + l] = stretch * (translation + rotation) * r, stretch * lateral
        lanes[Lane.SPIN + l], lanes[Lane.R + l], lanes[Lane.N + l] = spin, r, n_map
        lanes[Lane.RATE + l] = small_exp(-0.43 + 0.79 * h - 0.54 * t)
        lanes[Lane.POLE + l] = -(pole if pole > -1.0 else -1.0)
        lanes[Lane.FROM_EDGE + l], lanes[March.SLIPS + l], lanes[March.USED + l] = (
            from_edge,
            from_edge,
            used if used < 1.0 else 1.0,
        )
        lanes[March.EX + l], lanes[March.EY + l] = 0.0, 0.0
        lanes[Lane.TO + l] = end_of_stick(X, Y, P)
        lanes[Lane.NEXT + l] = -2.0 + 4.0 * from_edge
        per_unit, to_phi = stretch * k22, lanes[Lane.TO_SPIN + l]
        lanes[Lane.UNIT + l] = live / (per_unit + (1.0 - live))
        lanes[Lane.TO_X + l] = per_unit * (lanes[Lane.TO_X + l] - to_phi * y)
        lanes[Lane.TO_Y + l] = per_unit * (lanes[Lane.TO_Y + l] + to_phi * xc)
        lanes[Lane.TO_SPIN + l] = per_unit * to_phi * a
    if edges > 0:
        _set_edges(lanes)
    for l in range(marching(lanes)):
        lanes[March.TX + l], lanes[March.TY + l], lanes[March.LEFT + l], lanes[March.CAME + l] = 0.0, 0.0, 1.0, -2.0
        lanes[Lane.SUM_X + l], lanes[Lane.SUM_Y + l], lanes[Lane.SUM_M + l] = 0.0, 0.0, 0.0
        lanes[Lane.POWER + l], lanes[Lane.STICK + l] = 0.0, 0.0
        lanes[Lane.FROM + l], lanes[Lane.FROM_X + l], lanes[Lane.FROM_Y + l], lanes[Lane.LAST + l] = 1.0, 0.0, 0.0, 2.0
        lanes[Lane.NEXT_X + l], lanes[Lane.NEXT_Y + l] = 0.0, 0.0
        lanes[Lane.LAST_X + l], lanes[Lane.LAST_Y + l], lanes[Lane.ARC + l] = 0.0, 0.0, 0.0


@kernel
def _set_edges(lanes):
    """Fill the direction of the strips that slip from their leading edge."""
    for l in range(marching(lanes)):
        ex, ey = edge_direction(lanes[Lane.R + l], lanes[Lane.XS + l], lanes[Lane.YS + l] + 2.0 * lanes[Lane.SPIN + l])
        lanes[March.EX + l], lanes[March.EY + l] = lanes[Lane.FROM_EDGE + l] * ex, lanes[Lane.FROM_EDGE + l] * ey
