"""TANG: traction, stick and slip in steady rolling on a grid (Kalker 1990; theory.md 6).

    s = w + [C q(x) - C q(x + dx)]/dx,    |q| <= mu p,    s = 0 where |q| < mu p,    q = -mu p s/|s| where s != 0

is a variational inequality. Its operator, C(x) - C(x + dx), is positive definite but not symmetric. The solution is
therefore unique, but Gauss-Seidel sweeps diverge. Here a semi-smooth Newton iteration with active sets of stick and slip
solves it, in 5 to 10 steps from q = 0. Each step is a linear system, solved by GMRES with the products by FFT. The
preconditioner uses two facts: C by itself is symmetric, and in the stick zone a sum from the leading edge inverts the
difference. About 10 GMRES steps are needed on any grid. If Newton's iteration stalls, transient rolling over increasing
distances L leads to the steady state,

    s = w + [C q(x) - C q(x + dx)]/dx + C (q - q_before)/L.

The rigid slip w of spin varies along x. It is taken at x + dx·`OFFSET`. The difference of displacements belongs to
x + dx/2 and the traction to x. Both choices have errors of first order with opposite signs (theory.md 6).
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

#: Position of the rigid slip ahead of the element's centre, over dx. The value is that of CONTACT.
OFFSET = 1.0 / 6.0
#: Limits: Newton steps, GMRES steps in each of them, and transient distances.
MAX_NEWTON, MAX_KRYLOV, MAX_DISTANCES = 25, 80, 12
#: Relative accuracy of the linear systems. A smaller value costs more than it saves.
_INEXACT = 1e-2
#: rho over the diagonal of the operator. With 1, an element that slips in the wrong direction would reverse its slip
#: instead of sticking.
_STIFFER = 3.0


@dataclass(frozen=True, slots=True)
class Tangential:
    """Solution of the tangential problem; arrays have shape (ny, nx).

    Attributes
    ----------
    qx, qy : traction on the wheel [Pa]
    sx, sy : slip velocity, wheel minus rail, over V [-]
    stick : True in the adhesion area
    iterations : number of Newton steps
    products : number of products with the half space's matrix, a measure of the work
    residual : residual of q = projection of q - s/rho, over mu p (Euclidean norms)
    converged : False if the iteration stopped at its limit
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
        Wheel minus rail over V, at the origin or of each row.
    friction : float or ndarray, shape (ny, nx)
        Coefficient of friction mu [-].
    material : Material
    offset : float
        Position of the rigid slip in the element, see the module.
    tolerance : float
        Upper bound of the residual.
    start : (qx, qy)
        Traction to start from [Pa]; default 0.
    progress : callable
        Called with the number of the Newton step and the residual.

    Returns
    -------
    Tangential
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
    """Return the rigid slip over V, shape (2, ny, nx)."""
    w = np.empty((2, y.size, x.size))
    w[0] = (rows.vx - rows.phi * y)[:, None]
    w[1] = rows.vy[:, None] + rows.phi[:, None] * (x + ahead)
    return w


class _Rolling:
    """One tangential problem on the smallest grid that contains the contact, and the state of its solution."""

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
        """Set the operator for steady rolling (`per_metre` = 0) or transient rolling over the distance 1/`per_metre` [m]."""
        h, dx = self._influence, self.dx
        difference = (1.0 - h.ahead) / dx + per_metre
        self._transfer = h.xx * difference, h.yy * difference, h.xy * difference
        here, next_ = tangential(np.array([0.0, dx]), np.zeros(2), dx, self._dy, self._material)[0]
        self._own = float(here * (1.0 / dx + per_metre) - next_ / dx)
        self._share = 1.0 / (1.0 + dx * per_metre)

    def _times(self, transfer: tuple[Array, Array, Array], q: Array) -> Array:
        """Return the product of the transfer functions (xx, yy, xy) with a field of shape (2, ny, nx)."""
        self.products += 1
        x, y = self._influence.forward(q)
        xx, yy, xy = transfer
        return self._influence.back(np.stack((xx * x + xy * y, xy * x + yy * y)))

    def slip(self, q: Array, w: Array) -> Array:
        """Return the slip over V for the traction `q` and the rigid slip `w`."""
        return w + self._times(self._transfer, q)

    def steady(self, q: Array) -> tuple[Array, float]:
        """Return traction and residual of steady rolling. `q` is the start."""
        traction, residual = self._newton(q, self.w)
        if residual <= self.tolerance:
            return traction, residual
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
        """Return the last iterate of Newton's iteration from `q`, and its residual."""
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
        """Return the product of the Newton step's matrix with a restricted change `v`."""
        moved = self._times(self._transfer, v)
        zones.restrict(moved, self.zone, self._tangent)
        return moved + self._stiffness * v

    def _precondition(self, v: Array) -> Array:
        """Return an approximate solution of the Newton step with the right hand side `v`."""
        u = self._times(self._inverse, np.where(self.zone == zones.STICK, v, 0.0))
        change = np.empty_like(v)
        zones.accumulate(v, u, self.zone, self._stiffness, self._own, self.dx, self._share, change)
        return change
