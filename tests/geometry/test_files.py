"""Profile files: every format gives the same right-side profile in metres."""

import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import inspection, profile
from tests.geometry.written import COLUMNS, RAIL, WHEEL, same, table, wheel_file

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
        ("empty.prr", "", {}, "empty.prr' is empty"),
        ("none.prr", "header.begin", {}, "no points between point.begin and point.end"),
        ("bad.prr", "point.begin\n1 2\n3 x\npoint.end", {}, "line 3: '3 x' is not a point"),
        ("few.txt", "0 0\n1 1\n", {"kind": "rail", "unit": "m", "side": "right"}, "at least 4"),
        ("words.txt", "no numbers\nat all\n", {"kind": "rail", "unit": "m", "side": "right"}, "no columns of numbers"),
        ("late.txt", "0 0\n1 1\n2 2\nend of data\n", {"kind": "rail", "unit": "m", "side": "right"}, "line 4"),
        (
            "nan.txt",
            "0 0\n1 1\n2 nan\n",
            {"kind": "rail", "unit": "m", "side": "right"},
            "2 distinct points; at least 4",
        ),
        ("a.txt", "0 0", {"unit": "m", "side": "right"}, "kind = None"),
        ("a.txt", "0 0", {"kind": "rail", "side": "right"}, "unit = None"),
        ("a.txt", "0 0", {"kind": "rail", "unit": "m"}, "side = None"),
        ("a.txt", "0 0", {"kind": "rail", "unit": "ell", "side": "right"}, "unit = 'ell'"),
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
        (WHEEL, 1e3, "m", r"wheel\.txt.*is 129 m wide, outside the range \[0\.001, 0\.2\].*set unit"),
        (WHEEL, 1.0, "mm", r"is 0\.00012\d+ m wide"),
        (RAIL, 1e3, "m", r"is 73\.\d+ m wide"),
        (RAIL, 1e6, "mm", r"is 73\.\d+ m wide.*; no unit of m, mm, cm, inch fits: which columns hold y and z\?"),
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


@pytest.mark.parametrize(
    ("shape", "unit", "of_z", "said"),
    [
        (WHEEL, "m", 1e3, r"is 30\.6357 m high and 0\.129 m wide; are its columns y and z in one unit"),
        (RAIL, "m", 1e3, r"is 27\.2852 m high and 0\.07317\d* m wide; are its columns y and z in one unit"),
        (WHEEL, "mm", 1e-3, r"flange: there is no flange at y = -55 mm; all points lie within 0\.0306 mm of height"),
        (WHEEL, "mm", 1 / 25.4, r"flange: there is no flange at y = -55 mm; .*; are y and z in one unit"),
        (WHEEL, "mm", 2.0, "flange: the flange is 56 mm high, usually 25 to 40 mm"),
        (
            RAIL,
            "mm",
            0.1,
            r"flat: all points of 73\.2 mm of width lie within 2\.73 mm of height.*are y and z in one unit",
        ),
    ],
)
def test_y_and_z_in_different_units_or_to_different_scales_are_named(tmp_path, shape, unit, of_z, said):
    size = 1.0 if unit == "m" else 1e3
    path = tmp_path / "drawn.txt"
    path.write_text(table(size * shape.y, size * of_z * shape.z))
    if size == 1.0:
        with pytest.raises(ContactError, match=said):
            profile.read(path, kind=shape.kind, unit=unit, side="right")
    else:
        with pytest.warns(ProfileWarning, match=said):
            profile.read(path, kind=shape.kind, unit=unit, side="right")


@pytest.mark.parametrize(
    ("shape", "most", "said"),
    [
        (RAIL, 0.0, "top is known up to y = 0 mm only, wheels and rails touch up to 2"),
        (RAIL, 0.01, "top is known up to y = 9.98 mm only"),
        (WHEEL, 0.01, "tread is known up to y = 9.97 mm only, wheels and rails touch up to 20 mm"),
        (RAIL, 0.02, None),
        (WHEEL, 0.03, None),
    ],
)
def test_a_head_or_a_tread_that_is_not_whole_is_told(tmp_path, shape, most, said):
    path, inside = tmp_path / "half.txt", shape.y <= most + 2e-4
    path.write_text(table(shape.y[inside], shape.z[inside]))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        profile.read(path, kind=shape.kind, unit="m", side="right")
    assert [str(w.message).startswith("half.txt: not whole: the ") for w in told] == [True] * (said is not None)
    assert said is None or said in str(told[0].message)


def test_bounds_of_simpack_that_leave_no_point_are_named(tmp_path):
    text = SIMPACK.format(type=1, shift=0, rotate=0, mirror=0, per_metre=1.0, points=table(WHEEL.y, WHEEL.z))
    path = tmp_path / "wheel.prw"
    path.write_text(text.replace("  point.begin", "  bound.y.min = 5\n  bound.y.max = 6\n  point.begin"))
    with pytest.raises(ContactError, match=r"bound\.y from 5 to 6 leaves no point"):
        profile.read(path)


@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flange_on_the_field_side_is_detected_and_corrected_by_the_option(tmp_path, up):
    path = tmp_path / "wheel.txt"
    path.write_text(table(-WHEEL.y, up * WHEEL.z))
    with pytest.raises(ContactError, match=r"flange lies on the field side, at y = 0\.05.*set side"):
        profile.read(path, kind="wheel", unit="m", side="right")
    same(profile.read(path, kind="wheel", unit="m", side="left"), WHEEL)


