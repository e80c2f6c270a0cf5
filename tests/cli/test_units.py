"""Command line: the unit that JSON says of each number is the one of the option's help, and of the results."""

import json
import re

import pytest

typer = pytest.importorskip("typer")

from contact.cli import app as cli  # noqa: E402
from contact.cli.document import UNITS  # noqa: E402
from tests.command_line import call  # noqa: E402

WORDS = {
    "solve": ("--y", 2e-3),
    "curve": ("--points", 2),
    "compare": ("--curvatures", 1, 1, "--no-reference"),
    "stress": ("--y", 2e-3),
    "transient": ("--distance", 1e-3),
    "rail": ("--spin", -43.4, "--y", 2e-3),
    "roller": (0.6, "--spin", -43.4),
    "along": ("--points", 2, "--normal", "strip_halfspace"),
    "geometry": ("--max", 1e-3, "--step", 1e-3),
    "conicity": ("--amplitude", 1e-3, "--curve-radius", 300),
}
COUNTS = ["n_patches", "patches", "patch", "points", "resolution", "reference_elements"]
#: Members of results whose names mean different things → their units by command.
ROTATION = {"rail": ("spin",), "roller": ("spin",), "in-time": ("spin",), "along": ("spin",)}
#: What is written in a help text → the unit in JSON.
TOLD = {
    "m": "m", "m/s": "m/s", "rad": "rad", "rad/s": "rad/s", "N": "N", "N m": "N m", "N/m": "N/m", "Pa": "Pa",
    "K": "K", "1/m": "1/m",
}  # fmt: skip


def unit_of(units, path):
    """Return the unit of a number in a document: that of its two last names, else of its last."""
    return units.get(".".join(path[-2:]), units.get(path[-1]) if path else None)


def numbers(value, path=()):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from numbers(inner, (*path, key))
    elif isinstance(value, list):
        for inner in value:
            yield from numbers(inner, path)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path


def answer(command, tmp_path):
    if command == "in-time":
        motion = tmp_path / "motion.csv"
        motion.write_text("time,pose.y,velocity.spin\n0,1e-3,-43.4\n0.01,1e-3,-43.4\n")
        return json.loads(call(command, motion, "--damping", 1e-4, 0, "--json").stdout)
    return json.loads(call(command, *WORDS[command], "--json").stdout)


@pytest.mark.parametrize("command", [*WORDS, "in-time"])
def test_every_number_has_a_unit_or_is_a_count_and_spin_is_a_rotation_where_a_wheel_turns(command, tmp_path):
    found = answer(command, tmp_path)
    units, content = found["units"], {k: v for k, v in found.items() if k not in ("units", "version", "command")}
    assert set(units.values()) <= set(UNITS.values()) | {"rad/s"}
    bare = {path for path in numbers(content) if unit_of(units, path) is None}
    assert {path[-1] for path in bare if path[-1] != "status"} <= set(COUNTS)
    for path in numbers(content):
        if path[-1] == "spin":
            turns = command in ROTATION and path[-2:] != ("creepage", "spin")
            assert unit_of(units, path) == ("rad/s" if turns else "1/m"), path
        if path[-2:-1] == ("errors",):
            assert unit_of(units, path) == "1"
        if path[-1] in ("power", "My", "torque", "adhesion_area", "time"):
            wanted = {"power": "W", "My": "N m", "torque": "N m", "adhesion_area": "m²", "time": "s"}
            assert unit_of(units, path) == wanted[path[-1]]


def test_units_of_options_are_those_that_their_help_tells():
    """The last "in UNIT" of a help text, for options with one number."""
    looked_at = 0
    for command in typer.main.get_command(cli.app).commands.values():
        for option in command.params:
            help_text = getattr(option, "help", None) or ""
            told = re.findall(r"\bin (m/s|m|rad/s|rad|N m|N/m|N|Pa|K|1/m)(?=[,;.)]|$| that| instead| below)", help_text)
            if getattr(option, "nargs", 0) != 1 or not told:
                continue
            known = UNITS | cli_units(command.name)
            if option.name in known:
                looked_at += 1
                assert known[option.name] in {TOLD[unit] for unit in told}, (command.name, option.name, help_text)
            else:
                raise AssertionError(f"{command.name} {option.name} has no unit: {help_text}")
    assert looked_at > 60


def cli_units(name):
    from contact.cli.document import _OF_COMMAND

    return _OF_COMMAND.get(name.replace("-", "_"), {})
