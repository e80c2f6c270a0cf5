"""A small change of the pose causes a small change of the patch, from the field side to full flange contact."""

import numpy as np
import pytest

from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose

#: One plane for every pose, so that no new patches appear.
ONE_PLANE = {"combine_distance": 1.0}

WHEEL = profile.s1002()
RAILS = {"1:40": profile.rail_60e1(), "1:20": profile.rail_60e1(1 / 20, breakpoints="UIC 519")}


def sweep(pair, y, yaw, how):
    rows = []
    for value in y:
        (patch,) = pair.contacts(Pose(y=value, yaw=yaw), **how)
        creepage = patch.creepage
        rows.append((patch.angle, 10 * patch.position[1], 1e3 * patch.approach, *(100 * c for c in (
            creepage.longitudinal, creepage.lateral, 0.01 * creepage.spin))))  # fmt: skip
    return np.array(rows)


@pytest.mark.parametrize("rail", ["1:40", "1:20"])
@pytest.mark.parametrize("yaw", [0.0, 0.01])
@pytest.mark.parametrize("how", [{"penetration": 8e-5}, {"load": 80e3}], ids=["penetration", "load"])
def test_every_output_is_continuous_over_sixteen_millimetres(rail, yaw, how):
    pair = Pair(WHEEL, RAILS[rail], **ONE_PLANE)
    step = 1e-5
    y = np.arange(-8e-3, 8e-3 + step / 2, step)
    change = np.abs(np.diff(sweep(pair, y, yaw, how), axis=0))
    # a steep change (from tread to flange) is allowed, a jump is not, since it would not shrink with the step
    for column in range(change.shape[1]):
        i = int(change[:, column].argmax())
        fine = np.abs(np.diff(sweep(pair, np.linspace(y[i], y[i + 1], 41), yaw, how), axis=0))[:, column].max()
        assert fine < 0.2 * change[i, column] + 1e-7, f"output {column} jumps at y = {y[i]:g} m"
    assert np.median(change[:, 0]) < 2e-3


def test_patches_come_and_go_without_flicker():
    pair = Pair(WHEEL, RAILS["1:20"])
    counts = [len(pair.contacts(Pose(y=y), load=80e3)) for y in np.arange(6.2e-3, 6.5e-3, 1e-6)]
    assert max(counts) <= 4  # in the transition from one plane to two
    assert np.count_nonzero(np.diff(counts)) <= 5  # in and out of the transition


def test_a_patch_that_just_appears_is_small_and_finite():
    pair = Pair(WHEEL, RAILS["1:40"])
    for depth in (1e-6, 1e-8, 1e-10):
        (patch,) = pair.contacts(Pose(y=1e-3), penetration=depth)
        assert 0.0 < patch.approach <= depth
        assert patch.edges[1] - patch.edges[0] < 20 * np.sqrt(depth)
        assert np.isfinite(patch.separation.g).all()
