"""JSON of every command: version, inputs, units and results."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

import contact
from contact.view.units import UNITS

#: Units of names that mean another thing in some commands: the rotation of a wheel.
_ROTATING = {"spin": "rad/s", "creepage.spin": "1/m"}
_OF_COMMAND = dict.fromkeys(("rail", "roller", "in_time", "along"), _ROTATING) | {
    "curving": {"spin": "rad/s", "lateral": "N"},
    "demo": {"lateral": "m"},
}


_RUNNING: ContextVar[tuple[str, dict[str, Any]]] = ContextVar("_RUNNING", default=("", {}))
#: The options of the running command with their values, for its messages.
GIVEN: ContextVar[Mapping[str, Any]] = ContextVar("GIVEN")


@contextmanager
def running(command: str, inputs: Mapping[str, Any], given: Mapping[str, Any]) -> Iterator[None]:
    """Context manager in which `document` has the name and the inputs of a command, and `GIVEN` its options."""
    tokens = _RUNNING.set((command, dict(inputs))), GIVEN.set(given)
    try:
        yield
    finally:
        _RUNNING.reset(tokens[0])
        GIVEN.reset(tokens[1])


def in_effect(**values: Any) -> None:
    """Record the values that the command uses for inputs that were not given, for its JSON."""
    inputs = _RUNNING.get()[1]
    for name, value in values.items():
        if name in inputs and inputs[name] is None:
            inputs[name] = value


def document(content: Mapping[str, Any]) -> str:
    """Return the results of the running command as JSON with version, command, inputs and units.

    Infinite values and values that are no number become null.
    """
    command, given = _RUNNING.get()
    inputs = _plain({name: value for name, value in given.items() if name not in ("context", "as_json", "out")})
    results = _plain(dict(content))
    known = UNITS | _OF_COMMAND.get(command, {})
    units = {name: known[name] for name in sorted({*_keys(inputs), *_keys(results)} & set(known))}
    head = {"version": contact.__version__, "command": command, "inputs": inputs, "units": units}
    return json.dumps(head | results, indent=2, allow_nan=False, ensure_ascii=False)


def _plain(value: Any) -> Any:
    """Return a value as JSON can hold it."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner) for key, inner in value.items()}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return str(value) if isinstance(value, Path) else value


def _keys(value: Any, parent: str = "") -> Iterator[str]:
    """Yield the names in a document, each also as a member of what holds it: ``spin`` and ``creepage.spin``."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield f"{parent}.{key}"
            yield from _keys(inner, key)
    elif isinstance(value, list):
        for inner in value:
            yield from _keys(inner, parent)


def flat(row: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Return a nested row as a row of CSV: ``creepage.spin``, and numbers of lists as ``position.0``."""
    cells: dict[str, Any] = {}
    for key, value in row.items():
        name = f"{before}{key}"
        if isinstance(value, list | tuple):
            value = {str(k): inner for k, inner in enumerate(value)}
        cells |= flat(value, f"{name}.") if isinstance(value, Mapping) else {name: value}
    return cells
