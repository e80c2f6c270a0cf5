"""Time of the contacts of a wheelset in a vehicle run, step by step, by a C host: docs/real_time.md and its picture.

python -m benchmarks.real_time [--steps 1000000] [--real 60000] [--write docs]
"""

from __future__ import annotations

import argparse
import os
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import contact
from benchmarks.tables import table
from contact.geometry import profile
from models.life.spectra import Irregularities
from models.life.track import Curve, Track
from models.vehicle.course import lay
from models.vehicle.declared import read
from models.vehicle.simulation import ContactOptions, Simulation

Array = NDArray[np.float64]
SOURCE = Path(__file__).parents[1] / "examples" / "c" / "real_time.c"
SPEED, STEP, FRICTION = 20.0, 1e-3, 0.3
CAPS = (4, 6, 10, 16, 25, 40)
CHEAP = (("analyn", "fastrip"), ("kik_piotrowski", "fastsim"), ("hertz", "polach"))

PAGE = """# Real time

Written by `python -m benchmarks.real_time --write docs`. The first wheelset of the Manchester vehicle runs {length:g} m at
{speed:g} m/s, from straight track through a transition into a curve of 300 m, with irregularities in all channels. Its motion
is recorded every millisecond, {recorded} steps. A host in C, [`examples/c/real_time.c`](https://github.com/), replays it: both
wheels at every step, the default methods, each solution starting from the last one. The machine had two cores and was shared
with other work ({crowd:.0f} processes waited for them). Therefore times are those of the processor, except where the clock is named.

## A million steps

{steps} steps as fast as possible, {turns:.0f} turns through the motion.

| both wheels | processor [µs] | clock [µs] |
| --- | --- | --- |
{quantiles}

![Histogram of the time of a step](pictures/real_time.png)

## What makes the largest

The least time of a step over all turns is that of the algorithm. What a turn takes more is the machine's: interrupts,
and caches that other processes have emptied. The first step of a turn is not counted; it starts from the motion's other end.

* Algorithm: median {own_median:.0f} µs, 99.9 % {own_high:.0f} µs, largest {own_largest:.0f} µs.
* Machine: the largest of all steps took {worst:.0f} µs, {excess:.0f} µs more than the least time of the same step.

{patches}
## max_iterations as a cap

The error is the largest difference of a force component from that with {most} iterations, over friction times the mean load,
in all steps and both wheels. "Not converged" is what the host is told by the code of the answer.

{caps}
{verdict}

## 1 kHz

{real} steps at 1 kHz on one core, with the priority of a real-time process (`SCHED_FIFO`, {place}) and memory that is not swapped:
**{misses} misses**. The clock says: median {real_median:.0f} µs, 99.9 % {real_high:.0f} µs, largest {real_largest:.0f} µs of 1000.
{plain}

## In a host of your own

* Ask for the largest time on your machine with this host before you choose a step.
* Methods without iterations have no tail. If a step must end in a given time, take one of them, or cap the iterations and
  read the code of every answer.
* The library allocates no memory, takes no lock and calls no system function in `wr_pair_solve`.
"""


def motions(length: float) -> NDArray[np.void]:
    """Return the motion of the first wheelset of the Manchester vehicle, both wheels at every millisecond."""
    rough = Irregularities(spectrum="ERRI B176 low")
    curve = Curve(start=80.0, radius=300.0, length=length, transition=50.0, cant=0.1)
    track = Track(curves=(curve,), alignment=rough, vertical=rough, cross_level=rough, gauge=rough)
    rows = lay(track, length, lambda s: SPEED, (1,), 20.0)
    run = Simulation(
        read("manchester"), rows, profile.s1002(), profile.rail_60e1(), FRICTION, ContactOptions(pace=4), threads=2
    )
    found = []
    while run.distance < length:
        run.advance(0.25 * STEP, 4)
        found.append(run.scratch.given[:2].copy())
    return np.concatenate(found)


@dataclass
class Replay:
    """What the host answered."""

    text: str
    answers: Array  # Fx, Fy, Fz [N], patches, code of the right and left wheel at each recorded step; shape (n, 2, 5)
    clock: Array  # [µs] of every step
    processor: Array


class Host:
    """The C host, compiled, with its files in a folder."""

    def __init__(self, folder: Path, moved: NDArray[np.void]) -> None:
        library, self.folder = contact.get_library(), folder
        self.program, self.recorded = folder / "real_time", moved.size // 2
        command = ["gcc", "-O2", "-Wall", "-Wextra", "-Werror", SOURCE, f"-I{contact.get_include()}", library]
        command += ["-lm", "-o", self.program, f"-Wl,-rpath,{library.parent}"]
        subprocess.run([str(word) for word in command], check=True)
        moved.tofile(folder / "motion")
        for kind, shape in (("wheel", profile.s1002()), ("rail", profile.rail_60e1(inclination=1 / 40))):
            np.stack((shape.y, shape.z, shape.angle)).tofile(folder / kind)

    def replay(
        self,
        steps: int,
        period: int = 0,
        cap: int = 40,
        normal: str = "strip_halfspace",
        tangential: str = "fastrip_mapped",
    ) -> Replay:
        """Return the answers and times of a number of steps, `period` [µs] apart or as fast as possible."""
        words = [self.program, "motion", "wheel", "rail", "answers", "times", steps, period, cap, normal, tangential]
        done = subprocess.run([str(w) for w in words], cwd=self.folder, capture_output=True, text=True, check=True)
        times = 1e-3 * np.fromfile(self.folder / "times", dtype=np.int64).reshape(-1, 2)
        answers = np.fromfile(self.folder / "answers").reshape(-1, 2, 5)
        return Replay(done.stdout.strip(), answers, times[:, 0], times[:, 1])


