"""Variables of an FMU as a Markdown table."""

from __future__ import annotations

import math

from fmu_src.description import number
from fmu_src.variables import Kind, Table, Variable


def markdown(table: Table) -> str:
    """Return a Markdown section with one line for each row and field of `table`."""
    lines = [
        f"## {table.name}",
        "",
        table.description,
        "",
        "| name | | type, unit | start | range | meaning |",
        "|---|---|---|---|---|---|",
        *(_line(row) for row in table.shown),
    ]
    if table.fields:
        counts = " and ".join(f"`{name}`" for name in sorted(table.structural))
        lines += [
            "",
            f"In FMI 3.0 every array is one variable, {counts} are structural parameters, and there are fields besides:",
            "",
            *lines[4:6],
            *(_line(row) for row in table.fields),
        ]
    return "\n".join(lines) + "\n"


def _line(row: Variable) -> str:
    index = f"[{','.join(f'1..{n}' for n in row.shape)}]" if row.shape else ""
    cells = (
        f"`{row.element(index)}`",
        row.causality,
        _type(row),
        _start(row),
        _range(row),
        row.description.replace("|", r"\|"),
    )
    return f"| {' | '.join(cells)} |"


def _type(row: Variable) -> str:
    if row.enumeration is not None:
        return ", ".join(name for name, _ in row.enumeration.items)
    if row.kind in (Kind.INTEGER, Kind.BOOLEAN):
        return row.kind.lower()
    return ", ".join(dict.fromkeys(row.unit)) if isinstance(row.unit, tuple) else row.unit


def _start(row: Variable) -> str:
    if row.start is None:
        return ""
    if isinstance(row.start, tuple):
        return f"{row.start[0]:g} … {row.start[-1]:g}"
    return row.start if isinstance(row.start, str) else number(row.start)


def _range(row: Variable) -> str:
    if math.isinf(row.minimum) and math.isinf(row.maximum):
        return ""
    left = "]" if row.open_minimum or math.isinf(row.minimum) else "["
    right = "[" if math.isinf(row.maximum) else "]"
    return f"{left}{row.minimum:g}, {row.maximum:g}{right}"
