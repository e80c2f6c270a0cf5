"""A track as a resource of the FMUs of vehicles: the rows of `contact_models.vehicle.course.lay`, but for the speed."""

from __future__ import annotations

from pathlib import Path

from contact.arrays import Array
from contact_models.runs import simulated
from contact_models.runs.scenario import Scenario
from contact_models.vehicle.kernels.layout import TrackRow
from . import archive, resources
from .tables.vehicle import TRACK

MAGIC = b"wr-track"
ROWS = len(TrackRow)


def pack(given: Scenario) -> bytes:
    """Return the resource of the track of a scenario."""
    return pack_rows(simulated.track(given))


def pack_rows(rows: Array) -> bytes:
    """Return the resource of a track with these rows."""
    return resources.pack(MAGIC, rows)


def unpack(resource: bytes) -> Array:
    """Return the rows of a track's resource. Raise ContactError if it is none."""
    return resources.unpack(resource, ROWS, f"resource {TRACK}").copy()


def exchange(fmu: Path, given: Scenario) -> None:
    """Replace the track in an FMU file. If this fails, the file is unchanged.

    Raises
    ------
    ContactError
        If the file is not the FMU of a vehicle.
    """
    archive.exchange(fmu, {f"resources/{TRACK}": pack(given)}, "the FMU of a vehicle")
