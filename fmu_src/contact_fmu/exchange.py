"""Replace files in a finished FMU, without a compiler: ``python -m contact_fmu.exchange profiles|surfaces|track FMU …``."""

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
from . import profiles, surfaces, track
from .options import RailName, WheelName
from .tables.wheel_rail_surfaces import RAIL, WHEEL

Given = Annotated[Path, typer.Argument(help="Finished FMU.", show_default=False)]
app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False)


@app.command("profiles")
@reported
def exchange_profiles(
    fmu: Given, *, wheel: WheelName = None, rail: RailName = None, reading: arguments.Reading
) -> None:
    """Replace the profiles in a finished WheelRailPair FMU."""
    profiles.exchange(fmu, _require_any(reading.chosen(wheel, rail)))


@app.command("surfaces")
@reported
def exchange_surfaces(
    fmu: Given,
    *,
    wheel: WheelName = None,
    rail: RailName = None,
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
        new[WHEEL] = surfaces.pack(surface.with_deviations(*deviations))
    elif deviations:
        raise ContactError("--flat and --polygon need --wheel")
    if rail:
        own = RailSurface.read(rail) if of_rail else given["rail"]
        placed = SurfacePair(profile.s1002(), own, gauge=gauge, rail_origin=change.origin)
        new[RAIL] = surfaces.pack(placed.rail, placed.rail_origin)
    surfaces.exchange(fmu, _require_any(new))


@app.command("track")
@reported
def exchange_track(
    fmu: Given, file: Annotated[Path, typer.Argument(help="TOML file of a scenario with the table [track]")]
) -> None:
    """Replace the track in a finished FMU of a vehicle."""
    given = scenario.read(file)
    given.require_profiles(file.name, "the FMUs of a vehicle take")
    track.exchange(fmu, given)


def _require_any(new: dict[Any, Any]) -> dict[Any, Any]:
    """Return what is new. Raise a ContactError if there is nothing."""
    if not new:
        raise ContactError("nothing to do: give --wheel, --rail or both")
    return new


if __name__ == "__main__":
    app()
