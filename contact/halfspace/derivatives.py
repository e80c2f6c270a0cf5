"""Derivatives of a solution of the element-wise half space. Each column is one linear system.

At the solution, a change dw of the rigid slip and dg of the friction bound moves traction and slip by dq and ds,

    ds = dw + operator·dq,    ds = 0 in stick,    dq = dg n + v t,    t·ds + (|s|/g) v = 0 in slip,

with the direction n of the traction and t across it. This is the matrix of the last Newton step (`newton`). The pressure does
not depend on creepages and friction. Its change with the approach solves C dp = 1 on the elements in contact (`norm`).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from contact.halfspace.bent import Bent
from contact.halfspace.krylov import gmres
from contact.halfspace.norm import response
from contact.halfspace.pressed import Pressed
from contact.halfspace.solution import GridSolution
from contact.halfspace.tang import OFFSET, frictionless, prepare, rigid_slip
from contact.inputs.creepage import Creepage
from contact.results import Jacobian

#: Relative accuracy of the linear systems, and the most steps of each.
_TOLERANCE, _MOST = 1e-7, 150
#: Step over the creepage, and the least one [-], for the slope of a friction law.
_STEP, _LEAST = 1e-4, 1e-9


class _Moved(NamedTuple):
    """Change of traction [Pa] and slip over V [-] by one unit, shape (2, ny, nx)."""

    q: Array
    s: Array


def require_differentiable(pressed: Pressed) -> None:
    """Raise a ContactError if the half space has no derivatives for this problem."""
    friction = pressed.friction
    local = friction.velocity != "global" and friction.law != "coulomb"
    for holds, what in (
        (pressed.material.coupling != 0.0, "unlike materials"),
        (pressed.surface is not None, "conformal = True"),
        (pressed.layer is not None, "a layer"),
        (local or friction.hot_factor < 1.0, "friction that depends on local slip or temperature"),
    ):
        if holds:
            raise ContactError(f"derivatives = True does not work with {what}")


def derive(pressed: Pressed, solution: GridSolution) -> Jacobian:
    """Return the derivatives of what `pressed.roll` has returned last.

    Raises
    ------
    ContactError
        If the two problems depend on each other, or friction on the slip of each place.
    """
    require_differentiable(pressed)
    given = "approach" if pressed.load is None else "load"
    values = np.zeros((6, 5))
    p, x, y = pressed.p, pressed.x, pressed.y
    traction = pressed.traction
    if not p.any() or traction is None:
        return _finished(values, given)
    dx, dy = float(x[1] - x[0]), float(y[1] - y[0])
    rising = response(p, np.ones_like(p), dx, dy, pressed.material)
    stiffness = float(rising.sum()) * dx * dy
    unit = 1.0 if given == "approach" else 1.0 / stiffness
    values[3, 3], values[4, 3] = unit * stiffness, unit
    creepage, mu, factor = solution.creepage, solution.friction, pressed.factor()
    bound = mu * factor * p
    if not frictionless(bound, pressed.material):
        rows = Bent.plane(creepage, y)
        rolling, w, window = prepare(p, x, y, rows, bound, pressed.material, OFFSET, None, 0.0, _TOLERANCE, None)
        q = np.stack([field[window] for field in traction])
        s = rolling.slip(q, w)
        rolling.linearise(q, s)
        outward = np.stack((rolling.tangent[1], -rolling.tangent[0]))

        def moved(dw: Array, dg: Array) -> _Moved:
            radial = dg * outward
            rhs = -rolling.restricted(dw + rolling.times(rolling.operator.transfer, radial))
            across, _ = gmres(rolling.apply, rolling.precondition, rhs, _TOLERANCE, _MOST)
            change = radial + across
            return _Moved(change, dw + rolling.times(rolling.operator.transfer, change))

        still, fixed = np.zeros_like(w), np.zeros_like(w[0])
        changes = [moved(_slip_of(k, x, y)[:, *window], fixed) for k in range(3)]
        changes.append(moved(still, unit * mu * (factor * rising)[window]))
        changes.append(moved(still, (factor * p)[window]))
        at_x, at_y = x[window[1]], y[window[0]][:, None]
        for k, (dq, ds) in enumerate(changes):
            values[:3, k] = dq[0].sum(), dq[1].sum(), (at_x * dq[1] - at_y * dq[0]).sum()
            values[5, k] = -(dq * s + q * ds).sum()
        values[[0, 1, 2, 5]] *= dx * dy
        _follow_law(pressed, creepage, mu, values)
    return _finished(values, given)


def _slip_of(k: int, x: Array, y: Array) -> Array:
    """Return the rigid slip over V of one unit of creepage `k`: longitudinal, lateral or spin."""
    unit = Creepage(*(1.0 if j == k else 0.0 for j in range(3)))
    return rigid_slip(x, Bent.plane(unit, y), OFFSET * float(x[1] - x[0]))


def _follow_law(pressed: Pressed, creepage: Creepage, mu: float, values: Array) -> None:
    """Add to the creepages' columns what the coefficient of friction changes with them, and scale that of the friction."""
    friction = pressed.friction
    slip = math.hypot(creepage.longitudinal, creepage.lateral)
    if friction.law != "coulomb" and slip > 0.0:
        step = max(_STEP * slip, _LEAST)
        ends = (float(friction.coefficient(pressed.speed * (slip + sign * step))) for sign in (1.0, -1.0))
        slope = (next(ends) - next(ends)) / (2.0 * step)
        for k, part in enumerate((creepage.longitudinal, creepage.lateral)):
            values[:, k] += values[:, 4] * slope * part / slip
    values[:, 4] *= mu / friction.static if friction.static > 0.0 else 1.0


def _finished(values: Array, given: str) -> Jacobian:
    values.setflags(write=False)
    return Jacobian(values, given)
