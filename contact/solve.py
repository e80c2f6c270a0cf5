"""`contact.solve`: validate, call the kernel, wrap the answer."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction
from contact.halfspace import linear
from contact.halfspace.gap import Division, Gap
from contact.halfspace.solve import solve_gap, solve_pressure
from contact.kalker import constant_table
from contact.material import STEEL, Material
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.separation import Separation
from contact.solution import Solution
from contact.solver import N_ELEMENTS, N_STRIPS, Solver, require_conformal, require_resolution, require_trustworthy

Array = NDArray[np.float64]


def solve(
    separation: Separation | Gap,
    creepage: Creepage,
    *,
    load: float | None = None,
    approach: float | None = None,
    friction: float | Friction = 0.3,
    material: Material = STEEL,
    speed: float = 20.0,
    normal: str = DEFAULT_NORMAL,
    tangential: str = DEFAULT_TANGENTIAL,
    n_strips: int = N_STRIPS,
    n_elements: int = N_ELEMENTS,
    spacing: float | tuple[float, float] | None = None,
    conformal: bool = False,
    start: Solution | None = None,
    progress: Callable[[int, float], None] | None = None,
    throw: bool = True,
) -> Solution:
    """Solve the contact of one wheel-rail pair in the plane of its separation.

    Parameters
    ----------
    separation : Separation or contact.halfspace.Gap
        Undeformed gap; on a grid for the element-wise half space alone.
    creepage : Creepage
        Relative rigid motion, wheel minus rail over speed.
    load, approach : float
        Exactly one of them: normal force [N] ≥ 0, or rigid approach [m] measured from g = 0 (negative: apart).
    friction : float or contact.friction.Friction
        Coulomb's coefficient mu ≥ 0 [-], or a surface on which it falls with the sliding velocity.
    material : Material
    speed : float
        Rolling speed [m/s] > 0; sliding velocities and powers scale with it. Forces depend on it only if friction does.
    normal, tangential : str
        Names from `contact.methods()`.
    n_strips, n_elements : int
        Strips per patch, 4 to 1000, and elements per strip, 4 to 1000. With normal="halfspace" rows and columns of elements
        over the undeformed overlap, of which contact takes about 0.7 each way.
    spacing : float or (float, float)
        Size (dx, dy) of the elements of the half space [m], instead of their number.
    conformal : bool
        Let the contact angle vary over the patch by the separation's `tilt` and `rolling` (`contact.kernels.conformal`): slip and the
        directions of pressure and traction follow the surface. Fx, Fy, Mz are then resultants in the frame of the plane, the
        lateral part of the pressure included; fields count along the surface.
    start : Solution
        Solution of a neighbouring problem at the same resolution, from which an iterative normal method may start. It changes
        the time that is taken, and the result within the method's tolerance.
    progress : callable
        Given step and residual of the half space's tangential iteration.
    throw : bool
        Raise when the problem has no trustworthy answer (patch beyond the separation, not converged). With False the
        `status` of the solution says so.

    Returns
    -------
    Solution
        Forces act on the wheel. No contact is an answer: zero forces, ``Status.NO_CONTACT``.

    Raises
    ------
    ContactError
        For input outside its range, and, with `throw`, for the status OUT_OF_RANGE or NOT_CONVERGED.
    """
    if not isinstance(separation, Separation | Gap):
        raise ContactError(f"separation = {separation!r} is not a contact.Separation")
    if not isinstance(creepage, Creepage):
        raise ContactError(f"creepage = {creepage!r} is not a contact.Creepage")
    if (load is None) == (approach is None):
        raise ContactError(f"exactly one of load and approach is needed; load = {load}, approach = {approach}")
    if load is not None:
        require_number("load", load, 0.0)
    else:
        require_number("approach", approach)
    surface = as_friction(friction)
    speed = require_number("speed", speed, 0.0, open_minimum=True)
    n_strips, n_elements = require_resolution(n_strips, n_elements)
    method, rolling = lookup("normal", normal), lookup("tangential", tangential)
    division = Division(n_strips, n_elements, _pair(spacing))
    if rolling.elementwise and (surface.slope, surface.slope_far) != (1.0, 1.0):
        raise ContactError(
            f"friction.slope = {surface.slope:g}: tangential = {tangential!r} knows the half space alone, slope 1"
        )
    if conformal:
        require_conformal(rolling)
        if not isinstance(separation, Separation):
            raise ContactError("conformal: a gap on a grid knows the contact plane alone; allowed: contact.Separation")
    if method.elementwise and material.pressure_limit < math.inf:
        raise ContactError(
            f"material.pressure_limit = {material.pressure_limit:g}: normal = {normal!r} is elastic; allowed: inf"
        )
    if method.elementwise:
        if not rolling.elementwise:
            raise ContactError(f"tangential = {tangential!r} does not serve normal = {normal!r}; allowed: halfspace")
        solution: Solution = solve_gap(
            separation,
            creepage,
            division,
            load=load,
            approach=approach,
            friction=surface,
            material=material,
            speed=speed,
            conformal=conformal,
            progress=progress,
        )
    elif not isinstance(separation, Separation):
        raise ContactError(f"normal = {normal!r} needs a contact.Separation; separation = {separation!r} is on a grid")
    else:
        strips = _Strips(separation, creepage, load, approach, surface, material, speed, method.name)
        stands_in = DEFAULT_TANGENTIAL if rolling.elementwise else rolling.kernel
        solution = strips.solve(stands_in, n_strips, n_elements, start, conformal and not rolling.elementwise)
        if rolling.calibrated and solution.N > 0.0:
            own = _patch_coefficients(strips, solution)
            solution = strips.solve(stands_in, n_strips, n_elements, start, conformal, own)
        if rolling.name != stands_in and not rolling.elementwise:
            solution = replace(solution, tangential=rolling.name)
        if rolling.elementwise:
            solution = solve_pressure(solution, separation if conformal else None, surface, division, progress)
    if throw:
        require_trustworthy(solution, separation.y, load, approach)
    return solution


def _pair(spacing: object) -> tuple[float, float] | None:
    """(dx, dy) of the elements, or None."""
    if spacing is None:
        return None
    both = spacing if isinstance(spacing, tuple | list) else (spacing, spacing)
    if len(both) != 2:
        raise ContactError(f"spacing = {spacing!r} is not a number or a pair of numbers")
    dx, dy = (require_number("spacing", value, 0.0, open_minimum=True) for value in both)
    return dx, dy


class _Strips(NamedTuple):
    """One problem, to be solved on strips by different methods and resolutions."""

    separation: Separation
    creepage: Creepage
    load: float | None
    approach: float | None
    friction: Friction
    material: Material
    speed: float
    normal: str

    def solve(
        self,
        tangential: str,
        n_strips: int,
        n_elements: int,
        start: Solution | None = None,
        conformal: bool = False,
        coefficients: tuple[float, float, float] | None = None,
    ) -> Solution:
        """Solve it, with the patch's own C11, C22, C23 if given."""
        solver = Solver(
            normal=self.normal,
            tangential=tangential,
            n_strips=n_strips,
            n_elements=n_elements,
            friction=self.friction,
            material=self.material,
            speed=self.speed,
            conformal=conformal,
            n_samples=self.separation.y.size,
        )
        if coefficients is not None:
            solver.calibrate(constant_table(*coefficients))
        if start is not None:
            solver.start_from(start)
        return solver.solve(
            self.separation,
            self.creepage,
            load=self.load,
            approach=self.approach,
            warm=start is not None,
            throw=False,
        )


def _patch_coefficients(strips: _Strips, solution: Solution) -> tuple[float, float, float]:
    """C11, C22, C23 of linear theory on the patch of a `solution`, solved again as coarsely as that theory."""

    def at(n: int) -> Array:
        return linear.flexibilities(strips.solve(DEFAULT_TANGENTIAL, n, n).strips, solution.material, n)

    return linear.coefficients(linear.extrapolated(at), solution.strips, solution.material)
