"""The exit status tells whether results can be trusted; what is not to be trusted is written all the same."""

from dataclasses import replace
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from contact.cli.output import BAD_INPUT, INTERRUPTED, MISSING, NOT_TRUSTED
from contact_models.life.commands import wear
from contact_models.runs import commands, report
from contact_models.runs.run import VehicleRun
from contact_models.runs.trust import LARGEST_UNTRUSTED
from tests.command_line import call
from tests.life.short_set import written
from tests.life.trusts import BAD, GOOD


def run(command, *words):
    app = typer.Typer(pretty_exceptions_enable=False)
    app.command()(command)
    return CliRunner().invoke(app, [str(word) for word in words])


def test_a_run_is_reliable_if_its_energy_closes_and_nearly_all_contacts_have_a_solution():
    assert GOOD.reliable
    assert not BAD.reliable
    assert replace(GOOD, untrusted=1.0, untrusted_share=LARGEST_UNTRUSTED).reliable
    doubtful = replace(GOOD, untrusted=9.0, untrusted_share=2.0 * LARGEST_UNTRUSTED)
    assert not doubtful.reliable
    assert "These are 0.2 % of all" in doubtful.warnings[0]


@pytest.mark.parametrize(("trust", "status"), [(GOOD, 0), (BAD, NOT_TRUSTED)])
def test_a_run_that_is_not_to_be_trusted_ends_with_status_3_after_its_files(tmp_path, monkeypatch, trust, status):
    monkeypatch.setattr(report, "page_of", lambda run, nonlinear: "")
    monkeypatch.setattr(VehicleRun, "trust", trust)
    ended = run(commands.run, written(tmp_path).parent / "straight.toml", "--out", tmp_path / "out")
    assert ended.exit_code == status, ended.output
    assert (tmp_path / "out" / "result.nc").exists()


def test_a_study_that_stops_at_a_run_not_to_be_trusted_ends_with_status_3(tmp_path, monkeypatch):
    monkeypatch.setattr(VehicleRun, "trust", BAD)
    ended = run(wear, written(tmp_path), "--out", tmp_path / "out")
    assert ended.exit_code == NOT_TRUSTED
    assert "does not close: -49 %" in ended.output


def test_a_row_without_a_trustworthy_status_ends_its_command_with_status_3(tmp_path):
    """No rotation gives a torque beyond friction; the largest slip that was tried is printed and written all the same."""
    said = call("rail", "--torque", 1e6, "--out", tmp_path / "a.csv", code=NOT_TRUSTED).stderr
    assert "1 of 1 wheels are not to be trusted: unreachable" in said
    assert "UNREACHABLE" in (tmp_path / "a.csv").read_text(encoding="utf-8")


def test_the_page_of_the_command_line_has_every_exit_status():
    page = (Path(__file__).parents[2] / "docs/use/command_line.md").read_text(encoding="utf-8")
    for status in (0, MISSING, BAD_INPUT, NOT_TRUSTED, INTERRUPTED):
        assert f"\n| {status} |" in page
