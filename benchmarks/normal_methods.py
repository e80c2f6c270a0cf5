"""Accuracy of every normal method against CONTACT's half-space solution on real patches: docs/check/normal_methods.md.

python benchmarks/normal_methods.py [--write docs/check/normal_methods.md]
"""

from __future__ import annotations

import numpy as np

import contact
import reference
from benchmarks.tables import table, tell
from reference import accuracy

TEXT = """# Comparison of normal methods

Written by `make accuracy` (`benchmarks/normal_methods.py`). The reference is the half-space solution of CONTACT 25.1 for {n}
patches of S1002 on UIC60 (reference/patches.json). Numbers are mean (worst) absolute errors in per cent. L2 is
‖p − p_ref‖/‖p_ref‖.

## The same approach

This is the case of a simulation with a prescribed height of the wheelset.

{approach}
## The same load

This is the case of a simulation with a prescribed wheel load.

{load}
## Elliptic contact: patch and load of each method

| method | patch on an ellipse A, B | load on it |
| --- | --- | --- |
| `analyn`, `hertz`, `strip_halfspace`, `stripes_a`, `kpec`, `multi_hertz`, `pascal_sauvage` | Hertz's | Hertz's |
| `kik_piotrowski`, `linder` | a = √(0.55 δ/A), b = √(0.55 δ/B) | displacement of the centre is δ |
| `kik_piotrowski_2008` | the same area, a/b Hertz's | displacement of the centre is δ |
| `stripes_ab` | a Hertz's, b = √(ε δ/B) | Hertz's strip loads |
| `srst` | a = √(δ/2A), b = √(δ/2B) | Hertz's |
| `winkler` | a = √(δ/A), b = √(δ/B) | Hertz's |
| `semi_winkler` | Hertz's for A = B; area within 7 % for a/b from 0.2 to 6.5 | Hertz's |

The docstrings in `contact/kernels/normal` give equations and sources, and say what was recalled rather than read. All methods
pass strips with semi-elliptic pressure to the tangential methods. `winkler` and `semi_winkler` have another pressure along x.
It is replaced by the semi-ellipse of the same length and load, whose peak is 0.85 of Winkler's parabola (L2 difference 16 %).

The load of `kpec`, `multi_hertz`, `pascal_sauvage` and, by 0.8 %, `kik_piotrowski_2008` jumps where zones or ellipses appear
and disappear (`contact.methods()`: `continuous`). They are meant for comparison, not for time integration.

## KPEC compared with CONTACT's KPEC

Each cell has two errors in per cent, of our KPEC and of CONTACT's KPEC. The reference is CONTACT's half space at the same
approach.

{kpec}"""


def row(method: str, by_load: bool) -> list[str]:
    e = accuracy.errors_of_normal(method, by_load)
    first = "approach" if by_load else "N"
    cells = [100 * np.abs(e[k]) for k in (first, "pmax", "area", "L2")]
    return [f"`{method}`", *(f"{c.mean():.1f} ({c.max():.0f})" for c in cells)]


def report() -> str:
    """Return the page as Markdown."""
    normal = list(contact.methods().batched.normal)
    approach, load = ([row(m, by_load) for m in normal] for by_load in (False, True))
    heading = ["max pressure", "area", "pressure L2"]
    own, theirs = accuracy.errors_of_normal("kpec"), accuracy.published_on_patches("kpec_fastsim")
    kpec = [
        [case["name"], *(f"{100 * own[k][i]:.1f} / {100 * theirs[k][i]:.1f}" for k in ("N", "pmax", "area", "L2"))]
        for i, case in enumerate(reference.patches())
    ]
    return TEXT.format(
        n=len(reference.patches()),
        approach=table(["method", "N", *heading], approach),
        load=table(["method", "approach", *heading], load),
        kpec=table(["patch", "N", *heading], kpec),
    )


if __name__ == "__main__":
    tell(report, __doc__)
