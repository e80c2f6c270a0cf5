"""A vehicle and its run as small tables and pictures for notebooks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from contact.view.notebook import Sketch, beside, table

if TYPE_CHECKING:
    from .run import VehicleRun
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


def of_run(run: VehicleRun) -> str:
    """Return how far a run is and its largest forces, with a sketch of the forces on both wheels of the first axle."""
    declared, series, balance = run.scenario.declared, run.series, run.balance
    first = run.simulation.names[run.simulation.model.wheelsets[0]].replace(" ", "_")
    rows = [("run", f"{run.distance:.5g} of {declared.length:g} m in {run.steps} steps of {1e3 * run.step:.3g} ms")]
    for what, name in (("Q", "largest_vertical_force"), ("Y", "largest_lateral_force")):
        most = [(float(column.max()), key) for key, column in series.items() if key.endswith(name) and column.size]
        if most:
            force, key = max(most)
            rows.append((f"largest {what}", f"{1e-3 * force:.4g} kN, {key.removesuffix(f'_{name}').replace('_', ' ')}"))
    if balance["dissipated"] > 0.0:
        share = balance["residual"] / balance["dissipated"]
        rows.append(("dissipated, residual", f"{balance['dissipated']:.4g} J, {share:+.2%}"))
    s = series["distance"]
    pictures = []
    for label, name in (("Q, first axle [kN]", "vertical_force"), ("Y, first axle [kN]", "lateral_force")):
        lines = [1e-3 * series[f"{first}_{side}_{name}"] for side in _SIDES]
        if s.size > 1:
            ends = min(line.min() for line in lines), max(line.max() for line in lines)
            drawn = Sketch((s[0], s[-1]), ends, ("distance [m]", label), f"{label}, both wheels")
            for line in lines:
                drawn.curve(s, line)
            pictures.append(drawn.svg())
    return beside(table((), rows, declared.name), *pictures)
