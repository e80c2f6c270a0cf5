"""The command `compare`."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from contact.cli import arguments, cases
from contact.cli import options as opt
from contact.cli.output import prepare, reported
from contact.cli.progress import progress_bar
from contact.cli.tables import STUDY, show_study
from contact.study import SELECTION
from contact.study import compare as compare_methods
from contact.study.compare import REFERENCE_ELEMENTS
from contact.study.pairs import RESOLUTION

compared = partial(typer.Option, rich_help_panel="Comparison")
File = Annotated[
    Path | None, typer.Argument(help="cases in .toml, .json or .csv, with the names of the options", show_default=False)
]
Methods = Annotated[
    list[str] | None,
    compared(
        "--method",
        help="normal+tangential, like analyn+fastrip; may be repeated. Default: " + ", ".join(map(str, SELECTION)),
    ),
]
All = Annotated[bool, compared("--all", help="every normal with every tangential method")]
Without = Annotated[bool, compared("--no-reference", help="without the half space and the errors")]
Resolution = Annotated[int, compared(help="strips, and elements per strip, of the methods", show_default=True)]
Elements = Annotated[int, compared(help="rows and columns of the half space over the overlap")]


@reported
def compare(
    context: typer.Context,
    file: File = None,
    *,
    place: arguments.PlaceOptions,
    side: opt.Sides = opt.SideOption.right,
    amount: arguments.Amount,
    friction: opt.Friction = 0.3,
    curvatures: opt.Curvatures = None,
    methods: Methods = None,
    every: All = False,
    without: Without = False,
    resolution: Resolution = RESOLUTION,
    reference_elements: Elements = REFERENCE_ELEMENTS,
    as_json: opt.Json = False,
    out: opt.Pages = None,
) -> None:
    """Solve the same contact with several methods and compare forces, patches, times and errors against the half space.

    Examples:  contact compare --y 3e-3 --yaw 2e-3 --out page.html   ·   contact compare cases.toml --all --out table.csv
    """
    prepare(out, STUDY)
    arguments.require_use(context)
    given = vars(place) | vars(amount)
    given |= {"side": side.value, "friction": friction, "curvatures": curvatures}
    problems = cases.cases_of(given) if file is None else cases.read(file, given)
    if not problems:
        Console().print("no contact: there is nothing to compare")
        return
    with progress_bar() as bar:
        found = compare_methods(
            problems,
            [*(methods or []), "all"] if every else (methods or SELECTION),
            reference=not without,
            n_strips=resolution,
            n_elements=resolution,
            reference_elements=reference_elements,
            progress=bar,
        )
    show_study(found, as_json=as_json, out=out)
