"""Surfaces as resources of the FMU `WheelRailSurfaces`, which reads them when an instance is made.

`python -m contact_fmu.surfaces FMU [--wheel NAME|FILE] [--flat LENGTH] [--rail NAME|FILE] [--origin Y Z] …` replaces them in a
finished FMU. This needs no compiler.

A resource (`contact_fmu.resources`) has one row: the numbers of `contact.geometry.surfaces.compiled.numbers`.
"""

from __future__ import annotations

from pathlib import Path

import typer

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.along import OutOfRound
from contact.cli.output import reported
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.profile import Kind
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface, compiled
from contact.inputs.options import GAUGE, RADIUS
from . import archive, resources
from .profiles import Given, RailName, WheelName, require_any
from .tables.wheel_rail_surfaces import MOST_NUMBERS, RAIL, WHEEL

MAGIC: dict[Kind, bytes] = {"wheel": b"wr-wsurf", "rail": b"wr-rsurf"}


def pack(surface: WheelSurface | RailSurface, origin: tuple[float, float] = (0.0, 0.0)) -> bytes:
    """Return the resource of a surface. `origin` is the place (y, z) [m] of the origin of a rail's points.

    Raises
    ------
    ContactError
        If the surface is larger than an FMU reads, or a rail with deviations, which have no end.
    """
    kind: Kind = "wheel" if isinstance(surface, WheelSurface) else "rail"
    numbers = compiled.numbers(surface, origin)
    if numbers.size > MOST_NUMBERS:
        raise ContactError(
            f"{kind} = {surface!r} takes {numbers.size} numbers: an FMU reads at most {MOST_NUMBERS}; "
            "take fewer slices, or a larger spacing"
        )
    return resources.pack(MAGIC[kind], numbers[None], MOST_NUMBERS)


def of_pair(pair: SurfacePair) -> dict[str, bytes]:
    """Return name → content of the resources of a pair."""
    return {WHEEL: pack(pair.wheel), RAIL: pack(pair.rail, pair.rail_origin)}


def exchange(fmu: Path, new: dict[str, bytes]) -> None:
    """Replace surfaces in an FMU file. `new` is name → content, as of `of_pair`. If this fails, the file is unchanged.

    Raises
    ------
    ContactError
        If the file is not a WheelRailSurfaces FMU.
    """
    archive.exchange(fmu, {f"resources/{name}": content for name, content in new.items()}, "a WheelRailSurfaces FMU")


@reported
def replace(
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
        new[WHEEL] = pack(surface.with_deviations(*deviations))
    elif deviations:
        raise ContactError("--flat and --polygon need --wheel")
    if rail:
        own = RailSurface.read(rail) if of_rail else given["rail"]
        placed = SurfacePair(profile.s1002(), own, gauge=gauge, rail_origin=change.origin)
        new[RAIL] = pack(placed.rail, placed.rail_origin)
    exchange(fmu, require_any(new))


if __name__ == "__main__":
    typer.run(replace)
