"""Convert tables of TOML to dataclasses. Messages name unknown keys, missing keys and wrong types."""

from __future__ import annotations

import re
import types
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from contact.errors import ContactError, suggestion

Kind = TypeVar("Kind")


def build(kind: type[Kind], table: object, where: str) -> Kind:
    """Return an object of the dataclass `kind` from a table.

    Parameters
    ----------
    kind : type
        A dataclass whose fields are numbers, texts, dataclasses, tuples of these, or unions of them.
    table : dict
        Table from `tomllib`.
    where : str
        Name of the table in messages.

    Raises
    ------
    ContactError
        For unknown or missing keys, wrong types, and values that `kind` refuses. The message names the place of each, on a
        line of its own.
    """
    if not isinstance(table, dict):
        raise ContactError(f"{where} = {table!r} is not a table")
    hints = get_type_hints(kind)
    known = {entry.name: entry for entry in fields(kind) if entry.init}  # type: ignore[arg-type]
    faults = [
        f"{where}.{key} is unknown{suggestion(key, known)}; allowed: {', '.join(known)}"
        for key in table
        if key not in known
    ]
    needed = [name for name, each in known.items() if each.default is MISSING and each.default_factory is MISSING]
    faults += [f"{where}.{name} is missing" for name in needed if name not in table]
    values = {}
    for key in (key for key in table if key in known):
        try:
            values[key] = _convert(hints[key], table[key], f"{where}.{key}")
        except ContactError as error:
            faults.append(str(error))
    made = None
    while all(name in values for name in needed):
        try:
            made = kind(**values)
            break
        except ContactError as error:
            faults.append(f"{where}: {error}")
            wrong = next(iter(re.findall(r"^(?:n_)?(\w+)", str(error))), "")
            if wrong not in values or wrong in needed:
                break
            del values[wrong]  # its default is right, so what else is wrong shows
    if faults:
        raise ContactError("\n".join(faults))
    assert made is not None
    return made


def _convert(hint: Any, value: object, where: str) -> Any:
    options = get_args(hint) if get_origin(hint) in (Union, types.UnionType) else (hint,)
    options = tuple(
        str if get_origin(option) is Literal else option for option in options
    )  # the dataclass checks values
    for option in options:
        if isinstance(option, type) and is_dataclass(option) and isinstance(value, dict):
            return build(option, value, where)
        if get_origin(option) is tuple and isinstance(value, list):
            item = get_args(option)[0]
            return tuple(_convert(item, entry, f"{where}[{k}]") for k, entry in enumerate(value))
        if option is float and isinstance(value, int | float) and not isinstance(value, bool):
            try:
                return float(value)
            except OverflowError:
                raise ContactError(f"{where} is an integer beyond the range of floats") from None
        if option in (int, str, bool) and type(value) is option:
            return value
    raise ContactError(f"{where} = {value!r} is not {' or '.join(_named(o) for o in options if o is not type(None))}")


def _named(option: Any) -> str:
    if is_dataclass(option):
        return "a table"
    if get_origin(option) is tuple:
        return "an array"
    return {float: "a number", int: "an integer", str: "a text", bool: "true or false"}[option]
