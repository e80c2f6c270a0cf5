"""`contact compare`: the numbers of the Python API, files of cases, refusals."""

import json

import pytest

import contact

pytest.importorskip("typer")

from contact.study.pairs import RESOLUTION
from tests.command_line import call

QUICK = ("--method", "hertz+fastsim", "--reference-elements", 12)


def rows(*words):
    return json.loads(call("compare", *words, *QUICK, "--json").stdout)["cases"]


def test_options_are_those_of_solve():
    words = ("--curvatures", 1.1, 0.8, "--creepage", -1e-3, 2e-3, 0.1, "--load", 60e3, "--friction", 0.4)
    case = rows(*words)[0]
    s = contact.solve(
        contact.Separation.hertzian(1.1, 0.8),
        contact.Creepage(-1e-3, 2e-3, 0.1),
        load=60e3,
        friction=0.4,
        normal="hertz",
        tangential="fastsim",
        n_strips=RESOLUTION,
        n_elements=RESOLUTION,
    )
    assert [r["normal"] for r in case["results"]] == ["halfspace", "hertz"]
    assert case["results"][1]["Fy"] == s.Fy
    assert case["results"][0]["errors"] is None


def test_rails_and_wheels_make_a_case_a_patch():
    names = [case["name"] for case in rows("--y", 1e-3, "--side", "both")]
    assert names == [f"S1002 on 60E1, y = 1 mm, yaw 0 mrad, {side} 1" for side in ("left", "right")]


FILES = {
    "cases.toml": (
        'friction = 0.2\n[[case]]\nname = "a"\ncurvatures = [1.1, 0.8]\ncreepage = [1e-3, 0, 0]\n'
        '[[case]]\nname = "b"\ncurvatures = [1, 2]\nload = 2e4\nfriction = 0.5\n'
    ),
    "cases.json": json.dumps(
        {
            "friction": 0.2,
            "case": [
                {"name": "a", "curvatures": [1.1, 0.8], "creepage": [1e-3, 0, 0]},
                {"name": "b", "curvatures": [1, 2], "load": 2e4, "friction": 0.5},
            ],
        }
    ),
    "cases.csv": "# two\nname,curvatures,creepage,load,friction\na,1.1 0.8,1e-3 0 0,,0.2\nb,1 2,,2e4,0.5\n",
}


@pytest.mark.parametrize("name", FILES)
def test_files_of_cases_say_the_same(tmp_path, name):
    (tmp_path / name).write_text(FILES[name])
    a, b = rows(tmp_path / name, "--load", 3e4)
    assert (a["name"], a["load"], a["friction"], a["creepage"]["longitudinal"]) == ("a", 3e4, 0.2, 1e-3)
    assert (b["name"], b["load"], b["friction"], b["creepage"]["longitudinal"]) == ("b", 2e4, 0.5, 0.0)
    assert b["results"][1]["max_pressure"] == pytest.approx(contact.hertz(1, 2, load=2e4).p0)


@pytest.mark.slow
@pytest.mark.usefixtures("drawn_once")
def test_tables_and_files(tmp_path):
    pytest.importorskip("matplotlib")
    files = [tmp_path / f"out.{ending}" for ending in ("html", "csv", "png", "json")]
    words = [word for path in files for word in ("--out", path)]
    result = call("compare", "--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0, 0, *QUICK, *words)
    assert all(path.stat().st_size > 500 for path in files)
    for word in ("hertz", "+ fastsim", "errors against the half space", "approach"):
        assert word in result.stdout


def test_no_contact_has_nothing_to_compare():
    assert "no contact" in call("compare", "--penetration", 0.0).output


@pytest.mark.parametrize(
    ("file", "text", "message"),
    [
        ("cases.txt", "", "a file of cases ends in one of .toml, .json, .csv"),
        ("cases.toml", "x = ", "cannot be read"),
        ("cases.toml", "y = 1", "there is no list of cases called 'case'"),
        ("cases.json", "[]", "holds no case"),
        ("cases.json", "[3]", "case 1: 3 is not a table"),
        ("cases.json", '[{"weight": 3}]', "case 1: unknown name 'weight'; allowed: name, wheel"),
        ("cases.json", '[{"load": "heavy"}]', "case 1: load = 'heavy' is not a number"),
        ("cases.json", '[{"creepage": [1, 2]}]', "case 1: creepage = [1, 2] is not a list of 3 numbers"),
        ("cases.json", '[{"curvatures": [1, 1], "wheel": "s1002"}]', "case 1: wheel: curvatures replace wheel"),
        ("cases.json", '[{"side": "top"}]', "case 1: side = 'top' is none of left, right, both"),
        ("cases.csv", "load,y\n3", "more or fewer cells than names"),
    ],
)
def test_files_without_valid_cases_are_refused(tmp_path, file, text, message):
    (tmp_path / file).write_text(text)
    assert message in " ".join(call("compare", tmp_path / file, code=2).stderr.split())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("missing.toml",), "missing.toml cannot be read: No such file"),
        (("--out", "table.xls"), "table.xls cannot be written: a file ends in one of .html"),
        (("--method", "magic+fastrip"), "normal = 'magic'"),
        (("--reference-elements", "1"), "--reference-elements 1"),
    ],
)
def test_bad_options_end_with_code_2(words, message):
    assert message in call("compare", *words, code=2).stderr
