"""Profiles as resources of an FMU. Their points and tangents are read when an instance is made.

A resource (`contact_fmu.resources`) has the rows y [m], z [m] and the angle of the tangent [rad].
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.profile import Kind, Profile
from contact.geometry.wheelset import Pair
from . import archive
from . import resources as files
from .tables.wheel_rail_pair import RAIL, WHEEL

ROWS = 3
MAGIC: dict[Kind, bytes] = {"wheel": b"wr-wheel", "rail": b"wr-rail\0"}
_RESOURCES: dict[Kind, str] = {"wheel": WHEEL, "rail": RAIL}


def pack(given: Profile) -> bytes:
    """Return the resource of a profile.

    Raises
    ------
    ContactError
        If the profile has more points than an FMU reads, or cannot touch another one.
    """
    if given.y.size > files.MOST_POINTS:
        raise ContactError(f"profile of {given.y.size} points: an FMU reads at most {files.MOST_POINTS}")
    other: Profile = profile.rail_60e1() if given.kind == "wheel" else profile.s1002()
    Pair(
        *((given, other) if given.kind == "wheel" else (other, given)), gauge_point=1e-6
    )  # raises if they cannot touch
    return files.pack(MAGIC[given.kind], np.stack((given.y, given.z, given.angle)))


def resources(wheel: Profile, rail: Profile) -> dict[str, bytes]:
    """Return name → content of the resources of a pair."""
    return {WHEEL: pack(wheel), RAIL: pack(rail)}


def exchange(fmu: Path, profiles: dict[Kind, Profile]) -> None:
    """Replace profiles in an FMU file. If this fails, the file is unchanged.

    Raises
    ------
    ContactError
        If the file is not a WheelRailPair FMU.
    """
    new = {f"resources/{_RESOURCES[kind]}": pack(given) for kind, given in profiles.items()}
    archive.exchange(fmu, new, "a WheelRailPair FMU")
