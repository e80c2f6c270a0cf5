"""Pages by themselves: tables and embedded pictures in one HTML file, readable on a desktop and on a telephone."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Iterator
from html import escape
from typing import TYPE_CHECKING

from contact.study.comparison import Comparison
from contact.study.manchester import NOTES, Manchester
from contact.study.statistics import Statistics
from contact.study.table import Table, tables_of, title_of

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


def html_of(table: Table) -> str:
    """A table that scrolls by itself where it is too wide."""
    head = "".join(f"<th>{escape(name)}<small>{escape(unit)}</small></th>" for name, unit in table.headings)
    lines = "".join(
        f"<tr><td>{_two_lines(first)}</td>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>\n"
        for first, *cells in table.rows
    )
    return (
        f'<div class="wide"><table><caption>{escape(table.caption)}</caption>\n'
        f"<thead><tr>{head}</tr></thead>\n<tbody>{lines}</tbody></table></div>"
    )


def _two_lines(name: str) -> str:
    """Names of a pair, on two lines where there is little room."""
    first, plus, second = name.partition(" + ")
    return f"<span>{escape(first)}</span>" + (f" <span>+ {escape(second)}</span>" if plus else "")


def picture(wide: Figure, narrow: Figure, text: str) -> str:
    """The picture of a desktop or the one of a telephone, embedded."""
    return (
        f'<picture><source media="(max-width: 700px)" srcset="{_data(narrow)}">'
        f'<img src="{_data(wide)}" alt="{escape(text)}"></picture>'
    )


def _data(figure: Figure) -> str:
    from PIL import Image  # comes with matplotlib

    full, small = io.BytesIO(), io.BytesIO()
    figure.savefig(full, format="png", dpi=110.0)
    Image.open(full).convert("RGB").quantize(256).save(small, format="png", optimize=True)
    return "data:image/png;base64," + base64.b64encode(small.getvalue()).decode()


def comparison_page(c: Comparison) -> str:
    """Tables and pictures of a comparison, case by case."""
    from contact import __version__

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
    return page("Contact models side by side", [*body, *_cases(c)])


def _cases(c: Comparison) -> Iterator[str]:
    """Heading, tables and picture of every case."""
    from contact.plot import comparison

    for case, rows, solutions in c.by_case():
        yield f"<h2>{escape(title_of(case))}</h2>"
        yield from map(html_of, tables_of(case, rows, c.has_reference))
        wide, narrow = (
            comparison([("", [solutions[k] for k in c.drawn])], reference=c.has_reference, columns=columns, panel=panel)
            for columns, panel in ((6, 3.6), (2, 1.8))
        )
        if len(c.drawn) < len(c.pairs):
            yield '<p class="faint">The picture shows each normal and each tangential method with fields once.</p>'
        yield picture(wide, narrow, f"Pressure and traction of every method: {case.name}")


def statistics_page(s: Statistics) -> str:
    """Tables and the picture of the statistics."""
    from contact import __version__

    body = [
        "<h1>Creep forces on ellipses</h1>",
        f'<p class="faint">wheelrail-contact {__version__}. The cases are those of Vollebregt, Iwnicki, Xie and Shackleton '
        f"(2012); errors are against our half space with {s.elements} × {s.elements} elements on the ellipse. Dimensionless "
        "spin is chi, dimensionless creepage m.</p>",
        *(html_of(table) for table in s.tables()),
    ]
    body.append(picture(s.figure(), s.figure(), "Share of the cases over the error of the force"))
    return page("Creep forces on ellipses", body)


def manchester_page(m: Manchester) -> str:
    """Tables, notes and the comparison of every place."""
    from contact import __version__

    body = [
        "<h1>Manchester contact benchmark, A-2.2</h1>",
        f'<p class="faint">wheelrail-contact {__version__} beside CONTACT. A wheelset on straight track, displaced and yawed '
        "by 2.4 mrad a millimetre, 10 kN on each wheel. Forces act on the wheel. The height of the wheel is the one at which "
        "our half space carries the load; all methods have its normal force.</p>",
        *map(html_of, m.tables()),
        *(f'<p class="faint">{escape(note)}</p>' for note in NOTES),
        *_cases(m.comparison),
    ]
    return page("Manchester contact benchmark", body)
