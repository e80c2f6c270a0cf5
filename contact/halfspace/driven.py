"""Creepages that answer a given tangential force, found together with the traction in one Newton iteration.

The rigid slip has one uniform field for each unknown creepage, and each has its force,

    s = w + w_x xi + w_y eta + operator·q,    sum of q dx dy = F.

The Newton step is that of TANG, bordered by these columns and rows. The preconditioner of TANG also serves the bordered
system, by its Schur complement. Such an iteration takes little more time than that for given creepages.
"""

from __future__ import annotations

import math

import numpy as np

from contact.arrays import Array
from contact.halfspace.krylov import gmres
from contact.halfspace.newton import INEXACT, MAX_KRYLOV, MAX_NEWTON, Newton
from contact.halfspace.tang import Rolling

#: A step that Newton's iteration does not solve from the last traction is led there in this number of parts, or in `_MORE`.
_PARTS, _MORE = 5, 25
#: Most evaluations of the search for one creepage.
_MOST_ROOT = 60
#: Smallest determinant of the Schur complement over that of a sticking contact; below it the force is nearly saturated.
_REGULAR = 1e-6
#: A larger creepage [-] is no answer: the wheel slides as fast as it rolls.
_LARGEST = 1.0


class GivenForces:
    """One problem of steady rolling, or of a step in time, under given forces.

    Parameters
    ----------
    rolling : Newton
    w : ndarray, shape (2, ny, nx)
        Rigid slip over V without the unknown creepages.
    unknown : list of int
        Directions of the unknown creepages, 0 longitudinal and 1 lateral.
    wanted : ndarray, shape (len(unknown),)
        Sum of the traction over the elements in these directions [Pa].
    """

    def __init__(self, rolling: Newton, w: Array, unknown: list[int], wanted: Array) -> None:
        self.rolling, self.w, self.unknown, self.wanted = rolling, w, unknown, wanted
        #: A row of forces counts like the slip of this traction of every element.
        self._weight = rolling.operator.own / math.sqrt(w[0].size)
        self._columns = np.zeros((len(unknown), *w.shape))
        self._solved = self._columns
        self._inverse: Array = np.zeros((len(unknown), len(unknown)))

    def solve(self, u: Array, q: Array | None = None) -> tuple[Array, Array] | None:
        """Return creepages and traction, from the creepages `u` and a traction, by default 0. None if the iteration fails."""
        rolling, q = self.rolling, np.zeros_like(self.w) if q is None else q
        limit, first = float(rolling.bound.sum()), 0.0
        for _ in range(MAX_NEWTON):
            residual = rolling.linearise(q, rolling.slip(q, self.w + self._spread(u)))
            if residual <= rolling.tolerance and np.abs(self.wanted - self._sums(q)).max() <= rolling.tolerance * limit:
                return u, q
            lost = not math.isfinite(residual) or np.abs(u).max() > _LARGEST
            if lost or not self._border(first):
                return None
            first = first or float(np.abs(np.linalg.det(self._inverse)))
            rest = self._weight * (self.wanted - self._sums(q + rolling.correction))
            rhs = np.concatenate((rolling.right_hand_side().ravel(), rest))
            change, _ = gmres(self._apply, self._precondition, rhs, INEXACT, MAX_KRYLOV)
            field, more = self._parts(change)
            q, u = rolling.moved(q, field), u + more
        return None

    def _spread(self, u: Array) -> Array:
        """Return the rigid slip of the creepages `u`."""
        w = np.zeros_like(self.w)
        w[self.unknown] += u[:, None, None]
        return w

    def _sums(self, q: Array) -> Array:
        return q[self.unknown].sum(axis=(1, 2))

    def _parts(self, v: Array) -> tuple[Array, Array]:
        """Return the traction and the creepages in a vector."""
        n = self.w.size
        return v[:n].reshape(self.w.shape), v[n:]

    def _border(self, first: float) -> bool:
        """Set the columns of the step and what they cost; return False if the force is nearly saturated."""
        for k, direction in enumerate(self.unknown):
            self._columns[k] = 0.0
            self._columns[k, direction] = 1.0
            self.rolling.restricted(self._columns[k])
        self._solved = np.stack([self.rolling.precondition(column) for column in self._columns])
        schur = -self._weight * np.stack([self._sums(field) for field in self._solved], axis=1)
        size = float(np.abs(np.linalg.det(schur)))
        if not size > 0.0 or 0.0 < size * first < _REGULAR:
            return False
        self._inverse = np.asarray(np.linalg.inv(schur))
        return True

    def _apply(self, v: Array) -> Array:
        """Return the product of the bordered matrix with a change of traction and creepages."""
        field, u = self._parts(v)
        moved = self.rolling.apply(field) + np.einsum("k,kcij->cij", u, self._columns)
        return np.concatenate((moved.ravel(), self._weight * self._sums(field)))

    def _precondition(self, v: Array) -> Array:
        """Return an approximate solution of the bordered step."""
        field, rest = self._parts(v)
        change = self.rolling.precondition(field)
        u = self._inverse @ (rest - self._weight * self._sums(change))
        change -= np.einsum("k,kcij->cij", u, self._solved)
        return np.concatenate((change.ravel(), u))


