"""Convergence of the damage of a run: dissipated energy and worn volume over step, pace and spacing of the samples.

    python -m benchmarks.damage_steps

A wheelset at 20 m/s over irregular track through a curve of 500 m (docs/understand/vehicle.md, "Damage").
"""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from benchmarks.tables import table
from models.life.scenario import Declaration, Methods, Profiles, Recording, Scenario
from models.life.spectra import Irregularities
from models.life.track import Curve, Track
from models.vehicle.declared import read
from models.vehicle.run import VehicleRun

CURVE = Curve(start=30.0, radius=500.0, length=120.0, transition=40.0, cant=0.05)
DECLARED = Declaration(
    name="wheelset, curve of 500 m",
    length=260.0,
    speed=20.0,
    seed=5,
    vehicle="wheelset",
    track=Track(curves=(CURVE,), alignment=Irregularities(spectrum="ERRI B176 high")),
)
#: Step [ms], pace, and spacing of the samples [m].
CASES = (
    (0.5, 4, 0.25),
    (0.5, 4, 0.022),
    (0.5, 1, 0.25),
    (0.2, 4, 0.25),
    (0.1, 4, 0.25),
    (0.1, 1, 0.25),
    (0.05, 4, 0.25),
)


def row(step: float, pace: int, spacing: float) -> list[str]:
    """Return a row of the table."""
    recording = Recording(spacing=spacing, step=1e-3 * step)
    declared = replace(DECLARED, recording=recording, methods=Methods(pace=pace))
    run = VehicleRun(Scenario(declared, *Profiles().load(Path()), read(declared.vehicle)))
    begin = time.perf_counter()
    while not run.done:
        run.advance()
    spent = time.perf_counter() - begin
    volume = sum(histogram.volume for histogram in run.damage().values())
    numbers = f"{run.energy:.1f}", f"{1e9 * volume:.3f}", f"{100.0 * run.trust.residual:+.2f}", f"{spent:.1f}"
    return [f"{step:g}", str(pace), f"{spacing:g}", *numbers]


if __name__ == "__main__":
    headings = ["step, ms", "pace", "spacing, m", "energy, J", "worn volume, mm³", "residual, %", "time, s"]
    print(table(headings, [row(*case) for case in CASES]), end="")
