"""The options of `contact fmu`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from .tables.wheel_rail_contact import POINTS

_NAME = "a name of `contact profiles`, or a file"
WheelName = Annotated[str | None, typer.Option("--wheel", help=f"Profile of the wheel: {_NAME}.")]
RailName = Annotated[str | None, typer.Option("--rail", help=f"Profile of the rail: {_NAME}.")]


class Packaging(StrEnum):
    """Whether the FMU is for hosts with Python, for any host (native), or both."""

    python = "python"
    native = "native"
    all = "all"


@dataclass
class Options:
    """What to build."""

    packaging: Annotated[
        Packaging | None,
        typer.Option(
            help="python: for hosts with Python; native (the default): for any host. Each has a folder of its name. Given "
            "without --model or --fmi it asks for every FMU of that packaging."
        ),
    ] = None
    model: Annotated[
        list[str] | None,
        typer.Option(
            help="FMU to build, or all; may be repeated. Default: Vehicle with --vehicle, WheelRailSurfaces with "
            "--surfaces, else WheelRailPair."
        ),
    ] = None
    fmi: Annotated[str | None, typer.Option(help="Version of FMI: 2 (default), 3 (native only) or all.")] = None
    platform: Annotated[
        list[str] | None,
        typer.Option(
            help="System of a library in the FMUs: linux64, win64, darwin64 (default: all three); may be repeated."
        ),
    ] = None
    out: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path("dist")
    points: Annotated[int, typer.Option(help="Samples of the separation of WheelRailContact, at least 3.")] = POINTS
    accumulation: Annotated[
        bool, typer.Option("--accumulation", help="Give WheelRailPair the outputs of accumulated damage, 1500 numbers.")
    ] = False
    surfaces: Annotated[
        bool, typer.Option("--surfaces", help="Add the native FMU WheelRailSurfaces: crossings, flats, polygons.")
    ] = False
    vehicle: Annotated[
        Path | None,
        typer.Option(help="File of a scenario: adds its vehicle as the native FMUs Vehicle and OpenVehicle."),
    ] = None
    arm: Annotated[
        bool, typer.Option("--arm", help="Add libraries for 64-bit ARM to the native FMUs (some minutes).")
    ] = False
    describe: Annotated[bool, typer.Option("--describe", help="Print the variables as Markdown and build nothing.")] = (
        False
    )
    validation: Annotated[
        Path | None,
        typer.Option(help="Write a validation set for each FMU into this folder; contact fmu-check compares with it."),
    ] = None
    force: Annotated[bool, typer.Option("--force", help="Overwrite validation sets that exist.")] = False
