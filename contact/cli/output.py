"""Files that the commands write, and how a command ends early."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import typer

from contact.cli.extras import EXTRAS, missing
from contact.errors import ContactError
from contact.study.files import PICTURES, csv_of, require_ending, write

Command = TypeVar("Command", bound=Callable[..., None])


def reported(command: Command) -> Command:
    """Let a command end with a message on stderr: exit code 2 when it gets bad input, 1 when an extra is missing."""

    @functools.wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> None:
        try:
            command(*args, **kwargs)
        except ContactError as error:
            stop(str(error), 2)
        except ImportError as error:
            if "pip install 'wheelrail-contact[" not in str(error):
                raise
            stop(str(error), 1)

    return wrapper  # type: ignore[return-value]


def drawing() -> Any:
    """`contact.plot`, or the end of the program with the extra that is missing."""
    try:
        from contact import plot
    except ImportError as error:
        stop(str(error), 1)
    return plot


def require_extra(extra: str) -> None:
    """Go on if an extra is installed; else end the program with a line that names it."""
    if extra in missing():
        module, use = EXTRAS[extra]
        stop(f"{module} is missing ({use}): pip install 'wheelrail-contact[{extra}]'", 1)


def write_picture(figure: Any, path: Path) -> None:
    write(path, {}, lambda: figure)
    typer.echo(f"wrote {path}", err=True)


def write_csv(rows: Sequence[dict[str, Any]], path: Path) -> None:
    write(path, {".csv": lambda: csv_of(rows)})
    typer.echo(f"wrote {path}", err=True)


def require_endings(paths: Sequence[Path]) -> None:
    """Refuse, before minutes of work, a file that the results of a study cannot be written to."""
    for path in paths:
        require_ending(path, (".html", ".md", ".json", ".csv", *PICTURES))


def write_all(found: Any, paths: Sequence[Path]) -> None:
    """Write the results of a study to each of the files."""
    for path in paths:
        try:
            found.write(path)
        except ImportError as error:
            stop(str(error), 1)
        typer.echo(f"wrote {path}", err=True)


def stop(message: str, code: int) -> NoReturn:
    typer.echo(f"contact: {message}", err=True)
    raise typer.Exit(code)
