"""The roller rig of docs/check/proof.md."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from benchmarks.tables import table
from reference import roller_rig


def section() -> tuple[str, str]:
    """Return the agreement for the summary, and the text."""
    rows, largest = [], 0.0
    for case in roller_rig.CASES:
        found = roller_rig.solved(case)
        ours = -found.Fx, -found.Fy, -1e3 * found.Mz, 1e3 * found.approach, 1e-6 * found.max_pressure
        theirs = case.Fx, case.Fs, case.Mn, case.approach, case.largest
        shapes = ("{:.0f}", "{:.0f}", "{:.0f}", "{:.4f}", "{:.0f}")
        head = f"{1e3 * case.yaw:g} mrad, {case.N:.0f} N"
        rows.append([f"{head}: CONTACT", *(shape.format(v) for shape, v in zip(shapes, theirs, strict=True))])
        rows.append(["ours", *(shape.format(v) for shape, v in zip(shapes, ours, strict=True))])
        force = np.hypot(ours[0] - theirs[0], ours[1] - theirs[1]) / (roller_rig.FRICTION * case.N)
        largest = max(largest, 100.0 * float(force))
    finer = roller_rig.solved(roller_rig.CASES[-1], 0.2e-3)
    moved = 100.0 * abs(-finer.Fy / roller_rig.CASES[-1].Fs - 1.0)
    text = f"""## Roller rig

A wheel of 711 mm on a roller of 1600 mm, both with profiles as measured, dry, friction {roller_rig.FRICTION:g}, with an
elastic layer of 50 µm and 8200 MPa between them; the wheelset yaws. CONTACT's example `testbank/dry_10mph_13750lbs` (github
eve70a/CONTACT, commits 424e4e6 and 4cc09ad), its first three cases. Total forces of the first: Fx -1307, Fy -1252,
Fz 67 270 N. Our half space, on CONTACT's elements of .4 mm, takes its contact point, creepages and normal force
([set N](contact_features.md) tests the search).

{table(["yaw and normal force", "Fx [N]", "Fs [N]", "Mn [N mm]", "approach [mm]", "pressure [MPa]"], rows)}
![Pressure of the first case](proof/roller_rig.png)

Verdict: forces within {largest:.1f} % of friction times load, approaches within .6 %, largest pressures within 1.7 %.
CONTACT warns that its spline leaves the measured points by up to .2 mm. On elements of .2 mm the lateral force at 4 mrad
is {moved:.1f} % lower.
"""
    return f"forces within {largest:.1f} % of μN", text


def draw(path: Path) -> None:
    """Write the picture of the pressure and the stick zone."""
    found = roller_rig.solved(roller_rig.CASES[0], 0.2e-3)
    figure, axes = plt.subplots(figsize=(5.0, 3.8), layout="constrained")
    shown = axes.pcolormesh(1e3 * found.x, 1e3 * found.y, 1e-6 * np.ma.masked_less_equal(found.p, 0.0))
    figure.colorbar(shown, label="pressure [MPa]")
    axes.set(xlabel="x [mm], rolling →", ylabel="s [mm]", aspect="equal")
    figure.savefig(path, dpi=100)
    plt.close(figure)
