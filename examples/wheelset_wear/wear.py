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
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact_models.wheelset import master
from contact_models.wheelset.components import direct
from contact_models.wheelset.parameters import WheelsetParameters
from contact_models.wheelset.ports import MOTION

SPEED = 20.0  # [m/s], below the critical speed
AMPLITUDES = (1e-3, 2e-3, 3e-3)  # [m] amplitude of each wave of the track's centre line
WAVES = (37.0, 23.0, 14.0)  # [m] wavelengths; an artificial line, not a measured spectrum
FRICTION, STEP = 0.3, 5e-3  # [-], [s]; the iterated scheme is stable at this step
SETTLING, MOST_WORN = 1.0, 1e-3  # [s] at the start that do not count, [m] greatest wear depth in the drawing
SMOOTHING = 2e-3  # [m] smoothing width of the wear depth


@dataclass
class Run:
    """Damage of the right wheel and its rail on one track."""

    wheel: Histogram
    rail: Histogram
    solutions: list[contact.Solution] = field(default_factory=list)
    lateral: list[float] = field(default_factory=list)


def centre_line(amplitude: float, t: float) -> tuple[float, float]:
    """Return lateral position [m] and slope [-] of the track below the wheelset at time `t` [s]."""
    k, x = 2.0 * np.pi / np.array(WAVES), SPEED * t
    return float(amplitude * np.sin(k * x).sum()), float(amplitude * (k * np.cos(k * x)).sum())


def run(amplitude: float, seconds: float) -> Run:
    """Run the wheelset on a track with this amplitude. The last `seconds` count."""
    p = WheelsetParameters(speed=SPEED, lateral=0.0)
    wheelset, contacts = direct(p, FRICTION)
    history = master.run(
        wheelset,
        contacts,
        speed=SPEED,
        step=STEP,
        duration=SETTLING + seconds,
        scheme="iterated",
        irregularity=lambda t: centre_line(amplitude, t),
    )
    result = Run(Histogram(p.wheel, radius=p.radius), Histogram(p.rail, radius=p.radius))
    pair = Pair(
        p.wheel, p.rail, nominal_radius=p.radius, gauge=p.gauge, gauge_point=p.gauge_point, flange_back=p.flange_back
    )
    for k in np.flatnonzero(history["time"] >= SETTLING).tolist():
        y, yaw, y_rate, yaw_rate, spin, _, roll = (float(history[name][k]) for name in MOTION)
        line, slope = centre_line(amplitude, float(history["time"][k]))  # pose and velocity are relative to the track
        pose, velocity = (
            Pose(y - line, 0.0, roll, yaw - slope),
            Velocity(SPEED, y_rate - SPEED * slope, yaw=yaw_rate, spin=-spin),
        )
        # vertical load: the normal force of the wheelset's own contact, which has one plane for all lobes
        load = float(history["right.load.normal_force"][k] * np.cos(history["right.contact.angle"][k]))
        patches = pair.contacts(pose, velocity, load=load)
        solutions = [
            contact.solve(
                patch.separation, patch.creepage, load=patch.load, friction=FRICTION, speed=SPEED, throw=False
            )
            for patch in patches
        ]
        for histogram in (result.wheel, result.rail):
            histogram.add(patches, solutions, distance=SPEED * STEP)
        result.solutions += solutions
        result.lateral.append(pose.y)
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
