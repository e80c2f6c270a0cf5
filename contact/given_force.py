"""The creepages of a given force (`contact.kernels.given_force`), the depth under a load, and the root of a rising function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from contact.errors import ContactError, require_number
from contact.inputs.creepage import Creepage
from contact.kernels.geometry.settle import DEEPEST
from contact.kernels.given_force import LATERAL, LONGITUDINAL, begin, go_on
from contact.kernels.root import advance
from contact.kernels.root import begin as begin_root
from contact.kernels.searches import FORCE_SEARCH, ROOT
from contact.results import Solution, Status

#: Search of a depth: most forces, and a bracket [m] below which the force jumps.
_MOST, _SHORTEST = 40, 1e-12

#: Longitudinal and lateral force [N]; None where the creepage is given.
Force = tuple[float | None, float | None]


def wanted_force(force: object) -> Force:
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


def as_numbers(force: Force) -> tuple[int, float, float]:
    """Return a force as the kernel takes it: which members are given, and both [N]."""
    given = sum(bit for bit, value in zip((LONGITUDINAL, LATERAL), force, strict=True) if value is not None)
    return given, force[0] or 0.0, force[1] or 0.0


def solve_for_force(force: Force, start: Creepage, evaluate: Callable[[Creepage], Solution], bounded: bool) -> Solution:
    """Return the solution with the given forces [N]; its `creepage` is the answer.

    It is for solutions that Python finds, those of the half space. If no creepage up to 1 gives the forces, the status is
    UNREACHABLE. Forces are always those of the returned creepage.

    Parameters
    ----------
    force : (Fx, Fy)
        None where the creepage of `start` is kept.
    start : Creepage
        Where the search starts. The spin is kept.
    evaluate : callable
        Returns the solution for a creepage.
    bounded : bool
        The method's force never exceeds friction times load.
    """
    solution = evaluate(start)
    if solution.N <= 0.0:
        return solution
    limit, stiffness = solution.friction * solution.N, solution.material.shear_modulus * solution.area
    search = np.zeros(1, FORCE_SEARCH)[0]
    begin(search, *as_numbers(force), start.longitudinal, start.lateral, limit, stiffness, bounded)
    while go_on(search, solution.Fx, solution.Fy):
        solution = evaluate(replace(start, longitudinal=float(search.vx), lateral=float(search.vy)))
    return solution.with_status(Status(search.status)) if search.status else solution


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
    begin_root(root, start, slope, *ends)
    while advance(root, float(residual(float(root.x))), shortest, most):
        pass
    return Root(float(root.x), float(root.value), bool(root.beyond))


def depth_under(
    force: Callable[[float], float], load: float, start: float | None, tolerance: float
) -> tuple[float, float] | None:
    """Return the relative error of a load [N] > 0 and the depth below first touch that carries it best [m]; None if none does.

    F^(2/3) is nearly linear in the depth (Hertz). Where the force jumps, the depth is the best of those that were tried.
    `force` returns the force at a depth; the search begins at `start`, and ends at an error of `tolerance`.
    """
    target, tried = load ** (2.0 / 3.0), []

    def residual(depth: float) -> float:
        found = force(depth)
        tried.append((abs(found - load), depth))
        return 0.0 if tried[-1][0] <= tolerance * load else max(found, 0.0) ** (2.0 / 3.0) - target

    first = min(start or 1e-4 * (load / 1e5) ** (2.0 / 3.0), 0.5 * DEEPEST)
    if rising_root(residual, first, target / first, (0.0, DEEPEST), shortest=_SHORTEST, most=_MOST).beyond:
        return None
    missed, depth = min(tried)
    return missed / load, depth
