"""`contact.forces`: the solver over arrays of cases."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact import workspace
from contact._layout import (
    APPROACH,
    CASE_CONFORMAL,
    CASE_G,
    CASE_LOAD,
    CASE_LOAD_KIND,
    CASE_MU,
    CASE_NORMAL,
    CASE_NU,
    CASE_PHI,
    CASE_PRESSURE_LIMIT,
    CASE_TANGENTIAL,
    CASE_VX,
    CASE_VY,
    LOAD,
    N_CASE,
    N_RES,
    RES_APPROACH,
    RES_AREA,
    RES_FX,
    RES_FY,
    RES_MZ,
    RES_N,
    RES_PMAX,
    RES_POWER,
    RES_SLIP_AREA,
    RES_STATUS,
)
from contact.creepage import LARGEST_CREEPAGE, Creepage
from contact.errors import ContactError
from contact.friction import LARGEST, Friction, fill
from contact.material import STEEL, Material
from contact.pipeline import solve_cases
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.separation import Separation
from contact.solve import N_ELEMENTS, N_STRIPS, require_conformal, require_resolution

Array = NDArray[np.float64]
_CHUNK = 256


@dataclass(frozen=True, slots=True)
class Forces:
    """Results of many cases; every array has the broadcast shape of the input. Units and signs as in `Solution`."""

    Fx: Array
    Fy: Array
    Mz: Array
    N: Array
    approach: Array
    max_pressure: Array
    area: Array
    slip_ratio: Array
    power_per_metre: Array
    status: NDArray[np.int64]


def forces(
    separation: Separation | Sequence[Separation],
    creepage: Creepage | tuple[ArrayLike, ArrayLike, ArrayLike],
    *,
    load: ArrayLike | None = None,
    approach: ArrayLike | None = None,
    friction: ArrayLike | Friction = 0.3,
    speed: ArrayLike = 20.0,
    material: Material = STEEL,
    normal: str = DEFAULT_NORMAL,
    tangential: str = DEFAULT_TANGENTIAL,
    n_strips: int = N_STRIPS,
    n_elements: int = N_ELEMENTS,
    conformal: bool = False,
    threads: int | None = None,
) -> Forces:
    """Solve arrays of cases without a Python loop; the same kernel as `contact.solve`, fields left out.

    Parameters
    ----------
    separation : Separation or sequence of Separation
        A sequence of length n broadcasts like an array of shape (n,).
    creepage : Creepage or (longitudinal, lateral, spin)
        Arrays [-], [-], [1/m], broadcast against all other input.
    load, approach : array_like
        Exactly one of them: normal force [N] or rigid approach [m].
    friction : array_like or contact.friction.Friction
    speed : array_like
        Rolling speed [m/s] > 0; forces depend on it only if friction does.
    material, normal, tangential, n_strips, n_elements, conformal :
        As in `contact.solve`, common to all cases.
    threads : int
        Number of threads; the kernels release the GIL. Default: all cores the process may use. The answer does not depend
        on it.

    Returns
    -------
    Forces
        Nothing is raised for a case that has no trustworthy answer; its `status` says so.

    Raises
    ------
    ContactError
        For input outside its range or shapes that do not broadcast.
    """
    separations = [separation] if isinstance(separation, Separation) else list(separation)
    if not separations or not all(isinstance(s, Separation) for s in separations):
        raise ContactError("separation holds something else than contact.Separation, or nothing")
    if isinstance(creepage, Creepage):
        creepage = (creepage.longitudinal, creepage.lateral, creepage.spin)
    if len(creepage) != 3:
        raise ContactError(f"creepage has {len(creepage)} parts; (longitudinal, lateral, spin) is needed")
    if (load is None) == (approach is None):
        raise ContactError("exactly one of load and approach is needed")
    surface, coefficients = (friction, friction.static) if isinstance(friction, Friction) else (None, friction)
    index = np.arange(len(separations)) if not isinstance(separation, Separation) else np.array(0)
    columns = [
        _checked("load", load, 0.0) if load is not None else _checked("approach", approach, -np.inf),
        *(
            _checked(f"creepage.{name}", value, -LARGEST_CREEPAGE, LARGEST_CREEPAGE)
            for name, value in zip(("longitudinal", "lateral", "spin"), creepage, strict=True)
        ),
        _checked("friction", coefficients, 0.0, LARGEST),
        _checked("speed", speed, np.nextafter(0.0, 1.0)),
        index,
    ]
    try:
        amount, vx, vy, phi, mu, V, which = np.broadcast_arrays(*columns)
    except ValueError:
        shapes = ", ".join(str(np.shape(c)) for c in columns)
        raise ContactError(
            f"shapes of load, creepages, friction, speed and separation do not broadcast: {shapes}"
        ) from None
    n_strips, n_elements = require_resolution(n_strips, n_elements)
    method, rolling = (lookup(*kind, batched=True) for kind in (("normal", normal), ("tangential", tangential)))
    if conformal:
        require_conformal(rolling)
    shape, count = amount.shape, amount.size
    cases = np.empty((count, N_CASE))
    cases[:, CASE_LOAD_KIND] = LOAD if load is not None else APPROACH
    fill(cases, surface or Friction(0.0), V.ravel())
    for row, values in ((CASE_LOAD, amount), (CASE_VX, vx), (CASE_VY, vy), (CASE_PHI, phi), (CASE_MU, mu)):
        cases[:, row] = values.ravel()
    cases[:, CASE_G], cases[:, CASE_NU] = material.shear_modulus, material.poisson_ratio
    cases[:, CASE_PRESSURE_LIMIT] = material.pressure_limit
    cases[:, CASE_CONFORMAL] = float(conformal)
    cases[:, CASE_NORMAL], cases[:, CASE_TANGENTIAL] = method.id, rolling.id

    bounds = np.cumsum([0, *(s.y.size for s in separations)])
    columns = [np.concatenate([getattr(s, name) for s in separations]) for name in ("y", "g", "A", "x_c", "tilt")]
    rolled = np.array([s.rolling for s in separations])
    for array in columns:
        array.setflags(write=False)  # like a Separation's, so that numba compiles the solver for one signature only
    longest = max(s.y.size for s in separations)
    results = np.empty((count, N_RES))
    which = np.array(which).ravel()  # a copy: numba warns of a broadcast one

    def work(chunks: range) -> None:
        own = workspace.allocate(
            method, rolling, material.poisson_ratio, n_strips, n_elements, longest, fields=conformal
        )
        for first in chunks:
            last = min(first + _CHUNK, count)
            solve_cases(first, last, *columns, rolled, bounds, which, cases, *own[:-1], results)

    pieces = min(threads or cores(), -(-count // _CHUNK))
    if pieces <= 1:
        work(range(0, count, _CHUNK))
    else:
        with ThreadPoolExecutor(pieces) as pool:
            list(pool.map(work, (range(k * _CHUNK, count, pieces * _CHUNK) for k in range(pieces))))

    def column(row: int) -> Array:
        return results[:, row].reshape(shape)

    area = column(RES_AREA)
    slip_ratio = np.divide(column(RES_SLIP_AREA), area, out=np.zeros(shape), where=area > 0.0)
    return Forces(
        Fx=column(RES_FX),
        Fy=column(RES_FY),
        Mz=column(RES_MZ),
        N=column(RES_N),
        approach=column(RES_APPROACH),
        max_pressure=column(RES_PMAX),
        area=area,
        slip_ratio=slip_ratio,
        power_per_metre=column(RES_POWER),
        status=column(RES_STATUS).astype(np.int64),
    )


def cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _checked(name: str, values: ArrayLike | None, minimum: float, maximum: float = np.inf) -> Array:
    """Return `values` as finite float64 within [minimum, maximum], or name the first that is not."""
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ContactError(f"{name} is not an array of numbers") from None
    bad = ~(np.isfinite(array) & (array >= minimum) & (array <= maximum))
    if bad.any():
        where = np.unravel_index(int(np.argmax(bad)), array.shape)
        raise ContactError(
            f"{name}{list(map(int, where)) if array.ndim else ''} = {array[where]:g} is outside the allowed range "
            f"[{minimum:g}, {maximum:g}]"
        )
    return array
