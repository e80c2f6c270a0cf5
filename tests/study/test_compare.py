"""`contact.compare`: content of the rows, compatible methods, content of the files."""

import csv
import io
import json
import math
import re

import numpy as np
import pytest

import contact
from contact.study import REFERENCE, SELECTION, comparison, every_pair, pairs_of
from contact.study.table import number
from tests.study.page import Page
from tests.study.problems import METHODS, problem


def test_rows_are_what_solve_returns(small):
    case = small.cases[0]
    for (normal, tangential), row in zip(small.pairs[1:], small.rows[1:3], strict=True):
        s = contact.solve(**case.arguments, normal=normal, tangential=tangential, n_strips=12, n_elements=12)
        assert (row.normal, row.tangential, row.status) == (normal, tangential, "OK")
        for name in ("N", "approach", "Fx", "Fy", "Mz", "max_pressure", "area"):
            assert getattr(row, name) == getattr(s, name), name
        assert row.adhesion_area == pytest.approx(s.area - s.slip_area, rel=1e-12)
        assert row.time > 0.0


def test_errors_are_measured_against_the_half_space(small):
    true, _, analyn = small.rows[:3]
    assert (true.normal, true.tangential, true.errors) == (*REFERENCE, None)
    e, mu_n = analyn.errors, 0.3 * 60e3
    assert e.force == pytest.approx(math.hypot(analyn.Fx - true.Fx, analyn.Fy - true.Fy) / mu_n, rel=1e-6)
    assert e.moment == pytest.approx(abs(analyn.Mz - true.Mz) / mu_n / math.sqrt(true.area / math.pi), rel=1e-6)
    assert e.max_pressure == pytest.approx(analyn.max_pressure / true.max_pressure - 1.0)
    assert e.approach == pytest.approx(analyn.approach / true.approach - 1.0)
    # ANALYN is exact on an ellipse, so its pressure differs only by the grid error
    assert 0.0 < e.pressure < 0.05
    assert abs(e.N) < 1e-9


def test_a_gap_that_starts_elsewhere_changes_no_error():
    s = contact.Separation.hertzian(1.1, 0.8)
    lifted = contact.Separation(s.y, s.g + 1e-3, s.A)
    errors = []
    for separation in (s, lifted):
        case = contact.Case(separation, contact.Creepage(), load=60e3)
        errors.append(contact.compare(case, "kik_piotrowski+fastrip", reference_elements=12).rows[1].errors.approach)
    assert errors[1] == pytest.approx(errors[0], rel=1e-6)
    assert abs(errors[0]) > 0.02


def test_no_contact_is_a_valid_result(small):
    for row in small.rows[3:]:
        assert (row.status, row.N, row.area, row.adhesion_area, row.errors) == ("NO_CONTACT", 0.0, 0.0, 0.0, None)


def test_without_a_reference_there_are_no_errors():
    found = contact.compare(problem(), "hertz+fastrip", reference=False)
    assert [str(pair) for pair in found.pairs] == ["hertz+fastrip"]
    assert found.rows[0].errors is None
    assert not found.has_reference


def test_forces_alone_have_no_stick_area():
    pytest.importorskip("matplotlib")
    found = contact.compare(problem(), ("hertz+polach", "hertz+fastrip"), reference=False)
    assert found.rows[0].adhesion_area is None
    assert found.rows[1].adhesion_area > 0.0
    assert next(csv.DictReader(io.StringIO(found.csv())))["adhesion_area"] == ""
    titles = [ax.get_title(loc="left") for ax in found.figure().subfigs[0].axes]
    assert sum("forces only" in title for title in titles) == 1


def test_pairs_of_methods_are_selected_by_name():
    assert pairs_of("analyn+fastrip") == pairs_of([("analyn", "fastrip")]) == (("analyn", "fastrip"),)
    assert pairs_of(["hertz+fastsim", "all"]) == (
        ("hertz", "fastsim"),
        *(pair for pair in every_pair() if pair != ("hertz", "fastsim")),
    )
    assert set(SELECTION) < set(every_pair())
    assert REFERENCE in every_pair()
    known = contact.methods()
    assert len(every_pair()) == len(known.batched.normal) * len(known.tangential) + 1


