"""Outlines of whole rails are cut to the head, models keep their size, files of several lists let choose."""

import itertools
import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import profile
from tests.geometry.written import COLUMNS, RAIL, WHEEL, same, table

UPRIGHT = profile.rail_60e1(inclination=0.0)


def section(spacing=0.5):
    """Return head, web and foot of a rail like 60E1 [mm], z down, closed, from the middle of the foot's lower side on."""
    half = [(36.5, 39.5), (20, 48), (8.25, 60), (8.25, 140), (30, 155), (75, 160.5), (75, 172), (0, 172)]
    head = [(1e3 * y, 1e3 * z) for y, z in zip(UPRIGHT.y, UPRIGHT.z, strict=True)]
    corners = [(-y, z) for y, z in half][::-1] + head + half
    found = [corners[0]]
    for a, b in itertools.pairwise(corners):
        n = max(int(np.hypot(b[0] - a[0], b[1] - a[1]) / spacing), 1) if spacing else 1
        found += [tuple(np.add(a, np.subtract(b, a) * k / n)) for k in range(1, n + 1)]
    return np.array(found)


@pytest.mark.parametrize("start", [0, 0.13, 0.37, 0.5, 0.77, 0.95])
@pytest.mark.parametrize(("backwards", "up"), [(False, 1.0), (True, -1.0)])
@pytest.mark.parametrize("spacing", [0.5, 2.0, None])
def test_the_outline_of_a_rail_is_cut_to_its_head_from_every_start_and_either_way(
    start, backwards, up, spacing, tmp_path
):
    points = section(spacing)[:-1]
    points = np.roll(points, -int(start * len(points)), axis=0)
    points = np.concatenate((points, points[:1])) * [1.0, up]
    path = tmp_path / "section.csv"
    path.write_text(table(*(points[::-1] if backwards else points).T, "{:.7f};{:.7f}"))
    for repair in (False, True):
        with pytest.warns(ProfileWarning, match="closed outline: .* 172 mm high; kept is its head"):
            found = profile.read(path, kind="rail", unit="mm", side="right", repair=repair)
        assert found.z.min() == pytest.approx(0.0, abs=1e-4)
        assert abs(found.y[np.argmin(found.z)]) < 1e-3
        assert np.ptp(found.y) == pytest.approx(0.0732, abs=5e-4)
        assert np.ptp(found.z) < 0.045
        assert np.abs(np.interp(UPRIGHT.y, found.y, found.z) - UPRIGHT.z)[np.abs(UPRIGHT.y) < 0.03].max() < 2e-6


def test_the_outline_of_a_rail_in_unsorted_rows_is_sorted_and_cut(tmp_path):
    path, points = tmp_path / "rail.txt", section(1.0)
    path.write_text(table(*points[np.random.default_rng(1).permutation(len(points))].T))
    with pytest.warns(ProfileWarning, match="closed outline: .* 172 mm high; kept is its head"):
        found = profile.read(path, repair=True, **(COLUMNS | {"kind": "rail"}))
    assert np.ptp(found.y) == pytest.approx(0.0732, abs=2e-4)
    assert np.ptp(found.z) < 0.04


def test_an_outline_that_is_open_at_the_foot_is_cut_too(tmp_path):
    points = section()[60:-60]
    path = tmp_path / "section.csv"
    path.write_text(table(*points.T, "{:.7f};{:.7f}"))
    with pytest.warns(ProfileWarning, match="closed outline"):
        assert np.ptp(profile.read(path, kind="rail", unit="mm", side="right").y) == pytest.approx(0.0732, abs=5e-4)


def test_the_outline_of_a_wheels_rim_is_refused_by_that_reason(tmp_path):
    y, z = 1e3 * WHEEL.y, 1e3 * WHEEL.z
    inner = np.linspace(60, -69, 200)
    path = tmp_path / "rim.csv"
    path.write_text(table(np.concatenate((y, inner)), np.concatenate((z, np.full(200, -60.0))), "{:.7f};{:.7f}"))
    for repair in (False, True):
        with pytest.raises(ContactError, match=r"closed outline: the points run round a body .* running surface only"):
            profile.read(path, repair=repair, **COLUMNS)
    assert profile.check(path, **COLUMNS).profile is None
    same(profile.read(path, rows=(1, WHEEL.y.size), **COLUMNS), WHEEL, 1e-7)


