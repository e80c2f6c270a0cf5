"""A vehicle as a small table and a picture for notebooks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from contact.view.notebook import Sketch, beside, table

if TYPE_CHECKING:
    from .simulation import Simulation

_SIDES = ("right", "left")


def of_simulation(vehicle: Simulation) -> str:
    """Return place, time and the forces of every wheel at the last step, with a sketch of the vertical forces."""
    wheels, names = vehicle.wheels, vehicle.names
    seats = [f"{names[i]}, {side}" for i in vehicle.model.wheelsets for side in _SIDES]
    head = "wheel", "Q [kN]", "Y [kN]", "angle [°]", "Tγ [N]", "pressure [MPa]"
    rows = [
        (
            seat,
            *(f"{1e-3 * wheel[name]:.4g}" for name in ("vertical", "lateral")),
            f"{math.degrees(wheel['angle']):.3g}",
            f"{wheel['T_gamma']:.4g}",
            f"{1e-6 * wheel['pmax']:.4g}",
        )
        for seat, wheel in zip(seats, wheels, strict=True)
    ]
    caption = f"{len(names)} bodies, {len(seats)} wheels at {vehicle.distance:.5g} m, {vehicle.time:.4g} s"
    load = 1e-3 * np.array(wheels["vertical"])
    place = np.arange(1.0, load.size + 1.0)
    title = "vertical force of every wheel"
    drawn = Sketch((0.5, load.size + 0.5), (min(0.0, load.min()), load.max()), ("wheel", "Q [kN]"), title)
    drawn.bars(place, np.full(load.size, 0.8), np.minimum(load, 0.0), np.maximum(load, 0.0), np.full(load.size, 0.6))
    return beside(table(head, rows, caption), drawn.svg())
