"""The command `along`: a wheel over a crossing, or over its flats and polygons."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.output import drawing, reported, require_trusted
from contact.cli.problem import carried
from contact.cli.tables import show_table
from contact.geometry.surfaces import Deviation, RailSurface, SurfacePair, WheelSurface
from contact.geometry.surfaces.deviation import out_of_round
from contact.inputs.options import STATION
from contact.pair import PairRun, solver_for
from contact.pair.motion import MOST_ROWS

on_way = partial(typer.Option, rich_help_panel="Way")
_HEADINGS = (
    *(("at", "mm"), ("z", "mm"), ("patch", ""), ("x", "mm"), ("y", "mm")),
    *(("N", "kN"), ("Fx", "kN"), ("Fy", "kN"), ("p max", "MPa"), ("gap error", "")),
)
Begin = Annotated[float, on_way("--from", help="first station of the axle in m")]
End = Annotated[float, on_way("--to", help="last station in m")]
Count = Annotated[int, on_way("--points", help="number of stations", min=1, max=MOST_ROWS)]
Turned = Annotated[
    float | None,
    on_way(
        "--angle",
        help="angle of the wheel at the first station in rad; default: 0 at station 0, where a flat lies",
        show_default=False,
    ),
]
Rolling = Annotated[str | None, opt.in_method("--tangential", help="tangential method; default that of --normal")]
Origin = Annotated[
    tuple[float, float] | None,
    opt.in_profiles(help="place y z of the origin of a rail of slices in m, right side of the track", metavar="Y Z"),
]
FlatLength = Annotated[float | None, opt.in_profiles("--flat", help="length of a haversine flat in m")]
FlatDepth = Annotated[float | None, opt.in_profiles(help="its depth in m; default length²/(16 radius)")]
PolygonOf = Annotated[
    tuple[int, float] | None,
    opt.in_profiles("--polygon", help="out-of-roundness: order, amplitude in m", metavar="ORDER AMPLITUDE"),
]


@dataclass
class OutOfRound:
    """Deviations along the way: flat, polygon, origin of a rail of slices."""

    origin: Origin = None
    flat: FlatLength = None
    flat_depth: FlatDepth = None
    polygon: PolygonOf = None

    def deviations(self, radius: float) -> list[Deviation]:
        """Return flat and polygon of the wheel."""
        return out_of_round(radius, self.flat, self.flat_depth, self.polygon)


@dataclass
class Stations:
    """The way of the axle."""

    begin: Begin = 0.0
    end: End = 0.2
    points: Count = 21
    turned: Turned = None


@reported
def along(
    *,
    place: arguments.PlaceOptions,
    change: OutOfRound,
    way: Stations,
    load: opt.Load = None,
    vertical: opt.Vertical = None,
    surface: arguments.SlidingFriction,
    normal: opt.Normal = "halfspace",
    tangential: Rolling = None,
    output: arguments.Output,
) -> None:
    """Roll a right wheel along a rail that changes along the way (.slcs), or with a flat, a polygon or slices (.slcw).

    Examples:  contact along --rail nose.slcs --origin 0.75 0 --from -0.05 --to 0.15 --normal strip_halfspace --out nose.png

    contact along --flat 0.05 --from -0.05 --to 0.05
    """
    first, last = (STATION.require(name, at) for name, at in (("from", way.begin), ("to", way.end)))
    wheel = _wheel(place).with_deviations(*change.deviations(place.radius))
    slices = Path(place.rail).suffix == ".slcs"
    rail = RailSurface.read(place.rail) if slices else place.load(place.rail, "rail")
    pair = SurfacePair(wheel, rail, **place.lengths, rail_origin=change.origin)
    motion: dict[str, Any] = {"station": np.linspace(first, last, way.points), "velocity.x": place.speed}
    motion |= {"pose.y": place.y, "pose.roll": place.roll, "pose.yaw": place.yaw}
    motion |= carried(load, vertical)
    turned = -first / place.radius if way.turned is None else way.turned  # it falls when rolling forward
    found = solver_for(pair, normal, tangential).run(motion, rotation=turned, friction=surface.law())
    output.deliver(
        {**found, "patches_of": found.patches()},
        show=lambda console: _show(found, console),
        rows=found.patches,
        figure=lambda: drawing().passage(found, f"{place.wheel} on {place.rail}"),
    )
    require_trusted(found["status"].tolist(), "stations")


def _wheel(place: arguments.PlaceOptions) -> WheelSurface:
    """Return a wheel from a file of slices, or of revolution."""
    if Path(place.wheel).suffix == ".slcw":
        return WheelSurface.read(place.wheel)
    return WheelSurface.constant(place.load(place.wheel, "wheel"))


def _show(found: PairRun, console: Console) -> None:
    rows = [
        [
            f"{1e3 * row['station']:.1f}",
            f"{1e3 * row['wheel_z']:.4f}",
            str(row["patch"] + 1),
            *(f"{1e3 * row[name]:.2f}" for name in ("x", "y")),
            *(f"{1e-3 * row[name]:.2f}" for name in ("N", "Fx", "Fy")),
            f"{1e-6 * row['max_pressure']:.0f}",
            f"{row['gap_error']:.3f}",
        ]
        for row in found.patches()
    ]
    show_table("", _HEADINGS, rows, console)
