"""Whole poses of a wheel on a rail against CONTACT (set O): total force at equal height, and every patch by itself.

    python benchmarks/wheel_rail_poses.py FOLDER [--worst 10] [--methods normal+tangential+n_strips+n_elements …]

FOLDER holds `wheel_rail_cases.csv` and `profiles/`, which are not ours to pass on.

* Total force: pose, height and velocity are given; |F - F of CONTACT| over |F of CONTACT|.
* Patches: of those with N > 500 N, more than 150 elements and a peak below 4 GPa, the force over mu N and the peak pressure.
  Each is solved in our separation with CONTACT's normal load and creepages, so the search does not count.
"""

from __future__ import annotations

import csv
import warnings
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import contact
from benchmarks.tables import read_options, table
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.pair import WheelRailPair
from contact.study.errors import mean_p95_max
from reference import STEEL, Patch, accuracy

METHODS = ("analyn+fastrip+30+20", "strip_halfspace+fastrip_mapped+20+20")
Row = dict[str, str]


def read(folder: Path) -> dict[tuple[str, str], list[Row]]:
    """Return the rows of every pose."""
    poses: dict[tuple[str, str], list[Row]] = {}
    with (folder / "wheel_rail_cases.csv").open() as file:
        for row in csv.DictReader(file):
            poses.setdefault((row["set"], row["id"]), []).append(row)
    return poses


@cache
def pair_of(folder: Path, wheel: str, rail: str, gauge: float, flange_back: float) -> Pair:
    """Return the profiles of a pose, as a pair."""
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


def pose_of(row: Row) -> tuple[Pose, Velocity]:
    """Return pose and velocity of the wheelset."""
    y, z, roll, yaw, V, vy, omega = numbers(row, "y_mm", "z_mm", "roll", "yaw", "V_mm_s", "vy_mm_s", "omega_rad_s")
    return Pose(y=1e-3 * y, z=1e-3 * z, roll=roll, yaw=yaw), Velocity(1e-3 * V, y=1e-3 * vy, spin=omega)


def pair_at(folder: Path, row: Row) -> Pair:
    """Return the pair of a pose."""
    gauge, back = numbers(row, "gauge_mm", "flange_back_mm")
    return pair_of(folder, row["wheel"], row["rail"], 1e-3 * gauge, 1e-3 * back)


def patches(poses: Iterable[list[Row]], folder: Path) -> Iterable[Patch]:
    """Yield the patches that are compared, of the poses in which we find as many as CONTACT."""
    for rows in poses:
        found = pair_at(folder, rows[0]).contacts(pose_of(rows[0])[0])
        for row in rows if len(found) == len(rows) else ():
            N, Fx, Fs, pmax, elements = numbers(row, "N_N", "FX_N", "FS_N", "pmax_MPa", "n_contact")
            cksi, ceta, cphi, veloc, at = numbers(row, "cksi", "ceta", "cphi_1_mm", "veloc_mm_s", "y_tr_mm")
            if N > 500.0 and elements > 150 and pmax < 4000.0:
                separation = min(found, key=lambda patch: abs(1e3 * patch.position[1] - at)).separation
                scale = -veloc / float(row["V_mm_s"])
                creepage = contact.Creepage(scale * cksi, scale * ceta, scale * 1e3 * cphi)
                name, mu = f"{row['id']}.{row['patch']}", float(row["mu"])
                yield Patch(name, separation, creepage, mu, N, -Fx, -Fs, 1e6 * pmax)


def total_errors(poses: Iterable[list[Row]], folder: Path, options: dict[str, Any]) -> dict[str, float]:
    """Return the error of the total force of every pose over that force."""
    solvers: dict[int, WheelRailPair] = {}
    found = {}
    for rows in poses:
        pair = pair_at(folder, rows[0])
        solver = solvers.setdefault(id(pair), WheelRailPair(pair, material=STEEL, **options))
        answer = solver.solve(*pose_of(rows[0]), friction=float(rows[0]["mu"]))
        true = -np.array(numbers(rows[0], "FX_tr", "FY_tr", "FZ_tr"))
        found[rows[0]["id"]] = float(np.linalg.norm(answer.force - true) / np.linalg.norm(true))
    return found


def main() -> None:
    """Print the table, and the worst patches."""
    chosen = read_options(__doc__, folder=Path, methods=list(METHODS), worst=0)
    poses = read(chosen.folder).values()
    compared = list(patches(poses, chosen.folder))
    rows, worst = [], []
    for method in chosen.methods:
        normal, tangential, strips, elements = method.split("+")
        options = {"normal": normal, "tangential": tangential, "n_strips": int(strips), "n_elements": int(elements)}
        total = total_errors(poses, chosen.folder, options)
        force, peak, gap = accuracy.errors_of(compared, **options)
        bad = (force > 0.10) | (np.abs(peak) > 0.20)
        rows.append(
            [
                f"`{method}`",
                *(" / ".join(f"{v:.3f}" for v in mean_p95_max(e)) for e in (list(total.values()), force, np.abs(peak))),
                f"{bad.sum()} of {len(bad)}",
            ]
        )
        by_name = [total, *(dict(zip((p.name for p in compared), e, strict=True)) for e in (force, peak, gap))]
        for what, e in zip(("total", "force", "peak", "gap error"), by_name, strict=True):
            order = sorted(e, key=lambda k: -abs(e[k]))[: chosen.worst]
            worst.append(f"{method} {what}: " + ", ".join(f"{k} {e[k]:.3f}" for k in order))
    head = [
        "method",
        "total force, mean / 95 % / max",
        "patch: force",
        "largest pressure",
        "force > .10 or pressure > 20 % off",
    ]
    print(table(head, rows), *worst if chosen.worst else (), sep="\n")


if __name__ == "__main__":
    main()
