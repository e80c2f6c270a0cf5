"""Solve random but physical contact cases with every pair of methods and report statuses and post-conditions.

    python benchmarks/robustness.py [--cases 100000] [--seed 1]

Every case is solved with `contact.forces`, one in fifty again with `contact.solve`, which also returns fields and iterations.
No case may raise, return NaN or violate a post-condition. The tables show the margins of the worst case, and how often what was
warned of: each of `contact.forces` speaks once for all its cases.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter

import contact
from benchmarks.tables import read_options, table
from reference import random_cases


def report(cases: int, seed: int) -> str:
    """Return tables of statuses and worst margins as Markdown."""
    pairs = random_cases.method_pairs()
    share = -(-cases // len(pairs))
    results, warned = {}, {}
    for k, pair in enumerate(pairs):
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter("always")
            results[pair] = random_cases.run(*pair, share, seed + k, share // 50)
        warned[pair] = Counter(re.split(r"\[| =", str(one.message))[0] for one in seen)
    names = [f"`{n}` + `{t}`" for n, t in pairs]
    first = table(
        ["methods", "cases", *(s.name for s in contact.Status), "most iterations (cap)"],
        [
            [
                name,
                str(r["cases"]),
                *(str(c) for c in r["statuses"].values()),
                f"{r['iterations']} ({random_cases.CAPS[p[0]]})",
            ]
            for name, (p, r) in zip(names, results.items(), strict=True)
        ],
    )
    second = table(
        ["methods", "not finite", "F/μN − 1", "power/μN", "slip ratio outside [0, 1]", "N/load − 1", "Σp dA/N − 1",
         "(q − μp)/μp0", "work of an element"],
        [
            [name, f"{r['finite']:.0f}", *(f"{r[k]:.1e}" for k in ("force", "power", "slip", "load", "sum", "bound", "work"))]
            for name, r in zip(names, results.values(), strict=True)
        ],
    )  # fmt: skip
    third = table(
        ["methods", *random_cases.KINDS],
        [
            [name, *(str(c) for c in r["not converged"].values())]
            for name, r in zip(names, results.values(), strict=True)
            if r["statuses"][contact.Status.NOT_CONVERGED]
        ],
    )
    kinds = sorted({kind for counted in warned.values() for kind in counted})
    fourth = table(
        ["methods", *(f"`{kind}`" for kind in kinds)],
        [[name, *(str(counted[kind]) for kind in kinds)] for name, counted in zip(names, warned.values(), strict=True)],
    )
    return "\n".join(
        (
            *(first, "Worst of all cases:\n", second, "Not converged, by kind of separation:\n", third),
            *("Warnings, by what they name:\n", fourth),
        )
    )


def main() -> None:
    arguments = read_options(__doc__, cases=100_000, seed=1)
    print(report(arguments.cases, arguments.seed))


if __name__ == "__main__":
    main()
