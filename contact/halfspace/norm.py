"""NORM: the pressure between elastic half spaces in frictionless contact on a grid (Kalker 1990; theory.md 6).

    minimise ½ pᵀCp + (h - delta)ᵀp  over p >= 0:   p >= 0,   e = h - delta + C p >= 0,   p e = 0

The method is conjugate gradients on the elements in contact. The set of these elements is corrected in every iteration
(Polonsky and Keer 1999). The preconditioner is the inverse of C on a periodic grid (Vollebregt 2014, recalled); it reduces
46 iterations to 16 for 1e-6 on 124 × 68 elements. The start comes from a grid of half the resolution, recursively.
Pressure only pushes the surfaces apart, so contact lies inside the undeformed overlap h < delta. Several patches need no
special treatment.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.core import entry
from contact.halfspace.curved import Curved
from contact.halfspace.influence import Influence
from contact.halfspace.krylov import dot, size
from contact.inputs.material import Material
from contact.kernels.arrays import Flags, Matrix

#: Limits: iterations at given approach, and steps of the approach at given load.
MAX_ITERATIONS, MAX_STEPS = 300, 30
#: Coarser grids have at least this number of elements along each side.
_LEAST_SIDE = 20
#: Without a coarser grid, the start takes the elements up to this share of the overlap as in contact. In Hertz contact the
#: edge is at 1/(1 + alpha) along x and 1/(1 + beta) along y, on a circle at .5.
_LIKELY = 0.7
#: Relative change of the elements' stiffness at which its iteration stops. The relative error of the sum is its square.
_STIFFNESS_TOLERANCE = 3e-2
#: All rows.
ALL = slice(None)
#: Divisor for a first direction, whose quotient is not used.
_TINY = 1e-300
#: Rows and columns that are added on each side of the contact found on the coarser grid.
_MARGIN = 2


@dataclass(frozen=True, slots=True)
class Normal:
    """Solution of the normal problem.

    Attributes
    ----------
    p : pressure [Pa], shape (ny, nx)
    approach : [m], measured from h = 0
    stiffness : dN/d(approach) [N/m]
    iterations : of conjugate gradients on the given grid
    converged : False if the iteration stopped at its limit
    """

    p: Array
    approach: float
    stiffness: float
    iterations: int
    converged: bool


@dataclass(frozen=True, slots=True)
class Ground:
    """The half space under elements dx × dy [m], bent by the angles `tilt` of the rows if these are given."""

    dx: float
    dy: float
    material: Material
    tilt: Array | None = None

    @property
    def element(self) -> float:
        """Area of an element [m²]."""
        return self.dx * self.dy

    @property
    def coarser(self) -> Ground:
        """The plane half space under elements of twice the size."""
        return Ground(2.0 * self.dx, 2.0 * self.dy, self.material)

    def under(self, shape: tuple[int, ...], rows: slice = ALL) -> Influence:
        """Return the influence numbers of a grid of `shape`, whose rows are these."""
        if self.tilt is None:
            return Influence(shape, self.dx, self.dy, self.material)
        return Curved(shape, self.dx, self.dy, self.material, self.tilt[rows])


def norm(
    gap: Array,
    dx: float,
    dy: float,
    material: Material,
    *,
    load: float | None = None,
    approach: float | None = None,
    tolerance: float = 1e-5,
    start: Array | None = None,
    tilt: Array | None = None,
) -> Normal:
    """Solve the normal problem on a grid.

    Parameters
    ----------
    gap : ndarray, shape (ny, nx)
        Undeformed distance h at the centres of the elements [m].
    dx, dy : float
        Size of an element [m].
    material : Material
    load, approach : float
        Normal force [N] or rigid approach [m]. Give exactly one of them.
    tolerance : float
        Stop when the change of the pressure over the pressure (Euclidean norms) is below this.
    start : ndarray, shape (ny, nx)
        Pressure to start from [Pa]; default that of a coarser grid.
    tilt : ndarray, shape (ny,)
        Angle of each row of a bent surface [rad]; default the plane. Gap and approach are along the normal of the plane, and
        so is the pressure times the area of an element (`contact.halfspace.curved`).

    Returns
    -------
    Normal
    """
    ground = Ground(dx, dy, material, tilt)
    scale = 1.0 / ground.element
    if tilt is not None and start is None:
        start = norm(gap, dx, dy, material, load=load, approach=approach, tolerance=1e-2).p
    if load is not None:
        if load <= 0.0:
            return Normal(np.zeros(gap.shape), float(gap.min()), 0.0, 0, True)
        return _at_load(gap, ground, load * scale, tolerance, start)
    assert approach is not None
    if approach <= gap.min():
        return Normal(np.zeros(gap.shape), approach, 0.0, 0, True)
    if start is None:
        start = from_coarser(gap, ground, approach)
    p, iterations, converged = in_window(gap - approach, ground, start, tolerance)
    return Normal(p, approach, stiffness(p, ground).sum() / scale, iterations, converged)


def _at_load(gap: Array, ground: Ground, total: float, tolerance: float, start: Array | None) -> Normal:
    """Find the approach at which the pressures sum to `total` [Pa], by Newton's iteration. N(approach) is convex."""
    least = float(gap.min())
    if start is not None and start.any():
        p = start * (total / start.sum())
        touching = p > 0.0
        approach = float((gap + ground.under(gap.shape).normal(p))[touching].mean())
    elif min(gap.shape) >= 2 * _LEAST_SIDE:
        coarse = _at_load(_halved(gap), ground.coarser, 0.25 * total, 1e-2, None)
        p, approach = _doubled(coarse.p, gap.shape), coarse.approach
    else:
        p, approach = np.zeros_like(gap), least + _rough_overlap(gap - least, ground, total)
    iterations, converged = 0, False
    for _ in range(MAX_STEPS):
        if approach <= least:  # the load is too small for an overlap that a float holds
            return Normal(np.zeros(gap.shape), least, 0.0, iterations, True)
        p, n, solved = in_window(gap - approach, ground, p, tolerance)
        iterations += n
        rates = stiffness(p, ground)
        if not rates.any():  # no contact is left: the approach was too small
            approach = least + 2.0 * (approach - least)
            continue
        change = (total - p.sum()) / rates.sum()
        if abs(change) <= tolerance * (approach - least):
            converged = solved
            break
        change = max(change, -0.9 * (approach - least))
        p, approach = np.maximum(p + rates * change, 0.0), approach + change
    if p.any():
        p = p * (total / p.sum())
    return Normal(p, approach, float(rates.sum()) * ground.element, iterations, converged)


