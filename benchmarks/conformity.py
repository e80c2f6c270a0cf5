"""Effect of the varying contact angle on a worn pair of profiles.

    python benchmarks/conformity.py [--depth 1e-3] [--new]

S1002 and 60E1 (1:40) wear in steps by Archard's law with the map of KTH, over a fixed mix of lateral positions and yaw angles,
until each has lost `--depth` at its deepest point. A sweep over lateral positions then solves every patch twice: in its plane
and conformal (`contact.kernels.conformal`). `--new` sweeps the unworn pair instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

import contact
from benchmarks.tables import read_options
from contact.accumulation import Histogram, worn_profile
from contact.damage import evaluate
from contact.geometry import profile
from contact.geometry.profile import Profile
from contact.geometry.records import Patch
from contact.geometry.wheelset import Pair, Pose, Velocity

LOAD, FRICTION, SPEED = 80e3, 0.3, 20.0
#: Mean and spread [m] of the lateral positions on straight track and in curves (flange root); yaw [rad] per metre of position.
MIX = ((0.0, 2.0e-3), (5.5e-3, 1.0e-3))
YAW = 1.0
#: Greatest wear depth in a step and smoothing width [m].
STEP, SMOOTHING = 5e-5, 2e-3
SWEEP = np.array([-2.0, 0.0, 2.0, 4.0, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5]) * 1e-3


def mix() -> Iterator[tuple[float, float]]:
    """Yield (lateral position [m], weight)."""
    for mean, spread in MIX:
        for t in np.linspace(-2.0, 2.0, 17).tolist():
            yield mean + spread * t, math.exp(-0.5 * t * t)


def patches(pair: Pair, y: float) -> list[Patch]:
    """Return the patches of the right wheel under the load."""
    return list(pair.contacts(Pose(y=y, yaw=YAW * y), Velocity(SPEED), load=LOAD))


def solve(patch: Patch, conformal: bool, n_strips: int = 30) -> contact.Solution:
    """Solve a patch with ANALYN and FaStrip."""
    options = {"friction": FRICTION, "speed": SPEED, "n_strips": n_strips, "throw": False}
    return contact.solve(patch.separation, patch.creepage, load=patch.load, conformal=conformal, **options)


def lost(body: Histogram) -> float:
    """Return the greatest smoothed wear depth [m]."""
    after = worn_profile(body, smoothing=SMOOTHING)
    return float(np.hypot(after.y - body.profile.y, after.z - body.profile.z).max())


def wear(wheel: Profile, rail: Profile, depth: float) -> tuple[Profile, Profile]:
    """Return both profiles after `depth` [m] of wear, with each patch solved in its plane."""
    for _ in range(round(depth / STEP)):
        pair, bodies = Pair(wheel, rail), (Histogram(wheel), Histogram(rail))
        for y, weight in mix():
            found = patches(pair, y)
            solutions = [solve(patch, conformal=False) for patch in found]
            for body in bodies:
                body.add(found, solutions, distance=weight)
        wheel, rail = (worn_profile(body, STEP / lost(body), smoothing=SMOOTHING) for body in bodies)
    return wheel, rail


def row(pair: Pair, y: float) -> str:
    """Return a row of the table.

    For each patch: angle, variation of the angle, load. For all patches, plane → conformal: forces on the wheel, wear.
    """
    found = patches(pair, y)
    sums, deepest = np.zeros((2, 4)), np.zeros(2)
    told = []
    for patch in found:
        c, s = math.cos(patch.angle), math.sin(patch.angle)
        for k in range(2):
            sol = solve(patch, conformal=k == 1, n_strips=60)
            own = sol.Fx, sol.Fy * c + sol.N * s, sol.N * c - sol.Fy * s, sol.Mz
            sums[k] += patch.share * np.array(own)
            deepest[k] = max(deepest[k], evaluate(sol, patch.rolling_radius).archard.depth_max)
        turn = np.degrees(
            np.arctan(np.interp(sol.patch_edges.ravel()[[0, -1]], patch.separation.y, patch.separation.tilt))
        )
        told.append((math.degrees(patch.angle), *turn, 1e-3 * patch.share * sol.N))
    angle, turn, load = (
        " / ".join(text.format(*each) for each in told) for text in ("{0:.1f}", "{1:.1f} … {2:.1f}", "{3:.1f}")
    )
    forces = [f"{a:.2f} → {b:.2f}" for a, b in 1e-3 * sums[:, :3].T]
    depth = "{:.2f} → {:.2f}".format(*(1e9 * deepest))
    return " | ".join((f"{1e3 * y:g}", angle, turn, load, *forces, "{:.1f} → {:.1f}".format(*sums[:, 3]), depth))


def main() -> None:
    arguments = read_options(__doc__, depth=1e-3, new=False)
    wheel, rail = profile.s1002(), profile.rail_60e1(inclination=1 / 40)
    if not arguments.new:
        wheel, rail = wear(wheel, rail, arguments.depth)
    heads = (
        "y [mm]",
        "γ [°]",
        "Δ [°]",
        "N [kN]",
        "Fx [kN]",
        "lateral [kN]",
        "vertical [kN]",
        "Mz [N m]",
        "wear [nm/m]",
    )
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}")
    pair = Pair(wheel, rail)
    for y in SWEEP.tolist():
        print(f"| {row(pair, y)} |")


if __name__ == "__main__":
    main()
