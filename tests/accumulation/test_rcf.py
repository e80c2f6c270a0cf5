"""Burstow's index over the position on a profile: its direction, and its agreement with the index of the patch."""

import numpy as np
import pytest

import contact
from contact.accumulation import Histogram, load, save
from contact.damage import Burstow, DamageParameters, evaluate
from contact.geometry.profile import named, rail_60e1
from contact.geometry.wheelset import Pair, Pose, Velocity

WHEEL, RAIL = named("S1002"), rail_60e1()


def rolled(profile, spin: float, pose: Pose | None = None, parameters: DamageParameters | None = None):
    """Return the histogram of ten metres, and the indices of the patches. The spin differs by a share from free rolling."""
    velocity = Velocity(forward=20.0, spin=-20.0 / 0.46 * (1.0 + spin))
    patches = Pair(WHEEL, RAIL).contacts(pose or Pose(), velocity, load=60e3)
    solutions = [contact.solve(p.separation, p.creepage, load=p.load, n_strips=20, n_elements=20) for p in patches]
    histogram = Histogram(profile, parameters=parameters)
    histogram.add(patches, solutions, distance=10.0)
    return histogram, [evaluate(s, parameters=parameters).burstow for s in solutions], solutions


@pytest.mark.parametrize(("spin", "forward"), [(2e-3, True), (-2e-3, False)], ids=["driven", "braked"])
def test_cracks_grow_in_the_rail_under_a_driven_wheel_and_in_a_braked_wheel(spin, forward):
    on_rail, indices, solutions = rolled(RAIL, spin)
    on_wheel = rolled(WHEEL, spin)[0]
    assert (solutions[0].Fx > 0.0) == forward
    assert indices[0] != 0.0
    counted, other = (on_rail, on_wheel) if forward else (on_wheel, on_rail)
    assert not other.fatigue.any()
    whole = counted["contact"] > 9.999  # bins that the patch covers whole
    assert whole.any()
    assert counted.fatigue[whole] == pytest.approx(indices[0], rel=1e-3)  # strips are measured along the profile
    assert not counted.fatigue[counted["contact"] == 0.0].any()


def test_the_wear_branch_is_negative_and_the_floor_is_left_to_who_accumulates():
    """Beyond 175 N wear removes cracks faster than they grow."""
    hard, indices, _ = rolled(RAIL, 14e-3)
    assert indices[0] < 0.0
    assert hard.fatigue.min() == pytest.approx(indices[0], rel=1e-3)
    clipped = rolled(RAIL, 14e-3, parameters=DamageParameters(burstow=Burstow(clip_negative=True)))[0]
    assert not clipped.fatigue.any()


def test_an_index_adds_up_scales_and_survives_a_file(tmp_path):
    pytest.importorskip("xarray")
    once = rolled(RAIL, 2e-3)[0]
    save(once.scaled(3.0) + once, tmp_path / "h.nc")
    stored = load(tmp_path / "h.nc")
    assert stored["rcf_forward"] == pytest.approx(4.0 * once["rcf_forward"], rel=1e-13)
    assert stored.fatigue == pytest.approx(once.fatigue, rel=1e-13)
    assert Histogram(RAIL).fatigue.any() == np.False_
