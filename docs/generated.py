"""Parts of the site that are made from the code: the keys of a scenario and the options of the command line."""

from __future__ import annotations

import inspect
import re
import types
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from enum import Enum
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from contact.friction import LAWS, VELOCITIES
from contact_models.explained import explained, is_type
from contact_models.life import declared_set
from contact_models.runs import scenario
from contact_models.vehicle import declared as vehicle
from contact_models.vehicle.spectra import SPECTRA

#: Names of the code in docstrings → what they stand for.
_LISTS = {"LAWS": LAWS, "VELOCITIES": VELOCITIES, "SPECTRA": SPECTRA}
_NAMES = {float: "number", int: "integer", str: "text", bool: "true or false"}


def scenarios() -> str:
    """Return Markdown with every key of a scenario, of a set of scenarios and of a vehicle's file."""
    parts = []
    for title, kind, lead in (
        ("A scenario", scenario.Declaration, "The file of `contact run`."),
        ("A set of scenarios", declared_set.Declaration, "The file of `contact wear`."),
        ("A vehicle", vehicle.VehicleDeclaration, "The file that `vehicle` of a scenario names."),
    ):
        parts.append(f"## {title}\n\n{lead}")
        parts += [_table(places, of_kind, title) for of_kind, places in _tables(kind).items()]
    return "\n\n".join(parts) + "\n"


def command_line() -> str:
    """Return Markdown with every command and its options."""
    import typer

    from contact.cli.app import app
    from contact.cli.plugins import add_plugins

    add_plugins(app)
    group: Any = typer.main.get_command(app)
    parts = []
    for name, command in sorted(group.commands.items()):
        inner = getattr(command, "commands", None)
        for full, one in (
            {f"{name} {key}": value for key, value in inner.items()} if inner else {name: command}
        ).items():
            parts.append(_command(full, one))
    return "\n\n".join(parts) + "\n"


def _tables(kind: Any, where: str = "") -> dict[Any, list[str]]:
    """Return class → the places in the file where it stands, from the whole file inwards."""
    found: dict[Any, list[str]] = {kind: [where]}
    hints = get_type_hints(kind)
    for entry in fields(kind):
        for inner, several in _dataclasses(hints[entry.name]):
            path = f"{where}.{entry.name}".lstrip(".")
            for of_kind, places in _tables(inner, path).items():
                shown = [
                    f"[{place}]" if several and place == path and not place.startswith("[") else place
                    for place in places
                ]
                found[of_kind] = found.get(of_kind, []) + shown
    return found


def _dataclasses(hint: Any) -> Iterator[tuple[Any, bool]]:
    """Yield the dataclasses in a type, each with whether there are several of it, as in an array of tables."""
    if get_origin(hint) in (Union, types.UnionType):
        for option in get_args(hint):
            yield from _dataclasses(option)
    elif get_origin(hint) is tuple:
        yield from ((inner, True) for inner, _ in _dataclasses(get_args(hint)[0]))
    elif is_dataclass(hint):
        yield hint, False


def _table(places: list[str], kind: Any, title: str) -> str:
    heading = ", ".join(f"`[{place}]`" for place in dict.fromkeys(places) if place)
    lead = (inspect.getdoc(kind) or "").partition("\n\n")[0].replace("\n", " ")
    hints, known = get_type_hints(kind), explained(kind)
    rows: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for entry in fields(kind):
        if entry.init:
            value, meaning = _type(hints[entry.name]), known.get(entry.name) or lead
            meaning = "see its own table" if "table" in value and is_type(meaning) else meaning
            rows.setdefault((value, meaning), []).append((f"`{entry.name}`", _default(entry)))
    lines = ["| key | value | default | meaning |", "| --- | --- | --- | --- |"]
    for (value, meaning), entries in rows.items():
        keys, defaults = zip(*entries, strict=True)
        for name, listed in _LISTS.items():
            meaning = meaning.replace(f"`{name}`", ", ".join(f"`{each}`" for each in listed))
        cells = (", ".join(keys), value, ", ".join(defaults if len(set(defaults)) > 1 else defaults[:1]), meaning)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join([f"### {heading or f'{title}: keys of the file itself'}", "", lead, "", *lines])


