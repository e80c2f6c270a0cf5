"""`contact.solve`: validate, call the kernel, wrap the answer."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from contact import kalker, workspace
from contact._layout import (
    APPROACH,
    CASE_G,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_NORMAL,
    CASE_NU,
    CASE_PHI,
    CASE_PRESSURE_LIMIT,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    FIELD_DX,
    FIELD_P,
    FIELD_QX,
    FIELD_QY,
    FIELD_STICK,
    FIELD_SX,
    FIELD_SY,
    FIELD_X,
    LOAD,
    N_CASE,
    RES_APPROACH,
    RES_AREA,
    RES_EDGES,
    RES_FX,
    RES_FY,
    RES_ITERATIONS,
    RES_LENGTH,
    RES_MZ,
    RES_N,
    RES_PATCHES,
    RES_PMAX,
    RES_POWER,
    RES_PRESSURE_Y,
    RES_SLIP_AREA,
    RES_STATUS,
    RES_STIFFNESS,
    RES_WIDTH,
    STRIP_A,
    STRIP_ASPECT,
    STRIP_DY,
    STRIP_P0,
    STRIP_PATCH,
    STRIP_XC,
    STRIP_Y,
)
from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction, fill, of_case
from contact.halfspace import linear
from contact.halfspace.gap import Division, Gap
from contact.halfspace.solve import solve_gap, solve_pressure
from contact.material import STEEL, Material
from contact.pipeline import solve_case, solve_conformal
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, Method, lookup
from contact.separation import Separation
from contact.solution import Solution, Status, Strips

Array = NDArray[np.float64]

#: Resolution at which forces are within 0.002 mu N of their limit.
N_STRIPS, N_ELEMENTS = 30, 30


def require_resolution(n_strips: object, n_elements: object) -> tuple[int, int]:
    """Return both as integers in [4, 1000], or raise a ContactError."""
    for name, number in (("n_strips", n_strips), ("n_elements", n_elements)):
        if not isinstance(number, int | np.integer) or not 4 <= number <= 1000:
            raise ContactError(f"{name} = {number!r} is not an integer in the allowed range [4, 1000]")
    return int(n_strips), int(n_elements)  # type: ignore[call-overload]


def require_conformal(tangential: Method) -> None:
    """Raise a ContactError for a tangential method that knows the contact plane alone."""
    if not tangential.fields:
        raise ContactError(f"conformal: tangential = {tangential.name!r} knows the contact plane alone")


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
        Let the contact angle vary over the patch by the separation's `tilt` and `rolling` (`contact.conformal`): slip and the
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
        kind, amount = LOAD, require_number("load", load, 0.0)
    else:
        kind, amount = APPROACH, require_number("approach", approach)
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
        on_strips = partial(_on_strips, separation, creepage, (kind, amount), surface, material, speed, method)
        solution = on_strips(rolling, n_strips, n_elements, start, conformal and not rolling.elementwise)
        if rolling.calibrated and solution.N > 0.0:
            own = _patch_coefficients(on_strips, solution)
            solution = on_strips(rolling, n_strips, n_elements, start, conformal, own)
        if rolling.elementwise:
            solution = solve_pressure(solution, separation if conformal else None, surface, division, progress)
    if throw and solution.status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED):
        what = "load" if load is not None else "approach"
        raise ContactError(
            f"{what} = {amount:g}: {solution.status.message}; y = [{separation.y[0]:g}, {separation.y[-1]:g}] m "
            f"(throw=False returns the solution with this status)"
        )
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


def _patch_coefficients(on_strips: Callable[..., Solution], solution: Solution) -> tuple[float, float, float]:
    """C11, C22, C23 of linear theory on the patch of a `solution`, solved again by `on_strips` as coarsely as that theory."""
    anyhow, material = lookup("tangential", DEFAULT_TANGENTIAL), solution.material

    def at(n: int) -> Array:
        return linear.flexibilities(on_strips(anyhow, n, n).strips, material, n)

    return linear.coefficients(linear.extrapolated(at), solution.strips, material)


def _on_strips(
    separation: Separation,
    creepage: Creepage,
    amount: tuple[float, float],
    surface: Friction,
    material: Material,
    speed: float,
    method: Method,
    rolling: Method,
    n_strips: int,
    n_elements: int,
    start: Solution | None = None,
    conformal: bool = False,
    coefficients: tuple[float, float, float] | None = None,
) -> Solution:
    """Call the kernel, with the patch's own C11, C22, C23 if given; the default method stands in for the half space."""
    stands_in = lookup("tangential", DEFAULT_TANGENTIAL) if rolling.elementwise else rolling
    case = np.zeros(N_CASE)
    case[CASE_LOAD_KIND], case[CASE_LOAD] = amount
    case[CASE_VX], case[CASE_VY], case[CASE_PHI] = creepage.longitudinal, creepage.lateral, creepage.spin
    case[CASE_G], case[CASE_NU] = material.shear_modulus, material.poisson_ratio
    case[CASE_PRESSURE_LIMIT] = material.pressure_limit
    case[CASE_NORMAL], case[CASE_TANGENTIAL] = method.id, stands_in.id
    fill(case, surface, speed)
    own = workspace.allocate(method, stands_in, material.poisson_ratio, n_strips, n_elements, separation.y.size)
    if coefficients is not None:
        own = own._replace(tables=own.tables._replace(kalker=kalker.constant_table(*coefficients)))
    if start is not None and start.memory.size == own.space.memory.size:
        own.space.memory[:] = start.memory
    s = separation
    if conformal:
        n = solve_conformal(s.y, s.g, s.A, s.x_c, s.tilt, s.rolling, case, *own)
    else:
        n = solve_case(s.y, s.g, s.A, s.x_c, case, *own)
    result = own.result
    status = Status(int(result[RES_STATUS]))
    strips, fields = own.strips[:, :n], own.fields[:, :n]
    return Solution(
        Fx=float(result[RES_FX]),
        Fy=float(result[RES_FY]),
        Mz=float(result[RES_MZ]),
        N=float(result[RES_N]),
        approach=float(result[RES_APPROACH]),
        max_pressure=float(result[RES_PMAX]),
        area=float(result[RES_AREA]),
        slip_area=float(result[RES_SLIP_AREA]),
        power_per_metre=float(result[RES_POWER]),
        normal_stiffness=float(result[RES_STIFFNESS]),
        length=float(result[RES_LENGTH]),
        width=float(result[RES_WIDTH]),
        n_patches=int(result[RES_PATCHES]),
        iterations=int(result[RES_ITERATIONS]),
        status=status,
        strips=Strips(
            y=strips[STRIP_Y],
            dy=strips[STRIP_DY],
            x_c=strips[STRIP_XC],
            a=strips[STRIP_A],
            p0=strips[STRIP_P0],
            aspect=strips[STRIP_ASPECT],
            patch=strips[STRIP_PATCH].astype(np.int64),
        ),
        x=fields[FIELD_X],
        y=np.repeat(strips[STRIP_Y][:, None], fields.shape[2], axis=1),
        p=fields[FIELD_P],
        qx=fields[FIELD_QX],
        qy=fields[FIELD_QY],
        sx=fields[FIELD_SX],
        sy=fields[FIELD_SY],
        stick=fields[FIELD_STICK] > 0.5,
        dA=fields[FIELD_DX] * strips[STRIP_DY][:, None],
        creepage=creepage,
        friction=float(of_case(case)),
        material=material,
        speed=speed,
        normal=method.name,
        tangential=rolling.name,
        pressure_y=float(result[RES_PRESSURE_Y]),
        patch_edges=result[RES_EDGES : RES_EDGES + 2 * int(result[RES_PATCHES])].reshape(-1, 2).copy(),
        memory=own.space.memory,
    )