def three(values: Array) -> tuple[float, float, float]:
    """Return median, 99.9 % and the largest."""
    return float(np.median(values)), float(np.quantile(values, 0.999)), float(values.max())


def by_patches(least: Array, answers: Array) -> str:
    """Return a table of the algorithm's time over the number of patches on both wheels."""
    count, rows = answers[:, :, 3].sum(axis=1).astype(int), []
    for n in np.unique(count):
        of = least[count == n]
        rows.append([str(n), str(of.size), *(f"{t:.0f}" for t in three(of))])
    return table(["patches of both wheels", "steps", "median [µs]", "99.9 %", "largest"], rows)


def draw(path: Path, steps: Array, least: Array) -> None:
    """Draw the histogram of all steps, and of the least time of each recorded step."""
    figure, axes = plt.subplots(figsize=(8.0, 3.6), layout="constrained")
    edges = np.geomspace(0.9 * least.min(), 1.1 * steps.max(), 120)
    for values, label in ((steps, "all steps"), (least, "least of all turns: the algorithm")):
        axes.hist(values, edges, weights=np.full(values.size, 1.0 / values.size), histtype="step", label=label)
    axes.axvline(1000.0, color="0.5", linestyle=":", label="1 kHz")
    axes.set(xscale="log", yscale="log", xlabel="processor time of a step, both wheels [µs]", ylabel="share of steps")
    axes.legend()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def cap_rows(host: Host, exact: Replay) -> list[list[str]]:
    """Return what each cap, and each cheaper method, costs and loses."""
    load, rows = float(np.abs(exact.answers[:, :, 2]).mean()), []
    settings = [("strip_halfspace", "fastrip_mapped", cap) for cap in CAPS] + [(*names, 40) for names in CHEAP]
    for normal, tangential, cap in settings:
        found = [host.replay(host.recorded, 0, cap, normal, tangential) for _ in range(3)]
        off = np.abs(found[0].answers[:, :, :3] - exact.answers[:, :, :3]).max(axis=2).ravel() / (FRICTION * load)
        unsure = int((found[0].answers[:, :, 4] == contact.Status.NOT_CONVERGED).sum())
        least = np.minimum.reduce([each.processor for each in found])[1:]
        name = f"cap {cap}" if normal == "strip_halfspace" else f"`{normal}` + `{tangential}`"
        rows.append([name, *(f"{t:.0f}" for t in three(least)), str(unsure), *(f"{e:.2g}" for e in three(off))])
        print(" | ".join(rows[-1]), flush=True)
    return rows


def main(arguments: Sequence[str] | None = None) -> None:
    """Print what was found, or write page and picture."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--length", type=float, default=400.0, help="of the run [m]")
    parser.add_argument("--steps", type=int, default=1_000_000, help="replayed as fast as possible")
    parser.add_argument("--real", type=int, default=60_000, help="steps at 1 kHz")
    parser.add_argument("--write", type=Path, help="folder of the page")
    given = parser.parse_args(arguments)
    with TemporaryDirectory() as name:
        host = Host(Path(name), motions(given.length))
        crowd = os.getloadavg()[0]
        exact = host.replay(host.recorded, 0, 1000)
        rows = cap_rows(host, exact)
        free = host.replay(given.steps)
        urgent = host.replay(given.real, 1000)
    turns = given.steps // host.recorded
    by_turn = free.processor[: turns * host.recorded].reshape(turns, host.recorded)
    least = by_turn.min(axis=0)[1:]
    worst = int(by_turn[:, 1:].argmax())
    largest = by_turn[:, 1:].ravel()[worst]
    quantiles = "\n".join(
        f"| {name} | {a:.0f} | {b:.0f} |"
        for name, a, b in zip(("median", "99.9 %", "largest"), three(free.processor), three(free.clock), strict=True)
    )
    own, real = three(least), three(urgent.clock)
    misses = int(urgent.text.split()[0])
    late = int((urgent.processor > 1000.0).sum())
    text = PAGE.format(
        length=given.length, speed=SPEED, recorded=host.recorded, crowd=crowd, steps=given.steps, turns=turns,
        quantiles=quantiles, own_median=own[0], own_high=own[1], own_largest=own[2], worst=largest,
        excess=largest - least[worst % least.size], patches=by_patches(least, exact.answers[1:]), most=1000,
        caps=table(
            ["setting", "median [µs]", "99.9 %", "largest", "not converged", "error, median", "99.9 %", "largest"], rows
        ),
        verdict="", real=given.real, place=urgent.text.split()[-1], misses=misses, real_median=real[0],
        real_high=real[1], real_largest=real[2], plain=f"In {late} steps the processor worked longer than 1 ms.",
    )  # fmt: skip
    print(text)
    if given.write:
        draw(given.write / "pictures" / "real_time.png", free.processor, least)
        (given.write / "real_time.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
