"""What the keys of a TOML file mean, from the docstrings of the classes that they fill."""

from __future__ import annotations

import inspect
import re
import textwrap
from typing import Any


def explained(kind: Any) -> dict[str, str]:
    """Return key → meaning from the sections Parameters of a class and of its bases, as Markdown in one line."""
    found: dict[str, str] = {}
    for each in reversed(kind.__mro__):
        found |= _explained(each.__doc__ or "")
    return found


def _explained(docstring: str) -> dict[str, str]:
    text = inspect.cleandoc(docstring)
    _, _, section = text.partition("Parameters\n----------\n")
    section = re.split(r"\n\n?[A-Z][a-z]+\n-{4,}\n", section)[0]
    found: dict[str, str] = {}
    for block in re.split(r"\n(?=\S)", section.strip()):
        head, _, body = block.partition("\n")
        names, colon, rest = head.partition(" : ")
        meaning = textwrap.dedent(body).replace("\n", " ").strip()
        if not meaning or not is_type(rest):
            meaning = f"{rest} {meaning}".strip()
        for name in names.split(","):
            if colon:
                found[name.strip()] = meaning
    return found


def is_type(text: str) -> bool:
    """Return whether a text is a type and no meaning."""
    return bool(re.fullmatch(r"(float|int|str|bool|tuple of [\w ]+|\{.*\}|[A-Z]\w+)(, optional| or \w+)*", text))
