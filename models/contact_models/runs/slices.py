"""Rails and wheels that are given by slices, as a scenario declares them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from contact.errors import ContactError, require_number
from contact.geometry.surfaces import RailSurface, WheelSurface
from ..vehicle.declared import SIDES
from ..vehicle.sections import RailSection

Surface = TypeVar("Surface", RailSurface, WheelSurface)


def require_side(side: str | None) -> None:
    """Check that a side is "right", "left" or None."""
    if side is not None and side not in SIDES:
        raise ContactError(f"side = {side!r} is none of {', '.join(map(repr, SIDES))}")


@dataclass(frozen=True, kw_only=True)
class SliceFile:
    """A file of slices of CONTACT, or a folder with a file for each slice.

    Parameters
    ----------
    file : path relative to the scenario's file
    positions : of the slices of a folder, in metres or radians
    unit : "mm" or "m", of the file
    mirror_y, mirror_z : whether these coordinates have the opposite sign in the files
    """

    file: str
    positions: tuple[float, ...] | None = None
    unit: str = "mm"
    mirror_y: bool = False
    mirror_z: bool = False

    def __post_init__(self) -> None:
        if self.unit not in ("mm", "m"):
            raise ContactError(f"unit = {self.unit!r} is neither 'mm' nor 'm'")

    def read(self, folder: Path, reader: Callable[..., Surface], positions: str) -> Surface:
        """Return the surface of the file in a folder; `positions` is the name of the positions for the reader."""
        given: dict[str, Any] = {} if self.positions is None else {positions: self.positions}
        return reader(folder / self.file, unit=self.unit, mirror_y=self.mirror_y, mirror_z=self.mirror_z, **given)


@dataclass(frozen=True, kw_only=True)
class RailSlices(SliceFile):
    """A part of one rail or of both that is given by slices, such as a crossing, a switch or a joint.

    Parameters
    ----------
    at : place on the track at which the position of the slices is 0 [m]
    side : "right" or "left"; default: both rails
    origin : place (y, z) of the origin of the slices in track coordinates of the right side [m]. Default: slices in the
        coordinates of the rail's profile
    """

    at: float
    side: str | None = None
    origin: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        require_side(self.side)
        require_number("at", self.at)
        if self.origin is not None and len(self.origin) != 2:
            raise ContactError(f"origin = {self.origin!r} has {len(self.origin)} numbers; y and z are needed")


@dataclass(frozen=True, kw_only=True)
class WheelSlices(SliceFile):
    """A measured wheel, or both of an axle: radius minus nominal radius over angle and y.

    Parameters
    ----------
    axle : name of the wheelset
    side : "right" or "left"; default: both wheels
    """

    axle: str
    side: str | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        require_side(self.side)

    def load(self, folder: Path) -> WheelSurface:
        """Return the wheel."""
        return self.read(folder, WheelSurface.read, "theta")


@dataclass(frozen=True, kw_only=True)
class Rails:
    """Parts of the rails that change along the track. Damage is not counted on them.

    Parameters
    ----------
    slices : parts, a table each; they must not overlap
    """

    slices: tuple[RailSlices, ...] = ()

    def load(self, folder: Path, where: str) -> tuple[RailSection, ...]:
        """Return the sections of both rails. `where` is the place of the table in messages.

        Raises
        ------
        ContactError
            If a file is wrong.
        """
        found = []
        for k, each in enumerate(self.slices):
            name = f"{where}.slices[{k}]"
            try:
                surface = each.read(folder, RailSurface.read, "s")
            except (ContactError, OSError) as error:
                raise ContactError(f"{name}: {error}") from None
            origin = None if each.origin is None else (each.origin[0], each.origin[1])
            found += [
                RailSection(surface=surface, side=side, at=each.at, origin=origin, name=name)
                for side in SIDES
                if each.side in (None, side)
            ]
        return tuple(found)
