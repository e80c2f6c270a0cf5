"""Accuracy of the element-wise half space against CONTACT on CONTACT's own grids, and its run time: docs/check/halfspace.md.

    python benchmarks/halfspace.py [--write docs/check/halfspace.md]

Times are process times, the least of several runs in one thread. CONTACT's times were measured on the machine that computed the
reference numbers (issue 5).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import contact
import reference
from benchmarks.tables import table, tell
from benchmarks.timing import least
from contact.halfspace import Tangential, norm, tang
from contact.study.ellipse import ellipse

MU, STEEL = reference.MU, reference.STEEL
#: CONTACT's grid on ellipses: elements across each axis of the ellipse, and across the whole grid.
ACROSS, ALL = 62, 66


def on_grid(aspect: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, y and gap of set A on CONTACT's grid."""
    separation = ellipse(aspect, 5e-3, reference.N_ELLIPSE)
    s = (np.arange(ALL) - 0.5 * (ALL - 1)) * 2.0 / ACROSS
    x, y = 5e-3 * math.sqrt(aspect) * s, 5e-3 / math.sqrt(aspect) * s
    B = separation.g[0] / separation.y[0] ** 2
    return x, y, separation.A[0] * x**2 + B * y[:, None] ** 2


def patch(case: dict[str, Any], h: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, y and gap of a case of set D on elements of `h` [m]. For 0.2 mm this is CONTACT's grid."""
    separation = reference.separation_of(case)
    if math.isclose(h, 0.2e-3):
        x, y = (np.arange(v[0], v[-1] + 0.3, 0.2) * 1e-3 for v in (case["x_p"], case["y_p"]))
        y = y[y < separation.y[-1] + 1e-9]
    else:
        half = math.ceil(-case["x_p"][0] * 1e-3 / h)
        x = (np.arange(2 * half) - half + 0.5) * h
        y = np.arange(separation.y[0], separation.y[-1], h)
    g, A = (np.interp(y, separation.y, v) for v in (separation.g, separation.A))
    return x, y, g[:, None] + A[:, None] * x**2


def resultants(x: np.ndarray, y: np.ndarray, p: np.ndarray, found: Tangential, c: float) -> np.ndarray:
    """Return Fx and Fy over mu N, Mz over mu N c."""
    moment = (x * found.qy).sum() - (y[:, None] * found.qx).sum()
    return np.array([found.qx.sum(), found.qy.sum(), moment / c]) / (MU * p.sum())


def on_ellipses(offset: float) -> tuple[np.ndarray, int, int]:
    """Return the errors of Fx, Fy, Mz on set A, the largest number of Newton steps and the count of failures."""
    pressures: dict[float, tuple[np.ndarray, ...]] = {}
    errors, steps, failed = [], 0, 0
    for row in reference.ellipses():
        if row["aob"] not in pressures:
            x, y, gap = on_grid(row["aob"])
            p = norm(gap, x[1] - x[0], y[1] - y[0], STEEL, load=reference.N_ELLIPSE).p
            pressures[row["aob"]] = x, y, p
        x, y, p = pressures[row["aob"]]
        found = tang(p, x, y, contact.Creepage(row["xi"], row["eta"], row["phi"] * 1e3), MU, STEEL, offset=offset)
        errors.append(resultants(x, y, p, found, 5e-3) - [row[f"{k}_contact"] for k in ("fx", "fy", "mz")])
        steps, failed = max(steps, found.iterations), failed + (not found.converged)
    return np.array(errors), steps, failed


def on_patches(h: float) -> tuple[dict[str, np.ndarray], list[list[str]]]:
    """Return the errors on set D against CONTACT at 0.2 mm, and rows of times."""
    errors: dict[str, list[float]] = {"N": [], "pmax": [], "L2": [], "force": [], "moment": []}
    rows = []
    for case in reference.patches():
        x, y, gap = patch(case, h)
        delta, true = case["delta"] * 1e-3, case["contact"]

        def normal(gap: np.ndarray = gap, delta: float = delta) -> np.ndarray:
            return norm(gap, h, h, STEEL, approach=delta).p

        p = normal()
        errors["N"].append(p.sum() * h * h / true["N"] - 1)
        errors["pmax"].append(p.max() * 1e-6 / true["pmax"] - 1)
        if math.isclose(h, 0.2e-3):
            kept = np.array(case["p"])
            own = p[::2, ::2][: kept.shape[0], : kept.shape[1]] * 1e-6
            errors["L2"].append(float(np.linalg.norm(own - kept) / np.linalg.norm(kept)))
        times = []
        for k in range(len(case["xi"])):
            creepage = contact.Creepage(case["xi"][k], case["eta"][k], case["phi"][k] * 1e3)

            def rolling(p: np.ndarray = p, creepage: contact.Creepage = creepage) -> Tangential:
                return tang(p, x, y, creepage, MU, STEEL)  # noqa: B023

            arm = math.sqrt(true["area"] / math.pi)
            expected = np.array([true["Fx"][k], true["Fy"][k], true["Mz"][k] / arm]) / (MU * true["N"])
            e = resultants(x, y, p, rolling(), arm * 1e-3) - expected
            errors["force"].append(math.hypot(e[0], e[1]))
            errors["moment"].append(abs(e[2]))
            times.append(least(rolling, 3))
        figures = (least(normal, 9), float(np.mean(times)), max(times))
        rows.append([case["name"], f"{y.size} × {x.size}", str(int((p > 0).sum())), *(f"{t:.1f}" for t in figures)])
    return {name: np.abs(values) for name, values in errors.items()}, rows


def convergence() -> list[list[str]]:
    """Return rows of the force error on ellipses against the limit, by number of elements and place of the rigid slip."""
    cases = {
        "longitudinal, a/b = 1": (1.0, (1e-3, 0.0, 0.0)),
        "spin, a/b = 1": (1.0, (0.0, 0.0, 0.6)),
        "lateral against spin, a/b = 2": (2.0, (0.0, -6.25e-4, 0.625)),
        "spin, a/b = 0.2": (0.2, (0.0, 0.0, 1.0)),
    }
    rows = []
    for name, (aspect, creepage) in cases.items():
        offsets = (0.0, 1 / 6, 1 / 3, 1 / 2) if creepage[2] else (1 / 6,)
        forces = {(n, o): _force(aspect, creepage, n, o) for n in (12, 24, 48, 96) for o in offsets}
        limits = [2.0 * _force(aspect, creepage, 128, o) - _force(aspect, creepage, 64, o) for o in (1 / 6, 1 / 3)]
        limit = np.mean(limits, axis=0)
        for o in offsets:
            place = {0.0: "x", 1 / 6: "x + dx/6", 1 / 3: "x + dx/3", 1 / 2: "x + dx/2"}[o]
            figures = [float(np.linalg.norm(forces[n, o] - limit)) for n in (12, 24, 48, 96)]
            rows.append([name, place if creepage[2] else "any", *(f"{f:.4f}" for f in figures)])
    return rows


def _force(aspect: float, creepage: tuple[float, float, float], n: int, offset: float) -> np.ndarray:
    s = (np.arange(n) - 0.5 * (n - 1)) * 2.0 / n
    x, y = 5e-3 * math.sqrt(aspect) * s, 5e-3 / math.sqrt(aspect) * s
    p = np.sqrt(np.maximum(1.0 - s**2 - s[:, None] ** 2, 0.0))
    p *= 5e4 / (p.sum() * (x[1] - x[0]) * (y[1] - y[0]))
    found = tang(p, x, y, contact.Creepage(*creepage), MU, STEEL, offset=offset)
    return resultants(x, y, p, found, 5e-3)[:2]


def report() -> dict[str, str]:
    """Return all tables as Markdown."""
    errors, steps, failed = on_ellipses(1 / 6)
    a = table(
        ["", "mean", "max"],
        [
            [name, f"{e.mean():.1e}", f"{e.max():.1e}"]
            for name, e in (("force", np.hypot(errors[:, 0], errors[:, 1])), ("moment", np.abs(errors[:, 2])))
        ],
    )
    fine, fine_rows = on_patches(0.2e-3)
    coarse, coarse_rows = on_patches(0.5e-3)
    names = {
        "N": "N, relative",
        "pmax": "max pressure, relative",
        "L2": "pressure field, L2",
        "force": "force over μN",
        "moment": "moment",
    }
    d = table(
        ["", "0.2 mm: mean / max", "0.5 mm: mean / max"],
        [
            [title, *(f"{e[k].mean():.1e} / {e[k].max():.1e}" if e[k].size else "" for e in (fine, coarse))]
            for k, title in names.items()
        ],
    )
    header = ["patch", "rows × columns", "in contact", "normal [ms]", "tangential, mean [ms]", "tangential, max [ms]"]
    return {
        "a": f"At most {steps} Newton steps; {failed} cases not converged.\n\n{a}",
        "d": d,
        "times": f"{table(header, fine_rows)}\n{table(header, coarse_rows)}",
        "order": table(["case", "rigid slip at", "12", "24", "48", "96 elements"], convergence()),
    }


if __name__ == "__main__":
    tell(report, __doc__)
