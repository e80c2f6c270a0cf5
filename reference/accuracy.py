"""Errors of the fast methods against the reference numbers. `make accuracy` writes them, and tests limit them.

Errors are defined as in the tables of docs/check/accuracy.md. Forces are divided by mu N with each method's own N. Moments are
divided by mu N sqrt(ab) on ellipses and by mu N sqrt(area/pi) on other patches.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from typing import Any

import numpy as np

import contact
from contact.study.ellipse import ellipse
from reference import MU, N_ELLIPSE, STEEL, ellipses, fields, linear_slopes, patches, separation_of

RESOLUTION = {"n_strips": 40, "n_elements": 40}


@functools.cache
def errors_on_ellipses(method: str, published: bool = False) -> dict[str, np.ndarray]:
    """Return the errors of a tangential method on set A. With `published` they are those of CONTACT's column of that name."""
    rows = ellipses()
    if published:
        ours = np.array([[row[f"{k}_{method}"] for k in ("fx", "fy", "mz", "adh")] for row in rows])
    else:
        ours = np.empty((len(rows), 4))
        for aspect in sorted({row["aob"] for row in rows}):
            chosen = [i for i, row in enumerate(rows) if row["aob"] == aspect]
            creepage = tuple(
                np.array([rows[i][k] for i in chosen]) * s for k, s in (("xi", 1), ("eta", 1), ("phi", 1e3))
            )
            separation = ellipse(aspect, 5e-3, N_ELLIPSE)
            many = contact.forces(
                separation,
                creepage,
                load=N_ELLIPSE,
                friction=MU,
                material=STEEL,
                normal="analyn",  # exact on ellipses
                tangential=method,
                **RESOLUTION,
            )
            scale = MU * N_ELLIPSE
            ours[chosen] = np.stack(
                [many.Fx / scale, many.Fy / scale, many.Mz / (scale * 5e-3), 1 - many.slip_ratio], axis=1
            )
    true = np.array([[row[f"{k}_contact"] for k in ("fx", "fy", "mz", "adh")] for row in rows])
    d = ours - true
    return {"force": np.hypot(d[:, 0], d[:, 1]), "moment": np.abs(d[:, 2]), "adhesion": np.abs(d[:, 3])}


@functools.cache
def errors_on_fields(method: str) -> dict[str, float]:
    """Return the relative L2 error of the traction for each case of set B."""
    result = {}
    for case in fields():
        # Kalker's normalised cases (G = 1, a = 1) load a body to half its modulus. Elasticity is linear, so 1e-3 is used.
        share = 1.0 if case["G"] > 10 else 1e-3
        mm, unit = 1e-3, 1e6
        N, material = case["N"] * share, contact.Material(case["G"] * unit, case["nu"])
        separation = ellipse(case["aa"] / case["bb"], math.sqrt(case["aa"] * case["bb"]) * mm, N, material)
        sol = contact.solve(
            separation,
            contact.Creepage(case["xi"] * share, case["eta"] * share, case["phi"] * share / mm),
            load=N, friction=case["mu"], material=material, normal="hertz", tangential=method, n_strips=66, n_elements=66,
        )  # fmt: skip
        x, y = np.array(case["x"]) * mm, np.array(case["y"]) * mm
        ours = [evaluate(sol, field, x, y) / (unit * share) for field in (sol.qx, sol.qy)]
        true = [np.array(case["qx"]), np.array(case["qy"])]
        difference = sum(((a - b) ** 2).sum() for a, b in zip(ours, true, strict=True))
        result[case["name"]] = math.sqrt(difference / sum((t**2).sum() for t in true))
    return result


