"""Self-contained HTML pages with tables and embedded pictures, for desktops and telephones."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Iterator
from html import escape
from typing import TYPE_CHECKING

from contact.study.table import Table, tables_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from contact.study.comparison import Comparison

_STYLE = """
:root { color-scheme: light; --ink: #22262b; --faint: #6d747d; --rule: #dfe3e7; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: white; margin: 0 auto; max-width: 90rem;
  padding: 1rem; }
h1 { font-size: 1.5rem; margin: .5rem 0; } h2 { font-size: 1.15rem; margin: 2rem 0 .5rem; }
p { max-width: 50rem; } .faint { color: var(--faint); font-size: .875rem; }
.wide { overflow-x: auto; margin: .25rem 0 .75rem; background:
  linear-gradient(to left, white 40%, transparent) right / 2rem 100% no-repeat local,
  linear-gradient(to left, rgb(128 128 128 / 60%), transparent) right / .7rem 100% no-repeat scroll; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; white-space: nowrap; }
th, td { padding: .3rem .7rem; text-align: right; border-bottom: 1px solid var(--rule); }
th { font-weight: 600; vertical-align: bottom; } th small { display: block; font-weight: 400; color: var(--faint); }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: white; }
h3 { font-size: 1rem; margin: 1rem 0 0; }
img { max-width: 100%; height: auto; }
@media (max-width: 700px) { body { padding: .75rem; }
  th, td { padding: .3rem .45rem; } td:first-child span { display: block; }
  th, td:first-child { white-space: normal; overflow-wrap: break-word; } td:first-child { min-width: 5rem; max-width: 45vw; } }
"""


def page(title: str, body: Iterable[str]) -> str:
    """Return a complete HTML document."""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        + "\n".join(body)
        + "\n</body>\n</html>\n"
    )


def html_of(table: Table) -> str:
    """Return a table in HTML. It scrolls horizontally if it is too wide."""
    head = "".join(f"<th>{escape(name)}<small>{escape(unit)}</small></th>" for name, unit in table.headings)
    lines = "".join(
        f"<tr><td>{_two_lines(first)}</td>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>\n"
        for first, *cells in table.rows
    )
    return (
        f'<h3>{escape(table.caption)}</h3>\n<div class="wide"><table>\n'
        f"<thead><tr>{head}</tr></thead>\n<tbody>{lines}</tbody></table></div>"
    )


def _two_lines(name: str) -> str:
    """Return the names of a pair in HTML. On narrow screens they take two lines."""
    first, plus, second = name.partition(" + ")
    return f"<span>{escape(first)}</span>" + (f" <span>+ {escape(second)}</span>" if plus else "")


def picture(wide: Figure, narrow: Figure, text: str) -> str:
    """Return an embedded picture in HTML: `wide` for desktops, `narrow` for telephones. `text` describes it."""
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


def document(title: str, about: Iterable[str], parts: Iterable[str]) -> str:
    """Return an HTML page with a title, paragraphs of text and parts in HTML."""
    return page(title, [f"<h1>{escape(title)}</h1>", *map(faint, about), *parts])


def faint(text: str) -> str:
    """Return a paragraph of explanation in HTML."""
    return f'<p class="faint">{escape(text)}</p>'


def cases_of(c: Comparison) -> Iterator[str]:
    """Yield heading, tables and picture of each case in HTML."""
    from contact.plot import comparison

    for case, rows, solutions in c.by_case():
        yield f"<h2>{escape(case.name)}</h2>"
        yield from map(html_of, tables_of(case, rows, c.has_reference))
        wide, narrow = (
            comparison([("", [solutions[k] for k in c.drawn])], reference=c.has_reference, columns=columns, panel=panel)
            for columns, panel in ((6, 3.6), (2, 1.8))
        )
        if len(c.drawn) < len(c.pairs):
            yield faint("The picture shows each normal and each tangential method with fields once.")
        yield picture(wide, narrow, f"Pressure and traction of every method: {case.name}")
