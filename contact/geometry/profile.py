"""Profiles of wheels and rails: the record, the standard shapes, and profiles from files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from inspect import signature
from os import PathLike
from pathlib import Path
from typing import Any

from contact.errors import ContactError, require_kind, require_number
from contact.geometry import library
from contact.geometry.files import SIDES, UNITS, ZEROS, Inspection, check, read, read_folder
from contact.geometry.library import ALIASES, cone, is_standard, named, names, rail_60e1, rail_arc, s1002
from contact.geometry.outline import SPACING
from contact.geometry.shape import Kind, Profile

__all__ = [
    "ALIASES", "SIDES", "SPACING", "UNITS", "ZEROS", "Inspection", "Kind", "Profile", "check", "cone", "default_inclination",
    "is_standard", "load", "named", "names", "rail_60e1", "rail_arc", "read", "read_folder", "s1002",
]  # fmt: skip


def default_inclination(name: str) -> float | None:
    """Return the inclination that `load` gives the rail with this name; None if the profile has its own."""
    known = not Path(name).is_file() and is_standard(name)
    return library.STANDARD_INCLINATION if known and library.has_inclination(name) else None


def is_file(name: str) -> bool:
    """Return whether `load` takes this name as that of a file."""
    return Path(name).is_file() or (("." in name or "/" in name or "\\" in name) and not is_standard(name))


def require_file(names: Iterable[str | None], options: Mapping[str, Any]) -> None:
    """Raise a ContactError for an option of `read` that is not its default, if none of the names of profiles is a file."""
    defaults = {name: parameter.default for name, parameter in signature(read).parameters.items() if name != "scale"}
    given = [name for name, default in defaults.items() if name in options and options[name] != default]
    if given and not any(name and is_file(name) for name in names):
        raise ContactError(
            f"{given[0]} = {options[given[0]]!r} says how a file is read, and the profiles are those of the standards"
        )


def load(
    name: str, kind: Kind, *, inclination: float | str | None = None, rotation: float = 0.0, **options: Any
) -> Profile:
    """Return the profile in the file `name`, or the standard profile with this name.

    Parameters
    ----------
    name : str
        The name of a standard profile. Any other name with a point or a slash, or of an existing file, is a file.
    kind : {"wheel", "rail"}
    inclination : float or str
        Of a rail towards the track's centre, 0 ... 0.1 or "1/40". A standard rail has 1/40 by default; a rail in a file is
        taken as it lies there, and an inclination turns it further.
    rotation : float
        Angle about x by which the outline is turned [rad], positive from y to the field side towards z down.
    options
        For files, as for `read`. `scale` also makes a model of a standard profile.

    Raises
    ------
    ContactError
        As `read` and `named`.
    """
    require_kind("name", name, str | PathLike)
    rail_inclination = inclination if kind == "rail" else None
    rotation = require_number("rotation", rotation, -0.5, 0.5)
    if is_file(name):
        found = read(name, kind=kind, **options)
        turned = 0.0 if rail_inclination is None else library.angle_of(rail_inclination)
        rotation -= turned
    else:
        signature(read).bind(name, **options)  # a misspelled option raises, though none but `scale` is for these
        found = named(name, kind=kind, inclination=rail_inclination)
        if (scale := require_number("scale", options.get("scale", 1.0), 0.01, 2.0)) != 1.0:
            found = Profile(kind, scale * found.y, scale * found.z, found.angle, f"{found.name}, scale {scale:g}")
    return found.rotated(rotation) if rotation else found
