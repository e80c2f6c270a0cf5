"""Tables with text cells, for the terminal and for pages."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from contact.study.case import Case
from contact.study.row import Row


def number(value: float | None) -> str:
    """Return a number with four significant digits, without exponent in [1e-3, 1e5[; "" for None."""
    if value is None:
        return ""
    if value == 0.0 or 1e-3 <= abs(value) < 1e5:
        digits = 3 if value == 0.0 else max(0, 3 - math.floor(math.log10(abs(value))))
        return f"{value:.{min(digits, 6)}f}" if value else "0"
    return f"{value:.3e}"


def percent(value: float | None) -> str:
    """Return a percentage with two decimals below ten, one decimal above; "" for None."""
    if value is None:
        return ""
    return f"{value:.2f}" if abs(value) < 10.0 else f"{value:.1f}"


def brief(value: float | None) -> str:
    """Return a time with two significant digits; "" for None."""
    return "" if value is None else f"{value:.2g}" if value < 99.5 else f"{value:.0f}"


class Table(NamedTuple):
    """A table: caption, headings with units, and rows. The first cell of a row is its name."""

    caption: str
    headings: Sequence[tuple[str, str]]
    rows: Sequence[Sequence[str]]

    def markdown(self) -> str:
        """Return the table in Markdown. The caption is a heading."""
        head = [f"{name} [{unit}]" if unit else name or " " for name, unit in self.headings]
        marks = ["---", *["---:"] * (len(head) - 1)]
        return "\n".join([f"## {self.caption}", "", *(f"| {' | '.join(line)} |" for line in (head, marks, *self.rows))])


class Column(NamedTuple):
    """A column: heading, unit, and functions for the value of a row and its text. None is an empty cell."""

    heading: str
    unit: str
    value: Callable[[Row], float | None]
    text: Callable[[float | None], str] = number

    def cell(self, row: Row) -> str:
        """Return the text of the cell in a row."""
        return self.text(self.value(row))


def _scaled(name: str, factor: float) -> Callable[[Row], float | None]:
    def value(row: Row) -> float | None:
        found = getattr(row, name)
        return None if found is None else factor * found

    return value


def _error(name: str) -> Callable[[Row], float | None]:
    return lambda row: None if row.errors is None else 100.0 * getattr(row.errors, name)


_LOAD, _APPROACH = Column("normal force", "kN", _scaled("N", 1e-3)), Column("approach", "µm", _scaled("approach", 1e6))
_VALUES = (
    Column("peak pressure", "MPa", _scaled("max_pressure", 1e-6)),
    Column("area", "mm²", _scaled("area", 1e6)),
    Column("stick area", "mm²", _scaled("adhesion_area", 1e6)),
    Column("Fx", "kN", _scaled("Fx", 1e-3)),
    Column("Fy", "kN", _scaled("Fy", 1e-3)),
    Column("Mz", "N m", _scaled("Mz", 1.0)),
    Column("time", "ms", _scaled("time", 1e3), brief),
)
_ERRORS = (
    Column("force", "%", _error("force"), percent),
    Column("moment", "%", _error("moment"), percent),
    Column("peak pressure", "%", _error("max_pressure"), percent),
    Column("pressure field", "%", _error("pressure"), percent),
    Column("area", "%", _error("area"), percent),
)


def values_of(case: Case) -> Sequence[Column]:
    """Return the columns of the results. The first is the approach or the normal force, whichever is not given."""
    return (_APPROACH if case.approach is None else _LOAD, *_VALUES)


def errors_of(case: Case) -> Sequence[Column]:
    """Return the columns of the errors against the half space."""
    sought = ("approach", "approach") if case.approach is None else ("normal force", "N")
    return (*_ERRORS, Column(sought[0], "%", _error(sought[1]), percent))


def title_of(case: Case) -> str:
    """Return name and conditions of a case in one line."""
    c = case.creepage
    given = f"N = {case.load * 1e-3:g} kN" if case.load is not None else f"approach {1e6 * (case.approach or 0.0):g} µm"
    return (
        f"{case.name}: {given}, µ = {case.friction:g}, creepages {1e3 * c.longitudinal:.3g} ‰, "
        f"{1e3 * c.lateral:.3g} ‰, {c.spin:.3g} 1/m"
    )


def tables_of(case: Case, rows: Sequence[Row], has_reference: bool) -> list[Table]:
    """Return the table of results of a case, and that of errors if there is a reference."""
    result = [_table(title_of(case), values_of(case), rows)]
    if has_reference:
        caption = f"{case.name}: errors against the half space, force over µN, moment over µN√(area/π)"
        result.append(_table(caption, errors_of(case), [row for row in rows if row.errors is not None]))
    return result


def _table(caption: str, columns: Sequence[Column], rows: Sequence[Row]) -> Table:
    """Return a table. It has a column for the status if a row has another status than OK or SATURATED."""
    cells = [[f"{row.normal} + {row.tangential}", *(column.cell(row) for column in columns)] for row in rows]
    headings = [("method", ""), *((column.heading, column.unit) for column in columns)]
    if any(row.status not in ("OK", "SATURATED") for row in rows):
        headings.append(("status", ""))
        cells = [[*line, row.status.lower().replace("_", " ")] for line, row in zip(cells, rows, strict=True)]
    return Table(caption, headings, cells)
