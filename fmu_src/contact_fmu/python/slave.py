"""pythonfmu slave that is driven by a variable table: FMI's state machine. An `Instance` computes the values.

pythonfmu 0.7.0 turns an exception in a callback into fmi2Fatal, and the fifth one crashes the host (measured). Therefore no
exception leaves a callback. What is refused is logged, and `c/entry.c` returns the status of the worst message of a call.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Sequence
from enum import StrEnum
from functools import wraps
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pythonfmu.enums import Fmi2Status
from pythonfmu.fmi2slave import Fmi2Slave

from contact import __version__
from contact.arrays import Array
from contact.errors import ContactError
from ..description import LOG_CATEGORIES, model_description
from ..native.component import Component
from ..native.table import about
from ..variables import Causality, Kind, Table
from .doubting import Doubting
from .ending import release_once
from .instance import Instance

#: Capabilities of this packaging: attributes of the element CoSimulation.
INTERFACES = {
    "CoSimulation": {
        "needsExecutionTool": "true",
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }
}

#: Kinds served by FMI's get and set functions: for Reals, for Integers and Enumerations, for Booleans and Strings (none).
_CALLS: tuple[tuple[Kind, ...], ...] = ((Kind.REAL,), (Kind.INTEGER, Kind.ENUMERATION), ())
_REAL, _INTEGER, _NONE = _CALLS


#: Identity of a table → the table, and the guid of its description, which takes .3 s to write.
_GUIDS: dict[int, tuple[Table, str]] = {}


def _guid(table: Table) -> str:
    if id(table) not in _GUIDS:
        _GUIDS[id(table)] = table, model_description(table, INTERFACES)[0]
    return _GUIDS[id(table)][1]


class Phase(StrEnum):
    """State of the instance in FMI's state machine."""

    INSTANTIATED = "before initialisation"
    INITIALIZATION = "in initialisation"
    STEPPING = "after initialisation"
    TERMINATED = "after terminate"
    LOST = "after a state that is not one of this FMU"


class _NotAllowed(Exception):
    """A call that the host must not make now. It has changed nothing."""


