"""Every option refuses what it cannot take by its own name, before anything is computed."""

import pytest

typer = pytest.importorskip("typer")

from contact.cli import app as cli  # noqa: E402
from tests.command_line import call  # noqa: E402

COMMANDS = typer.main.get_command(cli.app).commands
#: What a command or an option needs.
WORDS = {"roller": [0.6], "along": ["--points", 2], "curve": ["--points", 2], "--flat-depth": ["--flat", 0.05]}
#: Commands and options with files or lists of their own, which other tests refuse.
OTHERS = {"check", "in-time", "inp", "lut", "table", "profiles", "methods", "--out", "--save", "--axis"}
OPTIONS = [
    pytest.param(command, max(option.opts, key=len), option.nargs, id=f"{command}{option.opts[0]}")
    for command in sorted(set(COMMANDS) - OTHERS)
    for option in COMMANDS[command].params
    if option.param_type_name == "option" and not option.is_flag and not OTHERS & set(option.opts)
]


@pytest.mark.parametrize(("command", "option", "count"), OPTIONS)
def test_what_an_option_cannot_take_is_refused_by_its_name(command, option, count):
    words = command, *WORDS.get(command, []), *WORDS.get(option, []), option, *["nan"] * count
    said = " ".join(call(*words, code=2).stderr.split())
    assert option in said
    assert "nan" in said or "Invalid value for" in said or "says how a file is read" in said


def test_the_widest_table_of_options_was_tried():
    assert len(OPTIONS) > 200
