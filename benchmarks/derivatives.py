"""Derivatives of forces against differences, and their price (docs/derivatives.md).

python -m benchmarks.derivatives [--cases 300] [--pairs 60] [--out kinks.png]

Random patches and poses of S1002 on 60E1. The wanted value is a central difference of closely iterated solutions with Richardson's
extrapolation of two steps. Where the two steps disagree, the force has a kink within the step, or noise, and no derivative is known.
"""

from __future__ import annotations

import argparse
import dataclasses
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity, contacts
from contact.pair import WheelRailPair

Array = NDArray[np.float64]

SPEED, RADIUS, FRICTION = 20.0, 0.460, 0.3
#: Disagreement of two central differences, over the largest slope of the column, above which no derivative is known.
DOUBT = 2e-4
#: Error that counts as right.
RIGHT = 1e-3
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


def made() -> WheelRailPair:
    """Return the pair."""
    return WheelRailPair(Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40)))


def of_pairs(n: int, rng: np.random.Generator) -> list[dict[str, Any]]:
    """Return error, disagreement and state of every column of `n` random poses."""
    pair, close, found = made(), made(), []
    close.bench.case["tolerance"] = 1e-10
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
            record, member = name.split(".")
            # a step on the flange changes the gap as much as one of the height
            step = step / max(1.0, np.tan(flange) * 10.0) if name == "pose.y" else step

            def at(h: float, record: str = record, member: str = member) -> Array:
                moved = {"pose": pose, "velocity": velocity}
                moved[record] = dataclasses.replace(moved[record], **{member: getattr(moved[record], member) + h})
                close.forget()
                there = close.solve(**moved, friction=FRICTION)
                return np.array([*there.force, *there.moment, there.z])

            wanted, doubt = richardson(at, step, unit)
            got = one.jacobian.values[:, one.jacobian.columns.index(name)]
            size = np.abs(wanted / unit).max()
            found.append(
                {
                    "name": name,
                    "error": float(np.abs((got - wanted) / unit).max() / size) if size > 0.0 else 0.0,
                    "doubt": doubt,
                    "y": pose.y,
                    "yaw": pose.yaw,
                    "used": one.used_friction / FRICTION,
                    "patches": len(one.contacts),
                    "angle": flange,
                    "sided": name in one.jacobian.one_sided,
                }
            )
    return found


def of_patches(n: int, rng: np.random.Generator) -> list[dict[str, Any]]:
    """Return the same for `n` random patches, by creepages, load and friction."""
    wheel, rail, found = profile.s1002(), profile.rail_60e1(inclination=1 / 40), []
    solver = contact.Solver(friction=FRICTION)
    while len({row["case"] for row in found}) < n:
        pose, velocity, load = draw(rng)
        patch = max(contacts(wheel, rail, pose, velocity, load=load), key=lambda each: each.load or 0.0)
        separation, creepage, load = patch.separation, patch.creepage, patch.load or load
        at = np.array([creepage.longitudinal, creepage.lateral, creepage.spin, load, FRICTION])
        one = solver.forces(separation, creepage, load=load, friction=FRICTION, derivatives=True)
        if one.status in (contact.Status.NOT_CONVERGED, contact.Status.OUT_OF_RANGE) or one.jacobian is None:
            continue
        unit = np.array([1.0, 1.0, 5e-3, 1.0, 1e-9])
        case = len(found)
        for j, (name, step) in enumerate(zip(one.jacobian.columns, (4e-9, 4e-9, 4e-6, 1e-3 * load, 4e-7), strict=True)):

            def forces(h: float, j: int = j) -> Array:
                there = at.copy()
                there[j] += h
                given = contact.Creepage(*there[:3])
                made = solver.forces(separation, given, load=there[3], friction=there[4], derivatives=True)
                return np.array([made.Fx, made.Fy, made.Mz, made.N, made.approach])

            wanted, doubt = richardson(forces, step, unit)
            got = one.jacobian.values[:5, j]
            size = np.abs(wanted / unit).max()
            found.append(
                {"name": name, "error": float(np.abs((got - wanted) / unit).max() / size), "doubt": doubt, "case": case}
            )
    return found


def table(title: str, rows: list[dict[str, Any]]) -> None:
    """Print the shares of kinks and of right columns, and the errors."""
    print(
        f"\n{title}: column, cases, kink or noise within the step; error of the others: median, 95 %, largest, within {RIGHT:g}"
    )
    for name in dict.fromkeys(row["name"] for row in rows):
        of = [row for row in rows if row["name"] == name]
        known = np.array([row["error"] for row in of if row["doubt"] <= DOUBT])
        share = 1.0 - known.size / len(of)
        if known.size:
            print(
                f"{name:18} {len(of):5} {share:6.1%}   {np.median(known):.1e} {np.percentile(known, 95):.1e} "
                f"{known.max():.1e} {np.mean(known < RIGHT):6.1%}"
            )


def prices(n: int, rng: np.random.Generator) -> None:
    """Print the times of forces and of forces with derivatives, one after the other, all from nothing."""
    pair, solver = made(), contact.Solver(friction=FRICTION)
    of_pair, of_patch = [], []
    for _ in range(n):
        pose, velocity, load = draw(rng)
        pair.forget()
        found = pair.solve(pose, velocity, load=load, friction=FRICTION)
        height = dataclasses.replace(pose, z=found.z)

        def spent(call: Callable[[], Any], forget: bool = True) -> float:
            best = np.inf
            for _ in range(9):
                if forget:
                    pair.forget()
                begun = time.perf_counter()
                call()
                best = min(best, time.perf_counter() - begun)
            return 1e6 * best

        given = pair.pair.given(height, velocity)
        code = lambda: pair.solve_given(0, 0.0, given)  # noqa: E731
        derive = lambda: (pair.solve_given(0, 0.0, given), pair._derive(0, given, None, None, None))  # noqa: E731
        under = lambda asked: pair.solve(pose, velocity, load=load, friction=FRICTION, derivatives=asked)  # noqa: E731
        of_pair.append((spent(code), spent(derive), spent(lambda: under(False)), spent(lambda: under(True))))
        patch = max(pair.pair.contacts(pose, velocity, load=load), key=lambda each: each.load or 0.0)
        asked = lambda which: solver.forces(patch.separation, patch.creepage, load=patch.load, derivatives=which)  # noqa: E731
        of_patch.append((spent(lambda: asked(False), False), spent(lambda: asked(True), False)))
    for name, times in (
        ("pair at a height", np.array(of_pair)[:, :2]),
        ("pair under a load", np.array(of_pair)[:, 2:]),
        ("patch", np.array(of_patch)),
    ):
        ratio = times[:, 1] / times[:, 0]
        low, high = np.median(times, axis=0)
        print(f"{name:20} {low:7.0f} {high:7.0f} µs   ratio: median {np.median(ratio):.2f}, largest {ratio.max():.2f}")


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
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--pairs", type=int, default=60)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args(arguments)
    rng = np.random.default_rng(1)
    prices(60, rng)
    table("patches", of_patches(options.cases, rng))
    rows = of_pairs(options.pairs, rng)
    table("pairs", rows)
    if options.out:
        draw_kinks(rows, options.out)


if __name__ == "__main__":
    main()
