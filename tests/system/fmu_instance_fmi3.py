"""FMU instances of FMI 3.0 for tests. Arrays are variables."""

from collections.abc import Iterable
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi3 import FMU3Model, FMU3Slave


class Instance3:
    """An instance with access to variables by name. It stores its log messages."""

    def __init__(self, directory: Path, kind: str = "CoSimulation") -> None:
        description = fmpy.read_model_description(str(directory))
        self.variables = {v.name: v for v in description.modelVariables}
        self.log: list[tuple[int, str]] = []
        self.fmu = (FMU3Slave if kind == "CoSimulation" else FMU3Model)(
            guid=description.guid,
            unzipDirectory=str(directory),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="instance",
        )
        self.fmu.instantiate(loggingOn=True, logMessage=self._log)
        self.time = 0.0  # end of the last step

    def free(self) -> None:
        """Free only the instance. fmpy's call would also unload the library, which other instances use."""
        self.fmu.fmi3FreeInstance(self.fmu.component)

    def _log(self, environment, status, category, message) -> None:
        self.log.append((status, message.decode()))

    def _call(self, prefix: str, name: str):
        kind = self.variables[name].type
        return getattr(self.fmu, prefix + ("Int64" if kind == "Enumeration" else kind))

    def shape(self, name: str) -> tuple[int, ...]:
        """Return the present shape of an array of the instance."""
        return tuple(d.start or self[d.variable.name] for d in self.variables[name].dimensions)

    def update(self, values: dict) -> None:
        for name, value in values.items():
            self._call("set", name)([self.variables[name].valueReference], np.atleast_1d(value).ravel().tolist())

    def __getitem__(self, name: str):
        shape = self.shape(name)
        values = self._call("get", name)([self.variables[name].valueReference], nValues=int(np.prod(shape)))
        return np.array(values).reshape(shape) if shape else values[0]

    def read(self, names: Iterable[str]) -> dict:
        """Return values, those of arrays as nested lists."""
        return {name: np.array(self[name]).tolist() for name in names}

    def all(self, *causalities: str) -> dict:
        return self.read(name for name, v in self.variables.items() if v.causality in causalities)

    def references(self, *groups: Iterable[str]) -> list[list[int]]:
        return [[self.variables[name].valueReference for name in group] for group in groups]

    def size(self, names: Iterable[str]) -> int:
        return sum(int(np.prod(self.shape(name))) for name in names)

    def directional(self, unknowns: list[str], knowns: list[str], seed: Iterable[float]) -> np.ndarray:
        """Return directional derivatives by a seed for each element of the knowns."""
        references, n = self.references(unknowns, knowns), self.size(unknowns)
        return np.array(self.fmu.getDirectionalDerivative(*references, list(seed), nSensitivity=n))

    def adjoint(self, unknowns: list[str], knowns: list[str], seed: Iterable[float]) -> np.ndarray:
        """Return adjoint derivatives by a seed for each element of the unknowns."""
        references, n = self.references(unknowns, knowns), self.size(knowns)
        return np.array(self.fmu.getAdjointDerivative(*references, list(seed), nSensitivity=n))

    def configure(self, **counts: int) -> "Instance3":
        """Set structural parameters `resolution.…`."""
        self.fmu.enterConfigurationMode()
        self.update({f"resolution.{name}": count for name, count in counts.items()})
        self.fmu.exitConfigurationMode()
        return self

    def initialize(self, stop_time: float | None = None) -> "Instance3":
        self.time = 0.0
        self.fmu.enterInitializationMode(startTime=0.0, stopTime=stop_time)
        self.fmu.exitInitializationMode()
        return self

    def step(self, time: float | None = None, h: float = 1e-3) -> tuple[bool, bool, bool, float]:
        """Do a step from `time`, by default from the end of the last one.

        Return the flags event handling needed, terminate, early return, and the last successful time.
        """
        answer = self.fmu.doStep(self.time if time is None else time, h)
        self.time = answer[3]
        return answer
