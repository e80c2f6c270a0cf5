"""Accuracy of every normal method against CONTACT's half-space solution on real patches: docs/check/normal_methods.md.

python benchmarks/normal_methods.py [--write docs/check/normal_methods.md]
"""

from __future__ import annotations

import numpy as np

import contact
import reference
from benchmarks.tables import table, tell
from reference import accuracy


def row(method: str, by_load: bool) -> list[str]:
    e = accuracy.errors_of_normal(method, by_load)
    first = "approach" if by_load else "N"
    cells = [100 * np.abs(e[k]) for k in (first, "pmax", "area", "L2")]
    return [f"`{method}`", *(f"{c.mean():.1f} ({c.max():.0f})" for c in cells)]


def report() -> dict[str, str]:
    """Return the tables of the page as Markdown."""
    normal = list(contact.methods().batched.normal)
    approach, load = ([row(m, by_load) for m in normal] for by_load in (False, True))
    heading = ["max pressure", "area", "pressure L2"]
    own, theirs = accuracy.errors_of_normal("kpec"), accuracy.published_on_patches("kpec_fastsim")
    kpec = [
        [case["name"], *(f"{100 * own[k][i]:.1f} / {100 * theirs[k][i]:.1f}" for k in ("N", "pmax", "area", "L2"))]
        for i, case in enumerate(reference.patches())
    ]
    return {
        "approach": table(["method", "N", *heading], approach),
        "load": table(["method", "approach", *heading], load),
        "kpec": table(["patch", "N", *heading], kpec),
    }


if __name__ == "__main__":
    tell(report, __doc__)
