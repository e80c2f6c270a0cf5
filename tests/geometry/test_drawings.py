"""Profiles in drawings (.dxf) and workbooks (.xlsx), and what is said without their readers."""

import itertools
import sys
import warnings

import numpy as np
import pytest

from contact import ContactError
from contact.errors import ProfileWarning
from contact.geometry import profile, standard
from contact.geometry.outline import Arc, Straight
from tests.geometry.written import COLUMNS, WHEEL, same

RAIL = {"kind": "rail", "unit": "mm", "side": "right"}
UPRIGHT = profile.rail_60e1(inclination=0.0)


def drawn(path, add, unit=4):
    """Write a drawing in which `add` draws on the model space, and return its path."""
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new("R2010")
    drawing.header["$INSUNITS"] = unit
    add(drawing.modelspace())
    drawing.saveas(path)
    return path


def segments(space):
    """Draw rail 60E1 as lines and arcs of the standard, z up, in no order."""
    pieces = standard.RAILS["60E1"].outline()
    for k in np.random.default_rng(1).permutation(len(pieces)):
        piece = pieces[k]
        if isinstance(piece, Straight):
            space.add_line((piece.y1, -piece.z1), (piece.y0, -piece.z0))
        else:
            assert isinstance(piece, Arc)
            start, end = (np.degrees(np.arccos((y - piece.cy) / piece.radius)) for y in (piece.y1, piece.y0))
            space.add_arc((piece.cy, -piece.cz), piece.radius, start, end)


def near(found, tolerance):
    """Assert that the profile lies on rail 60E1."""
    inside = np.abs(found.y) < 0.034
    assert np.abs(found.z[inside] - np.interp(found.y[inside], UPRIGHT.y, UPRIGHT.z)).max() < tolerance
    assert np.ptp(found.y) == pytest.approx(np.ptp(UPRIGHT.y), abs=1e-6)


