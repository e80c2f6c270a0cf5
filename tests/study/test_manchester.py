"""Manchester contact benchmark: the half space reproduces CONTACT's published numbers, and content of the tables."""

import csv
import io
import json
import math

import pytest

from contact.study import Comparison
from contact.study.manchester import Manchester, manchester, places
from tests.study.page import Page


@pytest.fixture(scope="module")
def three():
    """Return results at 1 mm on both sides and at 10 mm (flange), with a coarse half space."""
    chosen = [place for place in places() if place.name in ("1 mm right", "1 mm left", "10 mm right")]
    return manchester("analyn+fastrip", at=chosen, reference_elements=40)


def test_signs_and_units_are_ours():
    right = next(place for place in places() if place.name == "5 mm right")
    assert (right.y, right.yaw, right.angle) == (5e-3, 12e-3, -0.2905)
    # the wheel steers to the right: lateral creepage to the left, force to the right; the 10 kN include friction
    assert right.lateral == pytest.approx(-right.yaw / math.cos(right.angle), rel=5e-3)
    assert right.Fy > 0.0
    assert right.N * math.cos(right.angle) - right.Fy * math.sin(right.angle) == pytest.approx(10e3, rel=1e-4)
    assert right.spin == pytest.approx(math.sin(right.angle) / 0.46, rel=0.01)
    assert len(places()) == 9


def test_the_half_space_meets_contact(three):
    for place, patch, (case, rows, _) in zip(three.places, three.patches, three.comparison.by_case(), strict=True):
        true = rows[0]
        assert patch.angle == pytest.approx(place.angle, abs=1e-4), place.name
        assert case.load == pytest.approx(place.N, rel=1e-3), place.name
        assert math.hypot(true.Fx - place.Fx, true.Fy - place.Fy) < 0.004 * 0.3 * place.N, place.name
        # CONTACT's patch at 10 mm has four rows of elements
        tolerance = 0.005 if place.y < 5e-3 else 0.035
        assert true.approach == pytest.approx(place.approach, rel=tolerance), place.name
        assert true.max_pressure == pytest.approx(place.max_pressure, rel=tolerance), place.name


def test_tables_set_methods_beside_contact(three):
    tables = three.tables()
    assert [row[0] for row in tables[0].rows] == [
        "1 mm right", "  CONTACT", "1 mm left", "  CONTACT", "10 mm right", "  CONTACT",
    ]  # fmt: skip
    peak = next(table for table in tables if table.caption.startswith("Peak pressure"))
    analyn = next(row for row in peak.rows if row[0] == "analyn + fastrip")
    place, solution = three.places[0], three.comparison.solutions[1]
    assert float(analyn[1]) == pytest.approx(100 * (solution.max_pressure / place.max_pressure - 1), abs=0.01)
    assert len(tables[-1].rows) == 0  # CONTACT's KPEC and ANALYN are published for other positions


@pytest.mark.slow
def test_files_hold_ours_and_contacts(three):
    pytest.importorskip("matplotlib")
    lines = list(csv.DictReader(io.StringIO(three.csv())))
    assert len(lines) == 6
    assert float(lines[0]["max_pressure_contact"]) == 741.3e6
    content = json.loads(three.json())
    assert content["cases"][0]["contact"]["N"] == 9827.0
    assert "|   CONTACT | -69.60 | 9827 |" in three.markdown()
    c = three.comparison
    first = Comparison(c.cases[:1], c.pairs, c.rows[:2], c.solutions[:2])
    one = Manchester(three.places[:1], three.patches[:1], first, {name: s[:1] for name, s in three.fast.items()})
    page = Page()
    page.feed(one.html())
    assert page.tags.count("picture") == 1
    assert all(link.startswith("data:image/png;base64,") for link in page.links)


def test_the_command_shows_kpec_as_it_is():
    pytest.importorskip("typer")
    from tests.command_line import call

    words = ("--method", "hertz+fastsim", "--reference-elements", 20)
    output = call("manchester", *words).stdout
    line = next(row.split() for row in output.splitlines() if row.startswith("kpec, 0 mm right"))
    ours, theirs = map(float, line[-2:])
    assert theirs == 442.6  # of one row at the edge, where CONTACT does not cap the depth of the cut
    assert ours == pytest.approx(302.0, abs=2.0)  # CONTACT's number with the cap
    assert "CONTACT gives 302 MPa and 14.0 µm" in " ".join(output.split())
