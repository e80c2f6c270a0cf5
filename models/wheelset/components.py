"""What the master couples: components with named ports, here the ones that call the models directly."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

import contact
from models.wheelset.model import WheelsetModel
from models.wheelset.ports import CREEPAGE, CURVATURE, GAP, LOAD, POINTS

Array = NDArray[np.float64]


class Component(Protocol):
    """A simulator with a clock. The ports and the names behind them are those of `models.wheelset.ports`."""

    def read(self, port: str) -> Array:
        """Values of an output port."""

    def write(self, port: str, values: ArrayLike) -> None:
        """Set an input port; the values are held until they are set again."""

    def step(self, time: float, h: float) -> None:
        """Advance from `time` to `time + h` [s]."""

    def save(self) -> object:
        """All of the state, for `restore`."""

    def restore(self, state: object) -> None:
        """Return to a saved state; what follows is repeated bit by bit."""


class DirectContact:
    """`contact.solve` as a component: what the FMU `WheelRailContact` does, without FMI.

    Parameters
    ----------
    window_start, window_step : float
        First sample and distance of the samples of the separation [m].
    friction, speed : float
        [-], [m/s].
    options
        Further keywords of `contact.solve`.
    """

    def __init__(
        self, *, window_start: float, window_step: float, friction: float, speed: float, **options: object
    ) -> None:
        self._y = window_start + window_step * np.arange(POINTS)
        self._options = {"friction": friction, "speed": speed, **options}
        self._problem = np.zeros(LOAD + 1)
        self.solution: contact.Solution | None = None

    def write(self, port: str, values: ArrayLike) -> None:
        self._problem = np.array(values, dtype=np.float64)

    def step(self, time: float, h: float) -> None:
        problem = self._problem
        self.solution = contact.solve(
            contact.Separation(self._y, problem[GAP], problem[CURVATURE]),
            contact.Creepage(*problem[CREEPAGE].tolist()),
            load=problem[LOAD],
            throw=False,
            **self._options,
        )

    def read(self, port: str) -> Array:
        s = self.solution
        if port == "reaction":
            return np.array([s.Fx, s.Fy, s.Mz, s.approach])
        power = s.power_per_metre * s.speed
        T_gamma = abs(s.Fx * s.creepage.longitudinal) + abs(s.Fy * s.creepage.lateral)
        return np.array([power, s.max_pressure, s.slip_ratio, float(s.status), T_gamma])

    def save(self) -> object:
        return self._problem, self.solution

    def restore(self, state: object) -> None:
        self._problem, self.solution = state


class DirectWheelset:
    """`WheelsetModel` as a component."""

    def __init__(self, model: WheelsetModel) -> None:
        self.model = model

    def write(self, port: str, values: ArrayLike) -> None:
        if port == "irregularity":
            self.model.set_irregularity(*values)
        else:
            self.model.set_forces(port.removesuffix(".reaction"), *values)

    def step(self, time: float, h: float) -> None:
        self.model.step(h)

    def read(self, port: str) -> Array:
        side, _, what = port.rpartition(".")
        return getattr(self.model, what)(side) if side else getattr(self.model, what)()

    def save(self) -> object:
        return self.model.save()

    def restore(self, state: object) -> None:
        self.model.restore(state)
