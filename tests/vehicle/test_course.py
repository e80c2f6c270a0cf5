"""Tracks of vehicles: plan, cant, irregularities, measured series, friction."""

import math
from pathlib import Path

import numpy as np
import pytest

from contact.errors import ContactError
from contact_models.vehicle.course import BEYOND, SPACING, lay
from contact_models.vehicle.kernels.layout import TrackRow
from contact_models.vehicle.spectra import Irregularities
from contact_models.vehicle.track import Curve, Friction, Track

CURVE = Curve(start=20.0, radius=300.0, length=60.0, transition=30.0, cant=0.15)


def rows(track: Track, length: float = 200.0, settling: float = 0.0) -> np.ndarray:
    return lay(track, length, lambda s: 20.0, (3,), settling)


def at(s: float) -> int:
    return round((s + BEYOND) / SPACING)


def test_plan_is_a_circle_after_its_transition():
    """Three points of the circle lie on its radius; the whole curve turns by (length + transition)/radius."""
    found = rows(Track(curves=(CURVE,)))
    assert found[TrackRow.DIRECTION, -1] == pytest.approx(90.0 / 300.0, rel=1e-9)
    a, b, c = (found[[TrackRow.X, TrackRow.Y], at(s)] for s in (55.0, 80.0, 105.0))
    sides = [math.dist(p, q) for p, q in ((a, b), (b, c), (c, a))]
    area = 0.5 * abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]))
    assert math.prod(sides) / (4.0 * area) == pytest.approx(300.0, rel=1e-6)
    assert found[TrackRow.Y, -1] > 0.0  # to the right


def test_cant_lifts_the_left_rail_in_a_curve_to_the_right():
    found = rows(Track(curves=(CURVE,)))
    assert found[TrackRow.CANT, at(80.0)] == pytest.approx(math.asin(0.1))
    assert found[TrackRow.CANT, at(0.0)] == 0.0
    inside = slice(at(10.0), at(150.0))
    slope = np.gradient(found[TrackRow.CANT, inside], SPACING)
    assert np.abs(slope - found[TrackRow.CANT_SLOPE, inside])[1:-1].max() < 1e-12


def test_channels_move_the_rails_as_their_names_say():
    """Alignment moves both alike, gauge apart, cross-level lowers the right rail where the left lies higher."""
    for channel, row, sign in (
        ("alignment", TrackRow.RIGHT_Y, 1.0),
        ("vertical", TrackRow.RIGHT_Z, 1.0),
        ("cross_level", TrackRow.RIGHT_Z, -1.0),
        ("gauge", TrackRow.RIGHT_Y, -1.0),
    ):
        found = rows(Track(**{channel: Irregularities(spectrum="ERRI B176 low")}))
        left = row + TrackRow.LEFT_Y - TrackRow.RIGHT_Y
        assert found[row].std() > 1e-5
        np.testing.assert_allclose(found[left], sign * found[row], atol=1e-18)
        others = {int(TrackRow.RIGHT_Y), int(TrackRow.RIGHT_Z)} - {int(row)}
        assert not any(found[other].any() for other in others)


def test_channels_are_independent():
    both = Irregularities(spectrum="ERRI B176 low")
    found = rows(Track(alignment=both, vertical=both), length=2000.0)
    assert abs(np.corrcoef(found[TrackRow.RIGHT_Y], found[TrackRow.RIGHT_Z])[0, 1]) < 0.3


def test_measured_series_passes_through_its_values(tmp_path):
    s = np.arange(0.0, 100.0, 2.0)
    table = np.stack((s, 1e-3 * np.sin(0.3 * s), 2e-3 * np.cos(0.2 * s), 0.0 * s, 1e-3 + 0.0 * s), axis=1)
    np.savetxt(
        tmp_path / "track.csv",
        table,
        delimiter=",",
        header="distance,alignment,vertical,cross_level,gauge",
        comments="",
    )
    found = rows(Track(measured=str(tmp_path / "track.csv")), length=90.0)
    for place in (10.0, 40.0):
        k = int(place / 2.0)
        assert found[TrackRow.RIGHT_Y, at(place)] == pytest.approx(table[k, 1] + 0.5e-3, abs=1e-9)
        assert found[TrackRow.LEFT_Z, at(place)] == pytest.approx(table[k, 2], abs=1e-9)
    inside = slice(at(5.0), at(85.0))
    slope = np.gradient(found[TrackRow.RIGHT_Y, inside], SPACING)
    assert slope[1:-1] == pytest.approx(found[TrackRow.RIGHT_Y_SLOPE, inside][1:-1], abs=2e-6)


def joint(folder: Path, closest: float) -> Track:
    """Return a track whose rails dip to a sharp joint at 6 m, 5 mm deep, measured at stations `closest` apart around it."""
    s = np.unique(np.concatenate((np.arange(0.0, 12.0, 0.5), np.arange(5.5, 6.5, closest).round(9))))
    z = np.interp(s, [5.5, 6.0, 6.5], [0.0, 5e-3, 0.0])
    table = np.stack((s, 0.0 * s, z, 0.0 * s, 0.0 * s), axis=1)
    np.savetxt(folder / "track.csv", table, delimiter=",", header="distance,alignment,vertical,cross_level,gauge")
    return Track(measured=str(folder / "track.csv"))


def test_places_are_as_close_as_the_closest_stations(tmp_path):
    """With places 50 mm apart the slope at the joint would fall from 10 to -10 mrad over 100 mm (issue 31, 2)."""
    found = rows(joint(tmp_path, 0.005), length=10.0)
    assert np.diff(found[TrackRow.PLACE]) == pytest.approx(0.005, abs=1e-12)
    near = np.abs(found[TrackRow.PLACE] - 6.0) < 0.4
    assert found[TrackRow.RIGHT_Z, near].max() == pytest.approx(5e-3, abs=1e-9)
    rounded = near & (np.abs(np.abs(found[TrackRow.RIGHT_Z_SLOPE]) - 10e-3) > 1e-6)
    assert np.ptp(found[TrackRow.PLACE, rounded]) <= 0.010 + 1e-9
    assert np.diff(rows(Track(), length=10.0)[TrackRow.PLACE]) == pytest.approx(SPACING, abs=1e-12)


def test_a_track_with_too_many_places_is_refused(tmp_path, monkeypatch):
    track = joint(tmp_path, 0.005)
    monkeypatch.setattr("contact_models.vehicle.course.MOST_PLACES", 10_000)
    with pytest.raises(
        ContactError, match=r"stations are 0\.005 m apart, .* 1\.8e\+04 places .* at least 0\.009 m apart"
    ):
        rows(track, length=10.0)


def test_faults_of_a_measured_series_are_named(tmp_path):
    (tmp_path / "track.csv").write_text("distance,alignment\n0,1\n1,2\n")
    with pytest.raises(ContactError, match="needs the columns distance, alignment, vertical"):
        rows(Track(measured=str(tmp_path / "track.csv")))
    with pytest.raises(ContactError, match="excludes random irregularities"):
        Track(measured="x", gauge=Irregularities(spectrum="FRA 5"))


def test_friction_is_interpolated_between_its_places():
    found = rows(Track(friction=Friction(at=(10.0, 20.0), right=(1.0, 0.5), left=(1.0, 1.0))))
    assert found[TrackRow.RIGHT_FRICTION, at(15.0)] == pytest.approx(0.75)
    assert found[TrackRow.RIGHT_FRICTION, at(100.0)] == 0.5
    assert (found[TrackRow.LEFT_FRICTION] == 1.0).all()
