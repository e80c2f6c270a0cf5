"""Markdown tables of the reports."""

from __future__ import annotations

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
