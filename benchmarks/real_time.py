"""Time of the contacts of a wheelset in a vehicle run, step by step, by a C host (docs/real_time.md).

python -m benchmarks.real_time --steps 500000 --caps 6 10 16 40
"""

from __future__ import annotations

import argparse
import subprocess
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

import contact
from contact.geometry import profile
from models.life.spectra import Irregularities
from models.life.track import Curve, Track
from models.vehicle.course import lay
from models.vehicle.declared import read
from models.vehicle.simulation import ContactOptions, Simulation

_SOURCE = Path(__file__).parents[1] / "examples" / "c" / "real_time.c"
SPEED, STEP = 20.0, 1e-3


def motions(length: float) -> NDArray[np.void]:
    """Return the motion of the first wheelset of the Manchester vehicle, both wheels at every millisecond.

    Straight track, transition and curve of 300 m, with irregularities in all channels.
    """
    rough = Irregularities(spectrum="ERRI B176 low")
    curve = Curve(start=80.0, radius=300.0, length=length, transition=50.0, cant=0.1)
    track = Track(curves=(curve,), alignment=rough, vertical=rough, cross_level=rough, gauge=rough)
    rows = lay(track, length, lambda s: SPEED, (1,), 20.0)
    run = Simulation(
        read("manchester"), rows, profile.s1002(), profile.rail_60e1(), 0.3, ContactOptions(pace=4), threads=2
    )
    found = []
    while run.distance < length:
        run.advance(0.25 * STEP, 4)
        found.append(run.scratch.given[:2].copy())
    return np.concatenate(found)


def built(folder: Path) -> Path:
    """Return the compiled C host."""
    library, made = contact.get_library(), folder / "real_time"
    command = ["gcc", "-O2", "-Wall", "-Wextra", _SOURCE, f"-I{contact.get_include()}", library, "-lm", "-o", made]
    subprocess.run([*map(str, command), f"-Wl,-rpath,{library.parent}"], check=True)
    return made


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--length", type=float, default=400.0, help="of the run [m]")
    parser.add_argument("--steps", type=int, default=500_000, help="of both wheels, replayed as fast as possible")
    parser.add_argument("--real", type=int, default=60_000, help="steps at 1 kHz")
    parser.add_argument("--caps", type=int, nargs="+", default=[4, 6, 10, 16, 40], help="max_iterations")
    given = parser.parse_args(arguments)
    with TemporaryDirectory() as name:
        folder = Path(name)
        host, moved = built(folder), motions(given.length)
        moved.tofile(folder / "motion")
        for kind, shape in (("wheel", profile.s1002()), ("rail", profile.rail_60e1())):
            np.stack((shape.y, shape.z, shape.angle)).tofile(folder / kind)
        print(f"{moved.size // 2} recorded steps", flush=True)

        def told(steps: int, period: int, cap: int) -> tuple[str, NDArray[np.float64]]:
            words = [host, "motion", "wheel", "rail", "forces", steps, period, cap]
            done = subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, check=True)
            return done.stdout.strip(), np.fromfile(folder / "forces").reshape(-1, 3)

        _, exact = told(moved.size // 2, 0, 1000)
        load = float(np.median(np.abs(exact[:, 2])))
        for cap in given.caps:
            text, forces = told(given.steps, 0, cap)
            off = np.sort(np.abs(forces - exact[: len(forces)]).max(axis=1)) / (0.3 * load)
            quantiles = " ".join(f"{off[int(share * (off.size - 1))]:.2g}" for share in (0.5, 0.999, 1.0))
            print(
                f"cap {cap} | {text} | forces off, of friction times load, median, 99.9 %, largest: {quantiles}",
                flush=True,
            )
        print(f"1 kHz, cap {given.caps[-1]} | {told(given.real, 1000, given.caps[-1])[0]}")


if __name__ == "__main__":
    main()
