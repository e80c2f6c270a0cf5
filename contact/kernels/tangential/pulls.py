"""Pulls: what the tractions of one lobe or patch do to another one beside it, as a change of its creepage.

A force (Fx, Fy) on strips displaces the surfaces beside them. In rolling the slope of this displacement along x counts: it is
a creepage with the opposite sign. For a force at distance (x, y), r² = x² + y²,

    ∂ux/∂x = [-(1 - ν) x Fx/r³ + ν ((2x Fx + y Fy)/r³ - 3x (x² Fx + xy Fy)/r⁵)]/(πG)
    ∂uy/∂x = [-(1 - ν) x Fy/r³ + ν (y Fx/r³ - 3x (xy Fx + y² Fy)/r⁵)]/(πG)

Within one shape (`ties`) the table of effective creepages has this already. So strip j pulls at strip i with (1 - s)³, where s
is its share in the shape of i: in full from another patch, not at all within an ellipse. With the third power strips side by
side leave nothing, however narrow they are, because what they do grows with 1/r³.

The traction of a strip that sticks grows from its leading edge. By Carter's theory the centre of its force lies behind its
middle by a k²/(1 + k), k² = 1 - |F|/(mu N), and by reciprocity the place where a displacement counts lies ahead by as much.
Around it two points a/2 from it stand for the strip. No constant is fitted. Forces are estimated for each shape by linear
theory with the cubic of Johnson and Vermeulen (mapped_strip.md 10 has what this brings).
"""

import math

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.rows import Strip
from contact.kernels.tangential.ellipses import mean_ellipse
from contact.kernels.tangential.fastsim import NO_FRICTION
from contact.kernels.tangential.linear import linear, saturated
from contact.kernels.tangential.ties import end_of_shape, is_read, share_shape


@kernel
def is_divided(strips, first, last):
    """Return whether the strips of a patch are more than one shape."""
    return end_of_shape(strips, last, first) < last


@kernel
def _used(strips, first, last, turn, case, tables):
    """Return the estimated force of the shape that is shared, over mu N. `turn` is that of `turn_of`."""
    a, b = mean_ellipse(strips, first, last)
    weights, vx, vy, phi, limit = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        weight = strips[Strip.SHARE, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        weights += weight
        limit += weight * strips[Strip.BOUND, i]
        vx += weight * (strips[Strip.VX, i] - strips[Strip.PHI, i] * strips[Strip.Y, i])
        vy += weight * (strips[Strip.VY, i] + strips[Strip.PHI, i] * strips[Strip.XC, i])
        phi += weight * strips[Strip.PHI, i]
    limit *= 0.5 * math.pi * case.mu
    if not limit > NO_FRICTION * case.G * a * b:
        return 0.0, 0.0
    coefficients = kalker.coefficients(tables.kalker, math.log(a / b) + turn)
    Fx, Fy, _, _ = linear((vx / weights, vy / weights, phi / weights), case.G, math.sqrt(a * b), coefficients)
    Fx, Fy, _, _ = saturated(Fx, Fy, limit, True)
    return Fx / limit, Fy / limit


@kernel
def set_forces(strips, first, last, around, case, tables):
    """Estimate the force of every strip of a patch, and how far from its middle it acts.

    Here and below `around` are the first of all strips of the separation and the one after its last.
    """
    i = first
    while i < last:
        share_shape(strips, around[0], around[1], i)
        fx, fy = _used(strips, around[0], around[1], strips[Strip.TURN, i], case, tables)
        left = max(1.0 - math.sqrt(fx * fx + fy * fy), 0.0)
        behind = left / (1.0 + math.sqrt(left)) if left > 0.0 else 0.0
        end = end_of_shape(strips, last, i)
        for j in range(i, end):
            a = strips[Strip.A, j]
            bound = 0.5 * math.pi * case.mu * strips[Strip.BOUND, j] * a * strips[Strip.DY, j]
            strips[Strip.FORCE_X, j], strips[Strip.FORCE_Y, j] = bound * fx, bound * fy
            strips[Strip.BEHIND, j] = behind * a
        i = end


@kernel
def _slope(x, y, wide, Fx, Fy, nu):
    """Return the slopes along x of the displacements at (x, y) by a force, times πG. `wide` is added to r²."""
    per_square = 1.0 / (x * x + y * y + wide)
    per_cube = per_square * math.sqrt(per_square)
    along = 3.0 * x * (x * Fx + y * Fy) * per_square
    by_x = nu * (2.0 * x * Fx + y * Fy - along * x) - (1.0 - nu) * x * Fx
    by_y = nu * (y * Fx - along * y) - (1.0 - nu) * x * Fy
    return by_x * per_cube, by_y * per_cube


@kernel
def _pull(strips, around, i, case):
    """Set by what creepage all other strips pull at strip i."""
    share_shape(strips, around[0], around[1], i)
    y, dy, half = strips[Strip.Y, i], strips[Strip.DY, i], 0.5 * strips[Strip.A, i]
    at = strips[Strip.XC, i] + strips[Strip.BEHIND, i]
    to_x, to_y = 0.0, 0.0
    for j in range(around[0], around[1]):
        apart = 1.0 - strips[Strip.SHARE, j]
        if apart <= 0.0:
            continue
        x, away = at - strips[Strip.XC, j] + strips[Strip.BEHIND, j], y - strips[Strip.Y, j]
        more, other = half + 0.5 * strips[Strip.A, j], half - 0.5 * strips[Strip.A, j]
        weight = 0.25 * apart * apart * apart
        Fx, Fy = weight * strips[Strip.FORCE_X, j], weight * strips[Strip.FORCE_Y, j]
        wide = (dy * dy + strips[Strip.DY, j] * strips[Strip.DY, j]) / 12.0
        x1, y1 = _slope(x + more, away, wide, Fx, Fy, case.nu)
        x2, y2 = _slope(x - more, away, wide, Fx, Fy, case.nu)
        x3, y3 = _slope(x + other, away, wide, Fx, Fy, case.nu)
        x4, y4 = _slope(x - other, away, wide, Fx, Fy, case.nu)
        to_x, to_y = to_x + (x1 + x2) + (x3 + x4), to_y + (y1 + y2) + (y3 + y4)
    per_stiffness = -1.0 / (math.pi * case.G)
    strips[Strip.BY_PULL_X, i], strips[Strip.BY_PULL_Y, i] = per_stiffness * to_x, per_stiffness * to_y


@kernel
def set_pulls(strips, first, last, around, case):
    """Set by what creepage all strips pull at those of a patch, from the forces of `set_forces`."""
    for i in range(first, last):
        if is_read(i, first, last):
            _pull(strips, around, i, case)
    for i in range(first + 1, last - 1):
        if not is_read(i, first, last):
            strips[Strip.BY_PULL_X, i] = 0.5 * (strips[Strip.BY_PULL_X, i - 1] + strips[Strip.BY_PULL_X, i + 1])
            strips[Strip.BY_PULL_Y, i] = 0.5 * (strips[Strip.BY_PULL_Y, i - 1] + strips[Strip.BY_PULL_Y, i + 1])
