"""Call the command line inside this process. This needs typer."""

from typer.testing import CliRunner

from contact.cli import app as cli


def call(*words, code=0):
    """Run one command, check its exit code and return the result."""
    result = CliRunner().invoke(cli.app, [str(word) for word in words])
    assert result.exit_code == code, f"{result.output}\n{result.exception!r}"
    return result
