"""March along a block of strips in normalised form, for FASTSIM's methods, FaStrip's direction pass and mapped FaStrip.

Let x = x_c + a s. Traction tau and bound g, parabolic 1 - s² or elliptic √(1 - s²), are both divided by the peak g0 of
the bound. The rigid slip over flexibility is W = (X, Y + Z s) with X = a vx/(L1 g0), Y = a vy/(L2 g0), Z = a² phi/(L3
g0) (theory.md 2.5; Kalker 1982).

A rule completes the march: the bound of the traction, and how its direction turns in slip. The type of the rule chooses
`begin`, `bound_at`, `height_at`, `begin_to_slide`, `slide`, `slip_at`, `stop` and `leave`. `Even`, in this file, is
Kalker's rule with one flexibility in slip. `fastrip_mapped` has another.

Kalker's scaling of the trial traction back onto the bound is of first order in the element length. At 30 elements it
left 0.9 % of mu N under lateral creepage with spin. Here the direction of a sliding particle follows the same equation,
exactly for a constant W: in slip g d(angle) = |W| sin(angle to -W) ds, so tan(angle/2) decays with exp(-|W| ∫ds/g).

A particle passes from stick to slip, or back, within an element, where the traction reaches the bound or the slip ends.
This is of second order and stable at both edges, where the bound vanishes (mapped_strip.md 3, step 3, for one
flexibility).
"""

import math
from enum import auto
from typing import Any, NamedTuple

from contact.core import chosen_by, kernel
from contact.kernels.rows import Element
from contact.kernels.tangential.lanes import FAR, Now, Row, after, decay_and_lag, keep, marching, turned


class March(Row):
    """Rows of `lanes` of every march. The caller sets X, Y and Z."""

    X = after(Now)  # rigid slip (X, Y + Z s)
    Y = auto()
    Z = auto()
    START = auto()  # squared utilisation of the bound at the leading edge
    CAME = auto()  # s of the element where a particle first slides, or -2
    TX = auto()  # traction
    TY = auto()
    SLIPS = auto()  # 1 in slip
    USED = auto()  # utilisation of the bound, squared
    TRIAL_X = auto()  # traction in stick, with its utilisation squared
    TRIAL_Y = auto()
    TRIAL_USED = auto()
    LEFT = auto()  # share of the step that is left when a strip begins to slide
    AT = auto()  # s where the slip of a particle has ended within the step, or 2
    EX = auto()  # direction of the traction in slip
    EY = auto()


class Even(NamedTuple):
    """Rule with one flexibility in slip. The bound is elliptic or parabolic."""

    elliptic: bool


def begin(rule: Any, lanes: Any) -> None:
    """Set the state at the leading edge: the rows of `March` from START on."""
    raise NotImplementedError


def bound_at(rule: Any, k: int, elements: Any) -> tuple[float, float, float]:
    """Return the bound at element k, its decrease with s, and ∫ds/g of the step."""
    raise NotImplementedError


def height_at(rule: Any, s: float) -> float:
    """Return the bound at s."""
    raise NotImplementedError


def slide(rule: Any, place: Any, bound: float, slope: float, lanes: Any) -> int:
    """Turn the direction of all strips that slide. The others keep the trial traction. Return how many have a negative slip.

    `place` holds s, the step to it, its middle and ∫ds/g. The rows TRIAL_X to TRIAL_USED get the direction before the step
    and whether the strip slid.
    """
    raise NotImplementedError


def slip_at(rule: Any, s: float, slope: float, x: float, y: float, lanes: Any, l: int) -> float:
    """Return the slip of lane l at s along the direction (x, y), in units of flexibility times the bound's peak over a."""
    raise NotImplementedError


def begin_to_slide(rule: Any, place: Any, lanes: Any) -> None:
    """Set the direction where a trial traction passes the bound, and the share of the step that is left."""
    raise NotImplementedError


def stop(rule: Any, before: float, s: float, lanes: Any) -> None:
    """Take note of the strips whose slip has ended within the step, at `March.AT`."""
    raise NotImplementedError


def leave(rule: Any, s: float, k: int, elements: Any, lanes: Any) -> None:
    """Complete the output of element k in the rows of `Now`."""
    raise NotImplementedError


