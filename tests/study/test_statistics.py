"""The 3220 cases: design, errors over a sample, and resumption of an interrupted run."""

import json
import math

import numpy as np
import pytest

import contact
from contact.study.design import ELLIPSES, FRICTION, LOAD, MATERIAL, design
from contact.study.pairs import RESOLUTION
from contact.study.reference import reference_forces, separation_of
from contact.study.statistics import statistics
from tests.study.page import Page

TESTED = ("fastsim", "fastrip")


@pytest.fixture(scope="module")
def sample():
    return statistics(TESTED, cases=12, elements=16, processes=1)


def test_the_design_is_that_of_the_test_bank():
    d = design()
    assert d.number.size == 3220
    # theory.md 10: the first case with creepage is a = 4 mm, b = 20 mm, no spin, -90 degrees, m = 0.1
    assert ELLIPSES[d.ellipse[1]][:2] == (4e-3, 20e-3)
    assert (d.chi[1], d.angle[1], d.size[1]) == (0.0, -90.0, 0.1)
    assert d.lateral[1] == pytest.approx(-0.1 * 0.3 * math.sqrt(80.0) / 1772.0)
    assert abs(d.longitudinal[1]) < 1e-18
    assert d.spin[-1] == pytest.approx(2.0 * 0.3 / 1.772)
    assert sorted({float(f"{1e3 * c:.3f}") for c in d.c}) == [8.485, 8.944, 9.0]
    for k, (a, b, _) in enumerate(ELLIPSES):
        s = separation_of(k)
        curved = contact.hertz(float(s.A[0]), float(s.g[-1] / s.y[-1] ** 2), load=LOAD, material=MATERIAL)
        assert (curved.a, curved.b) == pytest.approx((a, b), rel=1e-6)


def test_every_case_belongs_to_one_class_of_each_kind():
    d = design()
    for kind, classes in d.classes().items():
        assert sum(own.astype(int) for own in classes.values()).tolist() == [1] * 3220, kind


def test_a_sample_is_always_the_same_and_spread_over_the_list():
    numbers = design(300).number
    assert numbers.tolist() == design(300).number.tolist() == sorted(set(numbers.tolist()))
    assert numbers.size == 300
    for classes in design(300).classes().values():
        assert all(own.any() for own in classes.values())


def test_errors_are_those_of_single_solves(sample):
    d = sample.design
    scale = FRICTION * LOAD
    for k in (3, 8):
        s = contact.solve(
            separation_of(int(d.ellipse[k])),
            contact.Creepage(float(d.longitudinal[k]), float(d.lateral[k]), float(d.spin[k])),
            load=LOAD,
            friction=FRICTION,
            material=MATERIAL,
            normal="hertz",
            tangential="fastrip",
            n_strips=RESOLUTION,
            n_elements=RESOLUTION,
        )
        force, moment = sample.errors("fastrip")
        Fx, Fy, Mz = sample.reference[k]
        assert force[k] == pytest.approx(math.hypot(s.Fx / scale - Fx, s.Fy / scale - Fy), abs=1e-9)
        assert moment[k] == pytest.approx(abs(s.Mz / (scale * d.c[k]) - Mz), abs=1e-9)
    overall = next(s for s in sample.spreads() if (s.method, s.classes) == ("fastrip", "all"))
    assert overall.force_mean == pytest.approx(force.mean())
    assert overall.force_max == force.max()
    assert overall.cases == 12


def test_the_half_space_converges(sample):
    finer, finest = (reference_forces(sample.design, n, processes=1) for n in (24, 48))
    coarse, fine = (np.abs(f - finest).mean() for f in (sample.reference, finer))
    assert fine < 0.6 * coarse < 0.006


def test_an_interrupted_run_goes_on(tmp_path, sample, monkeypatch):
    from contact.study import reference

    path, d = tmp_path / "kept.csv", sample.design
    monkeypatch.setattr(reference, "_CHUNK", 4)

    def stop(share, what):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reference_forces(d, 16, stored=path, processes=1, progress=stop)
    assert len(path.read_text().splitlines()) == 1 + 4
    with path.open("a") as file:
        file.write("77,0.1")  # killed within a line
    solved = []
    solve = reference.solve
    monkeypatch.setattr(reference, "solve", lambda *a, **k: solved.append(a) or solve(*a, **k))
    again = reference_forces(d, 16, stored=path, processes=1)
    assert len(solved) == 8
    assert again == pytest.approx(sample.reference, abs=1e-8)
    assert reference_forces(d, 16, stored=path, processes=1) == pytest.approx(again, abs=1e-8)
    assert len(solved) == 8


def test_files_of_another_run_are_refused(tmp_path, sample):
    path = tmp_path / "kept.csv"
    path.write_text("something\n1,2,3,4\n")
    with pytest.raises(contact.ContactError, match="holds other results"):
        reference_forces(sample.design, 16, stored=path, processes=1)
    heading = "# number,Fx/muN,Fy/muN,Mz/muNc by the half space with 16 x 16 elements on the ellipse"
    path.write_text(f"{heading}\n1,2,x,4\n")
    with pytest.raises(contact.ContactError, match="is damaged: '1,2,x,4'"):
        reference_forces(sample.design, 16, stored=path, processes=1)


@pytest.mark.slow
def test_two_processes_give_the_same(sample):
    two = statistics(["fastrip"], cases=22, elements=8, processes=2)
    one = statistics(["fastrip"], cases=22, elements=8, processes=1)
    assert two.reference.tolist() == one.reference.tolist()


def test_files_hold_the_errors(sample, tmp_path):
    pytest.importorskip("matplotlib")
    for ending in ("json", "csv", "html", "md", "png"):
        sample.write(tmp_path / f"out.{ending}")
    content = json.loads((tmp_path / "out.json").read_text())
    assert content["cases"] == 12
    assert {e["method"] for e in content["errors"]} == set(TESTED)
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 13
    assert "| fastrip | " in (tmp_path / "out.md").read_text()
    page = Page()
    page.feed((tmp_path / "out.html").read_text())
    assert all(link.startswith("data:image/png;base64,") for link in page.links)
    assert page.tags.count("table") == 4


def test_the_command_prints_what_python_computes():
    pytest.importorskip("typer")
    from tests.command_line import call

    words = ("--cases", 12, "--elements", 16, "--processes", 1, "--tangential", "fastsim", "--tangential", "fastrip")
    output = call("statistics", *words).stdout
    assert "Errors over 12 cases" in output
    content = json.loads(call("statistics", *words, "--json").stdout)
    expected = statistics(TESTED, cases=12, elements=16, processes=1).spreads()
    assert content["errors"][0]["force_mean"] == expected[0].force_mean
    assert "elements = 1 " in call("statistics", "--elements", 1, code=2).stderr
