"""Ends of the panels: how far the pressures beside an end tell it to move (strip_halfspace.md 2, step 4)."""

import math

from contact.core import entry, kernel
from contact.kernels.arrays import Matrix, Numbers
from contact.kernels.normal.between_panels import is_shared
from contact.kernels.normal.descent import END_SLOPE, END_STEP, END_VALUE
from contact.kernels.rows import Vector

_END_RANGE = (-3.0, 20.0)  # of one move outwards before the factor END_STEP, in widths of the end strip
_FAR = 0.95  # of that range, from which on a move counts as the longest one
#: Squared ratio of pressures from which on a frozen end still moves outwards: they rise towards the corner of a punch.
_PUNCH = 1.0
#: Pressure of the strip at an end over those of the next two, from which on it is a spur: the end lies inside the contact.
SPUR = 1.2
#: Third over fourth pressure up to which the peak lies away from the end, and from which on it lies at the end.
_AWAY, _NEAR = 0.8, 1.1
#: Second over third pressure from which on the pressures rise so much towards the end that the peak of a lobe lies there, and
#: from which on that alone counts.
_RISING, _LOBE = 1.1, 1.5
#: Least number of strips of a panel that is read by groups of strips.
_COARSEST = 20
#: First over second pressure at the exact half width, its change over a width of the end strip, the curvature of this relation,
#: and the largest excess that counts in it (strip_halfspace.md 2, step 4).
_FIRST_VALUE, _FIRST_SLOPE, _BEND_OUTWARDS, _BEND_INWARDS, _MOST = 0.36, 0.625, 0.55, 0.3, 1.6


@kernel
def idle_strips(vectors, n, first, step):
    """Return the number of idle strips at one end of a panel, at most n - 1."""
    idle = 0
    while idle < n - 1 and vectors[Vector.P, first + idle * step] <= 0.0:
        idle += 1
    return idle


@entry
def have_idle_part(n: int, n_panels: int, vectors: Matrix) -> bool:
    """Return whether a seventh of a loaded panel is idle at one of its ends, so that it must be cut off."""
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        idle = idle_strips(vectors, n, first, 1)
        if vectors[Vector.P, first + idle] > 0.0 and 7 * max(idle, idle_strips(vectors, n, last, -1)) > n:
            return True
    return False


@kernel
def _from_first_two(p0, p1):
    """Return how far an end should move outwards by its first two pressures, in widths of the end strip.

    The zero is that of an ellipse, the size is fitted to ellipses and flange roots. `p0` may be a tension.
    """
    if not p1 > 0.0:
        return _END_RANGE[0]
    u = p0 / p1 - _FIRST_VALUE
    bend = _BEND_OUTWARDS * min(u, _MOST) if u > 0.0 else _BEND_INWARDS * u
    return u / (_FIRST_SLOPE * (1.0 - bend))


@kernel
def _wanted(p0, p1, p2, p3):
    """Return how far an end should move outwards, in widths of the strip at the end, and the share of the first pressure.

    On the exact half width the squared ratio q of the second and third pressures has a known value. If the second pressure
    is high, the panel is too narrow. Where the third pressure is not much below the fourth or above it, or the second one far
    above the third, the peak lies at this end, and q depends on its shape. There the ratio of the first two pressures counts
    instead.
    """
    wanted = ((p1 / p2) ** 2 - END_VALUE) / END_SLOPE
    share = min(max((p2 / p3 - _AWAY) / (_NEAR - _AWAY), 0.0), 1.0) if p3 > 0.0 else 1.0
    share = max(share, min(max((p1 / p2 - _RISING) / (_LOBE - _RISING), 0.0), 1.0))
    if share > 0.0:
        share *= share * (3.0 - 2.0 * share)
        wanted = (1.0 - share) * wanted + share * _from_first_two(p0, p1)
    return min(max(wanted, _END_RANGE[0]), _END_RANGE[1]), share


@kernel
def _mean(vectors, first, step, begin, end):
    """Return the mean pressure of the strips `begin` to `end` from an end of a panel, tension at the end included."""
    load, width = 0.0, 0.0
    for k in range(begin, end):
        i = first + k * step
        p = vectors[Vector.END, i] if k == 0 else vectors[Vector.P, i]
        load, width = load + p * vectors[Vector.HALF, i], width + vectors[Vector.HALF, i]
    return load / width


