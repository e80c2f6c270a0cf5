"""FMU instances for tests."""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import ClassVar, Self

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Model, FMU3Slave

OK, WARNING, DISCARD, ERROR = range(4)


def named(group: str, **values: float) -> dict[str, float]:
    """Return values by the names of an FMU's variables: `group.name`."""
    return {f"{group}.{name}": value for name, value in values.items()}


class Instance:
    """An instance with access to variables by name. It stores its log messages."""

    classes: ClassVar = {"CoSimulation": FMU2Slave, "ModelExchange": FMU2Model}

    def __init__(self, directory: Path, log: list[tuple[int, str]] | None = None, kind: str = "CoSimulation") -> None:
        description = fmpy.read_model_description(str(directory))
        self.variables = {v.name: v for v in description.modelVariables}
        self.log = [] if log is None else log
        self.fmu = self.classes[kind](
            guid=description.guid,
            unzipDirectory=str(directory),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="instance",
        )
        self._instantiate()
        self.time = 0.0  # end of the last step

    def _instantiate(self) -> None:
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self.callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self.callbacks.freeMemory = defaultCallbacks.freeMemory
        self.fmu.instantiate(callbacks=self.callbacks, loggingOn=True)

    def free(self) -> None:
        """Free only the instance. fmpy's call would also unload the library, which other instances use."""
        self.fmu.fmi2FreeInstance(self.fmu.component)

    def _log(self, *words) -> None:
        """Keep the status and the text of a message, of FMI 2.0 or 3.0."""
        self.log.append((words[-3], words[-1].decode()))

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

    def references(self, *groups: Iterable[str]) -> list[list[int]]:
        return [[self.variables[name].valueReference for name in group] for group in groups]

    def directional(self, unknowns: Iterable[str], knowns: Iterable[str], seed: Iterable[float]) -> np.ndarray:
        """Return the derivative of each unknown along a direction: a seed for each of the knowns."""
        return np.array(self.fmu.getDirectionalDerivative(*self.references(unknowns, knowns), list(seed)))

    def quotient(self, unknowns: Iterable[str], knowns: Iterable[str], seed: Iterable[float], h: float) -> np.ndarray:
        """Return the same in model exchange by a central difference of fourth order with steps of h along the direction."""
        at, names, found = self.read(knowns), list(unknowns), []
        for k in (-2, -1, 1, 2, 0):
            self.update({name: value + k * h * s for (name, value), s in zip(at.items(), seed, strict=True)})
            found.append(np.array(list(self.read(names).values())) if k else np.nan)
        return (found[0] - 8.0 * found[1] + 8.0 * found[2] - found[3]) / (12.0 * h)

    def initialize(self, stop_time: float | None = None) -> Self:
        self.time = 0.0
        self._begin(stop_time)
        self.fmu.exitInitializationMode()
        return self

    def _begin(self, stop_time: float | None) -> None:
        self.fmu.setupExperiment(startTime=0.0, stopTime=stop_time)
        self.fmu.enterInitializationMode()

    def step(self, time: float | None = None, h: float = 1e-3) -> object:
        """Do a step from `time`, by default from the end of the last one. Return what fmpy returns."""
        begin = self.time if time is None else time
        answer = self.fmu.doStep(begin, h)
        self.time = begin + h
        return answer


class Instance3(Instance):
    """An instance of FMI 3.0. Arrays are variables; an element has its name of FMI 2.0 too: `wheel[2].force.y`."""

    classes: ClassVar = {"CoSimulation": FMU3Slave, "ModelExchange": FMU3Model}

    def _instantiate(self) -> None:
        self.fmu.instantiate(loggingOn=True, logMessage=self._log)

    def free(self) -> None:
        self.fmu.fmi3FreeInstance(self.fmu.component)

    def _call(self, prefix: str, name: str):
        kind = self.variables[name].type
        return getattr(self.fmu, prefix + ("Int64" if kind == "Enumeration" else kind))

    def element(self, name: str) -> tuple[str, tuple[int, ...]]:
        """Return the variable and the place in it of what FMI 2.0 has as one number."""
        index = re.search(r"\[([\d,]+)\]", name)
        if name in self.variables or not index:
            return name, ()
        return name.replace(index[0], ""), tuple(int(i) - 1 for i in index[1].split(","))

    def shape(self, name: str) -> tuple[int, ...]:
        """Return the present shape of an array of the instance."""
        return tuple(d.start or self[d.variable.name] for d in self.variables[name].dimensions)

    def update(self, values: dict) -> None:
        whole = {}
        for name, value in values.items():
            variable, place = self.element(name)
            if place:
                whole.setdefault(variable, self[variable])[place] = value
            else:
                whole[variable] = value
        for name, value in whole.items():
            self._call("set", name)([self.variables[name].valueReference], np.ravel(value).tolist())

    def __getitem__(self, name: str):
        name, place = self.element(name)
        shape = self.shape(name)
        values = self._call("get", name)([self.variables[name].valueReference], nValues=int(np.prod(shape)))
        return np.array(values).reshape(shape)[place] if shape else values[0]

    def read(self, names: Iterable[str]) -> dict:
        """Return values, those of arrays as nested lists."""
        return {name: np.array(self[name]).tolist() for name in names}

    def size(self, names: Iterable[str]) -> int:
        return sum(int(np.prod(self.shape(name))) for name in names)

    def directional(self, unknowns: Iterable[str], knowns: Iterable[str], seed: Iterable[float]) -> np.ndarray:
        """Return directional derivatives by a seed for each element of the knowns."""
        references, n = self.references(unknowns, knowns), self.size(unknowns)
        return np.array(self.fmu.getDirectionalDerivative(*references, list(seed), nSensitivity=n))

    def adjoint(self, unknowns: list[str], knowns: list[str], seed: Iterable[float]) -> np.ndarray:
        """Return adjoint derivatives by a seed for each element of the unknowns."""
        references, n = self.references(unknowns, knowns), self.size(knowns)
        return np.array(self.fmu.getAdjointDerivative(*references, list(seed), nSensitivity=n))

    def configure(self, **counts: int) -> Self:
        """Set structural parameters `resolution.…`."""
        self.fmu.enterConfigurationMode()
        self.update({f"resolution.{name}": count for name, count in counts.items()})
        self.fmu.exitConfigurationMode()
        return self

    def _begin(self, stop_time: float | None) -> None:
        self.fmu.enterInitializationMode(startTime=0.0, stopTime=stop_time)


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