def followed(newton: Newton, q: Array, w: Array) -> tuple[Array, float]:
    """Return traction and residual of a step from the traction `q`, in parts if it does not get there at once."""
    found, residual = newton.solve(q, w)
    if residual > newton.tolerance:
        rest = newton.influence.times(newton.operator.transfer, q)  # w = -rest is where the last traction stays
        found = q
        for part in range(1, _PARTS + 1):
            found, residual = newton.solve(found, -rest + (w + rest) * (part / _PARTS))
    return found, residual


def driven(
    newton: Newton, w: Array, unknown: list[int], wanted: Array, u: Array, q: Array
) -> tuple[Array, Array] | None:
    """Return creepages and traction under given forces; the force is raised in parts if it is not found at once."""
    limit = float(newton.bound.sum())
    if math.sqrt(float(wanted @ wanted)) > limit * (1.0 + 1e-9):
        return None
    for start, traction in ((u, q), (np.zeros(len(unknown)), np.zeros_like(q))):
        found = GivenForces(newton, w, unknown, wanted).solve(start, traction)
        if found is not None:
            return found
    for parts in (_PARTS, _MORE) if len(unknown) == 2 else (_PARTS,):
        found = np.zeros(len(unknown)), q
        first = q[unknown].sum(axis=(1, 2))
        for part in range(1, parts + 1):
            found = GivenForces(newton, w, unknown, first + (wanted - first) * (part / parts)).solve(*found)
            if found is None:
                break
        if found is not None:
            return found
    return _bracketed(newton, w, unknown[0], float(wanted[0]), q) if len(unknown) == 1 else None


def _bracketed(newton: Newton, w: Array, direction: int, wanted: float, q: Array) -> tuple[Array, Array] | None:
    """Return one creepage and the traction under one given force, inside a bracket: the force falls as the creepage grows."""
    limit, traction = float(newton.bound.sum()), q

    def residual(u: float) -> float:
        nonlocal traction
        slip = w.copy()
        slip[direction] += u
        traction, _ = newton.steady(traction, slip) if isinstance(newton, Rolling) else followed(newton, traction, slip)
        return float(traction[direction].sum()) - wanted

    step = max(float(np.abs(w).max()), newton.operator.own * float(newton.bound.max()), 1e-12)
    ends, values = [-step, step], [residual(-step), residual(step)]
    for _ in range(_MOST_ROOT):
        k = 0 if values[0] <= 0.0 else 1
        if values[0] > 0.0 and values[1] < 0.0:
            break
        ends[k] *= 2.0
        values[k] = residual(ends[k])
    else:
        return None
    for turn in range(_MOST_ROOT):
        u = ends[0] + (ends[1] - ends[0]) * (0.5 if turn % 3 == 2 else values[0] / (values[0] - values[1]))
        value = residual(u)
        found = GivenForces(newton, w, [direction], np.array([wanted])).solve(np.array([u]), traction)
        if found is not None and ends[0] <= float(found[0][0]) <= ends[1]:
            return found
        if abs(value) <= newton.tolerance * limit:
            return np.array([u]), traction
        k = 0 if value > 0.0 else 1
        ends[k], values[k] = u, value
    return None
