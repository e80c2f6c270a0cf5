"""Profile files: every format gives the same right-side profile in metres."""

import sys
import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import profile

WHEEL, RAIL = profile.s1002(), profile.rail_60e1()

SIMPACK = """! a comment
  header.begin
    version = 1
    type = {type}   ! 0=rail profile, 1=wheel profile
  header.end
  spline.begin
    file = 'somewhere.txt'
    shift.y = {shift}
    rotate = {rotate}
    bound.y.min = +1.0
    bound.y.max = +0.0
    mirror.y = {mirror}
    mirror.z = 0
    inversion = {mirror}
    units.len.f = {per_metre}
    units.ang.f = +1.0
    point.begin
{points}
    point.end
  spline.end
"""


def table(y, z, template="{:.9e} {:.9e} 1.0"):
    return "\n".join(template.format(a, b) for a, b in zip(y, z, strict=True))


def same(read: profile.Profile, shape: profile.Profile, tolerance=1e-9):
    """Check that points agree, and tangents too away from joints, where a spline bends."""
    assert read.kind == shape.kind
    np.testing.assert_allclose(read.y, shape.y, rtol=0, atol=tolerance)
    np.testing.assert_allclose(read.z, shape.z, rtol=0, atol=tolerance)
    assert np.median(np.abs(read.angle - shape.angle)) < 1e-5


@pytest.mark.parametrize("per_metre", [1.0, 1000.0])
def test_simpack_wheel_in_its_own_unit_mirrored_and_inverted(tmp_path, per_metre):
    points = table(-WHEEL.y[::-1] * per_metre, WHEEL.z[::-1] * per_metre)
    text = SIMPACK.format(type=1, shift=0, rotate=0, mirror=1, per_metre=per_metre, points=points)
    path = tmp_path / "wheel.prw"
    path.write_text(text)
    same(profile.read(path), WHEEL)


def test_simpack_shifts_before_it_turns_and_turns_before_it_mirrors(tmp_path):
    c, s = np.cos(0.1), np.sin(0.1)
    # undo: mirror, then turn back, then shift back
    y, z = c * -RAIL.y + s * RAIL.z, -s * -RAIL.y + c * RAIL.z
    text = SIMPACK.format(type=0, shift=0.25, rotate=0.1, mirror=1, per_metre=1.0, points=table(y - 0.25, z))
    path = tmp_path / "rail.prr"
    path.write_text(text)
    same(profile.read(path), RAIL, 1e-9)


def test_simpack_leaves_out_commented_points_and_near_duplicates(tmp_path):
    rows = table(RAIL.y, RAIL.z).splitlines()
    rows[3:3] = ["! 9.0 9.0", rows[2].replace("e-02 ", "1e-02 ", 1)]  # a comment, and a point 1e-10 m from the third
    text = SIMPACK.format(type=0, shift=0, rotate=0, mirror=0, per_metre=1.0, points="\n".join(rows))
    path = tmp_path / "rail.prr"
    path.write_text(text)
    same(profile.read(path), RAIL)


def test_miniprof_rail_points_to_the_track_and_up(tmp_path):
    path = tmp_path / "rail.BAN"
    gauge_side = RAIL.y < 0.02  # as measured: little of the field side
    y, z = RAIL.y[gauge_side], RAIL.z[gauge_side]
    body = table(-1e3 * y[::-1], -1e3 * z[::-1], "{:.7f} {:.7f} 0.0 0.0")
    path.write_text(f"Filename=x.trc\nXOffset=0.0000\nColumnDef=X,Y,A,C\n\n{body}\n")
    read = profile.read(path)
    assert read.kind == "rail"
    np.testing.assert_allclose(read.y, y, atol=1e-9)
    np.testing.assert_allclose(read.z, z, atol=1e-9)


