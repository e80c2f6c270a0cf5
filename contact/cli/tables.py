"""Tables in the terminal."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import typer
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table as RichTable

from contact.cli.document import document
from contact.cli.output import write_all

#: Signs with which numbers begin. A column without numbers is text, on the left.
_OF_NUMBERS = "0123456789-+−."


def show_table(
    caption: str, headings: Sequence[tuple[str, str]], rows: Sequence[Sequence[str]], console: Console
) -> None:
    """Print a table within 80 columns: headings with their units, and rows. A pair of methods takes two lines."""
    shown = RichTable(
        box=box.SIMPLE_HEAD,
        header_style="bold",
        pad_edge=False,
        show_edge=False,
        collapse_padding=True,
        title=escape(caption) or None,
        title_justify="left",
        title_style="bold",
    )
    for k, (name, unit) in enumerate(headings):
        heading = f"{escape(name)}\n[dim]{escape(unit)}[/dim]" if unit else escape(name)
        right = k > 0 and any(row[k][:1] in _OF_NUMBERS for row in rows if row[k])
        shown.add_column(
            heading,
            justify="right" if right else "left",
            vertical="bottom" if right else "top",
            no_wrap=not k,
            overflow="fold",  # a number loses no digit
        )
    for name, *cells in rows:
        shown.add_row(escape(name.replace(" + ", "\n+ ")), *map(escape, cells))
    console.print(shown)


#: Endings of the texts of a study.
STUDY = (".html", ".md", ".json", ".csv")


def show_study(found: Any, *, as_json: bool, out: Sequence[Path] | None) -> None:
    """Print the tables of a study, or its JSON, and write its files."""
    if as_json:
        typer.echo(document(json.loads(found.json())))
    else:
        console = Console()
        for table in found.tables():
            show_table(table.caption, table.headings, table.rows, console)
    write_all(found, out or [])
