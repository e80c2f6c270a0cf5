"""Functions of earlier versions, until 1.0: what they did are now arguments and methods of the pairs."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from contact.geometry.records import Pose, Velocity
from contact.pair.halfspace import HalfspacePair
from contact.pair.motion import PairRun
from contact.pair.solution import PairSolution
from contact.pair.wheel_rail import WheelRailPair


class Driven(NamedTuple):
    """What `drive` returned."""

    solution: PairSolution
    spin: float


def drive(pair: WheelRailPair, pose: Pose, velocity: Velocity, **options: Any) -> Driven:
    """Return ``pair.solve(pose, velocity, force=… or torque=…, …)`` and its `spin` [rad/s]."""
    _now("drive", "WheelRailPair.solve(…, force=…) or torque=…")
    found = pair.solve(pose, velocity, **options)
    return Driven(found, found.spin)


def over_time(pair: WheelRailPair, motion: Any, **options: Any) -> PairRun:
    """Return ``pair.run(motion, …)``."""
    _now("over_time", "WheelRailPair.run")
    return pair.run(motion, **options)


def passage(
    solver: WheelRailPair | HalfspacePair,
    stations: ArrayLike | Sequence[float],
    pose: Pose | None = None,
    velocity: Velocity | None = None,
    *,
    rotation: float = 0.0,
    friction: Any = 0.3,
    **given: Any,
) -> PairRun:
    """Return ``solver.run({"station": …, …})``; `given` is a load, a penetration or a vertical force."""
    _now("passage", 'run({"station": …})')
    pose, velocity = pose or Pose(), velocity or Velocity()
    motion: dict[str, Any] = {"station": stations, "pose.y": pose.y, "pose.z": pose.z, "pose.roll": pose.roll}
    motion |= {"pose.yaw": pose.yaw, "velocity.x": velocity.forward}
    motion |= {f"velocity.{name}": getattr(velocity, name) for name in ("y", "z", "roll", "yaw")}
    motion |= {} if velocity.spin is None else {"velocity.spin": velocity.spin}
    motion |= {name: value for name, value in given.items() if value is not None}
    return solver.run(motion, rotation=rotation, friction=friction)


def _now(earlier: str, now: str) -> None:
    warnings.warn(f"contact.pair.{earlier} is now {now}", DeprecationWarning, stacklevel=3)
