"""Measured profiles: noise is smoothed on request, and faults of the measurement are named with the option that cures them."""

import sys
import warnings

import numpy as np
import pytest

import contact
from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import profile
from contact.geometry.wheelset import Pair, Pose
from tests.geometry.written import COLUMNS, RAIL, WHEEL, distance, table, wheel_file


def test_smoothing_takes_the_noise_out_of_tangents_and_curvatures(tmp_path):
    noise = 2e-6 * np.random.default_rng(1).standard_normal(RAIL.y.size)
    y, z = RAIL.y - noise * np.sin(RAIL.angle), RAIL.z + noise * np.cos(RAIL.angle)
    path = tmp_path / "rail.txt"
    path.write_text(table(y, z))
    middle = slice(20, -20)  # a spline is less accurate at its ends

    def errors(shape):
        bend = [np.diff(s.angle) / np.hypot(np.diff(s.y), np.diff(s.z)) for s in (shape, RAIL)]
        return [np.sqrt(np.mean(d[middle] ** 2)) for d in (shape.angle - RAIL.angle, bend[0] - bend[1])]

    given = {"kind": "rail", "unit": "m", "side": "right"}
    raw, smooth = (profile.read(path, smoothing=tolerance, **given) for tolerance in (None, 2e-6))
    assert errors(smooth)[0] < errors(raw)[0] / 4, "tangents"
    assert errors(smooth)[1] < errors(raw)[1] / 10, "curvatures"
    moved = np.hypot(smooth.y - y, smooth.z - z)
    assert np.sqrt(np.mean(moved**2)) == pytest.approx(2e-6, rel=2e-3), "no further than it was allowed"
    with pytest.raises(ContactError, match="smoothing = 2 is outside"):
        profile.read(path, smoothing=2.0, **given)


def test_missing_scipy_is_named(tmp_path, monkeypatch):
    path = tmp_path / "rail.txt"
    path.write_text(table(RAIL.y, RAIL.z))
    monkeypatch.setitem(sys.modules, "scipy.interpolate", None)
    with pytest.raises(ImportError, match=r"wheelrail-contact\[profiles\]") as missing:
        profile.read(path, kind="rail", unit="m", side="right", smoothing=1e-6)
    assert missing.value.__suppress_context__, "one traceback is enough"


def test_unsorted_rows_are_named_and_sorted_on_request(tmp_path):
    mixed = np.random.default_rng(3).permutation(WHEEL.y.size)
    path = wheel_file(tmp_path / "wheel.txt", WHEEL.y[mixed], WHEEL.z[mixed])
    with pytest.raises(ContactError, match=r"wheel\.txt.*unsorted rows.*repair=True sorts them"):
        profile.read(path, **COLUMNS)
    assert distance(profile.read(path, repair=True, **COLUMNS)) < 1e-6


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (np.r_[: WHEEL.y.size, 5 : WHEEL.y.size], "several scans: the points run over the profile 2 times"),
        (np.r_[: WHEEL.y.size, WHEEL.y.size - 20 : 10 : -1], "backward scan: after 593 of 1156 points, at y = 60 mm"),
    ],
)
def test_repeated_and_backward_scans_are_named_and_one_is_kept_on_request(tmp_path, rows, message):
    path = wheel_file(
        tmp_path / "wheel.txt", WHEEL.y[rows], WHEEL.z[rows] + 1e-5 * (np.arange(rows.size) >= WHEEL.y.size)
    )
    with pytest.raises(ContactError, match=message):
        profile.read(path, **COLUMNS)
    repaired = profile.read(path, repair=True, **COLUMNS)
    assert repaired.y.size == WHEEL.y.size
    assert distance(repaired) < 1e-6


@pytest.mark.parametrize("backwards", [False, True])
def test_a_rail_scanned_there_and_back_has_each_side_once(tmp_path, backwards):
    """The point farthest from the start is no end of a rail: its sides are steep."""
    points = np.column_stack((RAIL.y, RAIL.z))[:: -1 if backwards else 1]
    path = wheel_file(tmp_path / "rail.txt", *np.concatenate((points, points[::-1])).T)
    with pytest.raises(ContactError, match="backward scan: after 443 of 886 points"):
        profile.read(path, **(COLUMNS | {"kind": "rail"}))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert profile.read(path, repair=True, **(COLUMNS | {"kind": "rail"})).y.size == RAIL.y.size


def test_spikes_and_back_steps_are_named_and_dropped_on_request(tmp_path):
    z, rows = WHEEL.z.copy(), np.arange(WHEEL.y.size)
    z[[350, 450]] += [1e-4, -6e-5]
    rows[300:302] = [301, 300]
    path = wheel_file(tmp_path / "wheel.txt", WHEEL.y[rows], z[rows])
    found = {finding.fault: finding for finding in profile.check(path, **COLUMNS).findings}
    assert set(found) == {"spikes", "back steps"}
    np.testing.assert_allclose(found["spikes"].at[:, 0], WHEEL.y[[350, 450]], atol=1e-7)
    assert "2 points up to 100 µm off" in found["spikes"].seen
    with pytest.warns(ProfileWarning, match=r"wheel\.txt: spikes.*repair=True drops them"):
        assert distance(profile.read(path, **COLUMNS)) > 5e-5
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert distance(profile.read(path, repair=True, **COLUMNS)) < 1e-6


