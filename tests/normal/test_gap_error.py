"""The error estimate of the normal problem."""

import numpy as np
import pytest

import contact
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from contact.registry import GAP_LIMIT, GAP_LIMIT_INTERACTING


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


@pytest.mark.parametrize("length", [1.9e-3, 2e-3])
def test_waves_that_strips_do_not_see_are_told_about_as_large_as_they_are(length):
    """Rounded coordinates leave waves of about a micrometre. 20 strips of about 1.6 mm do not see these, 80 do."""
    y = np.linspace(-0.03, 0.03, 401)
    waves = 0.75e-6 * np.cos(2.0 * np.pi * y / length)
    creepage, load = contact.Creepage(), 80e3
    smooth, rough = (contact.Separation(y, 0.3 * y**2 + wave, np.full(y.size, 1.1)) for wave in (0.0, waves))
    few, many = (contact.solve(rough, creepage, load=load, n_strips=n, throw=False) for n in (20, 80))
    left = 1.0 - few.max_pressure / many.max_pressure
    assert left > 0.15
    assert 0.7 * left < few.gap_error < 1.3 * left
    assert many.gap_error < 0.25 * few.gap_error
    assert few.gap_error > GAP_LIMIT_INTERACTING > contact.solve(smooth, creepage, load=load).gap_error
