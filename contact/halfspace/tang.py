"""TANG: traction, stick and slip in steady rolling on a grid (Kalker 1990; theory.md 6).

    s = w + [C q(x) - C q(x + dx)]/dx,    |q| <= mu p,    s = 0 where |q| < mu p,    q = -mu p s/|s| where s != 0

is a variational inequality whose operator, C(x) - C(x + dx), is positive definite but not symmetric: its solution is unique,
but sweeps of Gauss-Seidel diverge. Here Newton's iteration (semi-smooth; active sets of stick and slip) solves it, in 5 to
10 steps from q = 0. Each step is a linear system, solved by GMRES with the products by FFT. The preconditioner uses that C
alone is symmetric and that in stick the difference is undone by a sum from the leading edge; it takes about 10 steps of
GMRES on any grid. Should Newton's iteration stall, transient rolling over ever longer distances L leads to the steady state,

    s = w + [C q(x) - C q(x + dx)]/dx + C (q - q_before)/L.

The rigid slip w of spin varies along x. It is taken at x + dx·`OFFSET`: the difference of displacements belongs to x + dx/2,
the traction to x; both are of first order with opposite errors (theory.md 6).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.creepage import Creepage
from contact.halfspace import zones
from contact.halfspace.bent import Bent
from contact.halfspace.influence import Influence, tangential
from contact.halfspace.krylov import gmres
from contact.material import Material

Array = NDArray[np.float64]

#: Where in an element the rigid slip is taken, in elements ahead of the centre: as CONTACT does.
OFFSET = 1.0 / 6.0
#: Caps: steps of Newton's iteration and of GMRES in each, and transient distances.
MAX_NEWTON, MAX_KRYLOV, MAX_DISTANCES = 25, 80, 12
#: Accuracy of Newton's steps: smaller ones gain less than they cost.
_INEXACT = 1e-2
#: rho over the diagonal of the operator. With 1 an element that slips the wrong way is turned round instead of stuck.
_STIFFER = 3.0


@dataclass(frozen=True, slots=True)
class Tangential:
    """Solution of the tangential problem; arrays have shape (ny, nx).

    Attributes
    ----------
    qx, qy : traction on the wheel [Pa]
    sx, sy : slip velocity, wheel minus rail, over V [-]
    stick : True in the adhesion area
    iterations : Newton's steps
    products : products with the half space, a measure of the work
    residual : of q = projection of q - s/rho, over mu p (Euclidean norms)
    converged : False where the iteration stopped at its cap
    """

    qx: Array
    qy: Array
    sx: Array
    sy: Array
    stick: NDArray[np.bool_]
    iterations: int
    products: int
    residual: float
    converged: bool


def tang(
    p: Array,
    x: Array,
    y: Array,
    creepage: Creepage | Bent,
    friction: float | Array,
    material: Material,
    *,
    offset: float = OFFSET,
    tolerance: float = 1e-6,
    start: tuple[Array, Array] | None = None,
    progress: Callable[[int, float], None] | None = None,
) -> Tangential:
    """Solve the tangential problem of steady rolling towards +x.

    Parameters
    ----------
    p : ndarray, shape (ny, nx)
        Pressure [Pa], 0 outside the contact.
    x, y : ndarray, shape (nx,), (ny,)
        Centres of the elements [m], evenly spaced, increasing.
    creepage : Creepage or Bent
        Wheel minus rail over V at the origin, or of each row.
    friction : float or ndarray, shape (ny, nx)
        mu [-].
    material : Material
    offset : float
        Where in the element the rigid slip is taken, see the module.
    tolerance : float
        Bound of the residual.
    start : (qx, qy)
        Traction to start from [Pa]; default none.
    progress : callable
        Given the number of Newton's step and the residual.
    """
    whole = np.zeros((5, *p.shape))
    touching = p > 0.0
    bound = friction * p
    rows = creepage if isinstance(creepage, Bent) else Bent.plane(creepage, y)
    if not bound.any():
        rigid = np.zeros((2, *p.shape))
        if touching.any():
            rigid[:, touching] = _rigid_slip(x, y, rows, 0.0)[:, touching]
        return Tangential(whole[0], whole[1], rigid[0], rigid[1], np.zeros(p.shape, dtype=bool), 0, 0, 0.0, True)
    across, along = (np.flatnonzero(touching.any(axis=axis)) for axis in (1, 0))
    window = slice(across[0], across[-1] + 1), slice(along[0], along[-1] + 1)
    dx, dy = float(x[1] - x[0]), float(y[1] - y[0])
    w = np.ascontiguousarray(_rigid_slip(x, y, rows, offset * dx)[:, *window])
    rolling = _Rolling(np.ascontiguousarray(bound[window]), w, dx, dy, material, tolerance, progress)
    q = np.zeros_like(w) if start is None else np.stack([field[window] for field in start])
    q, residual = rolling.steady(q)
    s = rolling.slip(q, w)
    zones.settle(q, s, rolling.zone, rolling.bound)
    for k, field in enumerate((*q, *s, rolling.zone)):
        whole[k][window] = field
    qx, qy, sx, sy, zone = whole
    return Tangential(
        qx, qy, sx, sy, zone == zones.STICK, rolling.iterations, rolling.products, residual, residual <= tolerance
    )


def _rigid_slip(x: Array, y: Array, rows: Bent, ahead: float) -> Array:
    """Rigid slip over V, shape (2, ny, nx)."""
    w = np.empty((2, y.size, x.size))
    w[0] = (rows.vx - rows.phi * y)[:, None]
    w[1] = rows.vy[:, None] + rows.phi[:, None] * (x + ahead)
    return w


class _Rolling:
    """One problem on the smallest grid that holds its contact, and the state of its solution."""

    def __init__(
        self,
        bound: Array,
        w: Array,
        dx: float,
        dy: float,
        material: Material,
        tolerance: float,
        progress: Callable[[int, float], None] | None,
    ) -> None:
        self.bound, self.w, self.dx, self._dy, self._material = bound, w, dx, dy, material
        self.tolerance, self.progress = tolerance, progress
        self.iterations = self.products = 0
        self._influence = h = Influence(bound.shape, dx, dy, material)
        determinant = h.xx * h.yy - h.xy * h.xy
        self._inverse = h.yy / determinant, h.xx / determinant, -h.xy / determinant
        self._fade(0.0)
        self.zone, self._stiffness = np.empty_like(bound), np.empty_like(bound)
        self._step = np.empty((3, *w.shape))
        self._tangent, self._correction, self._rhs = self._step
        self._scale = math.sqrt(float(np.einsum("ij,ij->", bound, bound)))

    def _fade(self, per_metre: float) -> None:
        """Make the operator that of steady rolling (0), or transient over the distance 1/`per_metre`."""
        h, dx = self._influence, self.dx
        difference = (1.0 - h.ahead) / dx + per_metre
        self._transfer = h.xx * difference, h.yy * difference, h.xy * difference
        here, next_ = tangential(np.array([0.0, dx]), np.zeros(2), dx, self._dy, self._material)[0]
        self._own = float(here * (1.0 / dx + per_metre) - next_ / dx)
        self._share = 1.0 / (1.0 + dx * per_metre)

    def _times(self, transfer: tuple[Array, Array, Array], q: Array) -> Array:
        """The half space with the transfer functions xx, yy, xy on a field (2, ny, nx)."""
        self.products += 1
        x, y = self._influence.forward(q)
        xx, yy, xy = transfer
        return self._influence.back(np.stack((xx * x + xy * y, xy * x + yy * y)))

    def slip(self, q: Array, w: Array) -> Array:
        """Slip over V from the rigid slip `w`."""
        return w + self._times(self._transfer, q)

    def steady(self, q: Array) -> tuple[Array, float]:
        """Traction and residual of steady rolling, from the traction `q`."""
        found, residual = self._newton(q, self.w)
        if residual <= self.tolerance:
            return found, residual
        h = self._influence
        length = 0.25 * self.bound.shape[1] * self.dx
        for _ in range(MAX_DISTANCES):
            self._fade(1.0 / length)
            before = self._times((h.xx / length, h.yy / length, h.xy / length), q)
            q, _ = self._newton(q, self.w - before)
            self._fade(0.0)
            length *= 1.5
        return self._newton(q, self.w)

    def _newton(self, q: Array, w: Array) -> tuple[Array, float]:
        """Newton's iteration from `q`; the last iterate and its residual."""
        rho = _STIFFER * self._own
        for step in range(MAX_NEWTON + 1):
            square = zones.linearise(q, self.slip(q, w), self.bound, rho, self.zone, self._step, self._stiffness)
            residual = math.sqrt(square) / self._scale
            if self.progress is not None:
                self.progress(self.iterations, residual)
            if residual <= self.tolerance or step == MAX_NEWTON:
                break
            self.iterations += 1
            moved = self._times(self._transfer, self._correction)
            zones.restrict(moved, self.zone, self._tangent)
            change, _ = gmres(self._apply, self._precondition, self._rhs - moved, _INEXACT, MAX_KRYLOV)
            q = q + change + self._correction
            zones.admit(q, self.zone, self.bound)
        return q, residual

    def _apply(self, v: Array) -> Array:
        """The matrix of Newton's step on a change `v` that is already restricted."""
        moved = self._times(self._transfer, v)
        zones.restrict(moved, self.zone, self._tangent)
        return moved + self._stiffness * v

    def _precondition(self, v: Array) -> Array:
        """An approximate solution of Newton's step with the right hand side `v`."""
        u = self._times(self._inverse, np.where(self.zone == zones.STICK, v, 0.0))
        change = np.empty_like(v)
        zones.accumulate(v, u, self.zone, self._stiffness, self._own, self.dx, self._share, change)
        return change
