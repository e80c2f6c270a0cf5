"""TANG: traction, stick and slip in steady rolling on a grid (Kalker 1990; theory.md 6).

    s = w + [C q(x) - C q(x + dx)]/dx,    |q| <= mu p,    s = 0 where |q| < mu p,    q = -mu p s/|s| where s != 0

is a variational inequality. Its operator, C(x) - C(x + dx), is positive definite but not symmetric. The solution is
therefore unique, but Gauss-Seidel sweeps diverge. Here a semi-smooth Newton iteration with active sets of stick and slip
solves it, in 8 to 12 steps from q = 0. Each step is a linear system, solved by GMRES with the products by FFT. The
preconditioner uses two facts: C by itself is symmetric, and in the stick zone a sum from the leading edge inverts the
difference. About 5 GMRES steps are needed on any grid. If Newton's iteration stalls, transient rolling over increasing
distances L leads to the steady state,

    s = w + [C q(x) - C q(x + dx)]/dx + C (q - q_before)/L.

The rigid slip w of spin varies along x. It is taken at x + dx·`OFFSET`. The difference of displacements belongs to
x + dx/2 and the traction to x. Both choices have errors of first order with opposite signs (theory.md 6).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array, brief
from contact.halfspace import zones
from contact.halfspace.bent import Bent
from contact.halfspace.influence import Influence, tangential
from contact.halfspace.newton import Newton, Operator
from contact.inputs.creepage import Creepage
from contact.inputs.material import Material
from contact.kernels.tangential.fastsim import NO_FRICTION

Window = tuple[slice, slice]

#: Position of the rigid slip ahead of the element's centre, over dx. The value is that of CONTACT.
OFFSET = 1.0 / 6.0
#: Largest number of transient distances.
MAX_DISTANCES = 12


@dataclass(frozen=True, slots=True, eq=False)
class Tangential:
    """Solution of the tangential problem; arrays have shape (ny, nx).

    Attributes
    ----------
    qx, qy : traction on the wheel [Pa]
    sx, sy : slip velocity, wheel minus rail, over V [-]
    stick : True in the adhesion area
    iterations : number of Newton steps
    products : number of products with the half space's matrix, a measure of the work
    residual : residual of q = projection of q - s/rho, over q (Euclidean norms)
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

    __repr__ = brief


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
    added: Array | None = None,
    layer: float = 0.0,
    progress: Callable[[int, float], None] | None = None,
) -> Tangential:
    """Solve the tangential problem of steady rolling towards +x.

    Parameters
    ----------
    p : ndarray, shape (ny, nx)
        Pressure [Pa], 0 outside the contact.
    x, y : ndarray, shape (nx,), (ny,)
        Centres of the elements [m], evenly spaced, increasing; `y` along the surface.
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
    added : ndarray, shape (2, ny, nx)
        Slip over V from other causes than creepage and traction, added to the rigid slip.
    layer : float
        Shear flexibility of a layer between the bodies [m/Pa].
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
    if frictionless(bound, material):
        rigid = np.zeros((2, *p.shape))
        if touching.any():
            rigid[:, touching] = rigid_slip(x, rows, 0.0)[:, touching]
        return Tangential(whole[0], whole[1], rigid[0], rigid[1], np.zeros(p.shape, dtype=bool), 0, 0, 0.0, True)
    rolling, w, window = prepare(p, x, y, rows, bound, material, offset, added, layer, tolerance, progress)
    q = np.zeros_like(w) if start is None else np.stack([field[window] for field in start])
    q, residual = rolling.steady(q, w)
    s = rolling.slip(q, w)
    zones.settle(q, s, rolling.zone, rolling.bound)
    for k, field in enumerate((*q, *s, rolling.zone)):
        whole[k][window] = field
    qx, qy, sx, sy, zone = whole
    return Tangential(
        qx, qy, sx, sy, zone == zones.STICK, rolling.iterations, rolling.products, residual, residual <= tolerance
    )


def frictionless(bound: Array, material: Material) -> bool:
    """Return whether a traction `bound` [Pa] counts as zero, as on strips: its square would underflow."""
    return not bound.max(initial=0.0) > NO_FRICTION * material.shear_modulus


def prepare(
    p: Array,
    x: Array,
    y: Array,
    rows: Bent,
    bound: Array,
    material: Material,
    offset: float,
    added: Array | None,
    layer: float,
    tolerance: float,
    progress: Callable[[int, float], None] | None,
) -> tuple[Rolling, Array, Window]:
    """Return the problem on the smallest grid that contains the contact, its rigid slip and the place of that grid."""
    across, along = (np.flatnonzero((p > 0.0).any(axis=axis)) for axis in (1, 0))
    window = slice(across[0], across[-1] + 1), slice(along[0], along[-1] + 1)
    steps = float(x[1] - x[0]), float(y[1] - y[0])
    w = np.ascontiguousarray(rigid_slip(x, rows, offset * steps[0])[:, *window])
    if added is not None:
        w += added[:, *window]
    return Rolling(np.ascontiguousarray(bound[window]), steps, material, layer, tolerance, progress), w, window


def rigid_slip(x: Array, rows: Bent, ahead: float) -> Array:
    """Return the rigid slip over V, shape (2, ny, nx)."""
    w = np.empty((2, rows.y.size, x.size))
    w[0] = (rows.vx - rows.phi * rows.y)[:, None]
    w[1] = rows.vy[:, None] + rows.phi[:, None] * (x + ahead)
    return w


class Rolling(Newton):
    """One problem of steady rolling. `bound` is the largest traction of each element [Pa]."""

    def __init__(
        self,
        bound: Array,
        steps: tuple[float, float],
        material: Material,
        layer: float,
        tolerance: float,
        progress: Callable[[int, float], None] | None,
    ) -> None:
        self.dx = steps[0]
        super().__init__(bound, Influence(bound.shape, *steps, material, layer), tolerance, progress)
        self._own = tangential(np.array([0.0, self.dx]), np.zeros(2), *steps, material)[0] + np.array([layer, 0.0])
        self._fade(0.0)

    def _fade(self, per_metre: float) -> None:
        """Set the operator for steady rolling (`per_metre` = 0) or transient rolling over the distance 1/`per_metre` [m]."""
        h, dx = self.influence, self.dx
        difference = (1.0 - h.ahead) / dx + per_metre
        here, next_ = self._own
        own, share = float(here * (1.0 / dx + per_metre) - next_ / dx), 1.0 / (1.0 + dx * per_metre)
        self.operator = Operator((h.xx * difference, h.yy * difference, h.xy * difference), own, share * dx, share)

    def steady(self, q: Array, w: Array) -> tuple[Array, float]:
        """Return traction and residual of steady rolling with the rigid slip `w` over V. `q` is the start."""
        traction, residual = self.solve(q, w)
        if residual <= self.tolerance:
            return traction, residual
        h = self.influence
        length = 0.25 * self.bound.shape[1] * self.dx
        for _ in range(MAX_DISTANCES):
            self._fade(1.0 / length)
            before = self.times((h.xx / length, h.yy / length, h.xy / length), q)
            q, _ = self.solve(q, w - before)
            self._fade(0.0)
            length *= 1.5
        return self.solve(q, w)
