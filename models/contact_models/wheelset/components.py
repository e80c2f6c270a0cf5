"""Components with named ports for the master. Those of this module call the models directly."""

from __future__ import annotations

from typing import Any, Protocol, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

import contact
from contact.arrays import Array, as_array
from contact.errors import ContactError
from contact.inputs.material import Material
from .model import WheelsetModel
from .parameters import WheelsetParameters
from .ports import CREEPAGE, CURVATURE, GAP, LOAD, POINTS, REPORT, SIDES


class Component(Protocol):
    """A simulator with named ports. The ports and the names of their variables are those of `contact_models.wheelset.ports`."""

    def read(self, port: str) -> Array:
        """Return the values of an output port."""

    def write(self, port: str, values: ArrayLike) -> None:
        """Set an input port. The values are held until they are set again."""

    def step(self, time: float, h: float) -> None:
        """Advance from `time` to `time + h` [s]."""

    def save(self) -> Any:
        """Return the whole state, for `restore` of the same component."""

    def restore(self, state: Any) -> None:
        """Restore a saved state. The following results are repeated bit by bit."""


class SolveOptions(TypedDict, total=False):
    """Keywords of `contact.solve` that are constant during a run."""

    material: Material
    normal: str
    tangential: str
    n_strips: int
    n_elements: int
    conformal: bool
    throw: bool


class DirectContact:
    """`contact.solve` as a component: the FMU `WheelRailContact` without FMI.

    Parameters
    ----------
    parameters : WheelsetParameters
        Parameters of its wheelset, for the speed and the samples of the separation.
    friction : float
        Coefficient of friction [-].
    **options
        Keywords of `SolveOptions`.
    """

    def __init__(self, parameters: WheelsetParameters, friction: float = 0.3, **options: Unpack[SolveOptions]) -> None:
        self._y = parameters.window_start + parameters.window_step * np.arange(POINTS)
        self._friction, self._speed = friction, parameters.speed
        self._options: SolveOptions = {"throw": False}
        self._options.update(options)
        self._problem = np.zeros(LOAD + 1)
        self._solution: contact.Solution | None = None

    def write(self, port: str, values: ArrayLike) -> None:
        self._problem = as_array(port, values)

    def step(self, time: float, h: float) -> None:
        problem = self._problem
        self._solution = contact.solve(
            contact.Separation(self._y, problem[GAP], problem[CURVATURE]),
            contact.Creepage(*problem[CREEPAGE].tolist()),
            load=problem[LOAD],
            friction=self._friction,
            speed=self._speed,
            **self._options,
        )

    @property
    def solution(self) -> contact.Solution:
        """Solution of the last step. Before the first step it raises a ContactError."""
        if self._solution is None:
            raise ContactError("the contact has not been solved yet")
        return self._solution

    def read(self, port: str) -> Array:
        s = self.solution
        if port == "reaction":
            return np.array([s.Fx, s.Fy, s.Mz, s.approach])
        power = s.power_per_metre * s.speed
        T_gamma = abs(s.Fx * s.creepage.longitudinal) + abs(s.Fy * s.creepage.lateral)
        return np.array([power, s.max_pressure, s.slip_ratio, float(s.status), T_gamma])

    def save(self) -> tuple[Array, contact.Solution | None]:
        return self._problem, self._solution

    def restore(self, state: tuple[Array, contact.Solution | None]) -> None:
        self._problem, self._solution = state


class LinearContact:
    """Creep forces proportional to the creepages, as in the linear theory.

    Both directions have the same coefficient. Spin and the friction limit are neglected.

    Parameters
    ----------
    creep_coefficient : float
        f [N], force = -f·creepage.
    approach : float
        Constant approach that the component returns [m].
    """

    def __init__(self, creep_coefficient: float, approach: float = 6e-5) -> None:
        self._coefficient, self._approach = creep_coefficient, approach
        self._creepage = np.zeros(3)

    def write(self, port: str, values: ArrayLike) -> None:
        self._creepage = as_array(port, values)[CREEPAGE]

    def step(self, time: float, h: float) -> None:
        """Do nothing, because the component has no state."""

    def read(self, port: str) -> Array:
        if port == "reaction":
            return np.array([*(-self._coefficient * self._creepage[:2]), 0.0, self._approach])
        return np.zeros(len(REPORT))

    def save(self) -> Array:
        return self._creepage

    def restore(self, state: Array) -> None:
        self._creepage = state


class DirectWheelset:
    """`WheelsetModel` as a component."""

    def __init__(self, model: WheelsetModel) -> None:
        self.model = model

    def write(self, port: str, values: ArrayLike) -> None:
        given = as_array(port, values).tolist()
        if port == "irregularity":
            self.model.set_irregularity(*given)
        else:
            self.model.set_forces(port.removesuffix(".reaction"), *given)

    def step(self, time: float, h: float) -> None:
        self.model.step(h)

    def read(self, port: str) -> Array:
        side, _, what = port.rpartition(".")
        return getattr(self.model, what)(side) if side else getattr(self.model, what)()

    def save(self) -> bytes:
        return self.model.save()

    def restore(self, state: bytes) -> None:
        self.model.restore(state)


def direct(
    parameters: WheelsetParameters, friction: float = 0.3, **options: Unpack[SolveOptions]
) -> tuple[DirectWheelset, list[DirectContact]]:
    """Return the wheelset and its right and left contact for `master.run`."""
    return DirectWheelset(WheelsetModel(parameters)), [DirectContact(parameters, friction, **options) for _ in SIDES]
