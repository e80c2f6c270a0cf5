"""An FMU as a component, driven by fmpy."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from os import PathLike
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from numpy.typing import ArrayLike, NDArray

from contact.errors import ContactError

_DISCARD = 2  # FMI status Discard; higher values are Error and Fatal


class FmuComponent:
    """FMI 2.0 co-simulation FMU with the ports of `contact_models.wheelset.ports`. As a context manager it frees the FMU.

    Parameters
    ----------
    path : path
        Path of the FMU.
    ports : mapping
        Name of a port → names of its variables.
    start : mapping
        Name of a variable → value of the parameter or input before initialisation.

    Raises
    ------
    ContactError
        If the FMU refuses a call, with the message in its log. All methods may raise it.
    """

    def __init__(
        self,
        path: str | PathLike[str],
        ports: Mapping[str, tuple[str, ...]],
        start: Mapping[str, float] | None = None,
    ) -> None:
        description = fmpy.read_model_description(str(path))
        variables = {v.name: v for v in description.modelVariables}
        self._directory = fmpy.extract(str(path))
        self._fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self._directory,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self._objections: list[str] = []
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        self._references = {port: [variables[n].valueReference for n in names] for port, names in ports.items()}
        self._types = {port: [variables[n].type for n in names] for port, names in ports.items()}
        self._mixed = {port for port, types in self._types.items() if set(types) != {"Real"}}
        self._fmu.setupExperiment(startTime=0.0)
        for name, value in (start or {}).items():
            self._set(variables[name].type, variables[name].valueReference, value)
        self._call(self._fmu.enterInitializationMode)
        self._call(self._fmu.exitInitializationMode)

    def write(self, port: str, values: ArrayLike) -> None:
        self._call(self._fmu.setReal, self._references[port], np.asarray(values, dtype=np.float64).tolist())

    def read(self, port: str) -> NDArray[np.float64]:
        references = self._references[port]
        if port not in self._mixed:
            return np.array(self._fmu.getReal(references))
        # the port contains an integer status, so read variable by variable
        values = [self._get(kind, r) for kind, r in zip(self._types[port], references, strict=True)]
        return np.array(values, dtype=np.float64)

    def step(self, time: float, h: float) -> None:
        self._call(self._fmu.doStep, time, h)

    def save(self) -> Any:
        return self._fmu.getFMUState()

    def restore(self, state: Any) -> None:
        self._fmu.setFMUState(state)
        self._fmu.freeFMUState(state)

    def __enter__(self) -> FmuComponent:
        return self

    def __exit__(self, *exception: object) -> None:
        self._fmu.terminate()
        self._fmu.freeInstance()
        shutil.rmtree(self._directory, ignore_errors=True)

    def _set(self, kind: str, reference: int, value: float) -> None:
        if kind == "Real":
            self._call(self._fmu.setReal, [reference], [float(value)])
        else:
            self._call(self._fmu.setInteger, [reference], [int(value)])

    def _get(self, kind: str, reference: int) -> float:
        return (self._fmu.getReal if kind == "Real" else self._fmu.getInteger)([reference])[0]

    def _call(self, function: Callable[..., Any], *arguments: object) -> None:
        """Call a function and raise the FMU's error messages. pythonfmu returns OK for some calls that the FMU refuses."""
        self._objections.clear()
        try:
            function(*arguments)
        except FMICallException as error:
            raise ContactError("; ".join(self._objections) or str(error)) from None
        if self._objections:
            raise ContactError("; ".join(self._objections))

    def _log(self, environment: object, name: bytes, status: int, category: bytes, message: bytes) -> None:
        if status >= _DISCARD:
            self._objections.append(message.decode())