def _rough_overlap(h: Array, ground: Ground, total: float) -> float:
    """Return an estimate of the overlap [m] under the load, as a start.

    It is the overlap at which independent springs carry the load. Their stiffness is that of a half space under the
    overlap's area.
    """
    low, high = 0.0, float(h.max())
    for _ in range(30):
        middle = 0.5 * (low + high)
        depth = np.maximum(middle - h, 0.0)
        side = math.sqrt(np.count_nonzero(depth) * ground.element)
        carried = depth.sum() * ground.material.contact_modulus / side if side > 0.0 else 0.0
        low, high = (middle, high) if carried < total else (low, middle)
    return high


def _halved(gap: Array) -> Array:
    """Return the means of two by two elements. A last odd row or column counts twice."""
    ny, nx = gap.shape
    even = np.pad(gap, ((0, ny % 2), (0, nx % 2)), mode="edge")
    return 0.25 * (even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2])


def _doubled(p: Array, shape: tuple[int, ...]) -> Array:
    """Return the pressure of the halved grid on the full grid."""
    return p.repeat(2, axis=0).repeat(2, axis=1)[: shape[0], : shape[1]]


def from_coarser(gap: Array, ground: Ground, approach: float) -> Array:
    """Return the pressure to start from [Pa], computed at half the resolution."""
    halved = _halved(gap) if min(gap.shape) >= 2 * _LEAST_SIDE else gap
    if halved is gap or approach <= halved.min():
        least = gap.min()
        level = least + _LIKELY * (approach - least)
        # Hertz' shape; its scale does not matter
        return np.sqrt(np.maximum(level - gap, 0.0)) * ground.material.contact_modulus
    start = from_coarser(halved, ground.coarser, approach)
    p, _, _ = in_window(halved - approach, ground.coarser, start, 1e-2)
    return _doubled(p, gap.shape)


