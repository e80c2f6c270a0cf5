"""Runs at the ends of what scenarios take: a curve of a tram's depot, and walking pace."""

import warnings

import numpy as np
import pytest

from contact.errors import PlausibilityWarning
from contact_models.runs import scenario
from contact_models.runs.run import VehicleRun
from tests.vehicle.parts import completed

DEPOT = """name = "depot"
length = 12.0
speed = 3.0
[methods]
normal = "analyn"
tangential = "fastrip"
[recording]
settling = 1.0
[[track.curves]]
start = 1.0
radius = 15.0
length = 6.0
transition = 3.0
"""
WALK = 'name = "walk"\nlength = {}\nspeed = 0.1\n[recording]\nsettling = {}\nspacing = 0.01\n'


def made(path, text):
    file = path / "case.toml"
    file.write_text(text, encoding="utf-8")
    return VehicleRun(scenario.read(file))


@pytest.mark.slow
def test_a_wheelset_runs_through_a_curve_of_15_m(tmp_path):
    """The outer, left wheel runs at its flange; energy closes, no wheel lifts, and nearly all contacts have a solution."""
    run = completed(made(tmp_path, DEPOT))
    series, trust = run.series, run.trust
    inside = (series["distance"] > 6.0) & (series["distance"] < 8.5)
    assert series["curvature"][inside] == pytest.approx(1.0 / 15.0, rel=1e-2)
    assert series["wheelset_lateral"][inside].max() < -5e-3
    assert series["wheelset_left_contact_angle"][inside].min() > 0.3
    assert (series["wheelset_right_contact_angle"][inside] > -0.03).all()
    assert abs(trust.residual) < 0.05
    assert trust.lifted == 0
    assert trust.untrusted_share < 2e-3


def test_a_long_run_at_walking_pace_is_told_with_its_steps_and_hours(tmp_path):
    with pytest.warns(
        PlausibilityWarning, match=r"walk: at 0.1 m/s the stable step is 3.1e-06 s, so the run takes .* hours on"
    ):
        made(tmp_path, WALK.format(20.0, 1.0))


def test_a_short_run_at_walking_pace_ends_without_a_word(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error", PlausibilityWarning)
        run = made(tmp_path, WALK.format(0.02, 0.0))
    run.advance()
    assert run.trust.lifted == 0
    assert np.isfinite(run.series["wheelset_lateral"]).all()
