"""Print the tables of `contact.study` in the terminal."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import typer
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table as RichTable

from contact.cli.document import document
from contact.cli.output import write_all
from contact.study.table import Table


def show_study(found: Any, *, as_json: bool, out: Sequence[Path] | None, notes: Iterable[str] = ()) -> None:
    """Print the tables and notes of a study, or its JSON, and write its files."""
    if as_json:
        typer.echo(document(json.loads(found.json())))
    else:
        console = Console()
        show_tables(found.tables(), console)
        for note in notes:
            console.print(note, style="dim", highlight=False)
    write_all(found, out or [])


def show_tables(tables: Iterable[Table], console: Console) -> None:
    """Print tables within 80 columns. A pair of methods takes two lines."""
    for table in tables:
        shown = RichTable(
            box=box.SIMPLE_HEAD,
            header_style="bold",
            pad_edge=False,
            show_edge=False,
            collapse_padding=True,
            title=escape(table.caption),
            title_justify="left",
            title_style="",
        )
        (first, _), *others = table.headings
        shown.add_column(first, no_wrap=True)
        for name, unit in others:
            shown.add_column(f"{escape(name)}\n[dim]{escape(unit)}[/dim]", justify="right", vertical="bottom")
        for name, *cells in table.rows:
            shown.add_row(escape(name.replace(" + ", "\n+ ")), *map(escape, cells))
        console.print(shown)
