"""`contact.solve`: validate, call the kernel, wrap the answer."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_flag, require_kind, require_number, require_pair
from contact.friction import Friction, as_friction
from contact.given_force import solve_for_force, wanted_force
from contact.halfspace import linear
from contact.halfspace.bent import Surface
from contact.halfspace.derivatives import derive
from contact.halfspace.gap import Division, Gap
from contact.halfspace.pressed import Pressed
from contact.halfspace.solution import GridSolution
from contact.halfspace.solve import press_gap, press_solution
from contact.halfspace.third_body import ThirdBody
from contact.inputs.creepage import Creepage, as_creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import ITERATIONS, N_ELEMENTS, N_STRIPS
from contact.inputs.plausibility import doubt_case
from contact.inputs.separation import Separation
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, Method, lookup
from contact.results import Solution, doubt_answer
from contact.solver import (
    Solver,
    require_amount,
    require_resolution,
    require_separation,
    require_trustworthy,
)
from contact.theory.kalker import constant_table
from contact.view.trace import show, show_step

#: Default number of rows and of columns of the half space's elements.
_N_OF_HALF_SPACE = 60


def solve(
    separation: Separation | Gap,
    creepage: Creepage | tuple[float, float, float],
    *,
    load: float | None = None,
    approach: float | None = None,
    force: float | tuple[float | None, float | None] | None = None,
    friction: float | Friction = 0.3,
    material: Material = STEEL,
    speed: float = 20.0,
    normal: str = DEFAULT_NORMAL,
    tangential: str = DEFAULT_TANGENTIAL,
    n_strips: int | None = None,
    n_elements: int | None = None,
    spacing: float | tuple[float, float] | None = None,
    conformal: bool = False,
    max_iterations: int = ITERATIONS.usual,
    layer: ThirdBody | None = None,
    start: Solution | None = None,
    progress: Callable[[int, float], None] | None = None,
    trace: bool = False,
    derivatives: bool = False,
    throw: bool = True,
) -> Solution:
    """Solve the contact of one wheel-rail pair in the plane of its separation.

    Parameters
    ----------
    separation : Separation or contact.halfspace.Gap
        Undeformed gap. A `Gap` on a grid is only for the element-wise half space.
    creepage : Creepage or (longitudinal, lateral, spin)
        Rigid velocity of the wheel relative to the rail, over the speed [-], [-], [1/m].
    load, approach : float
        Normal force [N] ≥ 0, or rigid approach [m] measured from g = 0 (negative: apart). Give exactly one of them.
    force : float or (float or None, float or None)
        Tangential force Fx, or (Fx, Fy), on the wheel [N], instead of the creepages in its direction. These are found; those
        of `creepage` are the start. The spin is given, and so is a creepage whose force is None. `Solution.creepage` is the
        answer. If no creepage up to 1 makes the force, the status is UNREACHABLE, and the forces are those of the largest
        creepage that was tried.
    friction : float or contact.friction.Friction
        Coulomb's coefficient mu ≥ 0 [-], or a friction law.
    material : Material
    speed : float
        Rolling speed [m/s] ≥ 0. Sliding velocities and powers scale with it. Forces depend on it only if the friction does.
    normal, tangential : str
        Names from `contact.methods()`.
    n_strips, n_elements : int
        Strips per patch, 4 to 1000, and elements per strip, 4 to 1000; default 20 each. With normal="halfspace" they are
        rows and columns of elements over the undeformed overlap; the contact takes about 0.7 of it in each direction. Their
        default is then 60: on four patches of S1002 on 60E1 the force is .0023 of μN at most off that with 160, and the
        pressure .4 %, where 20 give .014 and 3.4 %, and methods on strips .008 and .8 %.
    spacing : float or (float, float)
        Size (dx, dy) of the half space's elements [m], instead of their number.
    conformal : bool
        Let the contact angle vary over the patch by the separation's `tilt` and `rolling` (`contact.kernels.conformal`).
        Slip, pressure and traction then follow the curved surface. Fx, Fy, Mz are resultants in the frame of the plane
        and include the lateral part of the pressure. Fields are measured along the surface. With normal="halfspace" the
        influence numbers are those of the bent surface (`contact.halfspace.curved`), and N contains the part of the
        traction along the plane's normal.
    max_iterations : int
        Most iterations of the strip half space, 1 to 1000. What is not at rest then is iterated as often once more if they
        are 60 or more, with the ends of the patches free again. After that the status is NOT_CONVERGED.
    layer : contact.ThirdBody
        A layer between the bodies that shears and yields; only with tangential="halfspace".
    start : Solution
        Solution of a similar problem at the same resolution. An iterative normal method may start from it. This changes
        the computing time, and the result only within the method's tolerance.
    progress : callable
        Called with step and residual of the half space's tangential iteration.
    trace : bool
        Print the iterations: of interacting strips the table of `Solver.trace`, of the half space step and residual of its
        tangential iteration. It is printed before an exception is raised.
    derivatives : bool
        Also find `Solution.jacobian`, the derivatives of forces and load or approach by creepages, load or approach, and
        friction. It works for the methods of ``contact.methods().batched`` and for normal="halfspace", there with like
        materials, a plane, no layer and friction that does not depend on local slip; not with `force`.
    throw : bool
        Raise an exception if the solution cannot be trusted (patch beyond the separation, not converged). If False, only
        the `status` of the solution tells.

    Returns
    -------
    Solution
        Forces act on the wheel. Without contact all forces are zero and the status is ``Status.NO_CONTACT``.

    Raises
    ------
    ContactError
        For input outside its range. With `throw`, also for the status OUT_OF_RANGE or NOT_CONVERGED.

    Warns
    -----
    PlausibilityWarning
        For a load, approach, creepage, friction or speed that no wheel has, as from a wrong unit (`inputs.plausibility`).

    Examples
    --------
    The patch of a new wheel on a new rail, as two curvatures, under 80 kN with a braking creepage:

    >>> import contact
    >>> gap = contact.Separation.hertzian(1.1, 0.8)
    >>> solution = contact.solve(gap, contact.Creepage(1e-3), load=80e3)
    >>> round(solution.Fx), round(solution.max_pressure / 1e6), solution.status
    (-11846, 893, <Status.OK: 1>)
    """
    require_kind("material", material, Material)
    conformal = require_flag("conformal", conformal)
    method, rolling = lookup("normal", normal), lookup("tangential", tangential)
    usual = (_N_OF_HALF_SPACE,) * 2 if method.elementwise else (N_STRIPS.usual, N_ELEMENTS.usual)
    size = require_resolution(
        *(default if given is None else given for given, default in zip((n_strips, n_elements), usual, strict=True))
    )
    max_iterations = ITERATIONS.require("max_iterations", max_iterations)
    division = Division(*size, None if spacing is None else require_pair("spacing", spacing))
    if layer is not None:
        require_layer(layer, rolling)
    if method.elementwise and not rolling.elementwise:
        raise ContactError(f"tangential = {tangential!r} does not work with normal = {normal!r}; allowed: halfspace")
    if derivatives and (force is not None or rolling.calibrated or (rolling.elementwise and not method.elementwise)):
        what = "force" if force is not None else f"normal = {normal!r} and tangential = {tangential!r}"
        raise ContactError(f"derivatives = True does not work with {what}")
    on_strips = partial(
        _on_strips, separation, load=load, approach=approach, friction=friction, material=material, speed=speed,
        normal=method.name, size=size, conformal=conformal, max_iterations=max_iterations, start=start, trace=trace,
    )  # fmt: skip
    if not rolling.elementwise:
        coefficients = _patch_coefficients(on_strips, creepage, rolling, material) if rolling.calibrated else None
        solution = on_strips(
            creepage,
            rolling.kernel,
            coefficients=coefficients,
            force=force,
            derivatives=derivatives,
            doubted=rolling.calibrated,
            throw=throw,
        )
        return replace(solution, tangential=rolling.name) if rolling.calibrated else solution  # which stays lazy

    require_separation(separation, Separation | Gap)
    creepage, _ = as_creepage(creepage), require_amount(load, approach)
    wanted = None if force is None else wanted_force(force)
    surface = as_friction(friction)
    if (surface.slope, surface.slope_far) != (1.0, 1.0):
        raise ContactError(
            f"friction.slope = {surface.slope:g}: tangential = {tangential!r} is the half space itself; allowed: slope 1"
        )
    if layer is not None and ((surface.velocity != "global" and surface.law != "coulomb") or surface.hot_factor < 1.0):
        raise ContactError("layer: friction must not depend on local slip or temperature")
    if conformal and isinstance(separation, Gap):
        raise ContactError("conformal: a gap on a grid has only the contact plane; allowed: contact.Separation")
    if method.elementwise and material.pressure_limit < math.inf:
        raise ContactError(
            f"material.pressure_limit = {material.pressure_limit:g}: normal = {normal!r} is elastic; allowed: inf"
        )
    if trace and progress is None:
        progress = show_step
    solver: Callable[[Creepage], Solution] | Pressed
    speed = require_number("speed", speed, 0.0)
    made = partial(Pressed, material=material, friction=surface, speed=speed, progress=progress, layer=layer, load=load)
    if method.elementwise:
        vector = creepage.longitudinal, creepage.lateral, creepage.spin
        doubt_case(load, approach, vector, surface.static, speed)
        if isinstance(separation, Separation):
            doubt_answer(separation.told, fit_error=separation.fit_error)
        solver = press_gap(
            made, separation, division, load=load, approach=approach, material=material, conformal=conformal
        )
    else:
        first = on_strips(creepage, conformal=False)
        bent = Surface.of(separation) if conformal and isinstance(separation, Separation) else None
        if first.N > 0.0:
            solver = press_solution(made, first, bent, division)
        else:
            solver = lambda given: replace(first, tangential="halfspace", creepage=given)  # noqa: E731
    evaluate = solver.roll if isinstance(solver, Pressed) else solver
    if wanted is None:
        solution = evaluate(creepage)
        if derivatives and isinstance(solver, Pressed) and isinstance(solution, GridSolution):
            solution = replace(solution, jacobian=derive(solver, solution))
    else:
        near = solver.creepage_for(wanted, creepage) if isinstance(solver, Pressed) else creepage
        solution = solve_for_force(wanted, near, evaluate, rolling.saturates)
    if throw:
        require_trustworthy(solution.status, separation.y, load, approach)
    return solution


def require_layer(layer: object, tangential: Method) -> None:
    """Raise a ContactError if a third body cannot be used with this method."""
    if not isinstance(layer, ThirdBody):
        raise ContactError(f"layer = {layer!r} is not a contact.ThirdBody")
    if not tangential.elementwise:
        raise ContactError(f"layer: tangential = {tangential.name!r} has no third body; allowed: halfspace")


class _Latest(threading.local):
    """The solvers that a thread has used last, by their options and C11, C22, C23."""

    def __init__(self) -> None:
        self.solvers: dict[tuple[object, ...], Solver] = {}


#: How many of them are kept.
_LATEST, _MOST = _Latest(), 4


def _on_strips(
    separation: Any,
    creepage: Any,
    tangential: str = DEFAULT_TANGENTIAL,
    *,
    normal: str,
    size: tuple[int, int],
    material: Material,
    conformal: bool,
    max_iterations: int,
    coefficients: tuple[float, float, float] | None = None,
    start: Solution | None,
    trace: bool,
    doubted: bool = False,
    throw: bool = False,
    **given: Any,
) -> Solution:
    """Return the solution of a `Solver`. `coefficients` are C11, C22, C23 to use instead of those of linear theory.

    The solver checks what else is `given`, the arguments of its method `solve`. It is not the user's, so each call is judged,
    unless it was `doubted` before.
    """
    if not isinstance(separation, Separation) and isinstance(separation, Gap):
        raise ContactError(f"normal = {normal!r} needs a contact.Separation; separation = {separation!r} is on a grid")
    options: dict[str, Any] = {
        "normal": normal,
        "tangential": tangential,
        "n_strips": size[0],
        "n_elements": size[1],
        "material": material,
        "conformal": conformal,
        "max_iterations": max_iterations,
    }
    solvers, key = _LATEST.solvers, (*options.values(), coefficients)
    solver = solvers.pop(key, None)  # until it is back, a signal handler that calls `solve` makes another one
    if solver is None:
        solver = Solver(**options)
        if coefficients is not None:
            solver.calibrate(constant_table(*coefficients))
    solver.told = getattr(separation, "told", set())  # the separation is the user's
    solver.doubted = None if doubted else set()
    try:
        if start is not None:
            solver.start_from(start)
        return solver.solve(separation, creepage, warm=start is not None, throw=throw, **given)
    finally:
        if trace:
            show(solver.trace())
        solvers[key] = solver
        while len(solvers) > _MOST:
            del solvers[next(iter(solvers))]


def _patch_coefficients(
    on_strips: Callable[..., Solution], creepage: object, method: Method, material: Material
) -> tuple[float, float, float] | None:
    """Return C11, C22, C23 of linear theory on the patch; None without contact.

    Linear theory is solved on coarse patches with n strips and extrapolated to n → ∞.
    """
    first = on_strips(creepage, method.kernel)
    if first.N <= 0.0:
        return None

    def at(n: int) -> Array:
        coarse = on_strips(creepage, size=(n, n), start=None, conformal=False, doubted=True)
        return linear.flexibilities(coarse.strips, material, n)

    try:
        return linear.coefficients(linear.extrapolated(at), first.strips, material)
    except np.linalg.LinAlgError:
        raise ContactError(
            f"tangential = {method.name!r}: the {first.n_patches} patches of normal = {first.normal!r} lie over each other, so "
            "there is no linear theory of them; take another normal method"
        ) from None