@pytest.mark.parametrize("scale", [0.2, 0.25, 1 / 15])
def test_a_model_keeps_its_size_and_is_judged_at_its_scale(scale, tmp_path):
    path = tmp_path / "roller.txt"
    path.write_text(table(1e3 * scale * WHEEL.y, 1e3 * scale * WHEEL.z, "{:.6f} {:.6f}"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = profile.read(path, scale=scale, **COLUMNS)
    np.testing.assert_allclose(found.y, scale * WHEEL.y, atol=1e-9)
    moved = tmp_path / "back.whl"
    moved.write_text("X=1\n\n" + table(1e3 * scale * (WHEEL.y + 0.07), 1e3 * scale * WHEEL.z, "{:.6f} {:.6f}"))
    np.testing.assert_allclose(profile.read(moved, scale=scale).y, scale * WHEEL.y, atol=1e-9)
    from_shape = profile.read(moved, scale=scale, zero="shape")
    np.testing.assert_allclose(from_shape.y, scale * WHEEL.y, atol=3e-5)


def test_a_twin_disc_and_another_distance_of_the_tape_circle_are_read(tmp_path):
    path = tmp_path / "disc.txt"
    y = np.linspace(-5.0, 5.0, 81)
    path.write_text(table(y, -(y**2) / 200.0, "{:.7f} {:.7f}"))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert np.ptp(profile.read(path, **COLUMNS).y) == pytest.approx(0.01)
    path = tmp_path / "aar.txt"
    path.write_text(table(1e3 * WHEEL.y + 77.8, 1e3 * WHEEL.z, "{:.7f} {:.7f}"))
    same(profile.read(path, zero=0.0778, **COLUMNS), WHEEL, 1e-7)
    same(profile.read(path, zero="0.0778", **COLUMNS), WHEEL, 1e-7)
    with pytest.raises(ContactError, match=r"zero = 77\.8 is outside the allowed range \[0\.001, 0\.2\]"):
        profile.read(path, zero=77.8, **COLUMNS)
    with pytest.raises(ContactError, match="zero = 'back' is none of 'file', 'flange_back', 'shape'"):
        profile.read(path, zero="back", **COLUMNS)


def _sections(path, *parts):
    rows = (f"[{name}Points]\n" + table(1e3 * s.y, 1e3 * s.z, "{:.7f},{:.7f},0.0") for name, s in parts)
    path.write_text("[FileInfo]\nVersion=1\n" + "\n".join(rows) + "\n[Other]\n7 8\n")


def test_of_two_bodies_in_one_file_one_is_chosen(tmp_path):
    path = tmp_path / "pair.mpt"
    _sections(path, ("Wheel", WHEEL), ("Rail", RAIL))
    with pytest.raises(
        ContactError, match=r"2 lists of points: 1 \[WheelPoints\] with 593 points, 2 \[RailPoints\] with 443"
    ):
        profile.read(path, kind="wheel")
    same(profile.read(path, kind="wheel", section=1), WHEEL)
    same(profile.read(path, kind="rail", section=2), RAIL)
    for wrong in (3, "both", 0):
        with pytest.raises(ContactError, match="section = "):
            profile.read(path, kind="wheel", section=wrong)
    with pytest.raises(ContactError, match=r"section = 1: a file like 'a.txt' has no choice of section"):
        profile.read(tmp_path / "a.txt", section=1, **COLUMNS)


@pytest.mark.parametrize("turned", [(False, False), (True, False), (False, True), (True, True)])
def test_two_halves_in_one_file_are_joined_however_they_were_scanned(turned, tmp_path):
    y, z = WHEEL.y, WHEEL.z
    halves = [(y[:250], z[:250]), (y[250:], z[250:])]
    halves = [(a[::-1], b[::-1]) if back else (a, b) for (a, b), back in zip(halves, turned, strict=True)]
    path = tmp_path / "wheel.mpt"
    text = "".join(f"[Points]\n{table(1e3 * a, 1e3 * b, '{:.7f} {:.7f}')}\n" for a, b in halves)
    path.write_text(text)
    same(profile.read(path, kind="wheel", section="joined"), WHEEL)


@pytest.mark.parametrize(
    ("option", "said"),
    [
        ({"columns": (0, 1)}, r"columns = \(0, 1\) is not two different numbers"),
        ({"columns": (1, 1)}, "columns"),
        ({"columns": (7, 8)}, "holds no columns of numbers"),
        ({"rows": (5, 2)}, r"rows = \(5, 2\) is not the first and the last line"),
        ({"rows": (1000, 0)}, r"rows = \(1000, 0\): 'wheel.txt' has 593 lines"),
        ({"scale": 0.0}, r"scale = 0 is outside the allowed range \[0\.01, 2\]"),
    ],
)
def test_choices_outside_the_file_are_refused(option, said, tmp_path):
    path = tmp_path / "wheel.txt"
    path.write_text(table(1e3 * WHEEL.y, 1e3 * WHEEL.z, "{:.7f} {:.7f}"))
    with pytest.raises(ContactError, match=said):
        profile.read(path, **option, **COLUMNS)
    path.write_text(table(1e3 * WHEEL.y, 1e3 * WHEEL.z, "x {:.7f} 3 {:.7f}"))
    same(profile.read(path, columns=(2, 4), **COLUMNS), WHEEL, 1e-7)


def test_half_an_outline_is_refused_and_never_cut_to_its_foot(tmp_path):
    points = section()
    path = tmp_path / "half.csv"
    for half in (points[: len(points) // 2], points[len(points) // 2 :]):
        path.write_text(table(*half.T, "{:.7f};{:.7f}"))
        for repair in (False, True):
            with pytest.raises(ContactError, match=r"closed outline: .* which end is the head is not seen"):
                profile.read(path, kind="rail", unit="mm", side="right", repair=repair)
