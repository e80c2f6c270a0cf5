"""Contact geometry of S1002 on UIC 60 against CONTACT: positions, angles, spins, penetrations, pressures.

    python benchmarks/geometry_table.py [wheel_rail.csv]

Geometry is compared at CONTACT's height of the wheelset. Pressure and penetration are compared at the same vertical load,
80 kN; ours are ANALYN's. Creepages are wheel minus rail over the forward speed. CONTACT's numbers are converted to this: their
sign changes, and they are multiplied by its mean rolling speed over the forward speed. CONTACT's longitudinal creepage refers
to the wheel's plane of first contact, ours to the wheel's surface opposite the reference point. They differ by design.
"""

import sys
from pathlib import Path

import numpy as np

import contact
import reference
from contact.geometry import profile, wheelset

LOAD = 80e3  # [N]
NOMINAL_RADIUS = 0.460


def pairs() -> dict[tuple[str, str], wheelset.Pair]:
    """Return the profiles of the benchmark: the rail inclined 1:40, and that rail turned by another 0.025 rad."""
    wheel = profile.s1002()
    rail = profile.rail_60e1(1 / 40, breakpoints="UIC 519")
    rails = {"1:40": rail, "1:20": rail.rotated(-0.025)}
    sides = {"R": "right", "L": "left"}
    return {(c, s): wheelset.Pair(wheel, rails[c], side=sides[s]) for c in rails for s in sides}


def main(rows: reference.Rows) -> None:
    """Print the table and the mean and largest deviations."""
    table = pairs()
    print(
        "              position y [mm]      angle [rad]      spin [1/km]   xi [1e-3]     at CONTACT's z:     under 80 kN:"
    )
    print("rail side dy     ours    diff     ours    diff     ours   diff   ours   diff  depth [um] diff   depth diff   "
          "pmax [MPa] CONTACT  its ANALYN")  # fmt: skip
    deviations = []
    for row in rows:
        pair = table[row["cant"], row["side"]]
        pose = wheelset.Pose(y=1e-3 * float(row["dy"]), z=1e-3 * float(row["z"]))
        (patch,) = pair.contacts(pose)
        (loaded,) = pair.contacts(pose, load=LOAD)
        solution = contact.solve(loaded.separation, loaded.creepage, load=loaded.load)
        mean_speed = 0.5 * (1.0 + patch.rolling_radius / NOMINAL_RADIUS)
        y, angle = float(row["y_track"]), float(row["angle"])
        depth, pmax, analyn = (float(row[k]) for k in ("penetration", "pmax", "pmax_analyn"))
        phi, xi = -1e6 * float(row["phi"]) * mean_speed, -1e3 * float(row["xi"]) * mean_speed
        own = 1e-6 * solution.max_pressure
        deviation = (
            1e3 * patch.position[1] - y,
            patch.angle - angle,
            1e3 * patch.creepage.spin - phi,
            1e3 * patch.creepage.longitudinal - xi,
            1e6 * patch.approach - 1e3 * depth,
            1e6 * loaded.approach - 1e3 * depth,
            100.0 * (own / pmax - 1.0),
            100.0 * (own / analyn - 1.0),
        )
        deviations.append(deviation)
        print(
            f"{row['cant']} {row['side']} {row['dy']:>3}  {1e3 * patch.position[1]:9.3f} {deviation[0]:6.3f} "
            f"{patch.angle:8.4f} {deviation[1]:8.5f} {1e3 * patch.creepage.spin:7.1f} {deviation[2]:5.1f} "
            f"{1e3 * patch.creepage.longitudinal:7.3f} {deviation[3]:6.3f} {1e6 * patch.approach:8.2f} {deviation[4]:6.2f} "
            f"{1e6 * loaded.approach:8.2f} {deviation[5]:5.1f}   {own:6.0f} {deviation[6]:+6.1f} % {deviation[7]:+6.1f} %"
        )
    names = (
        "y [mm]",
        "angle [rad]",
        "spin [1/km]",
        "xi [1e-3]",
        "depth [um]",
        "loaded depth [um]",
        "pmax [%]",
        "to ANALYN [%]",
    )
    print("\ndeviation           mean      max")
    for name, column in zip(names, np.abs(np.array(deviations)).T, strict=True):
        print(f"{name:18} {column.mean():8.5f} {column.max():8.5f}")


if __name__ == "__main__":
    main(reference.rows(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else reference.wheel_rail())
