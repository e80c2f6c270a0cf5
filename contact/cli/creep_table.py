"""The command `table`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact.cli import options as opt
from contact.cli.output import deliver, reported
from contact.cli.progress import progress_bar
from contact.study import creep_table
from contact.study import effective as effective_creepage
from contact.theory import force_table as table

app = typer.Typer(
    name="table",
    help="The tables that the tangential methods `table` and `fastrip_mapped` read.",
    no_args_is_help=True,
)


@app.command()
@reported
def build(
    out: Annotated[Path, typer.Option(help="CSV file; rows that it already contains are not computed again")],
    elements: Annotated[
        int, typer.Option(min=10, max=400, help="rows and columns of the half space on the ellipse")
    ] = 60,
    processes: Annotated[int | None, typer.Option(min=1, help="processes", show_default="all cores")] = None,
    as_json: opt.Json = False,
) -> None:
    """Compute the table with the half space: 15 180 cases, ten minutes on one core. An interrupted run continues.

    Example:  contact table build --out creep_table.csv, to replace the package's contact/data/creep_table.csv
    """
    with progress_bar() as bar:
        creep_table.build(out, elements, processes=processes, progress=bar)
    deliver({"files": [str(out)]}, show=lambda console: None, as_json=as_json)
    typer.echo(f"wrote {out}", err=True)


@app.command()
@reported
def effective(
    out: Annotated[Path, typer.Option(help="CSV file")],
    forces: Annotated[Path, typer.Option(help="table of creep forces, from `contact table build`")] = table.FILE,
    as_json: opt.Json = False,
) -> None:
    """Fit the effective creepages of `fastrip_mapped` to the table of creep forces. It takes two minutes and needs scipy.

    Example:  contact table effective --out effective_creepage.csv, to replace contact/data/effective_creepage.csv
    """
    with progress_bar() as bar:
        effective_creepage.build(out, forces, progress=bar)
    deliver({"files": [str(out)]}, show=lambda console: None, as_json=as_json)
    typer.echo(f"wrote {out}", err=True)
