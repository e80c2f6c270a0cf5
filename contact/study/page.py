"""Pages by themselves: tables and embedded pictures in one HTML file, readable on a desktop and on a telephone."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from contact.study.comparison import Comparison
from contact.study.table import errors_of, title_of, values_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_STYLE = """
:root { color-scheme: light; --ink: #22262b; --faint: #6d747d; --rule: #dfe3e7; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: white; margin: 0 auto; max-width: 90rem;
  padding: 1rem; }
h1 { font-size: 1.5rem; margin: .5rem 0; } h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
p { max-width: 50rem; } .faint { color: var(--faint); font-size: .875rem; }
.wide { overflow-x: auto; margin: .75rem 0; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
th, td { padding: .3rem .7rem; text-align: right; border-bottom: 1px solid var(--rule); }
th { font-weight: 600; vertical-align: bottom; } th small { display: block; font-weight: 400; color: var(--faint); }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: white; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; position: sticky; left: 0; }
img { max-width: 100%; height: auto; }
@media (max-width: 700px) { body { padding: .75rem; }
  th, td { padding: .3rem .45rem; } td:first-child span { display: block; } }
"""


def page(title: str, body: Iterable[str]) -> str:
    """A whole HTML document."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        + "\n".join(body)
        + "\n</body>\n</html>\n"
    )


def table(caption: str, headings: Sequence[tuple[str, str]], rows: Iterable[Sequence[str]]) -> str:
    """A table that scrolls by itself where it is too wide; headings with units, first cells may hold markup."""
    head = "".join(f"<th>{escape(name)}<small>{escape(unit)}</small></th>" for name, unit in headings)
    lines = "".join(
        f"<tr><td>{first}</td>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>\n"
        for first, *cells in rows
    )
    return (
        f'<div class="wide"><table><caption>{escape(caption)}</caption>\n'
        f"<thead><tr>{head}</tr></thead>\n<tbody>{lines}</tbody></table></div>"
    )


def picture(wide: Figure, narrow: Figure, text: str) -> str:
    """The picture of a desktop or the one of a telephone, embedded."""
    return (
        f'<picture><source media="(max-width: 700px)" srcset="{_data(narrow)}">'
        f'<img src="{_data(wide)}" alt="{escape(text)}"></picture>'
    )


def _data(figure: Figure) -> str:
    from PIL import Image  # comes with matplotlib

    full, small = io.BytesIO(), io.BytesIO()
    figure.savefig(full, format="png")
    Image.open(full).convert("RGB").quantize(256).save(small, format="png", optimize=True)
    return "data:image/png;base64," + base64.b64encode(small.getvalue()).decode()


def method(pair: Any) -> str:
    """Names of a pair, on two lines where there is little room."""
    return f"<span>{escape(pair.normal)}</span> <span>+ {escape(pair.tangential)}</span>"


def comparison_page(c: Comparison) -> str:
    """Tables and pictures of a comparison, case by case."""
    from contact import __version__
    from contact.plot import comparison

    body = [
        "<h1>Contact models side by side</h1>",
        f'<p class="faint">wheelrail-contact {__version__}. Forces act on the wheel, in the contact frame: x in the rolling '
        "direction, y to the right, z into the rail. Times are the least of several warm solves on the machine that wrote "
        "this page.</p>",
    ]
    if c.has_reference:
        body.append(
            '<p class="faint">Errors are against the element-wise half space (Kalker’s complete theory): those of the force '
            "over µN, of the moment over µN√(area/π), all others relative; the pressure field’s in the L2 norm. In the "
            "pictures its patch is dotted.</p>"
        )
    for case, rows, solutions in c.by_case():
        values, errors = values_of(case), errors_of(case)
        body.append(f"<h2>{escape(title_of(case))}</h2>")
        headings = [(column.heading, column.unit) for column in values]
        cells = [[method(row), *(column.cell(row) for column in values)] for row in rows]
        if any(row.status not in ("OK", "SATURATED") for row in rows):
            headings.append(("status", ""))
            cells = [[*line, row.status.lower().replace("_", " ")] for line, row in zip(cells, rows, strict=True)]
        body.append(table("Results", [("method", ""), *headings], cells))
        if c.has_reference:
            body.append(
                table(
                    "Errors against the half space",
                    [("method", ""), *((column.heading, column.unit) for column in errors)],
                    [[method(row), *(column.cell(row) for column in errors)] for row in rows if row.errors is not None],
                )
            )
        wide, narrow = (
            comparison([("", solutions)], reference=c.has_reference, columns=columns, panel=panel)
            for columns, panel in ((6, 3.6), (2, 1.8))
        )
        body.append(picture(wide, narrow, f"Pressure and traction of every method: {case.name}"))
    return page("Contact models side by side", body)
