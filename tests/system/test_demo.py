"""`contact demo` as a user calls it."""

import csv
from importlib.metadata import entry_points

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from contact_models.wheelset.demo import demo

FILES = ["contacts_flange.png", "contacts_tread.png", "time_histories.png", "wheelset.csv"]


def run(*arguments: object):
    app = typer.Typer()
    app.command()(demo)
    return CliRunner().invoke(app, [str(word) for word in arguments])


def test_demo_is_a_command_of_the_command_line():
    (point,) = entry_points(group="contact.commands", name="demo")
    assert point.load() is demo


@pytest.mark.parametrize("kind", ["fmus", "python"])
def test_demo_leaves_pictures_and_numbers(kind, fmus, tmp_path):
    out = tmp_path / "results of a run"
    source = ["--python"] if kind == "python" else ["--fmus", fmus.parent]
    result = run("--out", out, "--seconds", 0.1, *source)
    assert result.exit_code == 0, result.output
    assert sorted(path.name for path in out.iterdir()) == FILES
    for path in out.glob("*.png"):
        assert path.read_bytes().startswith(b"\x89PNG")
        assert path.stat().st_size > 20_000
    with (out / "wheelset.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    values = dict(zip(header, np.array(rows, dtype=np.float64).T, strict=True))
    assert values["time"] == pytest.approx(np.arange(200) * 5e-4, abs=1e-12)
    assert values["pose.y"][0] == 5e-3
    assert values["pose.y"][-1] < 0.0  # it has crossed the centre
    for words in ("linear critical speed", "power residual of the coupling", "contacts_flange.png"):
        assert words in result.output


def test_demo_without_fmus_says_how_to_make_them(tmp_path):
    result = run("--fmus", tmp_path, "--out", tmp_path / "out")
    assert result.exit_code == 1
    assert "Wheelset.fmu is missing; make it with  python build_fmu.py" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--speed", -1), "--speed -1 is outside the allowed range [0.1, 150]"),
        (("--step", 0), "--step 0 is outside the allowed range ]0"),
        (("--scheme", "euler"), "--scheme 'euler' is none of gauss_seidel, jacobi"),
        (("--lateral", 0.5), "do not overlap"),
        (("--friction", "nan"), "--friction nan is outside"),
    ],
)
def test_demo_refuses_impossible_runs(arguments, message, tmp_path):
    result = run("--python", "--out", tmp_path, "--seconds", 0.01, *arguments)
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.split())


def test_demo_passes_on_what_an_fmu_refuses(fmus, tmp_path):
    result = run("--fmus", fmus.parent, "--out", tmp_path, "--seconds", 0.01, "--lateral", 0.5)
    assert result.exit_code == 2
    assert "do not overlap" in result.stderr
