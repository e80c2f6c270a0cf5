"""`contact fmu`, in a checkout also ``python build_fmu.py``: build the FMUs."""

from __future__ import annotations

import contextlib
import sys

import typer

from contact.cli import arguments
from contact.cli import options as opt
from contact.cli.document import document
from contact.cli.output import reported, stop
from .options import Options, RailName, WheelName


@reported
def fmu(
    *,
    options: Options,
    wheel: WheelName = None,
    rail: RailName = None,
    reading: arguments.Reading,
    as_json: opt.Json = False,
) -> None:
    """Build FMUs: by default WheelRailPair, native, FMI 2.0.

    The others are WheelRailContact, EllipticContact, Wheelset and, native, WheelRailSurfaces, Vehicle and OpenVehicle.

    Example:  contact fmu --wheel S1002 --rail 60E1 --out dist
    """
    with contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext():
        try:
            from .build import build

            build(options, reading.chosen(wheel, rail))
        except ImportError as error:
            stop(str(error), 1)
    if as_json:
        files = sorted(str(path) for path in options.out.rglob("*") if path.suffix in (".fmu", ".ssp"))
        typer.echo(document({"files": files}))