def _window(inside: NDArray[np.bool_]) -> tuple[slice, slice]:
    """Return the slices of rows and columns that hold the elements `inside`, with a margin of `_MARGIN`."""
    slices = []
    for axis in (1, 0):
        where = np.flatnonzero(inside.any(axis=axis))
        first = max(int(where[0]) - _MARGIN, 0)
        slices.append(slice(first, min(int(where[-1]) + 1 + _MARGIN, inside.shape[1 - axis])))
    return slices[0], slices[1]


def in_window(h: Array, ground: Ground, start: Array, tolerance: float) -> tuple[Array, int, bool]:
    """Solve for gap minus approach `h` on a window around the contact of `start`.

    The window is extended as long as elements outside it overlap. Return the pressure, the iterations and whether the
    iteration has converged.
    """
    overlap = h < 0.0
    inside = (start > 0.0) & overlap
    if not inside.any():
        inside = overlap
    p, iterations = np.zeros_like(h), 0
    while True:
        window = _window(inside)
        influence = ground.under(h[window].shape, window[0])
        p[window], n, solved = _conjugate_gradients(
            h[window], influence, np.where(inside, start, 0.0)[window], tolerance
        )
        iterations += n
        beyond = overlap.copy()
        beyond[window] = False
        if not beyond.any():
            return p, iterations, solved
        beyond &= h + ground.under(h.shape).normal(p) < 0.0
        if not beyond.any() or not solved:
            return p, iterations, solved
        inside, start = inside | beyond, p


def _conjugate_gradients(h: Array, influence: Influence, p: Array, tolerance: float) -> tuple[Array, int, bool]:
    """Return the pressure for gap minus approach `h`, the iterations, and whether they converged. `p` >= 0 is the start."""
    touching = p > 0.0 if p.any() else h < 0.0
    e = influence.normal(p)
    work = dot(p, e)
    best = max(-dot(h, p) / work, 0.0) if work > 0.0 else 1.0  # the multiple of the start with the least energy
    p, e = best * p, best * e + h
    residual = e * touching
    direction, old = np.zeros_like(p), np.zeros_like(p)
    square = 0.0  # the first direction is then that of steepest descent
    for iteration in range(1, MAX_ITERATIONS + 1):
        square = _steer(residual, influence.normal_inverse(residual), touching, square, direction, old)
        moved = influence.normal(direction)
        change, pulled, entered = _advance(p, e, residual, direction, moved, touching, influence.own)
        if pulled or entered:
            e = h + influence.normal(p)
            residual = e * touching
        if entered:
            square = 0.0
        elif change <= tolerance:
            return p, iteration, True
    return p, MAX_ITERATIONS, False


@entry
def _steer(residual: Matrix, z: Matrix, touching: Flags, before: float, direction: Matrix, old: Matrix) -> float:
    """Set the next direction from the preconditioned residual `z`. Return residual·z over the elements in contact.

    The rule is that of Polak and Ribière. It restarts by itself after a change of the contact set, and if before <= 0.
    """
    square, back = 0.0, 0.0
    for i in range(z.shape[0]):
        for j in range(z.shape[1]):
            if touching[i, j]:
                square += residual[i, j] * z[i, j]
                back += old[i, j] * z[i, j]
    # LLVM divides before it chooses, so the divisor must not be 0: that would be a trap
    beta = max((square - back) / max(before, _TINY), 0.0) if before > 0.0 else 0.0
    for i in range(z.shape[0]):
        for j in range(z.shape[1]):
            direction[i, j] = z[i, j] + beta * direction[i, j] if touching[i, j] else 0.0
            old[i, j] = residual[i, j]
    return square


