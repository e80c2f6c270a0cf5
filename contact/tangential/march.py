"""FASTSIM's march along eight strips in normalised form, shared by FASTSIM and by FaStrip's direction pass.

With x = x_c + a s, traction tau and the parabolic bound 1 - s² both divided by the peak of the bound, the rigid slip over
flexibility is W = (X, Y + Z s): X = a vx/(L1 g0), Y = a vy/(L2 g0), Z = a² phi/(L3 g0) (theory.md 2.5; Kalker 1982).

Kalker's scaling of the trial traction back onto the bound is of first order in the element length: at 30 elements it left
0.9 % of mu N under lateral creepage with spin. Here the direction of a sliding particle follows the same equation exactly
for a constant W: in slip (1 - s²) d(angle) = |W| sin(angle to -W) ds, so tan(angle/2) decays with exp(-|W| ∫ds/(1 - s²)).
This is of second order and stable at both edges, where the bound vanishes (mapped_strip.md 3, step 3, for one flexibility).
"""

import math

from contact._jit import kernel
from contact.quadrature import EL_ATANH, EL_MIDDLE, EL_S, EL_SINE, EL_STEP
from contact.tangential.lanes import FAR, FREE_ROW, LANES, NOW_SLIP, NOW_USED, NOW_X, NOW_Y, decay, keep, turned

# rows of `lanes` that the caller sets (X, Y, Z) and that the march keeps (traction, 1 in slip)
ROW_X, ROW_Y, ROW_Z, _TX, _TY, _SLIPS = (FREE_ROW + row * LANES for row in range(6))
FREE_BEHIND_MARCH = FREE_ROW + 6 * LANES


@kernel
def march(elements, lanes, trace):
    """March from the leading edge; leave direction, slip and used share of the bound (1 in slip) of each element in `trace`.

    The direction is a unit vector, or zero where there is no traction. The slip is in units of flexibility times the bound's
    peak over a. In stick the traction is exact, spin included.
    """
    for l in range(LANES):
        x, y = lanes[ROW_X + l], lanes[ROW_Y + l] + lanes[ROW_Z + l]
        size = math.sqrt(x * x + y * y) + 1e-300
        lanes[_TX + l], lanes[_TY + l] = 0.0, 0.0
        lanes[NOW_X + l], lanes[NOW_Y + l] = -x / size, -y / size
        # at the edge the traction of stick rises |W|/2 times as fast as the bound
        lanes[_SLIPS + l] = 1.0 if size > 2.0 else 0.0
    bound = 0.0
    for k in range(elements.shape[1]):
        s, step, middle = elements[EL_S, k], elements[EL_STEP, k], elements[EL_MIDDLE, k]
        stretch = min(elements[EL_ATANH, k], FAR)
        before, bound = bound, elements[EL_SINE, k] ** 2
        at_edge = 1e300 if k == 0 else 0.0  # the first step cannot stick again
        for l in range(LANES):
            X, Y, Z = lanes[ROW_X + l], lanes[ROW_Y + l], lanes[ROW_Z + l]
            x, y, ex, ey, slips = lanes[_TX + l], lanes[_TY + l], lanes[NOW_X + l], lanes[NOW_Y + l], lanes[_SLIPS + l]
            wx, wy = X, Y + Z * middle
            # a particle goes on sliding while its slip is positive; otherwise it sticks again, from the bound before
            goes_on = slips if -(wx * ex + wy * ey) - 2.0 * middle + at_edge > 0.0 else 0.0
            on_bound_x, on_bound_y = before * ex, before * ey
            x = on_bound_x if goes_on < slips else x
            y = on_bound_y if goes_on < slips else y
            # slip: the direction turns; stick: the traction grows, and slips if it passes the bound
            w = math.sqrt(wx * wx + wy * wy) + 1e-300
            turned_x, turned_y = turned(ex, ey, wx, wy, w, decay(w * stretch))
            x -= step * wx
            y -= step * wy
            size = math.sqrt(x * x + y * y) + 1e-300
            stick_x, stick_y, used = x / size, y / size, size / bound
            ex = turned_x if goes_on > 0.5 else stick_x
            ey = turned_y if goes_on > 0.5 else stick_y
            slips = 1.0 if used > 1.0 else goes_on
            on_bound_x, on_bound_y = bound * ex, bound * ey
            slip = -(X * ex + (Y + Z * s) * ey) - 2.0 * s
            slip = slip if slip > 0.0 else 0.0
            lanes[_TX + l] = on_bound_x if slips > 0.5 else x
            lanes[_TY + l] = on_bound_y if slips > 0.5 else y
            lanes[_SLIPS + l] = slips
            lanes[NOW_X + l], lanes[NOW_Y + l] = ex, ey
            lanes[NOW_SLIP + l] = slip * slips
            lanes[NOW_USED + l] = 1.0 if slips > 0.5 else used
        keep(lanes, trace[k])
