"""Errors of the tangential methods over the 3220 cases of Vollebregt, Iwnicki, Xie and Shackleton (docs/check/statistics.md).

    python -m benchmarks.statistics [--cases 200] [--write docs/check/statistics.md]        # all cases take minutes

Vehicle System Dynamics 50 (2012) 1-17: five ellipses, four spins, seven directions and twenty-three sizes of the creepage. The
numbers are those of the test bank of CONTACT 25.1 (test_table_mx11; Apache-2.0), as in theory.md 10:

    N = 82 kN,  G = 82 GPa,  nu = 0.28,  mu = 0.3,  c = √(ab),
    longitudinal + i lateral = m mu c/rho exp(i angle),   spin = chi mu/rho.

As in the source, the case without creepage (m = 0) is counted once for each direction. The half space is TANG on Hertz's
pressure; with 60 × 60 elements its forces differ from those with 120 by .004 mu N at most, .001 on average.
"""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

import contact
from benchmarks.tables import fill, read_options
from contact.arrays import Array
from contact.registry import methods
from contact.study.ellipse import ellipse
from contact.study.errors import mean_p95_max
from contact.study.pairs import RESOLUTION
from contact.study.table import Table, brief

LOAD, FRICTION, MATERIAL = 82e3, 0.3, contact.Material(shear_modulus=82e9, poisson_ratio=0.28)
#: a, b and rho, the length that makes creepages dimensionless [m].
ELLIPSES = 1e-3 * np.array([(4, 20, 1772), (6, 12, 2075), (9, 9, 2700), (12, 6, 2075), (20, 4, 1772)])
SPINS = 0.0, 0.5, 1.0, 2.0
ANGLES = range(-90, 91, 30)  # degrees
SIZES = np.array(
    [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9, 1.1, 1.4, 1.7, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9, 10, 12]
)  # fmt: skip
ELEMENTS = 60


class Cases(NamedTuple):
    """Index in `ELLIPSES`, spin and size of the creepage, creepages [-], [-], [1/m] as rows, and √(ab) [m] of each case."""

    ellipse: Any
    chi: Array
    size: Array
    creepage: Array
    c: Array

    def classes(self) -> dict[str, dict[str, Any]]:
        """Return kind of classes → name of a class → mask of its cases."""
        m = self.size
        return {
            "ellipse": {f"a/b = {a / b:g}": self.ellipse == k for k, (a, b, _) in enumerate(ELLIPSES)},
            "spin": {f"chi = {chi:g}": self.chi == chi for chi in SPINS},
            "creepage": {"m ≤ 0.5": m <= 0.5, "0.5 < m ≤ 2": (m > 0.5) & (m <= 2.0), "m > 2": m > 2.0},
        }


def design(cases: int | None = None) -> Cases:
    """Return all 3220 cases, or a random sample of `cases` of them. The sample is always the same, in the list's order."""
    shape = len(ELLIPSES), len(SPINS), len(ANGLES), len(SIZES)
    number = np.arange(np.prod(shape))
    if cases is not None:
        number = np.sort(np.random.default_rng(2012).permutation(number.size)[:cases])
    k, *places = np.unravel_index(number, shape)
    chi, angle, size = (np.array(values)[i] for values, i in zip((SPINS, ANGLES, SIZES), places, strict=True))
    a, b, rho = ELLIPSES[k].T
    c, turn = np.sqrt(a * b), np.radians(angle)
    creepage = size * FRICTION * c / rho * np.array([np.cos(turn), np.sin(turn)])
    return Cases(k, chi, size, np.stack((*creepage, chi * FRICTION / rho)), c)


def separation_of(k: int) -> contact.Separation:
    """Return the separation whose patch under the load is ellipse `k`."""
    a, b, _ = ELLIPSES[k]
    return ellipse(a / b, float(np.sqrt(a * b)), LOAD, MATERIAL)


