"""Mapped strip marching without its march: edge, map, slip after stick, centres of a patch (mapped_strip.md)."""

import math

from contact.core import kernel
from contact.kernels import kalker
from contact.kernels.rows import Strip
from contact.kernels.tangential.skew import turn_of
from contact.kernels.tangential.ties import end_of_shape, share_shape

#: ln(a/b) of a strip has `_LOCAL` of the mean of its shape's own ones, from the curvatures, and the rest from the equivalent
#: ellipse; `_DEVIATION` of how far its own is from that mean; and `_TURN` of what `turn_of` gives (mapped_strip.md Eq. aspect).
_LOCAL, _DEVIATION, _TURN = 0.3, 0.65, 1.2


@kernel
def edge_direction(r, wx, wy):
    """Return the direction of slip at a slipping leading edge, where bound and traction start from zero."""
    size = math.sqrt(wx * wx + wy * wy) + 1e-300
    ex, ey = -wx / size, -wy / size
    for _ in range(3):
        slip = size - 2.0 * (r * ex * ex + ey * ey)
        slip = 0.5 * (slip + abs(slip))  # no selection, of which the compiler would make a branch
        ex, ey = -wx / (slip + 2.0 * r), -wy / (slip + 2.0)
        per_length = 1.0 / (math.sqrt(ex * ex + ey * ey) + 1e-300)
        ex, ey = ex * per_length, ey * per_length
    return ex, ey


@kernel
def end_of_stick(X, Y, P):
    """Return 1 + s where a strip that sticks at its leading edge begins to slide.

    The utilisation is (X, Y + P (1 + s))/(1 + s). Its square is 1 at a root of a quadratic equation for 1/(1 + s).
    """
    square, b = X * X + Y * Y, Y * P
    inside = b * b + square * (1.0 - P * P)
    root = math.sqrt(0.5 * (inside + abs(inside)))
    above, below = (b + root, 1.0 - P * P) if b > 0.0 else (square, root - b)
    end = above / (below + 1e-300)
    end = end if end < 2.0 else 2.0
    return end if end > 0.0 else 0.0


@kernel
def mapped(ux, uy, o, n):
    """Return the traction over mu·p in stick from the utilisation u of the parabolic bound.

    `o` is the y component of the pole. The exponent m = 1/2 + n enters as √(1-t)·(1-t)^n. The second factor is replaced
    by its [2/2] Padé approximant, which needs no libm (no change of accuracy on set A: .0077 → .0076).
    """
    dx, dy = ux, uy - o
    square = dx * dx + dy * dy
    along = o * dy
    t = square / (math.sqrt(along * along + square * (1.0 - o * o)) - along + 1e-300)
    t = t if t < 1.0 else 1.0
    # with √(1-t) = 1 - t/r, r = 1 + √(1-t), and above/below = 1 - n t (1-t/2)/below, f has no cancellation
    r = 1.0 + math.sqrt(1.0 - t)
    below = 1.0 - 0.5 * (2.0 - n) * t + (2.0 - n) * (1.0 - n) / 12.0 * t * t
    f = (below + n * (1.0 - 0.5 * t) * (r - t)) / (r * below)
    return dx * f, o + dy * f


@kernel
def slid_at(s, direction, r, pole, rigid, from_edge):
    """Return the slip of a particle at s over the lateral flexibility, 0 or more.

    The particle slides along `direction` against the `rigid` slip (Xs, Ys + 2 spin s). Where the strip slips from its
    edge this is the slip of the march. After a stick zone that ends at s_b the march has (1 - s) + (s_b - s), which
    belongs to the parabola. Strip theory has 2√((1 - s)(s_b - s)). Both multiply the traction without its spin part, e
    - o (theory.md 4.3). They agree in value and slope where the whole strip begins to slip.
    """
    ex, ey = direction
    Xs, Ys, spin = rigid
    fx, fy = ex, ey - pole
    stiffness = r * fx * fx + fy * fy + 1e-300
    reach = -(Xs * fx + Ys * fy) / stiffness  # 1 + s_b
    march = -(Xs * ex + (Ys + 2.0 * spin * s) * ey) - 2.0 * s * (r * ex * ex + ey * ey)
    back = reach - 1.0 - s
    back = back if back > 0.0 else 0.0
    theory = 2.0 * math.sqrt((1.0 - s) * back) * (r * ex * fx + ey * fy)
    slip = march if from_edge > 0.5 or reach >= 2.0 else theory
    return slip if slip > 0.0 else 0.0


@kernel
def _aspects_of_shape(strips, first, last, i):
    """Return the mean of the strips' own ln(a/b) in the shape of strip i, by load, and ln(a/b) of its equivalent ellipse."""
    share_shape(strips, first, last, i)
    longest, area, load, moment = 0.0, 0.0, 0.0, 0.0
    for j in range(first, last):
        half = strips[Strip.SHARE, j] * strips[Strip.A, j]
        part = half * strips[Strip.DY, j]
        longest = max(longest, half)
        area += 2.0 * part
        load += part * strips[Strip.P0, j]
        moment += part * strips[Strip.P0, j] * strips[Strip.LN_ASPECT, j]
    if not load > 0.0:
        return 0.0, 0.0
    return moment / load, math.log(math.pi * longest * longest / area)


@kernel
def set_aspects(strips, first, last, table):
    """Set ln(a/b) of the strips in place, their turn and their stiffness (mapped_strip.md 3, step 0)."""
    i = first
    while i < last:
        mean, equivalent = _aspects_of_shape(strips, first, last, i)
        turn, coupling = turn_of(strips, first, last)
        of_shape = _LOCAL * mean + (1.0 - _LOCAL) * (equivalent + _TURN * turn)
        end = end_of_shape(strips, last, i)
        for j in range(i, end):
            log_aspect = of_shape + _DEVIATION * (strips[Strip.LN_ASPECT, j] - mean)
            c11, _, _, c33 = kalker.coefficients(table, log_aspect)
            weight = c11 * strips[Strip.A, j] * strips[Strip.DY, j]
            strips[Strip.ASPECT, j], strips[Strip.STIFFNESS, j] = log_aspect, weight
            strips[Strip.SPIN_STIFFNESS, j] = weight * 4.0 * c33 * math.exp(log_aspect) / c11
            strips[Strip.TURN, j], strips[Strip.COUPLING, j] = turn, coupling
        i = end


@kernel
def set_centres(strips, first, last):
    """Set the centre of longitudinal stiffness and the C33 factor of the shape of every strip (mapped_strip.md 3, step 0)."""
    i = first
    while i < last:
        share_shape(strips, first, last, i)
        stiffness, moment, spin = 0.0, 0.0, 0.0
        for j in range(first, last):
            weight = strips[Strip.SHARE, j] * strips[Strip.STIFFNESS, j]
            stiffness += weight
            moment += weight * strips[Strip.Y, j]
            spin += strips[Strip.SHARE, j] * strips[Strip.SPIN_STIFFNESS, j]
        end = end_of_shape(strips, last, i)
        for j in range(i, end):
            strips[Strip.CENTRE, j] = moment / max(stiffness, 1e-300)
            strips[Strip.SPIN_FACTOR, j] = spin / max(stiffness, 1e-300)
        i = end
