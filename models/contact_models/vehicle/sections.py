"""Parts of the rails that are given by slices: crossings, switches, joints and dips on a track."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from contact.errors import ContactError
from contact.geometry.profile import Profile
from contact.geometry.records import Pose
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pair, place_of_rail

#: Distance before the first and after the last slice at which the rail's profile takes over [m]. A wheel may touch so far
#: ahead of its axle or behind it.
MARGIN = 0.1
#: Greatest step of the wheel's height where slices and profile meet [m]. Under 50 kN it is an energy of 1 J.
LARGEST_STEP = 2e-5


@dataclass(frozen=True, kw_only=True, eq=False)
class RailSection:
    """Slices of one rail, and where they lie on the track. Outside of them the rail's profile holds.

    Parameters
    ----------
    surface : RailSurface
        Slices, in the right-side convention.
    side : "right" or "left"
    at : float
        Place on the track at which the position of the slices is 0 [m].
    origin : (float, float), optional
        Place (y, z) of the origin of the slices in track coordinates of the right side [m]. Default: that of the rail's
        profile, for slices in its coordinates.
    name : str
        Name in messages.
    """

    surface: RailSurface
    side: str
    at: float
    origin: tuple[float, float] | None = None
    name: str = "section"

    @property
    def begin(self) -> float:
        """Place of an axle from which its wheel is solved on the slices [m]."""
        return self.at + float(self.surface.sheet.u[0]) - MARGIN

    @property
    def end(self) -> float:
        """Place of an axle up to which its wheel is solved on the slices [m]."""
        return self.at + float(self.surface.sheet.u[-1]) + MARGIN

    def pair(self, wheel: WheelSurface | Profile, rail: Profile, sizes: Mapping[str, Any]) -> SurfacePair:
        """Return a wheel on these slices, which lie in a rail with a profile. `sizes` are those of `SurfacePair`."""
        origin = self.origin or place_of_rail(rail, sizes["gauge"], sizes["gauge_point"])
        return SurfacePair(wheel, self.surface, **sizes, rail_origin=origin, tilted=True)

    def require_continued(self, wheel: Profile, rail: Profile, sizes: Mapping[str, Any]) -> None:
        """Check that a wheel in the middle of the track has the same height on the slices and on the profile at both ends.

        Raises
        ------
        ContactError
            If the heights differ by more than `LARGEST_STEP`.
        """
        on_profile, on_slices = Pair(wheel, rail, **sizes).touch(Pose()), self.pair(wheel, rail, sizes)
        for place, what in ((self.begin, "first"), (self.end, "last")):
            higher = on_profile - on_slices.touch(Pose(), station=place - self.at)
            if abs(higher) > LARGEST_STEP:
                raise ContactError(
                    f"{self.name}: on its {what} slice a wheel stands {1e3 * higher:.3g} mm higher than on the profile of the "
                    f"{self.side} rail; at most {1e3 * LARGEST_STEP:g} mm are allowed"
                )


def require_apart(sections: Sequence[RailSection]) -> None:
    """Check that sections of one rail do not overlap, with what is before and after them.

    Raises
    ------
    ContactError
        If two of them do.
    """
    for before, after in itertools.pairwise(sorted(sections, key=lambda each: (each.side, each.begin))):
        if before.side == after.side and after.begin < before.end:
            raise ContactError(
                f"{after.name}: on the {after.side} rail it begins at {after.begin:g} m, before {before.name} ends at "
                f"{before.end:g} m"
            )
