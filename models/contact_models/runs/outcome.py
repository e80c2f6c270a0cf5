"""What one run does to its wheels and rails. A function of its scenario alone, so that it can be computed anywhere."""

from __future__ import annotations

from typing import NamedTuple

from contact.accumulation import Histogram
from .run import VehicleRun
from .scenario import Scenario
from .trust import Trust


class Outcome(NamedTuple):
    """Damage of a run.

    Attributes
    ----------
    wheels : dict
        (wheelset, side) → Histogram.
    rails : dict
        Side → Histogram of all axles together.
    energy : float
        Frictional energy of all wheels where damage was counted [J].
    axle_load : float
        Mean static load of an axle [N].
    trust : Trust
    """

    wheels: dict[tuple[str, str], Histogram]
    rails: dict[str, Histogram]
    energy: float
    axle_load: float
    trust: Trust


def outcome(scenario: Scenario) -> Outcome:
    """Run a scenario to its end and return what it has done.

    Raises
    ------
    ContactError
        As `VehicleRun.advance`.
    """
    run = VehicleRun(scenario)
    while not run.done:
        run.advance()
    wheels: dict[tuple[str, str], Histogram] = {}
    rails: dict[str, Histogram] = {}
    names = iter(scenario.wheel_names)
    for key, histogram in run.damage().items():
        side, body = key[-2:]
        if body == "wheel":
            wheels[next(names)] = histogram
        else:
            rails[side] = rails[side] + histogram if side in rails else histogram
    return Outcome(wheels, rails, run.energy, run.axle_load, run.trust)
