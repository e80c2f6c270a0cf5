"""pythonfmu's slave: it passes every call on to the FMI functions of the native FMU (`native/c`), in the installed library.

So both packagings are one program. pythonfmu 0.7.0 turns an exception in a callback into fmi2Fatal, and the fifth one crashes
the host (measured). What the functions refuse, they log, and `c/entry.c` returns the status of the worst message of a call.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from pythonfmu.enums import Fmi2Status
from pythonfmu.fmi2slave import Fmi2Slave

from contact import __version__
from ..description import LOG_CATEGORIES
from ..native import components, systems
from ..native.table import NAME, content
from .ending import release_once

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

_LOGGER = ctypes.CFUNCTYPE(
    None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p
)  # and what its text is filled with, which is nothing
_CO_SIMULATION, _WARNING = 1, 1


class _Callbacks(ctypes.Structure):
    """fmi2CallbackFunctions. The native FMU uses the logger alone."""

    _fields_ = [
        ("logger", _LOGGER),
        *((name, ctypes.c_void_p) for name in ("allocate", "free", "finished", "environment")),
    ]


@cache
def _model(declared: str, options: tuple[tuple[str, Any], ...], guid: str) -> tuple[str, bytes]:
    """Return the name of an FMU, and what the installed package writes into its file of the model."""
    component = getattr(components, declared)(**dict(options))
    return component.table.name, content(component, guid)


@cache
def _library() -> ctypes.CDLL:
    """Return the FMI functions of this machine. A call of them releases Python's global lock."""
    library = ctypes.CDLL(str(systems.of_this_machine()))
    library.fmi2Instantiate.restype = ctypes.c_void_p
    return library


class _Instance:
    """An instance of the native FMU, and what it has said that was not told yet: statuses and texts."""

    def __init__(self, name: str, guid: str, resources: Path) -> None:
        said: list[tuple[int, str]] = []

        def log(environment: Any, name: bytes, status: int, category: bytes, text: bytes) -> None:
            said.append((status, text.decode(errors="replace")))

        self._address = None
        self.said, self._callbacks, self._library = said, _Callbacks(logger=_LOGGER(log)), _library()
        self._address = self._library.fmi2Instantiate(
            name.encode(), _CO_SIMULATION, guid.encode(), resources.absolute().as_uri().encode(),
            ctypes.byref(self._callbacks), 0, 1,
        )  # fmt: skip

    def __bool__(self) -> bool:
        """Whether there is an instance."""
        return bool(self._address)

    def call(self, function: str, *arguments: Any) -> bool:
        """Call a function of FMI. Return whether it did what it should."""
        return bool(self._library[f"fmi2{function}"](ctypes.c_void_p(self._address), *arguments) <= _WARNING)

    def __del__(self) -> None:
        if self:
            self.call("FreeInstance")


def _references(references: list[int]) -> tuple[Any, ctypes.c_size_t]:
    """Return value references as FMI takes them: an array, and its size."""
    n = len(references)
    return (ctypes.c_uint * n)(*references), ctypes.c_size_t(n)


def _getter(name: str, kind: Any) -> Callable[[ModelSlave, list[int]], list[Any]]:
    """Return the method that reads variables of one type of FMI; where that is refused they are 0."""

    def get(self: ModelSlave, references: list[int]) -> list[Any]:
        values = (kind * len(references))()
        if references:  # `c/entry.c` reads nothing as soon as there is an instance
            self._call(f"Get{name}", *_references(references), values)
        return list(values)

    return get


def _setter(name: str, kind: Any) -> Callable[[ModelSlave, list[int], list[Any]], None]:
    """Return the method that sets variables of one type of FMI."""

    def set_(self: ModelSlave, references: list[int], values: list[Any]) -> None:
        self._call(f"Set{name}", *_references(references), (kind * len(values))(*values))

    return set_


