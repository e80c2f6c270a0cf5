"""A track as a resource of the FMUs of vehicles: the rows of `contact_models.vehicle.course.lay`, without the speed, an input.

`python -m contact_fmu.track FMU SCENARIO` replaces the track in a finished FMU by that of a scenario.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact.arrays import Array
from contact.cli.output import reported
from contact_models.runs import scenario, simulated
from contact_models.runs.scenario import Scenario
from contact_models.vehicle.kernels.layout import TrackRow
from . import archive, resources
from .profiles import Given
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


@reported
def replace(
    fmu: Given, file: Annotated[Path, typer.Argument(help="TOML file of a scenario with the table [track]")]
) -> None:
    """Replace the track in a finished FMU of a vehicle."""
    given = scenario.read(file)
    given.require_profiles(file.name, "the FMUs of a vehicle take")
    exchange(fmu, given)


if __name__ == "__main__":
    typer.run(replace)
