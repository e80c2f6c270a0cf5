"""Convergence of a run over step, pace and spacing of the samples: energy, T-gamma, worn volume, peaks and residual.

    python -m benchmarks.damage_steps [wheelset | vehicle]

A wheelset at 20 m/s over irregular track through a curve of 500 m with the default methods, and the benchmark vehicle in the
curve of 600 m of the included set of wear (docs/understand/vehicle.md, "Damage"). Wear is that of the scenario's law.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from pathlib import Path

from benchmarks.tables import table
from contact_models.runs import scenario
from contact_models.runs.run import VehicleRun
from contact_models.runs.scenario import Declaration, Methods, Profiles, Recording, Scenario
from contact_models.vehicle.declared import read
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track

CURVE = Curve(start=30.0, radius=500.0, length=120.0, transition=40.0, cant=0.05)
WHEELSET = Declaration(
    name="wheelset, curve of 500 m",
    length=260.0,
    speed=20.0,
    seed=5,
    vehicle="wheelset",
    methods=Methods(),
    track=Track(curves=(CURVE,), alignment=Irregularities(spectrum="ERRI B176 high")),
)
VEHICLE = Path(__file__).parents[1] / "examples" / "scenarios" / "vehicle_wear" / "curve_600.toml"
#: Step [ms], pace, and spacing of the samples [m].
CASES = {
    "wheelset": (
        (0.5, 4, 0.25),
        (0.5, 4, 0.022),
        (0.5, 1, 0.25),
        (0.2, 4, 0.25),
        (0.1, 4, 0.25),
        (0.1, 1, 0.25),
        (0.05, 4, 0.25),
    ),
    "vehicle": (
        (0.46, 4, 0.25),
        (0.46, 4, 0.05),
        (0.46, 1, 0.25),
        (0.23, 4, 0.25),
        (0.23, 1, 0.25),
        (0.115, 4, 0.25),
        (0.0575, 4, 0.25),
    ),
}


def given(which: str) -> Scenario:
    """Return the scenario of the wheelset or of the vehicle."""
    if which == "wheelset":
        return Scenario(WHEELSET, *Profiles().load(Path()), read(WHEELSET.vehicle))
    return scenario.read(VEHICLE).limited(1.5e9)


def row(whole: Scenario, step: float, pace: int, spacing: float) -> list[str]:
    """Return a row of the table."""
    declared = whole.declared
    recording = Recording(spacing=spacing, step=1e-3 * step)
    run = VehicleRun(
        replace(whole, declared=replace(declared, recording=recording, methods=replace(declared.methods, pace=pace)))
    )
    begin = time.process_time()
    while not run.done:
        run.advance()
    spent = time.process_time() - begin
    series, volume = run.series, sum(histogram.volume for histogram in run.damage().values())
    counted = series["distance"] >= recording.settling
    t_gamma = sum(values[counted].mean() for name, values in series.items() if name.endswith("_T_gamma"))
    peaks = {
        what: max(abs(values[counted]).max() for name, values in series.items() if name.endswith(f"_{what}"))
        for what in ("largest_vertical_force", "largest_lateral_force")
    }
    return [
        f"{step:g}",
        str(pace),
        f"{spacing:g}",
        f"{run.energy:.1f}",
        f"{t_gamma:.2f}",
        f"{1e9 * volume:.3f}",
        *(f"{1e-3 * peak:.2f}" for peak in peaks.values()),
        f"{100.0 * run.trust.residual:+.2f}",
        f"{spent:.1f}",
    ]


if __name__ == "__main__":
    headings = ["step, ms", "pace", "spacing, m", "energy, J", "Tγ of all wheels, N", "worn volume, mm³"]
    headings += ["largest Q, kN", "largest Y, kN", "residual, %", "processor time, s"]
    for which in sys.argv[1:] or CASES:
        whole = given(which)
        print(whole.name)
        print(table(headings, [row(whole, *case) for case in CASES[which]]))
