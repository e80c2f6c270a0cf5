"""Time of the contacts of a wheelset in a vehicle run, step by step, by a C host: docs/check/real_time.md and its picture.

python -m benchmarks.real_time [--steps 1000000] [--real 60000] [--write docs]
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import contact
from benchmarks.tables import read_options, table
from contact.arrays import Array
from contact.geometry import profile
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.simulation import ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track

SOURCE = Path(__file__).parents[1] / "examples" / "c" / "real_time.c"
SPEED, STEP, FRICTION = 20.0, 1e-3, 0.3
PAGE = """# Real time

Written by `python -m benchmarks.real_time --write docs`. The first wheelset of the Manchester vehicle runs {length:g} m at
{speed:g} m/s, from straight track through a transition into a curve of 300 m, with irregularities in all channels. Its motion
is recorded every millisecond, {recorded} steps. A host in C, `examples/c/real_time.c`, replays it: both wheels at every step,
each solution starting from the last one. The machine had two cores, and the load was {crowd:.0f}; times are
those of the processor, except where the clock is named.

## As fast as possible

{steps} steps as fast as possible, {turns} turns through the motion, with the default methods.

{quantiles}
![Histogram of the time of a step](proof/real_time.png)

## What makes the largest

The least time of a step over all turns is that of the algorithm; what a turn takes more is the machine's.

* Algorithm: median / 99.9 % / largest {own} µs.
* Machine: the largest of all steps took {worst:.0f} µs, {excess:.0f} µs more than the least time of the same step.
* The slowest 0.1 % by the algorithm begin at {from:.0f} m. In {slipping:.0f} % of them both wheels slip as a whole (in all
  steps: {all_slipping:.0f} %).
* The second hump of the histogram is iterations of the pressure: {shares}.

{patches}
## max_iterations as a cap

The error is the largest difference of a force component from that with 1000 iterations, over friction times the mean load.
"Not converged" is what the code of the answer tells the host. Times are the least of two turns. Methods without iterations
are there for their times.

{caps}
## 1 kHz

{real} steps at 1 kHz on one core, with the priority of a real-time process (`SCHED_FIFO`: {place}) and memory that is not
swapped. A step is a miss if it ends after the next one should have begun. "Stolen" is the time that
the host of this virtual machine gave to others; the processor's clock counts it as work.

{timed}
## In a host of your own

* The algorithm needs more than 1 ms in {over} of {recorded} steps, and this shared virtual machine does not always give it the
  rest. Take a machine of your own, and a core for the process.
