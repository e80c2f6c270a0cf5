"""A wheel over the nose of a made-up crossing: contact points, forces over the distance and the patches on both parts.

    python examples/crossing/crossing.py [FOLDER]

The wing rail leaves to the field side at 1 : 20, and the nose rises beside it. The shapes are simple: flat heads with
rounded corners. Pictures and a table are written to FOLDER, by default out/.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface, SurfacePair
from contact.pair import PairRun, solver_for
from contact.plot import passage as draw
from contact.plot import patch

BEGIN, END = 0.0, 0.6  # [m] slices; the nose begins at the third of them
RATE = 1.0 / 20.0  # at which the wing rail leaves, and at which the nose becomes wider
GAUGE, LOW = -0.028, 0.0055  # [m] gauge side of the nose, and its depth at s = 0
DEEP = 0.025  # [m] height of the sides that are drawn


#: [m] closer where the wheel goes over from the wing rail to the nose
STATIONS = np.concatenate((np.arange(0.05, 0.15, 0.01), np.arange(0.15, 0.17, 0.001), np.arange(0.17, 0.551, 0.01)))


def head(low: float, high: float, top: float, crown: float, corner: float) -> Array:
    """Return points of a head between y = `low` and `high`, at the depth `top` in its middle, with rounded corners [m]."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    y = np.linspace(-(half - corner), half - corner, 61)
    above = np.stack((y, y**2 / (2.0 * crown)), axis=1)
    slope = above[-1, 1] * 2.0 / (half - corner)
    turned = np.linspace(np.arctan(slope), np.radians(86.0), 25)
    edge = (
        np.stack((np.sin(turned) - np.sin(turned[0]), np.cos(turned[0]) - np.cos(turned)), axis=1) * corner + above[-1]
    )
    edge = edge[1:]
    down = np.linspace(edge[-1, 1], DEEP, 30)[1:]
    side = np.stack((edge[-1, 0] + (down - edge[-1, 1]) * np.tan(np.radians(4.0)), down), axis=1)
    right = np.concatenate((edge, side))
    left = right[::-1] * [-1.0, 1.0]
    return np.concatenate((left, above, right)) + np.array([middle, top])


def crossing() -> RailSurface:
    """Return the crossing. Features: both ends of the nose, both ends of the wing rail."""
    s = np.linspace(BEGIN, END, 31)
    slices, features = [], []
    for k, at in enumerate(s):
        wing = head(0.012 + RATE * at, 0.084 + RATE * at, 0.0, 0.3, 0.010)
        length = float(np.hypot(*np.diff(wing, axis=0).T).sum())
        if k < 2:
            slices.append(wing)
            features.append([np.nan, np.nan, 0.0, length])
            continue
        nose = head(GAUGE, GAUGE + 0.016 + RATE * at, LOW - 0.014 * at, 0.06, 0.007)
        both = np.concatenate((nose, wing))
        own = float(np.hypot(*np.diff(nose, axis=0).T).sum())
        between = float(np.hypot(*(wing[0] - nose[-1])))
        slices.append(both)
        features.append([0.0, own, own + between, own + between + length])
    return RailSurface(s, slices, features=features, corners=[1, 2], name="made-up crossing")


def run(stations: Array, normal: str = "strip_halfspace") -> PairRun:
    """Return the passage of a wheel under 80 kN."""
    pair = SurfacePair(profile.s1002(), crossing(), rail_origin=(0.75, 0.0))
    return solver_for(pair, normal).run({"station": stations, "velocity.x": 20.0, "load": 8e4})


def main() -> None:
    """Write the pictures and print the patches."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
    folder.mkdir(exist_ok=True)
    found = run(STATIONS)
    draw(found, "S1002 over a made-up crossing, 80 kN").savefig(folder / "crossing.png")
    both = [k for k, one in enumerate(found.solutions) if len(one.contacts) > 1]
    for k in both:
        print(f"two patches at {found['station'][k]:.3f} m")
    if both:
        station = found["station"][both[len(both) // 2]]
        touching = run(np.array([station]), "halfspace").solutions[0].contacts
        titles = [
            f"{part}, y = {1e3 * c.position[1]:.1f} mm" for part, c in zip(("wing", "nose"), touching, strict=True)
        ]
        patch([c.solution for c in touching], titles).savefig(folder / "patches.png")
    print("station, patch, x, y [mm], N [kN], largest pressure [MPa], gap error")
    for row in found.patches():
        at = (1e3 * row[name] for name in ("station", "x", "y"))
        station, x, y = at
        print(
            f"{station:6.1f} {row['patch'] + 1:2d} {x:8.2f} {y:8.2f} {1e-3 * row['N']:7.2f} "
            f"{1e-6 * row['max_pressure']:7.0f} {row['gap_error']:7.4f}"
        )


if __name__ == "__main__":
    main()
