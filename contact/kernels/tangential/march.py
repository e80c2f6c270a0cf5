"""FASTSIM's march along a block of strips in normalised form, shared by the FASTSIM methods and FaStrip's direction pass.

With x = x_c + a s, traction tau and the bound g, parabolic 1 - s² or elliptic √(1 - s²), both divided by the peak of the
bound, the rigid slip over flexibility is W = (X, Y + Z s): X = a vx/(L1 g0), Y = a vy/(L2 g0), Z = a² phi/(L3 g0)
(theory.md 2.5; Kalker 1982).

Kalker's scaling of the trial traction back onto the bound is of first order in the element length: at 30 elements it left
0.9 % of mu N under lateral creepage with spin. Here the direction of a sliding particle follows the same equation exactly
for a constant W: in slip g d(angle) = |W| sin(angle to -W) ds, so tan(angle/2) decays with exp(-|W| ∫ds/g).
A particle passes from stick to slip, or back, within an element, where the traction reaches the bound or the slip ends.
This is of second order and stable at both edges, where the bound vanishes (mapped_strip.md 3, step 3, for one flexibility).
"""

import math

from contact._jit import kernel
from contact.kernels.layout import Element
from contact.kernels.tangential.lanes import (
    FAR,
    FREE_ROW,
    LANES,
    NOW_SLIDES,
    NOW_SLIP,
    NOW_STICK,
    NOW_X,
    NOW_Y,
    decay_and_lag,
    keep,
    turned,
)

# rows of `lanes` that the caller sets (X, Y, Z), that the march leaves (utilisation of the bound at the leading edge, squared,
# and s of the element where a particle first slides, -2 for nowhere) and that it keeps: traction, 1 in slip, utilisation
# squared, the trial traction in stick with its utilisation squared, and the share of the step left when a strip comes to slide
ROW_X, ROW_Y, ROW_Z, ROW_START, ROW_CAME, _TX, _TY, _SLIPS, _USED, _TRIAL_X, _TRIAL_Y, _TRIAL_USED, _LEFT = (
    FREE_ROW + row * LANES for row in range(13)
)
FREE_BEHIND_MARCH = FREE_ROW + 13 * LANES


@kernel
def march(elliptic, elements, lanes, trace):
    """March from the leading edge; leave traction over the bound and slip at each element in `trace`.

    Besides, whether it slides and the share of the step to it in stick. The slip is in units of flexibility times the
    bound's peak over a. In stick the traction is exact, spin included. The bound is `elliptic` or parabolic.
    """
    # at the edge the traction of stick rises |W|/2 times as fast as the parabola; the ellipse is infinitely steep there
    steepest, start = (math.inf, 0.0) if elliptic else (2.0, 0.25)
    for l in range(LANES):
        x, y = lanes[ROW_X + l], lanes[ROW_Y + l] + lanes[ROW_Z + l]
        size = math.sqrt(x * x + y * y) + 1e-300
        lanes[_TX + l], lanes[_TY + l], lanes[_LEFT + l] = 0.0, 0.0, 1.0
        lanes[NOW_X + l], lanes[NOW_Y + l] = -x / size, -y / size
        lanes[_SLIPS + l] = 1.0 if size > steepest else 0.0
        lanes[ROW_START + l] = lanes[_USED + l] = start * size * size
        lanes[ROW_CAME + l] = 1.0 if size > steepest else -2.0
    s, slope = 1.0, 2.0
    for k in range(elements.shape[1]):
        before, s, step, middle = s, elements[Element.S, k], elements[Element.STEP, k], elements[Element.MIDDLE, k]
        sine, slope_before = elements[Element.SINE, k], slope
        bound, slope, stretch = (
            sine * sine,
            2.0 * s,
            min(elements[Element.ATANH, k], FAR),
        )  # slope: fall of the bound over s
        if elliptic:
            bound, slope, stretch = (
                sine,
                s / sine,
                elements[Element.DX, k] / sine if k > 0 else 0.5 * elements[Element.DX, k] / sine,
            )
        per_bound = 1.0 / bound
        come, slide = 0, 0
        for l in range(LANES):
            x = lanes[_TX + l] - step * lanes[ROW_X + l]
            y = lanes[_TY + l] - step * (lanes[ROW_Y + l] + lanes[ROW_Z + l] * middle)
            used = (x * x + y * y) * per_bound * per_bound
            lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l] = x, y, used
            slide += 1 if lanes[_SLIPS + l] > 0.5 else 0
            come += 1 if used > 1.0 and lanes[_SLIPS + l] < 0.5 else 0
        if come > 0:
            _come_to_slide(s, lanes)
        if come + slide > 0:
            stop = _slide(s, step, middle, stretch, bound, slope, lanes)
            if stop > 0:
                _stop(elliptic, before, s, step, per_bound, slope_before, lanes)
        else:
            for l in range(LANES):
                x, y = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l]
                lanes[_TX + l], lanes[_TY + l], lanes[_USED + l] = x, y, lanes[_TRIAL_USED + l]
                lanes[NOW_X + l], lanes[NOW_Y + l] = x * per_bound, y * per_bound
                lanes[NOW_SLIP + l], lanes[NOW_SLIDES + l], lanes[NOW_STICK + l] = 0.0, 0.0, 1.0
        keep(lanes, trace[k])


