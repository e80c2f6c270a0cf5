"""Skewed patches: what the turn of a patch in its plane changes in mapped strip marching (mapped_strip.md 7).

The middles of a skewed patch's strips lie on a line x = k y. With the longest half length a0 and the half width b of an ellipse
with the same area, a0, b and k determine an ellipse that is turned by an angle θ, with the ratio g of its axes. It creeps
like a straight ellipse with ln(a/b) = ln g cos 2θ, which is not the ratio a0/b of its longest chord to its width. Its
flexibility has a principal direction along neither coordinate, so longitudinal creepage has a lateral force, and spin a
longitudinal one.
"""

import math

from contact.core import kernel
from contact.kernels.rows import Strip

#: Share of the turn in the aspect ratios: the best on turned ellipses, and as good as any on real patches.
_SHARE = 0.7
#: Rate of the coupling over ln g, from linear theory; longitudinal force by spin over that by lateral creepage of equal force.
_RATE, _BY_SPIN = 0.62, 3.5
#: Creepage (as r in `tangential.table`) at which a quarter of the coupling is left.
_FADE = 5.0


@kernel
def turn_of(strips, first, last):
    """Return by how much ln(a/b) of the shape that is shared exceeds ln(a0/b), times `_SHARE`, and sin 2θ tanh(rate ln g).

    Both are 0 where the middles of the strips lie on a line along y.
    """
    load, y, x, longest, area = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        half = strips[Strip.SHARE, i] * strips[Strip.A, i]
        part = half * strips[Strip.DY, i]
        weight = strips[Strip.P0, i] * part
        load, y, x = load + weight, y + weight * strips[Strip.Y, i], x + weight * strips[Strip.XC, i]
        longest, area = max(longest, half), area + 2.0 * part
    if not load > 0.0:
        return 0.0, 0.0
    y, x = y / load, x / load
    square, product = 0.0, 0.0
    for i in range(first, last):
        weight = strips[Strip.P0, i] * (strips[Strip.SHARE, i] * strips[Strip.A, i] * strips[Strip.DY, i])
        away = strips[Strip.Y, i] - y
        square, product = square + weight * away * away, product + weight * away * (strips[Strip.XC, i] - x)
    if not (square > 0.0 and product != 0.0):
        return 0.0, 0.0
    # eigenvalues of the ellipse's quadratic form (1, -k; -k, (a0/b)² + k²)/a0²
    k, chord = product / square, math.pi * longest * longest / area
    along, across = 1.0, chord * chord + k * k
    root = math.sqrt((across - along) ** 2 + 4.0 * k * k)
    log_axes = math.log(0.5 * (along + across + root) / chord)
    t = math.exp(-2.0 * _RATE * log_axes)
    change = log_axes * (across - along) / root - math.log(chord)
    return _SHARE * change, 2.0 * k / root * (1.0 - t) / (1.0 + t)


@kernel
def coupled(coupling, nu, r, coefficients, c, creepage):
    """Return what a turned patch adds to the longitudinal and the lateral creepage (mapped_strip.md Eq. coupled).

    `coupling` is the second number of `turn_of`, `r` the size of the creepages in `tangential.table`, and c = √(ab).
    """
    c11, c22, c23, _ = coefficients
    vx, vy, phi = creepage
    left = _FADE / (_FADE + r)
    share = -nu / (2.0 - nu) * coupling * left * left
    return share * (c22 * vy + _BY_SPIN * c23 * c * phi) / c11, share * vx
