"""Surfaces as resources of the FMU `WheelRailSurfaces`, which reads them when an instance is made.

`python -m contact_fmu.surfaces FMU [--wheel NAME|FILE] [--flat LENGTH] [--rail NAME|FILE] [--origin Y Z] …` replaces them in a
finished FMU. This needs no compiler.

A resource (`contact_fmu.resources`) has one row: the numbers of `contact.geometry.surfaces.compiled.numbers`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.profile import Kind, Profile
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface, compiled
from contact.geometry.surfaces.deviation import out_of_round
from contact.inputs.options import GAUGE, RADIUS
from . import archive, profiles, resources
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


def chosen(arguments: argparse.Namespace) -> dict[str, bytes]:
    """Return the resources that the command line names."""
    wheel, rail = arguments.wheel, arguments.rail
    of_wheel, of_rail = _has_slices(wheel, ".slcw"), _has_slices(rail, ".slcs")
    arguments.wheel, arguments.rail = None if of_wheel else wheel, None if of_rail else rail
    given: dict[Kind, Profile] = profiles.chosen(arguments)
    deviations = out_of_round(arguments.radius, arguments.flat, arguments.flat_depth, arguments.polygon)
    new = {}
    if wheel:
        read = WheelSurface.read(wheel) if of_wheel else WheelSurface.constant(given["wheel"])
        new[WHEEL] = pack(read.with_deviations(*deviations))
    elif deviations:
        raise ContactError("--flat and --polygon need --wheel")
    if rail:
        own = RailSurface.read(rail) if of_rail else given["rail"]
        placed = SurfacePair(profile.s1002(), own, gauge=arguments.gauge, rail_origin=arguments.origin)
        new[RAIL] = pack(placed.rail, placed.rail_origin)
    return new


def _has_slices(name: str | None, suffix: str) -> bool:
    return name is not None and Path(name).suffix == suffix


def _number(text: str) -> float:
    return int(text) if text.isdecimal() else float(text)


def main() -> None:
    """Replace the surfaces that the command line names."""
    parser = argparse.ArgumentParser(description="Replace the surfaces in a finished WheelRailSurfaces FMU.")
    parser.add_argument("fmu", type=Path)
    profiles.add_options(parser)
    parser.add_argument("--flat", type=float, metavar="M", help="length of a haversine flat of the wheel in m")
    parser.add_argument("--flat-depth", type=float, metavar="M", help="its depth in m; default length²/(16 radius)")
    parser.add_argument(
        "--polygon", type=_number, nargs=2, metavar=("ORDER", "M"), help="out-of-roundness: order, amplitude in m"
    )
    parser.add_argument(
        "--radius", type=float, default=RADIUS.usual, metavar="M", help="nominal radius, for a flat (default: 0.46)"
    )
    parser.add_argument(
        "--gauge", type=float, default=GAUGE.usual, metavar="M", help="gauge, for a rail with one profile"
    )
    parser.add_argument(
        "--origin", type=float, nargs=2, metavar=("Y", "Z"), help="place of the origin of a rail of slices in m"
    )
    profiles.replace(parser, chosen, exchange)


if __name__ == "__main__":
    main()
