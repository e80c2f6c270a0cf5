"""Wear of one section recomputed from its recorded contacts, beside what the run has counted.

    python -m benchmarks.wear_of_section [pace]

The leading axle of the benchmark vehicle in the circle of 600 m of the included set of wear. At every step the contacts are
written down: creep forces, creepages, area, speed. Wear by Sheffield's function of T-gamma/A is computed from these numbers
alone, with constants typed in below, and compared with the histograms of wheel and rail. No code of damage is shared. With a
pace above 1 the contacts are those of the last solution, so the difference shows how a solution counts for the steps around it.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.tables import table
from contact_models.runs import scenario
from contact_models.runs.run import VehicleRun
from contact_models.vehicle.declared import SIDES
from contact_models.vehicle.kernels.layout import Axis

EXAMPLE = Path(__file__).parents[1] / "examples" / "scenarios" / "vehicle_wear" / "curve_600.toml"
BEGIN, LENGTH = 85.0, 145.0  # the circle begins at 80 m [m]
DENSITY = 7850.0  # [kg/m³]


def lost(t_gamma: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Return the volume lost per metre rolled [m³/m]: rates of 5.3 I, 55, 55 + 61.9 (I - 77.2) µg/(m mm²), I in N/mm²."""
    intensity = 1e-6 * t_gamma / area
    rate = np.select([intensity < 10.4, intensity <= 77.2], [5.3 * intensity, 55.0], 55.0 + 61.9 * (intensity - 77.2))
    return rate * 1e-9 / 1e-6 * area / DENSITY


def recorded(run: VehicleRun) -> np.ndarray:
    """Run to the end and return the volume that each wheel of the first axle loses by the recorded contacts [m³]."""
    simulation, h, worn = run.simulation, run.step, np.zeros(2)
    while not run.done:
        counts = run.distance >= run.scenario.declared.recording.settling
        run.advance()
        if not counts:
            continue
        axle = simulation.model.wheelsets[0]
        for side in range(2):
            patches = simulation.wheel_arrays.contacts[side][: int(simulation.wheels[side]["patches"])]
            patches = patches[patches["area"] > 0.0]
            t_gamma = np.abs(patches["Fx"] * patches["longitudinal"]) + np.abs(patches["Fy"] * patches["lateral"])
            rolled = h * float(simulation.state.u[axle, Axis.X])
            worn[side] += rolled * lost(t_gamma, patches["area"]).sum()
    return worn


def rows(pace: int) -> list[list[str]]:
    """Return the rows of the table: one sample a step, so that every step is seen."""
    given = scenario.read(EXAMPLE).limited(1.5e9)
    declared = given.declared
    spacing = 1e-9 + declared.speed * 4.6e-4  # type: ignore[operator]
    recording = replace(declared.recording, settling=BEGIN, spacing=max(spacing, 0.01), step=4.6e-4)
    methods = replace(declared.methods, pace=pace)
    run = VehicleRun(replace(given, declared=replace(declared, length=LENGTH, recording=recording, methods=methods)))
    worn = recorded(run)
    name, found = run.scenario.vehicle.wheelsets[0].name, run.damage()
    told = []
    for k, side in enumerate(SIDES):
        counted = found[name, side, "wheel"].volume
        rail = found[name, side, "rail"].volume
        told.append(
            [
                f"{name}, {side}",
                *(f"{1e9 * v:.4f}" for v in (worn[k], counted, rail)),
                f"{100.0 * (counted / worn[k] - 1.0):+.2f}",
            ]
        )
    return told


if __name__ == "__main__":
    headings = ["wheel", "recomputed, mm³", "counted on the wheel, mm³", "on the rail, mm³", "difference, %"]
    print(table(headings, rows(int(sys.argv[1]) if len(sys.argv) > 1 else 1)), end="")
