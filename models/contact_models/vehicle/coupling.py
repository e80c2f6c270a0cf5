"""A vehicle without contacts: whoever drives it solves the contacts, as FMUs do (docs/use/own_vehicle.md)."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from contact.arrays import Array
from contact.core import pack
from contact.errors import ContactError
from contact.inputs.options import MOTION_INPUTS
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.arrays import Motions
from .declared import SIDES
from .kernels import motion
from .kernels.frames import speed_at
from .kernels.layout import Book, Model, Scratch, State
from .simulation import Simulation

#: What a contact is asked, by the names of the inputs of the FMU `WheelRailPair`.
QUESTION = (*MOTION_INPUTS, "friction.coefficient")
#: What it answers → member of the record WHEEL. The first six have the names of the FMU's outputs and act on the wheel in track
#: coordinates, moments about the wheelset's centre. The normal force [N] tells impacts and lifted wheels. Dissipation [N] and
#: elastic energy [J] are for the balance of energy alone.
ANSWER = {
    "force.x": "longitudinal",
    "force.y": "lateral",
    "force.z": "vertical",
    "moment.x": "moment_x",
    "moment.y": "moment_y",
    "moment.z": "moment_z",
    "normal": "normal",
    "dissipation": "dissipation",
    "elastic": "elastic",
}


class Contact(Protocol):
    """The contact of one wheel, wherever it is computed."""

    def answer(self, question: Array, time: float, step: float) -> Array:
        """Return the values of `ANSWER` for those of `QUESTION`. `step` is the time until the next question [s]."""


class AskingVehicle:
    """A vehicle that asks for the forces at its wheels, wherever it is computed."""

    time: float  # since the start [s]
    n_wheels: int
    _late: Array | None = None  # answers to the questions of the step before

    def ask(self) -> Array:
        """Return the questions at the present state, shape (wheels, len(QUESTION))."""
        raise NotImplementedError

    def move(self, answers: Array, h: float) -> None:
        """Advance by `h` [s] with the answers to the last questions, shape (wheels, len(ANSWER))."""
        raise NotImplementedError

    def run(
        self,
        contacts: Sequence[Contact],
        h: float,
        steps: int,
        *,
        parallel: bool = False,
        watch: Callable[[Array, Array], None] | None = None,
    ) -> None:
        """Advance by `steps` steps of `h` [s]: ask, let each contact answer, move.

        With `parallel` the vehicle moves with the answers to the questions of the step before, as in a master that steps all
        components at the same time (Jacobi). That needs half the step, and costs accuracy of first order in it. `watch` gets
        the questions and their answers before each move.

        Raises
        ------
        ContactError
            If there are not as many contacts as wheels, or a contact has no answer.
        """
        if len(contacts) != self.n_wheels:
            raise ContactError(f"{len(contacts)} contacts for {self.n_wheels} wheels")
        for _ in range(steps):
            questions = self.ask()
            answers = [contact.answer(own, self.time, h) for contact, own in zip(contacts, questions, strict=True)]
            now = np.array(answers)
            if watch is not None:
                watch(questions, now)
            late, self._late = (now if self._late is None else self._late), now
            self.move(late if parallel else now, h)


class OpenVehicle(OwnsArrays, AskingVehicle):
    """A vehicle of this package that asks for the forces at its wheels.

    Parameters
    ----------
    simulation : Simulation
        The vehicle on its track at the start. Its own contacts are not used from here on.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        model, state, scratch, motions = (
            simulation.model, simulation.state, simulation.scratch, simulation.wheel_arrays.motions
        )  # fmt: skip
        self._arguments = pack(Model, model), pack(State, state), pack(Motions, motions), pack(Scratch, scratch)
        self.take_turns_with(simulation)
        self.n_wheels = scratch.wheels.size

    def __copy__(self) -> OpenVehicle:
        return copy.deepcopy(self)  # with a simulation of its own

    def _kept(self) -> Any:
        return self._late

    def _keep(self, kept: Any) -> None:
        self._late = kept

    @property
    def wheels(self) -> tuple[tuple[str, str], ...]:
        """Wheelset and side of each wheel, in the order of the questions."""
        simulation = self._simulation
        return tuple((simulation.names[i], side) for i in simulation.model.wheelsets for side in SIDES)

    @property
    def time(self) -> float:  # type: ignore[override]
        """Time since the start [s]."""
        return self._simulation.time

    @one_thread
    def ask(self) -> Array:
        """Return the questions at the present state, shape (wheels, len(QUESTION))."""
        motion.prepare_contacts(*self._arguments, self._speed)
        scratch = self._simulation.scratch
        given = scratch.given.view(np.float64).reshape(scratch.given.size, -1)
        return np.column_stack((given, scratch.seats["friction"]))

    @one_thread
    def move(self, answers: Array, h: float) -> None:
        """Advance by `h` [s] with the answers to the last questions, shape (wheels, len(ANSWER))."""
        wheels = self._simulation.scratch.wheels
        for column, (name, member) in zip(answers.T, ANSWER.items(), strict=True):
            wheels[member] = -column if name == "force.z" else column
        motion.move(*self._arguments, float(h), self._speed)

    @property
    def _speed(self) -> float:
        """Speed at the present place [m/s]."""
        model = self._simulation.model
        return float(speed_at(model.track, self._simulation.distance))

    @property
    def residual(self) -> float:
        """Residual of the energy balance over the dissipation in the contacts [-]."""
        books = self._simulation.state.books
        return float(books[Book.RESIDUAL] / books[Book.DISSIPATED]) if books[Book.DISSIPATED] > 0.0 else 0.0
