"""examples/exudyn_wheelset: an independent multibody program with wheel-rail forces of the native FMU."""

import numpy as np
import pytest


def test_wheelset_of_exudyn_hunts_like_our_own(native):
    """Two programs with the same bodies and springs, and contacts by another search of one plane."""
    pytest.importorskip("exudyn", reason="THE EXAMPLE WITH EXUDYN IS NOT TESTED: pip install exudyn")
    from examples.exudyn_wheelset import wheelset

    given = wheelset.on_rigid_track(28.0)
    theirs, own = wheelset.in_exudyn(native, given, 4e-3, 0.45), wheelset.our_own(given, 4e-3, 0.45)
    (frequency, growth), (own_frequency, own_growth) = wheelset.hunting(theirs), wheelset.hunting(own)
    assert wheelset.apart(theirs, own) < 0.01 * 4e-3
    assert np.abs(theirs.yaw - np.interp(theirs.time, own.time, own.yaw)).max() < 0.02 * np.abs(own.yaw).max()
    assert frequency == pytest.approx(own_frequency, rel=3e-3)
    assert growth == pytest.approx(own_growth, abs=0.03)
