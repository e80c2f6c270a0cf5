"""CONTACT's approximate pressures on its grid at a given approach: KPEC (B = 5) and ANALYN (B = 6).

Both are CONTACT's forms of published methods, so that files that ask for them give its numbers. The methods `kpec` and
`analyn` of this package work on strips instead and differ by some per cent. h is the distance less the approach, negative in
the overlap.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.halfspace import Gap, Normal
from contact.halfspace.influence import Influence
from contact.inputs.material import Material
from contact.theory.hertz import hertz

#: Least curvature [1/m], and share of the depth within which Kik and Piotrowski take the contact.
_FLAT, _SHARE = 0.1, 0.5
_OPEN = "B = 5 needs a gap that opens to both sides; within the grid this one does not"


def pressure(method: int, gap: Gap, approach: float, material: Material) -> Array:
    """Return the pressure [Pa] of B = 5 or 6, shape (ny, nx)."""
    h = gap.h - approach
    if not h.min() < 0.0:
        return np.zeros_like(h)
    if min(h.shape) < 3:
        raise ContactError(f"B = {method} needs three rows and columns of elements at least; the patch has {h.shape}")
    return (kpec if method == 5 else analyn)(h, gap, material)


def normal(
    method: int, gap: Gap, h: Array, dx: float, dy: float, material: Material, *, approach: float, **_: Any
) -> Normal:
    """Return the normal solution of B = 5 or 6 as `contact.halfspace.norm` does; `gap` has the places of the elements."""
    return Normal(pressure(method, Gap(gap.x, gap.y, h), approach, material), approach, 0.0, 0, True)


def kpec(h: Array, gap: Gap, material: Material) -> Array:
    """Return the pressure of Kik and Piotrowski (2008) with the correction of shape by an equivalent ellipse."""
    depth = -float(h.min())
    A, B, a, b, middle = _equivalent_ellipse(h, gap, depth, material)
    along = A * a**2
    share = (along - (along - B * b**2) * ((gap.y - middle) / b) ** 2) / depth
    limit = -(1.0 - np.maximum(share, 0.0)) * depth
    inside = h <= limit[:, None]
    counts = [int(k[-1] - k[0] + 1) if k.size else 0 for k in map(np.flatnonzero, inside)]
    longest = 0.5 * max(counts) * gap.dx
    p = np.zeros_like(h)
    for i in np.flatnonzero(counts):
        k = np.flatnonzero(inside[i])
        first, last = int(k[0]), int(k[-1])
        back = _crossing(gap.x, h[i], limit[i], first, -1)
        front = _crossing(gap.x, h[i], limit[i], last, 1)
        x = gap.x[first : last + 1] - 0.5 * (back + front)
        p[i, first : last + 1] = np.sqrt(np.maximum((0.5 * (front - back)) ** 2 - x**2, 0.0)) / longest
    u = float(Influence(h.shape, gap.dx, gap.dy, material).normal(p).flat[int(h.argmin())])
    return np.where(inside, p * (depth / u), 0.0)


def _crossing(x: Array, h: Array, level: float, k: int, way: int) -> float:
    """Return x at which h passes `level` between element k and the next one in a direction."""
    if not 0 <= k + way < x.size:
        return float(x[k] + 0.5 * way * (x[1] - x[0]))
    t = (level - h[k]) / (h[k + way] - h[k])
    return float(x[k] + way * (x[1] - x[0]) * min(max(t, 0.0), 1.0))


def _equivalent_ellipse(
    h: Array, gap: Gap, depth: float, material: Material
) -> tuple[float, float, float, float, float]:
    """Return curvatures A, B [1/m], semi-axes a, b [m] and the lateral centre [m] of the ellipse that replaces a patch."""
    row, column = divmod(int(h.argmin()), h.shape[1])
    level = -(1.0 - _SHARE) * depth
    ny, nx = h.shape
    if not 0 < column < nx - 1:
        raise ContactError(_OPEN)
    n = 1
    while column - n > 0 and column + n < nx - 1 and max(h[row, column - n], h[row, column + n]) <= level:
        n += 1
    back, front = max(column - n, 0), min(column + n, nx - 1)
    A = float(h[row, front] - 2.0 * h[row, column] + h[row, back]) / (2.0 * (gap.x[front] - gap.x[column]) ** 2)
    rows = np.flatnonzero((h <= level).any(axis=1))
    first, last = max(int(rows[0]), 1), min(int(rows[-1]), ny - 2)
    ends = []
    for i, way in ((first, -1), (last, 1)):
        j = int(h[i].argmin())
        rise = float(h[i + way, j] - h[i, j])
        if not rise > 0.0:
            raise ContactError(_OPEN)
        ends.append(gap.y[i] + way * gap.dy * (level - h[i, j]) / rise)
    middle = float(0.5 * (ends[0] + ends[1]))
    if not ends[1] > middle:
        raise ContactError("B = 5 needs a patch that lies within the grid; this one reaches no further than its border")
    B = max(_FLAT, (level + depth) / float(ends[1] - middle) ** 2)
    found = hertz(max(A, _FLAT), B, approach=depth, material=material)
    a, b = found.a, found.b
    if first >= last:  # so that the deepest point is inside
        b = max(b, 1.1 * abs(float(gap.y[row]) - middle))
    return A, B, a, b, middle


def analyn(h: Array, gap: Gap, material: Material) -> Array:
    """Return the pressure of ANALYN (Sichani 2014): each row is that of an ellipse with the curvatures there."""
    depth, p = -float(h.min()), np.zeros_like(h)
    ny, nx = h.shape
    for i in range(ny):
        j = int(h[i].argmin())
        g, at = float(h[i, j]) + depth, min(max(j, 1), nx - 2)
        k = min(max(i, 1), ny - 2)
        A = 0.5 * float(h[i, at + 1] - 2.0 * h[i, at] + h[i, at - 1]) / gap.dx**2
        B = 0.5 * float(h[k + 1, at] - 2.0 * h[k, at] + h[k - 1, at]) / gap.dy**2
        A, B = max(A, _FLAT), max(B, _FLAT)
        whole = hertz(A, B, approach=depth, material=material)
        local = depth - depth / (B * whole.b**2) * g
        if not local > 0.0:
            continue
        length = whole.a * math.sqrt(local / depth)
        there = hertz(A, B, approach=local, material=material)
        top = 1.5 * there.N / (math.pi * there.a * there.b)
        p[i] = top * np.sqrt(np.maximum(1.0 - ((gap.x - gap.x[j]) / length) ** 2, 0.0))
    return p
