"""Variables of the FMU `WheelRailSurfaces`: those of `WheelRailPair`, and where the wheel stands on surfaces that change."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from contact.inputs.options import MEMBERS, REACH
from ..rows import parameter, signal, taken
from ..variables import Enumeration, Table, Variable
from . import wheel_rail_pair as pair

#: Rows of the pair that surfaces do not have. The resource of the rail has its place, and slices have no bins.
ABSENT = frozenset(
    ("track.gauge", "track.gauge_point", "rail.inclination", "patches.combine_angle", *pair.OF_ACCUMULATION)
)
#: File names of the surfaces in resources/ (`contact_fmu.surfaces`). They show the right side and serve both sides.
WHEEL, RAIL = "wheel.surface", "rail.surface"
#: Most numbers of a resource: 16 MB, some 500 slices of 300 paths.
MOST_NUMBERS = 2_000_000
FRAME = Enumeration(
    "Frame",
    (
        ("AboutX", "the frame of a patch is the track frame turned about x, as in CONTACT"),
        (
            "Tilted",
            "it follows the normal of the rail in all directions, so the pressure of a ramp acts along the track",
        ),
    ),
)


@cache
def table() -> Table:
    """Return the table."""
    return Table(
        "WheelRailSurfaces",
        "One wheel of a wheelset on one rail, both of which may change along the way: crossings, flats, polygons. The surfaces "
        "are in resources. Contact search, every patch, creep forces and damage as in WheelRailPair. Forces act on the wheel. "
        "Track frame: x forward, y to the right, z down. As co-simulation has no feedthrough, the outputs after a step belong "
        "to the inputs before it: one communication step late.",
        [*_parameters(), *_inputs(), *_place(), *(row for row in pair.outputs() if row.name not in ABSENT)],
        step_size=1e-3,
    )


def _parameters() -> Iterable[Variable]:
    yield from (row for row in pair.parameters(0.0) if row.name not in ABSENT)
    about = (
        "Distance before and behind the axle that is searched, doubled as long as the bodies come closer at its ends"
    )
    yield parameter("surfaces.reach", about, **taken(REACH), nominal=0.1, member="motion.reach")
    yield parameter("surfaces.frame", "Frame of a patch", enumeration=FRAME, start="AboutX", member="motion.tilted")


def _inputs() -> Iterable[Variable]:
    """Yield the inputs of the pair. On surfaces that change along the way a wheel rolls forward only."""
    for row in pair.inputs():
        yield replace(row, minimum=0.0, description="Forward speed") if row.name == "velocity.x" else row


def _place() -> Iterable[Variable]:
    place = MEMBERS["pair_input"]
    yield signal(
        "pose.station", "Position of the axle along the slices of the rail", unit="m", **taken(place["station"])
    )
    about = "Angle by which the wheel has turned about the axle, negative when rolling forward; the integral of velocity.spin"
    yield signal("pose.rotation", about, unit="rad", **taken(place["rotation"]))
