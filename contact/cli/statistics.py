"""The command `statistics`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact.cli import options as opt
from contact.cli.output import prepare, reported
from contact.cli.progress import progress_bar
from contact.cli.tables import STUDY, show_study
from contact.study.pairs import RESOLUTION
from contact.study.statistics import ELEMENTS
from contact.study.statistics import statistics as compute

Methods = Annotated[
    list[str] | None,
    opt.in_method("--tangential", help="tangential method; may be repeated. Default: all with a fast kernel"),
]
Cases = Annotated[int | None, typer.Option(min=1, help="a sample of the 3220 cases", show_default="all")]
Elements = Annotated[int, typer.Option(help="rows and columns of the half space on the ellipse")]
Resolution = Annotated[int, typer.Option(help="strips, and elements per strip, of the methods")]
Stored = Annotated[
    Path | None, typer.Option(help="keep the half space's forces in this file, and continue from there next time")
]
Processes = Annotated[int | None, typer.Option(min=1, help="processes for the half space", show_default="all cores")]


@reported
def statistics(
    tangential: Methods = None,
    cases: Cases = None,
    elements: Elements = ELEMENTS,
    resolution: Resolution = RESOLUTION,
    stored: Stored = None,
    processes: Processes = None,
    as_json: opt.Json = False,
    out: opt.Pages = None,
) -> None:
    """Compute errors of the tangential methods over 3220 cases on ellipses (Vollebregt, Iwnicki, Xie, Shackleton 2012).

    All cases take minutes. Examples:  contact statistics --cases 200   ·   contact statistics --stored ref.csv --out page.html
    """
    prepare(out, STUDY)
    with progress_bar() as bar:
        found = compute(
            tangential,
            cases=cases,
            elements=elements,
            n_strips=resolution,
            n_elements=resolution,
            stored=stored,
            processes=processes,
            progress=bar,
        )
    show_study(found, as_json=as_json, out=out)