@kernel
def _by_groups(vectors, n, first, step, cosines, wanted):
    """Return `wanted`, or how far the end should move if that is too far to be read from the strips at the end.

    Strips at an end are narrow, by the square of their number, and tell moves of a few of their widths. So groups of 2, 4,
    8 ... strips are read like one strip of a coarser panel. The coarsest panel that counts has at least `_COARSEST` strips.
    A finer one takes over where the move is less than the width of the coarser one's end strip.
    """
    size = 1
    while 2 * size * _COARSEST <= n:
        size *= 2
    far = 0.0
    width = 1.0 + cosines[1]
    known = False
    while size > 1:
        p2 = _mean(vectors, first, step, 2 * size, 3 * size)
        if p2 > 0.0:
            p0, p1 = _mean(vectors, first, step, 0, size), _mean(vectors, first, step, size, 2 * size)
            here, _ = _wanted(p0, p1, p2, _mean(vectors, first, step, 3 * size, 4 * size))
            unit = (1.0 + cosines[size]) / width
            share = min(max(abs(far) / (2.0 * unit) - 1.0, 0.0), 1.0) if known else 0.0
            share *= share * (3.0 - 2.0 * share)
            far = share * far + (1.0 - share) * here * unit
            known = True
        size //= 2
    share = min(max(0.5 * abs(far) - 1.0, 0.0), 1.0)
    share *= share * (3.0 - 2.0 * share)
    return share * far + (1.0 - share) * wanted


@entry
def is_far(n: int, cosines: Numbers, moved: float) -> bool:
    """Return whether an end `moved` outwards, over the width, as far as strips tell: its place of rest lies beyond."""
    size = 1
    while 2 * size * _COARSEST <= n:
        size *= 2
    return moved > _FAR * 0.5 * END_STEP * _END_RANGE[1] * (1.0 + cosines[size])


@kernel
def go_far(n, n_panels, panels, cosines, vectors):
    """Let ends that want the longest move outwards make it whole.

    Their rule tells no more than the direction there, and the mixing would leave little of it: an end crept over a thin bridge.
    """
    for p in range(n_panels):
        width = panels[2 * p + 1] - panels[2 * p]
        for side in range(2):
            end, outwards = p * n + side * (n - 1), 2.0 * side - 1.0
            if is_far(n, cosines, outwards * vectors[Vector.R, end] / width):
                vectors[Vector.STEP, end] = outwards * max(
                    outwards * vectors[Vector.STEP, end], outwards * vectors[Vector.R, end]
                )


@kernel
def end_move(vectors, n, first, step, cosines, shared, frozen, calm, skewed):
    """Return the outward move of one end of a panel over its half width.

    `first` is the strip at this end, `step` the step to its neighbour. The share of the first pressure in the rule replaces
    that pressure in Vector.END. An end that is `shared` with another panel only leaves idle strips, and the panels part there.
    A `frozen` end keeps its place, and idle strips with it, unless the half lengths are `calm` and the pressure rises towards
    it, as at the corner of a punch or in the last strip alone. It goes as far as the rule tells only to the corner of a punch
    in patches that are not `skewed`: elsewhere that is a direction, and the gap tells what lies there.
    """
    p0, p1, p2 = vectors[Vector.END, first], vectors[Vector.P, first + step], vectors[Vector.P, first + 2 * step]
    idle = idle_strips(vectors, n, first, step)
    if idle >= 2 or p2 <= 0.0:
        vectors[Vector.END, first] = 0.0
        return -(1.0 + cosines[idle]) if idle >= 2 and not frozen else 0.0
    if shared:
        vectors[Vector.END, first] = 1.0
        return 0.0
    punch, spur = (p1 / p2) ** 2 >= _PUNCH and p0 >= p1, p0 > SPUR * max(p1, p2)
    if frozen and not (calm and (punch or spur)):
        vectors[Vector.END, first] = 0.0
        return 0.0
    wanted, share = _wanted(p0, p1, p2, vectors[Vector.P, first + 3 * step] if n > 3 else math.inf)
    if n >= 2 * _COARSEST:
        wanted = _by_groups(vectors, n, first, step, cosines, wanted)
    if frozen and not punch:
        wanted = max(wanted, 1.0)
    move = END_STEP * wanted * (1.0 + cosines[1])
    if frozen and (skewed or not punch) and is_far(n, cosines, 0.5 * move):
        move = share = 0.0
    vectors[Vector.END, first] = share
    return move


@entry
def end_moves(
    y: Numbers,
    n: int,
    n_panels: int,
    panels: Numbers,
    cosines: Numbers,
    vectors: Matrix,
    frozen: bool,
    calm: bool,
    skewed: bool,
) -> float:
    """Fill Vector.R of the end strips with the moves of all panels' ends. Return the largest move over the width."""
    largest = 0.0
    for p in range(n_panels):
        first, last = p * n, p * n + n - 1
        low, high = panels[2 * p], panels[2 * p + 1]
        half = 0.5 * (high - low)
        move = end_move(vectors, n, first, 1, cosines, is_shared(2 * p, n_panels, panels), frozen, calm, skewed)
        vectors[Vector.R, first] = max(low - half * move, y[0]) - low
        move = end_move(vectors, n, last, -1, cosines, is_shared(2 * p + 1, n_panels, panels), frozen, calm, skewed)
        vectors[Vector.R, last] = min(high + half * move, y[y.size - 1]) - high
        largest = max(largest, max(abs(vectors[Vector.R, first]), abs(vectors[Vector.R, last])) / (high - low))
    return largest
