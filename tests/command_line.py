"""The command line inside this process; it needs typer."""

from typer.testing import CliRunner

from contact.cli import app as cli


def call(*words, code=0):
    """Run one command; return its result after a look at the exit code."""
    result = CliRunner().invoke(cli.app, [str(word) for word in words])
    assert result.exit_code == code, f"{result.output}\n{result.exception!r}"
    return result
