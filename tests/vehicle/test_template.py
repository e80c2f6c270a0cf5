"""`contact vehicle template`: a file that reads as the vehicle that it begins with, and explains each key."""

from dataclasses import fields

import pytest
from typer.testing import CliRunner

from contact_models.vehicle import declared, template

ALL = (declared.VehicleDeclaration, *template._TABLES.values())


@pytest.mark.parametrize("name", ["manchester", "wheelset"])
def test_the_file_is_that_vehicle_and_has_every_key(tmp_path, name):
    ended = CliRunner().invoke(template.app, ["template", str(tmp_path / "mine.toml"), "--like", name])
    assert ended.exit_code == 0, ended.output
    assert declared.read(tmp_path / "mine.toml") == declared.read(name)
    text = (tmp_path / "mine.toml").read_text(encoding="utf-8")
    comments = [line for line in text.splitlines() if line.startswith("#")]
    for kind in ALL:
        for entry in fields(kind):
            assert any(line.startswith(f"#   {entry.name}:") for line in comments), (kind, entry.name)
    assert max(map(len, comments)) <= 130


def test_a_file_is_not_overwritten_and_an_unknown_vehicle_is_named(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("x", encoding="utf-8")
    ended = CliRunner().invoke(template.app, ["template", str(path)])
    assert (ended.exit_code, path.read_text(encoding="utf-8")) == (2, "x")
    assert "--force" in ended.output
    assert CliRunner().invoke(template.app, ["template", str(path), "--force"]).exit_code == 0
    ended = CliRunner().invoke(template.app, ["template", str(tmp_path / "b.toml"), "--like", "tram"])
    assert ended.exit_code == 2
    assert "'tram' is neither a file nor one of manchester, wheelset" in ended.output
