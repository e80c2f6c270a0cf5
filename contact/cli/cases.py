"""Cases to compare, from a file or from the options of `contact solve`. The file uses the names of the options.

TOML and JSON files have the cases under `case`, and common values above them. CSV files have a line of names and one line
per case. Creepages and curvatures are lists, in CSV numbers separated by blanks. Values that the file does not contain are
those of the command line.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from typing import Any, get_args, get_type_hints

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.problem import amount_of, find_patches, standard_load
from contact.errors import ContactError, require_number
from contact.inputs.creepage import Creepage
from contact.inputs.separation import Separation
from contact.reading import text
from contact.reading.columns import number
from contact.study import Case

#: Name → type of its value: the options of `contact solve` that make a case.
_KINDS: dict[str, Any] = {"name": str}
for _group in (arguments.PlaceOptions, arguments.Amount):
    for _name, _kind in get_type_hints(_group).items():
        _KINDS[_name] = get_args(_kind)[0] if type(None) in get_args(_kind) else _kind
_KINDS |= {"side": str, "friction": float, "curvatures": tuple[float, float]}


def read(path: Path, defaults: Mapping[str, Any]) -> list[Case]:
    """Return the cases of a file. `defaults` are the values of the options.

    Raises
    ------
    ContactError
        If the file cannot be read, holds no case, or has an unknown name or an invalid value.
    """
    readers = {".toml": _toml, ".json": _json, ".csv": _csv}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise ContactError(f"{path} cannot be read: a file of cases ends in one of {', '.join(readers)}")
    if not path.is_file():
        raise ContactError(f"{path} cannot be read: No such file")
    try:
        common, cases = reader(text.read(path))
    except (ValueError, RecursionError) as error:  # includes the errors of tomllib, json and `text.read`
        raise ContactError(f"{path} cannot be read: {error}") from None
    if not cases:
        raise ContactError(f"{path} holds no case")
    found: list[Case] = []
    for k, case in enumerate(cases, 1):
        where = f"{path}, case {k}"
        if not isinstance(case, Mapping):
            raise ContactError(f"{where}: {case!r} is not a table of names and values")
        if "curvatures" in case and (idle := sorted(arguments.OF_A_POSITION.intersection(case))):
            raise ContactError(f"{where}: {', '.join(idle)}: curvatures replace wheel, rail and position")
        given = {name: _value(where, name, value) for name, value in (common | dict(case)).items()}
        try:
            found += cases_of({"name": f"case {k}", **defaults, **given})
        except ContactError as error:
            error.args = (f"{where}: {error}",)
            raise
    return found


def cases_of(given: Mapping[str, Any]) -> list[Case]:
    """Return one case per contact patch, from values under the names of the options; none without contact."""
    creepage = None if given["creepage"] is None else Creepage(*given["creepage"])
    common = {"friction": given["friction"], "speed": given["speed"]}
    load, penetration, name = given["load"], given["penetration"], given.get("name", "")
    if given["curvatures"] is not None:
        A, B = given["curvatures"]
        load = standard_load(load, penetration)
        return [
            Case(
                Separation.hertzian(A, B),
                creepage or Creepage(),
                load=load,
                approach=penetration,
                name=name or f"half curvatures {A:g} and {B:g} 1/m",
                **common,
            )
        ]
    if given["side"] not in list(opt.SideOption):
        raise ContactError(f"side = {given['side']!r} is none of {', '.join(opt.SideOption)}")
    place = arguments.PlaceOptions(**{entry.name: given[entry.name] for entry in fields(arguments.PlaceOptions)})
    position = place.position(opt.SideOption(given["side"]))
    pose = position.pose
    found = list(find_patches(position, load, penetration))
    bodies = " on ".join(_shown(given[body]) for body in ("wheel", "rail"))
    name = f"{name}, {bodies}" if name else f"{bodies}, y = {1e3 * pose.y:g} mm, yaw {1e3 * pose.yaw:g} mrad"
    return [
        Case(
            patch.separation,
            creepage or patch.creepage,
            name=f"{name}, {side} {number}" if len(found) > 1 else name,
            **amount_of(patch),
            **common,
        )
        for side, number, patch in found
    ]


def _shown(profile: str) -> str:
    """Return the name of a standard profile in capitals, or that of a file without its folder."""
    name = Path(profile).name
    return name if "." in name else name.upper()


def _toml(given: str) -> tuple[dict[str, Any], Sequence[Any]]:
    return _split(text.toml_of(given, "it"))


def _json(given: str) -> tuple[dict[str, Any], Sequence[Any]]:
    content = json.loads(given, object_pairs_hook=_once)
    return ({}, content) if isinstance(content, list) else _split(content)


def _csv(given: str) -> tuple[dict[str, Any], Sequence[Any]]:
    lines = [line for line in text.plain(given).splitlines() if line.strip() and not line.startswith("#")]
    separator = next((sign for sign in ";\t" if lines and sign in lines[0]), ",")
    rows = csv.DictReader(lines, delimiter=separator)
    _once([(name.strip(), "") for name in rows.fieldnames or ()])
    cases = list(rows)
    if any(None in case or None in case.values() for case in cases):
        raise ValueError("a line has more or fewer cells than names")
    return {}, [{name.strip(): _cell(cell, separator) for name, cell in case.items() if cell.strip()} for case in cases]


def _once(pairs: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Return names and values as a table; Python keeps the last of equal names."""
    made: dict[str, Any] = {}
    for name, value in pairs:
        if name and name in made:
            raise ValueError(f"the name {name!r} stands twice")
        made[name] = value
    return made


def _cell(cell: str, separator: str) -> str:
    """Return a cell, of numbers with decimal points."""
    words = cell.split()
    if separator != "," and all(number(word, comma=True) is not None for word in words):
        return " ".join(word.replace(",", ".") for word in words)
    return cell.strip()


def _split(content: Any) -> tuple[dict[str, Any], Sequence[Any]]:
    if not isinstance(content, dict) or not isinstance(content.get("case"), list):
        raise ValueError("there is no list of cases called 'case'")
    return {name: value for name, value in content.items() if name != "case"}, content["case"]


def _value(where: str, name: str, value: Any) -> Any:
    """Return the value of `name` with the right type, or raise a ContactError. The solver checks ranges later."""
    if name not in _KINDS:
        raise ContactError(f"{where}: unknown name {name!r}; allowed: {', '.join(_KINDS)}")
    kind, name = _KINDS[name], f"{where}: {name}"
    if kind is str:
        return str(value)
    if kind is bool:
        if (word := str(value).lower()) not in ("true", "false"):
            raise ContactError(f"{name} = {value!r} is neither true nor false")
        return word == "true"
    if kind is float:
        return _number(name, value)
    count, parts = len(get_args(kind)), value.split() if isinstance(value, str) else value
    if not isinstance(parts, list) or len(parts) != count:
        raise ContactError(f"{name} = {value!r} is not a list of {count} numbers")
    numbers = tuple(_number(name, part) for part in parts)
    return tuple(int(x) if one is int and x.is_integer() else x for one, x in zip(get_args(kind), numbers, strict=True))


def _number(name: str, value: Any) -> float:
    """Return a number, also from its text, because CSV values are text."""
    if isinstance(value, str):
        with suppress(ValueError):  # require_number refuses the text below
            value = float(value)
    return require_number(name, value)
