"""An FMU driven by fmpy: a vehicle that asks, the contact that answers, or any other."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from contact.arrays import Array
from contact.errors import ContactError
from ..vehicle.coupling import ANSWER, QUESTION, AskingVehicle
from .contacts import PATCH, REPORT, ReportingContact

_PATCHES = 3
_OF_WHOLE = (*REPORT[4:-1], "status_real")
_DISCARD = 2  # FMI status Discard; higher values are Error and Fatal


class Fmu:
    """An FMU of FMI 2.0. As a context manager it frees the FMU.

    Parameters
    ----------
    path : path
    start : mapping
        Name of a variable → its value before initialisation; of an Enumeration the name of its item or its number.
    name : str
        Name of the instance.
    exchange : bool
        Model exchange: outputs belong to the inputs at once. Otherwise co-simulation: they belong to the end of a step.

    Raises
    ------
    ContactError
        If the FMU refuses a call, with the message in its log. All methods may raise it.
    """

    def __init__(
        self,
        path: str | PathLike[str],
        start: Mapping[str, float | str] | None = None,
        *,
        name: str = "",
        exchange: bool = False,
    ) -> None:
        description = fmpy.read_model_description(str(path))
        self.variables = {v.name: v for v in description.modelVariables}
        self.exchange = exchange
        kind, about = (FMU2Model, description.modelExchange) if exchange else (FMU2Slave, description.coSimulation)
        self._directory = fmpy.extract(str(path))
        self._fmu = kind(
            guid=description.guid,
            unzipDirectory=self._directory,
            modelIdentifier=about.modelIdentifier,
            instanceName=name or description.modelName,
        )
        self._objections: list[str] = []
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        try:
            self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:  # noqa: BLE001 - fmpy's own class; the FMU has logged the reason
            raise ContactError(f"{path}: {'; '.join(self._objections) or error}") from None
        self._fmu.setupExperiment(startTime=0.0)
        for variable, value in (start or {}).items():
            self._start(self.variables[variable], value)
        self._call(self._fmu.enterInitializationMode)
        self._call(self._fmu.exitInitializationMode)
        if exchange:
            self._fmu.newDiscreteStates()
            self._fmu.enterContinuousTimeMode()

    def references(self, names: Sequence[str]) -> list[int]:
        """Return the value references of variables."""
        return [self.variables[name].valueReference for name in names]

    def set(self, references: list[int], values: Array) -> None:
        """Set Reals."""
        self._call(self._fmu.setReal, references, values.tolist())

    def get(self, references: list[int]) -> Array:
        """Return the values of Reals."""
        return np.array(self._fmu.getReal(references))

    def step(self, time: float, h: float) -> None:
        """Advance from `time` to `time + h` [s]; in model exchange tell the FMU the time."""
        if self.exchange:
            self._fmu.setTime(time)
        else:
            self._call(self._fmu.doStep, time, h)

    def free(self) -> None:
        """Free the FMU."""
        self._fmu.terminate()
        self._fmu.freeInstance()
        shutil.rmtree(self._directory, ignore_errors=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.free()

    def _start(self, variable: Any, value: float | str) -> None:
        if isinstance(value, str):
            value = float(next(item.value for item in variable.declaredType.items if item.name == value))
        if variable.type == "Real":
            self._call(self._fmu.setReal, [variable.valueReference], [float(value)])
        else:
            self._call(self._fmu.setInteger, [variable.valueReference], [int(value)])

    def _call(self, function: Callable[..., Any], *arguments: object) -> None:
        """Call a function and raise the FMU's error messages."""
        self._objections.clear()
        try:
            function(*arguments)
        except FMICallException as error:
            raise ContactError("; ".join(self._objections) or str(error)) from None

    def _log(self, environment: object, name: bytes, status: int, category: bytes, message: bytes) -> None:
        if status >= _DISCARD:
            self._objections.append(message.decode())


class FmuVehicle(AskingVehicle):
    """An FMU `Wheelset` or `OpenVehicle`."""

    def __init__(self, fmu: Fmu) -> None:
        self._fmu, self.time = fmu, 0.0
        self.n_wheels = sum(name.endswith("].pose.y") for name in fmu.variables)
        wheels = range(1, self.n_wheels + 1)
        self._asked = fmu.references([f"wheel[{k}].{name}" for k in wheels for name in QUESTION])
        self._taken = [name for name in ANSWER if f"wheel[1].{name}" in fmu.variables]
        self._answers = fmu.references([f"wheel[{k}].{name}" for k in wheels for name in self._taken])

    def ask(self) -> Array:
        return self._fmu.get(self._asked).reshape(self.n_wheels, len(QUESTION))

    def move(self, answers: Array, h: float) -> None:
        self._fmu.set(self._answers, answers[:, : len(self._taken)].ravel())
        self._fmu.step(self.time, h)
        self.time += h


class InFmu(ReportingContact, Fmu):
    """An FMU `WheelRailPair`.

    Parameters
    ----------
    path : Path
    side : {"right", "left"}
    start : mapping
        Names and values of parameters; of Enumerations the names of their items.
    exchange : bool
        As for `Fmu`. Both give the same answer, since the vehicle moves only after it has been given.
    """

    def __init__(
        self, path: Path, side: str, start: Mapping[str, float | str] | None = None, *, exchange: bool = False
    ) -> None:
        its = {"load.kind": "Position", "side": side.title()} | dict(start or {})
        super().__init__(path, its, name=side, exchange=exchange)
        self._inputs = self.references(QUESTION)
        names = (
            *tuple(ANSWER)[:6],
            *(f"patch[{k}].{name}" for k in range(1, _PATCHES + 1) for name in PATCH),
            *_OF_WHOLE,
        )
        self._outputs = self.references(names)

    def answer(self, question: Array, time: float, step: float) -> Array:
        self.set(self._inputs, question)
        self.step(time, step)
        values = self.get(self._outputs)
        patches = values[6 : -len(_OF_WHOLE)].reshape(_PATCHES, len(PATCH))
        return self._answer(values[:6], patches, values[-len(_OF_WHOLE) :])
