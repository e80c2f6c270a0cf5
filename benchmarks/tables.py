"""Markdown tables of the reports, and how a report is printed and written."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

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


def tell(report: Callable[[], str], description: str | None) -> None:
    """Print a report, and write it to the file that ``--write`` names."""
    parser = argparse.ArgumentParser(description=(description or "").splitlines()[0])
    parser.add_argument("--write", type=Path, help="write the report also to this file")
    path = parser.parse_args().write
    text = report()
    print(text)
    if path:
        path.write_text(text, encoding="utf-8")
