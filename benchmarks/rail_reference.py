"""Why the lateral deflection of a rail on springs differs from CONTACT's (set L): the reference of the creepage, and strips.

    python benchmarks/rail_reference.py FOLDER

Every pose is solved at CONTACT's own place of wheel and rail, so the table has the error before the springs give way to it.
CONTACT takes the velocity of the wheel at its greatest depth under the reference point (wr_creep_cref in m_wr_rigslip.f90 of
the open source), we take that of the wheel's point opposite the reference point. They differ where a patch has two lobes. The
element-wise half space and the default methods are solved with both. A second table has the errors of
`WheelRailPair.solve(rail=…)`, where springs and contact are in balance.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import contact
import reference
from benchmarks.patches_of_sets import BOTH, pair_of
from benchmarks.tables import read_options, table
from contact.geometry.wheelset import Irregularity, Pose, Velocity
from contact.pair import ElasticRail, PairSolution, WheelRailPair

MU, RADIUS = 0.3, 0.46
FORCES = "Fx_tr", "Fy_tr", "Fz_tr"
METHODS: tuple[dict[str, Any], ...] = ({**BOTH, "spacing": 0.2e-3}, {})


def rows(folder: Path) -> Iterator[list[str]]:
    """Yield deflection [mm], depth of the reference point [µm], and for each method and reference the errors."""
    pair = pair_of(folder / "L_rail_deflection")
    for row in reference.rows(folder / "L_rail_deflection" / "rail_deflection.csv"):
        v = {name: float(text) for name, text in row.items() if name not in ("id", "mode") and text}
        velocity = Velocity(2.0, spin=-2.0 / RADIUS * 1.0003)
        pose = Pose(y=1e-3 * v["y_ws"], z=1e-3 * v["z_ws"], yaw=v["yaw"])
        rail = Irregularity(y=1e-3 * v["dy_balance"], z=1e-3 * v["dz_balance"])
        patch = pair.contacts(pose, velocity, irregularity=rail)[0]
        gap = float(np.interp(0.0, patch.separation.y, patch.separation.g))
        deeper = replace(
            patch.creepage, longitudinal=patch.creepage.longitudinal - gap * math.cos(patch.angle) / RADIUS
        )
        errors = []
        for options in METHODS:
            for creepage in (patch.creepage, deeper):
                s = contact.solve(patch.separation, creepage, load=v["N"], friction=MU, **options)
                off = math.hypot(s.Fx + v["Fx"], s.Fy + v["Fs"]) / (MU * v["N"])
                lateral = math.cos(patch.angle) * s.Fy + math.sin(patch.angle) * s.N
                errors.append(f"{off:.4f}, {1e3 * abs(lateral + v['Fy_tr']) / v['KYRAIL']:.1f}")
        yield [row["id"], f"{v['dy_balance']:.3f}", f"{1e6 * gap:.0f}", *errors]


def balances(folder: Path) -> Iterator[list[str]]:
    """Yield the lateral deflection of CONTACT [mm], our error of it [µm], and those of deflection and force vector [%]."""
    solver = WheelRailPair(pair_of(folder / "L_rail_deflection"))
    for row in reference.rows(folder / "L_rail_deflection" / "rail_deflection.csv"):
        v = {name: float(text) for name, text in row.items() if name not in ("id", "mode") and text}
        found = on_springs(solver, row)
        balance, true = (np.array([v[k] for k in names]) for names in (("dy_balance", "dz_balance"), FORCES))
        away, off = 1e3 * np.array(found.deflection) - balance, found.force + true
        shares = (100.0 * np.linalg.norm(a) / np.linalg.norm(b) for a, b in ((away, balance), (off, true)))
        yield [row["id"], f"{balance[0]:.3f}", f"{1e3 * away[0]:.1f}", *(f"{share:.2f}" for share in shares)]


def on_springs(solver: WheelRailPair, row: dict[str, str]) -> PairSolution:
    """Return the solution of a row of set L on its springs, from no deflection."""
    v = {name: float(text) for name, text in row.items() if name not in ("id", "mode") and text}
    springs = ElasticRail(1e3 * v["KYRAIL"], 1e3 * v["KZRAIL"], v["FYRAIL"], v["FZRAIL"])
    height = row["mode"] == "z"
    pose = Pose(y=1e-3 * v["y_ws"], z=1e-3 * v["value"] if height else 0.0, yaw=v["yaw"])
    solver.forget()
    velocity = Velocity(2.0, spin=-2.0 / RADIUS * 1.0003)
    return solver.solve(pose, velocity, vertical=None if height else v["value"], rail=springs)


def main() -> None:
    head = ["pose", "lateral deflection [mm]", "gap at the reference [µm]"]
    head += [f"{method}, {point}: [μN], [µm]" for method in ("half space", "strips") for point in ("ours", "CONTACT's")]
    folder = read_options(__doc__, folder=Path).folder
    print(table(head, list(rows(folder))))
    head = ["pose", "lateral deflection [mm]", "error [µm]", "error of the deflection [%]", "error of the force [%]"]
    print(table(head, list(balances(folder))))


if __name__ == "__main__":
    main()
