"""Writing of result files, and early exit of a command with a message."""

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
    """Return the command with errors as messages on stderr: exit code 2 for bad input, 1 for a missing extra."""

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
    """Return `contact.plot`. If matplotlib is missing, exit with a message that names the extra."""
    try:
        from contact import plot
    except ImportError as error:
        stop(str(error), 1)
    return plot


def require_extra(extra: str) -> None:
    """Exit with a message if an extra is not installed."""
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
    """Raise a ContactError if a study cannot be written to one of the paths. Call it before the computation."""
    for path in paths:
        require_ending(path, (".html", ".md", ".json", ".csv", *PICTURES))


def write_all(found: Any, paths: Sequence[Path]) -> None:
    """Write the results of a study to each of the paths."""
    for path in paths:
        try:
            found.write(path)
        except ImportError as error:
            stop(str(error), 1)
        typer.echo(f"wrote {path}", err=True)


def stop(message: str, code: int) -> NoReturn:
    typer.echo(f"contact: {message}", err=True)
    raise typer.Exit(code)
