"""How the default's answers settle with the number of strips: 20, 40, 80 and 160 on 200 patches of random poses.

    python benchmarks/resolution.py [--patches 200] [--seed 1]

The poses are those of S1002 on 60E1 (1:20 and 1:40) with loads of 20 to 150 kN, half of them with a yaw of up to 30 mrad. A
change is that from half the number of strips. The force is over mu N, all else relative.
"""

from __future__ import annotations

import math

import numpy as np

import contact
from benchmarks.tables import read_options, table
from contact.geometry import profile, wheelset
from contact.study.errors import mean_p95_max

STRIPS = (20, 40, 80, 160)
FRICTION = 0.3
#: Change that counts as none.
SMALL = 1e-3
CREEPAGE = contact.Creepage(0.0015, 0.001, 0.2)


def patches(count: int, seed: int) -> list[tuple[contact.Separation, float, bool]]:
    """Return separation, load [N] and whether the wheelset is yawed, for the largest patch of each pose."""
    rng, found = np.random.default_rng(seed), []
    pairs = [wheelset.Pair(profile.s1002(), profile.rail_60e1(inclination=i)) for i in (1 / 40, 1 / 20)]
    while len(found) < count:
        yawed = len(found) % 2 == 1
        pose = wheelset.Pose(y=rng.uniform(-6e-3, 8e-3), yaw=rng.uniform(-30e-3, 30e-3) if yawed else 0.0)
        load = math.exp(rng.uniform(math.log(20e3), math.log(150e3)))
        largest = max(pairs[len(found) // 2 % 2].contacts(pose, load=load), key=lambda patch: patch.load)
        found.append((largest.separation, largest.load, yawed))
    return found


def answers(separation: contact.Separation, load: float) -> np.ndarray:
    """Return largest pressure, area, approach, both forces over mu N, and whether it converged, for each of `STRIPS`."""
    rows = []
    for n in STRIPS:
        sol = contact.solve(separation, CREEPAGE, load=load, friction=FRICTION, n_strips=n, throw=False)
        scale = FRICTION * load
        rows.append((sol.max_pressure, sol.area, sol.approach, sol.Fx / scale, sol.Fy / scale, float(sol.converged)))
    return np.array(rows)


def main() -> None:
    arguments = read_options(__doc__, patches=200, seed=1)
    cases = patches(arguments.patches, arguments.seed)
    found, yawed = np.array([answers(separation, load) for separation, load, _ in cases]), [case[2] for case in cases]
    rows = []
    for title, chosen in (("no yaw", ~np.array(yawed)), ("yawed", np.array(yawed))):
        for k, n in enumerate(STRIPS[1:], 1):
            before, after = found[chosen, k - 1], found[chosen, k]
            good = (before[:, 5] == 1.0) & (after[:, 5] == 1.0)
            change = np.abs(after[good, :3] / before[good, :3] - 1.0)
            force = np.hypot(*(after[good, 3:5] - before[good, 3:5]).T)
            cells = [" / ".join(f"{x:.4f}" for x in mean_p95_max(values)) for values in (*change.T, force)]
            rows.append([title, f"{STRIPS[k - 1]} → {n}", *cells, str(np.sum(after[:, 5] == 0.0))])
    print(table(["patches", "strips", "largest pressure", "area", "approach", "force", "not converged"], rows))
    steps = np.abs(np.diff(found[:, :, 0], axis=1)) / found[:, :1, 0]
    calm = np.all((steps[:, 1:] <= steps[:, :-1]) | (steps[:, 1:] < SMALL), axis=1) & (found[:, :, 5] == 1.0).all(
        axis=1
    )
    print(f"\nChanges of the largest pressure that fall or are below {SMALL}: {calm.sum()} of {len(cases)} patches")


if __name__ == "__main__":
    main()
