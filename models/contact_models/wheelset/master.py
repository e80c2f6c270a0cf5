"""Example master: one wheelset coupled with a contact at each wheel, by FMUs or by Python objects.

The creep forces are constant during a communication step. The schemes differ in when data is exchanged:

* ``jacobi``: all components run at the same time with the results of the previous step. First order; it needs the shortest
  steps.
* ``gauss_seidel``: the contacts are solved for the present creepages, then the wheelset runs with these forces. First
  order; stable at twice the step of ``jacobi``.
* ``iterated``: the wheelset runs with the mean of the forces at the start and at the end of the step (trapezoidal rule).
  The step is repeated from the saved state until the forces agree with the resulting creepages. Second order, except that
  the load follows the lateral force, and the height the approach, one step later. It has no stability limit and needs
  some more evaluations per step.

docs/check/coupling.md has measured values of the largest stable steps.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.view.notebook import Sketch, beside, table
from .components import Component
from .iteration import fixed_point
from .ports import CREEPAGE, ENERGY, FRAME, LOAD, MOTION, PROBLEM, REACTION, REPORT, SIDES

Scheme = Literal["gauss_seidel", "jacobi", "iterated"]

#: Tolerance of the iterated scheme, over the normal load, and its largest number of iterations.
TOLERANCE, MOST_ROUNDS = 1e-5, 20
_APPROACH_SCALE = 1e-4  # [m]
_MOMENT_ARM = 5e-3  # half length of a patch [m]
_LEAST_LOAD = 1e3  # least load [N] in the tolerance, for a wheel that hardly touches

_EXCHANGED = (*PROBLEM[CREEPAGE], PROBLEM[LOAD], *REACTION, *REPORT, *FRAME)
COLUMNS = ("time", *MOTION, *ENERGY, *(f"{side}.{name}" for side in SIDES for name in _EXCHANGED))


@dataclass(frozen=True, eq=False)
class History:
    """Exchanged data at each communication point: the motion, and the forces that result from it.

    Attributes
    ----------
    values : ndarray, shape (n, len(COLUMNS))
        The columns `COLUMNS`.
    problems : ndarray, shape (n, 2, len(PROBLEM))
        Inputs of each contact.
    rounds : ndarray, shape (n,)
        Number of iterations of each step; 1 unless the scheme is iterated. A value above MOST_ROUNDS means no convergence.
    speed, step : float
        Speed [m/s] and communication step [s].
    """

    values: Array
    problems: Array
    rounds: NDArray[np.int64]
    speed: float
    step: float

    def __getitem__(self, column: str) -> Array:
        return self.values[:, COLUMNS.index(column)]

    @property
    def distance(self) -> Array:
        """Distance travelled [m]."""
        return self.speed * self["time"]

    @property
    def creep_power(self) -> Array:
        """Power of the creep forces on the creepages of both wheels [W], positive if dissipated."""
        pairs = zip(PROBLEM[CREEPAGE], REACTION, strict=False)
        return -self.speed * np.sum([self[f"{s}.{c}"] * self[f"{s}.{f}"] for c, f in pairs for s in SIDES], axis=0)

    @property
    def friction_power(self) -> Array:
        """Frictional power of both contacts from their slip fields [W]."""
        return np.sum([self[f"{side}.power.friction"] for side in SIDES], axis=0)

    @property
    def elastic_energy(self) -> Array:
        """Elastic energy of both contacts [J]: 2/5 of load times approach, exact for Hertz contact."""
        return 0.4 * np.sum([self[f"{side}.load.normal_force"] * self[f"{side}.approach"] for side in SIDES], axis=0)

    @property
    def power_residual(self) -> Array:
        """Error of the coupling's energy balance [J].

        It is the energy that left the wheelset and was neither dissipated by creep nor stored in the contacts. Dissipation
        is integrated by the trapezoidal rule. The balance starts at the second communication point, because the first one
        uses an assumed approach.
        """
        power = self.creep_power
        dissipated = np.concatenate(([0.0], np.cumsum(power[1:] + power[:-1]) * (0.5 * self.step)))
        residual = self["energy.interface"] - dissipated - self.elastic_energy
        return residual - residual[min(1, residual.size - 1)]

    def _repr_html_(self) -> str:
        """Return HTML with a sketch of the lateral displacement over the distance, for a notebook."""
        s, y = self.distance, 1e3 * self["lateral"]
        drawn = Sketch(
            (s[0], s[-1]), (y.min(), y.max()), ("distance [m]", "lateral displacement [mm]"), "lateral motion"
        )
        drawn.curve(s, y)
        rows = [
            ("speed, step", f"{self.speed:g} m/s, {1e3 * self.step:g} ms"),
            ("time, distance", f"{self['time'][-1]:.4g} s, {s[-1]:.5g} m"),
            ("lateral", f"{y.min():.4g} … {y.max():.4g} mm"),
            *((f"largest load, {side}", f"{1e-3 * self[f'{side}.load.normal_force'].max():.4g} kN") for side in SIDES),
            (
                "rounds",
                f"{self.rounds.max(initial=1)} at most, {int((self.rounds > MOST_ROUNDS).sum())} steps without convergence",
            ),
            ("power residual", f"{np.abs(self.power_residual).max():.4g} J"),
        ]
        return beside(table((), rows, "wheelset"), drawn.svg())

    def write_csv(self, path: str | PathLike[str], columns: Sequence[str] = COLUMNS, every: int = 1) -> None:
        """Write every `every`-th communication point as CSV, with a header of names."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(
                [f"{v:.9g}" for v in row] for row in zip(*(self[c][::every] for c in columns), strict=True)
            )


