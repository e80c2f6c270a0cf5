"""The creepages that answer a given tangential force, for every tangential method.

The force falls with the creepage (B of TANG is positive definite), towards friction times load. The unknowns are found by
Broyden's iteration. It does not compare forces f = F/(mu N) but the creepages that Vermeulen and Johnson's law assigns to
them on a circle, proportional to 1 - (1 - f)^⅓. In these the problem is nearly linear up to saturation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.kernels.records import ROOT
from contact.kernels.root import advance, begin
from contact.solution import Solution, Status

Array = NDArray[np.float64]
Evaluate = Callable[[Creepage], Solution]

#: Forces must agree to this share of friction times load. A larger error, up to `_LEFT`, is accepted if the force jumps.
_TOLERANCE, _LEFT = 2e-6, 1e-4
#: Largest creepage [-]: the wheel slides as fast as it rolls. A force that needs more is unreachable.
LARGEST = 1.0
#: Limits: solutions, halvings of a step, and growth of a creepage in one step.
_MAX_SOLUTIONS, _MAX_HALVINGS, _GROWTH = 60, 8, 4.0
#: Kalker's C11 of a circle, roughly; it only scales the first step.
_C11 = 4.0
_NAMES = "longitudinal", "lateral"


def wanted_force(force: object) -> tuple[float | None, float | None]:
    """Return the given longitudinal and lateral force [N]; None where the creepage is given.

    Raises
    ------
    ContactError
        If `force` is not a number or a pair of numbers, or gives no force.
    """
    both = tuple(force) if isinstance(force, tuple | list) else (force, None)
    if len(both) != 2 or both == (None, None):
        raise ContactError(f"force = {force!r} is not a number or a pair of numbers, one of which may be None")
    Fx, Fy = (None if value is None else require_number("force", value) for value in both)
    return Fx, Fy


def solve_for_force(
    force: tuple[float | None, float | None], start: Creepage, evaluate: Evaluate, bounded: bool
) -> Solution:
    """Return the solution with the given forces [N]; its `creepage` is the answer.

    If no creepage up to `LARGEST` gives them, the status is UNREACHABLE. Forces are always those of the returned creepage.

    Parameters
    ----------
    force : (Fx, Fy)
        None where the creepage of `start` is kept.
    start : Creepage
        Where the iteration starts. The spin is kept.
    evaluate : callable
        Returns the solution for a creepage.
    bounded : bool
        The method's force never exceeds friction times load.
    """
    first = evaluate(start)
    limit = first.friction * first.N
    if first.N <= 0.0:
        return first
    search = _Search(force, start, evaluate, first, limit if bounded else math.inf)
    if limit <= 0.0 or size(search.wanted) > search.bound * (1.0 + _TOLERANCE):
        return first if search.error(first) == 0.0 else search.beyond()
    return search.in_bracket() if search.wanted.size == 1 else search.broyden()


def size(vector: NDArray[Any]) -> float:
    """Return the Euclidean norm."""
    return math.sqrt(float(vector @ vector))


class _Search:
    """One search, with the forces and creepages of the unknown components as vectors."""

    def __init__(
        self,
        force: tuple[float | None, float | None],
        start: Creepage,
        evaluate: Evaluate,
        first: Solution,
        bound: float,
    ) -> None:
        self.unknown = [k for k in (0, 1) if force[k] is not None]
        self.wanted = np.array([f for f in force if f is not None])
        self.start, self.evaluate, self.first, self.bound = start, evaluate, first, bound
        self.limit = first.friction * first.N
        #: Force per creepage at small creepage, roughly [N]
        self.slope = first.material.shear_modulus * first.area / math.pi * _C11
        self.solutions = 1

    def creepage(self, u: Array) -> Creepage:
        return replace(self.start, **{_NAMES[k]: float(v) for k, v in zip(self.unknown, u, strict=True)})

    def force(self, solution: Solution) -> Array:
        return np.array([(solution.Fx, solution.Fy)[k] for k in self.unknown])

    def error(self, solution: Solution) -> float:
        """Return the error of the force over friction times load."""
        away = size(self.force(solution) - self.wanted)
        return away / self.limit if self.limit > 0.0 else away

    def straight(self, force: Array) -> Array:
        """Return the creepage over 3 mu N/slope that gives the force by Vermeulen and Johnson's law."""
        f = size(force) / self.limit
        if self.bound == math.inf or f <= 0.0:
            return -force / (3.0 * self.limit)
        return -force / (f * self.limit) * (1.0 - (1.0 - min(f, 1.0 - 1e-12)) ** (1.0 / 3.0))

    def at(self, u: Array) -> tuple[Solution, Array]:
        """Return the solution at the creepages `u` and its residual."""
        self.solutions += 1
        solution = self.evaluate(self.creepage(u))
        return solution, self.straight(self.force(solution)) - self.straight(self.wanted)

    def beyond(self) -> Solution:
        """Return the solution at the largest creepage, in the direction of the force."""
        direction = -self.wanted / size(self.wanted)
        return self.evaluate(self.creepage(LARGEST * direction)).with_status(Status.UNREACHABLE)

    def in_bracket(self) -> Solution:
        """Return the solution for one unknown."""
        best, unit = self.first, 3.0 * self.limit / self.slope
        start = float(getattr(self.start, _NAMES[self.unknown[0]]))

        def residual(u: float) -> float:
            nonlocal best
            if u != start:
                best, _ = self.at(np.array([u]))
            if self.error(best) <= _TOLERANCE:
                return 0.0
            return float((self.straight(self.force(best)) - self.straight(self.wanted))[0])

        root = rising_root(residual, start, 1.0 / unit, (-LARGEST, LARGEST), shortest=1e-9 * unit, most=_MAX_SOLUTIONS)
        if self.error(best) <= _LEFT:
            return best
        return best.with_status(Status.UNREACHABLE if root.beyond else Status.NOT_CONVERGED)

    def broyden(self) -> Solution:
        """Return the solution for two unknowns."""
        u = np.array([getattr(self.start, _NAMES[k]) for k in self.unknown])
        best, residual = self.first, self.straight(self.force(self.first)) - self.straight(self.wanted)
        unit = 3.0 * self.limit / self.slope
        jacobian = np.eye(u.size) / unit
        fresh = True
        while self.error(best) > _TOLERANCE and self.solutions < _MAX_SOLUTIONS:
            step = np.linalg.lstsq(jacobian, -residual, rcond=1e-9)[0]
            step *= min(1.0, _GROWTH * max(size(u), 0.5 * unit) / max(size(step), 1e-300))
            for _ in range(_MAX_HALVINGS):
                ahead = u + step
                ahead *= min(1.0, LARGEST / max(size(ahead), 1e-300))
                solution, other = self.at(ahead)
                moved = ahead - u
                if size(moved) > 0.0:
                    jacobian += np.outer(other - residual - jacobian @ moved, moved) / (moved @ moved)
                if size(other) < size(residual):
                    break
                step *= 0.5
            else:
                if fresh:
                    break
                jacobian, fresh = self.differences(u, residual, unit), True
                continue
            u, best, residual, fresh = ahead, solution, other, False
        if self.error(best) <= _LEFT:
            return best
        reached = size(u) >= 0.99 * LARGEST or np.linalg.cond(jacobian) > 1e6
        return best.with_status(Status.UNREACHABLE if reached else Status.NOT_CONVERGED)

    def differences(self, u: Array, residual: Array, unit: float) -> Array:
        """Return the Jacobian by differences."""
        columns = []
        for k in range(u.size):
            moved = u.copy()
            moved[k] += 1e-4 * max(unit, size(u))
            columns.append((self.at(moved)[1] - residual) / (moved[k] - u[k]))
        return np.stack(columns, axis=1)


class Root(NamedTuple):
    """The last point `x` and the `residual` there. `beyond`: the residual does not change its sign up to that end."""

    x: float
    residual: float
    beyond: bool


def rising_root(
    residual: Callable[[float], float],
    start: float,
    slope: float,
    ends: tuple[float, float],
    *,
    shortest: float,
    most: int = 60,
) -> Root:
    """Return the root by secants that are kept inside a bracket.

    Parameters
    ----------
    residual : callable
        A rising function; it returns 0.0 where it is small enough.
    start, slope : float
        Where the search starts, and the slope expected there, positive.
    ends : (float, float)
        Ends of the range; they are evaluated only if the search gets there.
    shortest : float
        A bracket shorter than this ends the search: the function jumps.
    most : int
        Largest number of evaluations.
    """
    root = np.zeros(1, ROOT)[0]
    begin(root, start, slope, *ends)
    while advance(root, float(residual(float(root.x))), shortest, most):
        pass
    return Root(float(root.x), float(root.value), bool(root.beyond))
