"""Build the FMUs that `contact fmu` is asked for."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from contact.cli.extras import absent_modules
from contact.errors import ContactError
from contact.geometry.profile import Kind, Profile
from contact.study.files import require_folder
from contact_models.runs import scenario
from . import ssp, starts, validation
from .catalogue import Model, models, surfaces, vehicles
from .documentation import markdown
from .native import packaging as native
from .native import systems
from .options import Options
from .python import packaging as python
from .tables.vehicle import START

#: FMUs by the names of their tables; those that need an option have no form for hosts with Python.
_SURFACES, _VEHICLES = ("WheelRailSurfaces",), ("Vehicle", "OpenVehicle")
_NATIVE_ONLY = _SURFACES + _VEHICLES
MODELS = ("WheelRailContact", "EllipticContact", "WheelRailPair", "Wheelset", *_NATIVE_ONLY)
#: FMUs of which the two systems are made.
_WHEELSET, _VEHICLE = {"Wheelset", "WheelRailPair"}, {"OpenVehicle", "WheelRailPair"}


class _Asked(NamedTuple):
    """What to build: packagings, names of models, versions of FMI, systems of the libraries."""

    packagings: tuple[str, ...]
    models: tuple[str, ...]
    versions: tuple[int, ...]
    platforms: tuple[str, ...]


def _asked(options: Options) -> _Asked:
    """Return what the options ask for. Options that exclude each other are refused."""
    fmi, packaging, vehicle = options.fmi, options.packaging or "native", options.vehicle
    packagings = ("python", "native") if packaging == "all" else (str(packaging),)
    usual = (*(("Vehicle",) if vehicle else ()), *(("WheelRailSurfaces",) if options.surfaces else ()))
    names = tuple(options.model or (("all",) if options.packaging else usual or ("WheelRailPair",)))
    platforms = tuple(options.platform or ())
    for option, given, allowed in (
        ("model", names, (*MODELS, "all")),
        ("fmi", (fmi or "all",), ("2", "3", "all")),
        ("platform", platforms, (*systems.SYSTEMS, "all")),
    ):
        if unknown := [one for one in given if one not in allowed]:
            raise ContactError(f"--{option} {unknown[0]} is unknown; allowed: {', '.join(allowed)}")
    if options.points < 3:
        raise ContactError(f"--points {options.points}: a separation has at least 3 samples")
    for option, there, needed in (("vehicle", vehicle, _VEHICLES), ("surfaces", options.surfaces, _SURFACES)):
        if not there and (lacking := [one for one in needed if one in names]):
            raise ContactError(f"--model {lacking[0]} needs --{option}")
    if packaging == "python":
        if fmi == "3":
            raise ContactError(
                "--fmi 3: FMUs for hosts with Python are of FMI 2.0; leave it out, or --packaging native"
            )
        if platforms and not {"linux64", "win64", "all"} & set(platforms):
            raise ContactError(
                f"--platform {' '.join(platforms)}: FMUs for hosts with Python are for linux64 and win64"
            )
        if only_native := [one for one in names if one in _NATIVE_ONLY]:
            raise ContactError(f"--model {only_native[0]} is native: --packaging native")
    versions = {"2": (2,), "3": (3,), "all": (2, 3)}[fmi or ("all" if options.packaging else "2")]
    systems_of = systems.USUAL if not platforms or "all" in platforms else platforms
    return _Asked(packagings, names, versions, (*systems_of, *(systems.ARM if options.arm else ())))


def build(options: Options, given: Mapping[Kind, Profile]) -> None:
    """Build what is asked for with the given profiles, or print its variables."""
    asked = _asked(options)
    if options.validation is not None and absent_modules("fmu"):
        raise ImportError("a validation set is made by fmpy: pip install 'wheelrail-contact[fmu]'")
    if options.vehicle:
        of_vehicle = scenario.read(options.vehicle)
        given = {**starts.profiles(of_vehicle), **given}
        for what in starts.left_out(of_vehicle):
            print(f"{options.vehicle.name}: the FMUs of the vehicle do not take {what}")
    if not options.describe:
        require_folder(options.out)
        # before the models, because Python uses the one of this system; else a clone would build a library for itself too
        if "native" in asked.packagings:
            systems.folder(asked.platforms)
        if "python" in asked.packagings:
            systems.of_this_machine()

    def is_asked(model: Model) -> bool:
        return "all" in asked.models or model.table.name in asked.models

    chosen = tuple(filter(is_asked, models(options.points, given, options.accumulation)))
    more: tuple[Model, ...] = (surfaces(given),) if options.surfaces else ()
    more += vehicles(options.vehicle, given) if options.vehicle else ()
    more = tuple(filter(is_asked, more))
    if options.describe:
        print("\n".join(markdown(model.table) for model in (*chosen, *more)))
        return
    names = {model.table.name for model in (*chosen, *more)}
    if "python" in asked.packagings:
        for model in chosen:
            print(f"{model.table.name}, for hosts with Python ... ", end="", flush=True)
            made = python.build(model, options.out / "python", asked.platforms)
            print(_size(made))
            _validate(options, [made], model)
        if names >= _WHEELSET:
            build_system(options.out / "python")
    if "native" in asked.packagings:
        made_of = build_native((*chosen, *more), options.out / "native", asked.versions, asked.platforms)
        for model, paths in zip((*chosen, *more), made_of, strict=True):
            _validate(options, paths, model)
        if asked.versions[0] == 2 and names >= _WHEELSET:
            build_system(options.out / "native")
        if asked.versions[0] == 2 and options.vehicle and names >= _VEHICLE:
            system = ssp.vehicle_on_rails(scenario.read(options.vehicle), START)
            print(f"{system.name}, the vehicle and its contacts: {_size(ssp.build(options.out / 'native', system))}")


def _validate(options: Options, paths: Sequence[Path], model: Model) -> None:
    """Write the validation sets of an FMU, if asked for."""
    if options.validation is None:
        return
    for path in paths:
        is_python = path.parent.name == "python"
        exchange = not is_python and model.component.exchange
        of = model.options.get("vehicle")
        made = validation.write(
            path, model.table, options.validation, exchange=exchange, force=options.force, vehicle=of
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