def run(
    wheelset: Component,
    contacts: Sequence[Component],
    *,
    speed: float,
    step: float,
    duration: float,
    scheme: Scheme = "gauss_seidel",
    irregularity: Callable[[float], tuple[float, float]] | None = None,
    watch: Callable[[int, int], None] | None = None,
) -> History:
    """Run the coupled system from time 0.

    Parameters
    ----------
    wheelset : Component
        Initialised wheelset.
    contacts : two Components
        Right and left contact.
    speed : float
        Speed of the wheelset [m/s], for the power balance.
    step, duration : float
        Communication step and end time [s].
    scheme : {"gauss_seidel", "jacobi", "iterated"}
    irregularity : callable, optional
        Time [s] → lateral position [m] and slope [-] of the track's centre line.
    watch : callable, optional
        Called after each step with the number of steps done and the total number, for a progress bar.

    Returns
    -------
    History

    Raises
    ------
    ContactError
        For an unknown scheme, or a step or duration that is not positive.
    """
    if scheme not in get_args(Scheme):
        raise ContactError(f"scheme = {scheme!r} is none of {', '.join(get_args(Scheme))}")
    h = require_number("step", step, 0.0, open_minimum=True)
    n = max(1, round(require_number("duration", duration, 0.0, open_minimum=True) / h))
    pairs = list(zip(SIDES, contacts, strict=True))
    values, given = np.empty((n, len(COLUMNS))), np.empty((n, len(SIDES), len(PROBLEM)))
    rounds = np.ones(n, dtype=np.int64)
    answers: list[Array] = []
    for k in range(n):
        time = k * h
        if irregularity is not None:
            wheelset.write("irregularity", irregularity(time))
        problems = [wheelset.read(f"{side}.problem") for side in SIDES]
        reactions = _solve(pairs, problems, time, h)
        values[k], given[k] = _row(time, wheelset, pairs, problems, reactions), problems
        if scheme == "jacobi":
            # the first step uses its own results, which FMUs exchange during initialisation
            reactions, answers = answers or reactions, reactions
        elif scheme == "iterated":
            reactions, rounds[k] = _mean_over_step(wheelset, pairs, problems, reactions, time, h)
        _advance(wheelset, reactions, time, h)
        if watch is not None:
            watch(k + 1, n)
    return History(values, given, rounds, speed, h)


def _solve(pairs: Sequence[tuple[str, Component]], problems: Sequence[Array], time: float, h: float) -> list[Array]:
    for (_, contact), problem in zip(pairs, problems, strict=True):
        contact.write("problem", problem)
        contact.step(time, h)
    return [contact.read("reaction") for _, contact in pairs]


def _advance(wheelset: Component, reactions: Sequence[Array], time: float, h: float) -> None:
    for side, reaction in zip(SIDES, reactions, strict=True):
        wheelset.write(f"{side}.reaction", reaction)
    wheelset.step(time, h)


def _mean_over_step(
    wheelset: Component,
    pairs: Sequence[tuple[str, Component]],
    problems: Sequence[Array],
    reactions: Sequence[Array],
    time: float,
    h: float,
) -> tuple[list[Array], int]:
    """Return the mean of the reactions at the start and at the end of the step, and the number of iterations.

    The end of the step is computed with the same mean. The states of all components are restored.
    """
    now = np.array(reactions)

    def answer(end: Array) -> Array:
        """Return the reactions at the end of the step if the wheelset runs with the mean of `now` and `end`."""
        start = wheelset.save()
        _advance(wheelset, list(0.5 * (now + end.reshape(now.shape))), time, h)
        reached = [wheelset.read(f"{side}.problem") for side in SIDES]
        wheelset.restore(start)
        clocks = [contact.save() for _, contact in pairs]
        answers = _solve(pairs, reached, time + h, h)
        for (_, contact), clock in zip(pairs, clocks, strict=True):
            contact.restore(clock)
        return np.concatenate(answers)

    loads = [max(problem[LOAD], _LEAST_LOAD) for problem in problems]
    scale = np.concatenate([(load, load, load * _MOMENT_ARM, _APPROACH_SCALE) for load in loads])
    end, rounds = fixed_point(answer, now.ravel(), scale, TOLERANCE, MOST_ROUNDS)
    return list(0.5 * (now + end.reshape(now.shape))), rounds


def _row(
    time: float,
    wheelset: Component,
    pairs: Sequence[tuple[str, Component]],
    problems: Sequence[Array],
    reactions: Sequence[Array],
) -> Array:
    """Return one line of the history."""
    row: list[ArrayLike] = [[time], wheelset.read("motion"), wheelset.read("energy")]
    for (side, contact), problem, reaction in zip(pairs, problems, reactions, strict=True):
        row += [problem[CREEPAGE], [problem[LOAD]], reaction, contact.read("report"), wheelset.read(f"{side}.frame")]
    return np.concatenate(row)