@pytest.mark.parametrize("from_back", [0.0, 70.0])
def test_miniprof_wheel_measured_from_the_flange_back_or_the_tape_circle(tmp_path, from_back):
    path = tmp_path / "wheel.whl"
    body = table(1e3 * WHEEL.y + from_back, 1e3 * WHEEL.z, "{:.7f} {:.7f} 0.000")
    path.write_text(f"MINIPROF 101 148 1994 3 24\nWheel ID....:\n32.58 37.11 14.71  (Sd/Sh/qR)\n\n{body}\n")
    same(profile.read(path), WHEEL)


@pytest.mark.parametrize(("side", "sign"), [("right", 1.0), ("left", -1.0)])
@pytest.mark.parametrize("up", [1.0, -1.0])
@pytest.mark.parametrize("shape", [WHEEL, RAIL], ids=["wheel", "rail"])
def test_plain_columns_either_side_either_way_up(tmp_path, shape, side, sign, up):
    path = tmp_path / "points.csv"
    path.write_text("y [mm], z [mm]\n" + table(sign * 1e3 * shape.y, up * 1e3 * shape.z, "{:.7f}, {:.7f}"))
    same(profile.read(path, kind=shape.kind, unit="mm", side=side), shape)


@pytest.mark.parametrize(
    ("name", "text", "arguments", "message"),
    [
        ("none.prw", None, {}, "none.prw.* is missing: there is no such file"),
        ("empty.prr", "", {}, "no points between point.begin and point.end"),
        ("bad.prr", "point.begin\n1 2\n3 x\npoint.end", {}, "line 3: '3 x' is not a point"),
        ("few.txt", "0 0\n1 1\n", {"kind": "rail", "unit": "m", "side": "right"}, "at least 4"),
        ("words.txt", "no numbers\nat all\n", {"kind": "rail", "unit": "m", "side": "right"}, "no columns of numbers"),
        ("late.txt", "0 0\n1 1\n2 2\nend of data\n", {"kind": "rail", "unit": "m", "side": "right"}, "line 4"),
        ("nan.txt", "0 0\n1 1\n2 nan\n", {"kind": "rail", "unit": "m", "side": "right"}, "line 3"),
        ("a.txt", "0 0", {"unit": "m", "side": "right"}, "kind = None"),
        ("a.txt", "0 0", {"kind": "rail", "side": "right"}, "unit = None"),
        ("a.txt", "0 0", {"kind": "rail", "unit": "m"}, "side = None"),
        ("a.txt", "0 0", {"kind": "rail", "unit": "inch", "side": "right"}, "unit = 'inch'"),
        ("a.txt", "0 0", {"kind": "rail", "unit": "m", "side": "top"}, "side = 'top'"),
        ("a.prw", "0 0", {"kind": "rail"}, "is a file of a wheel"),
    ],
)
def test_files_without_a_profile_raise_an_error_with_the_reason(tmp_path, name, text, arguments, message):
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    with pytest.raises(ContactError, match=message):
        profile.read(path, **arguments)


@pytest.mark.parametrize(
    ("shape", "per_metre", "unit", "message"),
    [
        (WHEEL, 1e3, "m", r"wheel\.txt.*is 129 m wide, outside the range \[0\.03, 0\.2\].*set unit"),
        (WHEEL, 1.0, "mm", r"is 0\.00012\d+ m wide"),
        (RAIL, 1e3, "m", r"is 73\.\d+ m wide"),
    ],
)
def test_a_wrong_unit_is_detected_by_the_width(tmp_path, shape, per_metre, unit, message):
    path = tmp_path / f"{shape.kind}.txt"
    path.write_text(table(per_metre * shape.y, per_metre * shape.z))
    with pytest.raises(ContactError, match=message):
        profile.read(path, kind=shape.kind, unit=unit, side="right")


def test_a_wrong_unit_in_a_simpack_header_is_detected_and_corrected_by_the_option(tmp_path):
    path = tmp_path / "wheel.prw"
    points = table(1e3 * WHEEL.y, 1e3 * WHEEL.z)
    path.write_text(SIMPACK.format(type=1, shift=0, rotate=0, mirror=0, per_metre=1.0, points=points))
    with pytest.raises(ContactError, match="129 m wide"):
        profile.read(path)
    same(profile.read(path, unit="mm"), WHEEL)


