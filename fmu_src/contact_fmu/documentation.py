"""Variables of an FMU as a table, in Markdown and as the page documentation/index.html."""

from __future__ import annotations

import math
from collections.abc import Iterable
from html import escape

from .description import number
from .first_steps import first_steps
from .variables import Kind, Table, Variable


def markdown(table: Table) -> str:
    """Return a Markdown section with one line for each row and field of `table`."""
    lines = [
        f"## {table.name}",
        "",
        table.description,
        "",
        f"| {' | '.join(_HEAD)} |",
        "|---|---|---|---|---|---|",
        *(_line(row) for row in table.shown),
    ]
    if table.fields:
        lines += ["", _about_fields(table), "", *lines[4:6], *(_line(row) for row in table.fields)]
    return "\n".join(lines) + "\n"


def files(table: Table, packaging: str = "") -> list[tuple[str, bytes]]:
    """Return the documentation in an FMU, with a section on its packaging."""
    text = markdown(table) + packaging
    return [(f"documentation/{table.name}.md", text.encode()), ("documentation/index.html", page(table).encode())]


def page(table: Table) -> str:
    """Return the page that tools show for an FMU."""
    fields = f"<p>{escape(_about_fields(table))}</p>{_rows(table.fields)}" if table.fields else ""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{table.name}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; max-width: 75em; padding: 0 1em; color: #1e2837; }}
table {{ border-collapse: collapse; display: block; overflow-x: auto; }}
td, th {{ border-bottom: 1px solid #c4cdd6; padding: .3em .8em .3em 0; text-align: left; vertical-align: top; }}
td:first-child {{ font-family: ui-monospace, monospace; white-space: nowrap; }}
</style>
</head>
<body>
<h1>{table.name}</h1>
<p>{escape(table.description)}</p>
{first_steps(table)}<h2>Variables</h2>
{_rows(table.shown)}
{fields}
</body>
</html>
"""


_HEAD = ("name", "", "type, unit", "start", "range", "meaning")


def _about_fields(table: Table) -> str:
    counts = " and ".join(f"`{name}`" for name in sorted(table.structural))
    return f"In FMI 3.0 every array is one variable, {counts} are structural parameters, and there are fields besides:"


def _rows(rows: Iterable[Variable]) -> str:
    """Return rows as a table in HTML."""
    lines = ["".join(f"<th>{name}</th>" for name in _HEAD)]
    lines += ["".join(f"<td>{escape(cell)}</td>" for cell in _cells(row)) for row in rows]
    return "<table>\n" + "\n".join(f"<tr>{line}</tr>" for line in lines) + "\n</table>"


def _line(row: Variable) -> str:
    name, *cells = _cells(row)
    return f"| `{name}` | {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def _cells(row: Variable) -> tuple[str, ...]:
    index = f"[{','.join(f'1..{n}' for n in row.shape)}]" if row.shape else ""
    return row.element(index), row.causality, _type(row), _start(row), _range(row), row.description


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
