"""Modes, conicities and critical speeds of a scenario's vehicle on straight ideal track."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from contact.errors import ContactError
from contact.geometry import conicity
from ..vehicle import linear
from ..vehicle.hunting import Hunting, fall
from ..vehicle.kernels.layout import Axis
from ..vehicle.simulation import Simulation
from . import simulated
from .kept import kept
from .scenario import Scenario

#: Amplitudes of the equivalent conicity [m].
CONICITY_AT = (1e-3, 3e-3)
#: The nonlinear critical speed: greatest speed [m/s], least one over the greatest, and deceleration [m/s²].
FASTEST_CYCLE, SLOWEST_CYCLE, DECELERATION = 150.0, 0.3, 4.0
_ABOVE_CRITICAL = 1.2


class Stability:
    """How a vehicle moves on straight ideal track. Each is found when it is first read; critical speeds are kept (`kept`).

    Parameters
    ----------
    scenario : Scenario
    step : float
        Of the scenario's run [s].
    """

    def __init__(self, scenario: Scenario, step: float) -> None:
        self._scenario, self._step = scenario, step
        self._options = simulated.options(scenario)

    def _on_straight(self, speed: float) -> Simulation:
        return simulated.on_straight(self._scenario, speed)

    @cached_property
    def critical_speed(self) -> float:
        """Linear critical speed [m/s]; inf above 150 m/s."""
        return float(self._kept("linear", (), lambda: linear.critical_speed(self._on_straight, tolerance=2.0)))

    def _kept(self, what: str, more: tuple[Any, ...], compute: Callable[[], Any]) -> Any:
        """Return what depends on the vehicle, its profiles, friction and methods, and on `more`: computed once (`kept`)."""
        scenario = self._scenario
        given = (scenario.vehicle, scenario.friction, self._options, *more)
        return kept(what, given, (*scenario.wheels, *scenario.rails, scenario.wheel, scenario.rail), compute)

    @cached_property
    def limit_cycle(self) -> Hunting | None:
        """The fall from above the linear critical speed to `SLOWEST_CYCLE` of it, on the scenario's wheel and rail.

        None if a wheel leaves its rail. It takes some 25 s, once for a vehicle with its profiles, methods and step.
        """
        scenario = self._scenario
        fastest = min(_ABOVE_CRITICAL * self.critical_speed, FASTEST_CYCLE)
        slowest = max(SLOWEST_CYCLE * fastest, 2.0)
        step = self._step * min(slowest / scenario.slowest, 1.0)

        def fallen() -> list[Any] | None:
            try:
                found = fall(
                    scenario.vehicle,
                    (scenario.wheel, scenario.rail),
                    (slowest, fastest),
                    deceleration=DECELERATION,
                    friction=scenario.friction,
                    options=self._options,
                    step=step,
                )
            except ContactError:
                return None
            return [found.speed.tolist(), found.amplitude.tolist(), found.critical]

        found = self._kept("nonlinear", (slowest, fastest, step), fallen)
        return None if found is None else Hunting(np.array(found[0]), np.array(found[1]), float(found[2]))

    @cached_property
    def conicities(self) -> tuple[float, ...]:
        """Equivalent conicity of the scenario's wheel and rail at the amplitudes `CONICITY_AT`; empty if it has none."""
        given = self._scenario
        try:
            found = conicity(given.wheel, given.rail, CONICITY_AT, **given.vehicle.sizes)
        except ContactError:
            return ()
        return tuple(found.conicity.tolist())

    def modes(self, greatest: float = 50.0) -> list[tuple[str, linear.Mode]]:
        """Return the oscillating modes at the slowest speed up to a frequency [Hz], each with what moves most in it."""
        simulation = self._on_straight(self._scenario.slowest)
        free = linear.coordinates(simulation)
        found = []
        for mode in linear.modes(simulation):
            if 0.05 < mode.frequency <= greatest:
                body, axis = free[int(np.argmax(np.abs(mode.shape[: len(free)])))]
                found.append((f"{simulation.names[body]} {Axis(axis).name.lower()}", mode))
        return found
