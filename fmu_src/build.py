"""Build the FMUs: `contact fmu`, ``python -m contact_fmu.build`` and, in a checkout, ``python build_fmu.py``."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from contact_models.life import scenario
from contact_models.wheelset import ports
from contact_models.wheelset.parameters import WheelsetParameters

from contact.errors import ContactError
from . import profiles, ssp, starts
from .catalogue import Model, models, surfaces, vehicles
from .documentation import markdown
from .native import packaging as native
from .native import systems
from .tables.vehicle import START


def main(words: Sequence[str] | None = None, name: str | None = None) -> None:
    """Build the FMUs that the command line asks for. `words` and `name` replace the process's arguments and program name."""
    parser = argparse.ArgumentParser(prog=name, description="Build the FMUs of wheelrail-contact.")
    parser.add_argument(
        "--packaging",
        choices=["python", "native", "all"],
        default="all",
        help="python: for hosts with Python, into FOLDER/python; native: for any host, into FOLDER/native (default: all)",
    )
    parser.add_argument(
        "--out", type=Path, default=Path("dist"), metavar="FOLDER", help="output folder (default: dist)"
    )
    parser.add_argument(
        "--points",
        type=int,
        default=ports.POINTS,
        help=f"samples of the separation of WheelRailContact, at least 3 (default: {ports.POINTS}, as many as Wheelset gives)",
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
    profiles.add_options(parser)
    parser.add_argument("--describe", action="store_true", help="print the variables as Markdown and build nothing")
    arguments = parser.parse_args(words)
    if arguments.points < 3:
        parser.error(f"--points {arguments.points}: a separation has at least 3 samples")

    if arguments.packaging != "python" and not arguments.describe:
        # first, because Python uses the one of this system; else a clone would build a library for itself too
        systems.folder((*systems.USUAL, *(systems.ARM if arguments.arm else ())))
    try:
        given = profiles.chosen(arguments)
        if arguments.vehicle:
            of_vehicle = scenario.read(arguments.vehicle)
            given = {**starts.profiles(of_vehicle), **given}
            for what in starts.left_out(of_vehicle):
                print(f"{arguments.vehicle.name}: the FMUs of the vehicle do not take {what}")
        chosen = models(arguments.points, given, arguments.accumulation)
        more: tuple[Model, ...] = (surfaces(given),) if arguments.surfaces else ()
        more += vehicles(arguments.vehicle, given) if arguments.vehicle else ()
    except (ContactError, ImportError) as error:
        parser.error(str(error))
    if arguments.describe:
        print("\n".join(markdown(model.table) for model in (*chosen, *more)))
        return
    if arguments.packaging != "native":
        from .python import packaging as python  # it needs pythonfmu

        for model in chosen:
            print(f"{model.table.name}, for hosts with Python ... ", end="", flush=True)
            print(_size(python.build(model, arguments.out / "python")))
        build_system(arguments.out / "python")
    if arguments.packaging != "python":
        build_native((*chosen, *more), arguments.out / "native", arm=arguments.arm)
        build_system(arguments.out / "native")
        if arguments.vehicle:
            system = ssp.vehicle_on_rails(scenario.read(arguments.vehicle), START)
            print(f"{system.name}, the vehicle and its contacts: {_size(ssp.build(arguments.out / 'native', system))}")


def build_native(chosen: Sequence[Model], folder: Path, *, arm: bool = False) -> None:
    """Build FMUs that need no Python and print the progress.

    An FMU is the libraries and its data. A clone builds the libraries if they are not there.
    """
    begin = time.monotonic()

    def say(what: str) -> None:
        print(f"  {time.monotonic() - begin:3.0f} s  {what}", flush=True)

    def build(model: Model) -> None:
        def say_of_it(what: str) -> None:
            say(f"{model.table.name}: {what}")

        for path in native.build(model, folder, say_of_it, arm=arm):
            say_of_it(_size(path))

    print("Native, for hosts without Python:")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(build, chosen))


def build_system(folder: Path) -> None:
    """Build the coupled wheelset from the FMUs in a folder, or print why this is not possible."""
    if obstacle := ssp.obstacle(folder):
        print(f"{ssp.NAME}, a system of these: not made, {obstacle}")
    else:
        made = ssp.build(folder, ssp.wheelset_on_rails(WheelsetParameters()))
        print(f"{ssp.NAME}, a system of these: {_size(made)}")


def _size(path: Path) -> str:
    return f"{path} ({path.stat().st_size / 1024:.0f} kB)"


if __name__ == "__main__":
    main()
