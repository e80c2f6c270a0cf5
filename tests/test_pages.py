"""The pages speak of what an installation has: its modules, names, commands and options. `.ci/try_wheel` asks a wheel."""

import importlib.util
import re
import shlex
import warnings
from itertools import pairwise
from pathlib import Path

import pytest

pytest.importorskip("typer")
pytest.importorskip("matplotlib")

from tests.command_line import call

_SPEC = importlib.util.spec_from_file_location("installed", Path(__file__).parents[1] / "docs" / "installed.py")
installed = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(installed)


@pytest.mark.parametrize("page", installed.pages(), ids=lambda page: str(page.relative_to(installed.ROOT)))
def test_what_a_page_names_is_installed(page):
    assert list(installed.wrong(page)) == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "```python\nfrom contact.geometry import no_such\n```\n",
            "from contact.geometry import no_such: no such name",
        ),
        (
            "```{code-cell} python\nimport contact\ncontact.no_such()\n```\n",
            "contact.no_such: contact has no such name",
        ),
        (
            "```python\nfrom models.vehicle import declared\n```\n",
            "import models.vehicle: it has that name in a checkout only",
        ),
        ("`python -m contact_fmu.no_such`", "python -m contact_fmu.no_such: no such module"),
        ("`contact no-such --load 3`", "contact no-such --load 3: no such command"),
        ("    contact solve --no-such 3\n", "--no-such of: contact solve --no-such 3"),
        ("`python build_fmu.py`", "build_fmu.py: a wheel has `contact fmu`"),
    ],
)
def test_what_is_not_there_is_named(text, message, tmp_path, monkeypatch):
    monkeypatch.setattr(installed, "ROOT", tmp_path)
    page = tmp_path / "docs" / "use" / "page.md"
    page.parent.mkdir(parents=True)
    page.write_text(text)
    assert list(installed.wrong(page)) == [message]


#: Parts of commands that are not run here: files of the reader, runs of minutes (other tests have shorter ones), FMUs to build.
NOT_RUN = {
    "FILE",
    "NAME",
    "wheel17.whl",
    "wheel.whl",
    "cases.csv",
    "cases.toml",
    "nose.slcs",
    "--flat",
    "in-time",
    "inp",
}
NOT_RUN |= {"run", "wear", "fmu", "demo", "vehicle", "fmu-check", "check", "table"}
LINES = {line for page in installed.pages() for line in installed.commands_in(page.read_text(encoding="utf-8"))}
RUN = sorted(line for line in LINES if len(words := line.split()) > 2 and not NOT_RUN & set(words) and "…" not in line)


@pytest.mark.parametrize("line", RUN)
def test_a_command_of_a_page_runs_without_a_warning(line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    _, *words = shlex.split(line)
    result = call(*words)
    assert "warning" not in result.stderr
    assert all((tmp_path / name).stat().st_size > 100 for option, name in pairwise(words) if option == "--out")


def test_most_commands_of_pages_are_run():
    assert len(RUN) >= 25


#: Pages whose code needs no file of the reader. That of pages with cells runs when the site is built.
@pytest.mark.parametrize(
    "page", ["README.md", "docs/use/getting_started.md", "docs/use/lookup.md", "docs/check/derivatives.md"]
)
def test_the_code_of_a_page_runs_without_a_warning(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", (installed.ROOT / page).read_text(encoding="utf-8"), re.M | re.S):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            exec(compile(block, page, "exec"), names)
    assert names