@pytest.mark.parametrize(("side", "up"), [("right", 1.0), ("left", -1.0)])
@pytest.mark.parametrize("name", profile.names())
def test_a_wheel_is_no_rail_and_a_rail_no_wheel(tmp_path, name, up, side):
    path, drawn = tmp_path / "drawn.txt", profile.named(name)
    path.write_text(table(drawn.y if side == "right" else -drawn.y, up * drawn.z))
    other = "rail" if drawn.kind == "wheel" else "wheel"
    with pytest.raises(ContactError, match=f"shape of a {drawn.kind}: .*kind = '{other}' must be '{drawn.kind}'"):
        profile.read(path, kind=other, unit="m", side=side)
    assert profile.read(path, kind=drawn.kind, unit="m", side=side).kind == drawn.kind


def grooved(depth, lip, below):
    """Return y, z [m] of a rail like 60R1 in round numbers: a head 56 mm wide, `below` its field corner, a groove, a lip."""
    corners = 1e-3 * np.array([
        *((28.0, below), (28.0, 11.0), (25.0, 4.0), (18.0, 1.3), (0.0, 0.0), (-18.0, 1.3), (-25.0, 4.0), (-28.0, 11.0)),
        *((-31.0, depth - 9.0), (-40.0, depth - 1.0), (-47.0, depth), (-54.0, depth - 2.0), (-60.0, depth - 10.0)),
        *((-65.0, 12.0), (-68.0, 7.0), (-65.0 - lip, 6.0)),
    ])[::-1]  # fmt: skip
    along = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))))
    s = np.arange(0.0, along[-1], 0.5e-3)
    return np.interp(s, along, corners[:, 0]), np.interp(s, along, corners[:, 1])


@pytest.mark.parametrize("side", ["right", "left"])
@pytest.mark.parametrize("up", [1.0, -1.0])
@pytest.mark.parametrize(
    ("depth", "lip", "below"), [(47.0, 20.0, 30.0), (47.0, 8.0, 14.0), (26.0, 20.0, 14.0), (36.0, 20.0, 30.0)]
)
def test_a_grooved_rail_is_no_wheel(tmp_path, depth, lip, below, up, side):
    y, z = grooved(depth, lip, below)
    path = tmp_path / "grooved.txt"
    path.write_text(table(y if side == "right" else -y, up * z))
    with pytest.raises(ContactError, match=r"shape of a rail: .*kind = 'wheel' must be 'rail'"):
        profile.read(path, kind="wheel", unit="m", side=side)
    read = profile.read(path, kind="rail", unit="m", side=side)
    np.testing.assert_allclose(read.y, y, atol=1e-6)
    np.testing.assert_allclose(read.z, z, atol=1e-6)
    assert inspection.turned(np.column_stack((y, z)), "rail") == 0.0
    with pytest.raises(ContactError, match=r"the groove lies on the field side, .*set side to the other side"):
        profile.read(path, kind="rail", unit="m", side="left" if side == "right" else "right")


@pytest.mark.parametrize("depth", [0.02, 0.033, 0.037])
@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_head_on_its_side_is_refused(tmp_path, depth, up):
    path = tmp_path / "rail.txt"
    head = profile.rail_60e1(inclination=0.0)
    y, z = head.y[head.z < depth], head.z[head.z < depth]
    path.write_text(table(up * z, y))
    with pytest.raises(ContactError, match="are its columns y and z swapped"):
        profile.read(path, kind="rail", unit="m", side="right")


def test_shapes_that_could_be_either_are_taken_as_given(tmp_path):
    path = tmp_path / "part.txt"
    for drawn, part in ((RAIL, RAIL.y < 0.01), (WHEEL, WHEEL.y > -0.05)):  # the gauge side; a scan from the tip on
        path.write_text(table(drawn.y[part], drawn.z[part]))
        assert profile.read(path, kind=drawn.kind, unit="m", side="right").kind == drawn.kind


def test_commas_that_may_be_decimal_or_separate_columns_are_named(tmp_path):
    path = tmp_path / "wheel.txt"
    path.write_text(table(1e3 * WHEEL.y, 1e3 * WHEEL.z, "{:.3f}|{:.3f}").replace(".", ",").replace("|", ","))
    with pytest.raises(ContactError, match=r"line 1: .*commas may be decimal or separate columns.*semicolons"):
        profile.read(path, **COLUMNS)


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


@pytest.mark.parametrize("name", profile.names("wheel"))
@pytest.mark.parametrize("upwards", [False, True])
def test_a_tread_without_its_flange_rises_to_the_field_side(tmp_path, name, upwards):
    wheel = profile.named(name)
    tread = wheel.y > -0.02
    y, z = wheel.y[tread], wheel.z[tread]
    path = wheel_file(tmp_path / "tread.txt", y, -z if upwards else z)
    with pytest.warns(ProfileWarning, match="flange: no flange shows where z points"):
        read = profile.read(path, **COLUMNS)
    np.testing.assert_allclose(read.z, z, rtol=0, atol=1e-7)


@pytest.mark.parametrize("upwards", [False, True])
def test_a_crowned_disc_rises_to_both_sides(tmp_path, upwards):
    y = np.linspace(-0.03, 0.03, 101)
    z = -(y**2) / (2.0 * 0.1)
    path = wheel_file(tmp_path / "disc.txt", y, -z if upwards else z)
    with pytest.warns(ProfileWarning, match="no flange shows where z points"):
        read = profile.read(path, **COLUMNS)
    np.testing.assert_allclose(read.z, z, rtol=0, atol=1e-7)
