"""Errors of the tangential methods over the 3220 cases of Vollebregt, Iwnicki, Xie and Shackleton (2012)."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.errors import ContactError, require_integer
from contact.forces import forces
from contact.registry import lookup, methods
from contact.study.design import FRICTION, LOAD, MATERIAL, Design, design
from contact.study.errors import mean_p95_max
from contact.study.files import csv_of
from contact.study.pairs import RESOLUTION
from contact.study.reference import reference_forces, separation_of
from contact.study.report import Report
from contact.study.table import Table, brief
from contact.version import __version__

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Rows and columns of the half space on the ellipse. Forces differ from those with 120 by 0.004 mu N at most, 0.001 on
#: average.
ELEMENTS = 60
#: Largest error in the picture [% of mu N]. Larger errors, of methods without friction or spin, would hide the others.
_TOP = 30.0


@dataclass(frozen=True, slots=True)
class Spread:
    """Errors of one method over one class of cases: mean, 95th percentile and maximum [-].

    `classes` is the kind of classification, `name` the class. Force errors are |F - F_ref|/(mu N), moment errors
    |Mz - Mz_ref|/(mu N c).
    """

    method: str
    classes: str
    name: str
    cases: int
    force_mean: float
    force_p95: float
    force_max: float
    moment_mean: float
    moment_p95: float
    moment_max: float


@dataclass(frozen=True)
class Statistics(Report):
    """Forces of several tangential methods on the cases of `design`, and of the half space.

    Attributes
    ----------
    design : Design
    elements : rows and columns of the half space
    reference : Fx/(mu N), Fy/(mu N) and Mz/(mu N c) of the half space, shape (n, 3)
    forces : the same for each method
    times : time per case of each method in `contact.forces`, with one thread [s]
    """

    design: Design
    elements: int
    reference: Array
    forces: Mapping[str, Array]
    times: Mapping[str, float]

    def errors(self, method: str) -> tuple[Array, Array]:
        """Return the errors of force and moment of all cases [-], shape (n,) each."""
        d = self.forces[method] - self.reference
        return np.hypot(d[:, 0], d[:, 1]), np.abs(d[:, 2])

    def spreads(self) -> list[Spread]:
        """Return the errors of each method over each class that has cases."""
        found = []
        for method in self.forces:
            force, moment = self.errors(method)
            found += [
                Spread(method, kind, name, int(mask.sum()), *mean_p95_max(force[mask]), *mean_p95_max(moment[mask]))
                for kind, classes in self.design.classes().items()
                for name, mask in classes.items()
                if mask.any()
            ]
        return found

    def tables(self) -> list[Table]:
        """Return tables of the errors over all cases, and of mean force errors by class."""
        spreads = self.spreads()
        headings = [(f"{kind} {what}", "%") for kind in ("force", "moment") for what in ("mean", "95 %", "max")]
        columns = "force_mean", "force_p95", "force_max", "moment_mean", "moment_p95", "moment_max"
        rows = [
            [s.method, *(_percent(getattr(s, column)) for column in columns), brief(1e6 * self.times[s.method])]
            for s in spreads
            if s.classes == "all"
        ]
        caption = f"Errors over {self.design.number.size} cases: force of µN, moment of µN√(ab)"
        tables = [Table(caption, [("method", ""), *headings, ("time", "µs")], rows)]
        for kind in ("ellipse", "spin", "creepage"):
            of_kind = [s for s in spreads if s.classes == kind]
            headings = list(dict.fromkeys((s.name, f"{s.cases} cases") for s in of_kind))
            rows = [[m, *(_percent(s.force_mean) for s in of_kind if s.method == m)] for m in self.forces]
            tables.append(Table(f"Mean error of the force by {kind}, % of µN", [("method", ""), *headings], rows))
        return tables

    def figure(self) -> Figure:
        """Return the picture of the force error that a share of the cases does not exceed, one line per method."""
        from contact.plot.lines import INSIDE, curve
        from contact.plot.style import drawn

        n = self.design.number.size
        share = 100.0 * (np.arange(n) + 0.5) / n
        lines = {method: 100.0 * np.sort(self.errors(method)[0]) for method in self.forces}
        top = max(float(np.percentile(line, 95.0)) for line in lines.values())
        with drawn(6.4 if len(lines) <= INSIDE else 8.4, 4.4) as figure:
            ax = figure.subplots()
            curve(share, lines, xlabel="share of the cases [%]", ylabel="error of the force [% of µN]", ax=ax)
            ax.set_ylim(0.0, min(1.1 * max(top, 1e-3), _TOP))
        return figure

    def csv(self) -> str:
        """Return CSV with one line per case: creepages, forces by the half space and by each method."""
        d = self.design
        columns: dict[str, Any] = {
            name: getattr(d, name)
            for name in ("number", "ellipse", "chi", "angle", "size", "longitudinal", "lateral", "spin")
        }
        for method, values in {"halfspace": self.reference, **self.forces}.items():
            columns |= {f"{name}_{method}": values[:, k] for k, name in enumerate(("fx", "fy", "mz"))}
        return csv_of([{name: v[i].item() for name, v in columns.items()} for i in range(d.number.size)])

    def json(self) -> str:
        """Return errors by method and class, and times, as JSON."""
        content = {
            "version": __version__,
            "cases": int(self.design.number.size),
            "elements": self.elements,
            "times": dict(self.times),
            "errors": [asdict(s) for s in self.spreads()],
        }
        return json.dumps(content, indent=2)

    title: ClassVar[str] = "Creep forces on ellipses"

    @property
    def about(self) -> list[str]:
        """Paragraphs of explanation for the tables."""
        return [
            f"wheelrail-contact {__version__}. Cases of Vollebregt, Iwnicki, Xie and Shackleton (2012): five ellipses, spin "
            "chi, size m and direction of the creepage. Errors are against our half space with "
            f"{self.elements} × {self.elements} elements on the ellipse; times are per case in one thread."
        ]

    def parts(self) -> Iterable[str]:
        """Yield the tables and the picture in HTML."""
        from contact.study.page import html_of, picture

        yield from map(html_of, self.tables())
        figure = self.figure()
        yield picture(figure, figure, "Share of the cases over the error of the force")


def statistics(
    tangential: Sequence[str] | None = None,
    *,
    cases: int | None = None,
    elements: int = ELEMENTS,
    n_strips: int = RESOLUTION,
    n_elements: int = RESOLUTION,
    stored: str | Path | None = None,
    processes: int | None = None,
    progress: Callable[[float, str], None] | None = None,
) -> Statistics:
    """Solve the 3220 cases with every tangential method on Hertz's ellipse, and with the half space.

    Parameters
    ----------
    tangential : sequence of str
        Names of tangential methods; default all that `contact.forces` offers.
    cases : int
        Number of cases, a fixed random sample; default all.
    elements : int
        Rows and columns of the half space on the ellipse, 4 to 1000.
    n_strips, n_elements : int
        Resolution of the methods.
    stored : path
        File for the results of the half space, from which an interrupted run continues.
    processes : int
        Number of processes for the half space; default all cores. More than one need ``if __name__ == "__main__"`` in the
        calling script.
    progress : callable
        Called with the share done, 0 to 1, and a description.

    Returns
    -------
    Statistics

    Raises
    ------
    ContactError
        For an unknown method, numbers outside their range, or a file that cannot be used.
    """
    names = list(methods().batched.tangential) if tangential is None else list(dict.fromkeys(tangential))
    if not names:
        raise ContactError("tangential is empty; at least one method is needed")
    for name in names:
        lookup("tangential", name, batched=True)
    require_integer("elements", elements, 4, 1000)
    for what, value in (("cases", cases), ("processes", processes)):
        if value is not None:
            require_integer(what, value, 1, 4000)
    d = design(cases)
    found: dict[str, Array] = {}
    times: dict[str, float] = {}
    for name in names:
        found[name], times[name] = _by_method(d, name, n_strips, n_elements)
    true = reference_forces(
        d, elements, stored=None if stored is None else Path(stored), processes=processes, progress=progress
    )
    return Statistics(d, elements, true, found, times)


def _by_method(d: Design, name: str, n_strips: int, n_elements: int) -> tuple[Array, float]:
    """Return the dimensionless forces of one method, shape (n, 3), and the time per case in one thread [s]."""
    scale, result, spent = FRICTION * LOAD, np.empty((d.number.size, 3)), 0.0
    for k in np.unique(d.ellipse):
        mask = d.ellipse == k

        def call(chosen: NDArray[np.bool_], k: int = int(k)) -> Any:
            return forces(
                separation_of(k),
                (d.longitudinal[chosen], d.lateral[chosen], d.spin[chosen]),
                load=LOAD,
                friction=FRICTION,
                material=MATERIAL,
                normal="hertz",
                tangential=name,
                n_strips=n_strips,
                n_elements=n_elements,
                threads=1,
            )

        call(np.flatnonzero(mask)[:1])  # type: ignore[arg-type]  # compile or load the kernels first
        start = perf_counter()
        many = call(mask)
        spent += perf_counter() - start
        c = d.c[mask]
        result[mask] = np.stack([many.Fx / scale, many.Fy / scale, many.Mz / (scale * c)], axis=1)
    return result, spent / d.number.size


def _percent(value: float) -> str:
    return f"{100.0 * value:.2f}" if not math.isclose(value, 0.0, abs_tol=1e-12) else "0"
