"""Solve the contact patches that the options of the command line describe."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from contact.cli.document import in_effect
from contact.errors import ContactError, PlausibilityWarning
from contact.geometry.wheelset import Pair, Patch, Pose, Velocity
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.results import Solution
from contact.solve import solve

STANDARD_LOAD = 80e3  # load [N] if neither load nor penetration is given


@dataclass(frozen=True)
class Touch:
    """One solved contact patch; `side` and `patch` are None for a problem without wheel and rail."""

    solution: Solution
    side: str | None = None
    patch: Patch | None = None
    number: int = 1

    @property
    def name(self) -> str:
        """Name in tables and pictures. Patches are numbered from the field side to the flange."""
        return f"{self.side} {self.number}" if self.side else "patch"


@dataclass(frozen=True)
class Position:
    """A wheelset on its rails: the wheels to solve, pose and speed [m/s]."""

    wheels: Sequence[Pair]
    pose: Pose
    speed: float


def find_patches(case: Position, load: float | None, penetration: float | None) -> Iterator[tuple[str, int, Patch]]:
    """Yield side, number and record of every patch of the wheels. `load` [N] is the vertical load of each wheel."""
    load, velocity = standard_load(load, penetration), Velocity(forward=case.speed)
    for pair in case.wheels:
        found = pair.contacts(case.pose, velocity, load=load, penetration=penetration)
        pair.doubt(case.pose, velocity, load)
        for number, patch in enumerate(found, 1):
            yield pair.side, number, patch


def main_patch(case: Position, load: float) -> Patch:
    """Return the patch with the largest normal force of the first wheel under its vertical `load` [N]."""
    found = [patch for _, _, patch in find_patches(replace(case, wheels=case.wheels[:1]), load, None)]
    if not found:
        raise ContactError(f"load = {load:g}: the wheel does not touch its rail, so there is no creep curve")
    return max(found, key=lambda patch: patch.load or 0.0)


def amount_of(patch: Patch) -> dict[str, Any]:
    """Return the load of a patch if it was found from one, else its approach, as an argument of `solve`."""
    return {"approach": patch.approach} if patch.load is None else {"load": patch.load}


def solve_position(
    case: Position, load: float | None, penetration: float | None, creepage: Creepage | None, options: dict[str, Any]
) -> list[Touch]:
    """Return every patch of the wheels, solved. `load` [N] is the vertical load of each wheel."""
    touches = []
    for side, number, patch in find_patches(case, load, penetration):
        mirror = -1.0 if side == "left" else 1.0
        friction = options["friction"].placed(patch.on_rail[0], patch.angle, mirror)
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "load = ", PlausibilityWarning)  # a share of the load that was judged
            solution = solve(
                patch.separation,
                creepage or patch.creepage,
                speed=case.speed,
                **amount_of(patch),
                **options | {"friction": friction},
            )
        touches.append(Touch(solution, side, patch, number))
    return touches


def solve_hertzian(
    curvatures: tuple[float, float],
    load: float | None,
    approach: float | None,
    creepage: Creepage | None,
    options: dict[str, Any],
) -> Touch:
    """Return the solved patch of two constant half curvatures [1/m] under a normal load [N] or approach [m]."""
    load = standard_load(load, approach)
    separation = Separation.hertzian(*curvatures)
    return Touch(solve(separation, creepage or Creepage(), load=load, approach=approach, **options))


def sweep(
    over: str,
    values: Iterable[float],
    start: Creepage,
    separation: Separation,
    load: float,
    tangential: Sequence[str],
    options: dict[str, Any],
) -> list[dict[str, Any]]:
    """Return the forces of every tangential method under `load` [N] for each of the `values` of the creepage named `over`.

    The other creepages are those of `start`.
    """
    rows = []
    for method in tangential:
        for value in values:
            creepage = replace(start, **{over: float(value)})
            s = solve(separation, creepage, load=load, **options | {"tangential": method})
            forces = {"N": s.N, "Fx": s.Fx, "Fy": s.Fy, "Mz": s.Mz, "slip_ratio": s.slip_ratio}
            rows.append({"tangential": method, **asdict(creepage), **forces, "status": s.status.name})
    return rows


def standard_load(load: float | None, penetration: float | None) -> float | None:
    """Return the load [N]: `STANDARD_LOAD` if neither load nor penetration is given."""
    if load is not None and penetration is not None:
        raise ContactError(f"load = {load:g} and penetration = {penetration:g} exclude each other")
    return load_or_standard(load) if penetration is None else load


def carried(load: float | None, vertical: float | None) -> dict[str, float]:
    """Return the argument of a pair: the load [N] of the normal forces alone, or the vertical force with friction."""
    if vertical is None:
        return {"load": load_or_standard(load)}
    if load is not None:
        raise ContactError(f"--load {load:g} and --vertical {vertical:g} exclude each other")
    return {"vertical": vertical}


def load_or_standard(load: float | None) -> float:
    """Return the load [N], `STANDARD_LOAD` if it is None, and tell the JSON of the command."""
    load = STANDARD_LOAD if load is None else load
    in_effect(load=load)
    return load
