"""A vehicle over the made-up crossing: forces, energy and its residual over the speed (docs/understand/vehicle.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from contact.arrays import Array
from contact.geometry import profile
from contact.plot import time_histories
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import Book
from contact_models.vehicle.sections import RailSection
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.track import Track
from examples.crossing import turnout

#: Distance of the first wheelset before the slices begin, and after they end [m].
_BEFORE, _AFTER = 0.5, 1.5
METHODS = ContactOptions(normal="analyn", tangential="fastrip", n_strips=20, n_elements=12)


class Crossed(NamedTuple):
    """One run over the crossing, at every step."""

    place: Array  # of the first wheelset on the slices [m]
    right: Array  # vertical force of its right wheel, which runs over the crossing [N]
    left: Array  # of its left wheel [N]
    patches: Array  # of the right wheel
    stored: Array  # in all contacts [J]
    heights: Array  # mean of the first wheelset, downwards [m]
    residual: Array  # of the balance of energy of the vehicle [J]

    def fall(self, load: float) -> float:
        """Return the potential energy [J] that the first wheelset's `load` [N] gives away and takes back."""
        return load * float(np.ptp(self.heights))


def crossed(vehicle: str, speed: float, h: float, options: ContactOptions = METHODS) -> Crossed:
    """Return a run of a vehicle over the crossing on the right rail at a `speed` [m/s] with a step `h` [s].

    The rails are those of the Manchester vehicle: a mass on springs under each wheel.
    """
    declared = replace(read(vehicle), rail=read("manchester").rail)
    rows = lay(Track(), 40.0, lambda s: speed, (1,), 0.0)
    first = max(axle.at for axle in declared.wheelsets)
    section = RailSection(surface=turnout.surface(), side="right", at=first + _BEFORE)
    run = Simulation(declared, rows, profile.s1002(), profile.rail_60e1(), 0.3, options, sections=[section])
    place = run.model.bodies["place"]
    leading = run.model.wheelsets[0]
    last = run.model.wheelsets[-1]
    seen = []
    while run.distance + place[last] < section.end + _AFTER:
        run.advance(h)
        w, books = run.wheels, run.state.books
        seen.append(
            (run.distance + place[leading] - section.at, *w["vertical"][:2], w["patches"][0], w["elastic"].sum(),
             run.state.q[leading, 2], books[Book.RESIDUAL])
        )  # fmt: skip
    return Crossed(*np.array(seen).T)


def draw(runs: Mapping[float, Crossed]) -> Figure:
    """Return the forces of both wheels over the distance, a line for each speed [m/s]."""
    inside = {speed: (run.place > -0.2) & (run.place < 4.0) for speed, run in runs.items()}
    axis = np.linspace(-0.2, 3.5, 2000)

    def lines(name: str) -> dict[str, Array]:
        return {
            f"{speed:g} m/s": 1e-3 * np.interp(axis, run.place[inside[speed]], getattr(run, name)[inside[speed]])
            for speed, run in runs.items()
        }

    panels = {"right Q [kN]": lines("right"), "left Q [kN]": lines("left")}
    return time_histories(axis, panels, xlabel="place of the axle on the slices [m]")
