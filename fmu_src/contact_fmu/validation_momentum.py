"""The law that holds a vehicle without contacts: on straight, level track momentum grows by the forces on it and the weight."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

from contact.arrays import Array
from contact_models.vehicle.assembly import GRAVITY, assemble
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Axis, TrackRow
from . import resources
from .tables.vehicle import TRACK
from .track import ROWS
from .validation_cases import Case

_RELATIVE = 1e-6  # of the largest force


def momentum(fmu: Path, vehicle: str, given: Case, answer: dict[str, Array]) -> list[str] | None:
    """Return what the law says against the answer of the FMU of a vehicle.

    None where its track is not straight and level, or where a frame holds a body aside or up.

    Forces are held over a step.
    """
    made = assemble(read(vehicle))
    if made.bodies["held"][:, [Axis.Y, Axis.Z]].any():
        return None
    places = made.bodies["place"]
    if not _is_straight(fmu, answer["distance"][0] + places.min(), answer["distance"][-1] + places.max()):
        return None
    mass: Array = made.bodies["mass"]
    found = []
    for axis, weight in (("y", 0.0), ("z", GRAVITY * float(mass.sum()))):
        moved: Array = np.sum([m * answer[f"body[{k}].{axis}"] for k, m in enumerate(mass, 1)], axis=0)
        forces = [values for name, values in given.inputs.items() if name.endswith(f".force.{axis}")]
        force: Array = weight + np.sum(forces, axis=0)
        grown = np.diff(moved, 2) / given.step**2
        largest = max(float(np.abs(force).max()), GRAVITY * float(mass.sum()))
        if np.abs(grown - force[1:-1]).max() > _RELATIVE * largest:
            worst = int(np.argmax(np.abs(grown - force[1:-1])))
            found.append(
                f"the momentum along {axis} grows by {grown[worst]:.6g} N for a force of {force[1 + worst]:.6g} N at "
                f"{given.time[1 + worst]:g} s"
            )
    return found


def _is_straight(fmu: Path, begin: float, end: float) -> bool:
    with zipfile.ZipFile(fmu) as archive:
        track = resources.unpack(archive.read(f"resources/{TRACK}"), ROWS, str(fmu))
    near = (track[TrackRow.PLACE] > begin - 1.0) & (track[TrackRow.PLACE] < end + 1.0)
    bent = (TrackRow.CURVATURE, TrackRow.CANT, TrackRow.CANT_SLOPE)
    return not any(np.any(track[row, near]) for row in bent)
