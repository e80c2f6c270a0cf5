"""Example master: a wheelset coupled with a contact at each wheel, by FMUs or by Python objects.

The forces are constant during a communication step. The schemes differ in when data is exchanged:

* ``gauss_seidel``: the contacts answer first, then the wheelset moves with their answers. Nothing is late.
* ``jacobi``: all components step at the same time, so the wheelset moves with the answers to the step before. It needs
  shorter steps, and costs accuracy of first order.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Literal, get_args

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.view.notebook import Sketch, beside, table
from ..vehicle.coupling import ANSWER, QUESTION, AskingVehicle
from ..vehicle.declared import SIDES
from .contacts import REPORT, ReportingContact

Scheme = Literal["gauss_seidel", "jacobi"]

#: Motion of the wheelset, which both contacts get.
MOTION = QUESTION[:10]
_OF_SIDE = (*QUESTION[10:], *ANSWER, *REPORT)
COLUMNS = ("time", *MOTION, *(f"{side}.{name}" for side in SIDES for name in _OF_SIDE))


@dataclass(frozen=True, eq=False)
class History:
    """What was exchanged at each communication point, by the names of the inputs and outputs of the FMU `WheelRailPair`.

    Attributes
    ----------
    values : ndarray, shape (n, len(COLUMNS))
        The columns `COLUMNS`.
    step : float
        Communication step [s].
    """

    values: Array
    step: float

    def __getitem__(self, column: str) -> Array:
        return self.values[:, COLUMNS.index(column)]

    @property
    def distance(self) -> Array:
        """Distance travelled [m]."""
        return self["time"] * self["velocity.x"][0]

    @property
    def creep_power(self) -> Array:
        """Power of the creep forces on the creepages of both wheels [W], positive if dissipated."""
        return self["velocity.x"] * np.sum([self[f"{side}.dissipation"] for side in SIDES], axis=0)

    @property
    def friction_power(self) -> Array:
        """Frictional power of both contacts from their slip fields [W]."""
        return np.sum([self[f"{side}.power.friction"] for side in SIDES], axis=0)

    @property
    def contact_power(self) -> Array:
        """Power that leaves wheelset and rails through both contacts [W]: force and moment on the motion between them."""
        yaw, roll = self["pose.yaw"], self["pose.roll"]
        axle = np.stack((-np.sin(yaw) * np.cos(roll), np.cos(yaw) * np.cos(roll), np.sin(roll)))
        turning = self["velocity.spin"] * axle
        turning[0] += self["velocity.roll"]
        turning[2] += self["velocity.yaw"]
        power = np.zeros(len(self.values))
        for side in SIDES:
            for axis, turn in zip("xyz", turning, strict=True):
                moving = self[f"velocity.{axis}"]
                if axis != "x":
                    moving = moving - self[f"{side}.irregularity.{axis}_rate"]
                power -= self[f"{side}.force.{axis}"] * moving + self[f"{side}.moment.{axis}"] * turn
        return power

    @property
    def power_residual(self) -> Array:
        """Error of the coupling's energy balance [J].

        It is the energy that left wheelset and rails and was neither dissipated by creep nor stored in the contacts, by the
        trapezoidal rule.
        """
        lost = self.contact_power - self.creep_power
        energy = np.concatenate(([0.0], np.cumsum(lost[1:] + lost[:-1]) * (0.5 * self.step)))
        stored = np.sum([self[f"{side}.elastic"] for side in SIDES], axis=0)
        return energy - (stored - stored[0])

    def _repr_html_(self) -> str:
        """Return HTML with a sketch of the lateral displacement over the distance, for a notebook."""
        s, y = self.distance, 1e3 * self["pose.y"]
        drawn = Sketch(
            (s[0], s[-1]), (y.min(), y.max()), ("distance [m]", "lateral displacement [mm]"), "lateral motion"
        )
        drawn.curve(s, y)
        rows = [
            ("speed, step", f"{self['velocity.x'][0]:g} m/s, {1e3 * self.step:g} ms"),
            ("time, distance", f"{self['time'][-1]:.4g} s, {s[-1]:.5g} m"),
            ("lateral", f"{y.min():.4g} … {y.max():.4g} mm"),
            *((f"largest normal force, {side}", f"{1e-3 * self[f'{side}.normal'].max():.4g} kN") for side in SIDES),
            ("power residual", f"{np.abs(self.power_residual).max():.4g} J"),
        ]
        return beside(table((), rows, "wheelset"), drawn.svg())

    def write_csv(self, path: str | PathLike[str]) -> None:
        """Write the communication points as CSV, with a header of names."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(COLUMNS)
            writer.writerows([f"{v:.9g}" for v in row] for row in self.values)


def run(
    wheelset: AskingVehicle,
    contacts: Sequence[ReportingContact],
    *,
    step: float,
    duration: float,
    scheme: Scheme = "gauss_seidel",
    watch: Callable[[int, int], None] | None = None,
) -> History:
    """Run the coupled system from its start.

    Parameters
    ----------
    wheelset : AskingVehicle
        A vehicle with one wheelset: `contact_models.vehicle.coupling.OpenVehicle` or `.fmu.FmuVehicle`.
    contacts : two contacts
        Right and left: `.contacts.InPython` or `.contacts.InFmu`.
    step, duration : float
        Communication step and time [s].
    scheme : {"gauss_seidel", "jacobi"}
    watch : callable, optional
        Called after each step with the number of steps done and the total number, for a progress bar.

    Raises
    ------
    ContactError
        For an unknown scheme, a step or duration that is not positive, or what a component refuses.
    """
    if scheme not in get_args(Scheme):
        raise ContactError(f"scheme = {scheme!r} is none of {', '.join(get_args(Scheme))}")
    h = require_number("step", step, 0.0, open_minimum=True)
    n = max(1, round(require_number("duration", duration, 0.0, open_minimum=True) / h))
    rows: list[Array] = []

    def record(questions: Array, answers: Array) -> None:
        sides = [
            (question[len(MOTION) :], answer, contact.report)
            for question, answer, contact in zip(questions, answers, contacts, strict=True)
        ]
        rows.append(
            np.concatenate(([len(rows) * h], questions[0, : len(MOTION)], *(part for one in sides for part in one)))
        )
        if watch is not None:
            watch(len(rows), n)

    wheelset.run(contacts, h, n, parallel=scheme == "jacobi", watch=record)
    return History(np.array(rows), h)
