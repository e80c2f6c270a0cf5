"""The damage that a pair accumulates on both profiles equals that of `contact.accumulation` for the same patches."""

from dataclasses import replace

import numpy as np
import pytest

import contact
from contact.accumulation import MAXIMA, SUMS, Histogram
from contact.damage import WEAR_LAWS, DamageParameters
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.instance import workspace
from contact.kernels.rows import Bin, Body
from contact.pair import WheelRailPair

BODIES = {"wheel": profile.s1002(), "rail": profile.rail_60e1(1 / 20, breakpoints="UIC 519")}
VELOCITY = Velocity(forward=30.0)
#: Poses with contact on the tread, on tread and flange, on the flange root; metres rolled in each.
ROLLED = {Pose(y=1e-3, yaw=2e-3): 10.0, Pose(y=6.37e-3): 4.0, Pose(y=5.5e-3, yaw=5e-3): 2.0}
#: Methods whose answers do not depend on earlier calls.
METHODS = {**contact.THESIS, "n_strips": 20, "n_elements": 20}


def ledger(n_bins=100, first=-0.06, width=1e-3):
    rows = (np.stack((given.y, given.z)) for given in BODIES.values())
    return workspace.ledger(*rows, 20, n_bins, first, width)


def pair(side="right", law="archard", rail_wear=1.0, **options):
    damage = DamageParameters(wear_law=law, rail_wear=rail_wear)
    return WheelRailPair(Pair(*BODIES.values(), side=side), damage=damage, **{**METHODS, **options})


def rolled(pair, mirror=1.0):
    for pose, distance in ROLLED.items():
        pair.solve(Pose(y=mirror * pose.y, yaw=mirror * pose.yaw), VELOCITY, load=60e3, distance=distance)
    return pair.arrays.ledger.bins


@pytest.mark.parametrize("law", WEAR_LAWS)
def test_bins_are_those_of_the_histograms(law):
    run = pair(law=law, rail_wear=1.25, ledger=ledger())
    bins = rolled(run)
    for body, which in (("wheel", Body.WHEEL), ("rail", Body.RAIL)):
        wanted = Histogram(BODIES[body], width=1e-3, parameters=DamageParameters(wear_law=law, rail_wear=1.25))
        for pose, distance in ROLLED.items():
            z = pair(law=law).solve(pose, VELOCITY, load=60e3).z
            patches = run.pair.contacts(replace(pose, z=z), VELOCITY)
            solutions = [
                contact.solve(p.separation, p.creepage, approach=p.approach, speed=30.0, throw=False, **METHODS)
                for p in patches
            ]
            wanted.add(patches, solutions, distance=distance)
        offset = round(wanted.edges[0] / 1e-3) + 60
        for name, mine in zip(SUMS | MAXIMA, bins[which], strict=True):
            theirs = np.zeros(100)
            inside = np.arange(wanted.centres.size) + offset
            keep = (inside >= 0) & (inside < 100)
            theirs[inside[keep]] = wanted[name][keep]
            assert np.abs(wanted[name][~keep]).max(initial=0.0) == 0.0
            np.testing.assert_allclose(mine, theirs, rtol=1e-9, atol=1e-12 * np.abs(theirs).max(), err_msg=name)
            assert name.endswith("exceedance") or theirs.any(), name


@pytest.mark.parametrize(
    "methods", [METHODS, {"n_strips": 20, "normal": "strip_halfspace", "tangential": "fastrip_mapped"}]
)
@pytest.mark.parametrize("force", ["load", "vertical"])
def test_bins_under_a_force_are_those_at_the_height_that_carries_it(force, methods):
    under, at_height = pair(ledger=ledger(), **methods), pair(ledger=ledger(), **methods)
    for pose, distance in ROLLED.items():
        z = under.solve(pose, VELOCITY, distance=distance, **{force: 60e3}).z
        at_height.forget()
        at_height.solve(replace(pose, z=z), VELOCITY, distance=distance)
    assert under.arrays.ledger.bins.any()
    found, wanted = under.arrays.ledger.bins, at_height.arrays.ledger.bins
    if methods is METHODS:
        np.testing.assert_array_equal(found, wanted)
    else:  # with the noise of strips that start from another height, also where they end
        for row, right in zip(found.reshape(-1, found.shape[-1]), wanted.reshape(-1, wanted.shape[-1]), strict=True):
            np.testing.assert_allclose(
                row, right, rtol=0.0, atol=1e-3 * np.abs(right[np.isfinite(right)]).max(initial=0.0)
            )


def test_a_softer_rail_loses_more_and_nothing_else_changes():
    alike, softer = rolled(pair(ledger=ledger())).copy(), rolled(pair(rail_wear=1.25, ledger=ledger()))
    np.testing.assert_array_equal(softer[Body.WHEEL], alike[Body.WHEEL])
    worn = [Bin.WEAR, Bin.VOLUME]
    np.testing.assert_allclose(softer[Body.RAIL][worn], 1.25 * alike[Body.RAIL][worn], rtol=1e-12)
    others = [row for row in Bin if row not in worn]
    np.testing.assert_array_equal(softer[Body.RAIL][others], alike[Body.RAIL][others])


def test_left_side_is_the_mirror_image():
    right, left = rolled(pair(ledger=ledger())), rolled(pair("left", ledger=ledger()), mirror=-1.0)
    np.testing.assert_array_equal(left, right)


def test_bins_add_up_to_the_totals_even_if_the_contact_lies_outside():
    """Four bins around the tread. Damage outside belongs to the outer bins."""
    few, many = pair(ledger=ledger(4, -2e-3)), pair(ledger=ledger())
    T_gamma = volume = 0.0
    for pose, distance in ROLLED.items():
        for run in (few, many):
            damage = run.solve(pose, VELOCITY, load=60e3, distance=distance).damage
        T_gamma, volume = T_gamma + distance * damage.T_gamma, volume + distance * damage.archard_volume
    for run in (few, many):
        for body in run.arrays.ledger.bins:
            assert body[Bin.T_GAMMA].sum() == pytest.approx(T_gamma, rel=1e-12)
            assert body[Bin.VOLUME].sum() == pytest.approx(volume, rel=1e-12)


def test_growth_is_linear_and_zero_without_rolling_or_contact():
    run = pair(ledger=ledger())
    once = rolled(run).copy()
    for _ in range(4):
        rolled(run)
    for pose in ROLLED:
        run.solve(pose, VELOCITY, load=60e3)
    run.solve(Pose(), VELOCITY, load=0.0, distance=100.0)
    bins = run.arrays.ledger.bins
    np.testing.assert_allclose(bins[:, : len(SUMS)], 5.0 * once[:, : len(SUMS)], rtol=1e-13)
    np.testing.assert_array_equal(bins[:, Bin.ENERGY_INDEX_MAX], once[:, Bin.ENERGY_INDEX_MAX])


def test_laws_with_forces_only_accumulate_t_gamma_and_fatigue():
    bins = rolled(pair(ledger=ledger(), tangential="polach"))
    assert bins[:, Bin.T_GAMMA].sum() > 0.0
    assert not bins[:, [Bin.WEAR, Bin.VOLUME, Bin.ENERGY_INDEX, Bin.STRESS_EXCEEDANCE]].any()
