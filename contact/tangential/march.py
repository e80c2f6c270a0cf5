"""FASTSIM's march along one strip in normalised form, shared by FASTSIM and by FaStrip's direction pass.

With x = x_c + a s, traction tau and bound g(s) both divided by the peak of the bound, the rigid slip over flexibility of a
step is (X, Y + Z s): X = a vx/(L1 g0), Y = a vy/(L2 g0), Z = a² phi/(L3 g0) (theory.md 2.5; Kalker 1982).
"""

import math

from contact._jit import kernel

PARABOLIC, ELLIPTIC = 0, 1


@kernel
def march(angles, X, Y, Z, bound, tau_x, tau_y, excess):  # type: ignore[no-untyped-def]
    """March from the leading edge over elements at s = cos(angle); return the number of slipping elements.

    Fills the traction `tau` of each element and the `excess` |trial| - g over the step that produced it, which is the slip
    in units of the step's flexibility; 0 in stick. The spin term is taken at the middle of each step, exact in stick.
    """
    n = angles.size
    x, y = 0.0, 0.0
    s_before = 1.0
    slipping = 0
    for k in range(n):
        s = math.cos(angles[k])
        step = s_before - s
        middle = 0.5 * (s + s_before)
        x -= step * X
        y -= step * (Y + Z * middle)
        g2 = 1.0 - s * s
        g = g2 if bound == PARABOLIC else math.sqrt(g2)
        size = math.sqrt(x * x + y * y)
        if size > g:
            x *= g / size
            y *= g / size
            excess[k] = (size - g) / step
            slipping += 1
        else:
            excess[k] = 0.0
        tau_x[k], tau_y[k] = x, y
        s_before = s
    return slipping
