"""Mapped strip marching: FaStrip in one march, also defined where the strip theory of the thesis is not.

A strip is normalised as x = x_c + a s. With the traction tau of a march under the parabolic bound 1 - s², let u =
tau/(1 - s²). With the flexibilities of the amended strip theory the first stick zone |u| < 1 is identical to strip
theory's, and

    q/(mu p) = o + (u - o) f(t)/t,  f(t) = 1 - (1 - t)^m,  o = (0, -psi),

maps the march onto the elliptic pressure. t is the position of u on the ray from o to the unit circle. m = 1/2 is
exactly strip theory. March and map remain defined for |psi| >= 1, lateral creepage against spin, stick after slip, and
any pressure along the strip. Eight constants let m, the spin and the turning of the slip direction vary with spin and
aspect ratio. They were fitted to one half of the ellipses computed with CONTACT (mapped_strip.md measures every
choice).

On a patch that is not an ellipse the aspect ratio of a strip has a share of the local one, from the curvatures, and one
of that of the equivalent ellipse (`mapping.set_aspects`). Strips roll with effective creepages (`effective`), which give the
half space's forces on ellipses. On set A the mean error of the force is .0025 of mu N, without them .0077. On real
patches it is .0062, without them .0114. A patch with a neck or a shoulder has several shapes, each with an equivalent
ellipse, a centre and effective creepages of its own (`ties`); with them it is .0057, and the largest error on flange
roots falls from .097 to .045.
"""

import math
from typing import NamedTuple

from contact.core import chosen_by, entry, kernel
from contact.kernels.arrays import Case, Result, Workspace
from contact.kernels.rows import Element, Field, Strip
from contact.kernels.tangential.effective import set_effective
from contact.kernels.tangential.falling import Fallen, let_fall, set_loss, sum_up
from contact.kernels.tangential.lanes import FAR, LANES, Now, decay_and_lag, marching, room_for, turned
from contact.kernels.tangential.mapped_lanes import Lane, set_block
from contact.kernels.tangential.mapping import mapped, set_aspects, set_centres, slid_at
from contact.kernels.tangential.march import (
    March,
    begin,
    begin_to_slide,
    bound_at,
    height_at,
    leave,
    march,
    slide,
    slip_at,
    stop,
)
from contact.kernels.tangential.stick_zone import add_zone, begin_zone, end_zone
from contact.kernels.tangential.ties import tie_strips
from contact.kernels.tangential.varying import begin_varying, varies

_MOST = 2.0  # factor by which slip velocities may be scaled
_ROUND_OFF = 1e-12  # a slip zone shorter than this, over half the length of its strip, is none


class Uneven(NamedTuple):
    """Rule with two flexibilities in slip, a parabolic bound, and the map onto the elliptic pressure.

    Forces need the traction of the elements only where a strip does not stick for the first time (`stick_zone`). `shown` asks
    for it everywhere. It is no bool: Numba takes rules whose fields have the same types, as `Even`, for one rule.
    """

    shown: int


@kernel
def _begin(rule, lanes):
    pass  # `set_block` has set the state


@kernel
def _bound_at(rule, k, elements):
    # at the edge the direction is that of the equilibrium: ARC is 0 there
    return elements[Element.SINE, k] ** 2, 2.0 * elements[Element.S, k], elements[Element.ATANH, k] if k > 0 else 1.0


@kernel
def _height_at(rule, s):
    return 1.0 - s * s


@kernel
def _slip_at(rule, s, slope, x, y, lanes, l):
    Xs, Ys, spin, r = lanes[Lane.XS + l], lanes[Lane.YS + l], lanes[Lane.SPIN + l], lanes[Lane.R + l]
    return -slope * (r * x * x + y * y) - (Xs * x + (Ys + 2.0 * spin * s) * y)


