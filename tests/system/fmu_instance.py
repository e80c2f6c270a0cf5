"""An instance of an FMU for tests."""

from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE


class Instance:
    """An instance that is driven by names and keeps what it logs."""

    def __init__(self, directory: Path, log: list[tuple[int, str]] | None = None, kind: str = "CoSimulation") -> None:
        description = fmpy.read_model_description(str(directory))
        self.variables = {v.name: v for v in description.modelVariables}
        self.log = [] if log is None else log
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self.callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self.callbacks.freeMemory = defaultCallbacks.freeMemory
        self.fmu = (FMU2Slave if kind == "CoSimulation" else FMU2Model)(
            guid=description.guid,
            unzipDirectory=str(directory),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="instance",
        )
        self.fmu.instantiate(callbacks=self.callbacks, loggingOn=True)

    def free(self) -> None:
        """Free the instance alone: fmpy's call unloads the library too, under the feet of other instances."""
        self.fmu.fmi2FreeInstance(self.fmu.component)

    def _log(self, environment, name, status, category, message) -> None:
        self.log.append((status, message.decode()))

    def update(self, values: dict[str, float]) -> None:
        for name, value in values.items():
            variable = self.variables[name]
            call = self.fmu.setReal if variable.type == "Real" else self.fmu.setInteger
            call([variable.valueReference], [value])

    def __getitem__(self, name: str) -> float:
        variable = self.variables[name]
        call = self.fmu.getReal if variable.type == "Real" else self.fmu.getInteger
        return call([variable.valueReference])[0]

    def all(self, *causalities: str) -> dict[str, float]:
        return {name: self[name] for name, v in self.variables.items() if v.causality in causalities}

    def initialize(self, stop_time: float | None = None) -> "Instance":
        self.fmu.setupExperiment(startTime=0.0, stopTime=stop_time)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        return self

    def step(self, time: float = 0.0, h: float = 1e-3) -> None:
        self.fmu.doStep(time, h)
