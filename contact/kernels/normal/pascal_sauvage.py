"""Pascal and Sauvage's equivalent ellipse (1993): one Hertzian contact in place of several, with their total load.

The contacts of `multi_hertz` are replaced by one ellipse at their common approach. Its centre is the centroid of their
loads, and its half curvature A is that of the separation there. Its B is such that Hertz's load N(A, B, delta) is the
sum of their loads. So tangential methods for one ellipse can be used. [R]: recalled from Pascal and Sauvage, Vehicle
System Dynamics 22 (1993) 263, by way of theory.md 5 ("conserving total force"). How they choose the ratio of the axes
is not at hand.
"""

import math

from contact.core import kernel
from contact.kernels.cubic import locate
from contact.kernels.hertz import local_factors
from contact.kernels.normal.multi_hertz import lay_ellipse
from contact.kernels.rows import Strip

#: Range of ln(B/A) in which the equivalent curvature is searched.
_LOW, _HIGH = -16.0, 16.0


@kernel
def equivalent_curvature(A, N, delta, modulus):
    """Return B [1/m] at which Hertz's contact (A, B) carries N at approach delta. N falls with B, so bisection is used."""
    low, high = _LOW, _HIGH
    for _ in range(60):
        u = 0.5 * (low + high)
        B = A * math.exp(u)
        _, one_beta, nr, _ = local_factors(A, B)
        if 4.0 / 3.0 * modulus * delta * math.sqrt(delta) > N * nr * math.sqrt(one_beta * B):
            low = u
        else:
            high = u
    return A * math.exp(0.5 * (low + high))


@kernel
def one_ellipse(sep, N, n_strips, delta, modulus, across, strips, edges):
    """Replace the strips of several ellipses that carry N by those of one. Return their number."""
    y, A, xc, n = sep.y, sep.A, sep.x_c, sep.y.size
    load, moment = 0.0, 0.0
    for i in range(n_strips):
        part = strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        load += part
        moment += part * strips[Strip.Y, i]
    centre = moment / load
    k = locate(y, n, centre, 0)
    t = (centre - y[k]) / (y[k + 1] - y[k])
    A_here, x_c = (1.0 - t) * A[k] + t * A[k + 1], (1.0 - t) * xc[k] + t * xc[k + 1]
    B = equivalent_curvature(A_here, N, delta, modulus)
    lay_ellipse(strips, 0, delta, (A_here, B), (centre, x_c), modulus, across, edges)
    return across.nodes.size
