"""Interpolation error of the table of creep forces on random cases, against the half space.

    python benchmarks/creep_table.py [--cases 300] [--write reference/creep_table_unseen.csv]

The ratio a/b is log-uniform within the table. The direction in the table's coordinates is uniform on the sphere. The size r is
log-uniform from .05 to 20.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from benchmarks.tables import read_options
from contact.theory import force_table as table
from contact.theory import kalker
from reference.unseen import LOAD, MATERIAL, MU, C, errors, solve

#: Elements of the half space across each axis.
ELEMENTS = 60


def random_case(rng: np.random.Generator) -> tuple[float, float, float, float]:
    """Return a/b and the creepages [-], [-], [1/m]."""
    log_aspect = rng.uniform(table.LOG_ASPECT_MIN, -table.LOG_ASPECT_MIN)  # a/b from .1 to 10
    c11, c22, c23, _ = kalker.coefficients(kalker.table(table.NU), log_aspect)
    x, y, z = rng.normal(size=3)
    unit = 10 ** rng.uniform(math.log10(0.05), math.log10(20.0)) / math.sqrt(x * x + y * y + z * z)
    unit *= MU * LOAD / (MATERIAL.shear_modulus * C * C)
    spin = z / table.spin_weight(log_aspect, c11, c22, c23)
    return math.exp(log_aspect), unit * x / c11, unit * y / c22, unit * spin / (c23 * C)


def main() -> None:
    arguments = read_options(__doc__, cases=300, seed=1, write=Path)
    rng = np.random.default_rng(arguments.seed)
    cases = np.array([random_case(rng) for _ in range(arguments.cases)])
    true = np.array([solve(*case, tangential="halfspace", n=ELEMENTS) for case in cases])
    if arguments.write:
        lines = [
            ",".join([*(f"{v:.7g}" for v in c), *(f"{v:.5f}" for v in t)]) for c, t in zip(cases, true, strict=True)
        ]
        heading = (
            f"# Random ellipses and creepages by our half space (TANG on Hertz's pressure, {ELEMENTS} x {ELEMENTS} elements), "
            f"seed {arguments.seed}:\n# benchmarks/creep_table.py; forces over mu N, moment over mu N c\n"
            "a_over_b,longitudinal,lateral,spin,fx,fy,mz,slip\n"
        )
        arguments.write.write_text(heading + "\n".join(lines) + "\n")
    for method in ("table", "fastrip", "fastrip_mapped", "polach"):
        for name, values in errors(cases, true, method).items():
            print(
                f"{method} {name}: mean {values.mean():.4f}, p95 {np.percentile(values, 95):.4f}, max {values.max():.4f}"
            )


if __name__ == "__main__":
    main()
