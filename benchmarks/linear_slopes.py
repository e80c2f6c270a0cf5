"""Slopes of forces and moment at vanishing creepage on the real patches, computed by boundary elements in full adhesion.

    python benchmarks/linear_slopes.py        # writes reference/linear_slopes.json; some minutes

This is Kalker's linear theory on the patch of `strip_halfspace`. Every particle sticks, so the displacement of
constant-traction elements follows the rigid creep, u(x) - u(x + dx) = -w dx (theory.md 6). `check` compares the same
computation on ellipses with Kalker's table.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable

import numpy as np

import contact
import reference
from contact.halfspace import linear
from contact.study.ellipse import ellipse
from contact.theory import kalker

TARGET = reference.FOLDER / "linear_slopes.json"
Array = np.ndarray


def extrapolated(solve: Callable[[int], contact.Solution]) -> Array:
    """Return the slopes (rows: creepages, columns: forces), extrapolated from 16 and 24 strips and elements."""

    def at(n: int) -> Array:
        sol = solve(n)
        return linear.slopes(sol.strips, sol.material, n)

    return linear.extrapolated(at, 16, 24)


def kalker_error(aspect: float) -> dict[str, float]:
    """Return the relative deviation of C11, C22, C23, C33 from the published table on an ellipse."""
    c, separation = 5e-3, ellipse(aspect, 5e-3, 5e4)
    s = extrapolated(lambda n: contact.solve(separation, contact.Creepage(), load=5e4, n_strips=n))
    G = reference.STEEL.shear_modulus
    own = (-s[0, 0] / (G * c**2), -s[1, 1] / (G * c**2), -s[2, 1] / (G * c**3), -s[2, 2] / (G * c**4))
    table = kalker.coefficients(kalker.table(0.28), math.log(aspect))
    return {n: round(float(o / t - 1), 4) for n, o, t in zip(("C11", "C22", "C23", "C33"), own, table, strict=True)}


def digits(values: Array, n: int = 5) -> list[float]:
    """Return numbers rounded to n significant digits."""
    return [float(f"{v:.{n}g}") for v in values]


def main() -> None:
    cases = []
    for case in reference.patches():
        separation = reference.separation_of(case)

        def solve(
            n: int, separation: contact.Separation = separation, delta: float = case["delta"] * 1e-3
        ) -> contact.Solution:
            return contact.solve(
                separation,
                contact.Creepage(),
                approach=delta,
                normal="strip_halfspace",
                material=reference.STEEL,
                n_strips=n,
            )

        cases.append({"name": case["name"], "slopes": [digits(row) for row in extrapolated(solve)]})
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
