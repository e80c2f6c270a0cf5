"""Largest force of a wheel on a sharp rail joint, over the distance of the stations around it (docs/understand/vehicle.md).

python -m benchmarks.joint --stations 0.05 0.005 --steps 2e-4 1e-4
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.tables import read_options
from contact.geometry import profile
from contact_models.vehicle.course import lay
from contact_models.vehicle.declared import read
from contact_models.vehicle.simulation import Simulation
from contact_models.vehicle.track import Track

#: Place of the joint, length of the rail that falls to it [m], and its slope.
_AT, _LENGTH, _SLOPE = 6.0, 0.5, 10e-3


def peak(closest: float, h: float, speed: float) -> float:
    """Return the largest normal force of the wheelset's right wheel [N] with stations `closest` apart [m], step `h` [s]."""
    around = np.arange(_AT - _LENGTH, _AT + _LENGTH + 0.5 * closest, closest).round(9)
    s = np.unique(np.concatenate((np.arange(0.0, 2.0 * _AT, 0.5), around)))
    z = np.interp(s, [_AT - _LENGTH, _AT, _AT + _LENGTH], [0.0, _SLOPE * _LENGTH, 0.0])
    table = np.stack((s, 0.0 * s, z, 0.0 * s, 0.0 * s), axis=1)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "track.csv"
        np.savetxt(path, table, delimiter=",", header="distance,alignment,vertical,cross_level,gauge")
        rows = lay(Track(measured=str(path)), _AT + 4.0, lambda s: speed, (1,), 0.0)
    run = Simulation(read("wheelset"), rows, profile.s1002(), profile.rail_60e1())
    run.advance(h, int((_AT - 0.1) / (speed * h)))
    found = 0.0
    while run.distance < _AT + 1.0:
        run.advance(h)
        found = max(found, float(run.state.loads[0, 0]))
    return found


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a table."""
    given = read_options(
        __doc__, arguments, stations=[0.05, 0.02, 0.01, 0.005, 0.0025], steps=[2e-4, 1e-4, 5e-5], speed=30.0
    )
    print("stations, mm | step, ms | largest normal force, kN")
    for closest in given.stations:
        for h in given.steps:
            print(f"{1e3 * closest:g} | {1e3 * h:g} | {1e-3 * peak(closest, h, given.speed):.1f}", flush=True)


if __name__ == "__main__":
    main()
