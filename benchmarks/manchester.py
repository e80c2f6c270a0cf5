"""The Manchester contact benchmark against CONTACT (case A-2.2 of Shackleton and Iwnicki 2008; docs/check/manchester.md).

    python -m benchmarks.manchester [--write docs/check/manchester.md]

`reference.manchester` has the positions and CONTACT's results, with their provenance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import contact
from benchmarks.tables import tell
from contact.geometry.records import Patch
from contact.study.pairs import RESOLUTION, SELECTION, Pair
from contact.study.row import Row
from contact.study.table import Table, number, percent
from reference.manchester import FRICTION, Place, places, settled

METHODS = (*SELECTION, Pair("kpec", "fastsim"))


class Found(NamedTuple):
    """Our patch at each place, at the height at which our half space carries the load, and all methods with its force."""

    places: Sequence[Place]
    patches: Sequence[Patch]
    comparison: contact.Comparison


def compute(at: Sequence[Place] | None = None, methods: Iterable[str | Pair] = METHODS, elements: int = 80) -> Found:
    """Compute some places, by default all, with a half space of `elements` rows and columns."""
    chosen = places() if at is None else at
    patches, cases = zip(*(settled(place, elements) for place in chosen), strict=True)
    return Found(chosen, patches, contact.compare(list(cases), list(map(str, methods)), reference_elements=elements))


def tables(found: Found) -> list[Table]:
    """Return tables of our half space and CONTACT, all methods against CONTACT, and KPEC and ANALYN of both programs."""
    rows_of = [rows for _, rows, _ in found.comparison.by_case()]
    units = ("angle", "mrad"), ("N", "N"), ("Fx", "N"), ("Fy", "N"), ("approach", "µm"), ("peak", "MPa")
    rows = []
    for place, patch, ours in zip(found.places, found.patches, rows_of, strict=True):
        for name, angle, r in ((place.name, patch.angle, ours[0]), ("  CONTACT", place.angle, place)):
            values = (1e3 * angle, r.N, r.Fx, r.Fy, 1e6 * r.approach, 1e-6 * r.max_pressure)
            rows.append([name, *map(number, values)])
    made = [Table("Our half space, and CONTACT", (("", ""), *units), rows)]
    short = [("method", ""), *((f"{1e3 * p.y:g} {p.side[0].upper()}", "%") for p in found.places)]
    for caption, error in _ERRORS:
        rows = [
            [
                f"{pair.normal} + {pair.tangential}",
                *(percent(100.0 * error(p, r[k])) for p, r in zip(found.places, rows_of, strict=True)),
            ]
            for k, pair in enumerate(found.comparison.pairs)
        ]
        made.append(Table(f"{caption} against CONTACT's half space; mm and side", short, rows))
    heads = ("", ""), ("approach", "µm"), ("CONTACT's", "µm"), ("peak", "MPa"), ("CONTACT's", "MPa")
    return [*made, Table("KPEC and ANALYN, and CONTACT's", heads, list(fast(found)))]


def fast(found: Found) -> Iterator[list[str]]:
    """Yield our KPEC and ANALYN beside those of CONTACT that are published."""
    for method in ("kpec", "analyn"):
        for place, case in zip(found.places, found.comparison.cases, strict=True):
            if (published := getattr(place, method)) is not None:
                s = contact.solve(**case.arguments, normal=method, n_strips=RESOLUTION, throw=False)
                both = 1e6 * s.approach, 1e6 * published[0], 1e-6 * s.max_pressure, 1e-6 * published[1]
                yield [f"{method}, {place.name}", *map(number, both)]


def _force_error(place: Place, row: Row) -> float:
    limit, true_limit = FRICTION * row.N, FRICTION * place.N
    return math.hypot(row.Fx / limit - place.Fx / true_limit, row.Fy / limit - place.Fy / true_limit)


_ERRORS: Sequence[tuple[str, Callable[[Place, Row], float]]] = (
    ("Force over µN", _force_error),
    ("Peak pressure", lambda place, row: row.max_pressure / place.max_pressure - 1.0),
    ("Approach", lambda place, row: row.approach / place.approach - 1.0),
)


def report() -> dict[str, str]:
    """Return the tables of the page."""
    return {"tables": "\n\n".join(table.markdown() for table in tables(compute())) + "\n"}


if __name__ == "__main__":
    tell(report, __doc__)
