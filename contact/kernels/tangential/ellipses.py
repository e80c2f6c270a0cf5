"""Ellipses that stand for a patch or for a strip of it, and the flexibilities of simplified theory on them (theory.md 2.5)."""

import math
from typing import NamedTuple

from contact.core import entry, kernel
from contact.kernels import kalker
from contact.kernels.arrays import Matrix
from contact.kernels.friction import slope_of_case
from contact.kernels.rows import Strip


class Part(NamedTuple):
    """One separate patch: strips first … last - 1, load `N` [N], and position (x, y) [m] as `place_in_load` gives it."""

    first: int
    last: int
    N: float
    x: float
    y: float


@kernel
def end_of_patch(strips, n, first):
    """Return the index after the last strip of the patch that begins at strip `first`."""
    last = first + 1
    while last < n and strips[Strip.PATCH, last] == strips[Strip.PATCH, first]:
        last += 1
    return last


@kernel
def centre_of_load(strips, first, last):
    """Return the load of strips over π/2 [N] and its centre (x, y) [m]."""
    load, x, y = 0.0, 0.0, 0.0
    for i in range(first, last):
        share = strips[Strip.P0, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        load += share
        x += share * strips[Strip.XC, i]
        y += share * strips[Strip.Y, i]
    return (load, x / load, y / load) if load > 0.0 else (0.0, 0.0, 0.0)


@kernel
def place_in_load(strips, n, first, last):
    """Return the share of a patch in the load of all `n` strips, and its centre (x, y) relative to theirs [m].

    For a single patch the result is exactly 1, 0, 0. Laws that take creepages of a patch as a whole take them at this
    place. So separate patches do not affect each other. For a single patch, and when a second one appears, this is the
    origin.
    """
    total, x0, y0 = centre_of_load(strips, 0, n)
    load, x, y = centre_of_load(strips, first, last)
    return (load / total, x - x0, y - y0) if total > 0.0 else (1.0, 0.0, 0.0)


@kernel
def stiffness_of(part, case, limit, workspace):
    """Return the shear modulus of a case times the factor on the creep stiffness, for one patch [Pa].

    `limit` is the largest force that friction allows on the patch [N].
    """
    if case.slope == 1.0 and case.slope_far == 1.0:
        return case.G
    a, b = equivalent_ellipse(workspace.strips, part.first, part.last)
    c11 = kalker.coefficients(workspace.tables.kalker, math.log(a / b))[0] if b > 0.0 else 0.0
    return case.G * slope_of_case(case, (part.x, part.y), a, b, c11, limit)


@kernel
def equivalent_ellipse(strips, first, last):
    """Return the semi-axes [m] of the ellipse with the longest strip as a and the area of the patch."""
    a = 0.0
    area = 0.0
    for i in range(first, last):
        a = max(a, strips[Strip.A, i])
        area += 2.0 * strips[Strip.A, i] * strips[Strip.DY, i]
    return a, (area / (math.pi * a) if a > 0.0 else 0.0)


@kernel
def is_beyond_kalker(strips, first, last):
    """Return whether a/b of the equivalent ellipse is beyond Kalker's coefficients, which then are those of their end."""
    a, b = equivalent_ellipse(strips, first, last)
    return b > 0.0 and abs(math.log(a / b)) > kalker.LOG_ASPECT_MAX


@kernel
def mean_ellipse(strips, first, last):
    """Return the semi-axes [m] of the ellipse with the area and the mean length of the shape that is shared (`ties`).

    Both are 0 without an area. The mean length follows from ∫a² dy/∫a dy, which is 8a/(3π) on an ellipse.
    """
    area, square = 0.0, 0.0
    for i in range(first, last):
        share = strips[Strip.SHARE, i] * strips[Strip.A, i] * strips[Strip.DY, i]
        area += share
        square += share * strips[Strip.A, i]
    a = 0.375 * math.pi * square / max(area, 1e-300)
    return a, 2.0 * area / (math.pi * max(a, 1e-300))


@entry
def flexibilities(G: float, a: float, b: float, table: Matrix) -> tuple[float, float, float]:
    """Return L1, L2, L3 [m/Pa] with which the forces at vanishing creepage are Kalker's (thesis Eqs. 4.28-4.30).

    Return 1, 1, 1 if there is no ellipse.
    """
    if a <= 0.0 or b <= 0.0:
        return 1.0, 1.0, 1.0
    c11, c22, c23, _ = kalker.coefficients(table, math.log(a / b))
    return (
        8.0 * a / (3.0 * G * c11),
        8.0 * a / (3.0 * G * c22),
        math.pi * a * a / (4.0 * G * math.sqrt(a * b) * c23),
    )


@entry
def weighted(vx: float, vy: float, phi: float, c: float, L1: float, L2: float, L3: float) -> float:
    """Return the single flexibility (|vx| L1 + |vy| L2 + |phi| c L3)/√(vx² + vy² + phi² c²) [m/Pa].

    The source is Kalker 1982; thesis Eqs. 4.31-4.32.
    """
    spin = c * phi
    size = math.sqrt(vx * vx + vy * vy + spin * spin)
    return (abs(vx) * L1 + abs(vy) * L2 + abs(spin) * L3) / size if size > 0.0 else L1
