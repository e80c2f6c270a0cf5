"""`contact.forces`: solve arrays of cases."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import broadcast, require_aligned, require_numbers
from contact.core import pack
from contact.errors import ContactError, require_flag, require_integer
from contact.friction import Friction
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import APPROACH, CREEPAGE, FRICTION, LOAD, N_ELEMENTS, N_STRIPS
from contact.inputs.plausibility import doubt_alike, doubt_values
from contact.inputs.separation import Separation
from contact.instance import workspace
from contact.instance.case import cases as prepared_cases
from contact.instance.case import set_surface
from contact.kernels.arrays import Samples, SolverArrays
from contact.kernels.enumerations import LoadKind
from contact.kernels.jacobian import COLUMNS, ROWS
from contact.kernels.pipeline import solve_cases
from contact.kernels.records import RESULT
from contact.kernels.solver import derive_contact
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL, lookup
from contact.results import Forces, Jacobian, doubt_answer
from contact.results.later import arrays_of
from contact.solver import require_conformal, require_resolution

_CHUNK = 256
_PARTS = ("longitudinal", "lateral", "spin")


def forces(
    separation: Separation | Sequence[Separation],
    creepage: Creepage | Sequence[Creepage] | tuple[ArrayLike, ArrayLike, ArrayLike],
    *,
    load: ArrayLike | None = None,
    approach: ArrayLike | None = None,
    friction: ArrayLike | Friction = 0.3,
    speed: ArrayLike = 20.0,
    material: Material = STEEL,
    normal: str = DEFAULT_NORMAL,
    tangential: str = DEFAULT_TANGENTIAL,
    n_strips: int = N_STRIPS.usual,
    n_elements: int = N_ELEMENTS.usual,
    conformal: bool = False,
    threads: int | None = None,
    derivatives: bool = False,
) -> Forces:
    """Return the contact forces of arrays of cases, without a Python loop over the cases.

    The kernel is that of `contact.solve`. Fields over the patch are not returned.

    Parameters
    ----------
    separation : Separation or sequence of Separation
        A sequence of length n broadcasts like an array of shape (n,).
    creepage : Creepage or (longitudinal, lateral, spin), or sequence of Creepage
        Arrays [-], [-], [1/m]. They broadcast with all other arrays. A sequence of length n broadcasts like an array of
        shape (n,).
    load, approach : array_like
        Normal force [N] or rigid approach [m]. Give exactly one of them.
    friction : array_like or contact.friction.Friction
        Coefficient of friction [-], or a friction law common to all cases.
    speed : array_like
        Rolling speed [m/s] ≥ 0. Forces depend on it only if the friction does.
    material, normal, tangential, n_strips, n_elements, conformal :
        As in `contact.solve`, common to all cases.
    threads : int
        Number of threads; default all cores that the process may use. The kernels release the GIL. The results do not
        depend on the number of threads.
    derivatives : bool
        Also find `Forces.jacobian`, as `contact.solve` does.

    Returns
    -------
    Forces
        Arrays of the broadcast shape. A case without a trustworthy solution raises nothing; see its `status`.

    Raises
    ------
    ContactError
        For input outside its range or shapes that do not broadcast.

    Warns
    -----
    PlausibilityWarning
        As `contact.solve`, once for each argument.

    Examples
    --------
    >>> import contact
    >>> gap = contact.Separation.hertzian(1.1, 0.8)
    >>> found = contact.forces(gap, ([0.0, 1e-3, 2e-3], 0.0, 0.0), load=80e3)
    >>> found.Fx.round().tolist()
    [0.0, -11846.0, -19294.0]
    """
    given = [separation] if isinstance(separation, Separation) else separation
    separations = list(given) if isinstance(given, Iterable) else []
    if not separations or not all(isinstance(s, Separation) for s in separations):
        raise ContactError("separation is empty or holds an object that is not a contact.Separation")
    creepages = _creepages(creepage)
    if (load is None) == (approach is None):
        raise ContactError("exactly one of load and approach is needed")
    surface, coefficients = (friction, friction.static) if isinstance(friction, Friction) else (None, friction)
    index = np.arange(len(separations)) if not isinstance(separation, Separation) else np.array(0)
    load_name = "approach" if load is None else "load"
    limits, wanted = (APPROACH, approach) if load is None else (LOAD, load)
    columns: dict[str, NDArray[Any]] = {load_name: require_numbers(load_name, wanted, *limits.bounds)}
    for name, value in zip(_PARTS, creepages, strict=True):
        columns[f"creepage.{name}"] = require_numbers(f"creepage.{name}", value, *CREEPAGE.bounds)
    columns["friction"] = require_numbers("friction", coefficients, *FRICTION.bounds)
    columns["speed"] = require_numbers("speed", speed, 0.0)
    for name, values in columns.items():
        doubt_values(name, values)
    columns["separation"] = index
    require_aligned(
        **dict(zip(_PARTS, creepages, strict=True)), **{load_name: wanted}, friction=coefficients, speed=speed
    )
    amount, vx, vy, phi, mu, V, which = broadcast(columns)
    n_strips, n_elements = require_resolution(n_strips, n_elements)
    method, rolling = (lookup(*kind, batched=True) for kind in (("normal", normal), ("tangential", tangential)))
    if require_flag("conformal", conformal):
        require_conformal(rolling)
    shape, count = amount.shape, amount.size
    bounds = np.cumsum([0, *(s.y.size for s in separations)])
    samples = Samples(*(np.concatenate(column) for column in zip(*(s.samples for s in separations), strict=True)))
    which = np.array(which).ravel()  # a copy, because it is broadcast

    cases = prepared_cases(count, method, rolling, material, conformal=conformal)
    doubt_alike(material.coupling)
    set_surface(cases, surface or Friction(0.0), V.ravel())
    cases["load_kind"] = LoadKind.LOAD if load is not None else LoadKind.APPROACH
    cases["rolling"] = np.array([s.rolling for s in separations])[which]
    for name, values in (("amount", amount), ("vx", vx), ("vy", vy), ("phi", phi), ("mu", mu)):
        cases[name] = values.ravel()
    if surface is None:
        cases["kinetic"] = mu.ravel()
    longest = max(s.y.size for s in separations)
    results = np.zeros(count, RESULT)
    slopes = np.zeros((count, ROWS, COLUMNS)) if derivatives else None

    def work(chunks: range) -> None:
        size = n_strips, n_elements, longest
        if slopes is not None:
            solver = workspace.solver_arrays(method, rolling, material.poisson_ratio, size)
            packed = pack(SolverArrays, solver)
            for first in chunks:
                solver.workspace.space.memory[0] = 0.0
                for i in range(first, min(first + _CHUNK, count)):
                    solver.case[0] = cases[i]
                    derive_contact(separations[which[i]].packed, False, packed)
                    results[i], slopes[i] = solver.result[0], solver.slopes
            return
        with_fields = conformal or material.pressure_limit < np.inf  # both compute the forces from the fields
        arrays = workspace.allocate(method, rolling, material.poisson_ratio, size, fields=with_fields)
        for first in chunks:
            arrays.space.memory[0] = 0.0
            solve_cases(first, min(first + _CHUNK, count), samples, bounds, which, cases, arrays, results)

    threads = cores() if threads is None else require_integer("threads", threads, 0) or cores()
    pieces = min(threads, -(-count // _CHUNK))
    if pieces <= 1:
        work(range(0, count, _CHUNK))
    else:
        with ThreadPoolExecutor(pieces) as pool:
            list(pool.map(work, (range(k * _CHUNK, count, pieces * _CHUNK) for k in range(pieces))))

    if count:
        for name in ("N", "gap_error", "bend", "beyond"):
            worst = int(results[name].argmax())
            told = separations[which[worst]].told
            doubt_answer(told, method.gap_limit, conformal, " in an array", **{name: float(results[name][worst])})
        least_true = max(separations, key=lambda one: one.fit_error)
        doubt_answer(least_true.told, fit_error=least_true.fit_error)
    slip_ratio = np.divide(results["slip_area"], results["area"], out=np.zeros(count), where=results["area"] > 0.0)
    return Forces(
        **arrays_of(Forces, results, shape),
        slip_ratio=slip_ratio.reshape(shape),
        jacobian=None if slopes is None else Jacobian(slopes.reshape(*shape, ROWS, COLUMNS), load_name),
    )._with_inputs({name.removeprefix("creepage."): values for name, values in columns.items()})


def _creepages(given: Any) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
    """Return longitudinal, lateral and spin creepage of any form that `forces` takes."""
    if isinstance(given, Creepage):
        return given.longitudinal, given.lateral, given.spin
    if isinstance(given, Sequence) and given and all(isinstance(one, Creepage) for one in given):
        vx, vy, phi = ([getattr(one, name) for one in given] for name in _PARTS)
        return vx, vy, phi
    if not isinstance(given, tuple | list | np.ndarray) or not getattr(given, "ndim", 1) or len(given) != 3:
        raise ContactError(f"creepage = {given!r} is neither a contact.Creepage nor (longitudinal, lateral, spin)")
    vx, vy, phi = given
    return vx, vy, phi


def cores() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