def half_space(case: tuple[int, Any, int]) -> tuple[float, float, float]:
    """Return Fx, Fy and Mz of one case on n × n elements."""
    k, creepage, n = case
    s = contact.solve(
        separation_of(k), contact.Creepage(*creepage), load=LOAD, friction=FRICTION, material=MATERIAL,
        normal="hertz", tangential="halfspace", n_strips=n, n_elements=n,
    )  # fmt: skip
    return s.Fx, s.Fy, s.Mz


def reference_forces(d: Cases) -> Array:
    """Return Fx/(mu N), Fy/(mu N) and Mz/(mu N c) of the half space, shape (n, 3)."""
    jobs = [(int(k), tuple(w.tolist()), ELEMENTS) for k, w in zip(d.ellipse, d.creepage.T, strict=True)]
    with ProcessPoolExecutor() as pool:
        return scaled(d, np.array(list(pool.map(half_space, jobs, chunksize=20))))


def by_method(d: Cases, name: str) -> tuple[Array, float]:
    """Return the same by one method in `contact.forces`, and the time per case in one thread [s]."""
    found, spent = np.empty((d.c.size, 3)), 0.0
    options: dict[str, Any] = {"load": LOAD, "friction": FRICTION, "material": MATERIAL, "threads": 1}
    options |= {"normal": "hertz", "tangential": name, "n_strips": RESOLUTION, "n_elements": RESOLUTION}
    for k in np.unique(d.ellipse):
        mask, separation = d.ellipse == k, separation_of(k)
        contact.forces(separation, tuple(d.creepage[:, mask][:, :1]), **options)  # loads the kernels
        start = perf_counter()
        many = contact.forces(separation, tuple(d.creepage[:, mask]), **options)
        spent += perf_counter() - start
        found[mask] = np.stack((many.Fx, many.Fy, many.Mz), axis=1)
    return scaled(d, found), spent / d.c.size


def scaled(d: Cases, forces: Array) -> Array:
    """Return forces over mu N and moments over mu N c."""
    return forces / (FRICTION * LOAD * np.stack((np.ones_like(d.c), np.ones_like(d.c), d.c), axis=1))


def percent(value: float) -> str:
    """Return a share in per cent."""
    return f"{100.0 * value:.2f}" if value > 1e-12 else "0"


def tables(d: Cases, reference: Array) -> list[Table]:
    """Return tables of the errors over all cases, and of mean errors of the force by class."""
    whole, force_of = [], {}
    for name in methods().batched.tangential:
        forces, seconds = by_method(d, name)
        error = forces - reference
        force, moment = np.hypot(error[:, 0], error[:, 1]), np.abs(error[:, 2])
        force_of[name] = force
        whole.append([name, *map(percent, (*mean_p95_max(force), *mean_p95_max(moment))), brief(1e6 * seconds)])
    heads = [(f"{kind} {what}", "%") for kind in ("force", "moment") for what in ("mean", "95 %", "max")]
    caption = f"Errors over {d.c.size} cases: force of µN, moment of µN√(ab)"
    found = [Table(caption, [("method", ""), *heads, ("time", "µs")], whole)]
    for kind, classes in d.classes().items():
        heads = [(name, f"{mask.sum()} cases") for name, mask in classes.items() if mask.any()]
        masks = [mask for mask in classes.values() if mask.any()]
        rows = [[name, *(percent(float(force[mask].mean())) for mask in masks)] for name, force in force_of.items()]
        found.append(Table(f"Mean error of the force by {kind}, % of µN", [("method", ""), *heads], rows))
    return found


def main() -> None:
    """Print the tables, or write them into the page."""
    given = read_options(__doc__, cases=int, write=Path)
    d = design(given.cases)
    fill(given.write, {"tables": "\n\n".join(each.markdown() for each in tables(d, reference_forces(d))) + "\n"})


if __name__ == "__main__":
    main()
