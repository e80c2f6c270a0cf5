"""FASTSIM's march along eight strips in normalised form, shared by FASTSIM and by FaStrip's direction pass.

With x = x_c + a s, traction tau and the parabolic bound 1 - s² both divided by the peak of the bound, the rigid slip over
flexibility is W = (X, Y + Z s): X = a vx/(L1 g0), Y = a vy/(L2 g0), Z = a² phi/(L3 g0) (theory.md 2.5; Kalker 1982).

Kalker's scaling of the trial traction back onto the bound is of first order in the element length: at 30 elements it left
0.9 % of mu N under lateral creepage with spin. Here the direction of a sliding particle follows the same equation exactly
for a constant W: in slip (1 - s²) d(angle) = |W| sin(angle to -W) ds, so tan(angle/2) decays with exp(-|W| ∫ds/(1 - s²)).
A particle passes from stick to slip, or back, within an element, where the traction reaches the bound or the slip ends.
This is of second order and stable at both edges, where the bound vanishes (mapped_strip.md 3, step 3, for one flexibility).
"""

import math

from contact._jit import kernel
from contact.quadrature import EL_ATANH, EL_MIDDLE, EL_S, EL_SINE, EL_STEP
from contact.tangential.lanes import (
    FAR,
    FREE_ROW,
    LANES,
    NOW_SLIDES,
    NOW_SLIP,
    NOW_STICK,
    NOW_X,
    NOW_Y,
    decay,
    keep,
    lagging,
    turned,
)

# rows of `lanes` that the caller sets (X, Y, Z) and that the march keeps: traction, 1 in slip, utilisation squared, and the
# trial traction in stick with its utilisation squared
ROW_X, ROW_Y, ROW_Z, _TX, _TY, _SLIPS, _USED, _TRIAL_X, _TRIAL_Y, _TRIAL_USED = (
    FREE_ROW + row * LANES for row in range(10)
)
FREE_BEHIND_MARCH = FREE_ROW + 10 * LANES


@kernel
def march(elements, lanes, trace):
    """March from the leading edge; leave traction over the bound and slip at each element in `trace`, and the share of the
    step to it in stick.

    The slip is in units of flexibility times the bound's peak over a. In stick the traction is exact, spin included.
    """
    for l in range(LANES):
        x, y = lanes[ROW_X + l], lanes[ROW_Y + l] + lanes[ROW_Z + l]
        size = math.sqrt(x * x + y * y) + 1e-300
        lanes[_TX + l], lanes[_TY + l] = 0.0, 0.0
        lanes[NOW_X + l], lanes[NOW_Y + l] = -x / size, -y / size
        # at the edge the traction of stick rises |W|/2 times as fast as the bound
        lanes[_SLIPS + l] = 1.0 if size > 2.0 else 0.0
        lanes[_USED + l] = 0.25 * size * size
    s = 1.0
    for k in range(elements.shape[1]):
        before, s, step, middle = s, elements[EL_S, k], elements[EL_STEP, k], elements[EL_MIDDLE, k]
        stretch = min(elements[EL_ATANH, k], FAR)
        bound = elements[EL_SINE, k] ** 2
        per_bound = 1.0 / bound
        sliding = 0.0
        for l in range(LANES):
            x = lanes[_TX + l] - step * lanes[ROW_X + l]
            y = lanes[_TY + l] - step * (lanes[ROW_Y + l] + lanes[ROW_Z + l] * middle)
            used = (x * x + y * y) * per_bound * per_bound
            lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l] = x, y, used
            sliding += 1.0 if used > 1.0 else lanes[_SLIPS + l]
        if sliding == 0.0:
            for l in range(LANES):
                x, y = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l]
                lanes[_TX + l], lanes[_TY + l], lanes[_USED + l] = x, y, lanes[_TRIAL_USED + l]
                lanes[NOW_X + l], lanes[NOW_Y + l] = x * per_bound, y * per_bound
                lanes[NOW_SLIP + l], lanes[NOW_SLIDES + l], lanes[NOW_STICK + l] = 0.0, 0.0, 1.0
        else:
            _slide(before, s, step, middle, stretch, bound, lanes)
        keep(lanes, trace[k])


@kernel
def _slide(before, s, step, middle, stretch, bound, lanes):
    """Step of all strips from `before` to `s` when at least one slides or comes to slide; the others stick as tried."""
    per_bound = 1.0 / bound
    for l in range(LANES):
        X, Y, Z, slid = lanes[ROW_X + l], lanes[ROW_Y + l], lanes[ROW_Z + l], lanes[_SLIPS + l]
        x, y, ex, ey = lanes[_TX + l], lanes[_TY + l], lanes[NOW_X + l], lanes[NOW_Y + l]
        trial_x, trial_y, used = lanes[_TRIAL_X + l], lanes[_TRIAL_Y + l], lanes[_TRIAL_USED + l]
        # where the trial traction passes the bound within the step, the direction turns over the rest of it
        share = (1.0 - lanes[_USED + l]) / (used - lanes[_USED + l] + 1e-300)
        share = share if used > lanes[_USED + l] else 0.0
        x, y = x + share * (trial_x - x), y + share * (trial_y - y)
        size = math.sqrt(x * x + y * y) + 1e-300
        x, y = x / size, y / size
        x, y = ex if slid > 0.5 else x, ey if slid > 0.5 else y
        rest = 1.0 if slid > 0.5 else 1.0 - share
        wx, wy = X, Y + Z * middle
        far = rest * stretch * math.sqrt(wx * wx + wy * wy)
        wy = Y + Z * (s + rest * step * (1.0 - lagging(far)))
        w = math.sqrt(wx * wx + wy * wy) + 1e-300
        ex, ey = turned(x, y, wx, wy, w, decay(far))
        # a particle slides as far as its slip is positive; from there on it sticks
        slip_before = -(X * x + (Y + Z * before) * y) - 2.0 * before
        slip = -(X * ex + (Y + Z * s) * ey) - 2.0 * s
        slides = slip_before / (slip_before - slip + 1e-300)
        slides = slides if slip_before > 0.0 else 0.0
        ux, uy = x + slides * (ex - x), y + slides * (ey - y)
        at, left = before - slides * step, (1.0 - slides) * step
        size = (1.0 - at * at) * (1.5 - 0.5 * (ux * ux + uy * uy))
        again_x, again_y = size * ux - left * X, size * uy - left * (Y + 0.5 * Z * (at + s))
        again_used = (again_x * again_x + again_y * again_y) * per_bound * per_bound
        sticks = slid if slip < 0.0 else 0.0
        sticks = sticks if again_used < 1.0 else 0.0

        trial_x, trial_y = again_x if sticks > 0.5 else trial_x, again_y if sticks > 0.5 else trial_y
        used = again_used if sticks > 0.5 else used
        slid = 1.0 if used > 1.0 else slid - sticks
        stick = 1.0 - slides if sticks > 0.5 else (0.0 if lanes[_SLIPS + l] > 0.5 else share)
        lanes[NOW_X + l] = ex if slid > 0.5 else trial_x * per_bound
        lanes[NOW_Y + l] = ey if slid > 0.5 else trial_y * per_bound
        lanes[_TX + l] = bound * ex if slid > 0.5 else trial_x
        lanes[_TY + l] = bound * ey if slid > 0.5 else trial_y
        lanes[_SLIPS + l], lanes[_USED + l] = slid, used
        lanes[NOW_SLIP + l] = slip * slid if slip > 0.0 else 0.0
        lanes[NOW_SLIDES + l] = slid
        lanes[NOW_STICK + l] = stick if slid + sticks > 0.5 else 1.0