@kernel
def _slide(rule, place, bound, slope, lanes):
    """Turn the direction with unequal flexibilities (mapped_strip.md 3, step 3), and set the slip of the fields."""
    s, step, _, stretch = place
    ends = 0
    for l in range(marching(lanes)):
        Xs, Ys, spin, r = lanes[Lane.XS + l], lanes[Lane.YS + l], lanes[Lane.SPIN + l], lanes[Lane.R + l]
        slid, x, y, left = lanes[March.SLIPS + l], lanes[March.EX + l], lanes[March.EY + l], lanes[March.LEFT + l]
        trial_x, trial_y, used = lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.TRIAL_USED + l]
        middle = s + 0.5 * left * step
        c = -middle * (1.0 - r)
        wx, wy = Xs + c * x, Ys + 2.0 * spin * middle - c * y
        rate = lanes[Lane.RATE + l] * lanes[Lane.ARC + l] * stretch / (r * y * y + x * x + 1e-300)
        far = rate * math.sqrt(wx * wx + wy * wy)
        rest, lag = decay_and_lag(far if far < FAR else FAR)
        at = s + left * step * (1.0 - lag)
        c = -at * (1.0 - r)
        wx, wy = Xs + c * x, Ys + 2.0 * spin * at - c * y
        w = math.sqrt(wx * wx + wy * wy) + 1e-300
        ex, ey = turned(x, y, wx, wy, w, rest)
        slip = _slip_at(rule, s, slope, ex, ey, lanes, l)
        slides = 1.0 if used > 1.0 else slid
        ends += 1 if slides > 0.5 and slip < 0.0 else 0
        shown = slid_at(s, (ex, ey), r, lanes[Lane.POLE + l], (Xs, Ys, spin), lanes[Lane.FROM_EDGE + l])
        lanes[March.EX + l], lanes[March.EY + l] = ex, ey
        lanes[March.TX + l] = bound * ex if slides > 0.5 else trial_x
        lanes[March.TY + l] = bound * ey if slides > 0.5 else trial_y
        lanes[March.SLIPS + l], lanes[March.USED + l], lanes[March.LEFT + l] = slides, used, 1.0
        lanes[Lane.ARC + l] = 1.0
        shown += lanes[Lane.TO_X + l] * ex + (lanes[Lane.TO_Y + l] + lanes[Lane.TO_SPIN + l] * s) * ey
        lanes[Now.SLIP + l], lanes[Now.SLIDES + l] = 0.5 * (shown + abs(shown)) * slides, slides
        lanes[Now.STICK + l] = (1.0 - slid) * (1.0 - left) if slides > 0.5 else 1.0
        lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.TRIAL_USED + l] = x, y, slid
    return ends


@kernel
def _map(per_bound, lanes):
    """Map the traction of the strips that stick."""
    for l in range(marching(lanes)):
        x, y, slides = lanes[March.TX + l] * per_bound, lanes[March.TY + l] * per_bound, lanes[March.SLIPS + l]
        map_x, map_y = mapped(x, y, lanes[Lane.POLE + l], lanes[Lane.N + l])
        lanes[Now.X + l] = map_x + slides * (lanes[March.EX + l] - map_x)
        lanes[Now.Y + l] = map_y + slides * (lanes[March.EY + l] - map_y)


@kernel
def _leave(rule, s, k, elements, lanes):
    """Map the traction where a strip sticks, and add the element to the sums (mapped_strip.md 3, step 4)."""
    stick, ended = 0, 0
    for l in range(marching(lanes)):
        again = lanes[Lane.NEXT + l] > -1.5 or rule.shown != 0
        ended += 1 if lanes[Lane.NEXT + l] == s else 0
        stick += 1 if lanes[March.SLIPS + l] < 0.5 and again else 0
        lanes[Now.X + l], lanes[Now.Y + l] = lanes[March.EX + l], lanes[March.EY + l]
    if ended > 0:
        for l in range(marching(lanes)):
            if lanes[Lane.NEXT + l] == s:
                lanes[Lane.NEXT_X + l], lanes[Lane.NEXT_Y + l] = lanes[March.EX + l], lanes[March.EY + l]
    if stick > 0:
        _map(1.0 / elements[Element.SINE, k] ** 2, lanes)
    step, weight = elements[Element.STEP, k], elements[Element.SINE, k] * elements[Element.DX, k]
    for l in range(marching(lanes)):
        counts = weight if lanes[Lane.NEXT + l] > -1.5 else 0.0
        lanes[Lane.SUM_X + l] += counts * lanes[Now.X + l]
        lanes[Lane.SUM_Y + l] += counts * lanes[Now.Y + l]
        lanes[Lane.SUM_M + l] += counts * s * lanes[Now.Y + l]
        lanes[Lane.POWER + l] += weight * lanes[Now.SLIP + l]
        lanes[Lane.STICK + l] += step * lanes[Now.STICK + l]


