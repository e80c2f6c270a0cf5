"""Patches of yawed wheels: the default against elements on the same separation, and both against the true distance.

    python benchmarks/yawed_patches.py [--patches 160] [--seed 21] [--flange 1]

The poses are those of S1002 and EPS on 60E1 and 60E2 (1:20 and 1:40), y from -7 to 8 mm, with `--flange 1` from 3 to 8.5 mm,
yaw of 3 to 30 mrad either way, 20 to 150 kN, with random creepages. The patch with the largest load counts. Elements are 120 ×
120. The true distance is that of both surfaces in the plane of the patch; it is taken for patches beyond .6 rad, where the
separation's parabolas go through points beside the trace line.
"""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

import contact
from benchmarks.tables import read_options, table
from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.pair import SurfacePair
from contact.geometry.wheelset import Pair, Pose
from contact.halfspace import Gap
from contact.study.errors import mean_p95_max

ELEMENTS = 120
FRICTION = 0.3
FREE = contact.Creepage(0.0, 0.0, 0.0)
BOTH: dict[str, Any] = {"normal": "halfspace", "tangential": "halfspace", "n_strips": ELEMENTS, "n_elements": ELEMENTS}
#: Contact angle [rad] from which on a patch is held against the true distance.
STEEP = 0.6


def true_gap(pair: Pair, patch: Any, pose: Pose) -> Gap:
    """Return the distance of both surfaces over the plane of a patch that `pair` has found at `pose`."""
    surfaces = SurfacePair(*pair.profiles)
    surfaces.contacts(Pose(y=pose.y, yaw=pose.yaw, z=pair.z))
    frame = Frame.turned(np.array(patch.position), patch.angle)
    longest = 1.4 * math.sqrt(patch.approach / float(patch.separation.A.min()))
    x, y = np.linspace(-longest, longest, ELEMENTS), np.linspace(patch.edges[0], patch.edges[1], ELEMENTS)
    h = surfaces.distance(frame, x, y)
    return Gap(x, y, h - h.min())


def errors(found: contact.Solution, exact: contact.Solution, load: float) -> tuple[float, ...]:
    """Return errors of force over mu N, largest pressure, area and approach."""
    force = math.hypot(found.Fx - exact.Fx, found.Fy - exact.Fy) / (FRICTION * load)
    names = ("max_pressure", "area", "approach")
    return force, *(abs(getattr(found, name) / getattr(exact, name) - 1.0) for name in names)


def main() -> None:
    """Print a table."""
    options = read_options(__doc__, patches=160, seed=21, flange=0)
    rng = np.random.default_rng(options.seed)
    pairs = [
        Pair(profile.load(wheel, "wheel"), profile.load(rail, "rail", inclination=slope))
        for wheel in ("s1002", "eps")
        for rail in ("60E1", "60E2")
        for slope in ("1:40", "1:20")
    ]
    range_of_y = (3e-3, 8.5e-3) if options.flange else (-7e-3, 8e-3)
    rows: dict[str, list[tuple[float, ...]]] = {"strips, elements": [], "strips, true": [], "elements, true": []}
    warnings.simplefilter("ignore")
    count = 0
    while count < options.patches:
        pair = pairs[rng.integers(len(pairs))]
        pose = Pose(y=rng.uniform(*range_of_y), yaw=rng.uniform(3e-3, 30e-3) * rng.choice([-1.0, 1.0]))
        load = math.exp(rng.uniform(math.log(20e3), math.log(150e3)))
        longitudinal, lateral = (float(value) for value in rng.normal(0.0, 2e-3, 2))
        slip = contact.Creepage(longitudinal, lateral, rng.normal(0.0, 0.2))
        try:
            patch = max(pair.contacts(pose, load=load), key=lambda one: one.load or 0.0)
        except ContactError:
            continue
        count += 1
        carried = patch.load or 0.0
        given: dict[str, Any] = {"load": carried, "friction": FRICTION, "throw": False}
        strips = contact.solve(patch.separation, slip, **given)
        elements = contact.solve(patch.separation, slip, **BOTH, **given)
        rows["strips, elements"].append(errors(strips, elements, carried))
        if abs(patch.angle) > STEEP:
            exact = contact.solve(true_gap(pair, patch, pose), slip, **BOTH, **given)
            rows["strips, true"].append(errors(strips, exact, carried))
            rows["elements, true"].append(errors(elements, exact, carried))
    cells = [
        [name, str(len(values)), *(" / ".join(f"{v:.4f}" for v in mean_p95_max(one)) for one in np.array(values).T)]
        for name, values in rows.items()
        if values
    ]
    print(table(["answer, reference", "patches", "force", "largest pressure", "area", "approach"], cells))


if __name__ == "__main__":
    main()
