"""Profile files: every format gives the same right-side profile in metres."""

import sys

import numpy as np
import pytest

from contact import ContactError
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
        ("none.prw", None, {}, "none.prw.* cannot be read"),
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
