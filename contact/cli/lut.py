"""The command `lut`: look-up tables of a wheel on a rail."""

from __future__ import annotations

import warnings
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import deliver, reported
from contact.cli.problem import load_or_standard
from contact.cli.progress import progress_bar
from contact.cli.tables import show_table
from contact.errors import ContactError, PlausibilityWarning
from contact.inputs.plausibility import doubt_values
from contact.pair import WheelRailPair
from contact.study import lookup

in_axes = partial(typer.Option, rich_help_panel="Axes of the tables")
#: Axis → its name among the usual values.
_USUAL = {
    **{"y": "pose.y", "roll": "pose.roll", "yaw": "pose.yaw", "load": "wheel load", "speed": "speed"},
    **{name: f"creepage.{name}" for name in ("longitudinal", "lateral", "spin")},
}
Axis = Annotated[
    list[str] | None,
    in_axes(
        "--axis",
        help=f"axis and its breakpoints, NAME=FROM:TO:NUMBER or NAME=A,B,C; may be repeated. Names: {', '.join(lookup.AXES)}",
    ),
]
Chosen = Annotated[
    list[str] | None,
    in_axes("--table", help=f"table to make; may be repeated: {', '.join(lookup.TABLES)}", show_default=False),
]
_MOST = 1_000_000  # breakpoints of an axis, and random points
Checked = Annotated[int, typer.Option("--check", min=1, max=_MOST, help="random points on which the error is measured")]
Threads = Annotated[int | None, typer.Option(min=1, help="threads", show_default="all cores")]
Tables = Annotated[Path, opt.in_output("--out", help="write .mat, .npz or .csv")]


@reported
def lut(
    out: Tables,
    *,
    axis: Axis = None,
    table: Chosen = None,
    wheels: arguments.Wheels,
    side: opt.Sides = opt.SideOption.right,
    load: opt.Load = None,
    speed: opt.Speed = 20.0,
    surface: arguments.SlidingFriction,
    methods: arguments.Methods,
    check: Checked = 500,
    threads: Threads = None,
    as_json: opt.Json = False,
) -> None:
    """Make look-up tables of a wheel on its rail over pose, load and creepages, for Simulink's n-D Lookup Table.

    Example:  contact lut --axis y=-6e-3:6e-3:49 --axis yaw=-4e-3:4e-3:9 --axis load=40e3:120e3:5 --out tables.mat
    """
    lookup.require_writable(out)
    if side is opt.SideOption.both:
        raise ContactError("--side both: a table is that of one wheel; allowed: left, right")
    given = list(map(_breakpoints, axis or ["y=-6e-3:6e-3:49", "yaw=-4e-3:4e-3:9"]))
    if len(axes := dict(given)) < len(given):
        raise ContactError(f"--axis {', --axis '.join(name for name, _ in given)}: a name stands twice")
    pair = WheelRailPair(wheels.pairs(side.value)[0], **vars(methods))
    options: dict[str, Any] = {"friction": surface.law(), "threads": threads}
    options |= {} if "load" in axes else {"load": load_or_standard(load)}
    options |= {} if "speed" in axes else {"speed": speed}
    names = tuple(table or lookup.DEFAULT_TABLES)
    others = {name: np.asarray(options[name]) for name in ("load", "speed") if name in options}
    for name, points in (axes | others).items():
        if name in _USUAL:
            doubt_values(_USUAL[name], points, name if name in others else f"--axis {name}")
    with warnings.catch_warnings():  # they were looked at above, under the name that was typed
        warnings.simplefilter("ignore", PlausibilityWarning)
        plan = lookup.estimate(pair, axes, tables=len(names), **options)
        typer.echo(f"{plan.poses} poses, {1e-6 * plan.size:.2g} MB, about {plan.seconds:.2g} s", err=True)
        with progress_bar() as bar:
            found = lookup.lookup_table(pair, axes, tables=names, progress=bar, **options)
        try:
            errors = lookup.interpolation_error(pair, found, points=check, **options)
        except ContactError:
            none = f"none of {check} random poses between the breakpoints has a trustworthy solution"
            raise ContactError(f"{none}; look at the ranges of --axis") from None
        found.write(out)

    def show(console: Console) -> None:
        rows = [
            [name, f"{one.rms:.3g}", f"{one.largest:.3g}", f"{one.scale:.3g}", lookup.TABLES[name]]
            for name, one in errors.items()
        ]
        headings = [(name, "") for name in ("table", "rms error", "largest", "largest value", "unit")]
        show_table(f"Linear interpolation on {check} random points", headings, rows, console)
        if found.untrusted:
            console.print(f"{found.untrusted} of {plan.poses} points have no trustworthy solution", highlight=False)

    content = {
        "axes": found.axes,
        "errors": {name: asdict(one) for name, one in errors.items()},
        "untrusted": found.untrusted,
        "estimate": asdict(plan),
        "files": [str(out)],
    }
    deliver(content, show=show, as_json=as_json)
    typer.echo(f"wrote {out}", err=True)


def _breakpoints(text: str) -> tuple[str, np.ndarray]:
    """Return name and breakpoints of an option --axis."""
    name, equals, values = text.partition("=")
    try:
        if not equals:
            raise ValueError
        if ":" not in values:
            return name, np.array([float(value) for value in values.split(",")])
        low, high, number = values.split(":")
        if not 2 <= int(number) <= _MOST:
            raise ValueError
        return name, np.linspace(float(low), float(high), int(number))
    except ValueError:
        raise ContactError(
            f"--axis {text}: give NAME=FROM:TO:NUMBER, the number of breakpoints from 2 to {_MOST}, or NAME=A,B,C"
        ) from None
