"""Wheels with flats and polygons, and measured ones, as a scenario declares them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from contact.errors import ContactError
from contact.geometry.profile import Profile
from contact.geometry.surfaces import Flat, Polygon, WheelSurface
from contact.geometry.surfaces.deviation import Deviation
from contact.inputs.options import RADIUS
from .slices import WheelSlices, require_side


@dataclass(frozen=True, kw_only=True)
class FlatWheel:
    """A flat of one wheel, or of both of an axle (`contact.geometry.surfaces.Flat`).

    Parameters
    ----------
    axle : name of the wheelset
    side : "right" or "left"; default: both wheels
    length : along the circumference [m], 1e-3 to 0.3
    depth : largest depth [m] of a haversine, 0 to 0.02; default length²/(16 radius)
    shape : "haversine", a worn flat with rounded ends, or "chord", a fresh flat with sharp ends
    angle : of its middle around the wheel [rad]; 0 is at the bottom at the start
    """

    axle: str
    length: float
    side: str | None = None
    depth: float | None = None
    shape: str = "haversine"
    angle: float = 0.0

    def __post_init__(self) -> None:
        require_side(self.side)
        self.deviation(RADIUS.usual)  # checks the numbers

    def deviation(self, radius: float) -> Deviation:
        """Return the flat on a wheel with a nominal radius [m]."""
        return Flat(self.length, radius, self.depth, self.shape, self.angle)


@dataclass(frozen=True, kw_only=True)
class PolygonWheel:
    """Periodic out-of-roundness of one wheel, or of both of an axle (`contact.geometry.surfaces.Polygon`).

    Parameters
    ----------
    axle : name of the wheelset
    side : "right" or "left"; default: both wheels
    order : number of periods around the wheel, 1 to 500
    amplitude : half of the difference between the largest and the smallest radius [m], 0 to 0.01
    phase : [rad]
    """

    axle: str
    order: int
    amplitude: float
    side: str | None = None
    phase: float = 0.0

    def __post_init__(self) -> None:
        require_side(self.side)
        self.deviation(RADIUS.usual)

    def deviation(self, radius: float) -> Deviation:
        """Return the polygon; it is the same for every radius."""
        return Polygon(self.order, self.amplitude, self.phase)


@dataclass(frozen=True, kw_only=True)
class Wheels:
    """Wheels that are not round. They have no damage: it is counted over profiles, which these wheels do not have.

    Parameters
    ----------
    flat : flats, a table each; a wheel may have several
    polygon : polygons, a table each; they add to flats of the same wheel
    slices : measured wheels, a table each; flats and polygons of the same wheel add to them
    """

    flat: tuple[FlatWheel, ...] = ()
    polygon: tuple[PolygonWheel, ...] = ()
    slices: tuple[WheelSlices, ...] = ()

    def require_axles(self, axles: Sequence[str], where: str) -> None:
        """Check that all wheelsets are those of the vehicle.

        Raises
        ------
        ContactError
            If one is not. The message has the place in the file, which begins with `where`, and the names of the vehicle.
        """
        kinds: dict[str, tuple[FlatWheel | PolygonWheel | WheelSlices, ...]] = {
            "flat": self.flat,
            "polygon": self.polygon,
            "slices": self.slices,
        }
        for kind, entries in kinds.items():
            for k, entry in enumerate(entries):
                if entry.axle not in axles:
                    names = ", ".join(map(repr, axles))
                    raise ContactError(
                        f"{where}.{kind}[{k}].axle = {entry.axle!r} is no wheelset; the vehicle has {names}"
                    )

    def load(self, folder: Path, where: str) -> tuple[WheelSurface, ...]:
        """Return the wheels of `slices`. `where` is the place of the table in messages.

        Raises
        ------
        ContactError
            If a file is wrong, or if a wheel is given twice.
        """
        found = []
        for k, each in enumerate(self.slices):
            for other in self.slices[:k]:
                if each.axle == other.axle and (each.side == other.side or None in (each.side, other.side)):
                    raise ContactError(f"{where}.slices[{k}]: a wheel of {each.axle!r} is given twice")
            try:
                found.append(each.load(folder))
            except (ContactError, OSError) as error:
                raise ContactError(f"{where}.slices[{k}]: {error}") from None
        return tuple(found)

    def surfaces(
        self,
        names: Sequence[tuple[str, str]],
        profiles: Sequence[Profile],
        radius: float,
        measured: Sequence[WheelSurface],
    ) -> dict[int, WheelSurface]:
        """Return number of a wheel → its surface, for those that are not round.

        Parameters
        ----------
        names : sequence of (str, str)
            Wheelset and side of every wheel.
        profiles : sequence of Profile
            Profile of every wheel.
        radius : float
            Nominal radius [m].
        measured : sequence of WheelSurface
            Those of `load`.
        """
        entries: tuple[FlatWheel | PolygonWheel, ...] = (*self.flat, *self.polygon)
        found: dict[int, WheelSurface] = {}
        for number, ((axle, side), shape) in enumerate(zip(names, profiles, strict=True)):
            for entry, surface in zip(self.slices, measured, strict=True):
                if entry.axle == axle and entry.side in (None, side):
                    found[number] = surface
            own = [entry.deviation(radius) for entry in entries if entry.axle == axle and entry.side in (None, side)]
            if own:
                found[number] = (found.get(number) or WheelSurface.constant(shape)).with_deviations(*own)
        return found