@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flange_on_the_field_side_is_detected_and_corrected_by_the_option(tmp_path, up):
    path = tmp_path / "wheel.txt"
    path.write_text(table(-WHEEL.y, up * WHEEL.z))
    with pytest.raises(ContactError, match=r"flange lies on the field side, at y = 0\.05.*set side"):
        profile.read(path, kind="wheel", unit="m", side="right")
    same(profile.read(path, kind="wheel", unit="m", side="left"), WHEEL)


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
    with pytest.raises(ImportError, match=r"wheelrail-contact\[profiles\]"):
        profile.read(path, kind="rail", unit="m", side="right", smoothing=1e-6)


COLUMNS = {"kind": "wheel", "unit": "mm", "side": "right"}


def wheel_file(path, y, z, template="{:.4f} {:.4f}"):
    path.write_text(table(1e3 * y, 1e3 * z, template))
    return path


def distance(read, shape=WHEEL):
    """Return the greatest vertical distance between two profiles where the wheel is not steep [m]."""
    inside = (read.y > -0.03) & (read.y < 0.055)
    return np.abs(read.z[inside] - np.interp(read.y[inside], shape.y, shape.z)).max()


@pytest.mark.parametrize("separator", [" ", ";", "; ", "\t", ", "])
def test_decimal_commas_are_recognised(tmp_path, separator):
    path = tmp_path / "wheel.txt"
    rows = table(1e3 * WHEEL.y, 1e3 * WHEEL.z, "{:.7f}|{:.7f}").replace(".", ",").replace("|", separator)
    path.write_text(f"y;z\n{rows}\n")
    same(profile.read(path, **COLUMNS), WHEEL)


def test_commas_that_may_be_decimal_or_separate_columns_are_named(tmp_path):
    path = tmp_path / "wheel.txt"
    path.write_text(table(1e3 * WHEEL.y, 1e3 * WHEEL.z, "{:.3f}|{:.3f}").replace(".", ",").replace("|", ","))
    with pytest.raises(ContactError, match=r"line 1: .*commas may be decimal or separate columns.*semicolons"):
        profile.read(path, **COLUMNS)


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
    assert "numbers rounded to 0.01 mm" in found.seen
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


def test_vampire_wheels_of_both_sides(tmp_path):
    path = tmp_path / "pair.whe"
    y, z = 1e3 * WHEEL.y + 750.0, 1e3 * WHEEL.z
    worn = z + 0.5
    rows = "\n".join(f"{-a:.7f}, {c:.7f}, {a:.7f}, {b:.7f}" for a, b, c in zip(y, z, worn, strict=True))
    path.write_text(f"WHEELPROFILE\nS1002\nTREADDATUM EUROPEAN\nFLANGEBACK 1360\n{rows}\n")
    same(profile.read(path), WHEEL)
    left = profile.read(path, side="left")
    np.testing.assert_allclose(left.z, WHEEL.z + 5e-4, atol=1e-9)
    path.write_text(f"WHEELPROFILE\nS1002\nTREADDATUM LOCAL\nFLANGEBACK 1360\n{rows}\n")
    with pytest.raises(ContactError, match=r"line 3: .* is no TREADDATUM; allowed: EUROPEAN"):
        profile.read(path)


def test_vampire_rails_point_up(tmp_path):
    path = tmp_path / "pair.rai"
    y, z = 1e3 * RAIL.y + 750.0, -1e3 * RAIL.z
    path.write_text(
        "RAILPROFILE\nUIC60\nGAUGEPOINT EUROPEAN\nGAUGE 1435\n"
        + "\n".join(f"{-a:.7f} {b:.7f} {a:.7f} {b:.7f}" for a, b in zip(y, z, strict=True))
    )
    read = profile.read(path)
    np.testing.assert_allclose(read.z, RAIL.z, atol=1e-9)
    np.testing.assert_allclose(np.diff(read.y), np.diff(RAIL.y), atol=1e-9)


