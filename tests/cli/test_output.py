"""Command line: what is printed and written, as tables, JSON, CSV and pictures."""

import csv
import io
import json
from dataclasses import replace

import pytest
from rich.console import Console

import contact
import contact.stress
from contact.halfspace import Transient

typer = pytest.importorskip("typer")


from contact.cli import problem  # noqa: E402
from contact.cli.tables import show_table  # noqa: E402
from tests.command_line import call  # noqa: E402


def test_table_shows_the_solution_in_the_engineers_units():
    output = call("solve", "--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0, 0).output
    s = contact.solve(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3, 0.0, 0.0), load=80e3)
    line = next(row for row in output.splitlines() if "peak pressure" in row)
    assert f"{s.max_pressure * 1e-6:.1f}" in line
    assert "MPa" in line
    for word in ("normal force", "T-gamma", "Burstow", "Archard", "status"):
        assert word in output


def test_json_has_the_values_in_effect_where_a_default_is_used():
    def inputs(*words):
        return json.loads(call("solve", *words, "--y", 3e-3, "--json").stdout)["inputs"]

    assert (inputs()["load"], inputs()["inclination"]) == (80e3, 0.025)
    assert inputs("--inclination", "1/20")["inclination"] == "1/20"
    assert inputs("--penetration", 1e-4)["load"] is None
    assert inputs("--rail", "EN 15302 rail A")["inclination"] is None  # it is drawn as it lies


@pytest.mark.parametrize(
    "words",
    [
        ("patch", "--out", "{}/patch.json"),
        ("curve", "--points", 2),
        ("geometry", "--max", 1e-3, "--step", 1e-3),
        ("conicity", "--amplitude", 1e-3),
        ("profiles",),
        ("methods",),
        ("compare", "--curvatures", 1, 1, "--no-reference"),
    ],
)
def test_every_command_has_json(words, tmp_path):
    answer = json.loads(call(*(str(word).format(tmp_path) for word in words), "--json").stdout)
    assert (answer["version"], answer["command"]) == (contact.__version__, words[0])
    assert {"inputs", "units"} < set(answer)


def test_results_are_written_as_json_and_csv_with_any_command(tmp_path):
    paths = [tmp_path / name for name in ("a.json", "a.csv")]
    shown = json.loads(call("solve", "--json", "--out", paths[0], "--out", paths[1]).stdout)
    assert json.loads(paths[0].read_text(encoding="utf-8")) == shown
    (row,) = csv.DictReader(paths[1].open(encoding="utf-8"))
    assert float(row["damage.T_gamma"]) == shown["patches"][0]["damage"]["T_gamma"]
    assert float(row["position.1"]) == shown["patches"][0]["position"][1]


def test_units_of_headings_are_not_swallowed_by_markup():
    assert "spin creepage [1/m]" in call("curve", "--over", "spin", "--points", 2).stdout
    assert "amplitude [mm]" in call("conicity", "--amplitude", 1e-3).stdout


def test_absurd_input_is_answered_with_a_warning_on_one_line():
    for words, wanted in (
        (("--y", -0.02), "contact: warning: --y -0.02: a flange touches at about 0.007 m; the unit is m"),
        (("--load", 80, "--side", "both"), "contact: warning: --load 80: a wheel carries 20 to 150 kN; the unit is N"),
        (("--friction", 30), "contact: warning: --friction 30: steel on steel has 0.05 to 0.6"),
        (
            ("--creepage", -0.128, 0, 0),
            "contact: warning: --creepage: creepage.longitudinal = -0.128: a rolling wheel has less",
        ),
    ):
        result = call("solve", *words)
        assert wanted in result.stderr
        assert result.stderr.count("\n") == 1, "and nothing else"
    assert call("solve").stderr == ""


@pytest.mark.parametrize("words", [("check", "{}"), ("solve", "--wheel", "{}"), ("in-time", "{}", "--load", 8e4)])
def test_a_file_that_the_command_reads_is_not_written_over(words, tmp_path):
    file = tmp_path / "measured.csv"
    file.write_text("time,pose.y\n0,0\n")
    (tmp_path / "x").mkdir()
    assert (
        "the command reads it"
        in call(*(str(word).format(file) for word in words), "--out", tmp_path / "x" / ".." / file.name, code=2).stderr
    )
    assert file.read_text().startswith("time")


def test_a_file_that_cannot_be_written_is_refused_before_the_computation(tmp_path, monkeypatch):
    monkeypatch.setattr("contact.cli.arguments.solve_position", None)
    assert "there is no folder" in call("solve", "--out", tmp_path / "no/a.csv", code=2).stderr
    assert "a file ends in one of" in call("solve", "--out", tmp_path / "a.docx", code=2).stderr


def test_messages_name_the_option_that_was_typed():
    assert call("solve", "--radius", 460, code=2).stderr.startswith(
        "contact: --radius 460 is outside the allowed range"
    )
    said = call("solve", "--gauge", 1.668, code=2).stderr
    assert said.startswith("contact: --y 0: ")
    assert "--gauge 1.668 and --back-to-back 1.36 hardly belong to one track" in said
    assert "--back-to-back 0.01 is outside" in call("geometry", "--back-to-back", 0.01, code=2).stderr
    said = call("solve", "--speed", 300, "--yaw", 0.06, "--load", 500).stderr.splitlines()
    assert sorted(line.split(":")[2] for line in said) == [" --load 500", " --speed 300", " --yaw 0.06"]


def test_a_decimal_comma_is_named():
    said = call("solve", "--friction", "0,35", code=2).stderr
    assert said == "contact: --friction 0,35: numbers have a decimal point, 0.35\n"
    assert "-1,5e-3: numbers have a decimal point, -1.5e-3" in call("solve", "--y", "-1,5e-3", code=2).stderr


def test_a_standing_wheelset_is_told_to_have_no_creep_forces():
    assert "contact: warning: --speed 0: the wheelset stands" in call("solve", "--speed", 0).stderr


@pytest.mark.parametrize(
    "words",
    [
        ("solve", "--curvatures", 1, 1),
        ("patch", "--out", "{}/patch.png"),
        ("stress", "--curvatures", 1, 1),
        ("curve", "--points", 2),
        ("transient", "--distance", 1e-3),
    ],
)
def test_results_that_are_not_to_be_trusted_end_with_3(words, monkeypatch, tmp_path):
    """All solutions of the command are given the status UNREACHABLE."""

    def untrusted(made):
        return lambda *args, **kwargs: replace(made(*args, **kwargs), status=contact.Status.UNREACHABLE)

    monkeypatch.setattr(problem, "solve", untrusted(problem.solve))
    monkeypatch.setattr(Transient, "roll", untrusted(Transient.roll))
    answer = call(*(str(word).format(tmp_path) for word in words), code=3)
    assert "are not to be trusted: unreachable" in answer.stderr


def test_a_table_in_a_narrow_terminal_loses_no_digit():
    written = io.StringIO()
    numbers = ["5.7394e+09", "-2.3842e-14", "0.00011496"]
    show_table("", [("case", ""), *[("max_pressure", "Pa")] * 3], [["1", *numbers]], Console(file=written, width=30))
    assert "…" not in written.getvalue()
    *_, row = written.getvalue().partition("─\n")
    columns = [line.split() for line in row.splitlines() if line.strip()]
    assert sorted("".join(part for line in columns for part in line)) == sorted("1" + "".join(numbers))