class ModelSlave(Fmi2Slave):
    """Slave of the FMU that a function of `native.components` declares.

    Parameters
    ----------
    declared, options : str, dict
        Name of the function, and its arguments.
    guid : str
        Guid in the FMU's modelDescription.xml.

    Raises
    ------
    RuntimeError
        If the FMU was built with another version of this package, or if no instance can be made.
    """

    log_categories = LOG_CATEGORIES

    def __init__(self, declared: str, options: dict[str, Any], guid: str, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if self.resources in sys.path:
            # pythonfmu adds this entry for every instance and never removes it. The script is already imported.
            sys.path.remove(self.resources)
        release_once(self.resources)
        folder = Path(self.resources)
        name, model = _model(declared, tuple(sorted(options.items())), guid)
        if (folder / NAME).read_bytes() != model:
            reason = (
                f"this FMU {name} was built with another version of wheelrail-contact than the installed "
                f"{__version__}: install that version, or build the FMU anew"
            )
            raise RuntimeError(reason)
        self.guid = guid
        self._instance = _Instance(self.instance_name, guid, folder)
        if not self._instance:
            raise RuntimeError("; ".join(text for _, text in self._instance.said))

    def _call(self, function: str, *arguments: Any) -> bool:
        """Call a function of FMI and tell what it says. Return whether it did what it should."""
        done = self._instance.call(function, *arguments)
        self._tell()
        return done

    def _tell(self) -> None:
        while self._instance.said:
            status, text = self._instance.said.pop(0)
            self.log(text, Fmi2Status(status))

    def setup_experiment(self, start_time: float, stop_time: float | None, tolerance: float | None) -> None:
        """Remember start and stop time."""
        start, stop = ctypes.c_double(start_time), ctypes.c_double(stop_time or 0.0)
        self._call("SetupExperiment", 0, ctypes.c_double(), start, int(stop_time is not None), stop)

    def enter_initialization_mode(self) -> None:
        """Enter initialisation mode, in which outputs follow what is set."""
        self._call("EnterInitializationMode")

    def exit_initialization_mode(self) -> None:
        """Fix the parameters and compute the outputs at the start."""
        self._call("ExitInitializationMode")

    def terminate(self) -> None:
        """End the run."""
        self._call("Terminate")

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance the outputs by one step. Return False (Discard) if this fails; the outputs are then unchanged."""
        return self._call("DoStep", ctypes.c_double(current_time), ctypes.c_double(step_size), 0)

    get_real, set_real = _getter("Real", ctypes.c_double), _setter("Real", ctypes.c_double)
    get_integer, set_integer = _getter("Integer", ctypes.c_int), _setter("Integer", ctypes.c_int)
    get_boolean, set_boolean = _getter("Boolean", ctypes.c_int), _setter("Boolean", ctypes.c_int)

    def get_string(self, references: list[int]) -> list[str]:
        """Refuse: no table has Strings."""
        self._call("GetString", *_references(references), None)
        return [""] * len(references)

    def set_string(self, references: list[int], values: list[str]) -> None:
        """Refuse: no table has Strings."""
        self._call("SetString", *_references(references), None)

    def _get_fmu_state(self) -> bytes:
        state, size = ctypes.c_void_p(), ctypes.c_size_t()
        self._call("GetFMUstate", ctypes.byref(state))
        self._call("SerializedFMUstateSize", state, ctypes.byref(size))
        made = ctypes.create_string_buffer(size.value)
        self._call("SerializeFMUstate", state, made, size)
        self._call("FreeFMUstate", ctypes.byref(state))
        return made.raw

    def _set_fmu_state(self, given: bytes) -> None:
        state = ctypes.c_void_p()
        if self._call("DeSerializeFMUstate", given, ctypes.c_size_t(len(given)), ctypes.byref(state)):
            self._call("SetFMUstate", state)
            self._call("FreeFMUstate", ctypes.byref(state))

    @staticmethod
    def _fmu_state_to_bytes(state: bytes) -> bytes:
        return state

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> bytes:
        return state