def test_progress_runs_from_zero_to_one():
    told = []
    contact.compare(problem(), METHODS, reference_elements=8, progress=lambda share, what: told.append((share, what)))
    shares = [share for share, _ in told]
    assert shares[0] == 0.0
    assert shares[-1] == 1.0
    assert shares == sorted(shares)
    assert any("halfspace+halfspace, step" in what for _, what in told)


def test_json_and_csv_hold_every_number(small):
    cases = json.loads(small.json())["cases"]
    assert [case["name"] for case in cases] == ["ellipse", "apart"]
    assert cases[0]["creepage"]["spin"] == 0.1
    lines = list(csv.DictReader(io.StringIO(small.csv())))
    assert len(lines) == len(small.rows) == 6
    for k, (row, line) in enumerate(zip(small.rows, lines, strict=True)):
        result = cases[k // 3]["results"][k % 3]
        assert result["Fx"] == row.Fx == float(line["Fx"])
        assert (line["error_force"] == "") == (row.errors is None)
    assert "NaN" not in small.json()
    lines = small.markdown().splitlines()
    assert "| method | approach [µm] | peak pressure [MPa] |" in next(line for line in lines if "peak pressure" in line)
    assert sum(line.startswith("| hertz + fastsim |") for line in lines) == 3  # no errors without contact


def test_the_dataset_is_labelled_by_case_and_method(small):
    pytest.importorskip("xarray")
    data = small.to_xarray()
    assert dict(data.sizes) == {"case": 2, "pair": 3}
    at = data.sel(case="ellipse", pair="analyn+fastrip")
    assert float(at.Fx) == small.rows[2].Fx
    assert float(at.error_force) == small.rows[2].errors.force
    assert np.isnan(data.error_force.sel(pair=str(REFERENCE))).all()
    assert data.status.sel(case="apart").values.tolist() == ["NO_CONTACT"] * 3


@pytest.mark.slow
@pytest.mark.usefixtures("drawn_once")
def test_the_page_needs_nothing_from_outside(small):
    pytest.importorskip("matplotlib")
    text = small.html()
    page = Page()
    page.feed(text)
    assert page.tags.count("picture") == 2
    assert len(page.links) == 4
    assert all(link.startswith("data:image/png;base64,") for link in page.links)
    assert not re.search(r"https?://|url\(|@import", text)
    assert "script" not in page.tags
    assert number(small.rows[0].max_pressure * 1e-6) in page.cells
    assert "no contact" in page.cells


@pytest.mark.usefixtures("undrawn")
def test_names_are_text_and_not_markup_on_the_page():
    pytest.importorskip("matplotlib")
    text = contact.compare(problem("<b>&"), "hertz+fastrip", reference=False).html()
    assert "<b>&" not in text
    assert "&lt;b&gt;&amp;" in text


@pytest.mark.slow
def test_pictures_show_one_panel_a_method(small, tmp_path):
    pytest.importorskip("matplotlib")
    figure = small.figure()
    panels = [ax for part in figure.subfigs for ax in part.axes if ax.get_title(loc="left")]
    assert len(panels) == 2 * len(small.rows)
    limits = {(ax.get_xlim(), ax.get_ylim()) for ax in figure.subfigs[0].axes if ax.get_title(loc="left")}
    assert len(limits) == 1
    small.write(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").read_bytes()[:4] == b"\x89PNG"


def test_with_many_pairs_every_method_with_fields_is_drawn_once(monkeypatch):
    monkeypatch.setattr(comparison, "MOST_PANELS", 3)
    methods = ("hertz+polach", "hertz+fastsim", "analyn+fastsim", "hertz+fastrip", "analyn+fastrip")
    found = contact.compare(problem(), methods, reference=False)
    assert [str(found.pairs[k]) for k in found.drawn] == ["hertz+fastsim", "analyn+fastsim", "hertz+fastrip"]


@pytest.mark.parametrize("name", ["table.txt", "nowhere/at/all.csv"])
def test_files_that_cannot_be_written(small, tmp_path, name):
    with pytest.raises(contact.ContactError, match="cannot be written"):
        small.write(tmp_path / name)


def test_full_slip_leaves_no_stick():
    slipping = contact.Case(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(0.1, 0.1, 0.0), load=60e3)
    rows = contact.compare(slipping, METHODS, reference=False).rows
    assert [(row.status, row.adhesion_area) for row in rows] == [("SATURATED", 0.0)] * 2
