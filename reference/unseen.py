"""Errors of interpolated creep forces on random ellipses that are not in the table of creep forces.

`benchmarks/creep_table.py` draws the cases and solves them with the half space. `reference.unseen_ellipses` loads them.
"""

from __future__ import annotations

import numpy as np

import contact
from contact.study.ellipse import ellipse
from contact.theory import force_table as table

MATERIAL, LOAD, MU, C = contact.Material(82e9, table.NU), 82e3, 0.3, 6e-3


def solve(a_over_b: float, *creepage: float, tangential: str, n: int = 40) -> np.ndarray:
    """Return Fx and Fy over mu N, Mz over mu N c and the share of slip."""
    sol = contact.solve(
        ellipse(a_over_b, C, LOAD, MATERIAL), contact.Creepage(*creepage), load=LOAD, friction=MU, material=MATERIAL,
        normal="hertz", tangential=tangential, n_strips=n, n_elements=n,
    )  # fmt: skip
    return np.array([sol.Fx, sol.Fy, sol.Mz / C, MU * LOAD * sol.slip_ratio]) / (MU * LOAD)


def errors(cases: np.ndarray, true: np.ndarray, tangential: str = "table") -> dict[str, np.ndarray]:
    """Return the errors of force, moment and share of slip."""
    d = np.array([solve(*case, tangential=tangential) for case in cases]) - true
    return {"force": np.hypot(d[:, 0], d[:, 1]), "moment": np.abs(d[:, 2]), "slip": np.abs(d[:, 3])}
