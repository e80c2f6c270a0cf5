"""The pages speak of what an installation has: its modules, names, commands and options. `.ci/try_wheel` asks a wheel."""

import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("typer")

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
