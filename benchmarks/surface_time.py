"""Processor time of a pose on surfaces over that of constant profiles, by the same methods on strips.

    python benchmarks/surface_time.py [--poses 200]

Every row is measured in one run. `search` is the contact search alone, the others are `WheelRailPair.solve` at a given
penetration, under a load, and under a vertical force with friction. Each pose differs from the last one.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from benchmarks.tables import read_options, table
from contact.geometry import profile
from contact.geometry.surfaces import Flat, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.kernels.enumerations import Height
from contact.kernels.geometry.elements import find
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.settle import settle
from contact.pair import WheelRailPair
from examples.crossing.crossing import crossing

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
ROLLING = Velocity(20.0)


def times(call: Callable[[int], object], poses: int) -> np.ndarray:
    """Return the processor time of every pose [µs]."""
    call(0)
    found = []
    for k in range(poses):
        begin = time.process_time_ns()
        call(k)
        found.append(1e-3 * (time.process_time_ns() - begin))
    return np.array(found)


def measured(pair: Pair | SurfacePair, place: Callable[[int], dict[str, float]], poses: int) -> list[np.ndarray]:
    """Return the times of search, penetration, load and vertical force. `place` gives station and rotation of pose k."""
    solver = WheelRailPair(pair, normal="strip_halfspace", tangential="fastrip_mapped")

    def search(k: int) -> None:
        move(pair.given(Pose(y=1e-6 * k), ROLLING, **place(k)), pair.space.motion[0])
        (settle if isinstance(pair, Pair) else find)(Height.PENETRATION, 8e-5, pair.space)

    found = [times(search, poses)]
    ways = ({"penetration": 8e-5}, {"load": 8e4}, {"vertical": 8e4})
    return found + [
        times(lambda k, way=way: solver.solve(Pose(y=1e-6 * k), ROLLING, **place(k), **way), poses) for way in ways
    ]


def main() -> None:
    """Print the table."""
    poses = read_options(__doc__, poses=200).poses
    flat = WheelSurface.constant(WHEEL, Flat(0.05))
    cases = {
        "constant profiles": (Pair(WHEEL, RAIL), lambda k: {}),
        "the same as surfaces": (SurfacePair(WHEEL, RAIL), lambda k: {}),
        "a flat of 50 mm": (SurfacePair(flat, RAIL), lambda k: {"rotation": 0.08 * (2.0 * k / poses - 1.0)}),
        "a crossing nose": (
            SurfacePair(WHEEL, crossing(), rail_origin=(0.75, 0.0)),
            lambda k: {"station": 0.06 + 0.48 * k / poses},
        ),
    }
    rows, base = [], []
    for name, (pair, place) in cases.items():
        found = measured(pair, place, poses)
        base = base or [float(np.median(one)) for one in found]
        cells = [
            f"{np.median(one):.0f} µs, {np.median(one) / b:.1f}, {one.max() / b:.1f}"
            for one, b in zip(found, base, strict=True)
        ]
        rows.append([name, *cells])
    print("Median, median and worst over the median of constant profiles:\n")
    print(table(["surfaces", "search", "penetration", "load", "vertical force"], rows))


if __name__ == "__main__":
    main()
