"""The pages speak of what an installed wheel has: its modules, commands and options."""

import importlib.util
import re
from pathlib import Path

import pytest

typer = pytest.importorskip("typer")

from contact.cli import app as cli  # noqa: E402
from contact.cli.plugins import add_plugins  # noqa: E402
from models.vehicle import template  # noqa: E402

ROOT = Path(__file__).parents[1]
#: Pages for who has installed a wheel. Those of docs/extend, and docs/check, are for who has a checkout.
PAGES = sorted((*ROOT.glob("docs/use/**/*.md"), *ROOT.glob("docs/understand/**/*.md")))
PACKAGES = ("contact", "contact_models", "contact_fmu")
_IMPORT = re.compile(r"^\s*(?:from|import) ((?:contact|contact_models|contact_fmu|fmu_src|models)(?:\.\w+)*)\b", re.M)
_MODULE = re.compile(r"python -m ([\w.]+)")
_CODE = re.compile(r"^    (contact .+)$|`(contact [a-z][^`]*)`|^(contact .+)$", re.M)


def ids(page):
    return str(page.relative_to(ROOT / "docs"))


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_modules_of_a_page_are_in_a_wheel(page):
    text = page.read_text(encoding="utf-8")
    names = [*_IMPORT.findall(text), *_MODULE.findall(text)]
    ours = [name for name in names if name.split(".")[0] in (*PACKAGES, "fmu_src", "models", "tests")]
    for name in ours:
        assert name.split(".")[0] in PACKAGES, f"{name} has that name in a checkout only"
        assert importlib.util.find_spec(name) is not None, name
    told = text.replace("`python build_fmu.py` is the same in a clone", "")
    assert "build_fmu.py" not in told, "a wheel has `contact fmu`"


@pytest.fixture(scope="module")
def commands():
    add_plugins(cli.app)
    group = typer.main.get_command(cli.app)
    found = dict(group.commands)
    found.setdefault(
        "vehicle", typer.main.get_command(template.app)
    )  # a checkout may have been installed before it came
    return found


@pytest.mark.parametrize("page", PAGES, ids=ids)
def test_commands_and_options_of_a_page_exist(page, commands):
    for line in ("".join(found) for found in _CODE.findall(page.read_text(encoding="utf-8"))):
        line = re.split(r"[|>#]|&&|;", line)[0]
        words = line.split()[1:]
        if not words or not re.fullmatch(r"[a-z][a-z-]*", words[0]):
            continue
        assert words[0] in commands, line
        command = commands[words[0]]
        inner = getattr(command, "commands", None)
        if inner and len(words) > 1 and words[1] in inner:
            command = inner[words[1]]
        options = {name for option in command.params for name in (*option.opts, *option.secondary_opts)} | {
            "--help",
            "-h",
        }
        for word in words[1:]:
            if re.match(r"--[a-z]", word) and not word.endswith("…"):
                assert word.split("=")[0].rstrip(".,)") in options, f"{word} of: {line}"
