"""FMU instances for tests."""

from collections import defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

OK, WARNING, DISCARD, ERROR = range(4)


def named(group: str, **values: float) -> dict[str, float]:
    """Return values by the names of an FMU's variables: `group.name`."""
    return {f"{group}.{name}": value for name, value in values.items()}


class Instance:
    """An instance with access to variables by name. It stores its log messages."""

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
        self.time = 0.0  # end of the last step

    def free(self) -> None:
        """Free only the instance. fmpy's call would also unload the library, which other instances use."""
        self.fmu.fmi2FreeInstance(self.fmu.component)

    def _log(self, environment, name, status, category, message) -> None:
        self.log.append((status, message.decode()))

    def update(self, values: dict[str, float]) -> None:
        for call, names in self._by_type(values, "set").items():
            call([self.variables[name].valueReference for name in names], [values[name] for name in names])

    def __getitem__(self, name: str) -> float:
        return self.read([name])[name]

    def read(self, names: Iterable[str]) -> dict[str, float]:
        wanted, found = list(names), {}
        for call, chosen in self._by_type(wanted, "get").items():
            found |= zip(chosen, call([self.variables[name].valueReference for name in chosen]), strict=True)
        return {name: found[name] for name in wanted}

    def _by_type(self, names: Iterable[str], verb: str) -> dict[Callable, list[str]]:
        """Return fmpy's function for each FMI type → names of its variables."""
        sorted_names = defaultdict(list)
        for name in names:
            kind = "Real" if self.variables[name].type == "Real" else "Integer"
            sorted_names[getattr(self.fmu, verb + kind)].append(name)
        return sorted_names

    def all(self, *causalities: str) -> dict[str, float]:
        return self.read(name for name, v in self.variables.items() if v.causality in causalities)

    def initialize(self, stop_time: float | None = None) -> "Instance":
        self.time = 0.0
        self.fmu.setupExperiment(startTime=0.0, stopTime=stop_time)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        return self

    def step(self, time: float | None = None, h: float = 1e-3) -> None:
        """Do a step from `time`, by default from the end of the last one."""
        begin = self.time if time is None else time
        self.fmu.doStep(begin, h)
        self.time = begin + h


def refused(call, status: int) -> None:
    """Assert that a call returns this status."""
    with pytest.raises(FMICallException) as caught:
        call()
    assert caught.value.status == status


def discarded(fmu: Instance, time: float | None = None, h: float = 1e-3) -> str:
    """Assert that a step is discarded, and return the message of the FMU."""
    fmu.log.clear()
    refused(lambda: fmu.step(time, h), DISCARD)
    assert [status for status, _ in fmu.log] == [DISCARD]
    return fmu.log[0][1]


def recovers(fmu: Instance, values: dict[str, float], says: str, times: int = 1) -> None:
    """Assert that steps with these values are discarded with a message that begins so, and that the instance then goes on."""
    before, good = fmu.all("output"), fmu.read(values)
    fmu.update(values)
    for _ in range(times):
        assert discarded(fmu).startswith(says)
    assert fmu.all("output") == before
    fmu.update(good)
    fmu.step()


def goes_on(fmu, other, drive: Callable) -> object:
    """Assert that a saved state goes on with the same bits, restored and, serialised, in an `other` instance, of any FMI.

    `drive(instance)` makes steps and returns what they gave. Return the same.
    """
    state = fmu.fmu.getFMUState()
    content, wanted = fmu.fmu.serializeFMUState(state), drive(fmu)
    for one, its in ((fmu, state), (other, other.fmu.deserializeFMUState(content))):
        one.fmu.setFMUState(its)
        one.fmu.freeFMUState(its)
        assert drive(one) == wanted
    return wanted


def answered_extremes(fmu: Instance, trials: int, chosen: Callable[[np.random.Generator], dict]) -> int:
    """Step from inputs of 1e-300 to 1e300, a few at a time, beside the `chosen` ones. Outputs are finite or discarded.

    Return how many steps were answered.
    """
    rng = np.random.default_rng(3)
    inputs = [name for name, v in fmu.variables.items() if v.causality == "input"]
    answered = 0
    for _ in range(trials):
        fmu.fmu.reset()
        fmu.update(chosen(rng))
        try:
            for name in rng.choice(inputs, rng.integers(1, 5)):
                fmu.update(
                    {name: 10.0 ** rng.choice([-300.0, -9.0, -2.0, 0.0, 6.0, 9.0, 300.0]) * rng.uniform(-1.0, 1.0)}
                )
            fmu.initialize()
            fmu.step()
        except FMICallException as error:
            if error.status != DISCARD:
                raise
            continue
        answered += 1
        assert np.isfinite(list(fmu.all("output").values())).all()
    return answered
