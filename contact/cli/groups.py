"""Groups of options: a parameter of a command that is a dataclass stands for the options in its fields."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, TypeVar, get_type_hints

Command = TypeVar("Command", bound=Callable[..., None])


def expanded(command: Command) -> Command:
    """Return the command with the fields of dataclasses in place of the parameters that have them as annotation.

    The fields have the annotations of typer. The command receives objects of the dataclasses.
    """
    hints = get_type_hints(command, include_extras=True)
    groups: dict[str, Any] = {name: kind for name, kind in hints.items() if is_dataclass(kind)}
    parameters: list[inspect.Parameter] = []
    for name, parameter in inspect.signature(command).parameters.items():
        if name in groups:
            parameters += _options(groups[name])
        else:
            parameters.append(parameter.replace(annotation=hints[name]))

    @functools.wraps(command)
    def wrapper(*args: Any, **given: Any) -> None:
        for name, kind in groups.items():
            given[name] = kind(**{entry.name: given.pop(entry.name) for entry in fields(kind)})
        command(*args, **given)

    order = sorted(parameters, key=lambda parameter: parameter.kind)
    wrapper.__signature__ = inspect.Signature(order)  # type: ignore[attr-defined]
    wrapper.__annotations__ = {parameter.name: parameter.annotation for parameter in order}
    return wrapper  # type: ignore[return-value]


def _options(kind: Any) -> list[inspect.Parameter]:
    """Return the parameters that stand for the fields of a group. Groups hold no lists, so a factory's value can be shared."""
    hints = get_type_hints(kind, include_extras=True)
    return [
        inspect.Parameter(
            entry.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=entry.default if entry.default is not MISSING else inspect.Parameter.empty,
            annotation=hints[entry.name],
        )
        for entry in fields(kind)
    ]