@kernel
def _come_to_slide(s, lanes):
    """Where a trial traction passes the bound: its direction there, and the share of the step that is left."""
    for l in range(LANES):
        x, y, used, before = lanes[_TX + l], lanes[_TY + l], lanes[_TRIAL_USED + l], lanes[_USED + l]
        comes = 1.0 - lanes[_SLIPS + l] if used > 1.0 else 0.0
        gap = used - before
        share = (1.0 - before) / (gap if gap > 1e-12 else 1.0)
        x, y = x + share * (lanes[_TRIAL_X + l] - x), y + share * (lanes[_TRIAL_Y + l] - y)
        per_size = 1.0 / (math.sqrt(x * x + y * y) + 1e-300)
        # sums, not choices: the compiler would put roots and divisions behind a branch
        lanes[NOW_X + l] += comes * (x * per_size - lanes[NOW_X + l])
        lanes[NOW_Y + l] += comes * (y * per_size - lanes[NOW_Y + l])
        lanes[_LEFT + l] = 1.0 - comes * share
        came = lanes[ROW_CAME + l]
        lanes[ROW_CAME + l] = s if comes > 0.5 and s > came else came


@kernel
def _slide(s, step, middle, stretch, bound, slope, lanes):
    """Turn the direction of all strips that slide; the others stick as tried. Return how many slide against their slip.

    They leave the direction and the length from which they started in the rows of the trial.
    """
    per_bound = 1.0 / bound
    stop = 0
    for l in range(LANES):
        X, Y, Z, slid = lanes[ROW_X + l], lanes[ROW_Y + l], lanes[ROW_Z + l], lanes[_SLIPS + l]
        x, y, left = lanes[NOW_X + l], lanes[NOW_Y + l], lanes[_LEFT + l]
        trial_x, trial_y, used = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l]
        wx, wy = X, Y + Z * middle
        far = left * stretch * math.sqrt(wx * wx + wy * wy)
        rest, lag = decay_and_lag(far if far < FAR else FAR)
        wy = Y + Z * (s + left * step * (1.0 - lag))
        w = math.sqrt(wx * wx + wy * wy) + 1e-300
        ex, ey = turned(x, y, wx, wy, w, rest)
        slip = -(X * ex + (Y + Z * s) * ey) - slope
        slides = 1.0 if used > 1.0 else slid
        stop += 1 if slides > 0.5 and slip < 0.0 else 0
        lanes[NOW_X + l] = ex if slides > 0.5 else trial_x * per_bound
        lanes[NOW_Y + l] = ey if slides > 0.5 else trial_y * per_bound
        lanes[_TX + l] = bound * ex if slides > 0.5 else trial_x
        lanes[_TY + l] = bound * ey if slides > 0.5 else trial_y
        lanes[_SLIPS + l], lanes[_USED + l], lanes[_LEFT + l] = slides, used, 1.0
        lanes[NOW_SLIP + l], lanes[NOW_SLIDES + l] = slip * slides, slides
        lanes[NOW_STICK + l] = (1.0 - slid) * (1.0 - left) if slides > 0.5 else 1.0
        lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l] = x, y, slid
    return stop


@kernel
def _stop(elliptic, before, s, step, per_bound, slope_before, lanes):
    """A particle slides as far as its slip is positive; from there on it sticks, unless the bound is too low for that."""
    for l in range(LANES):
        X, Y, Z, slid, slip = (
            lanes[ROW_X + l],
            lanes[ROW_Y + l],
            lanes[ROW_Z + l],
            lanes[_TRIAL_USED + l],
            lanes[NOW_SLIP + l],
        )
        x, y, ex, ey = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[NOW_X + l], lanes[NOW_Y + l]
        slip_before = -(X * x + (Y + Z * before) * y) - slope_before
        share = slip_before / (slip_before - slip + 1e-300)
        share = share if slip_before > 0.0 else 0.0
        ux, uy = x + share * (ex - x), y + share * (ey - y)
        at, left = before - share * step, (1.0 - share) * step
        parabola = 1.0 - at * at
        size = (math.sqrt(parabola) if elliptic else parabola) * (1.5 - 0.5 * (ux * ux + uy * uy))
        stick_x, stick_y = size * ux - left * X, size * uy - left * (Y + 0.5 * Z * (at + s))
        used = (stick_x * stick_x + stick_y * stick_y) * per_bound * per_bound
        stops = slip < 0.0 and slid > 0.5 and used < 1.0
        lanes[NOW_SLIP + l] = slip if slip > 0.0 else 0.0
        lanes[NOW_X + l] = stick_x * per_bound if stops else ex
        lanes[NOW_Y + l] = stick_y * per_bound if stops else ey
        lanes[_TX + l] = stick_x if stops else lanes[_TX + l]
        lanes[_TY + l] = stick_y if stops else lanes[_TY + l]
        lanes[_USED + l] = used if stops else lanes[_USED + l]
        lanes[_SLIPS + l] = 0.0 if stops else lanes[_SLIPS + l]
        lanes[NOW_SLIDES + l] = 0.0 if stops else lanes[NOW_SLIDES + l]
        lanes[NOW_STICK + l] = 1.0 - share if stops else lanes[NOW_STICK + l]
