"""The command `compare`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from contact.cli import cases
from contact.cli import options as opt
from contact.cli.output import reported, require_endings
from contact.cli.progress import progress_bar
from contact.cli.tables import show_study
from contact.study import SELECTION
from contact.study import compare as compare_methods
from contact.study.compare import REFERENCE_ELEMENTS
from contact.study.pairs import RESOLUTION

COMPARED = "Comparison"
File = Annotated[
    Path | None,
    typer.Argument(help="cases in .toml, .json or .csv, with the names of the options", show_default=False),
]
Methods = Annotated[
    list[str] | None,
    typer.Option(
        "--method",
        help="normal+tangential, like analyn+fastrip; may be repeated. Default: " + ", ".join(map(str, SELECTION)),
        rich_help_panel=COMPARED,
    ),
]
All = Annotated[bool, typer.Option("--all", help="every normal with every tangential method", rich_help_panel=COMPARED)]
Without = Annotated[
    bool, typer.Option("--no-reference", help="without the half space and the errors", rich_help_panel=COMPARED)
]
Resolution = Annotated[
    int,
    typer.Option(help="strips, and elements per strip, of the methods", rich_help_panel=COMPARED, show_default=True),
]
Elements = Annotated[
    int, typer.Option(help="rows and columns of the half space over the overlap", rich_help_panel=COMPARED)
]


@reported
def compare(
    context: typer.Context,
    file: File = None,
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    side: opt.Sides = opt.Side.right,
    y: opt.Y = 0.0,
    roll: opt.Roll = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    penetration: opt.Penetration = None,
    friction: opt.Friction = 0.3,
    creepage: opt.Creep = None,
    curvatures: opt.Curvatures = None,
    methods: Methods = None,
    every: All = False,
    without: Without = False,
    resolution: Resolution = RESOLUTION,
    reference_elements: Elements = REFERENCE_ELEMENTS,
    as_json: opt.Json = False,
    out: opt.Files = None,
) -> None:
    """Solve the same contact with several methods and compare forces, patches, times and errors against the half space.

    Examples:  contact compare --y 3e-3 --yaw 2e-3 --out page.html   ·   contact compare cases.toml --all --out table.csv
    """
    require_endings(out or [])
    opt.require_use(context)
    given: dict[str, Any] = {
        "wheel": wheel, "rail": rail, "inclination": inclination, "unit": unit, "drawn_side": drawn_side,
        "smoothing": smoothing, "radius": radius, "side": side.value, "y": y, "roll": roll, "yaw": yaw, "speed": speed,
        "load": load, "penetration": penetration, "friction": friction, "creepage": creepage, "curvatures": curvatures,
    }  # fmt: skip
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