def _type(hint: Any) -> str:
    if get_origin(hint) in (Union, types.UnionType):
        return " or ".join(dict.fromkeys(_type(option) for option in get_args(hint) if option is not type(None)))
    if get_origin(hint) is tuple:
        return f"array: {_type(get_args(hint)[0])}"
    if get_origin(hint) is Literal:
        return ", ".join(f'"{value}"' for value in get_args(hint))
    return "table" if is_dataclass(hint) else _NAMES[hint]


def _default(entry: Field[Any]) -> str:
    if entry.default is MISSING and entry.default_factory is MISSING:
        return "required"
    if entry.default is None or entry.default is MISSING or is_dataclass(entry.default):
        return "–"
    if isinstance(entry.default, bool):
        return str(entry.default).lower()
    if isinstance(entry.default, tuple):
        return f"{list(entry.default)}" if entry.default else "–"
    return f'"{entry.default}"' if isinstance(entry.default, str) else f"{entry.default:.10g}"


def _command(name: str, command: Any) -> str:
    """Return the section of a command: what it does, and a table of its options in their groups."""
    said = [_typed(" ".join(part.split())) for part in re.split(r"\n\s*\n", inspect.cleandoc(command.help or ""))]
    groups: dict[str, list[str]] = {}
    arguments = []
    for parameter in command.params:
        if parameter.name in ("help", "context"):
            continue
        default = getattr(parameter, "show_default", True)
        value = parameter.default
        shown = default if isinstance(default, str) else _shown(value)
        text = _typed(getattr(parameter, "help", "") or "").replace("|", "\\|")
        if parameter.param_type_name == "argument":
            arguments.append(f"`{parameter.name.upper()}`: {text}")
            continue
        spelled = ", ".join(f"`{word}`" for word in (*parameter.opts, *parameter.secondary_opts))
        metavar = "" if parameter.is_flag else f" `{_metavar(parameter)}`"
        metavar = metavar.replace("|", "\\|")
        row = f"| {spelled}{metavar} | {shown} | {text} |"
        groups.setdefault(getattr(parameter, "rich_help_panel", None) or "Options", []).append(row)
    lines = [f"## contact {name}", *said, *arguments]
    if groups:
        table = ["| option | default | meaning |", "| --- | --- | --- |"]
        for group, rows in groups.items():
            table += [f"| **{group}** | | |", *rows]
        lines.append("\n".join(table))
    return "\n\n".join(lines)


def _typed(text: str) -> str:
    """Return a text in which examples and options are set as code. Otherwise -- would become a dash."""
    before, word, examples = (
        re.split(r"(Examples?:)", text, maxsplit=1) if re.search(r"Examples?:", text) else (text, "", "")
    )
    parts = []
    for example in examples.split("·") if examples else []:
        command, comma, rest = example.strip().partition(", to ")
        parts.append(f"`{command}`{comma}{rest}")
    before = re.sub(r"(?<![`\w-])(--[a-z][\w-]*)", r"`\1`", before)
    return f"{before}{word} {', '.join(parts)}".strip()


def _metavar(parameter: Any) -> str:
    """Return the placeholder of an option's value. typer keeps the type in different places from version to version."""
    annotation = getattr(getattr(parameter, "type_descriptor", None), "annotation", None)
    if annotation is None:
        annotation = {"float": float, "integer": int}.get(parameter.type.name.removesuffix(" range"), str)
    inner = get_args(annotation)[0] if get_origin(annotation) is list else annotation
    if isinstance(inner, type) and issubclass(inner, Enum):
        return "|".join(str(member.value) for member in inner)
    return parameter.metavar or _NAMES.get(inner, getattr(inner, "__name__", "text")).upper()


def _shown(value: Any) -> str:
    value = value() if callable(value) else value
    value = getattr(value, "value", value)
    if value is None or value is False or "UNSET" in str(value).upper():
        return ""
    return " ".join(map(str, value)) if isinstance(value, list | tuple) else str(value)
