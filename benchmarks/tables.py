"""Markdown tables of the reports, and how a report is printed and written.

A page of the documentation keeps its own text; a report writes what stands between marks, ``<!-- name -->``.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def table(header: list[str], rows: list[list[str]]) -> str:
    """Return a Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def summary(name: str, errors: ArrayLike, unit: str) -> list[str]:
    """Return a row: name, count, mean, 95 % and largest of the absolute errors, unit."""
    e = np.abs(np.asarray(errors, dtype=np.float64)).ravel()
    return [name, str(e.size), *(f"{v:.1e}" for v in (e.mean(), np.quantile(e, 0.95), e.max())), unit]


def read_options(
    description: str | None, arguments: Sequence[str] | None = None, **defaults: Any
) -> argparse.Namespace:
    """Return the options of a benchmark: ``--name``, or the first argument for the name `folder`.

    A default says of which type an option is: a list takes several values, False is a flag, and a type has no default. A folder
    may be left out if its default is None.
    """
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=description, formatter_class=raw)
    for name, default in defaults.items():
        if default is False:
            parser.add_argument(f"--{name}", action="store_true")
        elif isinstance(default, list):
            parser.add_argument(f"--{name}", type=type(default[0]), nargs="*", default=default)
        elif name == "folder":
            parser.add_argument(name, type=Path, nargs="?" if default is None else None)
        elif isinstance(default, type):
            parser.add_argument(f"--{name}", type=default)
        else:
            parser.add_argument(f"--{name}", type=type(default), default=default)
    return parser.parse_args(arguments)


def with_part(text: str, name: str, part: str) -> str:
    """Return a page with the part between its two marks replaced."""
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
    if begin not in text or end not in text:
        raise ValueError(f"the page has no marks of the part {name!r}")
    head, rest = text.split(begin, 1)
    return f"{head}{begin}{part}{end}{rest.split(end, 1)[1]}"


def fill(page: Path | None, parts: dict[str, str]) -> None:
    """Print parts of a page, and write them between their marks if a page is given."""
    print(*parts.values(), sep="\n")
    if page is not None:
        text = page.read_text(encoding="utf-8")
        for name, part in parts.items():
            text = with_part(text, name, part)
        page.write_text(text, encoding="utf-8")


def tell(report: Callable[[], dict[str, str]], description: str | None) -> None:
    """Print a report, and write its parts into the page that ``--write`` names."""
    page = read_options(description, write=Path).write
    fill(page, report())
