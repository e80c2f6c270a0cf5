"""Profiles for `WheelRailPair` that the command line names."""

import argparse

import numpy as np
import pytest

from contact.errors import ContactError
from contact.geometry import profile
from contact_fmu import profiles


def chosen(*words: object) -> dict[str, profile.Profile]:
    parser = argparse.ArgumentParser()
    profiles.add_options(parser)
    return profiles.chosen(parser.parse_args([str(word) for word in words]))


def test_measured_profiles_are_smoothed_on_request(tmp_path):
    """Files are smoothed as by `contact.geometry.profile.read`. Profiles given by name are not smoothed."""
    pytest.importorskip("scipy")
    rail, path = profile.named("49E1"), tmp_path / "rail.txt"
    noise = 2e-6 * np.random.default_rng(5).standard_normal(rail.y.size)
    np.savetxt(path, np.stack((rail.y, rail.z + noise), axis=1))
    words = ("--rail", path, "--wheel", "S1002", "--profile-unit", "m", "--profile-side", "right")
    words += ("--profile-smoothing", 2e-6)
    found = chosen(*words)
    wanted = profile.read(path, kind="rail", unit="m", side="right", smoothing=2e-6)
    np.testing.assert_array_equal(found["rail"].angle, wanted.angle)
    assert np.abs(found["rail"].angle - chosen(*words[:-2])["rail"].angle).max() > 1e-2
    np.testing.assert_array_equal(found["wheel"].angle, profile.s1002().angle)
    with pytest.raises(ContactError, match="smoothing = 1 is outside"):
        chosen(*words[:-1], 1.0)
