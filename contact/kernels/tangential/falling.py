"""Mapped strip marching under friction that falls along the strips with slip or temperature (theory.md 8.1).

Behind a stick zone that ends at s = b let friction lack the share d(s) of the coefficient at rest. This takes traction from the
slip zone, and changes that of the stick zone, which must still have no slip. For one strip of elastic half planes Carter's
equation has a closed solution. With R(t) = √((b - t)(1 - t)), the pressure p(t) = √(1 - t²) and, over the slip zone,

    J = 1/π ∫ d p/R dt,    Q = ∫ d p [((1 + b)/2 - t)/R - 1] dt,

stick ends where it would end if the rigid slip were greater by 2 J, and the traction of the stick zone is less by

    q(s) = √((s - b)(1 - s)) 1/π ∫ d p/(R (s - t)) dt,    ∫ q ds = Q.

Here q has one pole for all d, at the place that gives Q. For small d the force falls by ∫ d p √((b - t)/(1 - t)) dt: what slip
lacks near the stick zone, the stick zone bears. The slip itself is greater by 2 d (s + (1 - b)/2). Where a strip slips from its
edge, b = 1 and the slip is greater by 2 (J - d(1) + d s); this is exact if d is linear in s.
"""

import math

from contact.core import kernel
from contact.kernels.friction import fallen
from contact.kernels.rows import Element, Strip
from contact.kernels.tangential.lanes import LANES, Now, Row, Varying
from contact.kernels.tangential.mapped_lanes import Lane
from contact.kernels.tangential.mapping import edge_direction
from contact.kernels.tangential.stick_zone import add_zone
from contact.kernels.tangential.varying import soften


class Fallen(Row):
    """Column of `trace` with the share of the traction that friction still bears."""

    SHARE = Now.STICK


@kernel
def _end_of_stick(lanes, l):
    """Return s where a strip that sticks at its leading edge begins to slip; 1 where it slips from there."""
    return lanes[Lane.TO + l] - 1.0 if lanes[Lane.FROM_EDGE + l] < 0.5 else 1.0


@kernel
def _lack_at_edge(case, lanes, l):
    """Return what friction lacks at the leading edge of a strip that slips from there; 0 if it sticks."""
    r, x, y = lanes[Lane.R + l], lanes[Lane.XS + l], lanes[Lane.YS + l] + 2.0 * lanes[Lane.SPIN + l]
    if lanes[Lane.FROM_EDGE + l] < 0.5:
        return 0.0
    ex, ey = edge_direction(r, x, y)
    slip = -(x * ex + y * ey) - 2.0 * (r * ex * ex + ey * ey)
    return 1.0 - fallen(case, slip * lanes[Varying.UNIT + l], 0.0, 1.0)


@kernel
def _with_own_fall(case, s, slip, stick, direction, lanes, l):
    """Return the slip, over V, to which the fall of friction changes the `slip` under the coefficient at rest.

    The elastic part of the slip follows the traction, here that of the element.
    """
    x, y = direction
    end = _end_of_stick(lanes, l)
    at = s + (0.5 * (1.0 - end) if s < end else 0.0)
    lack = 1.0 - fallen(case, slip, stick, 1.0)
    return max(slip + 2.0 * lack * at * (lanes[Lane.R + l] * x * x + y * y) * lanes[Varying.UNIT + l], 0.0)


