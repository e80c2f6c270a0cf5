"""What `Solution.gap_error` promises: hits and false alarms on random patches against the element-wise half space.

python benchmarks/gap_error.py [--cases 3000]: half a minute. docs/check/limits.md has the result.

A case is a patch of a random pose of one of four pairs of standard profiles: lateral position -6 to 8 mm, yaw up to 30 mrad in
every second case, load 10 to 200 kN. The separation is solved under its load by each method and by 60 × 60 elements.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import product

import numpy as np

import contact
from benchmarks.tables import read_options, table
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose

METHODS = ("strip_halfspace", "analyn")
PAIRS = tuple(product(("s1002", "eps"), (("60E1", "1:40"), ("60E2", "1:20"))))
WRONG = 0.05, 0.1, 0.2  # errors of the largest pressure that an alarm should find
LIMITS = 0.01, 0.02, 0.03, 0.05, 0.08, 0.13, 0.17, 0.25


def cases(n: int) -> Iterator[tuple[contact.Separation, float]]:
    """Yield separations and loads [N]."""
    rng = np.random.default_rng(29)
    pairs = [
        Pair(profile.load(wheel, "wheel"), profile.load(rail, "rail", inclination=slope))
        for wheel, (rail, slope) in PAIRS
    ]
    while n > 0:
        pair, yawed = pairs[rng.integers(len(pairs))], rng.random() < 0.5
        pose = Pose(y=rng.uniform(-6e-3, 8e-3), yaw=rng.uniform(-0.03, 0.03) * yawed)
        try:
            found = pair.contacts(pose, load=rng.uniform(10e3, 200e3))
        except ContactError:
            continue
        for patch in found[:n]:
            yield patch.separation, patch.load
            n -= 1


def errors(case: tuple[contact.Separation, float]) -> list[tuple[float, float, int]]:
    """Return for each method the error of the largest pressure [-], `gap_error` and the status."""
    separation, load = case
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        free = contact.Creepage(0.0, 0.0, 0.0)
        exact = contact.solve(separation, free, load=load, normal="halfspace", tangential="halfspace", throw=False)
        found = [contact.solve(separation, free, load=load, normal=name, throw=False) for name in METHODS]
    return [(one.max_pressure / exact.max_pressure - 1.0, one.gap_error, int(one.status)) for one in found]


def rows(found: np.ndarray) -> Iterator[list[str]]:
    """Yield for each limit the alarms, and for each error in `WRONG` those that are right over the patches so wrong."""
    error, gap = np.abs(found[:, 0]), found[:, 1]
    for limit in LIMITS:
        alarm = gap > limit
        hits = (f"{np.sum(alarm & (error > wrong))} of {np.sum(error > wrong)}" for wrong in WRONG)
        yield [f"{limit:g}", str(np.sum(alarm)), *hits, f"{error[~alarm].max():.3f}"]


def main() -> None:
    """Print a table for each method."""
    given = list(cases(read_options(__doc__, cases=3000).cases))
    with ProcessPoolExecutor() as pool:
        found = np.array(list(pool.map(errors, given, chunksize=8)))
    for k, name in enumerate(METHODS):
        error = np.abs(found[:, k, 0])
        quantiles = ", ".join(f"{v:.4f}" for v in (error.mean(), *np.quantile(error, (0.95, 0.99)), error.max()))
        print(f"\n{name}, {len(given)} patches: mean, 95 %, 99 %, largest error of the largest pressure {quantiles}\n")
        header = ["limit", "alarms", *(f"found of > {wrong:.0%} off" for wrong in WRONG), "largest error without alarm"]
        print(table(header, list(rows(found[:, k]))))


if __name__ == "__main__":
    main()
