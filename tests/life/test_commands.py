"""`contact run` from file to report, with an interruption."""

import csv
import json
import signal
from pathlib import Path

import pytest
import scipy.io
import typer
import xarray
from typer.testing import CliRunner

from contact_models.runs import commands, progress, report
from contact_models.runs.run import VehicleRun
from contact_models.runs.trust import TRUST

SCENARIO = """
name = "short & sharp"
length = 3.0
speed = 20.0
friction = 0.4
[methods]
normal = "analyn"
tangential = "fastrip"
strips = 20
elements = 12
[track.alignment]
spectrum = "ERRI B176 low"
[recording]
settling = 0.5
"""


@pytest.fixture
def call(tmp_path):
    app = typer.Typer(pretty_exceptions_enable=False)
    app.command()(commands.run)
    (tmp_path / "case.toml").write_text(SCENARIO, encoding="utf-8")

    def invoke(out: str, *options: str):
        return CliRunner().invoke(app, [str(tmp_path / "case.toml"), "--out", str(tmp_path / out), *options])

    return invoke


def test_interrupted_run_goes_on_to_the_same_files(call, tmp_path, monkeypatch):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: repr(run.balance))  # pictures take long
    assert call("whole").exit_code == 0
    advance = VehicleRun.advance

    def interrupted(self):
        advance(self)
        if self.distance > 1.8:
            signal.raise_signal(signal.SIGINT)

    with monkeypatch.context() as patch:
        patch.setattr(VehicleRun, "advance", interrupted)
        broken = call("broken")
    assert broken.exit_code == 130
    assert "the same command continues from" in broken.output
    assert not (tmp_path / "broken" / "result.nc").exists()
    resumed = call("broken")
    assert "continues at 2.0 m" in resumed.output  # nothing is lost
    for name in ("result.nc", "report.html"):
        assert (tmp_path / "broken" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert sorted(path.name for path in (tmp_path / "broken").iterdir()) == ["report.html", "result.nc"]


def test_the_files_do_not_depend_on_the_number_of_threads(call, tmp_path, monkeypatch):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: "")
    for threads in ("1", "2"):
        assert call(threads, "--threads", threads).exit_code == 0
    assert (tmp_path / "1" / "result.nc").read_bytes() == (tmp_path / "2" / "result.nc").read_bytes()
    assert "--threads 3 is outside the allowed range [1, 2]" in call("3", "--threads", "3").output


@pytest.mark.usefixtures("drawn_once")
def test_report_stands_by_itself(call, tmp_path):
    assert call("out").exit_code == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "<h1>short &amp; sharp</h1>" in page
    assert page.count("<picture>") == 6
    assert "http" not in page
    assert 'src="data:image/png;base64,' in page


def test_bad_scenario_ends_with_a_message(call, tmp_path):
    (tmp_path / "case.toml").write_text(SCENARIO + "spacing = 'wide'", encoding="utf-8")
    ended = call("out")
    assert ended.exit_code == 2
    assert "case.toml.recording.spacing = 'wide' is not a number" in ended.output


def test_a_value_of_a_file_is_not_told_as_that_of_a_flag(call, tmp_path):
    (tmp_path / "case.toml").write_text(SCENARIO.replace("speed = 20.0", "speed = 0"), encoding="utf-8")
    assert "case.toml: speed = 0 is outside the allowed range [0.1, 150]" in call("out").output


def test_json_of_a_run_names_its_files_and_how_far_it_can_be_trusted(call, tmp_path, monkeypatch):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: "")
    answer = json.loads(call("out", "--json").stdout)
    assert answer["command"] == "run"
    assert answer["inputs"]["file"] == str(tmp_path / "case.toml")
    assert all(Path(name).is_file() for name in answer["files"])
    assert set(answer["trust"]) == set(TRUST)


@pytest.mark.parametrize("ending", [".csv", ".mat", ".nc"])
def test_the_time_series_goes_to_a_file_that_other_programs_read(call, tmp_path, monkeypatch, ending):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: "")
    path = tmp_path / f"run{ending}"
    ended = call(path.name)
    assert ended.exit_code == 0
    assert (tmp_path / "run" / "report.html").exists()
    with xarray.open_dataset(tmp_path / "run" / "result.nc", engine="scipy") as stored:
        wanted = stored["wheelset_right_vertical_force"].values
    if ending == ".csv":
        header, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
        found = [float(row[header.index("wheelset_right_vertical_force [N]")]) for row in rows]
    elif ending == ".mat":
        found = scipy.io.loadmat(path, simplify_cells=True)["series"]["wheelset_right_vertical_force"]
    else:
        found = xarray.open_dataset(path, engine="scipy")["wheelset_right_vertical_force"].values
    assert found == pytest.approx(wanted, rel=1e-12)


def test_progress_is_also_a_line_a_minute_in_a_file(call, tmp_path, monkeypatch):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: "")
    monkeypatch.setattr(progress, "_LOGGED", 0.0)
    assert call("out").exit_code == 0
    lines = (tmp_path / "out" / "progress.log").read_text(encoding="utf-8").splitlines()
    assert len(lines) > 3
    assert " m of 3 m" in lines[0]
