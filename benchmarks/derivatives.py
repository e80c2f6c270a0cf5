"""Derivatives of forces against differences, and their price (docs/check/derivatives.md).

python -m benchmarks.derivatives [--cases 300] [--pairs 60] [--out kinks.png]

Random patches and poses of S1002 on 60E1. The wanted value is a central difference of closely iterated solutions with
Richardson's extrapolation of two steps. Where the two steps disagree, the force has a kink within the step, or noise, and no
derivative is known. The derivatives are those of a solution with the default tolerance, 1e-4, and again of a closely iterated
one, which leaves the error of the derivatives themselves.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import contact
from benchmarks.tables import read_options
from benchmarks.timing import least
from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity, contacts
from contact.pair import WheelRailPair

SPEED, RADIUS, FRICTION = 20.0, 0.460, 0.3
#: Disagreement of two central differences, over the largest slope of the column, above which no derivative is known.
DOUBT = 2e-4
#: Error that counts as right, and that of the issue.
RIGHT, GOAL = 1e-3, 1e-4
#: Tolerance of closely iterated solutions.
CLOSE = 1e-10
POSES = {"pose.y": 4e-7, "pose.z": 4e-8, "pose.roll": 4e-8, "pose.yaw": 4e-7}
VELOCITIES = {"velocity.y": 2e-7, "velocity.yaw": 2e-7, "velocity.spin": 2e-7}


def richardson(of: Callable[[float], Array], step: float, unit: Array) -> tuple[Array, float]:
    """Return the derivative of `of` at 0, and the disagreement of both steps over the largest slope in units."""
    half, whole = ((of(h) - of(-h)) / (2.0 * h) for h in (0.5 * step, step))
    size = np.abs(half / unit).max()
    return (4.0 * half - whole) / 3.0, float(np.abs((half - whole) / unit).max() / size) if size > 0.0 else 0.0


def draw(rng: np.random.Generator) -> tuple[Pose, Velocity, float]:
    """Return a random pose, velocity and load."""
    pose = Pose(y=rng.uniform(-5e-3, 7.5e-3), roll=rng.uniform(-2e-3, 2e-3), yaw=rng.uniform(-1e-2, 1e-2))
    velocity = Velocity(
        SPEED,
        y=rng.uniform(-0.05, 0.05),
        yaw=rng.uniform(-0.02, 0.02),
        roll=rng.uniform(-0.02, 0.02),
        spin=-SPEED / RADIUS * (1.0 + rng.uniform(-2e-3, 2e-3)),
    )
    return pose, velocity, rng.uniform(30e3, 120e3)


def made(closely: bool = False) -> WheelRailPair:
    """Return the pair, which iterates closely or with the default tolerance."""
    pair = WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)))
    if closely:
        pair.arrays.case["tolerance"] = CLOSE
    return pair


def solver(closely: bool = False) -> contact.Solver:
    """Return the same for one contact."""
    made_solver = contact.Solver(friction=FRICTION)
    if closely:
        made_solver._case["tolerance"] = CLOSE
    return made_solver


def _at_pose(close: WheelRailPair, pose: Pose, velocity: Velocity, name: str) -> Callable[[float], Array]:
    """Return the forces as a function of what is added to one member of pose or velocity."""
    record, member = name.split(".")

    def at(h: float) -> Array:
        moved: dict[str, Any] = {"pose": pose, "velocity": velocity}
        moved[record] = dataclasses.replace(moved[record], **{member: getattr(moved[record], member) + h})
        close.forget()
        there = close.solve(**moved, friction=FRICTION)
        return np.array([*there.force, *there.moment, there.z])

    return at


def of_pairs(n: int, closely: bool) -> list[dict[str, Any]]:
    """Return error, disagreement and state of every column of `n` random poses."""
    rng, pair, close, found = np.random.default_rng(1), made(closely), made(True), []
    unit = np.array([1.0, 1.0, 1.0, 0.75, 0.75, 0.75, 1e-9])
    for _ in range(n):
        pose, velocity, load = draw(rng)
        pair.forget()
        pose = dataclasses.replace(pose, z=pair.solve(pose, velocity, load=load, friction=FRICTION).z)
        one = pair.solve(pose, velocity, friction=FRICTION, derivatives=True)
        if one.status in (contact.Status.NOT_CONVERGED, contact.Status.OUT_OF_RANGE) or one.jacobian is None:
            continue
        flange = max(abs(patch.angle) for patch in one.contacts)
        for name, step in (POSES | VELOCITIES).items():
            # a step on the flange changes the gap as much as one of the height
            step = step / max(1.0, np.tan(flange) * 10.0) if name == "pose.y" else step
            wanted, doubt = richardson(_at_pose(close, pose, velocity, name), step, unit)
            got = one.jacobian.values[:, one.jacobian.columns.index(name)]
            size = np.abs(wanted / unit).max()
            found.append(
                {
                    "name": name,
                    "error": float(np.abs((got - wanted) / unit).max() / size) if size > 0.0 else 0.0,
                    "doubt": doubt,
                    "y": pose.y,
                    "used": one.used_friction / FRICTION,
                }
            )
    return found


def _at_patch(own: contact.Solver, separation: contact.Separation, at: Array, j: int) -> Callable[[float], Array]:
    """Return the forces as a function of what is added to number j: a creepage, the load, or the friction."""

    def forces(h: float) -> Array:
        there = at.copy()
        there[j] += h
        given = contact.Creepage(*there[:3])
        found = own.forces(separation, given, load=there[3], friction=float(there[4]))
        return np.array([found.Fx, found.Fy, found.Mz, found.N, found.approach])

    return forces


def of_patches(n: int, closely: bool) -> list[dict[str, Any]]:
    """Return the same for `n` random patches, by creepages, load and friction."""
    wheel, rail, found, count = profile.s1002(), profile.rail_60e1(inclination=1 / 40), [], 0
    rng, own, close = np.random.default_rng(1), solver(closely), solver(True)
    unit = np.array([1.0, 1.0, 5e-3, 1.0, 1e-9])
    while count < n:
        pose, velocity, load = draw(rng)
        patch = max(contacts(wheel, rail, pose, velocity, load=load), key=lambda each: each.load or 0.0)
        separation, creepage, load = patch.separation, patch.creepage, patch.load or load
        at = np.array([creepage.longitudinal, creepage.lateral, creepage.spin, load, FRICTION])
        one = own.forces(separation, creepage, load=load, friction=FRICTION, derivatives=True)
        if one.status in (contact.Status.NOT_CONVERGED, contact.Status.OUT_OF_RANGE) or one.jacobian is None:
            continue
        count += 1
        for j, step in enumerate((4e-9, 4e-9, 4e-6, 1e-3 * load, 4e-7)):
            wanted, doubt = richardson(_at_patch(close, separation, at, j), step, unit)
            size = np.abs(wanted / unit).max()
            error = float(np.abs((one.jacobian.values[:5, j] - wanted) / unit).max() / size)
            found.append({"name": one.jacobian.columns[j], "error": error, "doubt": doubt})
    return found


def table(title: str, rows: list[dict[str, Any]]) -> None:
    """Print the shares of kinks and of right columns, and the errors."""
    print(
        f"\n{title}: column, cases, kink or noise within the step; error of the others: median, 95 %, largest, "
        f"within {RIGHT:g}, {GOAL:g}"
    )
    for name in dict.fromkeys(row["name"] for row in rows):
        of = [row for row in rows if row["name"] == name]
        known = np.array([row["error"] for row in of if row["doubt"] <= DOUBT])
        share = 1.0 - known.size / len(of)
        if known.size:
            print(
                f"{name:18} {len(of):5} {share:6.1%}   {np.median(known):.1e} {np.percentile(known, 95):.1e} "
                f"{known.max():.1e} {np.mean(known < RIGHT):6.1%} {np.mean(known < GOAL):6.1%}"
            )


def _prices_of(pair: WheelRailPair, own: contact.Solver, rng: np.random.Generator) -> list[float]:
    """Return the times of a pair at a height and under a load, and of a patch, each without and with derivatives [µs]."""
    pose, velocity, load = draw(rng)
    assert isinstance(pair.pair, Pair)
    pair.forget()
    found = pair.solve(pose, velocity, load=load, friction=FRICTION)
    given = pair.pair.given(dataclasses.replace(pose, z=found.z), velocity)
    patch = max(pair.pair.contacts(pose, velocity, load=load), key=lambda each: each.load or 0.0)

    def at_height(derivatives: bool) -> None:
        pair.solve_given(0, 0.0, given)
        if derivatives:
            pair._derive(0)

    def of_patch(derivatives: bool) -> None:
        own.forces(patch.separation, patch.creepage, load=patch.load, derivatives=derivatives)

    def under_load(derivatives: bool) -> None:
        pair.solve(pose, velocity, load=load, friction=FRICTION, derivatives=derivatives)

    calls = (at_height, under_load, of_patch)
    return [
        1e3 * least(partial(call, asked), 9, before=pair.forget, clock=time.perf_counter)
        for call in calls
        for asked in (False, True)
    ]


def prices(n: int, rng: np.random.Generator) -> None:
    """Print the times of forces and of forces with derivatives, one after the other, all from nothing."""
    pair, own = made(), solver()
    times = np.array([_prices_of(pair, own, rng) for _ in range(n)])
    for k, name in enumerate(("pair at a height", "pair under a load", "patch")):
        plain, derived = times[:, 2 * k], times[:, 2 * k + 1]
        ratio = derived / plain
        print(
            f"{name:20} {np.median(plain):7.0f} {np.median(derived):7.0f} µs   ratio: median {np.median(ratio):.2f}, "
            f"90 % {np.percentile(ratio, 90):.2f}, largest {ratio.max():.2f}"
        )


def draw_kinks(rows: list[dict[str, Any]], out: Path) -> None:
    """Draw where the columns of the poses have kinks, over the lateral position and the use of friction."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(POSES), figsize=(12, 3.4), sharey=True, layout="constrained")
    for name, axis in zip(POSES, axes, strict=True):
        of = [row for row in rows if row["name"] == name]
        for label, colour, chosen in (
            ("derivative as the difference", "0.6", [r for r in of if r["doubt"] <= DOUBT and r["error"] < RIGHT]),
            ("kink within the step", "tab:orange", [r for r in of if r["doubt"] > DOUBT]),
            ("off", "tab:red", [r for r in of if r["doubt"] <= DOUBT and r["error"] >= RIGHT]),
        ):
            axis.plot([1e3 * r["y"] for r in chosen], [r["used"] for r in chosen], ".", color=colour, label=label)
        axis.set_title(name)
        axis.set_xlabel("y [mm]")
    axes[0].set_ylabel("used friction")
    axes[0].legend(fontsize=7)
    figure.savefig(out, dpi=110)


def main(arguments: list[str] | None = None) -> None:
    """Print all tables."""
    given = read_options(__doc__, arguments, cases=300, pairs=60, out=Path)
    prices(60, np.random.default_rng(1))
    for closely, note in ((True, ", closely iterated"), (False, "")):
        table("patches" + note, of_patches(given.cases, closely))
        rows = of_pairs(given.pairs, closely)
        table("pairs" + note, rows)
    if given.out:
        draw_kinks(rows, given.out)


if __name__ == "__main__":
    main()
