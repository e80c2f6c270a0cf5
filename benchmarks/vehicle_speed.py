"""Print how fast a vehicle of eight wheels runs, and the share of its contacts (`make bench`).

    python benchmarks/vehicle_speed.py [--seconds 2] [--threads 2] [--fmu dist/native/Vehicle.fmu]

The Manchester benchmark vehicle runs on straight track at 25 m/s and in a curve of 300 m at 15 m/s, with the alignment ERRI
B176 low. With `--fmu` the one kernel and the native FMU run on the track of `examples/scenarios/vehicle_300.toml`. Times are
processor times, so they depend little on other processes, but some: of cores that share caches. Those of several threads are
elapsed times, beside that of one thread measured in turn; they mean something only on cores that are free.
"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

from benchmarks.tables import read_options, table
from contact.geometry import profile
from contact_models.runs import scenario
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.kernels.motion import move, prepare_contacts
from contact_models.vehicle.simulation import PACE, ContactOptions, Simulation
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Track
from contact_models.wheelset.fmu import Fmu

STEP, SHORT = 4.6e-4, 200  # [s], and steps of a piece that is timed
SCENARIO = Path(__file__).parents[1] / "examples" / "scenarios" / "vehicle_300.toml"
ROUGH = Irregularities(spectrum="ERRI B176 low")
CURVE = Curve(start=0.0, radius=300.0, length=1e4, transition=20.0, cant=0.1)
TRACKS = {
    "straight, 25 m/s": (25.0, Track(alignment=ROUGH)),
    "curve of 300 m, 15 m/s": (15.0, Track(curves=(CURVE,), alignment=ROUGH)),
}
METHODS = {
    "default": ContactOptions(),
    "`analyn` + `fastrip`, 30 × 20": ContactOptions(normal="analyn", tangential="fastrip", n_strips=30, n_elements=20),
    "`analyn` + `table`": ContactOptions(normal="analyn", tangential="table"),
}
PACES = (PACE, 1)


def started(speed: float, track: Track, options: ContactOptions, seconds: float, threads: int = 1) -> Simulation:
    """Return a vehicle that has run 50 m, into the curve, with `seconds` to go."""
    rows = lay(track, 60.0 + speed * seconds, lambda s: speed, (1,), 30.0)
    vehicle = Simulation(read("manchester"), rows, profile.s1002(), profile.rail_60e1(), 0.3, options, threads=threads)
    vehicle.advance(STEP, round(50.0 / speed / STEP))
    return vehicle


def shared(threads: int, seconds: float) -> list[list[str]]:
    """Return the rows of one thread and of several: simulated over elapsed time, the best of pieces of `SHORT` steps."""
    rows = []
    for where, (speed, track) in TRACKS.items():
        best: dict[int, float] = {}
        vehicles = {n: started(speed, track, ContactOptions(), seconds, n) for n in (1, threads)}
        for _ in range(round(seconds / STEP / SHORT)):
            for n, vehicle in vehicles.items():
                start = time.perf_counter()
                vehicle.advance(STEP, SHORT)
                best[n] = min(best.get(n, math.inf), time.perf_counter() - start)
        rows += [[where, str(n), f"{SHORT * STEP / took:.2f}"] for n, took in best.items()]
    return rows


def measured(speed: float, track: Track, options: ContactOptions, seconds: float) -> tuple[float, float, float]:
    """Return simulated time over processor time, the share of the contacts in the processor time, and that of the steps at
    which a contact is solved.
    """
    vehicle = started(speed, track, options, seconds)
    steps = round(seconds / STEP)
    before = vehicle.wheel_arrays.last.solutions.copy()
    start = time.process_time()
    vehicle.advance(STEP, steps)
    spent = (time.process_time() - start) / steps
    solved = float((vehicle.wheel_arrays.last.solutions - before).mean()) / steps if options.pace > 1 else 1.0
    arguments = vehicle.model, vehicle.state, vehicle.wheel_arrays.motions, vehicle.scratch
    calls = 500
    prepare_contacts(*arguments, speed)
    move(*arguments, 1e-12, speed)
    start = time.process_time()
    for _ in range(calls):  # all but the contacts, with the calls from Python
        prepare_contacts(*arguments, speed)
        move(*arguments, 1e-12, speed)
    besides = (time.process_time() - start) / calls
    return STEP / spent, 1.0 - besides / spent, solved


def beside_the_fmu(path: Path, seconds: float) -> list[list[str]]:
    """Return the rows of the one kernel and of the native FMU, with the default methods, in a curve of 300 m."""
    given = scenario.read(SCENARIO)
    d, start, warm_up = given.declared, -12.0, round(85.0 / 15.0 / STEP)  # into the circle
    rows = lay(d.track, d.length, given.speed, (d.seed,), d.recording.settling)
    whole = Simulation(read("manchester"), rows, given.wheel, given.rail, d.friction, start=start)
    steps = round(seconds / STEP)
    with Fmu(path, {"initial.distance": start, "resolution.step": STEP, "speed": given.speed(start)}) as fmu:
        whole.advance(STEP, warm_up)
        fmu.step(0.0, warm_up * STEP)
        at = [time.process_time()]
        whole.advance(STEP, steps)
        at.append(time.process_time())
        fmu.step(warm_up * STEP, steps * STEP)
        at.append(time.process_time())
    return [
        [name, f"{steps * STEP / (end - begin):.2f}"]
        for name, begin, end in zip(("one kernel", "native FMU"), at, at[1:], strict=False)
    ]


def main() -> None:
    """Print the tables."""
    arguments = read_options(__doc__, seconds=2.0, threads=0, fmu=Path)
    seconds = arguments.seconds
    rows = []
    for name, options in METHODS.items():
        for where, (speed, track) in TRACKS.items():
            for pace in PACES:
                ratio, share, solved = measured(speed, track, replace(options, pace=pace), seconds)
                rows.append([name, where, str(pace), f"{ratio:.2f}", f"{share:.0%}", f"{solved:.0%}"])
    print(f"Eight wheels, one core, steps of {1e3 * STEP:g} ms\n")
    head = ["contact methods", "track", "pace", "simulated over processor time", "share of the contacts", "solved"]
    print(table(head, rows))
    if arguments.threads:
        head = ["default methods", "threads", "simulated over elapsed time"]
        print(f"\nPace {PACE}\n\n" + table(head, shared(arguments.threads, seconds)))
    if arguments.fmu:
        head = ["curve of 300 m, 15 m/s, default methods", "simulated over processor time"]
        print("\n" + table(head, beside_the_fmu(arguments.fmu, seconds)))


if __name__ == "__main__":
    main()
