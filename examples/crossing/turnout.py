"""A made-up crossing between rails 60E1, as slices for a scenario.

The wing rail, a 60E1, leaves to the field side at 1 : 20. The nose is a 60E1 whose head is narrow and low at first; it becomes
wider at the same rate and rises until it is the rail. So both ends are the plain rail. The shapes are our own.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.surfaces import RailSurface

RATE = 1.0 / 20.0
SPACING = 0.02  # of the slices [m]
WIDTH, GROOVE = 0.010, 0.030  # width of the nose where it begins, and the groove between nose and wing rail [m]
LOW = 5e-3  # depth of the nose where it begins [m]
RISE = 0.9  # distance over which the nose rises to the height of the rail [m]


def head() -> Array:
    """Return the points of the 60E1, from the gauge side to the field side [m]."""
    rail = profile.rail_60e1()
    return np.stack((rail.y, rail.z), axis=1)


def slices() -> tuple[Array, list[Array], Array]:
    """Return positions [m], points of each slice, and features: both ends of the nose, both ends of the wing rail."""
    rail = head()
    full = float(np.ptp(rail[:, 0]))
    begin = np.ceil((WIDTH + GROOVE) / RATE / SPACING) * SPACING  # of the nose
    whole = begin + (full - WIDTH) / RATE
    s = np.arange(0.0, whole + 0.1, SPACING)
    found, features = [], []
    for at in s:
        wing = rail + np.array([RATE * at, 0.0])
        if at < begin - 1e-9:
            found.append(wing)
            features.append([np.nan, np.nan, 0.0, _length(wing)])
            continue
        share = min((WIDTH + RATE * (at - begin)) / full, 1.0)
        low = LOW * 0.5 * (1.0 + np.cos(np.pi * min((at - begin) / RISE, 1.0)))
        nose = np.stack((rail[0, 0] + share * (rail[:, 0] - rail[0, 0]), rail[:, 1] + low), axis=1)
        ends = np.cumsum([_length(nose), float(np.hypot(*(wing[0] - nose[-1]))), _length(wing)])
        found.append(np.concatenate((nose, wing)))
        features.append([0.0, *ends])
    return s, found, np.array(features)


def surface() -> RailSurface:
    """Return the crossing as a surface."""
    s, points, features = slices()
    return RailSurface(s, points, features=features, corners=[1, 2], name="crossing")


def write(folder: Path) -> Path:
    """Write the crossing as CONTACT's file of slices, with a file of points [mm] for each; return the file of slices."""
    s, points, features = slices()
    for k, each in enumerate(points):
        np.savetxt(folder / f"slice{k:03d}.txt", 1e3 * each, fmt="%.6f")
    lines = ["0 1  ! offset, scale", str(s.size), "4 2 0  ! features, kinks, accelerations", "1  ! interpolating"]
    lines += [f"{1e3 * at:.6f} 'slice{k:03d}.txt'" for k, at in enumerate(s)]
    lines.append("1 2  ! kinks")
    lines += [
        " ".join(f"{1e3 * value:.6f}" for value in (at, *np.where(np.isnan(row), -1e-3, row)))
        for at, row in zip(s, features, strict=True)
    ]
    path = folder / "crossing.slcs"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def _length(points: Array) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
