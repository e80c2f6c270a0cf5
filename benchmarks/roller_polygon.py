"""The largest pressure on rollers (set N): the profile of CONTACT's roller is a polygon.

    python benchmarks/roller_polygon.py FOLDER

On a rail CONTACT interpolates the profile by a spline. On a roller it turns the points of the profile about the roller's
axle and interpolates linearly between them (grid_revolve_profile and interp_cartz2unif in m_wr_undefdist.f90 of the open
source). The chords lie up to .2 µm under the arc, and the pressure peaks at the corners. Here the same polygon is put on the
patches of `contact.pair.RollerRig`, on CONTACT's elements.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

import contact
import reference
from benchmarks.patches_of_sets import BOTH, pair_of
from benchmarks.tables import read_options, summary, table
from contact.geometry.records import Patch
from contact.geometry.wheelset import Pose, Velocity
from contact.halfspace import Gap
from contact.pair import RollerRig

_STEP = 2e-4  # [m] of CONTACT's elements
_ROWS, _COLUMNS = 80, 40  # of elements to both sides of its reference point
_OUTSIDE = 1e-3  # [m] gap where the separation ends


class Peak(NamedTuple):
    """The largest pressure of a pose over CONTACT's, less 1: on the smooth roller and on the polygon."""

    case: str
    smooth: float
    polygon: float


def peaks(folder: Path) -> Iterator[Peak]:
    """Yield all poses of set N, under CONTACT's normal force."""
    pair = pair_of(folder / "N_roller")
    points = 1e-3 * np.load(folder / "N_roller" / "profiles.npz")["rail_uic60_yz"]
    for row in reference.rows(folder / "N_roller" / "roller.csv"):
        v = {name: float(text) for name, text in row.items() if name != "id" and text}
        radius = 1e-3 * v["R_roller"]
        rig = RollerRig(pair, radius, offset=1e-3 * v["x_ws"])
        velocity = Velocity(v["RPITCH"] * radius, spin=v["VPITCH"])
        patch = rig.solve(Pose(y=1e-3 * v["y_ws"], yaw=v["yaw"]), velocity, vertical=v["Fz_in"]).contacts[0].patch
        found = []
        for corners in (None, points):
            gap = _gap(patch, 1e-3 * v["ycp_r"], v["delta_rad"], corners)
            s = contact.solve(gap, patch.creepage, load=v["N"], **BOTH)
            found.append(1e-6 * s.max_pressure / v["pmax"] - 1.0)
        yield Peak(row["id"], *found)


def errors(folder: Path) -> Iterator[list[str]]:
    """Yield the rows of the summary."""
    found = list(peaks(folder))
    yield summary("N: largest pressure, smooth roller", [p.smooth for p in found], "itself")
    yield summary("N: largest pressure, polygon as in CONTACT", [p.polygon for p in found], "itself")


def _gap(patch: Patch, rail_y: float, angle: float, corners: NDArray[np.float64] | None) -> Gap:
    """Return the gap on CONTACT's elements, which are centred on its reference point `rail_y` [m] of the rail's profile."""
    cosine, s = math.cos(angle), patch.separation
    across, x = _STEP * np.arange(-_ROWS, _ROWS + 1), _STEP * np.arange(-_COLUMNS, _COLUMNS + 1)
    y = across + (rail_y - patch.on_rail[0]) / cosine
    g, A, x_c = (CubicSpline(s.y, row)(y) for row in (s.g, s.A, s.x_c))
    if corners is not None:
        on_rail = rail_y + across * cosine
        near = corners[(corners[:, 0] > on_rail[0] - 2e-3) & (corners[:, 0] < on_rail[-1] + 2e-3)]
        near = near[np.append(True, np.diff(near[:, 0]) > 1e-9)]
        g += cosine * (np.interp(on_rail, *near.T) - CubicSpline(*near.T)(on_rail))
    h = g[:, None] + A[:, None] * (x - x_c[:, None]) ** 2
    h[(y < s.y[0]) | (y > s.y[-1])] = _OUTSIDE
    return Gap(x, across, h - h.min())


def main() -> None:
    rows = [[p.case, f"{p.smooth:+.2%}", f"{p.polygon:+.2%}"] for p in peaks(read_options(__doc__, folder=Path).folder)]
    print(table(["pose", "largest pressure, smooth roller", "with the corners of CONTACT's roller"], rows))


if __name__ == "__main__":
    main()