@pytest.mark.parametrize("height", [-5e-3, -2e-3, -1e-3, 1e-3, 2e-3, 5e-3])
def test_spikes_taller_than_the_spacing_are_named_and_dropped_on_request(tmp_path, height):
    """Those of 1 to 4 mm were passed over: beside them the neighbours stand off by the spacing only."""
    z = WHEEL.z.copy()
    z[400] += height
    path = wheel_file(tmp_path / "wheel.txt", WHEEL.y, z)
    found = {finding.fault.value: finding for finding in profile.check(path, **COLUMNS).findings}
    np.testing.assert_allclose(found["spikes"].at[:, 0], WHEEL.y[[400]], atol=1e-7)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert distance(profile.read(path, repair=True, **COLUMNS)) < 1e-6


@pytest.mark.parametrize("height", [5e-5, 1e-3, 3e-3])
def test_steps_up_and_down_in_the_tread_are_named(tmp_path, height):
    """Those above .5 mm were taken for a flank, which no wheel and rail touch."""
    z = WHEEL.z.copy()
    z[400:404] -= height
    found = profile.check(wheel_file(tmp_path / "wheel.txt", WHEEL.y, z), **COLUMNS).findings
    assert [finding.fault.value for finding in found] == ["kinks"]
    assert abs(found[0].at[0, 0] - WHEEL.y[400]) < 4e-4


def test_a_gap_is_named(tmp_path):
    there = (WHEEL.y < -0.005) | (WHEEL.y > 0.003)
    with pytest.warns(ProfileWarning, match=r"gap: no points over 8\.48 mm from y = -5\.23 mm on"):
        profile.read(wheel_file(tmp_path / "wheel.txt", WHEEL.y[there], WHEEL.z[there]), **COLUMNS)


def test_a_corner_in_the_tread_is_named_and_a_chamfer_is_not(tmp_path):
    z = WHEEL.z + np.where(WHEEL.y > 0.01, 0.2 * (WHEEL.y - 0.01), 0.0)
    found = profile.check(wheel_file(tmp_path / "wheel.txt", WHEEL.y, z), **COLUMNS).findings
    assert [finding.fault.value for finding in found] == ["kinks"]
    assert found[0].at[0, 0] == pytest.approx(0.01, abs=3e-4)
    assert profile.check(profile.named("EN 15302 A")).findings == ()


def test_rounded_numbers_are_named_with_a_smoothing_that_helps(tmp_path):
    path = wheel_file(tmp_path / "wheel.txt", WHEEL.y, WHEEL.z, "{:.2f} {:.2f}")
    (found,) = profile.check(path, **COLUMNS).findings
    assert "from rounding: the numbers are given to 0.01 mm" in found.seen
    assert found.cure.startswith("smoothing=3e-06")
    middle = slice(60, -60)

    def error(read):
        tangents = np.interp(read.y[middle], WHEEL.y, WHEEL.angle)
        return np.sqrt(np.mean((read.angle[middle] - tangents) ** 2))

    raw = profile.check(path, **COLUMNS).profile
    for option in ({"smoothing": 3e-6}, {"wavelength": 5e-3}):
        assert error(profile.read(path, **option, **COLUMNS)) < error(raw) / 3


def test_every_standard_profile_but_wheel_H_is_clean():
    """Wheel H of EN 15302 has corners in its tread."""
    for name in set(profile.names()) - {"EN 15302 H"}:
        assert profile.check(profile.named(name)).findings == (), name


@pytest.mark.parametrize(
    ("dy", "dz", "zero", "message"),
    [
        (0.07, 0.0, "flange_back", r"tip lies at y = 15 mm.*zero='flange_back'"),
        (0.02, 0.0, "shape", r"tip lies at y = -35 mm.*zero='shape'"),
        (0.0, 0.003, "shape", r"tread .* at z = 3 mm; the wheel's radius becomes that much larger.*zero='shape'"),
    ],
)
def test_offsets_are_named_and_removed_by_the_option_in_the_message(tmp_path, dy, dz, zero, message):
    path = wheel_file(tmp_path / "wheel.txt", WHEEL.y + dy, WHEEL.z + dz)
    with pytest.warns(ProfileWarning, match=message):
        profile.read(path, **COLUMNS)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = profile.read(path, zero=zero, **COLUMNS)
    assert distance(read) < 3e-5  # the tip of S1002 is found within half a spacing of its points


def test_the_zero_of_a_rail_is_found_from_its_shape(tmp_path):
    path = tmp_path / "rail.txt"
    upright = profile.rail_60e1(inclination=0.0)
    path.write_text(table(1e3 * upright.y + 700.0, 1e3 * upright.z - 3.0))
    read = profile.read(path, kind="rail", unit="mm", side="right", zero="shape")
    assert np.abs(read.z.min()) < 1e-9
    assert np.interp(-0.020, read.y, read.z) == pytest.approx(np.interp(-0.020, upright.y, upright.z), abs=2e-5)


