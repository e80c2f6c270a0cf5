"""`contact fmu`: build the FMUs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from contact.cli.output import stop


class Packaging(StrEnum):
    """Whether the FMU is for hosts with Python, for any host (native), or both."""

    python = "python"
    native = "native"
    all = "all"


class Unit(StrEnum):
    """Unit of a profile file."""

    m = "m"
    mm = "mm"


class Side(StrEnum):
    """Side of the track that a profile file shows."""

    right = "right"
    left = "left"


PROFILE = "a name of `contact profiles`, or a file"


def fmu(
    packaging: Annotated[
        Packaging,
        typer.Option(help="python: for hosts with Python; native: for any host, into the subfolder native."),
    ] = Packaging.all,
    out: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path("dist"),
    points: Annotated[
        int | None,
        typer.Option(help="Samples of the separation of WheelRailContact. Default: as many as Wheelset gives."),
    ] = None,
    wheel: Annotated[str | None, typer.Option(help=f"Profile of the wheel: {PROFILE}.")] = None,
    rail: Annotated[str | None, typer.Option(help=f"Profile of the rail: {PROFILE}.")] = None,
    unit: Annotated[Unit | None, typer.Option(help="Unit of the profile files, for plain columns.")] = None,
    side: Annotated[Side | None, typer.Option(help="Side that the files show, for plain columns.")] = None,
    smoothing: Annotated[
        float | None, typer.Option(help="Measurement noise in m to smooth out of the files, for example 2e-6.")
    ] = None,
    accumulation: Annotated[
        bool, typer.Option("--accumulation", help="Give WheelRailPair the outputs of accumulated damage, 1500 numbers.")
    ] = False,
    describe: Annotated[
        bool, typer.Option("--describe", help="Print the variables as Markdown and build nothing.")
    ] = False,
) -> None:
    """Build the FMUs: Wheelset, WheelRailContact and WheelRailPair.

    Example:  contact fmu --packaging python --out dist
    """
    try:
        from fmu_src.build import main
    except ModuleNotFoundError as missing:
        stop(
            f"FMUs need {missing.name}: pip install 'wheelrail-contact[fmu]', native ones 'wheelrail-contact[native]'",
            1,
        )
    options = {
        "packaging": packaging,
        "out": out,
        "points": points,
        "wheel": wheel,
        "rail": rail,
        "unit": unit,
        "side": side,
        "smoothing": smoothing,
    }
    words = [f"--{name}={value}" for name, value in options.items() if value is not None]
    switches = {"--accumulation": accumulation, "--describe": describe}
    main([*words, *(word for word, on in switches.items() if on)], "contact fmu")
