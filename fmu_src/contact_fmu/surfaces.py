"""Surfaces as resources of the FMU `WheelRailSurfaces`, which reads them when an instance is made.

A resource (`contact_fmu.resources`) has one row: the numbers of `contact.geometry.surfaces.compiled.numbers`.
"""

from __future__ import annotations

from pathlib import Path

from contact.errors import ContactError
from contact.geometry.profile import Kind
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface, compiled
from . import archive, resources
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