def test_lines_and_arcs_are_joined_in_whatever_order_they_were_drawn(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = profile.read(drawn(tmp_path / "rail.dxf", segments), **RAIL)
    near(found, 1.2e-6)  # of the chords of the points to compare with
    crown = np.abs(found.y) < 0.008
    assert np.median(np.abs(np.diff(found.angle[crown]) / np.diff(found.y[crown]))) == pytest.approx(1 / 0.3, rel=1e-3)


@pytest.mark.parametrize("kind", ["lwpolyline", "polyline", "spline", "block"])
def test_polylines_splines_and_blocks_are_read(kind, tmp_path):
    points = [(1e3 * y, -1e3 * z) for y, z in zip(UPRIGHT.y, UPRIGHT.z, strict=True)]

    def add(space):
        if kind == "lwpolyline":
            space.add_lwpolyline(points)
        elif kind == "polyline":
            space.add_polyline2d(points)
        elif kind == "spline":
            space.add_spline([*points[::4], points[-1]])
        else:
            block = space.doc.blocks.new("RAIL")
            block.add_lwpolyline(points)
            space.add_blockref("RAIL", (0.0, 0.0))

    near(profile.check(drawn(tmp_path / "rail.dxf", add), **RAIL).profile, 3e-5 if kind == "spline" else 1e-6)


def test_a_polyline_with_bulges_has_arcs(tmp_path):
    path = drawn(tmp_path / "disc.dxf", lambda space: space.add_lwpolyline([(-20, 0, -0.2), (20, 0, 0)], format="xyb"))
    found = profile.check(path, **RAIL).profile
    radius = 20.0 / np.sin(2.0 * np.arctan(0.2))
    bend = np.diff(found.angle) / np.hypot(np.diff(found.y), np.diff(found.z))
    assert np.median(bend) == pytest.approx(1e3 / radius, rel=1e-3)


def test_of_several_lines_one_is_chosen_and_the_drawings_unit_is_told(tmp_path):
    def add(space):
        segments(space)
        space.add_line((-200, -300), (200, -300))

    path = drawn(tmp_path / "rail.dxf", add, unit=1)
    with pytest.raises(ContactError, match=r"2 lists of points: 1 line 400 wide and 0 high .*, 2 line 73\.2 wide"):
        profile.read(path, **RAIL)
    with pytest.warns(ProfileWarning, match="its unit is inch"):
        near(profile.read(path, section=2, **RAIL), 1.2e-6)


@pytest.mark.parametrize("axes", [(0, 2), (1, 2)])
def test_a_section_that_rises_out_of_the_drawings_plane_is_refused(axes, tmp_path):
    points = np.zeros((UPRIGHT.y.size, 3))
    points[:, axes] = np.column_stack((1e3 * UPRIGHT.y, -1e3 * UPRIGHT.z))
    path = drawn(tmp_path / "rail.dxf", lambda space: space.add_polyline3d(points))
    with pytest.raises(ContactError, match="lines that rise by"):
        profile.read(path, **RAIL)


def test_joined_takes_all_lines_of_a_drawing_however_many(tmp_path):
    points = np.column_stack((1e3 * UPRIGHT.y, -1e3 * UPRIGHT.z))

    def add(space):
        for part in np.array_split(points, 20):  # with gaps of .25 mm
            space.add_lwpolyline(part)

    path = drawn(tmp_path / "rail.dxf", add)
    with pytest.raises(ContactError, match=r"holds 20 lists of points: 1 line .* and 8 more; set section"):
        profile.read(path, **RAIL)
    near(profile.read(path, section="joined", **RAIL), 1e-6)


def test_a_whole_rail_in_a_drawing_is_cut_to_its_head(tmp_path):
    half = [(36.6, 39.5), (20, 48), (8.25, 60), (8.25, 140), (30, 155), (75, 160.5), (75, 172)]

    def add(space):
        segments(space)
        end = (1e3 * UPRIGHT.y[-1], -1e3 * UPRIGHT.z[-1])
        for side in (1, -1):
            corners = [(side * end[0], end[1]), *((side * y, -z) for y, z in half)]
            for a, b in itertools.pairwise(corners):
                space.add_line(a, b)
        space.add_line((75, -172), (-75, -172))

    with pytest.warns(ProfileWarning, match="kept is its head"):
        found = profile.read(drawn(tmp_path / "section.dxf", add), **RAIL)
    assert abs(found.y[np.argmin(found.z)]) < 5e-4
    assert np.ptp(found.z) < 0.04


def workbook(path, *sheets):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.remove(book.active)
    for title, rows in sheets:
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


def test_a_sheet_of_a_workbook_is_read_with_false_rows_left_out(tmp_path):
    rows = [[1e3 * y, 1e3 * z] for y, z in zip(WHEEL.y, WHEEL.z, strict=True)]
    path = workbook(tmp_path / "wheel.xlsx", ("notes", [["nothing"]]), ("scan", [["y", "z"], *rows]))
    same(profile.read(path, **COLUMNS), WHEEL, 1e-12)
    missing = [
        [None, "y", "z"],
        *([None, *row] for row in rows[:100]),
        [None, 3.5, None],
        *([None, *row] for row in rows[100:]),
    ]
    path = workbook(tmp_path / "gap.xlsx", ("scan", missing))
    with pytest.warns(ProfileWarning, match="false rows: 1 of 594"):
        same(profile.read(path, **COLUMNS), WHEEL, 1e-12)
    path = workbook(tmp_path / "two.xlsx", ("left", rows), ("right", rows))
    with pytest.raises(ContactError, match="2 lists of points: 1 sheet 'left' with 593 points"):
        profile.read(path, **COLUMNS)
    same(profile.read(path, section=2, rows=(1, 0), columns=(1, 2), **COLUMNS), WHEEL, 1e-12)


def test_a_column_of_a_workbook_that_counts_the_rows_is_passed_over(tmp_path):
    rows = [[k, 1e3 * y, 1e3 * z] for k, (y, z) in enumerate(zip(WHEEL.y, WHEEL.z, strict=True), 1)]
    with pytest.warns(ProfileWarning, match="the first column counts the rows"):
        same(profile.read(workbook(tmp_path / "wheel.xlsx", ("scan", rows)), **COLUMNS), WHEEL, 1e-12)


@pytest.mark.parametrize(("name", "module"), [("dxf", "ezdxf"), ("xlsx", "openpyxl")])
def test_a_missing_reader_is_named_with_its_extra(name, module, tmp_path, monkeypatch):
    path = tmp_path / f"wheel.{name}"
    path.write_text("0\nSECTION\n")
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf"wheelrail-contact\[{name}\]"):
        profile.read(path, **COLUMNS)


@pytest.mark.parametrize(
    "content", [b"", b"hello", b"PK\x03\x04" + bytes(300), b"0\nSECTION\n2\nHEADER\n", bytes(range(256))]
)
@pytest.mark.parametrize("name", ["dxf", "xlsx"])
def test_what_is_no_drawing_or_workbook_is_refused(name, content, tmp_path):
    pytest.importorskip("ezdxf")
    pytest.importorskip("openpyxl")
    path = tmp_path / f"wheel.{name}"
    path.write_bytes(content)
    with pytest.raises(ContactError, match="wheel"):
        profile.read(path, **COLUMNS)
