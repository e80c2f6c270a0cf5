"""Speed of kernels and of the public functions; run by `make bench`, never by `make test`."""

from __future__ import annotations

import itertools
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from contact.kernels.layout import LoadKind
import contact
from benchmarks import accuracy
from contact import workspace
from contact.kernels.layout import N_CASE
from contact.friction import Friction, fill
from contact.kernels.pipeline import solve_case, solve_cases

PATCH = next(case for case in accuracy.patches() if case["name"].startswith("c40_dy+0"))
SEPARATION = contact.Separation(np.array(PATCH["y"]) * 1e-3, np.array(PATCH["g"]) * 1e-3, np.array(PATCH["A"]) * 1e3)
METHODS = contact.methods().batched
CREEP = contact.Creepage(1e-3, 5e-4, 0.1)


CASES = 64


def case_of(normal, tangential):
    """A load-prescribed case, with constant friction."""
    case = np.zeros(N_CASE)
    case.load_kind, case.amount, case.G, case.nu = LoadKind.LOAD, 8e4, 82e9, 0.28
    case.vx, case.vy, case.phi = CREEP.longitudinal, CREEP.lateral, CREEP.spin
    case.normal, case.tangential = normal.id, tangential.id
    fill(case, Friction(0.3), 20.0)
    return case


def kernel_loop(normal: str, tangential: str, n_strips: int, n_elements: int, *, fields: bool):
    """The kernel's own loop over CASES load-prescribed cases on the patch c40_dy+0: Python hardly counts."""
    method = METHODS.normal[normal]
    own = workspace.allocate(
        method, METHODS.tangential[tangential], 0.28, n_strips, n_elements, SEPARATION.y.size, fields=fields
    )
    case = case_of(method, METHODS.tangential[tangential])
    bounds, which = np.array([0, SEPARATION.y.size]), np.zeros(CASES, dtype=np.int64)
    results = np.empty((CASES, own.result.size))
    arrays = (
        SEPARATION.y,
        SEPARATION.g,
        SEPARATION.A,
        SEPARATION.x_c,
        SEPARATION.tilt,
        np.zeros(1),
        bounds,
        which,
        np.tile(case, (CASES, 1)),
    )
    arguments = (0, CASES, *arrays, own.rule, own.tables, own.space, own.strips, own.fields, results)

    def call() -> None:
        solve_cases(*arguments)

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
    """Warm: the separation moves to and fro by 0.02 mm from call to call, as between the time steps of a vehicle model."""
    method = METHODS.normal["strip_halfspace"]
    rolling = METHODS.tangential["fastrip_mapped"]
    own = workspace.allocate(method, rolling, 0.28, n_strips, 20, SEPARATION.y.size, fields=False)
    case = case_of(method, rolling)
    y = SEPARATION.y
    shifts = 2e-5 * np.concatenate((np.arange(26), np.arange(24, 0, -1)))
    gap = CubicSpline(y, SEPARATION.g)
    moving = itertools.cycle([gap(np.clip(y - shift, y[0], y[-1])) for shift in shifts])

    def call() -> None:
        if not warm:
            own.space.memory[0] = 0.0
        solve_case(y, next(moving), SEPARATION.A, SEPARATION.x_c, case, *own)

    call()
    benchmark(call)


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