@kernel
def march(rule, elements, lanes, trace):
    """March from the leading edge. Fill `trace` with traction over the bound and slip at each element.

    `trace` also holds whether the element slides and the share of the step to it that is in stick. The slip is in units
    of flexibility times the bound's peak over a. In stick the traction is exact, spin included.
    """
    begin(rule, lanes)
    s, slope = 1.0, 2.0
    for k in range(elements.shape[1]):
        before, s, step, middle = s, elements[Element.S, k], elements[Element.STEP, k], elements[Element.MIDDLE, k]
        slope_before = slope
        bound, slope, stretch = bound_at(rule, k, elements)
        per_bound = 1.0 / bound
        begins, sliding = 0, 0
        for l in range(marching(lanes)):
            x = lanes[March.TX + l] - step * lanes[March.X + l]
            y = lanes[March.TY + l] - step * (lanes[March.Y + l] + lanes[March.Z + l] * middle)
            used = (x * x + y * y) * per_bound * per_bound
            lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.TRIAL_USED + l] = x, y, used
            sliding += 1 if lanes[March.SLIPS + l] > 0.5 else 0
            begins += 1 if used > 1.0 and lanes[March.SLIPS + l] < 0.5 else 0
        if begins > 0:
            begin_to_slide(rule, (s, step, middle, stretch), lanes)
        if begins + sliding > 0:
            ends = slide(rule, (s, step, middle, stretch), bound, slope, lanes)
            if ends > 0:
                _end_slip(rule, (before, s, step), slope_before, slope, bound, lanes)
                stop(rule, before, s, lanes)
        else:
            for l in range(marching(lanes)):
                x, y = lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l]
                lanes[March.TX + l], lanes[March.TY + l], lanes[March.USED + l] = x, y, lanes[March.TRIAL_USED + l]
                lanes[Now.X + l], lanes[Now.Y + l] = x * per_bound, y * per_bound
                lanes[Now.SLIP + l], lanes[Now.SLIDES + l], lanes[Now.STICK + l] = 0.0, 0.0, 1.0
        leave(rule, s, k, elements, lanes)
        keep(lanes, trace[k])


@kernel
def _begin_to_slide(rule, place, lanes):
    s = place[0]
    for l in range(marching(lanes)):
        x, y, used, before = (
            lanes[March.TX + l],
            lanes[March.TY + l],
            lanes[March.TRIAL_USED + l],
            lanes[March.USED + l],
        )
        comes = 1.0 - lanes[March.SLIPS + l] if used > 1.0 else 0.0
        gap = used - before
        share = (1.0 - before) / (gap if gap > 1e-12 else 1.0)
        x, y = x + share * (lanes[March.TRIAL_X + l] - x), y + share * (lanes[March.TRIAL_Y + l] - y)
        per_size = 1.0 / (math.sqrt(x * x + y * y) + 1e-300)
        # sums instead of selections: the compiler would put roots and divisions in a branch
        lanes[March.EX + l] += comes * (x * per_size - lanes[March.EX + l])
        lanes[March.EY + l] += comes * (y * per_size - lanes[March.EY + l])
        lanes[March.LEFT + l] = 1.0 - comes * share
        came = lanes[March.CAME + l]
        lanes[March.CAME + l] = s if comes > 0.5 and s > came else came


@kernel
def _end_slip(rule, place, slope_before, slope, bound, lanes):
    """Set traction and state of particles whose slip becomes zero within the step: they stick, unless the bound is too low."""
    before, s, step = place
    per_bound = 1.0 / bound
    for l in range(marching(lanes)):
        x, y, ex, ey = lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.EX + l], lanes[March.EY + l]
        slid = lanes[March.TRIAL_USED + l]
        slip_before = slip_at(rule, before, slope_before, x, y, lanes, l)
        slip = slip_at(rule, s, slope, ex, ey, lanes, l)
        share = slip_before / (slip_before - slip + 1e-300)
        share = share if slip_before > 0.0 else 0.0
        ux, uy = x + share * (ex - x), y + share * (ey - y)
        at, left = before - share * step, (1.0 - share) * step
        size = height_at(rule, at) * (1.5 - 0.5 * (ux * ux + uy * uy))
        stick_x = size * ux - left * lanes[March.X + l]
        stick_y = size * uy - left * (lanes[March.Y + l] + 0.5 * lanes[March.Z + l] * (at + s))
        used = (stick_x * stick_x + stick_y * stick_y) * per_bound * per_bound
        stops = slip < 0.0 and slid > 0.5 and used < 1.0
        lanes[March.AT + l] = at if stops else 2.0
        shown = lanes[Now.SLIP + l] if lanes[Now.SLIP + l] > 0.0 else 0.0
        lanes[Now.SLIP + l] = 0.0 if stops else shown
        lanes[Now.X + l] = stick_x * per_bound if stops else lanes[Now.X + l]
        lanes[Now.Y + l] = stick_y * per_bound if stops else lanes[Now.Y + l]
        lanes[March.TX + l] = stick_x if stops else lanes[March.TX + l]
        lanes[March.TY + l] = stick_y if stops else lanes[March.TY + l]
        lanes[March.USED + l] = used if stops else lanes[March.USED + l]
        lanes[March.SLIPS + l] = 0.0 if stops else lanes[March.SLIPS + l]
        lanes[Now.SLIDES + l] = 0.0 if stops else lanes[Now.SLIDES + l]
        lanes[Now.STICK + l] = 1.0 - share if stops else lanes[Now.STICK + l]


