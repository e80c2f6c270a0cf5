"""Strips with `conformal=True` against conformal elements, by the change of the contact angle over the patch.

python benchmarks/bend.py: a minute; result: docs/check/limits.md. Patches of random poses of S1002 on 60E1, and of a ball
(radius 8 to 30 mm) in a groove, with random loads and creepages.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise

import numpy as np

import contact
from benchmarks.tables import table
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose

BOUNDS = 0, 10, 23, 35, 50, 90  # [deg]
MU = 0.3
Case = tuple[contact.Separation, float, contact.Creepage]


def rails(rng: np.random.Generator, n: int) -> Iterator[tuple[contact.Separation, float]]:
    """Yield separations and loads of patches on n poses of a wheel on a rail."""
    pairs = [Pair(profile.s1002(), profile.rail_60e1(inclination=slope)) for slope in (1 / 40, 1 / 20)]
    for _ in range(n):
        pose = Pose(y=rng.uniform(3e-3, 7.5e-3), yaw=rng.uniform(-0.02, 0.02) * (rng.random() < 0.5))
        try:
            found = pairs[rng.integers(2)].contacts(pose, load=rng.uniform(2e4, 2e5))
        except ContactError:
            continue
        yield from ((patch.separation, patch.load) for patch in found)


def grooves(rng: np.random.Generator, n: int) -> Iterator[tuple[contact.Separation, float]]:
    """Yield separations and loads of n balls in grooves."""
    turn = np.linspace(-1.2, 1.2, 241)
    for _ in range(n):
        ball = rng.uniform(8e-3, 30e-3)
        groove, y = ball * rng.uniform(1.005, 1.2), ball * np.sin(turn)
        gap = ball - ball * np.cos(turn) - (groove - np.sqrt(groove**2 - y**2))
        yield contact.Separation(y, gap, 1.1, tilt=np.tan(turn)), rng.uniform(5e3, 1.5e5)


def difference(case: Case) -> tuple[float, float, float]:
    """Return the change of the contact angle [rad], and the differences of force over μN and of the largest pressure."""
    separation, load, creepage = case
    given = {"load": load, "friction": MU, "conformal": True, "throw": False}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        strips = contact.solve(separation, creepage, **given)
        elements = contact.solve(separation, creepage, normal="halfspace", tangential="halfspace", **given)
    if max(strips.status, elements.status) > contact.Status.SATURATED:
        return float("nan"), 0.0, 0.0
    away = np.hypot(strips.Fx - elements.Fx, strips.Fy - elements.Fy) / (MU * load)
    return strips.bend, float(away), abs(strips.max_pressure / elements.max_pressure - 1.0)


def main() -> None:
    """Print the table."""
    rng = np.random.default_rng(29)
    spans = np.array([2e-3, 2e-3, 0.5])
    cases = [
        (separation, load, contact.Creepage(*rng.uniform(-spans, spans)))
        for separation, load in (*rails(rng, 400), *grooves(rng, 200))
    ]
    with ProcessPoolExecutor() as pool:
        found = np.array(list(pool.map(difference, cases, chunksize=8)))
    degrees, rows = np.degrees(found[:, 0]), []
    for low, high in pairwise(BOUNDS):
        chosen = found[(degrees >= low) & (degrees < high)]
        figures = (f"{np.median(e):.4f} / {e.max():.4f}" for e in chosen.T[1:])
        rows.append([f"{low} to {high}°", str(len(chosen)), *figures])
    print(table(["change of the angle", "patches", "force over μN, median / largest", "largest pressure"], rows))


if __name__ == "__main__":
    main()