def test_gensys_points_to_the_centre_of_the_track(tmp_path):
    path = tmp_path / "s1002.wheel"
    path.write_text(table(-1e3 * WHEEL.y[::-1], 1e3 * WHEEL.z[::-1], "{:.7f} {:.7f}  # a comment"))
    same(profile.read(path), WHEEL)


def test_miniprof_sections(tmp_path):
    path = tmp_path / "wheel.mpt"
    rows = table(1e3 * WHEEL.y + 70.0, 1e3 * WHEEL.z, "{:.7f},{:.7f},0.0")
    path.write_text(f"[FileInfo]\nVersion=1\n[Profile]\nXYPoints=593\n1 2 3\n[ProfilePoints]\n{rows}\n[Other]\n7 8\n")
    same(profile.read(path, kind="wheel"), WHEEL)
    with pytest.raises(ContactError, match="kind = None"):
        profile.read(path)


def test_a_folder_of_files(tmp_path):
    for name, shift in (("b.txt", 1e-3), ("a.txt", 0.0)):
        wheel_file(tmp_path / name, WHEEL.y, WHEEL.z + shift * 0.1)
    (tmp_path / "notes.txt").write_text("nothing here")
    assert list(profile.read_folder(tmp_path, "[ab].txt", **COLUMNS)) == ["a.txt", "b.txt"]
    with pytest.raises(ContactError, match="no columns of numbers"):
        profile.read_folder(tmp_path, **COLUMNS)
    with pytest.warns(ProfileWarning, match="left out: .*notes.txt"):
        assert len(profile.read_folder(tmp_path, skip=True, **COLUMNS)) == 2
    for folder, message in ((tmp_path / "no", "is missing"), (tmp_path / "a.txt", "is no folder")):
        with pytest.raises(ContactError, match=message):
            profile.read_folder(folder)
    with pytest.raises(ContactError, match=r"is a folder; profile\.read_folder"):
        profile.read(tmp_path, **COLUMNS)


def test_a_file_far_too_large_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "wheel.txt"
    with path.open("wb") as file:
        file.truncate(72_000_000)
    with pytest.raises(ContactError, match=r"holds 72 MB.*allowed: 20 MB"):
        profile.read(path, **COLUMNS)


def test_a_missing_file_is_called_missing_also_without_a_suffix():
    with pytest.raises(ContactError, match="'measured/wheel17' is missing: there is no such file"):
        profile.load("measured/wheel17", "wheel")
    with pytest.raises(ContactError, match="is missing"):
        profile.load("wheel.dat", "wheel")
    assert profile.load("1/40", "wheel").name == "1/40"


@pytest.mark.parametrize("text", ["1/40", "1:40", "0.025"])
def test_an_inclination_may_be_a_ratio(text):
    np.testing.assert_array_equal(profile.named("60E1", inclination=text).z, profile.rail_60e1(1 / 40).z)


@pytest.mark.parametrize("text", ["1/0", "steep", "1/40/2"])
def test_a_text_that_is_no_ratio_is_refused(text):
    with pytest.raises(ContactError, match="neither a number nor a ratio like 1/40"):
        profile.rail_60e1(text)


def test_a_check_is_printed_and_drawn(tmp_path):
    plot = pytest.importorskip("contact.plot")
    z = WHEEL.z.copy()
    z[350] += 1e-4
    found = profile.check(wheel_file(tmp_path / "wheel.txt", WHEEL.y, z), **COLUMNS)
    assert str(found).splitlines()[0] == "wheel.txt: wheel, 593 points"
    figure = plot.profile_check(found)
    marked = [line for line in figure.axes[0].lines if line.get_label() == "spikes"]
    assert marked[0].get_xdata()[0] == pytest.approx(1e3 * WHEEL.y[350], abs=1e-4)
    assert "nothing found" in str(profile.check(WHEEL))
