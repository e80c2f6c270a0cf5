"""FASTSIM's march along one strip in normalised form, shared by FASTSIM and by FaStrip's direction pass.

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


@kernel
def turned(ex, ey, wx, wy, w, stretch):
    """Unit vector (ex, ey) turned towards -(wx, wy), |w| = w, over the normalised distance `stretch`."""
    dx, dy = -wx / w, -wy / w
    cosine = dx * ex + dy * ey
    sine = dx * ey - dy * ex
    if cosine < -1.0 + 1e-14:  # exactly against the equilibrium: stays there
        return ex, ey
    t = sine / (1.0 + cosine) * math.exp(-w * stretch)
    scale = 1.0 / (1.0 + t * t)
    cosine, sine = (1.0 - t * t) * scale, 2.0 * t * scale
    return dx * cosine - dy * sine, dy * cosine + dx * sine


@kernel
def march(elements, X, Y, Z, tau_x, tau_y, excess):
    """March from the leading edge; fill the traction `tau` and the slip `excess` of each element.

    `excess` is the slip in units of flexibility times the bound's peak over a; it is 0 in stick. In stick the traction is
    exact, spin included.
    """
    n = elements.shape[1]
    x, y, ex, ey, bound = 0.0, 0.0, 0.0, 0.0, 0.0
    slips = X * X + (Y + Z) ** 2 > 4.0  # at the edge the traction of stick rises |W|/2 times as fast as the bound
    for k in range(n):
        s, step, middle = elements[EL_S, k], elements[EL_STEP, k], elements[EL_MIDDLE, k]
        wx, wy = X, Y + Z * middle
        before, bound = bound, elements[EL_SINE, k] ** 2
        if slips and k > 0 and -(wx * ex + wy * ey) - 2.0 * middle <= 0.0:
            slips = False
            x, y = before * ex, before * ey
        if slips:
            w = math.sqrt(wx * wx + wy * wy)
            if k == 0:
                ex, ey = -wx / w, -wy / w
            elif w > 0.0:
                ex, ey = turned(ex, ey, wx, wy, w, elements[EL_ATANH, k])
        else:
            x -= step * wx
            y -= step * wy
            size = math.sqrt(x * x + y * y)
            if size > bound:
                slips = True
                ex, ey = x / size, y / size
        if slips:
            x, y = bound * ex, bound * ey
            excess[k] = max(-(X * ex + (Y + Z * s) * ey) - 2.0 * s, 1e-300)
        else:
            excess[k] = 0.0
        tau_x[k], tau_y[k] = x, y
