"""Command line: errors, help, plug-ins and missing packages."""

import errno
import json
import subprocess
import sys
from importlib.metadata import EntryPoint

import pytest

import contact
import contact.stress

typer = pytest.importorskip("typer")

from typer.testing import CliRunner  # noqa: E402

from contact.cli import app as cli  # noqa: E402
from contact.cli import extras, output  # noqa: E402
from contact.cli.plugins import GROUP, add_plugins  # noqa: E402
from tests.command_line import call  # noqa: E402


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            ("solve", "--curvatures", "1", "1", "--wheel", "s1002", "--y", "0"),
            "--wheel, --y: --curvatures replaces wheel",
        ),
        (("compare", "--curvatures", "1", "1", "--profile-smoothing", "2e-6"), "--profile-smoothing: --curvatures"),
        (("solve", "--wheel", "round"), "--wheel 'round' is no profile of the standards; they are S1002, 1/40"),
        (("solve", "--inclination", "steep"), "neither a number nor a ratio"),
        (("solve", "--rail", "some.prr", "--inclination", "0.05"), "some.prr' is missing"),
        (("geometry", "--gauge", "1435"), "--gauge 1435 is outside"),
        (("solve", "--load", "1", "--penetration", "1e-5"), "exclude each other"),
        (("solve", "--y", "1.0"), "--y 1"),
        (("solve", "--curvatures", "1", "1", "--out", "nowhere/at/all.png"), "all.png cannot be written"),
        (("curve", "--out", "nowhere/at/all.csv"), "all.csv cannot be written"),
        (("geometry", "--profile-repair"), "--profile-repair says how a file is read"),
        (("solve", "--wheel", "a.whl", "--profile-unit", "mm"), "a.whl' is missing"),
        (("geometry", "--left-wheel", "a.whl", "--profile-unit", "mm"), "a.whl' is missing"),
    ],
)
def test_bad_input_ends_with_a_message_on_stderr_and_code_2(words, message):
    result = call(*words, code=2)
    assert message in result.stderr
    assert "Traceback" not in result.output


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("solve", "--out", "folder.png"), "folder.png cannot be written: it is a folder"),
        (
            ("lut", "--axis", "y=0:1e-3:2", "--load", "8e4", "--out", "folder.csv"),
            "folder.csv cannot be written: it is",
        ),
        (("demo", "--python", "--out", "file"), "is a file and no folder"),
        (("run", "no.toml", "--out", "file/deep"), "file' is a file and no folder"),
        (("run", "no.toml", "--out", "folder.csv"), "folder.csv cannot be written: it is a folder"),
        (("wear", "no.toml", "--out", "file"), "is a file and no folder"),
        (("fmu", "--out", "file"), "is a file and no folder"),
        (("fmu", "--vehicle", "no.toml"), "--vehicle 'no.toml' is missing"),
        (("fmu", "--vehicle", "file"), "--vehicle 'file' is empty"),
        (("in-time", "folder.csv", "--load", "8e4"), "motion = 'folder.csv' is a folder"),
        (("check", "folder.csv"), "folder = 'folder.csv' holds no file"),
    ],
)
def test_what_cannot_be_read_or_written_is_told_before_the_computation(words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("folder.csv", "folder.png"):
        (tmp_path / name).mkdir()
    (tmp_path / "file").touch()
    add_plugins(cli.app)
    monkeypatch.setattr("contact_fmu.native.systems.folder", lambda *_: pytest.fail("builds libraries first"))
    result = call(*words, code=2)
    assert message in result.stderr
    assert result.stdout == ""


def test_a_file_system_that_refuses_ends_with_a_message():
    def refuse():
        raise OSError(errno.ENOSPC, "No space left on device", "place/result.nc")

    app = typer.Typer(pretty_exceptions_enable=False)
    app.command()(output.reported(refuse))
    result = CliRunner().invoke(app, [])
    assert result.exit_code == output.BAD_INPUT
    assert "contact: place/result.nc: No space left on device" in result.stderr


def test_unknown_commands_and_options_end_with_code_2():
    assert "No such command" in call("solv", code=2).output
    assert "No such option" in call("solve", "--lode", "1", code=2).output


def test_every_command_and_every_option_has_its_help():
    app = typer.main.get_command(cli.app)
    commands = app.commands
    assert all(command.help for command in commands.values())
    assert [(name, one.name) for name, of in [("", app), *commands.items()] for one in of.params if not one.help] == []
    assert "--creepage" in call("solve", "-h").output


def test_version_is_that_of_the_package():
    assert call("--version").output.strip() == contact.__version__


def test_plug_in_becomes_a_command(tmp_path, monkeypatch):
    (tmp_path / "a_plug_in.py").write_text("def greet(name: str = 'nobody'):\n    print('hello', name)\n")
    monkeypatch.syspath_prepend(tmp_path)
    app = typer.Typer()
    app.command("other")(lambda: None)
    assert add_plugins(app, [EntryPoint("greet", "a_plug_in:greet", GROUP)]) == []
    result = CliRunner().invoke(app, ["greet", "--name", "rail"])
    assert result.output == "hello rail\n"


def test_a_broken_plug_in_is_named_and_does_not_stop_other_commands():
    app = typer.Typer()
    app.command("one")(lambda: None)
    app.command("two")(lambda: None)
    problems = add_plugins(app, [EntryPoint("broken", "no_such_module:f", GROUP), EntryPoint("bare", "json:no", GROUP)])
    assert [("bare" in line or "broken" in line) for line in problems] == [True, True]
    assert "no_such_module" in " ".join(problems)
    assert CliRunner().invoke(app, ["one"]).exit_code == 0


def test_own_commands_do_not_load_plug_ins(monkeypatch):
    loaded = []
    monkeypatch.setattr(cli, "add_plugins", lambda app: loaded.append(app) or [])
    monkeypatch.setattr(cli, "app", FakeApp(cli.app))
    cli.run(["solve", "--y", "0"])
    assert loaded == []
    cli.run(["--help"])
    cli.run(["demo"])
    assert len(loaded) == 2


class FakeApp:
    """Its own commands of an app, which are not run; other tests may have loaded plug-ins into it."""

    def __init__(self, app):
        own = [command for command in app.registered_commands if command.callback.__module__.startswith("contact.")]
        self.registered_commands = own

    def __call__(self, args, prog_name):
        assert prog_name == "contact"


def test_missing_dependency_is_named_and_ends_with_code_1():
    code = (
        "import sys; sys.modules['typer'] = None; sys.argv = ['contact', 'methods']; import contact.cli as c; c.main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr == "contact: typer is missing; pip install wheelrail-contact installs it\n"
    assert "Traceback" not in done.stderr


def test_missing_matplotlib_ends_a_plot_with_code_1(monkeypatch, tmp_path):
    for name in [name for name in sys.modules if name.startswith("contact.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(vars(contact), "plot", raising=False)  # getattr would import it
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    result = call("solve", "--curvatures", 1, 1, "--out", tmp_path / "no.png", code=1)
    assert "wheelrail-contact[plot]" in result.stderr


def test_every_module_of_an_extra_is_asked_for_before_a_run(monkeypatch, capsys):
    """xarray alone was enough to start a run, which failed after its last step because scipy writes its file."""
    found = extras.find_spec
    monkeypatch.setattr(extras, "find_spec", lambda name: None if name == "scipy" else found(name))
    with pytest.raises(typer.Exit):
        output.require_extra("xarray")
    assert (
        "scipy is missing (result files: run, wear): pip install 'wheelrail-contact[xarray]'" in capsys.readouterr().err
    )


def test_json_has_version_command_inputs_and_units():
    words = ("--curvatures", 1.1, 0.8, "--creepage", 1e-3, 0.0, 0.1, "--load", 60e3, "--json")
    answer = json.loads(call("solve", *words).stdout)
    assert (answer["version"], answer["command"]) == (contact.__version__, "solve")
    given = {
        "load": 60e3,
        "curvatures": [1.1, 0.8],
        "creepage": [1e-3, 0.0, 0.1],
        "pressure_limit": None,
        "side": "right",
    }
    assert {name: answer["inputs"][name] for name in given} == given
    wanted = {
        "load": "N", "curvatures": "1/m", "creepage": "1, 1, 1/m", "max_pressure": "Pa", "Mz": "N m", "area": "m²",
    }  # fmt: skip
    assert {name: answer["units"][name] for name in wanted} == wanted
