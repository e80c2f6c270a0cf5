"""examples/exudyn_wheelset: an independent multibody program with wheel-rail forces of the native FMU."""

import numpy as np
import pytest

from contact_models.wheelset.parameters import WheelsetParameters


def test_wheelset_of_exudyn_hunts_like_our_own(native):
    """Six degrees of freedom on elastic contacts agree with loads in equilibrium: 0.5 % of the amplitude at 28 m/s, 4 mm."""
    pytest.importorskip("exudyn", reason="THE EXAMPLE WITH EXUDYN IS NOT TESTED: pip install exudyn")
    from examples.exudyn_wheelset import wheelset

    p = wheelset.settled(WheelsetParameters(speed=28.0, lateral=4e-3))
    theirs, own = wheelset.in_exudyn(native, p, 0.45), wheelset.our_own(p, 0.45)
    (frequency, growth), (own_frequency, own_growth) = wheelset.hunting(theirs), wheelset.hunting(own)
    assert np.abs(theirs.lateral - own.lateral).max() < 0.01 * p.lateral
    assert np.abs(theirs.yaw - own.yaw).max() < 0.02 * np.abs(own.yaw).max()
    assert frequency == pytest.approx(own_frequency, rel=3e-3)
    assert growth == pytest.approx(own_growth, abs=0.03)
