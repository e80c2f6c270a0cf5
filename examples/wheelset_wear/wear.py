"""Wear of S1002 wheels and 60E1 rails in runs of a wheelset: run, accumulate, merge, save, draw (readme.md)."""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass, field
from functools import reduce
from operator import add
from pathlib import Path

import numpy as np

import contact
from contact import plot
from contact.accumulation import Histogram, save, worn_profile
from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact_models.vehicle.coupling import OpenVehicle
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.layout import TrackRow
from contact_models.vehicle.simulation import Simulation
from contact_models.vehicle.track import Track

SPEED = 20.0  # [m/s], below the critical speed
AMPLITUDES = (1e-3, 2e-3, 3e-3)  # [m] amplitude of each wave of the track's centre line
WAVES = (37.0, 23.0, 14.0)  # [m] wavelengths; an artificial line, not a measured spectrum
FRICTION, STEP, EVERY = 0.3, 2e-4, 25  # [-], [s], steps from one sample to the next
SETTLING, MOST_WORN = 1.0, 1e-3  # [s] at the start that do not count, [m] greatest wear depth in the drawing
SMOOTHING = 2e-3  # [m] smoothing width of the wear depth


@dataclass
class Run:
    """Damage of the right wheel and its rail on one track."""

    wheel: Histogram
    rail: Histogram
    solutions: list[contact.Solution] = field(default_factory=list)
    lateral: list[float] = field(default_factory=list)


def track(amplitude: float, length: float) -> Array:
    """Return the rows of straight track whose centre line is a sum of sines."""
    rows = lay(Track(), length, lambda s: SPEED, (0,), 0.0)
    k, s = 2.0 * np.pi / np.array(WAVES)[:, None], rows[TrackRow.PLACE]
    for row in (TrackRow.RIGHT_Y, TrackRow.LEFT_Y):  # followed by their slopes
        rows[row : row + 2] = amplitude * np.sin(k * s).sum(axis=0), amplitude * (k * np.cos(k * s)).sum(axis=0)
    return rows


def run(amplitude: float, seconds: float) -> Run:
    """Run the wheelset on a track with this amplitude. The last `seconds` count."""
    v, wheel, rail = read("wheelset"), profile.s1002(), profile.rail_60e1()
    simulation = Simulation(v, track(amplitude, SPEED * (SETTLING + seconds) + 1.0), wheel, rail, FRICTION)
    opened = OpenVehicle(simulation)
    simulation.advance(STEP, round(SETTLING / STEP))
    result = Run(Histogram(wheel, radius=v.radius), Histogram(rail, radius=v.radius))
    pair = Pair(wheel, rail, **v.sizes)
    for _ in range(round(seconds / (EVERY * STEP))):
        simulation.advance(STEP, EVERY)
        right = opened.ask()[0].tolist()
        pose, velocity, irregularity = Pose(*right[:4]), Velocity(*right[4:10]), Irregularity(*right[10:16])
        patches = pair.contacts(pose, velocity, irregularity=irregularity)
        solutions = [
            contact.solve(
                patch.separation, patch.creepage, approach=patch.approach, friction=FRICTION, speed=SPEED, throw=False
            )
            for patch in patches
        ]
        for histogram in (result.wheel, result.rail):
            histogram.add(patches, solutions, distance=SPEED * EVERY * STEP)
        result.solutions += solutions
        result.lateral.append(pose.y - irregularity.y)
    return result


def draw(runs: dict[str, Run], out: Path) -> None:
    """Draw stacked wear, worn profiles and the shakedown map."""
    out.mkdir(parents=True, exist_ok=True)
    for body in ("wheel", "rail"):
        histograms = {name: getattr(r, body) for name, r in runs.items()}
        plot.wear(histograms, f"wear of the right {body}, tracks of three amplitudes").savefig(out / f"wear_{body}.png")
        total = reduce(add, histograms.values())
        save(total, out / f"{body}.nc")
        times = MOST_WORN / worn_depth(total)
        amount = f"{times * total.distance / 1e6:.3g} thousand km" if body == "wheel" else f"{times:.3g} axle passes"
        plot.worn_profile(
            total.profile,
            worn_profile(total, times, smoothing=SMOOTHING),
            magnified=2.0,
            title=f"right {body} after {amount} of these runs, smoothed over {1e3 * SMOOTHING:g} mm",
        ).savefig(out / f"worn_{body}.png")
    clouds = {name: r.solutions for name, r in runs.items()}
    plot.shakedown(clouds, f"μ = {FRICTION:g}, k = {contact.STEEL.shear_yield * 1e-6:g} MPa").savefig(
        out / "shakedown.png"
    )


def worn_depth(histogram: Histogram) -> float:
    """Return the greatest smoothed wear depth [m]."""
    p, w = histogram.profile, worn_profile(histogram, smoothing=SMOOTHING)
    return float(np.hypot(w.y - p.y, w.z - p.z).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0, help="simulated time of each run that counts")
    parser.add_argument("--out", type=Path, default=Path("out"))
    arguments = parser.parse_args()
    began = time.perf_counter()
    runs = {f"{1e3 * amplitude:g} mm": run(amplitude, arguments.seconds) for amplitude in AMPLITUDES}
    draw(runs, arguments.out)
    print("track   wheel on rail  distance  wheel worn   greatest depth  mean T-gamma  surface fatigue")
    for name, r in runs.items():
        w = r.wheel
        print(
            f"{name:6}  {1e3 * min(r.lateral):5.2f} … {1e3 * max(r.lateral):4.2f} mm  {w.distance:5.1f} m"
            f"  {1e12 * w.volume / w.distance:6.3g} mm³/km  {1e12 * w.per('metre')['wear'].max():6.3g} nm/km"
            f"  {w['T_gamma'].sum() / w.distance:8.3g} N  {100.0 * exceeding(r.solutions):10.1f} %"
        )
    print(f"{time.perf_counter() - began:.1f} s; pictures and histograms in {arguments.out}/")


def exceeding(solutions: list[contact.Solution]) -> float:
    """Return the share of contacts with a positive surface fatigue index."""
    return float(np.mean([s.damage.fatigue_index > 0.0 for s in solutions]))


if __name__ == "__main__":
    main()
