"""The command `contact vehicle template`: a vehicle's TOML file to begin with, with the meaning of each key."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from contact.cli.output import reported
from contact.errors import ContactError
from ..explained import explained, is_type
from . import declared

_WIDTH = 100
#: Table of the file → the class that it fills.
_TABLES = {
    "bodies": declared.Body,
    "wheelsets": declared.Wheelset,
    "springs": declared.Spring,
    "dampers": declared.Damper,
    "stops": declared.Stop,
    "rail": declared.Rail,
}
app = typer.Typer(help="Files of vehicles.", no_args_is_help=True)


@app.callback()
def _group() -> None:
    """Files of vehicles."""


@app.command()
@reported
def template(
    file: Annotated[Path, typer.Argument(help="TOML file to write", show_default=False)],
    vehicle: Annotated[
        str, typer.Option("--like", help="the included vehicle to begin with: manchester or wheelset")
    ] = ("manchester"),
    force: Annotated[bool, typer.Option("--force", help="overwrite a file")] = False,
) -> None:
    """Write the file of a vehicle with the meaning of each key, to be changed to your own.

    Example:  contact vehicle template mine.toml, then vehicle = "mine.toml" in a scenario
    """
    if file.exists() and not force:
        raise ContactError(f"{file} exists; give another name, or --force")
    text = commented(vehicle)
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        raise ContactError(f"{file} cannot be written: {error.strerror}") from None
    typer.echo(f"wrote {file}", err=True)


def commented(vehicle: str) -> str:
    """Return the text of an included vehicle with the meaning of each key before its first table of a kind."""
    told: set[str] = set()
    lines = list(_meaning("the file itself", declared.VehicleDeclaration))
    for line in declared.find(vehicle).read_text(encoding="utf-8").splitlines():
        name = line.strip("[]")
        if line.startswith("[") and name in _TABLES and name not in told:
            told.add(name)
            lines += _meaning(name, _TABLES[name])
        lines.append(line)
    for name in [name for name in _TABLES if name not in told]:
        lines += ["", f"# Not in this vehicle: [{name}]" if name == "rail" else f"# Not in this vehicle: [[{name}]]"]
        lines += _meaning(name, _TABLES[name])
    return "\n".join(lines) + "\n"


def _meaning(name: str, kind: Any) -> Iterator[str]:
    """Yield the meaning of each key of a table as comments."""
    summary = (inspect.getdoc(kind) or "").partition("\n\n")[0].replace("\n", " ")
    yield from _wrapped(f"{name}: {summary}", "# ")
    for key, meaning in explained(kind).items():
        yield from _wrapped(f"{key}: {'see its own table' if is_type(meaning) else meaning}", "#   ")


def _wrapped(text: str, before: str) -> list[str]:
    return textwrap.wrap(text, _WIDTH, initial_indent=before, subsequent_indent=f"{before}  ")