@kernel
def _begin_to_slide(rule, place, lanes):
    end_zone(place, lanes)


@kernel
def _stop(rule, before, s, lanes):
    begin_zone(before, s, lanes)


for _stub, _kernel in (
    (begin, _begin),
    (bound_at, _bound_at),
    (height_at, _height_at),
    (slide, _slide),
    (slip_at, _slip_at),
    (begin_to_slide, _begin_to_slide),
    (stop, _stop),
    (leave, _leave),
):
    chosen_by(_stub, {Uneven: _kernel})


@kernel
def _write_fields(block, last, elements, falling, lanes, trace, fields):
    """Fill traction, slip and stick flag of a block's strips.

    The outer loop is over elements, so `trace` is read in its order in memory.
    """
    for k in range(elements.shape[1]):
        for l in range(min(LANES, last - block)):
            i, bound = block + l, lanes[Lane.BOUND + l]
            qx, qy, slip = trace[k, Now.X + l], trace[k, Now.Y + l], trace[k, Now.SLIP + l] * lanes[Lane.UNIT + l]
            size = bound * elements[Element.SINE, k] * (trace[k, Fallen.SHARE + l] if falling else 1.0)
            fields[Field.QX, i, k], fields[Field.QY, i, k] = size * qx, size * qy
            fields[Field.SX, i, k], fields[Field.SY, i, k] = -slip * qx, -slip * qy
            fields[Field.STICK, i, k] = 1.0 - trace[k, Now.SLIDES + l] if bound > 0.0 else 0.0


@kernel
def energy(strips, i, l, lanes):
    """Return what the slip of strip i, in lane l, dissipates and the work of its forces, per metre rolled [N]."""
    a, y, xc = strips[Strip.A, i], strips[Strip.Y, i], strips[Strip.XC, i]
    vx, vy, phi = strips[Strip.VX, i], strips[Strip.VY, i], strips[Strip.PHI, i]
    load = lanes[Lane.BOUND + l] * a * strips[Strip.DY, i]
    work = (
        lanes[Lane.SUM_X + l] * (vx - phi * y)
        + lanes[Lane.SUM_Y + l] * (vy + phi * xc)
        + a * lanes[Lane.SUM_M + l] * phi
    )
    return load * lanes[Lane.POWER + l] * lanes[Lane.UNIT + l], -load * work


@kernel
def forces_of(strips, i, l, lanes):
    """Return force and moment of strip i, in lane l [N, N m]."""
    a, y, xc = strips[Strip.A, i], strips[Strip.Y, i], strips[Strip.XC, i]
    load = lanes[Lane.BOUND + l] * a * strips[Strip.DY, i]
    Fx, Fy = load * lanes[Lane.SUM_X + l], load * lanes[Lane.SUM_Y + l]
    return Fx, Fy, load * a * lanes[Lane.SUM_M + l] + xc * Fy - y * Fx


@kernel
def slip_factor(power, work):
    """Return the factor of the slip velocities of a patch with which they dissipate the work of its forces."""
    return min(max(work / power, 1.0 / _MOST), _MOST) if power > 0.0 else 1.0


@kernel
def _march_under(block, last, case, factor, workspace):
    """March along a block of strips under friction that varies along them."""
    lanes, trace, elements = workspace.space.lanes, workspace.space.trace, workspace.rule.elements
    set_block(workspace.strips, block, last, case, workspace.tables.kalker, lanes)
    march(Uneven(1), elements, lanes, trace)
    begin_varying(workspace.strips, block, last, case, lanes[Lane.BOUND : Lane.BOUND + LANES], lanes)
    let_fall(case, factor, elements, lanes, trace)


