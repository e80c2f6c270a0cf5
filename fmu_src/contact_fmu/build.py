"""Build the FMUs: `contact fmu`, ``python -m contact_fmu.build`` and, in a checkout, ``python build_fmu.py``."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from contact.errors import ContactError
from contact_models.runs import scenario
from . import profiles, ssp, starts
from .catalogue import Model, models, surfaces, vehicles
from .documentation import markdown
from .native import packaging as native
from .native import systems
from .tables.vehicle import START
from .tables.wheel_rail_contact import POINTS

#: FMUs by the names of their tables; those that need an option have no form for hosts with Python.
_NATIVE_ONLY = ("WheelRailSurfaces", "Vehicle", "OpenVehicle")
MODELS = ("WheelRailContact", "EllipticContact", "WheelRailPair", "Wheelset", *_NATIVE_ONLY)
#: FMUs of which the two systems are made.
_WHEELSET, _VEHICLE = {"Wheelset", "WheelRailPair"}, {"OpenVehicle", "WheelRailPair"}


def main(words: Sequence[str] | None = None, name: str | None = None) -> None:
    """Build the FMUs that the command line asks for. `words` and `name` replace the process's arguments and program name."""
    parser = argparse.ArgumentParser(prog=name, description="Build the FMUs of wheelrail-contact.")
    parser.add_argument(
        "--packaging",
        choices=["python", "native", "all"],
        help="python: for hosts with Python, into FOLDER/python; native: for any host, into FOLDER/native (default). Given "
        "without --model or --fmi it asks for every model and version of that packaging",
    )
    parser.add_argument(
        "--model",
        action="append",
        choices=[*MODELS, "all"],
        help="FMU to build, may be repeated (default: Vehicle with --vehicle, WheelRailSurfaces with --surfaces, else "
        "WheelRailPair)",
    )
    parser.add_argument("--fmi", choices=["2", "3", "all"], help="version of FMI (default: 2; 3 is native only)")
    parser.add_argument(
        "--platform",
        action="append",
        choices=[*systems.SYSTEMS, "all"],
        help="system of a library in the FMUs, may be repeated (default: linux64, win64 and darwin64)",
    )
    parser.add_argument(
        "--out", type=Path, default=Path("dist"), metavar="FOLDER", help="output folder (default: dist)"
    )
    parser.add_argument(
        "--points",
        type=int,
        default=POINTS,
        help=f"samples of the separation of WheelRailContact, at least 3 (default: {POINTS})",
    )
    parser.add_argument(
        "--accumulation",
        action="store_true",
        help="give WheelRailPair 1500 outputs more: damage that accumulates in bins over both profiles",
    )
    parser.add_argument(
        "--arm",
        action="store_true",
        help="add libraries for 64-bit ARM to the native FMUs, for Linux and macOS (some minutes)",
    )
    parser.add_argument(
        "--surfaces",
        action="store_true",
        help="add the native FMU WheelRailSurfaces: a pair whose wheel and rail may change along the way",
    )
    parser.add_argument(
        "--vehicle",
        type=Path,
        metavar="SCENARIO",
        help="add the native FMUs Vehicle and OpenVehicle: the vehicle of a scenario's file on its track",
    )
    parser.add_argument(
        "--validation",
        type=Path,
        metavar="FOLDER",
        help="write a validation set for each FMU into FOLDER: inputs, reference, tolerances (contact fmu-check compares)",
    )
    parser.add_argument("--force", action="store_true", help="overwrite validation sets that exist")
    profiles.add_options(parser)
    parser.add_argument("--describe", action="store_true", help="print the variables as Markdown and build nothing")
    arguments = parser.parse_args(words)
    if arguments.points < 3:
        parser.error(f"--points {arguments.points}: a separation has at least 3 samples")

    asked = _asked(parser, arguments)
    try:
        _build(arguments, asked)
    except (ContactError, ImportError) as error:
        if name is not None:
            raise  # the command line says it in its own words
        parser.error(str(error))


class _Asked(NamedTuple):
    """What to build: packagings, names of models, versions of FMI, systems of the libraries."""

    packagings: tuple[str, ...]
    models: tuple[str, ...]
    versions: tuple[int, ...]
    platforms: tuple[str, ...]