* A cap bounds the iterations. What it costs in accuracy stands above; read the code of every answer.
* `wr_pair_solve` allocates no memory, takes no lock and calls nothing of the system.
"""


def motions(length: float) -> NDArray[np.void]:
    """Return the motion of the first wheelset of the Manchester vehicle, both wheels at every millisecond."""
    rough = Irregularities(spectrum="ERRI B176 low")
    curve = Curve(start=80.0, radius=300.0, length=length, transition=50.0, cant=0.1)
    track = Track(curves=(curve,), alignment=rough, vertical=rough, cross_level=rough, gauge=rough)
    rows = lay(track, length, lambda s: SPEED, (1,), 20.0)
    run = Simulation(
        read("manchester"), rows, profile.s1002(), profile.rail_60e1(), FRICTION, ContactOptions(), threads=2
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
        library, self.folder = Path(shutil.copy(contact.get_library(), folder)), folder
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
        strips: int = 20,
    ) -> Replay:
        """Return the answers and times of a number of steps, `period` [µs] apart or as fast as possible."""
        words: list[object] = [self.program, "motion", "wheel", "rail", "answers", "times"]
        words += [steps, period, cap, normal, tangential, strips]
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


SETTINGS: dict[str, dict[str, object]] = {
    **{f"cap {cap}": {"cap": cap} for cap in (4, 6, 10, 16, 25, 40)},
    "10 × 10, cap 40": {"strips": 10},
    "`analyn` + `fastrip`": {"normal": "analyn", "tangential": "fastrip"},
    "`kik_piotrowski` + `fastsim`": {"normal": "kik_piotrowski", "tangential": "fastsim"},
    "`hertz` + `polach`": {"normal": "hertz", "tangential": "polach"},
}
#: Those that run at 1 kHz.
TIMED = ("cap 40", "10 × 10, cap 40", "`analyn` + `fastrip`")


def caps(host: Host) -> tuple[str, str]:
    """Return a table of what each cap, and each cheaper method, costs and loses, and the shares of slow steps."""
    exact = host.replay(host.recorded, cap=1000).answers
    load, rows = float(np.abs(exact[:, :, 2]).mean()), []
    slow = {}
    for name, settings in SETTINGS.items():
        found = [host.replay(host.recorded, **settings) for _ in range(2)]
        off = np.abs(found[0].answers[:, :, :3] - exact[:, :, :3]).max(axis=2).ravel() / (FRICTION * load)
        unsure = int((found[0].answers[:, :, 4] == contact.Status.NOT_CONVERGED).sum())
        least = np.minimum.reduce([each.processor for each in found])[1:]
        slow[name] = 100.0 * float((least > 350.0).mean())
        errors = [f"{e:.2g}" for e in three(off)] if name.startswith("cap") else ["", "", ""]
        rows.append([name, *(f"{t:.0f}" for t in three(least)), str(unsure), *errors])
        print(" | ".join(rows[-1]), flush=True)
    head = ["setting", "median [µs]", "99.9 %", "largest", "not converged", "error, median", "99.9 %", "largest"]
    shares = f"{slow['cap 40']:.1f} % of the steps take more than 350 µs; with a cap of 6 iterations {slow['cap 6']:.1f} % do"
    return table(head, rows), shares


def stolen() -> float:
    """Return the time [s] that the machine's own host has taken from its processors so far; the processor's clock counts it."""
    return int(Path("/proc/stat").read_text(encoding="ascii").split("\n")[0].split()[8]) / os.sysconf("SC_CLK_TCK")


def in_time(host: Host, steps: int) -> tuple[str, str]:
    """Return a table of runs at 1 kHz, and whether the first place was granted."""
    rows, place = [], ""
    for name in TIMED:
        before = stolen()
        found = host.replay(steps, 1000, **SETTINGS[name])
        taken = 1e3 * (stolen() - before)
        place = found.text.split()[-1]
        late = int((found.processor > 1000.0).sum())
        over = [f"{t:.0f}" for t in three(found.clock)]
        rows.append([name, found.text.split()[0], *over, f"{found.processor.max():.0f}", str(late), f"{taken:.0f}"])
        print(" | ".join(rows[-1]), flush=True)
    head = [
        "setting",
        "misses",
        "clock, median [µs]",
        "99.9 %",
        "largest",
        "processor, largest",
        "steps above 1000 µs",
        "stolen [ms]",
    ]
    return table(head, rows), place


def free_run(host: Host, steps: int) -> tuple[dict[str, object], Array, Array]:
    """Return the numbers of a run as fast as possible, the time of all steps and the least of each recorded one."""
    found = host.replay(steps)
    turns = steps // host.recorded
    by_turn = found.processor[: turns * host.recorded].reshape(turns, host.recorded)[:, 1:]
    least, worst = by_turn.min(axis=0), np.unravel_index(int(by_turn.argmax()), by_turn.shape)
    names = ("median", "99.9 %", "largest")
    rows = [
        [n, f"{a:.0f}", f"{b:.0f}"] for n, a, b in zip(names, three(found.processor), three(found.clock), strict=True)
    ]
    slow = least > np.quantile(least, 0.999)
    answers = found.answers[1:]
    numbers = {
        "turns": turns,
        "quantiles": table(["both wheels", "processor [µs]", "clock [µs]"], rows),
        "own": " / ".join(f"{t:.0f}" for t in three(least)),
        "worst": by_turn[worst],
        "excess": by_turn[worst] - least[worst[1]],
        "patches": by_patches(least, answers),
        "over": int((least > 1000.0).sum()),
        "slipping": 100.0 * float((answers[slow, :, 4] == contact.Status.SATURATED).all(axis=1).mean()),
        "all_slipping": 100.0 * float((answers[:, :, 4] == contact.Status.SATURATED).all(axis=1).mean()),
        "from": SPEED * STEP * float(np.flatnonzero(slow).min()),
    }
    return numbers, found.processor, least


def main(arguments: Sequence[str] | None = None) -> None:
    """Print what was found, and write page and picture."""
    given = read_options(__doc__, arguments, length=400.0, steps=1_000_000, real=60_000, write=Path)
    with TemporaryDirectory() as name:
        host = Host(Path(name), motions(given.length))
        numbers, steps, least = free_run(host, given.steps)
        rows, shares = caps(host)
        timed, place = in_time(host, given.real)
    text = PAGE.format(
        length=given.length, speed=SPEED, recorded=host.recorded, crowd=os.getloadavg()[2], steps=given.steps,
        caps=rows, shares=shares, real=given.real, place=place, timed=timed, **numbers,
    )  # fmt: skip
    print(text)
    if given.write:
        draw(given.write / "check" / "proof" / "real_time.png", steps, least)
        (given.write / "check" / "real_time.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
