"""Replace profiles, surfaces or the track in a finished FMU, without a compiler.

`python -m contact_fmu.profiles`, `contact_fmu.surfaces` and `contact_fmu.track` are these commands.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.along import OutOfRound
from contact.cli.output import reported
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface
from contact.inputs.options import GAUGE, RADIUS
from contact_models.runs import scenario
from . import profiles as own_profiles
from . import surfaces as own_surfaces
from . import track as own_track
from .command import PROFILE
from .tables.wheel_rail_surfaces import RAIL, WHEEL

Given = Annotated[Path, typer.Argument(help="finished FMU", show_default=False)]
Wheel = Annotated[str | None, typer.Option("--wheel", help=f"profile of the wheel: {PROFILE}")]
Rail = Annotated[str | None, typer.Option("--rail", help=f"profile of the rail: {PROFILE}")]


@reported
def profiles(fmu: Given, *, wheel: Wheel = None, rail: Rail = None, reading: arguments.Reading) -> None:
    """Replace the profiles in a finished WheelRailPair FMU."""
    own_profiles.exchange(fmu, _any(reading.chosen(wheel, rail)))


@reported
def surfaces(
    fmu: Given,
    *,
    wheel: Wheel = None,
    rail: Rail = None,
    reading: arguments.Reading,
    change: OutOfRound,
    radius: opt.Radius = RADIUS.usual,
    gauge: opt.Gauge = GAUGE.usual,
) -> None:
    """Replace the surfaces in a finished WheelRailSurfaces FMU: profiles, or slices of .slcw and .slcs."""
    of_wheel, of_rail = Path(wheel or "").suffix == ".slcw", Path(rail or "").suffix == ".slcs"
    given = reading.chosen(None if of_wheel else wheel, None if of_rail else rail)
    deviations = change.deviations(radius)
    new: dict[str, bytes] = {}
    if wheel:
        surface = WheelSurface.read(wheel) if of_wheel else WheelSurface.constant(given["wheel"])
        new[WHEEL] = own_surfaces.pack(surface.with_deviations(*deviations))
    elif deviations:
        raise ContactError("--flat and --polygon need --wheel")
    if rail:
        own = RailSurface.read(rail) if of_rail else given["rail"]
        placed = SurfacePair(profile.s1002(), own, gauge=gauge, rail_origin=change.origin)
        new[RAIL] = own_surfaces.pack(placed.rail, placed.rail_origin)
    own_surfaces.exchange(fmu, _any(new))


@reported
def track(
    fmu: Given, file: Annotated[Path, typer.Argument(help="TOML file of a scenario with the table [track]")]
) -> None:
    """Replace the track in a finished FMU of a vehicle."""
    given = scenario.read(file)
    given.require_profiles(file.name, "the FMUs of a vehicle take")
    own_track.exchange(fmu, given)


def _any(new: Any) -> Any:
    if not new:
        raise ContactError("nothing to do: give --wheel, --rail or both")
    return new
