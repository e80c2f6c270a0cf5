"""What `contact.compare` returns, and the files that it is written to."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from contact.solution import Solution
from contact.study.case import Case
from contact.study.errors import Errors
from contact.study.files import csv_of, write
from contact.study.pairs import REFERENCE, Pair

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Pairs up to which a picture shows every one.
MOST_PANELS = 24


@dataclass(frozen=True, slots=True)
class Row:
    """One case by one pair of methods; SI units, forces on the wheel.

    Attributes
    ----------
    case, normal, tangential, status : str
    N, Fx, Fy, Mz, approach, max_pressure, area : float
        As in `Solution`.
    adhesion_area : float or None
        [m²]; None where the tangential method gives forces alone.
    time : float
        Least wall time of a warm `contact.solve` [s].
    errors : Errors or None
        Against the reference; None for the reference itself, without one, or without contact.
    """

    case: str
    normal: str
    tangential: str
    status: str
    N: float
    approach: float
    Fx: float
    Fy: float
    Mz: float
    max_pressure: float
    area: float
    adhesion_area: float | None
    time: float
    errors: Errors | None

    def flat(self) -> dict[str, Any]:
        """One level of names, `error_force` and so on; None where there is no value."""
        content = asdict(self)
        errors = content.pop("errors") or {}
        names = Errors.__dataclass_fields__
        return content | {f"error_{name}": errors.get(name) for name in names}


@dataclass(frozen=True)
class Comparison:
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

    def html(self) -> str:
        """A page by itself: tables and pictures, nothing outside is needed."""
        from contact.study.page import comparison_page

        return comparison_page(self)

    @property
    def texts(self) -> dict[str, Callable[[], str]]:
        """What makes the text of a file, by its ending."""
        return {".json": self.json, ".csv": self.csv, ".html": self.html}

    def write(self, path: str | Path) -> None:
        """Write a table (.json, .csv), a picture (.png, .pdf, .svg) or a page (.html), as the name of the file says.

        Raises
        ------
        ContactError
            Another ending, or a file that cannot be written.
        """
        write(path, self.texts, self.figure)

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