@kernel
def let_fall(case, factor, elements, lanes, trace):
    """Fill `trace` with the slip, and the share of the traction that friction still bears. Sum up what friction lacks.

    `factor` scales the slip.
    """
    for l in range(LANES):
        lanes[Varying.UNIT + l] = lanes[Lane.UNIT + l] * factor
        lanes[Varying.LACK_X + l], lanes[Varying.LACK_Y + l] = 0.0, 0.0
        lanes[Varying.SHED_X + l], lanes[Varying.SHED_Y + l] = 0.0, 0.0
    for k in range(elements.shape[1]):
        s, sine = elements[Element.S, k], elements[Element.SINE, k]
        weight = sine * elements[Element.DX, k]
        for l in range(LANES):
            unit, stick = lanes[Varying.UNIT + l], trace[k, Now.STICK + l]
            direction = trace[k, Now.X + l], trace[k, Now.Y + l]
            cold = trace[k, Now.SLIP + l] * unit
            slip = _with_own_fall(case, s, cold, stick, direction, lanes, l) if cold > 0.0 else cold
            lanes[Varying.SLIP + l], lanes[Varying.FLUX + l] = slip, lanes[Varying.HEATING + l] * sine * slip
            lanes[Now.STICK + l] = stick
            if slip != cold:
                trace[k, Now.SLIP + l] = slip / unit
        soften(case, k, elements, lanes, trace)
        for l in range(LANES):
            x, y, fall = trace[k, Now.X + l], trace[k, Now.Y + l], lanes[Varying.FALL + l]
            used, share = math.sqrt(x * x + y * y), 1.0
            if fall < 1.0 and used > fall:
                share = fall / used
                trace[k, Now.SLIDES + l], trace[k, Now.STICK + l] = 1.0, 0.0
                end = _end_of_stick(lanes, l)
                if s < end:
                    root = math.sqrt((end - s) * (1.0 - s))
                    lack = weight * (1.0 - share) / root
                    shed = lack * (0.5 * (1.0 + end) - s - root)
                    lanes[Varying.LACK_X + l] += lack * x
                    lanes[Varying.LACK_Y + l] += lack * y
                    lanes[Varying.SHED_X + l] += shed * x
                    lanes[Varying.SHED_Y + l] += shed * y
            lanes[Lane.STICK + l] += elements[Element.STEP, k] * (trace[k, Now.STICK + l] - lanes[Now.STICK + l])
            trace[k, Fallen.SHARE + l] = share


@kernel
def set_loss(strips, block, last, case, lanes):
    """Set the change of creepages of a block: 2 (J - d(1)), with which stick ends where falling friction makes it end."""
    for l in range(min(LANES, last - block)):
        unit, at_edge = -2.0 * lanes[Lane.UNIT + l], _lack_at_edge(case, lanes, l)
        x, y = lanes[Varying.LACK_X + l], lanes[Varying.LACK_Y + l]
        lack = math.sqrt(x * x + y * y)
        share = 1.0 / math.pi - (at_edge / lack if lack > 0.0 else 0.0)
        strips[Strip.BY_FALL_X, block + l] = unit * share * lanes[Lane.R + l] * x
        strips[Strip.BY_FALL_Y, block + l] = unit * share * y


@kernel
def _relieve(elements, lanes, trace):
    """Take from the traction of the stick zones at the edge what they lose by the fall of friction behind them."""
    for l in range(LANES):
        lack_x, lack_y = lanes[Varying.LACK_X + l] / math.pi, lanes[Varying.LACK_Y + l] / math.pi
        square, end = lack_x * lack_x + lack_y * lack_y, _end_of_stick(lanes, l)
        shed = lack_x * lanes[Varying.SHED_X + l] + lack_y * lanes[Varying.SHED_Y + l]
        if not shed > 0.0:
            continue
        middle, half, force = 0.5 * (1.0 + end), 0.5 * (1.0 - end), shed / square  # force per lack
        away = force / math.pi
        pole = middle - 0.5 * (away + half * half / away)
        moment = 0.5 * math.pi * half * half + pole * force
        lanes[Lane.SUM_X + l] -= force * lack_x
        lanes[Lane.SUM_Y + l] -= force * lack_y
        lanes[Lane.SUM_M + l] -= moment * lack_y
        for k in range(elements.shape[1]):
            s = elements[Element.S, k]
            if s > end:
                less = math.sqrt((s - end) * (1.0 - s)) / ((s - pole) * elements[Element.SINE, k])
                trace[k, Now.X + l] -= less * lack_x
                trace[k, Now.Y + l] -= less * lack_y


@kernel
def sum_up(elements, lanes, trace):
    """Sum up forces and power of a block."""
    for l in range(LANES):
        lanes[Lane.SUM_X + l], lanes[Lane.SUM_Y + l], lanes[Lane.SUM_M + l] = 0.0, 0.0, 0.0
        lanes[Lane.POWER + l] = 0.0
    for k in range(elements.shape[1]):
        s, weight = elements[Element.S, k], elements[Element.SINE, k] * elements[Element.DX, k]
        for l in range(LANES):
            share = trace[k, Fallen.SHARE + l]
            counts = 0.0 if lanes[Lane.FROM + l] > s > lanes[Lane.NEXT + l] else weight * share
            lanes[Lane.SUM_X + l] += counts * trace[k, Now.X + l]
            lanes[Lane.SUM_Y + l] += counts * trace[k, Now.Y + l]
            lanes[Lane.SUM_M + l] += counts * s * trace[k, Now.Y + l]
            lanes[Lane.POWER + l] += weight * share * trace[k, Now.SLIP + l]
    add_zone(elements, lanes)
    _relieve(elements, lanes, trace)
