"""The parts of the site that are made from the code are complete."""

import os
import sys
from dataclasses import fields, is_dataclass
from pathlib import Path

import pytest

pytest.importorskip("typer")
ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "docs"))

import check  # noqa: E402
import generated  # noqa: E402

from contact.friction import Friction  # noqa: E402
from contact_models.life import declared_set  # noqa: E402
from contact_models.runs import scenario  # noqa: E402
from contact_models.vehicle import track  # noqa: E402


@pytest.fixture(scope="module")
def keys():
    return generated.scenarios()


def rows(text):
    return [line.split(" | ") for line in text.splitlines() if line.startswith("| `")]


@pytest.mark.parametrize(
    "kind", [scenario.Declaration, scenario.Profiles, scenario.Recording, track.Curve, declared_set.Steps, Friction]
)
def test_every_key_of_a_scenario_is_explained(keys, kind):
    assert is_dataclass(kind)
    named = {name.strip("| `"): row for row in rows(keys) for name in row[0].split(", ")}
    for entry in fields(kind):
        value, _, meaning = (cell.strip(" |") for cell in named[entry.name][1:4])
        assert value, entry.name
        assert len(meaning) > 5, entry.name


def test_keys_of_a_base_are_explained_by_it(keys):
    for table in ("wheels.slices", "rails.slices"):
        own = keys.partition(f"### `[[{table}]]`")[2].partition("###")[0]
        assert "path relative to the scenario's file" in own


def test_no_key_is_without_a_meaning_or_explained_by_its_type(keys):
    for row in rows(keys):
        meaning = row[3].strip(" |")
        assert meaning, row
        assert not generated.is_type(meaning), row


def test_a_group_of_keys_has_all_their_defaults(keys):
    (row,) = (row for row in rows(keys) if "`border_width`" in row[0])
    assert row[0].count("`") // 2 == row[2].count(",") + 1 == 3
    assert row[2].endswith("0.005")


def test_every_command_and_option_is_listed():
    text = generated.command_line()
    for command in ("check", "solve", "conicity", "run", "wear", "fmu", "demo", "table build", "profiles"):
        assert f"## contact {command}\n" in text
    section = text.partition("## contact solve\n")[2].partition("\n## ")[0]
    for option in ("--y", "--profile-zero", "--json", "--out", "--gauge", "--falling"):
        assert f"`{option}`" in section
    assert "| `--gauge` `NUMBER` | 1.435 | track gauge in m" in section
    assert "typer" not in text


def test_links_to_nowhere_are_found(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "index.html").write_text(
        '<h1 id="top">x</h1><a href="a/b.html#here">ok</a><a href="https://x.org/y">out</a>'
    )
    (tmp_path / "a" / "b.html").write_text(
        '<p id="here"/><a href="../index.html#top">ok</a><a href="../index.html#gone">1</a><a href="c.html">2</a>'
        '<img src="no.png"><a href="#there">4</a>'
    )
    found = list(check.broken_links(tmp_path))
    assert [line.split(": ")[1].split(" leads")[0] for line in found] == [
        "../index.html#gone",
        "c.html",
        "no.png",
        "#there",
    ]
    assert found[0].startswith("a/b.html: ".replace("/", os.sep))
