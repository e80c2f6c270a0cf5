"""A vehicle whose eight contacts are FMUs `WheelRailPair`, against the same vehicle in one kernel.

    python build_fmu.py --packaging native
    python -m examples.coupled_vehicle.coupled dist/native/WheelRailPair.fmu

The Manchester benchmark vehicle runs into a curve of 300 m at 15 m/s, with all four irregularities.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.wheelset import Pair
from contact.pair import WheelRailPair
from contact_models.vehicle.coupling import Contact, OpenVehicle
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import SIDES, read
from contact_models.vehicle.kernels.layout import Axis
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from contact_models.wheelset.contacts import InPython
from contact_models.wheelset.fmu import InFmu

SPEED = 15.0  # [m/s]
FRICTION = 0.3
FAST = ContactOptions(normal="analyn", tangential="fastrip", pace=1)
STEP = 2e-4  # [s]
PARALLEL, PARALLEL_SECONDS = (1e-4, 5e-5, 2.5e-5, 1.25e-5), 0.2  # steps [s] of the parallel scheme, and its time [s]
EVERY = 10  # steps between two samples
_ROUGH = Irregularities(spectrum="ERRI B176 low")
CURVE = Curve(start=5.0, radius=300.0, length=100.0, transition=20.0, cant=0.08)
TRACK = Track(curves=(CURVE,), alignment=_ROUGH, vertical=_ROUGH, cross_level=_ROUGH, gauge=_ROUGH)


def vehicle(options: ContactOptions) -> Simulation:
    """Return the vehicle at the start of the track."""
    rows = lay(TRACK, 100.0, lambda s: SPEED, (3,), 5.0)
    return Simulation(read("manchester"), rows, profile.s1002(), profile.rail_60e1(), FRICTION, options, start=-12.0)


def in_one_kernel(options: ContactOptions, h: float, samples: int) -> Array:
    """Return lateral positions of the wheelsets [m] and Y of all wheels [N] over the run."""
    whole = vehicle(options)
    rows = []
    for _ in range(samples):
        whole.advance(h, EVERY)
        rows.append(_row(whole))
    return np.array(rows)


def coupled(
    contacts: Sequence[Contact], options: ContactOptions, h: float, samples: int, parallel: bool = False
) -> Array:
    """Return the same from the vehicle without contacts and `contacts`."""
    whole = vehicle(options)
    opened = OpenVehicle(whole)
    rows = []
    for _ in range(samples):
        opened.run(contacts, h, EVERY, parallel=parallel)
        rows.append(_row(whole))
    return np.array(rows)


def _row(whole: Simulation) -> Array:
    return np.concatenate((whole.state.q[whole.model.wheelsets, Axis.Y], whole.wheels["lateral"]))


def python_contacts(options: ContactOptions) -> list[Contact]:
    """Return the contacts of all wheels as Python objects."""
    v = read("manchester")
    made: list[Contact] = []
    for side in SIDES * len(v.wheelsets):
        pair = Pair(profile.s1002(), profile.rail_60e1(), side=side, **v.sizes)
        made.append(
            InPython(
                WheelRailPair(
                    pair, normal=options.normal, tangential=options.tangential, n_strips=options.n_strips,
                    n_elements=options.n_elements,
                )
            )
        )  # fmt: skip
    return made


def fmu_contacts(stack: ExitStack, fmu: Path, options: ContactOptions, *, exchange: bool = False) -> list[Contact]:
    """Return the contacts of all wheels as FMUs, which `stack` frees."""
    v = read("manchester")
    start: dict[str, float | str] = {
        "wheel.radius": v.radius, "track.gauge": v.gauge, "track.gauge_point": v.gauge_point,
        "wheel.flange_back": v.flange_back, "friction.coefficient": FRICTION,
        "resolution.n_strips": options.n_strips, "resolution.n_elements": options.n_elements,
        "method.normal": options.normal, "method.tangential": options.tangential,
    }  # fmt: skip
    return [stack.enter_context(InFmu(fmu, side, start, exchange=exchange)) for side in SIDES * len(v.wheelsets)]


def difference(one: Array, other: Array) -> tuple[float, float]:
    """Return the largest differences of the lateral positions [m] and of Y [N]."""
    axles = one.shape[1] // 3
    apart = np.abs(one - other)
    return float(apart[:, :axles].max()), float(apart[:, axles:].max())


def main() -> None:
    """Print the table of docs/use/own_vehicle.md."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fmu", type=Path)
    parser.add_argument("--seconds", type=float, default=2.0)
    arguments = parser.parse_args()
    for options in (ContactOptions(pace=1), FAST):
        samples = round(arguments.seconds / (EVERY * STEP))
        whole = in_one_kernel(options, STEP, samples)
        with ExitStack() as stack:
            places = {
                "Python objects": python_contacts(options),
                "FMUs, model exchange": fmu_contacts(stack, arguments.fmu, options, exchange=True),
                "FMUs, co-simulation": fmu_contacts(stack, arguments.fmu, options),
            }
            for name, contacts in places.items():
                found = coupled(contacts, options, STEP, samples)
                y, force = difference(whole, found)
                row = f"| {options.normal} + {options.tangential} | {name} | {1e6 * y:.3g} | {force:.3g} |"
                print(row, flush=True)
    for h in PARALLEL:
        samples = round(PARALLEL_SECONDS / (EVERY * h))
        whole = in_one_kernel(FAST, h, samples)
        y, force = difference(whole, coupled(python_contacts(FAST), FAST, h, samples, parallel=True))
        print(f"| {1e3 * h:g} | {1e6 * y:.3g} | {force:.3g} |", flush=True)


if __name__ == "__main__":
    main()
