"""Profiles for `WheelRailPair` that the command line names."""

import numpy as np
import pytest

from contact.cli import arguments
from contact.errors import ContactError
from contact.geometry import profile


def chosen(rail: object, smoothing: float | None = None) -> dict[str, profile.Profile]:
    reading = arguments.Reading(profile_unit="m", profile_side="right", profile_smoothing=smoothing)
    return reading.chosen("S1002", str(rail))


def test_measured_profiles_are_smoothed_on_request(tmp_path):
    """Files are smoothed as by `contact.geometry.profile.read`. Profiles given by name are not smoothed."""
    pytest.importorskip("scipy")
    rail, path = profile.named("49E1"), tmp_path / "rail.txt"
    noise = 2e-6 * np.random.default_rng(5).standard_normal(rail.y.size)
    np.savetxt(path, np.stack((rail.y, rail.z + noise), axis=1))
    found = chosen(path, 2e-6)
    wanted = profile.read(path, kind="rail", unit="m", side="right", smoothing=2e-6)
    np.testing.assert_array_equal(found["rail"].angle, wanted.angle)
    assert np.abs(found["rail"].angle - chosen(path)["rail"].angle).max() > 1e-2
    np.testing.assert_array_equal(found["wheel"].angle, profile.s1002().angle)
    with pytest.raises(ContactError, match="smoothing = 1 is outside"):
        chosen(path, 1.0)
