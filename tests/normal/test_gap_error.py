"""The error estimate of the normal problem."""

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.registry import GAP_LIMIT


def test_a_lobe_without_a_patch_is_seen():
    """ANALYN misses the second lobe of S1002 on 60E1 at y = 5 mm; its largest pressure is a third too low."""
    pair = Pair(profile.s1002(), profile.rail_60e1(inclination=1 / 40))
    (patch,) = (p for p in pair.contacts(Pose(y=5e-3, yaw=1e-3), load=80e3) if p.load)
    given = {"load": patch.load, "throw": False}
    missed = contact.solve(patch.separation, patch.creepage, **contact.THESIS, **given)
    both = contact.solve(patch.separation, patch.creepage, **given)
    assert (missed.n_patches, both.n_patches) == (1, 2)
    assert missed.max_pressure < 0.7 * both.max_pressure
    assert missed.gap_error > GAP_LIMIT
    assert both.gap_error < 0.01
