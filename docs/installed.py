"""Hold each import, module and command of the pages against the installation that runs this: ``python -I docs/installed.py``.

Nothing of a checkout is used but the pages, so a wheel in an environment of its own shows what its users have.
"""

from __future__ import annotations

import ast
import importlib
import importlib.util
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).parents[1]
PACKAGES = ("contact", "contact_models", "contact_fmu")
#: Names of packages in a checkout whose names in a wheel differ, or that it has not; and the folders of pages for who has one.
CHECKOUT, FOR_CHECKOUT = ("fmu_src", "models", "tests"), ("extend", "check")
_BLOCK = re.compile(r"^```(?:\{code-cell\} )?i?python3?\n(.*?)^```", re.M | re.S)
_MODULE = re.compile(r"python -m ([\w.]+)")
_COMMAND = re.compile(r"^    (contact .+)$|`(contact [a-z][^`]*)`|^(contact .+)$", re.M)


def pages() -> list[Path]:
    """Return the pages, and the README."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*/**/*.md"))]


def wrong(page: Path) -> Iterator[str]:
    """Yield what a page names and this installation does not have."""
    text = page.read_text(encoding="utf-8")
    in_checkout = page.relative_to(ROOT).parts[1:2] and page.relative_to(ROOT).parts[1] in FOR_CHECKOUT
    for name in _MODULE.findall(text):
        top = name.split(".")[0]
        if top in CHECKOUT and not in_checkout:
            yield f"python -m {name}: {top} has that name in a checkout only"
        elif top in PACKAGES and importlib.util.find_spec(name) is None:
            yield f"python -m {name}: no such module"
    if not in_checkout and page.name != "README.md":
        told = text.replace("`python build_fmu.py` is the same in a clone", "")
        if "build_fmu.py" in told:
            yield "build_fmu.py: a wheel has `contact fmu`"
    known: dict[str, Any] = {}
    for block in _BLOCK.findall(text):
        yield from _wrong_in_block(block, known, bool(in_checkout))
    for line in commands_in(text):
        yield from _wrong_in_command(line)


def _wrong_in_block(block: str, known: dict[str, Any], in_checkout: bool) -> Iterator[str]:
    """Yield the imports and the attributes of modules that do not exist. `known` are the modules that the page has imported."""
    lines = [line for line in block.splitlines() if not line.startswith(("%", "!", ":", ">>>"))]
    try:
        tree = ast.parse("\n".join(lines))
    except SyntaxError:  # a page may leave something out with …
        tree = ast.parse("\n".join(line for line in lines if re.match(r"(from [\w.]+ )?import [\w., ]+$", line)))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from _wrong_import(
                node.module, [(a.name, a.asname or a.name) for a in node.names], known, in_checkout
            )
        elif isinstance(node, ast.Import):
            for one in node.names:
                yield from _wrong_import(one.name, [("", one.asname or one.name.split(".")[0])], known, in_checkout)
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module = known.get(node.value.id)
            if isinstance(module, ModuleType) and _member(module, node.attr) is None:
                yield f"{node.value.id}.{node.attr}: {module.__name__} has no such name"


def _wrong_import(module: str, names: list[tuple[str, str]], known: dict[str, Any], in_checkout: bool) -> Iterator[str]:
    top = module.split(".")[0]
    if top in CHECKOUT and not in_checkout:
        yield f"import {module}: it has that name in a checkout only"
    if top not in PACKAGES:
        return
    try:
        found = importlib.import_module(module)
    except ImportError as error:
        if "wheelrail-contact[" not in str(error):  # an extra is missing, and the message says which
            yield f"import {module}: {error}"
        return
    for name, called in names:
        known[called] = sys.modules[top] if not name and called == top else found if not name else _member(found, name)
        if known[called] is None:
            yield f"from {module} import {name}: no such name"


def _member(module: ModuleType, name: str) -> Any:
    """Return what a module has under a name, which may be a module in it; None if there is none."""
    try:
        return getattr(module, name) if hasattr(module, name) else importlib.import_module(f"{module.__name__}.{name}")
    except ImportError as error:  # an extra is missing, and the message says which
        return error if "wheelrail-contact[" in str(error) else None


def commands() -> dict[str, Any]:
    """Return the commands of the command line, those of other packages too."""
    import typer

    from contact.cli import app as cli
    from contact.cli.plugins import add_plugins

    if not _COMMANDS:
        add_plugins(cli.app)
        _COMMANDS.update(typer.main.get_command(cli.app).commands)  # type: ignore[attr-defined]
    return _COMMANDS


_COMMANDS: dict[str, Any] = {}


def commands_in(text: str) -> Iterator[str]:
    """Yield the commands of a page, without what follows them."""
    for found in _COMMAND.findall(text):
        line = re.split(r"[|>#]|&&|;", "".join(found))[0].strip()
        if re.match(r"contact [a-z][a-z-]*( |$)", line):
            yield line


def _wrong_in_command(line: str) -> Iterator[str]:
    """Yield the command if it does not exist, and each of its options that does not."""
    words = line.split()[1:]
    if words[0] not in commands():
        yield f"{line}: no such command"
        return
    command = commands()[words[0]]
    inner = getattr(command, "commands", None)
    if inner and len(words) > 1 and words[1] in inner:
        command = inner[words[1]]
    options = {name for one in command.params for name in (*one.opts, *one.secondary_opts)} | {"--help", "-h"}
    for word in words[1:]:
        if re.match(r"--[a-z]", word) and not word.endswith("…") and word.split("=")[0].rstrip(".,)") not in options:
            yield f"{word} of: {line}"


def main() -> None:
    """Print what is wrong; the exit code is 1 if anything is."""
    import contact

    found = [f"{page.relative_to(ROOT)}: {text}" for page in pages() for text in wrong(page)]
    sys.stdout.write(
        "\n".join([*found, f"{len(pages())} pages against {Path(contact.__file__).parent}: {len(found)} wrong\n"])
    )
    raise SystemExit(bool(found))


if __name__ == "__main__":
    main()
