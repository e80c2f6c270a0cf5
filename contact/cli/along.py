"""The command `along`: a wheel over a crossing, or over its flats and polygons."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich import box
from rich.console import Console
from rich.table import Table

import contact
from contact.cli import options as opt
from contact.cli.output import drawing, reported, write_csv, write_picture
from contact.cli.problem import STANDARD_LOAD
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import Deviation, Flat, Polygon, RailSurface, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pose, Velocity
from contact.passage import Passage, passage
from contact.surface_pair import WheelRailSurfaces

_WAY = "Way"
_HEADINGS = ("at\nmm", "z\nmm", "patch", "x\nmm", "y\nmm", "N\nkN", "Fx\nkN", "Fy\nkN", "p max\nMPa", "fit\nerror")
Begin = Annotated[float, typer.Option("--from", help="first station of the axle in m", rich_help_panel=_WAY)]
End = Annotated[float, typer.Option("--to", help="last station in m", rich_help_panel=_WAY)]
Count = Annotated[int, typer.Option("--points", help="number of stations", min=1, rich_help_panel=_WAY)]
Turned = Annotated[
    float, typer.Option("--angle", help="angle of the wheel at the first station in degrees", rich_help_panel=_WAY)
]
Origin = Annotated[
    tuple[float, float] | None,
    typer.Option(
        help="place y z of the origin of a rail of slices in m, right side of the track",
        metavar="Y Z",
        rich_help_panel=opt.PROFILES,
    ),
]
FlatLength = Annotated[
    float | None, typer.Option("--flat", help="length of a haversine flat in m", rich_help_panel=opt.PROFILES)
]
FlatDepth = Annotated[
    float | None, typer.Option(help="its depth in m; default length²/(16 radius)", rich_help_panel=opt.PROFILES)
]
PolygonOf = Annotated[
    tuple[int, float] | None,
    typer.Option(
        "--polygon",
        help="out-of-roundness: order, amplitude in m",
        metavar="ORDER AMPLITUDE",
        rich_help_panel=opt.PROFILES,
    ),
]
Vertical = Annotated[
    float | None,
    typer.Option(help="instead of a load: vertical force with friction in N", rich_help_panel=opt.LOADING),
]


@reported
def along(
    *,
    wheel: opt.WheelName = "s1002",
    rail: opt.RailName = "60e1",
    origin: Origin = None,
    flat: FlatLength = None,
    flat_depth: FlatDepth = None,
    polygon: PolygonOf = None,
    inclination: opt.Inclination = None,
    unit: opt.Unit = None,
    drawn_side: opt.Drawn = None,
    smoothing: opt.Smoothing = None,
    radius: opt.Radius = 0.46,
    begin: Begin = 0.0,
    end: End = 0.2,
    points: Count = 21,
    angle: Turned = 0.0,
    y: opt.Y = 0.0,
    yaw: opt.Yaw = 0.0,
    speed: opt.Speed = 20.0,
    load: opt.Load = None,
    vertical: Vertical = None,
    friction: opt.Friction = 0.3,
    normal: Annotated[str, typer.Option(help="normal method", rich_help_panel=opt.METHOD)] = "halfspace",
    tangential: Annotated[
        str | None, typer.Option(help="tangential method; default that of --normal", rich_help_panel=opt.METHOD)
    ] = None,
    as_json: opt.Json = False,
    table: opt.Csv = None,
    plot: opt.Plot = None,
) -> None:
    """Roll a right wheel along a rail that changes along the way (.slcs), or with a flat, a polygon or slices (.slcw).

    Examples:  contact along --rail nose.slcs --origin 0.75 0 --from -0.05 --to 0.15 --normal strip_halfspace --plot nose.png

    contact along --flat 0.05 --from -0.05 --to 0.05
    """
    if plot is not None:
        drawing()
    if load is None and vertical is None:
        load = STANDARD_LOAD
    reading = opt.reading(inclination, unit, drawn_side, smoothing)
    deviations: list[Deviation] = []
    if flat is not None:
        deviations.append(Flat(flat, radius, flat_depth))
    elif flat_depth is not None:
        raise ContactError(f"flat_depth = {flat_depth:g} needs --flat")
    if polygon is not None:
        deviations.append(Polygon(*polygon))
    turning = _wheel(wheel, reading).with_deviations(*deviations)
    lying = RailSurface.read(rail) if Path(rail).suffix == ".slcs" else profile.load(rail, "rail", **reading)
    pair = SurfacePair(turning, lying, nominal_radius=radius, rail_origin=origin)
    solver = WheelRailSurfaces(pair, normal=normal, tangential=tangential)
    found = passage(
        solver,
        np.linspace(begin, end, points),
        Pose(y=y, yaw=yaw),
        Velocity(speed),
        rotation=np.radians(angle),
        load=load if vertical is None else None,
        vertical=vertical,
        friction=friction,
    )
    if as_json:
        columns = {name: values.tolist() for name, values in found.columns().items()}
        typer.echo(json.dumps({"version": contact.__version__, **columns, "patches_of": found.rows()}, indent=2))
    else:
        _show(found, Console())
    if table is not None:
        write_csv(found.rows(), table)
    if plot is not None:
        write_picture(drawing().passage(found, f"{wheel} on {rail}"), plot)


def _wheel(name: str, reading: dict[str, Any]) -> WheelSurface:
    """Return a wheel from a file of slices, or of revolution."""
    if Path(name).suffix == ".slcw":
        return WheelSurface.read(name)
    return WheelSurface.constant(profile.load(name, "wheel", **reading))


def _show(found: Passage, console: Console) -> None:
    table = Table(header_style="bold", box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0))
    for heading in _HEADINGS:
        table.add_column(heading, justify="right", no_wrap=True)
    for row in found.rows():
        table.add_row(
            f"{1e3 * row['station']:.1f}",
            f"{1e3 * row['wheel_z']:.4f}",
            str(row["patch"] + 1),
            *(f"{1e3 * row[name]:.2f}" for name in ("x", "y")),
            *(f"{1e-3 * row[name]:.2f}" for name in ("N", "Fx", "Fy")),
            f"{1e-6 * row['max_pressure']:.0f}",
            f"{row['fit_error']:.3f}",
        )
    console.print(table)
