"""Crossings along the way, CONTACT and ours: the section of docs/check/proof.md, from reference/crossing.csv.

python -m benchmarks.proof.crossing FOLDER    makes that file; FOLDER is F_crossing/, which is not ours to pass on
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from benchmarks.tables import table
from contact.geometry.surfaces import RailSurface, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pose, Velocity
from contact.pair import HalfspacePair, WheelRailPair
from reference import STEEL

KEPT = Path(__file__).parents[2] / "reference" / "crossing.csv"
MU, VELOCITY = 0.3, Velocity(2.0, spin=-4.3481181)
SURFACES = {
    "nose": "cross_nose",
    "uk_v2_z": "uk_interrupt_v2",
    "uk_v2_Fz": "uk_interrupt_v2",
    "cross_wing": "cross_wing_extd",
}
WHOSE = ("CONTACT", "halfspace", "strip_halfspace")
NAMES = {
    "nose": "nose rising at 1:10, given force",
    "uk_v2_z": "measured crossing, given height",
    "uk_v2_Fz": "measured crossing, given force",
    "cross_wing": "wing rail and nose, given force",
}


def poses(path: Path, sweep: str) -> Iterator[list[dict[str, str]]]:
    """Yield the rows of every pose of a sweep that has contact."""
    with path.open() as file:
        rows = [row for row in csv.DictReader(file) if row["sweep"] == sweep and row["N"]]
    for k, row in enumerate(rows):
        if row["patch"] == "1":
            yield rows[k : k + int(row["n_patches"])]


def pair_of(folder: Path, sweep: str) -> SurfacePair:
    """Return the wheel and the crossing of a sweep."""
    data, wheel = (np.load(folder / f"{name}.npz") for name in (f"surface_{SURFACES[sweep]}", "wheel_s1002"))
    rail = RailSurface(
        1e-3 * data["u"],
        [1e-3 * data[f"yz_{i:02d}"] for i in range(data["u"].size)],
        features=1e-3 * data["features_s"],
        interpolating=int(data["u_intpol"]) == 1,
    )
    return SurfacePair(WheelSurface([0.0], [1e-3 * wheel["yz"]]), rail, rail_origin=(0.75, 0.0), material=STEEL)


def compute(folder: Path) -> None:
    """Write `KEPT`: forces on the wheel [N], height of the wheelset [mm], largest pressure [MPa]."""
    lines = [["sweep", "station", "load", "whose", "Fx", "Fy", "Fz", "z", "pressure"]]
    for sweep in NAMES:
        pair = pair_of(folder, sweep)
        solvers = {"halfspace": HalfspacePair(pair), "strip_halfspace": WheelRailPair(pair, material=STEEL)}
        for rows in poses(folder / "crossing.csv", sweep):
            first = rows[0]
            if sweep != "uk_v2_z" and first["mode"] != "Fz":
                continue
            head = [sweep, first["s_ws"], first["value"] if first["mode"] == "Fz" else ""]
            force = [-float(first[f"F{k}_tr"]) for k in "xyz"]
            lines.append([*head, "CONTACT", *shown(force, float(first["z_wm"]), max(float(r["pmax"]) for r in rows))])
            under = {"vertical": float(first["Fz_tr"])} if first["mode"] == "Fz" else {}
            pose = Pose(y=1e-3 * float(first["y_ws"]), z=1e-3 * float(first["z_wm"]), yaw=float(first["yaw"]))
            for name, solver in solvers.items():
                found = solver.solve(pose, VELOCITY, friction=MU, station=1e-3 * float(first["s_ws"]), **under)
                lines.append([*head, name, *shown(list(found.force), 1e3 * found.z, 1e-6 * found.max_pressure)])
    with KEPT.open("w", newline="", encoding="utf-8") as file:
        file.write("# Set F of CONTACT 25.1 (rev 2707, Apache-2.0), and ours; python -m benchmarks.proof.crossing\n")
        csv.writer(file, lineterminator="\n").writerows(lines)


def shown(force: list[float], z: float, pressure: float) -> list[str]:
    """Return the numbers of a line."""
    return [*(f"{value:.1f}" for value in force), f"{z:.4f}", f"{pressure:.1f}"]


def kept() -> list[dict[str, str]]:
    """Return the lines of `KEPT`."""
    with KEPT.open(encoding="utf-8") as file:
        next(file)
        return list(csv.DictReader(file))


def numbers(lines: list[dict[str, str]], sweep: str, whose: str) -> np.ndarray:
    """Return station, Fx, Fy, Fz, z, pressure and load (NaN: height given) of a sweep, shape (n, 7), by station."""
    names = ("station", "Fx", "Fy", "Fz", "z", "pressure", "load")
    found = [[float(row[n] or "nan") for n in names] for row in lines if (row["sweep"], row["whose"]) == (sweep, whose)]
    return np.array(sorted(found))


def section() -> tuple[str, str]:
    """Return the agreement for the summary, and the text."""
    lines, rows, largest = kept(), [], {}
    for sweep, title in NAMES.items():
        true = numbers(lines, sweep, "CONTACT")
        for whose in WHOSE[1:]:
            ours = numbers(lines, sweep, whose)
            force = np.linalg.norm((ours - true)[:, 1:4], axis=1) / np.linalg.norm(true[:, 1:4], axis=1)
            pressure, height = np.abs(ours[:, 5] / true[:, 5] - 1.0), 1e3 * np.abs(ours[:, 4] - true[:, 4])
            largest[sweep, whose] = 100.0 * force.max(), 100.0 * pressure.max()
            given = "" if sweep == "uk_v2_z" else f"{height.mean():.2f} / {height.max():.2f}"
            cells = (f"{100 * e.mean():.2f} / {100 * e.max():.2f}" for e in (force, pressure))
            rows.append([title, str(len(true)), f"`{whose}`", *cells, given])
    head = ["sweep", "poses", "ours", "force [%], mean / max", "largest pressure [%]", "height [µm]"]
    smooth = ("nose", "uk_v2_z", "uk_v2_Fz")
    measured = max(largest[sweep, "halfspace"][0] for sweep in smooth)
    by_strips = max(largest[sweep, "strip_halfspace"][0] for sweep in smooth)
    ours, true = (numbers(lines, "uk_v2_Fz", whose) for whose in ("halfspace", "CONTACT"))
    lateral = 1e-3 * float(np.abs(ours - true)[:, 2].max())
    pressure = max(largest[sweep, "halfspace"][1] for sweep in smooth)
    strips = max(largest[sweep, "strip_halfspace"][1] for sweep in smooth)
    text = f"""## Crossings

