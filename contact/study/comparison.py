"""`Comparison`, the result of `contact.compare`, with its tables, pictures and files."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from contact.results import Solution
from contact.study.case import Case
from contact.study.files import csv_of, write
from contact.study.pairs import REFERENCE, Pair
from contact.study.row import Row
from contact.study.table import Table, tables_of
from contact.version import __version__
from contact.view.tables import Table as Tables
from contact.view.tables import Tabular

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Largest number of pairs of which a picture shows all.
MOST_PANELS = 24
_TITLE = "Contact models side by side"


@dataclass(frozen=True)
class Comparison(Tabular):
    """Cases solved by several pairs of methods. Its tables for pandas and xarray are over case and pair.

    Attributes
    ----------
    cases : tuple of Case
    pairs : tuple of Pair
        The pairs of methods; the reference is the first, if there is one.
    rows : tuple of Row
        Results case by case, in the order of `pairs`.
    solutions : tuple of Solution
        Solutions of the rows.

    Examples
    --------
    >>> import contact
    >>> case = contact.Case(contact.Separation.hertzian(1.1, 0.8), contact.Creepage(1e-3), load=80e3)
    >>> found = contact.compare(case, "analyn+fastrip", reference=False)
    >>> found.csv().splitlines()[0][:23]
    'case,normal,tangential,'
    """

    cases: tuple[Case, ...]
    pairs: tuple[Pair, ...]
    rows: tuple[Row, ...]
    solutions: tuple[Solution, ...]

    def __repr__(self) -> str:
        return f"Comparison({len(self.cases)} case(s): {', '.join(map(str, self.pairs))})"

    @property
    def has_reference(self) -> bool:
        """True if the comparison has errors against the half space."""
        return self.pairs[0] == REFERENCE

    def by_case(self) -> Sequence[tuple[Case, Sequence[Row], Sequence[Solution]]]:
        """Return each case with its rows and solutions."""
        n = len(self.pairs)
        return [
            (case, self.rows[k * n : (k + 1) * n], self.solutions[k * n : (k + 1) * n])
            for k, case in enumerate(self.cases)
        ]

    @property
    def drawn(self) -> tuple[int, ...]:
        """Indices of the pairs in pictures: all, or of more than `MOST_PANELS` those in which a method occurs first.

        Pairs without fields are left out in the second case.
        """
        if len(self.pairs) <= MOST_PANELS:
            return tuple(range(len(self.pairs)))
        seen: set[tuple[str, str]] = set()
        chosen = []
        for k, (pair, solution) in enumerate(zip(self.pairs, self.solutions, strict=False)):
            both = {("normal", pair.normal), ("tangential", pair.tangential)}
            if solution.has_fields and not both <= seen:
                chosen.append(k)
                seen |= both
        return tuple(chosen)

    def figure(self, columns: int = 8) -> Figure:
        """Return the picture of patches, pressures, stick and slip of the pairs in `drawn` (`contact.plot.comparison`)."""
        from contact.plot import comparison

        return comparison(
            [(case.name, [solutions[k] for k in self.drawn]) for case, _, solutions in self.by_case()],
            reference=self.has_reference,
            columns=columns,
        )

    def json(self) -> str:
        """Return all results without fields as JSON, in SI units, under the names of the Python API."""
        cases = [
            {
                "name": case.name,
                **{name: getattr(case, name) for name in ("load", "approach", "friction", "speed")},
                "creepage": asdict(case.creepage),
                "material": asdict(case.material),
                "results": [asdict(row) for row in rows],
            }
            for case, rows, _ in self.by_case()
        ]
        return json.dumps({"version": __version__, "cases": cases}, indent=2)

    def csv(self) -> str:
        """Return CSV with one line per row, in SI units."""
        return csv_of([row.flat() for row in self.rows])

    @property
    def about(self) -> list[str]:
        """Paragraphs of explanation for the tables."""
        found = [
            f"wheelrail-contact {__version__}. Forces act on the wheel, in the contact frame: x in the rolling direction, y to "
            "the right, z into the rail. Times are the least of several warm solves on the machine that wrote this page."
        ]
        if self.has_reference:
            found.append(
                "Errors are against the element-wise half space (Kalker's complete theory). The error of the force is over µN, "
                "that of the moment over µN√(area/π); all others are relative, for the pressure field in the L2 norm. In "
                "pictures the half space's patch is dotted."
            )
        return found

    def tables(self) -> list[Table]:
        """Return the tables of results of each case, and of errors if there is a reference."""
        return [table for case, rows, _ in self.by_case() for table in tables_of(case, rows, self.has_reference)]

    def markdown(self) -> str:
        """Return the tables in Markdown."""
        return "\n\n".join([f"# {_TITLE}", *self.about, *(table.markdown() for table in self.tables())]) + "\n"

    def html(self) -> str:
        """Return a self-contained HTML page: tables and picture of each case."""
        from contact.study.page import cases_of, document

        return document(_TITLE, self.about, cases_of(self))

    def write(self, path: str | Path) -> None:
        """Write numbers (.json, .csv), tables (.md), the picture (.png, .pdf, .svg) or a page (.html).

        The ending of `path` selects which of them.

        Raises
        ------
        ContactError
            For any other ending, or if the file cannot be written.
        """
        texts = {".html": self.html, ".md": self.markdown, ".json": self.json, ".csv": self.csv}
        write(path, texts, self.figure)

    def _table(self) -> Tables:
        axes = {"case": np.array([case.name for case in self.cases]), "pair": np.array(list(map(str, self.pairs)))}
        flat = [row.flat() for row in self.rows]
        columns = {
            name: np.array([row[name] for row in flat], dtype=str if name == "status" else np.float64).reshape(
                len(self.cases), -1
            )
            for name in flat[0]
            if name not in ("case", "normal", "tangential")
        }
        return Tables(axes, columns, units={"time": "s"})
