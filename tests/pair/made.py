"""Pairs and motions for the tests of `WheelRailPair`."""

import numpy as np

from contact.geometry import profile
from contact.geometry.wheelset import Irregularity, Pair, Pose, Velocity
from contact.pair import WheelRailPair

R0 = 0.460
WHEEL, RAIL = profile.s1002(), profile.rail_60e1()
#: The gauge corner clears the flange root, so tread and flange touch at the same time, far apart, around y = 6.37 mm.
WORN = profile.rail_60e1(1 / 20, breakpoints="UIC 519")


def make(side="right", rail=RAIL, **options) -> WheelRailPair:
    return WheelRailPair(Pair(WHEEL, rail, side=side), **options)


def random_motion(seed: int) -> tuple[Pose, Velocity, Irregularity]:
    """Return a random motion, from field side contact to flange contact, with all rates."""
    rng = np.random.default_rng(seed)
    pose = Pose(rng.uniform(-8e-3, 8e-3), rng.uniform(0.0, 4e-4), *rng.uniform(-0.02, 0.02, 2))
    V = rng.uniform(5.0, 60.0)
    velocity = Velocity(V, *rng.uniform(-0.05, 0.05, 4), spin=-V / R0 * rng.uniform(0.997, 1.003))
    return pose, velocity, Irregularity(*(rng.uniform(-1, 1, 6) * [1e-3, 1e-3, 5e-3, 0.02, 0.02, 0.05]))
