"""The mirror across the track, y to -y, of what an FMU gets and answers: mirrored inputs have mirrored answers."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np

from contact.arrays import Array
from .variables import Table

#: Last part of a name → names that change their sign in the mirror, of all FMUs.
_ODD = re.compile(
    r"(^|\.)("
    r"(pose|velocity|irregularity|offset)\.(y|roll|yaw)|(irregularity|offset)\.(y|roll|yaw)_rate"
    r"|force\.y|moment\.[xz]|(rail\.)?(preload|deflection)_y"
    r"|patch\[\d+\]\.(fy|mx|mz|y|angle|lateral|spin)"
    r"|creepage\.(lateral|spin)"
    r")$"
)
#: Arrays over the width of a contact, whose order turns round; they are not compared.
_ACROSS = re.compile(r"geometry\.(g|A|tilt)\[\d+\]$")
_MATRIX = re.compile(r"creep_stiffness\[(\d),(\d)\]$")


def has_mirror(table: Table) -> bool:
    """Return whether the FMU has a mirror: vehicles have not, since their track is what it is."""
    return table.name not in ("Vehicle", "OpenVehicle", "Wheelset")


def factor(name: str) -> float:
    """Return the factor of the value of a variable in the mirror."""
    if found := _MATRIX.search(name):
        return -1.0 if (found[1] == "1") != (found[2] == "1") else 1.0
    return -1.0 if _ODD.search(name) else 1.0


def starts(table: Table) -> dict[str, float]:
    """Return the starts of the parameters that differ in the mirror: the other wheel, another side of the track."""
    found = {}
    for scalar in table.scalars:
        if scalar.row.is_given and factor(scalar.name) < 0.0 and float(scalar.first) != 0.0:
            found[scalar.name] = -float(scalar.first)
    if "side" in table.row:
        found["side"] = 3.0 - float(table.scalars[table.references("side")[0]].first)
    return found


def mirrored(inputs: dict[str, Array]) -> dict[str, Array]:
    """Return the inputs in the mirror."""
    return {name: factor(name) * values for name, values in inputs.items()}


def unlike(answer: dict[str, Array], other: dict[str, Array], tolerance: Callable[[str, Array], float]) -> list[str]:
    """Return what differs of an answer and that in the mirror."""
    found = []
    for name, values in answer.items():
        if name == "time" or _ACROSS.search(name) or name not in other:
            continue
        apart = np.abs(values - factor(name) * other[name])
        if apart.max() > tolerance(name, values):
            at = answer["time"][int(np.argmax(apart))]
            found.append(f"{name} is not that of mirrored inputs: {apart.max():.3g} apart at {at:g} s")
    return found
