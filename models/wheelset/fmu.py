"""An FMU as a component, driven by fmpy."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from os import PathLike

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from numpy.typing import ArrayLike, NDArray


class FmuComponent:
    """FMI 2.0 co-simulation FMU with the ports of `models.wheelset.ports`; a context manager that frees it.

    Parameters
    ----------
    path : path
    ports : mapping
        Name of a port → names of its variables.
    start : mapping
        Name of a variable → value of the parameter or input before initialisation.
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
        self._fmu.instantiate()
        # A port of one type is read in one call; the few that mix types (a status among numbers) variable by variable.
        self._ports = {port: [(variables[n].type, variables[n].valueReference) for n in ports[port]] for port in ports}
        self._fmu.setupExperiment(startTime=0.0)
        for name, value in (start or {}).items():
            self._set(variables[name].type, [variables[name].valueReference], [value])
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()

    def write(self, port: str, values: ArrayLike) -> None:
        references = self._ports[port]
        self._fmu.setReal([r for _, r in references], np.asarray(values, dtype=np.float64).tolist())

    def read(self, port: str) -> NDArray[np.float64]:
        references = self._ports[port]
        if all(kind == "Real" for kind, _ in references):
            return np.array(self._fmu.getReal([r for _, r in references]))
        return np.array([self._get(kind, [r])[0] for kind, r in references], dtype=np.float64)

    def step(self, time: float, h: float) -> None:
        self._fmu.doStep(currentCommunicationPoint=time, communicationStepSize=h)

    def save(self) -> object:
        return self._fmu.getFMUState()

    def restore(self, state: object) -> None:
        self._fmu.setFMUState(state)
        self._fmu.freeFMUState(state)

    def __enter__(self) -> FmuComponent:
        return self

    def __exit__(self, *exception: object) -> None:
        self._fmu.terminate()
        self._fmu.freeInstance()
        shutil.rmtree(self._directory, ignore_errors=True)

    def _set(self, kind: str, references: list[int], values: list[float]) -> None:
        if kind == "Real":
            self._fmu.setReal(references, [float(v) for v in values])
        else:
            self._fmu.setInteger(references, [int(v) for v in values])

    def _get(self, kind: str, references: list[int]) -> list[float]:
        return self._fmu.getReal(references) if kind == "Real" else self._fmu.getInteger(references)