def guarded(method: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap a callback so that it logs an exception and returns False: Discard for a wrong value, Error for anything else."""

    @wraps(method)
    def callback(self: TableSlave, *args: Any) -> Any:
        try:
            return method(self, *args)
        except ContactError as error:
            self.log(str(error), Fmi2Status.discard)
        except _NotAllowed as error:
            self.log(str(error), Fmi2Status.error)
        except Exception as error:  # noqa: BLE001 - no exception may reach the host
            self.log(f"{method.__name__}: {type(error).__name__}: {error}", Fmi2Status.error)
        return False

    return callback


def _rounding(time: float, h: float) -> float:
    """Return by how much a host's time may differ, as in `native/c/simulate.c`.

    Masters add up steps, with an error of less than a thousandth of a step. Others keep the time in single precision; half a
    step off is wrong in any case.
    """
    return 1e-3 * h + 16.0 * sys.float_info.epsilon * abs(time) + min(2.0**-23 * abs(time), 0.499 * h)


class TableSlave(Fmi2Slave):
    """Co-simulation slave of an FMU. Its values are one array, indexed by value reference, which an `Instance` computes.

    Parameters
    ----------
    component : Component
    guid : str
        Guid in the FMU's modelDescription.xml. It must equal the guid that the installed package computes.
    make : callable
        Returns the instance for the component and the folder of its resources.

    Raises
    ------
    RuntimeError
        If the FMU was built with another version of this package.
    """

    log_categories = LOG_CATEGORIES

    def __init__(
        self, component: Component, guid: str, make: Callable[[Component, Path], Any] = Instance, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        if self.resources in sys.path:
            # pythonfmu adds this entry for every instance and never removes it. The script is already imported.
            sys.path.remove(self.resources)
        release_once(self.resources)
        table = component.table
        if guid != _guid(table):
            reason = (
                f"this FMU {table.name} was built with another version of wheelrail-contact than the installed "
                f"{__version__}: install that version, or build the FMU anew"
            )
            raise RuntimeError(reason)
        self.component, self.table = component, table
        self.guid = guid
        self.phase = Phase.INSTANTIATED
        self.time, self.stop_time = 0.0, math.inf
        self.values = np.array([s.first for s in table.scalars], np.float64)
        self.solved = self.values.copy()  # values of the last step, to which the lazy rows belong
        self.lazy_is_stale = False
        self.inputs_are_new = True
        self.said = 0  # number of the last warning, which is logged once while it lasts
        self._model = make(component, Path(self.resources))
        self._index(table)

    def _index(self, table: Table) -> None:
        """Sort the value references by what a host may do with them."""
        every = list(enumerate(table.scalars))
        inputs = frozenset(r for r, s in every if s.row.causality is Causality.INPUT)
        tunable = frozenset(r for r, s in every if s.row.tunable)
        exact = frozenset(r for r, s in every if s.row.initial == "exact")
        settable = {
            Phase.INSTANTIATED: inputs | exact,
            Phase.INITIALIZATION: inputs | exact,
            Phase.STEPPING: inputs | tunable,
            Phase.TERMINATED: frozenset[int](),
            Phase.LOST: frozenset[int](),
        }
        self._readable = {kinds: frozenset(r for r, s in every if s.row.kind in kinds) for kinds in _CALLS}
        self._settable = {(p, kinds): settable[p] & self._readable[kinds] for p in Phase for kinds in _CALLS}
        self._lazy = [r for name in self.component.lazy for r in table.references(name)]
        self._computed = np.array([r for r, s in every if not s.row.is_given], np.int64)
        self._checked = np.array([r for r, s in every if s.row.initial == "exact" or r in inputs], np.int64)
        scalars = [table.scalars[r] for r in self._checked]
        # Closed ranges of finite numbers: an open minimum becomes the next number, infinity the largest finite number.
        least = [np.nextafter(s.minimum, np.inf) if s.row.open_minimum else s.minimum for s in scalars]
        self._least = np.maximum(least, -sys.float_info.max)
        self._greatest = np.minimum([s.maximum for s in scalars], sys.float_info.max)
        self._doubts = Doubting(table)
        at: dict[str | None, int] = {name: span.start for name, span in table.span.items()}
        self._choices = [(at[row.name], at[row.twin_of], row.maximum) for row in table.twins if row.is_given]
        mirrors = [(row.name, row.twin_of) for row in table.twins if not row.is_given]
        self._mirrors, self._shown = (
            np.array([r for pair in mirrors for r in table.references(pair[k])], np.int64) for k in range(2)
        )
        self._totals = [(at[name], *(at.get(one) for one in of)) for name, of in self.component.totals.items()]

    # ---------------------------------------------------------------- life of an instance

    @guarded
    def setup_experiment(self, start_time: float, stop_time: float | None, tolerance: float | None) -> None:
        """Remember start and stop time."""
        if not math.isfinite(start_time) or (stop_time is not None and not stop_time >= start_time):
            raise _NotAllowed(
                f"startTime = {start_time:g}, stopTime = {stop_time}: allowed: numbers, the stop not before it"
            )
        self.time = start_time
        self.stop_time = math.inf if stop_time is None else stop_time

    @guarded
    def enter_initialization_mode(self) -> None:
        """Enter initialisation mode, in which outputs follow what is set."""
        self.phase = Phase.INITIALIZATION

    @guarded
    def exit_initialization_mode(self) -> None:
        """Fix the parameters and compute the outputs at the start. After a failure the host may correct a value and repeat."""
        self._update(0.0)
        self.phase = Phase.STEPPING

    @guarded
    def terminate(self) -> None:
        """End the run. Nothing can be set after this."""
        self.phase = Phase.TERMINATED

    @guarded
    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance the outputs by one step. Return False (Discard) if this fails; the outputs are then unchanged."""
        if self.phase is not Phase.STEPPING:
            raise _NotAllowed(f"doStep is not allowed {self.phase}; the call is ignored")
        time, h = float(current_time), float(step_size)
        if not math.isfinite(time):
            raise _NotAllowed(f"currentCommunicationPoint = {time:g} is not finite")
        if not (0.0 < h < math.inf):
            raise _NotAllowed(f"communicationStepSize = {h:g} is outside the allowed range ]0, inf[")
        near = _rounding(time, h)
        if abs(time - self.time) > near:
            raise _NotAllowed(
                f"currentCommunicationPoint = {time:.17g} does not continue the last step, which ended at {self.time:.17g}"
            )
        if time + h > self.stop_time + near:
            raise _NotAllowed(f"end of the step = {time + h:.17g} is after the stopTime = {self.stop_time:.17g}")
        self._update(step_size)
        self.time = current_time + step_size
        return True

    def _update(self, h: float) -> None:
        """Check the ranges of the values and compute the outputs. If this fails, the outputs are unchanged."""
        self.inputs_are_new = False
        self._choose()
        values = self._checked_values()
        number = self._model.solve(values, h)
        if number in self.component.failures:
            raise ContactError(self._reason(number, values))
        for total, rate, speed in self._totals:
            per_second = 1.0 if speed is None else abs(values[speed])
            values[total] += (per_second if rate is None else per_second * values[rate]) * h
        values[self._mirrors] = values[self._shown]
        self._require_finite(values, self._computed)
        self._model.accept(values, h)
        self.values[self._computed] = values[self._computed]
        self.solved, self.lazy_is_stale = values, bool(self._lazy)
        for message in self._doubts.messages(values):
            self.log(message, Fmi2Status.warning)
        if number != self.said and number in self.component.warnings:
            self.log(self.component.warnings[number], Fmi2Status.warning)
        self.said = number

    @guarded
    def _update_at_start(self) -> None:
        """Compute the outputs for the values that have been set so far."""
        self._update(0.0)

    @guarded
    def _update_lazy(self) -> None:
        """Compute the lazy rows of the last step."""
        self.lazy_is_stale = False
        values = self.solved.copy()
        self._model.solve_lazy(values)
        self._require_finite(values, self._lazy)
        self.values[self._lazy] = values[self._lazy]

    def _require_finite(self, values: Array, references: Sequence[int] | NDArray[np.int64]) -> None:
        """Raise ContactError for the first of these that is not finite."""
        finite = np.isfinite(values[references])
        if not finite.all():
            name = self.table.scalars[references[int(np.argmin(finite))]].name
            raise ContactError(f"{name} has no finite value for these inputs")

    def _reason(self, number: int, values: Array) -> str:
        """Return why a step is discarded, with the value that this is about."""
        name, text = about(self.table, self.component.failures[number])
        return f"{name} = {values[self.table.span[name].start]:g}: {text}" if name else text

    def _choose(self) -> None:
        """Let the choices that are not 0 be the values of their enumerations."""
        for twin, of, greatest in self._choices:
            if 1.0 <= self.values[twin] <= greatest:
                self.values[of] = self.values[twin]

    def _checked_values(self) -> Array:
        """Return a copy of the values, with its start in place of a value that is outside its range and is not used.

        Raise ContactError for the first parameter, input or state that is used and not finite or outside its range.
        """
        values = self.values.copy()
        numbers = values[self._checked]
        for k in np.flatnonzero(~((numbers >= self._least) & (numbers <= self._greatest))):
            reference = self._checked[k]
            scalar = self.table.scalars[reference]
            if self.table.uses(scalar.row, values):
                scalar.check(float(values[reference]))
            values[reference] = scalar.first
        return values

    # ---------------------------------------------------------------- get and set

    def get_real(self, references: list[int]) -> list[float]:
        """Return the values of Reals."""
        return self._get(_REAL, references)

    def get_integer(self, references: list[int]) -> list[int]:
        """Return the values of Integers and Enumerations."""
        return self._get(_INTEGER, references)

    def get_boolean(self, references: list[int]) -> list[bool]:
        """Refuse: no table has Booleans."""
        return self._get(_NONE, references)

    def get_string(self, references: list[int]) -> list[str]:
        """Refuse: no table has Strings."""
        return [""] * len(self._get(_NONE, references))

    def set_real(self, references: list[int], values: list[float]) -> None:
        """Set Reals."""
        self._set(_REAL, references, values)

    def set_integer(self, references: list[int], values: list[int]) -> None:
        """Set Integers and Enumerations."""
        self._set(_INTEGER, references, values)

    def set_boolean(self, references: list[int], values: list[bool]) -> None:
        """Refuse: no table has Booleans."""
        self._set(_NONE, references, values)

    def set_string(self, references: list[int], values: list[str]) -> None:
        """Refuse: no table has Strings."""
        self._set(_NONE, references, values)

    def _get(self, kinds: tuple[Kind, ...], references: list[int]) -> list[Any]:
        if self.phase is Phase.INITIALIZATION and self.inputs_are_new:
            self._update_at_start()
        if self.lazy_is_stale and not set(references).isdisjoint(self._lazy):
            self._update_lazy()
        readable = self._readable[kinds] if self.phase is not Phase.INSTANTIATED else ()  # there is nothing yet
        kind = float if kinds is _REAL else int
        for reference in (r for r in references if r not in readable):
            self._refuse("read", reference, kinds)
        return [kind(self.values[reference]) if reference in readable else 0 for reference in references]

    def _set(self, kinds: tuple[Kind, ...], references: list[int], values: list[Any]) -> None:
        self.inputs_are_new = True
        settable = self._settable[self.phase, kinds]
        for reference, value in zip(references, values, strict=True):
            if reference in settable:
                self.values[reference] = value
            else:
                self._refuse("set", reference, kinds)

    def _refuse(self, verb: str, reference: int, kinds: tuple[Kind, ...]) -> None:
        known = 0 <= reference < len(self.table.scalars)
        name = self.table.scalars[reference].name if known else f"value reference {reference}"
        words = " or ".join(kinds) or "Boolean or String"
        self.log(f"{name} cannot be {verb} as {words} {self.phase}; the call is ignored", Fmi2Status.error)

    # ---------------------------------------------------------------- state

    def _get_fmu_state(self) -> dict[str, Any]:
        return {
            "guid": self.guid,
            "phase": self.phase,
            "time": self.time,
            "stop_time": self.stop_time,
            "said": self.said,
            "values": self.values.tolist(),
            "solved": self.solved.tolist(),
            "lazy_is_stale": self.lazy_is_stale,
            "inputs_are_new": self.inputs_are_new,
            "memory": self._model.memory.tobytes().hex(),
        }

    @guarded
    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        if not isinstance(state, dict) or state.get("guid") != self.guid:
            self.phase = Phase.LOST
            raise ValueError(f"this is not a state of the FMU {self.table.name}; set another one")
        both = np.array([state["values"], state["solved"]], np.float64)
        memory = np.frombuffer(bytes.fromhex(state["memory"])).reshape(2, -1).copy()
        if both.shape != (2, self.values.size):
            raise ValueError(f"this state of the FMU {self.table.name} has {both.shape[1]} values")
        self.phase = Phase(state["phase"])
        self.time, self.stop_time, self.said = state["time"], state["stop_time"], state["said"]
        self.values, self.solved = both
        self.lazy_is_stale = state["lazy_is_stale"]
        self.inputs_are_new = state["inputs_are_new"]
        self._model.memory = memory

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return json.dumps(state).encode()  # JSON floats read back exactly

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        try:
            return json.loads(state)
        except ValueError:
            return {}  # setting this state is refused with a message
