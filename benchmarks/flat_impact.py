"""Impacts of a flat in a vehicle: peak force, energy and its residual over the speed (docs/understand/vehicle.md).

python -m benchmarks.flat_impact --lengths 0.04 0.05 --speeds 3 10 20
python -m benchmarks.flat_impact --vehicle manchester --speeds 20 --steps 1e-4 5e-5
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from benchmarks.tables import read_options
from contact.geometry import profile
from contact.geometry.surfaces import Flat, WheelSurface
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.track import Track

#: Turns of the wheel before the flat comes, and those after which the run ends; the flat is at the bottom at .5.
_BEFORE, _END = 0.4, 0.75
METHODS = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12)


class Impact(NamedTuple):
    """One passage of a flat."""

    largest: float  # normal force of the right wheel of the first wheelset [N]
    least: float
    stored: float  # most energy in the contacts of all wheels, 2/5 load times approach [J]
    residual: float  # greatest of the balance, of either sign [J]


def impact(vehicle: str, length: float, speed: float, h: float, options: ContactOptions = METHODS) -> Impact:
    """Return what a flat of a `length` [m] on both wheels of the first wheelset does at a `speed` [m/s], step `h` [s].

    The rails are those of the Manchester vehicle: a mass on springs under each wheel.
    """
    declared = replace(read(vehicle), rail=read("manchester").rail)
    wheel = profile.s1002()
    surface = WheelSurface.constant(wheel, Flat(length, declared.radius, angle=math.pi))
    rows = lay(Track(), 10.0, lambda s: speed, (1,), 0.0)
    run = Simulation(declared, rows, wheel, profile.rail_60e1(), 0.3, options, uneven={0: surface, 1: surface})
    turn = 2.0 * math.pi * declared.radius / (speed * h)  # [steps]
    run.advance(h, round(_BEFORE * turn))
    seen = []
    for _ in range(round((_END - _BEFORE) * turn)):
        run.advance(h)
        seen.append((run.wheels["normal"][0], run.wheels["elastic"].sum(), run.state.books[Book.RESIDUAL]))
    normal, stored, residual = np.array(seen).T
    return Impact(normal.max(), normal.min(), stored.max(), np.abs(residual).max())


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a table."""
    given = read_options(__doc__, arguments, vehicle="wheelset", lengths=[0.05], speeds=[20.0], steps=[1e-4])
    print("flat, mm | speed, m/s | step, ms | largest and least normal force, kN | stored, J | residual, J")
    for length in given.lengths:
        for speed in given.speeds:
            for h in given.steps:
                found = impact(given.vehicle, length, speed, h)
                print(
                    f"{1e3 * length:g} | {speed:g} | {1e3 * h:g} | {1e-3 * found.largest:.1f} {1e-3 * found.least:.1f} | "
                    f"{found.stored:.1f} | {found.residual:.2f}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