@kernel
def _begin_even(rule, lanes):
    # at the edge the traction of stick rises |W|/2 times as fast as the parabola; the ellipse is infinitely steep there
    steepest, start = (math.inf, 0.0) if rule.elliptic else (2.0, 0.25)
    for l in range(marching(lanes)):
        x, y = lanes[March.X + l], lanes[March.Y + l] + lanes[March.Z + l]
        size = math.sqrt(x * x + y * y) + 1e-300
        lanes[March.TX + l], lanes[March.TY + l], lanes[March.LEFT + l] = 0.0, 0.0, 1.0
        lanes[March.EX + l], lanes[March.EY + l] = -x / size, -y / size
        lanes[March.SLIPS + l] = 1.0 if size > steepest else 0.0
        lanes[March.START + l] = lanes[March.USED + l] = start * size * size
        lanes[March.CAME + l] = 1.0 if size > steepest else -2.0


@kernel
def _bound_even(rule, k, elements):
    s, sine = elements[Element.S, k], elements[Element.SINE, k]
    if rule.elliptic:
        return sine, s / sine, (elements[Element.DX, k] if k > 0 else 0.5 * elements[Element.DX, k]) / sine
    return sine * sine, 2.0 * s, min(elements[Element.ATANH, k], FAR)


@kernel
def _height_even(rule, s):
    parabola = 1.0 - s * s
    return (
        math.sqrt(0.5 * (parabola + abs(parabola))) if rule.elliptic else parabola
    )  # idle lanes lie outside the strip


@kernel
def _slide_even(rule, place, bound, slope, lanes):
    s, step, middle, stretch = place
    per_bound = 1.0 / bound
    ends = 0
    for l in range(marching(lanes)):
        X, Y, Z, slid = lanes[March.X + l], lanes[March.Y + l], lanes[March.Z + l], lanes[March.SLIPS + l]
        x, y, left = lanes[March.EX + l], lanes[March.EY + l], lanes[March.LEFT + l]
        trial_x, trial_y, used = lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.TRIAL_USED + l]
        wx, wy = X, Y + Z * middle
        far = left * stretch * math.sqrt(wx * wx + wy * wy)
        rest, lag = decay_and_lag(far if far < FAR else FAR)
        wy = Y + Z * (s + left * step * (1.0 - lag))
        w = math.sqrt(wx * wx + wy * wy) + 1e-300
        ex, ey = turned(x, y, wx, wy, w, rest)
        slip = -(X * ex + (Y + Z * s) * ey) - slope
        slides = 1.0 if used > 1.0 else slid
        ends += 1 if slides > 0.5 and slip < 0.0 else 0
        lanes[March.EX + l], lanes[March.EY + l] = ex, ey
        lanes[Now.X + l] = ex if slides > 0.5 else trial_x * per_bound
        lanes[Now.Y + l] = ey if slides > 0.5 else trial_y * per_bound
        lanes[March.TX + l] = bound * ex if slides > 0.5 else trial_x
        lanes[March.TY + l] = bound * ey if slides > 0.5 else trial_y
        lanes[March.SLIPS + l], lanes[March.USED + l], lanes[March.LEFT + l] = slides, used, 1.0
        lanes[Now.SLIP + l], lanes[Now.SLIDES + l] = slip * slides, slides
        lanes[Now.STICK + l] = (1.0 - slid) * (1.0 - left) if slides > 0.5 else 1.0
        lanes[March.TRIAL_X + l], lanes[March.TRIAL_Y + l], lanes[March.TRIAL_USED + l] = x, y, slid
    return ends


@kernel
def _slip_even(rule, s, slope, x, y, lanes, l):
    return -(lanes[March.X + l] * x + (lanes[March.Y + l] + lanes[March.Z + l] * s) * y) - slope


@kernel
def _stop_even(rule, before, s, lanes):
    pass


@kernel
def _leave_even(rule, s, k, elements, lanes):
    pass


for _stub, _kernel in (
    (begin, _begin_even),
    (bound_at, _bound_even),
    (height_at, _height_even),
    (slide, _slide_even),
    (slip_at, _slip_even),
    (begin_to_slide, _begin_to_slide),
    (stop, _stop_even),
    (leave, _leave_even),
):
    chosen_by(_stub, {Even: _kernel})
