"""What `contact.compare` returns, and the files that it is written to."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from contact.solution import Solution
from contact.study.case import Case
from contact.study.files import csv_of
from contact.study.pairs import REFERENCE, Pair
from contact.study.report import Report
from contact.study.row import Row
from contact.study.table import Table, tables_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Pairs up to which a picture shows every one.
MOST_PANELS = 24


@dataclass(frozen=True)
class Comparison(Report):
    """Cases solved by several pairs of methods.

    Attributes
    ----------
    cases : tuple of Case
    pairs : tuple of Pair
        The reference first, where there is one.
    rows : tuple of Row
        Case by case, in the order of `pairs`.
    solutions : tuple of Solution
        Those of the rows.
    """

    cases: tuple[Case, ...]
    pairs: tuple[Pair, ...]
    rows: tuple[Row, ...]
    solutions: tuple[Solution, ...]

    def __repr__(self) -> str:
        return f"Comparison({len(self.cases)} case(s): {', '.join(map(str, self.pairs))})"

    @property
    def has_reference(self) -> bool:
        """Whether errors against the half space were asked for."""
        return self.pairs[0] == REFERENCE

    def by_case(self) -> Sequence[tuple[Case, Sequence[Row], Sequence[Solution]]]:
        """Each case with its rows and solutions."""
        n = len(self.pairs)
        return [
            (case, self.rows[k * n : (k + 1) * n], self.solutions[k * n : (k + 1) * n])
            for k, case in enumerate(self.cases)
        ]

    @property
    def drawn(self) -> tuple[int, ...]:
        """Places of the pairs that pictures show: all, or of many those with which a method with fields comes first."""
        if len(self.pairs) <= MOST_PANELS:
            return tuple(range(len(self.pairs)))
        seen: set[tuple[str, str]] = set()
        chosen = []
        for k, (pair, solution) in enumerate(zip(self.pairs, self.solutions, strict=False)):
            own = {("normal", pair.normal), ("tangential", pair.tangential)}
            if solution.has_fields and not own <= seen:
                chosen.append(k)
                seen |= own
        return tuple(chosen)

    def figure(self, columns: int = 6) -> Figure:
        """Patches, pressures, stick and slip, one scale a case (`contact.plot.comparison`), of the pairs in `drawn`."""
        from contact.plot import comparison

        return comparison(
            [(case.name, [solutions[k] for k in self.drawn]) for case, _, solutions in self.by_case()],
            reference=self.has_reference,
            columns=columns,
        )

    def json(self) -> str:
        """Everything but the fields, in SI units, under the names of the Python API."""
        from contact import __version__

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
        """One line a row, SI units."""
        return csv_of([row.flat() for row in self.rows])

    title: ClassVar[str] = "Contact models side by side"

    @property
    def about(self) -> list[str]:
        """What a reader of the tables needs to know."""
        from contact import __version__

        found = [
            f"wheelrail-contact {__version__}. Forces act on the wheel, in the contact frame: x in the rolling direction, y to "
            "the right, z into the rail. Times are the least of several warm solves on the machine that wrote this page."
        ]
        if self.has_reference:
            found.append(
                "Errors are against the element-wise half space (Kalker's complete theory): those of the force over µN, of the "
                "moment over µN√(area/π), all others relative; the pressure field's in the L2 norm. In pictures its patch is "
                "dotted."
            )
        return found

    def tables(self) -> list[Table]:
        """Results of every case, and its errors where there is a reference."""
        return [table for case, rows, _ in self.by_case() for table in tables_of(case, rows, self.has_reference)]

    def parts(self) -> Iterable[str]:
        """Tables and picture of every case."""
        from contact.study.page import cases_of

        return cases_of(self)

    def to_xarray(self) -> Any:
        """The rows as an `xarray.Dataset` over case and pair; NaN where there is no value. Needs xarray."""
        try:
            import xarray
        except ImportError:
            raise ImportError("Comparison.to_xarray needs xarray: pip install 'wheelrail-contact[xarray]'") from None
        import numpy as np

        shape = len(self.cases), len(self.pairs)
        flat = [row.flat() for row in self.rows]
        values = {
            name: (("case", "pair"), np.array([row[name] for row in flat], dtype=object).reshape(shape))
            for name in flat[0]
            if name not in ("case", "normal", "tangential")
        }
        for name, (dims, array) in values.items():
            values[name] = (dims, array.astype(str if name == "status" else np.float64))
        return xarray.Dataset(
            values, coords={"case": [case.name for case in self.cases], "pair": [str(pair) for pair in self.pairs]}
        )
