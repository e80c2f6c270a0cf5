"""Two lobes of interpenetration: when they share one plane, when each has its own, and the transition between these."""

import math

import numpy as np
import pytest

from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.kernels.geometry import search
from contact.kernels.geometry.settle import carried
from contact.kernels.records import LOBE, MAX_LOBES


def two_lobes(gap, degrees, steepness=0.0):
    """Return two lobes 2 mm wide. The straight line of length `gap` between their edges falls by `steepness` [rad]."""
    lobe = np.zeros(MAX_LOBES, LOBE)
    y, z = gap * math.cos(steepness), -gap * math.sin(steepness)
    for k, (edge, height, angle) in enumerate(((-2e-3, 0.0, -math.radians(degrees)), (y, z, 0.0))):
        lobe[k].low, lobe[k].high = edge, edge + 2e-3
        lobe[k].low_z = lobe[k].high_z = height
        lobe[k].weight, lobe[k].moment = 1.0, edge
        lobe[k].cosine, lobe[k].sine = math.cos(angle), math.sin(angle)
    return lobe


@pytest.mark.parametrize(
    ("gap", "degrees", "steepness", "patches"),
    [
        # gauge corner and face of a worn wheel, 37.5 degrees apart: only 4 mm in y (CONTACT 25.1: two patches)
        (12.87e-3, 37.5, 1.257, 2),
        (12.87e-3, 13.0, 0.2, 2),  # as in CONTACT, which uses only the distance
        (7.9e-3, 37.0, 1.2, 1),
        (12.87e-3, 9.9, 0.1, 1),  # nearly one plane, and lobes interact only in a common plane
    ],
)
def test_the_straight_distance_and_the_angle_decide(gap, degrees, steepness, patches):
    lobe = two_lobes(gap, degrees, steepness)
    assert search.combine(lobe, 2, 8e-3, math.radians(10.0), 4) == patches
    if patches == 2:
        assert lobe[1].tie == 0.0


def test_the_tie_falls_smoothly_from_1_to_0():
    ties = []
    for gap in np.linspace(7.9e-3, 10.1e-3, 221):
        lobe = two_lobes(gap, 40.0)
        ties.append(lobe[1].tie if search.combine(lobe, 2, 8e-3, math.radians(10.0), 4) == 2 else 1.0)
    assert ties[0] == 1.0
    assert ties[-1] == 0.0
    assert (np.diff(ties) <= 0.0).all()
    assert np.diff(ties).min() > -0.01


def test_the_shares_of_every_patch_add_up_to_one_and_there_are_no_more_than_allowed():
    for ties in [(0.3, 0.0, 0.0), (0.3, 0.6, 0.0), (0.3, 0.6, 0.9), (1.0, 0.5, 0.2)]:
        lobe = np.zeros(MAX_LOBES, LOBE)
        lobe[1:4]["tie"] = ties
        search.untie(lobe, 4, 4)
        runs = [(i, j, search.shared(lobe, 4, i, j)) for j in range(4) for i in range(j + 1)]
        for k in range(4):
            assert sum(share for i, j, share in runs if i <= k <= j) == pytest.approx(1.0, abs=1e-15)
        assert sum(share > 0.0 for *_, share in runs) <= 4


def forces(pair, y, height):
    """Return the number of patches, and vertical and lateral force of the pressures, at a fixed height."""
    n = pair.locate(Pose(y=y, z=height))
    vertical = carried(n, pair.space)
    patches = pair.patches[:n]
    normal = patches["share"] * patches["load"]
    return n, vertical, float((normal * np.sin(patches["angle"])).sum())


# S1002 on 60E1 1:20, where tread and gauge corner both carry. The vertical force of 80 kN once jumped by 54 and 21 kN in 2 µm
@pytest.mark.parametrize(("height", "distance"), [(2.2e-4, 5e-3), (1.8e-4, 8e-3), (2.4e-4, 4e-3)])
def test_forces_do_not_jump_as_one_plane_becomes_two(height, distance):
    pair = Pair(profile.s1002(), profile.rail_60e1(1 / 20, breakpoints="UIC 519"), combine_distance=distance)
    found = np.array([forces(pair, y, height) for y in np.arange(5.9e-3, 6.44e-3, 2e-6)])
    assert len(set(found[:, 0])) > 2
    change = np.abs(np.diff(found[:, 1:], axis=0))
    assert change.max() < 5e3


def test_the_vertical_load_is_the_sum_of_the_shares_of_all_patches():
    pair = Pair(profile.s1002(), profile.rail_60e1(1 / 20, breakpoints="UIC 519"))
    patches = pair.contacts(Pose(y=6.365e-3), load=80e3)
    assert len(patches) == 3
    assert sum(p.share * p.load * math.cos(p.angle) for p in patches) == pytest.approx(80e3, rel=1e-9)
