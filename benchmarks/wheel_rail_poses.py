"""Whole poses of a wheel on a rail against CONTACT (set O): total force at equal height, and every patch by itself.

    python benchmarks/wheel_rail_poses.py [--set FOLDER] [--worst 10] [METHODS …]

Without FOLDER, the poses of `reference/wheel_rail_poses.csv`, all of the standard profiles S1002 on 60E1, are computed. FOLDER
holds `wheel_rail_cases.csv` with the same columns and `profiles/`: the other profiles of the set are not ours to pass on.
METHODS are written normal+tangential+n_strips+n_elements.

* Total force: pose, height and velocity are given; |F - F of CONTACT| over |F of CONTACT|.
* Patches: of those with N > 500 N, more than 150 elements and a peak below 4 GPa, the force over mu N and the peak pressure.
  Each is solved in our separation with CONTACT's normal load and creepages, so the search does not count.
"""

from __future__ import annotations

import argparse
import csv
import math
import warnings
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import contact
from benchmarks.tables import table
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact.study.errors import mean_p95_max
from reference import FOLDER

STEEL = contact.Material(82e9, 0.28)
METHODS = ("analyn+fastrip+30+20", "strip_halfspace+fastrip_mapped+20+20")
Row = dict[str, str]


def read(folder: Path | None) -> dict[tuple[str, str], list[Row]]:
    """Return the rows of every pose."""
    path = FOLDER / "wheel_rail_poses.csv" if folder is None else folder / "wheel_rail_cases.csv"
    poses: dict[tuple[str, str], list[Row]] = {}
    with path.open() as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            poses.setdefault((row["set"], row["id"]), []).append(row)
    return poses


@cache
def pair_of(folder: Path | None, wheel: str, rail: str, gauge: float, flange_back: float) -> Pair:
    """Return the profiles of a pose, as a pair."""
    if folder is None:
        profiles = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            profiles = (
                profile.load(str(folder / "profiles" / wheel), "wheel"),
                profile.load(str(folder / "profiles" / rail), "rail"),
            )
    return Pair(*profiles, gauge=gauge, flange_back=flange_back, material=STEEL)


def numbers(row: Row, *names: str) -> tuple[float, ...]:
    """Return columns of a row as numbers."""
    return tuple(float(row[name]) for name in names)


def errors(poses: Iterable[list[Row]], folder: Path | None, method: str) -> dict[str, Any]:
    """Return the errors of the total forces and of the patches, with the names of the poses."""
    normal, tangential, n_strips, n_elements = method.split("+")
    solvers: dict[int, WheelRailPair] = {}
    single = contact.Solver(
        normal=normal, tangential=tangential, n_strips=int(n_strips), n_elements=int(n_elements), material=STEEL
    )
    total, force, peak, quality = {}, {}, {}, {}
    for rows in poses:
        first = rows[0]
        pair = pair_of(
            folder, first["wheel"], first["rail"], *(1e-3 * x for x in numbers(first, "gauge_mm", "flange_back_mm"))
        )
        if id(pair) not in solvers:
            solvers[id(pair)] = WheelRailPair(
                pair,
                material=STEEL,
                normal=normal,
                tangential=tangential,
                n_strips=int(n_strips),
                n_elements=int(n_elements),
            )
        y, z, roll, yaw = numbers(first, "y_mm", "z_mm", "roll", "yaw")
        pose = Pose(y=1e-3 * y, z=1e-3 * z, roll=roll, yaw=yaw)
        V, vy, omega, mu = numbers(first, "V_mm_s", "vy_mm_s", "omega_rad_s", "mu")
        name = first["id"]
        answer = solvers[id(pair)].solve(pose, Velocity(1e-3 * V, y=1e-3 * vy, spin=omega), friction=mu)
        true = -np.array(numbers(first, "FX_tr", "FY_tr", "FZ_tr"))
        total[name] = float(np.linalg.norm(answer.force - true) / np.linalg.norm(true))
        found = pair.contacts(pose)
        if len(found) != len(rows):
            continue
        for row in rows:
            N, Fx, Fs, pmax, elements = numbers(row, "N_N", "FX_N", "FS_N", "pmax_MPa", "n_contact")
            if not (N > 500.0 and elements > 150 and pmax < 4000.0):
                continue
            cksi, ceta, cphi, veloc = numbers(row, "cksi", "ceta", "cphi_1_mm", "veloc_mm_s")
            (at,) = numbers(row, "y_tr_mm")
            patch = min(found, key=lambda p: abs(1e3 * p.position[1] - at))
            scale = -veloc / V
            creepage = contact.Creepage(scale * cksi, scale * ceta, scale * 1e3 * cphi)
            solution = single.solve(patch.separation, creepage, load=N, friction=mu)
            key = f"{name}.{row['patch']}"
            force[key] = math.hypot(solution.Fx + Fx, solution.Fy + Fs) / (mu * N)
            peak[key] = solution.max_pressure / (1e6 * pmax) - 1.0
            quality[key] = getattr(solution, "quality", math.nan)
    return {"total": total, "force": force, "peak": peak, "quality": quality}


def main() -> None:
    """Print the table, and the worst patches."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("methods", nargs="*", default=METHODS)
    parser.add_argument("--set", type=Path)
    parser.add_argument("--worst", type=int, default=0)
    chosen = parser.parse_args()
    poses = read(chosen.set)
    rows, worst = [], []
    for method in chosen.methods:
        e = errors(poses.values(), chosen.set, method)
        force, peak = np.array(list(e["force"].values())), np.abs(list(e["peak"].values()))
        bad = [k for k in e["force"] if e["force"][k] > 0.10 or abs(e["peak"][k]) > 0.20]
        rows.append(
            [
                f"`{method}`",
                " / ".join(f"{v:.3f}" for v in mean_p95_max(list(e["total"].values()))),
                " / ".join(f"{v:.3f}" for v in mean_p95_max(force)),
                " / ".join(f"{v:.3f}" for v in mean_p95_max(peak)),
                f"{len(bad)} of {len(force)}",
            ]
        )
        for what in ("total", "force", "peak"):
            order = sorted(e[what], key=lambda k: -abs(e[what][k]))[: chosen.worst]
            worst.append(f"{method} {what}: " + ", ".join(f"{k} {e[what][k]:.3f}" for k in order))
    head = [
        "method",
        "total force, mean / 95 % / max",
        "patch: force",
        "peak pressure",
        "force > .10 or peak > 20 % off",
    ]
    print(table(head, rows), *worst if chosen.worst else (), sep="\n")


if __name__ == "__main__":
    main()
