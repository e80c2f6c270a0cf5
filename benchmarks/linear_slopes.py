"""Slopes of forces and moment at vanishing creepage on the real patches, by boundary elements in full adhesion.

    python benchmarks/linear_slopes.py        # writes tests/reference/linear_slopes.json; some minutes

Kalker's linear theory on the patch of `strip_halfspace`: every particle sticks, so the displacement of constant-traction
elements follows the rigid creep, u(x) - u(x + dx) = -w dx (theory.md 6). `check` holds the same computation on ellipses against
Kalker's table.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.linalg import lu_factor, lu_solve

import contact
from benchmarks import accuracy
from contact import kalker
from contact.halfspace import influence

TARGET = Path(__file__).parent.parent / "tests" / "reference" / "linear_slopes.json"
STATES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
Array = np.ndarray


def slopes(solve: Callable[[int], contact.Solution], n: int) -> Array:
    """Fx, Fy, Mz (columns) per unit creepage (rows) in full adhesion: n strips, each of n elements that end at its edges."""
    sol = solve(n)
    unit = (np.arange(n) + 0.5) * 2.0 / n - 1.0
    x = (sol.strips.x_c[:, None] + sol.strips.a[:, None] * unit).ravel()
    y, dy, dx = (np.repeat(v, n) for v in (sol.strips.y, sol.strips.dy, 2.0 * sol.strips.a / n))
    X, Y = x[:, None] - x[None, :], y[:, None] - y[None, :]
    here = influence.tangential(X, Y, dx, dy, sol.material)
    ahead = influence.tangential(X + dx[:, None], Y, dx, dy, sol.material)
    xx, yy, xy = (a - b for a, b in zip(here, ahead, strict=True))
    system = lu_factor(np.block([[xx, xy], [xy, yy]]))
    result = []
    for vx, vy, phi in STATES:
        # a creep that varies along x is met half-way between the two positions
        w = np.r_[vx - phi * y, vy + phi * (x + dx / 2)]
        q = lu_solve(system, -w * np.r_[dx, dx])
        qx, qy = q[: x.size] * dx * dy, q[x.size :] * dx * dy
        result.append([qx.sum(), qy.sum(), (x * qy - y * qx).sum()])
    return np.array(result)


def extrapolated(solve: Callable[[int], contact.Solution]) -> Array:
    """From 16 and 24 strips and elements, linearly in 1/n."""
    coarse, fine = slopes(solve, 16), slopes(solve, 24)
    return fine + 2.0 * (fine - coarse)


def kalker_error(aspect: float) -> dict[str, float]:
    """Relative deviation of C11, C22, C23, C33 of this computation from the published table, on an ellipse."""
    c, separation = 5e-3, accuracy.ellipse(aspect, 5e-3, 5e4)
    s = extrapolated(lambda n: contact.solve(separation, contact.Creepage(), load=5e4, n_strips=n))
    G = accuracy.STEEL.shear_modulus
    own = (-s[0, 0] / (G * c**2), -s[1, 1] / (G * c**2), -s[2, 1] / (G * c**3), -s[2, 2] / (G * c**4))
    table = kalker.coefficients(kalker.table(0.28), math.log(aspect))
    return {n: round(float(o / t - 1), 4) for n, o, t in zip(("C11", "C22", "C23", "C33"), own, table, strict=True)}


def main() -> None:
    cases = []
    for case in accuracy.patches():
        separation = accuracy.separation_of(case)

        def solve(
            n: int, separation: contact.Separation = separation, delta: float = case["delta"] * 1e-3
        ) -> contact.Solution:
            return contact.solve(
                separation,
                contact.Creepage(),
                approach=delta,
                normal="strip_halfspace",
                material=accuracy.STEEL,
                n_strips=n,
            )

        cases.append({"name": case["name"], "slopes": [accuracy.digits(row) for row in extrapolated(solve)]})
        print(cases[-1], flush=True)
    check = {str(a): kalker_error(a) for a in (0.3, 1.0, 3.0)}
    print(check)
    about = (
        "slopes[creepage][force]: Fx [N], Fy [N], Mz [N m] per unit of longitudinal, lateral and spin creepage [1/m] at "
        "vanishing creepage; own boundary elements in full adhesion on the patches of strip_halfspace, "
        "benchmarks/linear_slopes.py; check: deviation from Kalker's table on ellipses"
    )
    TARGET.write_text(json.dumps({"about": about, "check": check, "cases": cases}, indent=1) + "\n")


if __name__ == "__main__":
    main()
