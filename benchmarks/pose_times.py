"""Print the distribution of computing times over poses of a wheelset: what a real-time host has to expect (`make bench`).

    python benchmarks/pose_times.py [--poses 10000]

A pose is a random lateral position, yaw, roll and load of S1002 on 60E1. Its time is the sum over its patches, the least of
three runs. A second table has rough and flat gaps, which no profile has, with three caps of the iterations: the worst case.
The normal problem is timed with a creep force law that takes next to no time: cold, when no call starts from
another one, and warm, when the call is repeated. The whole contact is timed with the default methods. The last table has
whole pairs, with their search.
"""

from __future__ import annotations

import time
from functools import partial

import numpy as np

import contact
from benchmarks.tables import read_options, table
from benchmarks.timing import least
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Patch, Pose, Velocity
from contact.kernels.normal.strip_halfspace import MAX_ITERATIONS
from contact.pair import WheelRailPair
from reference.random_cases import nearly_flat, noisy, two_lobed

REPEATS = 3


def poses(count: int) -> list[list[Patch]]:
    """Return the patches of `count` random poses."""
    rng = np.random.default_rng(3)
    pair = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
    found = []
    while len(found) < count:
        pose = Pose(y=rng.uniform(-8e-3, 8e-3), yaw=rng.uniform(-10e-3, 10e-3), roll=rng.uniform(-5e-3, 5e-3))
        found.append([patch for patch in pair.contacts(pose, load=10 ** rng.uniform(4.3, 5.2)) if patch.load])
    return found


def count_of(patch: Patch) -> int:
    """Return the number of separate patches that the default method finds in a contact plane."""
    return contact.solve(patch.separation, patch.creepage, load=patch.load, throw=False).n_patches


def seconds(solver: contact.Solver, patches: list[Patch], warm: bool) -> float:
    """Return the least time that the patches of a pose take together."""
    total = 0.0
    for patch in patches:
        solver.forget()
        call = partial(solver.forces, patch.separation, patch.creepage, load=patch.load, warm=warm)
        total += 1e-3 * least(call, REPEATS + warm, clock=time.perf_counter)
    return total


def of_rough_gaps(count: int) -> str:
    """Return the table of the worst case: gaps with noise, nearly flat ones and two lobes, for three caps of the iterations."""
    rng = np.random.default_rng(5)
    gaps = [family(rng) for _ in range(count) for family in (noisy, nearly_flat, two_lobed)]
    rows = []
    for cap in (MAX_ITERATIONS, MAX_ITERATIONS // 2, MAX_ITERATIONS // 4):
        solver, times, missed = contact.Solver(max_iterations=cap), [], 0
        for gap in gaps:
            call = partial(solver.forces, gap, contact.Creepage(1e-3), load=80e3)
            times.append(1e3 * least(call, REPEATS, clock=time.perf_counter))
            missed += call().status == contact.Status.NOT_CONVERGED
        rows.append([f"{cap}", *(f"{v:.0f}" for v in (*np.percentile(times, [50, 99]), max(times)))])
        rows[-1].append(f"{missed / len(gaps):.1%}")
    head = f"\n{len(gaps)} rough, nearly flat and two-lobed gaps, default methods, cold, µs\n"
    return "\n".join((head, table(["max_iterations", "median", "99 %", "longest", "NOT_CONVERGED"], rows)))


def of_pairs(count: int) -> str:
    """Return the table of `WheelRailPair.solve`: search, forces and damage of `count` poses, one after the other.

    Cold, `forget` is called before each pose.
    """
    one, velocity = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))), Velocity(20.0)
    sides = np.linspace(-4e-3, 6e-3, count)
    found = [Pose(y=y, z=one.solve(Pose(y=y), velocity, load=80e3).z) for y in sides]
    rows = []
    for title, given in (("height given", {}), ("load", {"load": 80e3}), ("vertical", {"vertical": 80e3})):
        for start in ("warm", "cold"):
            times = np.full(count, np.inf)
            for _ in range(REPEATS):
                for k, pose in enumerate(found):
                    if start == "cold":
                        one.forget()
                    begin = time.perf_counter()
                    one.solve(pose, velocity, **given)
                    times[k] = min(times[k], 1e6 * (time.perf_counter() - begin))
            rows.append(
                [f"{title}, {start}", *(f"{v:.0f}" for v in (*np.percentile(times, [50, 95, 99.9]), times.max()))]
            )
    head = f"\n`WheelRailPair.solve` from Python, default, {count} poses from -4 to 6 mm, 80 kN, µs\n"
    return "\n".join((head, table(["what", "median", "95 %", "99.9 %", "longest"], rows)))


def main() -> None:
    """Print the tables."""
    found = poses(read_options(__doc__, poses=10_000).poses)
    several = np.array([sum(count_of(patch) for patch in patches) for patches in found])
    rows = []
    for title, options, warm in (
        ("`analyn`, normal problem", {**contact.THESIS, "tangential": "linear_saturated"}, False),
        ("`strip_halfspace`, normal problem, cold", {"tangential": "linear_saturated"}, False),
        ("`strip_halfspace`, normal problem, warm", {"tangential": "linear_saturated"}, True),
        ("`analyn` + `fastrip`, 30 × 20", {**contact.THESIS, "n_elements": 20}, False),
        ("default, cold", {}, False),
        ("default, warm", {}, True),
    ):
        solver = contact.Solver(**options)
        times = 1e6 * np.array([seconds(solver, patches, warm) for patches in found])
        rows.append([title, *(f"{v:.0f}" for v in (*np.percentile(times, [50, 95, 99.9]), times.max()))])
        rows[-1].append(f"{np.mean(times[several > 1]):.0f}" if np.any(several > 1) else "-")
    print(
        f"{len(found)} poses, {np.mean(several > 1):.0%} of them with several patches; times in µs with the call from Python\n"
    )
    print(table(["what", "median", "95 %", "99.9 %", "longest", "mean with several patches"], rows))
    print(of_rough_gaps(500))
    print(of_pairs(400))


if __name__ == "__main__":
    main()