def evaluate(sol: contact.Solution, field: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a traction field on a grid (y, x), linear between strips and between elements of the unit strip."""
    a = np.interp(y, sol.strips.y, sol.strips.a**2, left=0, right=0)
    low, high = sol.patch_edges[0]
    a_edge = np.where((y > low) & (y < high), np.sqrt(np.maximum(a, 1e-30)), 0.0)
    s_nodes = ((sol.x - sol.strips.x_c[:, None]) / sol.strips.a[:, None])[0, ::-1]
    out = np.zeros((y.size, x.size))
    for i, (yi, ai) in enumerate(zip(y, a_edge, strict=True)):
        if ai <= 0:
            continue
        k = int(np.clip(np.searchsorted(sol.strips.y, yi) - 1, 0, sol.strips.y.size - 2))
        t = float(np.clip((yi - sol.strips.y[k]) / (sol.strips.y[k + 1] - sol.strips.y[k]), 0, 1))
        s = x / ai
        row = [np.interp(s, s_nodes, field[j, ::-1]) for j in (k, k + 1)]
        out[i] = np.where(np.abs(s) < 1, (1 - t) * row[0] + t * row[1], 0.0)
    return out


def errors_of_pressure(sol: contact.Solution, case: dict[str, Any]) -> tuple[float, float, float, float]:
    """Return the relative errors of N, pmax and area, and the L2 error of the pressure, for a patch of set D."""
    true, full = case["contact"], np.array(case["p"])
    ours = sol.pressure(np.array(case["x_p"])[None, :] * 1e-3, np.array(case["y_p"])[:, None] * 1e-3) / 1e6
    return (
        sol.N / true["N"] - 1,
        sol.max_pressure / 1e6 / true["pmax"] - 1,
        sol.area * 1e6 / true["area"] - 1,
        float(np.linalg.norm(ours - full) / np.linalg.norm(full)),
    )


@functools.cache
def errors_of_normal(normal: str, by_load: bool = False) -> dict[str, np.ndarray]:
    """Return the errors for each patch of set D: N, pmax, area, pressure L2 and approach.

    The patches are solved at CONTACT's approach, or with `by_load` at its load.
    """
    rows = []
    for case in patches():
        given = {"load": case["contact"]["N"]} if by_load else {"approach": case["delta"] * 1e-3}
        sol = contact.solve(
            separation_of(case), contact.Creepage(), material=STEEL, normal=normal, throw=False, **given, **RESOLUTION
        )
        rows.append((*errors_of_pressure(sol, case), sol.approach * 1e3 / case["delta"] - 1))
    return dict(zip(("N", "pmax", "area", "L2", "approach"), np.array(rows).T, strict=True))


@functools.cache
def errors_on_patches(normal: str, tangential: str) -> dict[str, np.ndarray]:
    """Return the errors on set D at the prescribed approach: N, pmax, area, pressure L2 by patch, force, moment by state."""
    normal_errors, force, moment = [], [], []
    for case in patches():
        separation, true = separation_of(case), case["contact"]
        for k in range(len(case["xi"])):
            sol = contact.solve(
                separation,
                contact.Creepage(case["xi"][k], case["eta"][k], case["phi"][k] * 1e3),
                approach=case["delta"] * 1e-3, friction=MU, material=STEEL, normal=normal, tangential=tangential,
                throw=False, **RESOLUTION,
            )  # fmt: skip
            d = [f / (MU * sol.N) - true[n][k] / (MU * true["N"]) for f, n in ((sol.Fx, "Fx"), (sol.Fy, "Fy"))]
            force.append(math.hypot(*d))
            arm = math.sqrt(true["area"] / math.pi)
            moment.append(abs(sol.Mz * 1e3 / (MU * sol.N) - true["Mz"][k] / (MU * true["N"])) / arm)
        normal_errors.append(errors_of_pressure(sol, case))
    N, pmax, area, L2 = np.array(normal_errors).T
    return {"N": N, "pmax": pmax, "area": area, "L2": L2, "force": np.array(force), "moment": np.array(moment)}


@functools.cache
def errors_of_slopes(normal: str, tangential: str) -> np.ndarray:
    """Return relative errors (patches, 4) of Fx/ξ, Fy/η, Fy/φ, Mz/φ at vanishing creepage."""
    tiny, errors = 1e-8, []
    for case, true in zip(patches(), linear_slopes(), strict=True):
        assert case["name"] == true["name"]
        creepage = tuple(tiny * np.eye(3))
        many = contact.forces(
            separation_of(case), creepage, approach=case["delta"] * 1e-3, friction=MU, material=STEEL, normal=normal,
            tangential=tangential, n_strips=40, n_elements=60,
        )  # fmt: skip
        slopes_of_ours = np.array([many.Fx[0], many.Fy[1], many.Fy[2], many.Mz[2]]) / tiny
        slopes = np.array(true["slopes"])
        errors.append(slopes_of_ours / (slopes[0, 0], slopes[1, 1], slopes[2, 1], slopes[2, 2]) - 1)
    return np.array(errors)


def published_on_patches(name: str) -> dict[str, np.ndarray]:
    """Return the errors of CONTACT's own fast methods on set D."""
    force, moment, N, pmax, area = [], [], [], [], []
    for case in patches():
        fast, true = case["fast"][name], case["contact"]
        scale, full = MU * fast["N"], MU * true["N"]
        for k in range(len(case["xi"])):
            force.append(math.hypot(*(fast[n][k] / scale - true[n][k] / full for n in ("Fx", "Fy"))))
            moment.append(abs(fast["Mz"][k] / scale - true["Mz"][k] / full) / math.sqrt(true["area"] / math.pi))
        N.append(fast["N"] / true["N"] - 1)
        pmax.append(fast["pmax"] / true["pmax"] - 1)
        area.append(fast["area"] / true["area"] - 1)
    L2 = [case["pressure_error"].get(name.split("_")[0], math.nan) for case in patches()]
    return dict(
        zip(
            ("N", "pmax", "area", "L2", "force", "moment"),
            map(np.array, (N, pmax, area, L2, force, moment)),
            strict=True,
        )
    )


def errors_of(patches: Iterable[Any], **options: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the errors of patches with CONTACT's load and creepages, and the error estimate of the normal problem.

    The first array is the error of the force over mu N, the second the largest pressure over CONTACT's less 1, the third is
    `Solution.gap_error`. `options` are those of `contact.Solver`; `patches` as `wheel_rail_patches` gives them.
    """
    solver = contact.Solver(material=STEEL, **options)
    rows = []
    for patch in patches:
        s = solver.solve(patch.separation, patch.creepage, load=patch.N, friction=patch.friction)
        force = math.hypot(s.Fx - patch.Fx, s.Fy - patch.Fy) / (patch.friction * patch.N)
        rows.append((force, s.max_pressure / patch.max_pressure - 1.0, s.gap_error))
    force, peak, gap = np.array(rows).T
    return force, peak, gap
