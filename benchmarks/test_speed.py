"""Speed of the kernels and the public functions. `make bench` runs these tests, `make test` does not."""

from __future__ import annotations

import itertools
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import contact
import reference
from contact import workspace
from contact.case import cases, set_surface
from contact.friction import Friction
from contact.kernels.enumerations import LoadKind
from contact.kernels.pipeline import solve_cases
from contact.kernels.records import RESULT

PATCH = next(case for case in reference.patches() if case["name"].startswith("c40_dy+0"))
SEPARATION = contact.Separation(np.array(PATCH["y"]) * 1e-3, np.array(PATCH["g"]) * 1e-3, np.array(PATCH["A"]) * 1e3)
METHODS = contact.methods().batched
CREEP = contact.Creepage(1e-3, 5e-4, 0.1)


CASES = 64


def cases_of(n, normal, tangential):
    """Return `n` cases with prescribed load and constant friction, and memory for their results."""
    made = cases(n, normal, tangential, contact.STEEL)
    set_surface(made, Friction(0.3), 20.0)
    made["load_kind"], made["amount"] = LoadKind.LOAD, 8e4
    made["vx"], made["vy"], made["phi"] = CREEP.longitudinal, CREEP.lateral, CREEP.spin
    return made, np.zeros(n, RESULT)


def kernel_loop(normal: str, tangential: str, n_strips: int, n_elements: int, *, fields: bool):
    """Return a call of the kernel's loop over CASES load-prescribed cases on patch c40_dy+0, with little Python overhead."""
    methods = METHODS.normal[normal], METHODS.tangential[tangential]
    own = workspace.allocate(*methods, 0.28, (n_strips, n_elements, SEPARATION.y.size), fields=fields)
    bounds, which = np.array([0, SEPARATION.y.size]), np.zeros(CASES, dtype=np.int64)
    problems, results = cases_of(CASES, *methods)

    def call() -> None:
        own.space.memory[0] = 0.0
        solve_cases(0, CASES, SEPARATION.samples, bounds, which, problems, own, results)

    call()
    return call


@pytest.mark.parametrize("fields", [True, False], ids=["fields", "forces"])
@pytest.mark.parametrize(("n_strips", "n_elements"), [(40, 40), (30, 20)])
@pytest.mark.parametrize("tangential", ["fastrip", "fastrip_mapped", "fastsim"])
@pytest.mark.parametrize("normal", ["hertz", "analyn"])
def test_kernel(benchmark, normal, tangential, n_strips, n_elements, fields):
    benchmark.extra_info.update(cases=CASES, elements=n_strips * n_elements)
    benchmark(kernel_loop(normal, tangential, n_strips, n_elements, fields=fields))


@pytest.mark.parametrize("warm", [False, True], ids=["cold", "warm"])
@pytest.mark.parametrize("n_strips", [20, 30, 40])
def test_strip_halfspace_kernel(benchmark, n_strips, warm):
    """Warm: the separation moves back and forth by 0.02 mm between calls, as between the time steps of a vehicle model."""
    y = SEPARATION.y
    shifts = 2e-5 * np.concatenate((np.arange(26), np.arange(24, 0, -1)))
    gap = CubicSpline(y, SEPARATION.g)
    moving = itertools.cycle([SEPARATION.with_gap(gap(np.clip(y - s, y[0], y[-1])), SEPARATION.A) for s in shifts])
    options = {"normal": "strip_halfspace", "tangential": "fastrip_mapped"}
    solver = contact.Solver(**options, n_strips=n_strips, n_elements=20, n_samples=y.size)

    def call() -> None:
        solver.forces(next(moving), CREEP, load=8e4, warm=warm)

    call()
    benchmark(call)


def test_solver(benchmark):
    solver = contact.Solver(n_samples=SEPARATION.y.size)
    benchmark(solver.solve, SEPARATION, CREEP, load=8e4)


def test_solver_forces_only(benchmark):
    solver = contact.Solver(n_samples=SEPARATION.y.size)
    benchmark(solver.forces, SEPARATION, CREEP, load=8e4)


def test_solve(benchmark):
    benchmark(contact.solve, SEPARATION, CREEP, load=8e4)


@pytest.mark.parametrize("threads", [1, 2])
def test_forces_of_2000_cases(benchmark, threads):
    creep = tuple(np.random.default_rng(1).normal(0, scale, 2000) for scale in (1e-3, 1e-3, 0.2))
    benchmark(contact.forces, SEPARATION, creep, load=8e4, threads=threads)


def test_import_of_contact(benchmark):
    def fresh() -> None:
        subprocess.run([sys.executable, "-c", "import contact"], check=True, env=os.environ)

    benchmark.pedantic(fresh, rounds=5)


def test_first_solution_with_a_warm_cache(benchmark):
    def fresh() -> None:
        code = "import contact; contact.solve(contact.Separation.hertzian(1.0, 2.0), contact.Creepage(1e-3), load=8e4)"
        subprocess.run([sys.executable, "-c", code], check=True, env=os.environ)

    fresh()
    time.sleep(0.1)
    benchmark.pedantic(fresh, rounds=5)
