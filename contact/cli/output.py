"""Files that the commands write, and how a command ends early."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

import typer

from contact.errors import ContactError


def drawing() -> Any:
    """`contact.plot`, or the end of the program with the extra that is missing."""
    try:
        from contact import plot
    except ImportError as error:
        stop(str(error), 1)
    return plot


PICTURES = (".png", ".pdf", ".svg")


def write_picture(figure: Any, path: Path) -> None:
    if path.suffix.lower() not in PICTURES:  # matplotlib would append one and write elsewhere than it says
        raise ContactError(f"{path} cannot be written: a picture ends in one of {', '.join(PICTURES)}")
    try:
        figure.savefig(path)
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error}") from None
    typer.echo(f"wrote {path}", err=True)


def write_csv(rows: Sequence[dict[str, Any]], path: Path) -> None:
    try:
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror}") from None
    typer.echo(f"wrote {path}", err=True)


def stop(message: str, code: int) -> NoReturn:
    typer.echo(f"contact: {message}", err=True)
    raise typer.Exit(code)
