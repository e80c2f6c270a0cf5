"""Print the times of the kernels and of the public functions, with CONTACT's for comparison (`make bench`)."""

from __future__ import annotations

import itertools
import platform
import time
from collections.abc import Callable, Iterator

import numpy as np
from scipy.interpolate import CubicSpline

import contact
import reference
from benchmarks.tables import table
from contact.friction import Friction
from contact.instance import workspace
from contact.instance.case import cases, set_surface
from contact.kernels.enumerations import LoadKind
from contact.kernels.pipeline import solve_cases
from contact.kernels.records import RESULT

PATCH = next(case for case in reference.patches() if case["name"].startswith("c40_dy+0"))
SEPARATION = contact.Separation(np.array(PATCH["y"]) * 1e-3, np.array(PATCH["g"]) * 1e-3, np.array(PATCH["A"]) * 1e3)
CREEP = contact.Creepage(1e-3, 5e-4, 0.1)
CASES = 64
CONTACT = (
    "CONTACT 25.1 on the same patch (design figures, another machine): solvers alone 100 µs (ANALYN + FaStrip, 28 × 50 "
    "elements), whole case 700 µs; full half space 47 ms."
)
#: What is timed: name, call, cases and elements of a call.
Task = tuple[str, Callable[[], object], int, int]


def kernel_loop(normal: str, tangential: str, n_strips: int, n_elements: int, fields: bool) -> Callable[[], object]:
    """Return a call of the kernel's loop over CASES load-prescribed cases on patch c40_dy+0, with little Python overhead."""
    known = contact.methods().batched
    methods = known.normal[normal], known.tangential[tangential]
    made = cases(CASES, *methods, contact.STEEL)
    set_surface(made, Friction(0.3), 20.0)
    made["load_kind"], made["amount"] = LoadKind.LOAD, 8e4
    made["vx"], made["vy"], made["phi"] = CREEP.longitudinal, CREEP.lateral, CREEP.spin
    memory = workspace.allocate(*methods, 0.28, (n_strips, n_elements, SEPARATION.y.size), fields=fields)
    bounds, which = np.array([0, SEPARATION.y.size]), np.zeros(CASES, dtype=np.int64)
    results = np.zeros(CASES, RESULT)

    def call() -> None:
        memory.space.memory[0] = 0.0
        solve_cases(0, CASES, SEPARATION.samples, bounds, which, made, memory, results)

    return call


def moving(n_strips: int, warm: bool) -> Callable[[], object]:
    """Return a call of the default methods on the separation that moves back and forth by 0.02 mm, as in a vehicle model."""
    y = SEPARATION.y
    shifts = 2e-5 * np.concatenate((np.arange(26), np.arange(24, 0, -1)))
    gap = CubicSpline(y, SEPARATION.g)
    places = itertools.cycle([SEPARATION.with_gap(gap(np.clip(y - s, y[0], y[-1])), SEPARATION.A) for s in shifts])
    solver = contact.Solver(n_strips=n_strips, n_elements=20, n_samples=y.size)
    return lambda: solver.forces(next(places), CREEP, load=8e4, warm=warm)


def tasks() -> Iterator[Task]:
    """Yield what is timed."""
    for normal, tangential, (n, m), fields in itertools.product(
        ("hertz", "analyn"), ("fastrip", "fastrip_mapped", "fastsim"), ((30, 20), (40, 40)), (False, True)
    ):
        name = f"kernel, {normal} + {tangential}, {n} × {m}, {'fields' if fields else 'forces'}"
        yield name, kernel_loop(normal, tangential, n, m, fields), CASES, n * m
    for n, warm in itertools.product((20, 30, 40), (False, True)):
        yield f"Solver.forces, default, {n} × 20, {'warm' if warm else 'cold'}", moving(n, warm), 1, 0
    solver = contact.Solver(n_samples=SEPARATION.y.size)
    yield "Solver.solve", lambda: solver.solve(SEPARATION, CREEP, load=8e4), 1, 0
    yield "Solver.solve and its Fx", lambda: solver.solve(SEPARATION, CREEP, load=8e4).Fx, 1, 0
    yield "Solver.solve and its p", lambda: solver.solve(SEPARATION, CREEP, load=8e4).p, 1, 0
    yield "contact.solve", lambda: contact.solve(SEPARATION, CREEP, load=8e4), 1, 0
    creep = tuple(np.random.default_rng(1).normal(0, scale, 2000) for scale in (1e-3, 1e-3, 0.2))
    for threads in (1, 2):
        call = lambda threads=threads: contact.forces(SEPARATION, creep, load=8e4, threads=threads)  # noqa: E731
        yield f"contact.forces of 2000 cases, {threads} threads", call, 1, 0


def rounds(call: Callable[[], object], n: int = 40, least: float = 5e-3) -> np.ndarray:
    """Return the times [s] of a call in `n` rounds, each of as many calls as take about `least` [s]."""
    call()
    start = time.perf_counter()
    call()
    calls = max(1, round(least / (time.perf_counter() - start)))
    found = []
    for _ in range(n):
        start = time.perf_counter()
        for _ in range(calls):
            call()
        found.append((time.perf_counter() - start) / calls)
    return np.array(found)


def scaled(seconds: float) -> str:
    """Return a time with its unit."""
    unit, factor = next(((u, f) for u, f in (("s", 1.0), ("ms", 1e3), ("µs", 1e6)) if seconds * f >= 1.0), ("ns", 1e9))
    return f"{seconds * factor:.3g} {unit}"


def main() -> None:
    """Print the table."""
    rows = []
    for name, call, many, elements in tasks():
        found = rounds(call) / many
        each = scaled(float(found.min()) / elements) if elements else ""
        rows.append([name, scaled(float(found.min())), scaled(float(np.median(found))), each])
    print(f"{platform.processor()}, Python {platform.python_version()}; least and median of many rounds, of one case\n")
    print(table(["what", "least", "median", "least per element"], rows))
    print(CONTACT)


if __name__ == "__main__":
    main()
