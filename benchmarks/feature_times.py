"""Times of the features beside steady rolling, and their ratios to CONTACT's: part of `benchmarks/contact_features.py`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

import contact
import reference
from benchmarks.patches_of_sets import BOTH
from benchmarks.timing import least
from contact.friction import Friction
from contact.geometry import profile
from contact.geometry.flexible import WheelOffset
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.halfspace import Gap
from contact.pair import ContactDamping, ElasticRail, FrictionMemory, RollerRig, WheelRailPair
from contact.stress import SurfaceLoad, below, largest

Row = list[str]
MU = 0.3
#: CONTACT's times [ms] for the patch of `elements`: its default solver, and GDsteady by the ratio of another comparison.
DEFAULT = 2100.0
GDSTEADY = DEFAULT * 0.46 / 3.9


def _patch() -> tuple[Gap, contact.Separation, contact.Creepage]:
    """Return a real patch at 0.2 mm for which CONTACT's time is known (docs/check/halfspace.md)."""
    case = next(case for case in reference.patches() if case["name"] == "c40_dy+0_p1")
    x, y = (np.arange(v[0], v[-1] + 0.3, 0.2) * 1e-3 for v in (case["x_p"], case["y_p"]))
    separation = reference.separation_of(case)
    y = y[y < separation.y[-1] + 1e-9]
    g, A = (np.interp(y, separation.y, v) for v in (separation.g, separation.A))
    creepage = contact.Creepage(case["xi"][0], case["eta"][0], case["phi"][0] * 1e3)
    return Gap(x, y, g[:, None] + A[:, None] * x**2), separation, creepage


def elements() -> Iterator[Row]:
    """Yield the rows of the half space."""
    gap, separation, creepage = _patch()
    steady = contact.solve(gap, creepage, load=80e3, throw=False, **BOTH)
    spin = contact.Creepage(spin=creepage.spin)
    forces = 0.8 * steady.Fx, 0.8 * steady.Fy
    aluminium = contact.Material.from_pair(70e9, 0.33, 210e9, 0.28)
    given: dict[str, tuple[contact.Creepage, dict[str, Any]]] = {
        "creepages given": (creepage, {}),
        "both forces given": (spin, {"force": forces}),
        "unlike materials": (creepage, {"material": aluminium}),
        "third body, elastic": (creepage, {"layer": contact.ThirdBody(1e-13)}),
        "third body, plastic with hardening": (creepage, {"layer": contact.ThirdBody(1e-13, 2e8, 1e13)}),
    }
    for name, (motion, options) in given.items():
        task = partial(contact.solve, gap, motion, load=80e3, friction=MU, throw=False, **options, **BOTH)
        yield _row(name, least(task, 3))
    for name, conformal in (("plane, from a separation", False), ("bent surface", True)):
        options = {"conformal": conformal, "spacing": 0.2e-3}
        task = partial(contact.solve, separation, creepage, load=80e3, friction=MU, throw=False, **options, **BOTH)
        yield _row(name, least(task, 3))
    rolling = contact.Transient(gap, load=80e3, friction=MU)
    rolling.shift(-6e-6)
    yield _row("a step of transient rolling", least(partial(rolling.roll, creepage, distance=gap.dx), 10))
    load, z = SurfaceLoad.of(steady), np.linspace(0.0, 10e-3, 16)
    yield _row("stresses at 16 depths", least(partial(below, load, z, margin=0.0), 3))
    yield _row("largest von Mises stress, its place and depth", least(partial(largest, load), 3))


def _row(name: str, took: float) -> Row:
    return [name, f"{took:.0f}", f"{DEFAULT / took:.0f}, {GDSTEADY / took:.1f}"]


def pairs() -> Iterator[Row]:
    """Yield the rows of pairs on strips."""
    profiles = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
    poses = [Pose(y=1e-5 * k) for k in range(300, 340)]
    given: dict[str, dict[str, Any]] = {
        "a vertical force, rigid rail": {},
        "a vertical force, rail on springs": {"rail": ElasticRail(8e6, 5e7)},
        "a vertical force, flexible wheel": {"offset": WheelOffset(y=1e-4, yaw=1e-4)},
    }
    for name, options in given.items():
        yield [name, _each(partial(_series, WheelRailPair(profiles), poses, options), len(poses))]
    law = Friction(static=0.35, law="exponential", kinetic=0.15, half_speed=0.5)
    n = len(poses)
    motion = {"time": 1e-3 * np.arange(n), "pose.y": [pose.y for pose in poses], "load.normal_force": np.full(n, 8e4)}
    motion["velocity.x"] = np.full(n, 20.0)
    memory = {"memory": FrictionMemory(law, 0.01), "damping": ContactDamping(1e-4, 1e-4)}
    yield [
        "the same with friction memory and damping",
        _each(partial(WheelRailPair(profiles).run, motion, **memory), n),
    ]
    separation = profiles.contacts(poses[0], load=8e4)[0].separation
    task = partial(contact.solve, separation, contact.Creepage(), load=8e4, force=1e4)
    yield ["one patch, longitudinal force given", f"{least(task, 10):.2f}"]
    rig = RollerRig(profiles, 0.6)
    task = partial(rig.solve, poses[0], Velocity(10.0), vertical=6e4)
    yield ["a wheel on a roller under a vertical force, cold", f"{least(task, 10):.1f}"]


def _series(solver: WheelRailPair, poses: list[Pose], options: dict[str, Any]) -> None:
    for pose in poses:
        solver.solve(pose, vertical=8e4, **options)


def _each(task: Callable[[], Any], n: int) -> str:
    """Return the time [ms] of one of the `n` solutions of a task."""
    return f"{least(task, 3) / n:.2f}"