def _asked(parser: argparse.ArgumentParser, arguments: argparse.Namespace) -> _Asked:
    """Return what the options ask for. Options that exclude each other end the command."""
    packaging = arguments.packaging or "native"
    packagings = ("python", "native") if packaging == "all" else (packaging,)
    every = bool(arguments.packaging)
    usual: tuple[str, ...] = ("Vehicle",) if arguments.vehicle else ()
    usual += ("WheelRailSurfaces",) if arguments.surfaces else ()
    names = tuple(arguments.model or (("all",) if every else usual or ("WheelRailPair",)))
    fmi = arguments.fmi or ("all" if every else "2")
    platforms = tuple(arguments.platform or ()) or systems.USUAL
    if "all" in platforms:
        platforms = systems.USUAL
    if arguments.arm:
        platforms = (*platforms, *systems.ARM)
    for option, needed in (("vehicle", ("Vehicle", "OpenVehicle")), ("surfaces", ("WheelRailSurfaces",))):
        if not getattr(arguments, option) and (lacking := [one for one in needed if one in names]):
            parser.error(f"--model {lacking[0]} needs --{option}")
    if packaging == "python":
        if arguments.fmi == "3":
            parser.error("--fmi 3: FMUs for hosts with Python are of FMI 2.0; leave it out, or --packaging native")
        if arguments.platform and not {"linux64", "win64", "all"} & set(arguments.platform):
            parser.error(
                f"--platform {' '.join(arguments.platform)}: FMUs for hosts with Python are for linux64 and win64"
            )
        if only_native := [one for one in names if one in _NATIVE_ONLY]:
            parser.error(f"--model {only_native[0]} is native: --packaging native")
    return _Asked(packagings, names, {"2": (2,), "3": (3,), "all": (2, 3)}[fmi], platforms)


def _build(arguments: argparse.Namespace, asked: _Asked) -> None:
    """Build what is asked for, or print its variables."""
    if not arguments.describe:
        # first, because Python uses the one of this system; else a clone would build a library for itself too
        if "native" in asked.packagings:
            systems.folder(asked.platforms)
        if "python" in asked.packagings:
            systems.of_this_machine()
    given = profiles.chosen(arguments)
    if arguments.vehicle:
        of_vehicle = scenario.read(arguments.vehicle)
        given = {**starts.profiles(of_vehicle), **given}
        for what in starts.left_out(of_vehicle):
            print(f"{arguments.vehicle.name}: the FMUs of the vehicle do not take {what}")

    def is_asked(model: Model) -> bool:
        return "all" in asked.models or model.table.name in asked.models

    chosen = tuple(filter(is_asked, models(arguments.points, given, arguments.accumulation)))
    more: tuple[Model, ...] = (surfaces(given),) if arguments.surfaces else ()
    more += vehicles(arguments.vehicle, given) if arguments.vehicle else ()
    more = tuple(filter(is_asked, more))
    if arguments.describe:
        print("\n".join(markdown(model.table) for model in (*chosen, *more)))
        return
    names = {model.table.name for model in (*chosen, *more)}
    if "python" in asked.packagings:
        from .python import packaging as python  # it needs pythonfmu

        for model in chosen:
            print(f"{model.table.name}, for hosts with Python ... ", end="", flush=True)
            made = python.build(model, arguments.out / "python", asked.platforms)
            print(_size(made))
            _validate(arguments, [made], model)
        if names >= _WHEELSET:
            build_system(arguments.out / "python")
    if "native" in asked.packagings:
        made_of = build_native((*chosen, *more), arguments.out / "native", asked.versions, asked.platforms)
        for model, paths in zip((*chosen, *more), made_of, strict=True):
            _validate(arguments, paths, model)
        if asked.versions[0] == 2 and names >= _WHEELSET:
            build_system(arguments.out / "native")
        if asked.versions[0] == 2 and arguments.vehicle and names >= _VEHICLE:
            system = ssp.vehicle_on_rails(scenario.read(arguments.vehicle), START)
            print(f"{system.name}, the vehicle and its contacts: {_size(ssp.build(arguments.out / 'native', system))}")


def _validate(arguments: argparse.Namespace, paths: Sequence[Path], model: Model) -> None:
    """Write the validation sets of an FMU, if asked for."""
    if arguments.validation is None:
        return
    try:
        from . import validation
    except ModuleNotFoundError as error:
        raise ImportError(f"{error}: a validation set is made by fmpy: pip install 'wheelrail-contact[fmu]'") from None
    for path in paths:
        is_python = path.parent.name == "python"
        exchange = not is_python and model.component().exchange
        of = model.options.get("vehicle")
        made = validation.write(
            path, model.table, arguments.validation, exchange=exchange, force=arguments.force, vehicle=of
        )
        for place in made:
            print(f"{model.table.name}, validation set: {place}")


def build_native(
    chosen: Sequence[Model], folder: Path, versions: Sequence[int] = (2, 3), platforms: Sequence[str] = systems.USUAL
) -> list[list[Path]]:
    """Build FMUs that need no Python and print the progress. Return the files of each.

    An FMU is the libraries and its data. A clone builds the libraries if they are not there.
    """
    begin = time.monotonic()

    def say(what: str) -> None:
        print(f"  {time.monotonic() - begin:3.0f} s  {what}", flush=True)

    def build(model: Model) -> list[Path]:
        def say_of_it(what: str) -> None:
            say(f"{model.table.name}: {what}")

        made = native.build(model, folder, say_of_it, versions, platforms)
        for path in made:
            say_of_it(_size(path))
        return made

    print("Native, for hosts without Python:")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(build, chosen))


def build_system(folder: Path) -> None:
    """Build the coupled wheelset from the FMUs in a folder."""
    print(f"{ssp.NAME}, a system of these: {_size(ssp.build(folder, ssp.wheelset_on_rails()))}")


def _size(path: Path) -> str:
    return f"{path} ({path.stat().st_size / 1024:.0f} kB)"


if __name__ == "__main__":
    main()
