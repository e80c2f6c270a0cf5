"""Profiles of wheels and rails: the record, the standard shapes, and profiles from files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from contact.errors import ContactError
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


def load(name: str, kind: Kind, *, inclination: float | str | None = None, **options: Any) -> Profile:
    """Return the profile in the file `name`, or the standard profile with this name.

    The name of a standard profile is for `named`, with `inclination` if it is a rail; the other options are ignored. Any
    other `name` with a point or a slash, or of an existing file, is a file for `read` with the options.

    Raises
    ------
    ContactError
        As `read` and `named`. Also for an inclination of a rail from a file, which already has its inclination.
    """
    rail_inclination = inclination if kind == "rail" else None
    is_file = Path(name).is_file() or (("." in name or "/" in name or "\\" in name) and not is_standard(name))
    if not is_file:
        return named(name, kind=kind, inclination=rail_inclination)
    if rail_inclination is not None:
        raise ContactError(f"inclination = {inclination}: the rail in the file {name!r} is taken as it lies there")
    return read(name, kind=kind, **options)