def test_a_rail_whose_field_side_is_deeper_may_show_the_other_side(tmp_path):
    path = tmp_path / "rail.txt"
    gauge_side = RAIL.y < 0.02
    path.write_text(table(-RAIL.y[gauge_side], RAIL.z[gauge_side]))
    with pytest.warns(ProfileWarning, match="field side reaches .* deeper .*set side"):
        profile.read(path, kind="rail", unit="m", side="right")


def test_a_wavelength_is_halved_and_long_waves_stay():
    from contact.geometry.smoothing import filtered

    y = np.arange(-0.05, 0.05, 2.5e-4)
    for length, share in ((5e-3, 0.5), (20e-3, 1.0 / (1.0 + 0.25**4)), (2.5e-3, 1.0 / 17.0)):
        wave = 1e-6 * np.sin(2.0 * np.pi * y / length)
        _, z, _ = filtered(y, wave, 5e-3)
        middle = np.abs(y) < 0.03
        assert (z[middle] @ wave[middle]) / (wave[middle] @ wave[middle]) == pytest.approx(share, abs=0.02)


def test_a_check_is_printed_and_drawn(tmp_path):
    plot = pytest.importorskip("contact.plot")
    z = WHEEL.z.copy()
    z[350] += 1e-4
    found = profile.check(wheel_file(tmp_path / "wheel.txt", WHEEL.y, z), **COLUMNS)
    assert str(found).splitlines()[0] == "wheel.txt: wheel, 593 points"
    figure = plot.profile_check(found)
    marked = [line for line in figure.axes[0].lines if line.get_label() == "spikes"]
    assert marked[0].get_xdata()[0] == pytest.approx(1e3 * WHEEL.y[350], abs=1e-4)
    assert "nothing found" in repr(profile.check(WHEEL)) == str(profile.check(WHEEL))


def test_pictures_after_a_repair_say_what_was_dropped(tmp_path):
    """Issue 34, 6."""
    plot = pytest.importorskip("contact.plot")
    z, scan = WHEEL.z.copy(), WHEEL.y.size
    z[350] += 1e-4
    path = wheel_file(tmp_path / "wheel.txt", np.tile(WHEEL.y, 2)[:-100], np.tile(z, 2)[:-100])
    found = profile.check(path, **COLUMNS, repair=True)
    assert found.dropped == scan - 100 + 1
    assert [finding.fault.value for finding in found.repaired] == ["several scans", "spikes"]
    said = f"repair dropped {found.dropped} of {2 * scan - 100} points (several scans, spikes)"
    assert said in str(found)
    assert "nothing found" not in str(found)
    assert said in plot.profile_check(found).get_supxlabel()
    once = profile.check(wheel_file(tmp_path / "once.txt", WHEEL.y, z), **COLUMNS, repair=True)
    figure = plot.profile_check(once)
    assert f"repair dropped 1 of {scan} points (spikes)" in figure.get_supxlabel()
    dropped = next(line for line in figure.axes[0].lines if line.get_label() == "spikes, dropped")
    assert dropped.get_xdata()[0] == pytest.approx(1e3 * WHEEL.y[350], abs=1e-4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read = profile.read(path, **COLUMNS, repair=True)
    for one in (read, read.rotated(0.01)):
        assert said in one.plot().get_supxlabel()
        assert said in one._repr_html_()
    assert WHEEL.plot().get_supxlabel() == ""
    clean = profile.check(wheel_file(tmp_path / "clean.txt", WHEEL.y, WHEEL.z), **COLUMNS, repair=True)
    assert (clean.dropped, clean.repaired) == (0, ())
    assert "nothing found" in str(clean)


def test_points_that_coincide_are_repaired_without_an_error(tmp_path):
    """Found by random files: several scans in which most neighbours are one point."""
    y, z = np.repeat(WHEEL.y, 3), np.repeat(WHEEL.z, 3)
    found = profile.check(wheel_file(tmp_path / "wheel.txt", np.tile(y, 2), np.tile(z, 2)), **COLUMNS, repair=True)
    assert found.profile is not None
    assert found.profile.y.size == WHEEL.y.size
    assert "repair dropped" in found.profile.note


def test_the_picture_of_a_position_says_which_of_its_profiles_was_repaired(tmp_path):
    plot = pytest.importorskip("contact.plot")
    z = WHEEL.z.copy()
    z[350] += 1e-4
    wheel = profile.read(wheel_file(tmp_path / "mine.txt", WHEEL.y, z), **COLUMNS, repair=True)
    rail = profile.rail_60e1()
    patches = Pair(wheel, rail).contacts(Pose(y=1e-3), load=80e3)
    solutions = [contact.solve(p.separation, p.creepage, load=p.load) for p in patches]
    figure = plot.position([plot.Wheel("right", wheel, rail, patches, solutions)])
    assert f"mine: {wheel.note}" in figure.subfigs[0].get_supxlabel()
