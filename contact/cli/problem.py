"""From what the command line is given to solved contact patches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from contact.creepage import Creepage
from contact.errors import ContactError
from contact.geometry import wheelset
from contact.geometry.profile import Profile
from contact.geometry.wheelset import Patch, Pose, Velocity
from contact.separation import Separation
from contact.solution import Solution
from contact.solve import solve

STANDARD_LOAD = 80e3  # [N] when neither load nor penetration is given
#: Options that a problem of two curvatures has no use for; speed and radius scale its damage.
OF_A_POSITION = frozenset(
    {"wheel", "rail", "inclination", "unit", "drawn_side", "smoothing", "side", "y", "roll", "yaw", "conformal"}
)


@dataclass(frozen=True)
class Touch:
    """One solved contact patch; `side` and `patch` are None for a problem without wheel and rail."""

    solution: Solution
    side: str | None = None
    patch: Patch | None = None
    number: int = 1

    @property
    def name(self) -> str:
        """What tables and pictures call it; patches are numbered from the field side to the flange."""
        return f"{self.side} {self.number}" if self.side else "patch"


@dataclass(frozen=True)
class Position:
    """A wheelset on its rails: profiles in the right-side convention, the sides asked for, pose and speed."""

    wheel: Profile
    rail: Profile
    sides: Sequence[str]
    pose: Pose
    speed: float
    radius: float


def find_patches(case: Position, load: float | None, penetration: float | None) -> Iterator[tuple[str, int, Patch]]:
    """Side, number and place of every patch of the wheels asked for; `load` [N] is the vertical load of each wheel."""
    load = standard_load(load, penetration)
    for side in case.sides:
        found = wheelset.contacts(
            case.wheel,
            case.rail,
            case.pose,
            Velocity(forward=case.speed),
            load=load,
            penetration=penetration,
            side=side,
            nominal_radius=case.radius,
        )
        for number, patch in enumerate(found, 1):
            yield side, number, patch


def amount_of(patch: Patch) -> dict[str, Any]:
    """The load of a patch where it was found from one, else its approach."""
    return {"approach": patch.approach} if patch.load is None else {"load": patch.load}


def solve_position(
    case: Position, load: float | None, penetration: float | None, creepage: Creepage | None, options: dict[str, Any]
) -> list[Touch]:
    """Every patch of the wheels asked for; `load` [N] is the vertical load of each wheel."""
    touches = []
    for side, number, patch in find_patches(case, load, penetration):
        mirror = -1.0 if side == "left" else 1.0
        friction = options["friction"].placed(patch.on_rail[0], patch.angle, mirror)
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
    """The patch of two constant half curvatures [1/m] under a normal load."""
    load = standard_load(load, approach)
    separation = Separation.hertzian(*curvatures)
    return Touch(solve(separation, creepage or Creepage(), load=load, approach=approach, **options))


def sweep(
    over: str,
    values: Iterable[float],
    start: Creepage,
    curvatures: tuple[float, float],
    load: float | None,
    tangential: Sequence[str],
    options: dict[str, Any],
) -> list[dict[str, Any]]:
    """Forces of every tangential method with the creepage named `over` running through `values`, the others as `start`."""
    rows = []
    for method in tangential:
        for value in values:
            creepage = replace(start, **{over: float(value)})
            s = solve_hertzian(curvatures, load, None, creepage, options | {"tangential": method}).solution
            forces = {"N": s.N, "Fx": s.Fx, "Fy": s.Fy, "Mz": s.Mz, "slip_ratio": s.slip_ratio}
            rows.append({"tangential": method, **asdict(creepage), **forces})
    return rows


def standard_load(load: float | None, penetration: float | None) -> float | None:
    """The load [N], that of a standard wheel when neither is given."""
    if load is not None and penetration is not None:
        raise ContactError(f"load = {load:g} and penetration = {penetration:g} exclude each other")
    return STANDARD_LOAD if load is None and penetration is None else load
