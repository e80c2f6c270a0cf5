"""A run as a small table and pictures for notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact.view.notebook import Sketch, beside, table
from ..vehicle.declared import SIDES

if TYPE_CHECKING:
    from .run import VehicleRun


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
        lines = [1e-3 * series[f"{first}_{side}_{name}"] for side in SIDES]
        if s.size > 1:
            ends = min(line.min() for line in lines), max(line.max() for line in lines)
            drawn = Sketch((s[0], s[-1]), ends, ("distance [m]", label), f"{label}, both wheels")
            for line in lines:
                drawn.curve(s, line)
            pictures.append(drawn.svg())
    return beside(table((), rows, declared.name), *pictures)