CONTACT 25.1 along three crossings (our reference set F, 10 to 60 kN; friction .3, S1002 with 460 mm; published numbers were
[not found](#not-found)). Errors of the force vector are over its size; heights are compared where the force is
given ([surfaces](../use/surfaces.md)). `python -m benchmarks.proof.crossing FOLDER` computes ours; the surfaces
are CONTACT's and not in this repository.

{table(head, rows)}
![Forces and pressure along the crossings](proof/crossing.png)

Verdict: on the nose and the measured crossing forces are within {measured:.1f} % by elements and {by_strips:.1f} % by the
default method. The lateral force alone is up to {lateral:.1f} kN off on the measured crossing, since CONTACT's mean
inclination of the rough nose is another. Largest pressures are within {pressure:.1f} % by elements, and up to
{strips:.0f} % off by strips from 128 mm on, whose section is rough; `gap_error` and a warning say so.
"""
    return f"force within {measured:.1f} %, default method {by_strips:.1f} %", text


def draw(path: Path) -> None:
    """Draw the ways along the crossings."""
    lines = kept()
    figure, axes = plt.subplots(3, 4, figsize=(11.0, 6.5), layout="constrained")
    looks = {"CONTACT": "ko", "halfspace": "C0+", "strip_halfspace": "C1x"}
    for column, (sweep, title) in zip(axes.T, NAMES.items(), strict=True):
        for whose, look in looks.items():
            of = numbers(lines, sweep, whose)
            for ax, index, scale in zip(column, (1, 2, 5), (1e-3, 1e-3, 1.0), strict=True):
                ax.plot(of[:, 0], scale * of[:, index], look, label=whose, fillstyle="none")
                ax.grid(visible=True, alpha=0.3)
        column[0].set_title(title, fontsize=8)
        column[2].set_xlabel("station [mm]")
    for ax, label in zip(axes[:, 0], ("Fx [kN]", "Fy [kN]", "pressure [MPa]"), strict=True):
        ax.set_ylabel(label)
    axes[0, 0].legend(fontsize=7)
    figure.savefig(path, dpi=100)
    plt.close(figure)


if __name__ == "__main__":
    compute(Path(sys.argv[1]))