@entry
def _advance(
    p: Matrix, e: Matrix, residual: Matrix, direction: Matrix, moved: Matrix, touching: Flags, own: float
) -> tuple[float, int, int]:
    """Step along the direction to the least energy, and correct the set of elements in contact.

    Elements with tension leave the contact; elements that overlap enter it. Return the change of the pressure over the
    pressure (Euclidean norms), and how many elements have left and entered. If none has, gap and residual are updated;
    else the caller has to recompute them.
    """
    curvature, along, length, size, pulled, entered = 0.0, 0.0, 0.0, 0.0, 0, 0
    for i in range(p.shape[0]):
        for j in range(p.shape[1]):
            curvature += direction[i, j] * moved[i, j]
            along += residual[i, j] * direction[i, j]
            length += direction[i, j] * direction[i, j]
    step = along / curvature if curvature > 0.0 else 0.0
    for i in range(p.shape[0]):
        for j in range(p.shape[1]):
            p[i, j] -= step * direction[i, j]
            size += p[i, j] * p[i, j]
            if p[i, j] < 0.0:
                p[i, j], touching[i, j] = 0.0, False
                pulled += 1
            elif e[i, j] < 0.0 and not touching[i, j]:
                p[i, j], touching[i, j] = -e[i, j] / own, True
                entered += 1
    if pulled + entered == 0:
        for i in range(p.shape[0]):
            for j in range(p.shape[1]):
                e[i, j] -= step * moved[i, j]
                residual[i, j] = e[i, j] if touching[i, j] else 0.0
    return abs(step) * math.sqrt(length / size) if size > 0.0 else 0.0, pulled, entered


def response(p: Array, lowered: Array, dx: float, dy: float, material: Material) -> Array:
    """Return the change r of a pressure of `norm` on the plane when the gap is lower by `lowered`, from C r = lowered.

    Elements come into contact and leave it at no pressure, so the set of them stays. C is symmetric: the same function gives
    the adjoint of any sum over the pressure.

    Parameters
    ----------
    p : ndarray, shape (ny, nx)
        Pressure [Pa], 0 outside the contact.
    lowered : ndarray, shape (ny, nx)
        [m] or, for an adjoint, the derivative of the sum by the pressure of each element.
    dx, dy : float
        Size of an element [m].
    material : Material
    """
    return _respond(p, lowered, Ground(dx, dy, material), 1e-9)


def stiffness(p: Array, ground: Ground) -> Array:
    """Return dp/d(approach) [Pa/m], roughly."""
    return _respond(p, np.ones_like(p), ground, _STIFFNESS_TOLERANCE)


def _respond(p: Array, lowered: Array, ground: Ground, tolerance: float) -> Array:
    """Return r on the elements in contact, from C r = lowered there."""
    touching = p > 0.0
    rates = np.zeros_like(p)
    if not touching.any():
        return rates
    window = _window(touching)
    inside = touching[window]
    influence = ground.under(inside.shape, window[0])
    # conjugate gradients as above, with a fixed set of elements in contact
    r, residual, direction, square = np.zeros(inside.shape), lowered[window] * inside, np.zeros(inside.shape), 1.0
    for _ in range(MAX_ITERATIONS):
        z = influence.normal_inverse(residual) * inside
        before, square = square, dot(residual, z)
        if square <= 0.0:
            break
        direction = z + square / before * direction
        moved = influence.normal(direction) * inside
        step = square / dot(direction, moved)
        r += step * direction
        residual -= step * moved
        if abs(step) * size(direction) <= tolerance * size(r):
            break
    rates[window] = r
    return rates
