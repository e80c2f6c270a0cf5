"""The half space on a bent surface (`conformal=True`) against CONTACT with the same influence numbers (set M).

    python benchmarks/bent_surface.py FOLDER

prints every patch; `benchmarks/contact_features.py` prints the summary. FOLDER has the set M_conformal.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import contact
import reference
from benchmarks.tables import read_options, summary, table
from contact.geometry.profile import Profile
from contact.geometry.records import Patch, Pose, Velocity
from contact.geometry.wheelset import Pair
from contact.given_force import rising_root

MU = 0.3
BOTH: dict[str, Any] = {"normal": "halfspace", "tangential": "halfspace"}
#: Geometry [m] and velocity [m/s, rad/s] of the poses. CONTACT's origin of the worn wheel is at the flange back.
SITE_B: dict[str, Any] = {"nominal_radius": 0.444, "gauge": 1.4351, "gauge_point": 0.015875, "flange_back": 1.3474}
S1002: dict[str, Any] = {"gauge": 1.435, "flange_back": 1.36, "combine_distance": 4e-3}
WIDE = {"combine_distance": 30e-3, "combine_angle": math.radians(90.0)}  # one patch of 26 mm
SITE_B_SPEED, S1002_SPEED = Velocity(15.0, spin=-32.1), Velocity(2.0, spin=-4.3481124)


class Found(NamedTuple):
    """One patch, ours and CONTACT's: N [N], pmax [Pa], forces on the wheel [N] in contact axes, approach [m]."""

    case: str
    ours: contact.Solution
    N: float
    pmax: float
    Fx: float
    Fy: float
    approach: float
    friction: float

    @property
    def off(self) -> tuple[float, float, float]:
        """Errors of N and pmax [-], and of the force over mu N."""
        away = math.hypot(self.ours.Fx - self.Fx, self.ours.Fy - self.Fy)
        return self.ours.N / self.N - 1.0, self.ours.max_pressure / self.pmax - 1.0, away / (MU * self.N)


def patches(folder: Path, conformal: bool = True) -> Iterator[Found]:
    """Yield the patches of all cases whose number of patches agrees."""
    cases: dict[str, list[dict[str, str]]] = {}
    for row in reference.rows(folder / "M_conformal" / "conformal.csv"):
        if row["method"] == "conformal_if1_v4":
            cases.setdefault(row["case"], []).append(row)
    for name, rows in cases.items():
        friction = MU if rows[0]["T"] == "3" else 0.0
        solve = groove if name.startswith("groove") else pose
        for row, own in zip(rows, solve(folder, rows[0], friction, conformal), strict=True):
            N, pmax, Fx, Fy, approach = (float(row[key] or 0.0) for key in ("N", "pmax", "Fx", "Fs", "pen"))
            yield Found(name, own, N, 1e6 * pmax, -Fx, -Fy, 1e-3 * approach, friction)


def groove(_: Path, row: dict[str, str], friction: float, conformal: bool) -> list[contact.Solution]:
    """Return the solution of a ball of 10 mm in a groove, by closed forms of the profiles."""
    ball, radius = 10e-3, 1e-5 * float(row["case"].removeprefix("groove_r"))
    y = np.linspace(-8e-3, 8e-3, 801)
    wheel, rail = (np.sqrt(r**2 - y**2) - r for r in (ball, radius))
    tilt = -0.5 * sum(y / np.sqrt(r**2 - y**2) for r in (ball, radius))
    separation = contact.Separation(y, rail - wheel, 0.5 / (0.42 + wheel), tilt=tilt, rolling=1.0 / 0.42)
    slip = contact.Creepage(1.0 - 1.0002)  # the wheel turns faster than it rolls
    options = BOTH | {"conformal": conformal, "friction": friction}
    return [contact.solve(separation, slip, load=1e4, spacing=(0.2e-3, 0.25e-3), **options)]


def pose(folder: Path, row: dict[str, str], friction: float, conformal: bool) -> list[contact.Solution]:
    """Return the solutions of the patches of a wheel on a rail, at the height that gives CONTACT's vertical force."""
    site = row["case"].startswith("siteb")
    points = np.load(folder / "M_conformal" / "profiles.npz")
    wheel, rail = (outline(points[n]) for n in (SITE_FILES if site else S1002_FILES))
    if site:
        options = SITE_B | (WIDE if row["case"] == "siteb_y14.85" else {})
        wheel = wheel - np.array([0.07, 0.0])
    else:
        options, rail = S1002, turned(rail, -0.025)
    pair = Pair(Profile("wheel", *wheel.T), Profile("rail", *rail.T), material=contact.STEEL, **options)
    at = Pose(y=1e-3 * float(row["y_ws"]), roll=float(row["roll"]), yaw=float(row["yaw"]))
    step, load = (0.4e-3 if site else 0.2e-3), float(row["Fz_in"])
    how: dict[str, Any] = BOTH | {"conformal": conformal, "friction": friction, "spacing": step, "throw": False}
    solutions: list[contact.Solution] = []

    def residual(penetration: float) -> float:
        found = pair.contacts(at, SITE_B_SPEED if site else S1002_SPEED, penetration=penetration)
        solutions[:] = [contact.solve(p.separation, p.creepage, approach=p.approach, **how) for p in found]
        left = sum(upward(*both) for both in zip(found, solutions, strict=True)) - load
        return 0.0 if abs(left) <= 1e-5 * load else left

    rising_root(residual, 5e-5, load / 5e-5, (0.0, 4e-4), shortest=1e-10)
    return solutions


SITE_FILES, S1002_FILES = ("wheel_worn_raw_yz", "rail_site_b_yz"), ("wheel_s1002_yz", "rail_uic60_yz")


def upward(patch: Patch, s: contact.Solution) -> float:
    """Return the vertical force on the wheel [N], positive up."""
    return patch.share * (math.cos(patch.angle) * s.N - math.sin(patch.angle) * s.Fy)


def outline(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points [m] without repetitions, in the library's order."""
    xy = 1e-3 * points
    xy = xy[np.append(True, np.hypot(*np.diff(xy, axis=0).T) > 1e-7)]
    return xy[::-1] if xy[0, 0] > xy[-1, 0] else xy


def turned(xy: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    """Return points turned about the origin."""
    c, s = math.cos(angle), math.sin(angle)
    return xy @ np.array([[c, s], [-s, c]])


def errors(folder: Path) -> Iterator[list[str]]:
    """Yield the rows of the summary."""
    off = np.array([found.off for found in patches(folder)])
    for column, (what, unit) in enumerate(
        (("normal force", "itself"), ("largest pressure", "itself"), ("force", "μN"))
    ):
        yield summary(f"M: {what}, half space on the bent surface", off[:, column], unit)


def main() -> None:
    folder = read_options(__doc__, folder=Path).folder
    rows = []
    for kind in (False, True):
        for f in patches(folder, kind):
            values = (f"{100.0 * f.off[0]:.2f}", f"{100.0 * f.off[1]:.2f}", f"{f.off[2]:.4f}")
            rows.append([f.case, "conformal" if kind else "plane", f"{f.N:.0f}", f"{1e-6 * f.pmax:.0f}", *values])
    print(table(["case", "surface", "N [N]", "pmax [MPa]", "N off [%]", "pmax off [%]", "force off [μN]"], rows))


if __name__ == "__main__":
    main()
