"""Profiles as resources of an FMU. Their points and tangents are read when an instance is made.

`python -m contact_fmu.profiles FMU [--wheel NAME|FILE] [--rail NAME|FILE]` replaces the profiles in a finished
FMU. This needs no compiler.

A resource (`contact_fmu.resources`) has the rows y [m], z [m] and the angle of the tangent [rad].
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

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


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the command line options that name profiles. `chosen` reads them."""
    for kind in MAGIC:
        parser.add_argument(
            f"--{kind}",
            metavar="NAME|FILE",
            help=f"profile of the {kind}: a name of `contact profiles`, or a file (formats: contact.geometry.files)",
        )
    parser.add_argument(
        "--inclination", metavar="1/40", help="inclination of a rail; in a file it turns the rail further"
    )
    parser.add_argument(
        "--profile-rotation",
        nargs=2,
        type=float,
        default=(0.0, 0.0),
        metavar=("WHEEL", "RAIL"),
        help="angles in rad by which they are turned about x, positive from the field side down",
    )
    parser.add_argument("--profile-unit", choices=profile.UNITS, help="unit of the profile files, for plain columns")
    parser.add_argument("--profile-side", choices=profile.SIDES, help="side that the files show, for plain columns")
    parser.add_argument(
        "--profile-zero", help=f"zero of the profile files: {', '.join(profile.ZEROS)}, or a distance in m"
    )
    parser.add_argument("--profile-scale", type=float, default=1.0, metavar="0.2", help="scale of profiles of a model")
    parser.add_argument("--profile-columns", type=int, nargs=2, metavar=("Y", "Z"), help="columns of y and z, from 1")
    parser.add_argument(
        "--profile-rows",
        type=int,
        nargs=2,
        metavar=("FIRST", "LAST"),
        help="lines that are read; 0 as the last: to the end",
    )
    parser.add_argument("--profile-section", metavar="1|joined", help="which list of points of a file that has several")
    parser.add_argument(
        "--profile-repair", action="store_true", help="sort rows, keep one scan, drop spikes and back steps"
    )
    parser.add_argument(
        "--profile-smoothing",
        type=float,
        metavar="M",
        help="measurement noise in m to smooth out of the files, for example 2e-6 (needs scipy)",
    )
    parser.add_argument(
        "--profile-wavelength", type=float, metavar="M", help="instead: waves of this length in m are halved, like 3e-3"
    )


def chosen(arguments: argparse.Namespace) -> dict[Kind, Profile]:
    """Return the profiles that the command line names."""
    prefix = "profile_"
    reading = {key.removeprefix(prefix): value for key, value in vars(arguments).items() if key.startswith(prefix)}
    wheel, rail = reading.pop("rotation")
    return {
        kind: profile.load(
            name, kind, inclination=arguments.inclination, rotation=wheel if kind == "wheel" else rail, **reading
        )
        for kind in MAGIC
        if (name := getattr(arguments, kind))
    }


def replace(
    parser: argparse.ArgumentParser,
    chosen: Callable[[argparse.Namespace], Any],
    exchange: Callable[[Path, Any], Any],
) -> None:
    """Run a command that replaces what lies in an FMU: `chosen` reads it from the command line, `exchange` writes it."""
    arguments = parser.parse_args()
    try:
        new = chosen(arguments)
        if not new:
            parser.print_help()
            parser.exit(2, "nothing to do: give --wheel, --rail or both\n")
        exchange(arguments.fmu, new)
    except (ContactError, ImportError, OSError) as error:
        parser.error(str(error))


def main() -> None:
    """Replace the profiles that the command line names."""
    parser = argparse.ArgumentParser(description="Replace the profiles in a finished WheelRailPair FMU.")
    parser.add_argument("fmu", type=Path)
    add_options(parser)
    replace(parser, chosen, exchange)


if __name__ == "__main__":
    main()
