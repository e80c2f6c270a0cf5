"""Impact of a wheel with a flat at several speeds: the largest contact force over the speed.

    python examples/wheel_flat/wheel_flat.py [FOLDER]

The wheel's unsprung mass carries a constant load and rolls over a rail that is a mass on a spring and a damper (one degree of
freedom each). The contact force depends on the penetration and on the angle of the wheel. It is taken from a table that the
contact search on the surfaces fills before (`contact.geometry.surfaces`, normal forces by strip_halfspace), so the flat's
shape, its curvature within the patch and the contact ahead of the axle are those of the surface. Quasi-static in friction.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from contact.arrays import Array
from contact.geometry import profile
from contact.geometry.surfaces import Flat, SurfacePair, WheelSurface
from contact.geometry.wheelset import Pose
from contact.pair import WheelRailPair

RADIUS = 0.460


class Model(NamedTuple):
    """Chosen numbers, of the usual size: load [N], unsprung mass of half a wheelset [kg], rail: mass, stiffness, damping."""

    load: float = 8e4
    wheel: float = 700.0
    rail: float = 120.0
    stiffness: float = 70e6
    damping: float = 60e3


class Table(NamedTuple):
    """Height of first touch [m] over the angle [rad], and F^(2/3) over angle and penetration [m]."""

    angle: Array
    touch: Array
    depth: Array
    force: Array

    @classmethod
    def of(cls, flat: Flat, angles: int = 61, deepest: float = 4e-4, steps: int = 9) -> Table:
        """Fill the table for a wheel S1002 on a rail 60E1."""
        pair = SurfacePair(WheelSurface.constant(profile.s1002(), flat), profile.rail_60e1())
        half = 0.5 * flat.length / RADIUS
        angle, depths = np.linspace(-2.0 * half, 2.0 * half, angles), np.linspace(0.0, 1.0, steps) ** 2 * deepest
        touch, force = np.empty(angles), np.zeros((angles, steps))
        solver = WheelRailPair(pair)
        for i, at in enumerate(angle.tolist()):
            for j, depth in enumerate(depths.tolist()):
                found = solver.solve(Pose(), rotation=at, penetration=depth, friction=0.0)
                touch[i], force[i, j] = found.z - depth, found.Q
        return cls(angle, touch, depths, force ** (2.0 / 3.0))

    def at(self, angle: float, z: float) -> float:
        """Return the contact force [N] of the wheel at the height z [m] above an unmoved rail. Beyond the table it is round."""
        t = np.clip((angle - self.angle[0]) / (self.angle[1] - self.angle[0]), 0.0, self.angle.size - 1.000001)
        i = int(t)
        w = t - i
        depth = z - (1.0 - w) * self.touch[i] - w * self.touch[i + 1]
        if depth <= 0.0:
            return 0.0
        row = (1.0 - w) * self.force[i] + w * self.force[i + 1]
        j = min(int(np.searchsorted(self.depth, depth)), self.depth.size - 1)
        slope = (row[j] - row[j - 1]) / (self.depth[j] - self.depth[j - 1])
        return float(max(row[j - 1] + slope * (depth - self.depth[j - 1]), 0.0) ** 1.5)


def run(table: Table, speed: float, model: Model, step: float = 1e-5) -> tuple[Array, Array]:
    """Return angles and contact forces [N] of one passage of the flat at a `speed` [m/s], by the symplectic Euler method."""
    begin, end = 1.5 * table.angle[0], table.angle[-1] + 0.04 * speed / RADIUS
    n = int((end - begin) * RADIUS / speed / step)
    rail = model.load / model.stiffness
    wheel = rail + _static(table, model.load)
    v_wheel = v_rail = 0.0
    angles, forces = np.linspace(begin, end, n), np.empty(n)
    for k, angle in enumerate(angles.tolist()):
        force = table.at(angle, wheel - rail)
        v_wheel += step * (model.load - force) / model.wheel
        v_rail += step * (force - model.stiffness * rail - model.damping * v_rail) / model.rail
        wheel += step * v_wheel
        rail += step * v_rail
        forces[k] = force
    return angles, forces


def _static(table: Table, load: float) -> float:
    """Return the height [m] at which the round wheel carries the load."""
    return float(table.touch[0] + np.interp(load ** (2.0 / 3.0), table.force[0], table.depth))


def main() -> None:
    """Write the picture, and print the largest forces."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
    folder.mkdir(exist_ok=True)
    speeds = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0, 40.0])
    model = Model()
    figure = Figure(figsize=(7.4, 6.0), dpi=150, layout="constrained")
    above, below = figure.subplots(2, 1)
    for length, colour in ((0.03, "#1f5fa8"), (0.05, "#d1602c"), (0.07, "#2b8a57")):
        table = Table.of(Flat(length))
        runs = [run(table, float(v), model) for v in speeds]
        peaks = np.array([forces.max() for _, forces in runs])
        lost = [int((forces == 0.0).any()) for _, forces in runs]
        print(f"flat of {1e3 * length:.0f} mm: largest force [kN]", np.round(1e-3 * peaks, 1), "lifted", lost)
        label = f"{1e3 * length:.0f} × {1e3 * float(Flat(length).depth):.2f} mm"  # type: ignore[arg-type]
        above.plot(3.6 * speeds, 1e-3 * peaks, "o-", ms=3.0, color=colour, label=label)
        if length == 0.05:
            for k in (2, 7, 12):
                angles, forces = runs[k]
                t = 1e3 * angles * RADIUS / speeds[k]
                below.plot(t, 1e-3 * forces, label=f"{3.6 * speeds[k]:.0f} km/h", lw=1.0)
    above.axhline(1e-3 * model.load, color="#8a9099", lw=0.8)
    above.set(xlabel="speed [km/h]", ylabel="largest contact force [kN]", ylim=(0.0, None))
    below.set(
        xlabel="time from the middle of the flat [ms]",
        ylabel="contact force [kN]",
        xlim=(-20.0, 40.0),
        ylim=(0.0, None),
    )
    for ax in (above, below):
        ax.grid(visible=True, color="#eceef1")
        ax.legend(frameon=False)
    figure.savefig(folder / "wheel_flat.png")


if __name__ == "__main__":
    main()