@entry
def roll_patch(first: int, last: int, case: Case, workspace: Workspace, result: Result) -> None:
    """Add forces, power and slip area of the strips of a patch to `result`. Fill their fields if there is room.

    In steady rolling the slip dissipates the work of the forces. The march's slip follows
    the given creepages, its forces the effective ones, so the slip velocities of the patch are scaled to that work. Friction
    that varies along the strips takes three marches: for this factor, for its effect on the stick zones, and with that.
    """
    strips, fields, elements = workspace.strips, workspace.fields, workspace.rule.elements
    lanes, trace = workspace.space.lanes, workspace.space.trace
    rest = 1.0 + elements[Element.S, -1]  # from the middle of the last element to the trailing edge
    falling = varies(case)
    shown = falling or fields.shape[1] >= last
    factor, power, work = 1.0, 0.0, 0.0
    if falling:  # friction follows from the scaled slip, so its factor is needed first
        for block in range(first, last, LANES):
            set_block(strips, block, last, case, workspace.tables.kalker, lanes)
            march(Uneven(1), elements, lanes, trace)
            add_zone(elements, lanes)
            for l in range(min(LANES, last - block)):
                more_power, more_work = energy(strips, block + l, l, lanes)
                power, work = power + more_power, work + more_work
        factor = slip_factor(power, work)
        power, work = 0.0, 0.0
        for block in range(first, last, LANES):
            _march_under(block, last, case, factor, workspace)
            set_loss(strips, block, last, case, lanes)
    for block in range(first, last, LANES):
        lanes = workspace.space.lanes[: room_for(LANES if falling else last - block)]
        if falling:
            _march_under(block, last, case, factor, workspace)
            sum_up(elements, lanes, trace)
        else:
            set_block(strips, block, last, case, workspace.tables.kalker, lanes)
            march(Uneven(1 if shown else 0), elements, lanes, trace)
            add_zone(elements, lanes)
        for l in range(min(LANES, last - block)):
            i = block + l
            a, dy, bound = strips[Strip.A, i], strips[Strip.DY, i], lanes[Lane.BOUND + l]
            Fx, Fy, Mz = forces_of(strips, i, l, lanes)
            result.Fx += Fx
            result.Fy += Fy
            result.Mz += Mz
            more_power, more_work = energy(strips, i, l, lanes)
            power, work = power + more_power, work + more_work
            stick = lanes[Lane.STICK + l] + rest * (1.0 - lanes[March.SLIPS + l]) if bound > 0.0 else 0.0
            slip = 2.0 - stick
            result.slip_area += slip * a * dy if slip > _ROUND_OFF else 0.0
        if fields.shape[1] >= last:  # else only forces are wanted
            _write_fields(block, last, elements, falling, lanes, trace, fields)
    if not falling:
        factor = slip_factor(power, work)
    result.power += factor * power
    for i in range(first, last if fields.shape[1] >= last else first):
        for k in range(elements.shape[1]):
            fields[Field.SX, i, k] *= factor
            fields[Field.SY, i, k] *= factor


@entry
def set_shapes(n: int, workspace: Workspace) -> None:
    """Set ties, aspect ratios and centres of the `n` strips of all patches."""
    tie_strips(workspace.strips, 0, n)
    set_aspects(workspace.strips, 0, n, workspace.tables.kalker)
    set_centres(workspace.strips, 0, n)


@kernel
def fastrip_mapped(part, n, case, workspace, result):
    """Fill the traction, slip and stick fields of one patch. Add its forces, power, slip area and `beyond` to `result`.

    `set_shapes` has been called for the `n` strips of all patches, and `set_pulls` for all if they are more than one shape.
    """
    beyond = set_effective(workspace.strips, part.first, part.last, (0, n), case, workspace.tables)
    result.beyond += beyond * part.N / max(result.N, 1e-300)
    roll_patch(part.first, part.last, case, workspace, result)
