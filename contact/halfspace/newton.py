"""Newton's iteration with active sets of stick and slip, for one tangential problem on a grid.

    s = w + operator·q,    |q| <= mu p,    s = 0 where |q| < mu p,    q = -mu p s/|s| where s != 0

Each step is a linear system, solved by GMRES with the products by FFT.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.halfspace import zones
from contact.halfspace.influence import Influence, Transfer
from contact.halfspace.krylov import gmres, size

#: Limits: Newton steps, and GMRES steps in each of them.
MAX_NEWTON, MAX_KRYLOV = 25, 80
#: Relative accuracy of the linear systems. With 1e-2 there are 1 to 2 Newton steps less, but a quarter to two thirds more
#: products with the half space's matrix.
INEXACT = 0.1
#: rho over the diagonal of the operator. With 1, an element that slips in the wrong direction would reverse its slip
#: instead of sticking.
_STIFFER = 3.0
#: Residuals are compared with the traction, at least with this share of mu p (Euclidean norms).
_LEAST = 1e-8


class Operator(NamedTuple):
    """Slip over V from traction, and what its preconditioner needs.

    Attributes
    ----------
    transfer : transfer functions xx, yy, xy on the padded grid
    own : slip of an element from its own traction
    gain, share : in stick, the traction is `gain` times the inverse of C plus `share` of that of the element ahead
    """

    transfer: Transfer
    own: float
    gain: float
    share: float


class Newton:
    """One tangential problem: the friction bound, the half space and the state of the iteration."""

    def __init__(
        self,
        bound: Array,
        influence: Influence,
        tolerance: float,
        progress: Callable[[int, float], None] | None,
    ) -> None:
        self.bound, self.influence, self.tolerance, self.progress = bound, influence, tolerance, progress
        self.iterations = self.products = 0
        h = influence
        determinant = h.xx * h.yy - h.xy * h.xy
        self._inverse = h.yy / determinant, h.xx / determinant, -h.xy / determinant
        self.operator: Operator
        self.zone, self._stiffness = np.empty_like(bound), np.empty_like(bound)
        self._step = np.empty((3, 2, *bound.shape))
        self.tangent, self.correction, self._rhs = self._step
        self._scale = size(bound)

    def times(self, transfer: Transfer, q: Array) -> Array:
        """Return the product of the transfer functions (xx, yy, xy) with a field of shape (2, ny, nx), and count it."""
        self.products += 1
        return self.influence.times(transfer, q)

    def slip(self, q: Array, w: Array) -> Array:
        """Return the slip over V for the traction `q` and the rigid slip `w`."""
        return w + self.times(self.operator.transfer, q)

    def solve(self, q: Array, w: Array) -> tuple[Array, float]:
        """Return the last iterate of Newton's iteration from `q`, and its residual."""
        for step in range(MAX_NEWTON + 1):
            residual = self.linearise(q, self.slip(q, w))
            if residual <= self.tolerance or step == MAX_NEWTON:
                break
            change, _ = gmres(self.apply, self.precondition, self.right_hand_side(), INEXACT, MAX_KRYLOV)
            q = self.moved(q, change)
        return q, residual

    def linearise(self, q: Array, s: Array) -> float:
        """Set up the next step at the traction `q` with the slip `s` over V, and return the residual."""
        rho = _STIFFER * self.operator.own
        square = zones.linearise(q, s, self.bound, rho, self.zone, self._step, self._stiffness)
        residual = math.sqrt(square) / max(min(size(q), self._scale), _LEAST * self._scale)
        if self.progress is not None:
            self.progress(self.iterations, residual)
        return residual

    def right_hand_side(self) -> Array:
        """Return the right-hand side of the step."""
        return self._rhs - self.restricted(self.times(self.operator.transfer, self.correction))

    def moved(self, q: Array, change: Array) -> Array:
        """Return the traction after the step's `change`, with slipping elements on the friction circle."""
        self.iterations += 1
        q = q + change + self.correction
        zones.admit(q, self.zone, self.bound)
        return q

    def restricted(self, v: Array) -> Array:
        """Restrict the field `v` in place to what the step may change, and return it."""
        zones.restrict(v, self.zone, self.tangent)
        return v

    def apply(self, v: Array) -> Array:
        """Return the product of the Newton step's matrix with a restricted change `v`."""
        return self.restricted(self.times(self.operator.transfer, v)) + self._stiffness * v

    def precondition(self, v: Array) -> Array:
        """Return an approximate solution of the Newton step with the right hand side `v`."""
        u = self.times(self._inverse, np.where(self.zone == zones.STICK, v, 0.0))
        change = np.empty_like(v)
        operator = self.operator
        zones.accumulate(v, u, self.zone, self._stiffness, operator.own, operator.gain, operator.share, change)
        return change
