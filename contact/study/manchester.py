"""The Manchester contact benchmark, compared with CONTACT (case A-2.2 of Shackleton and Iwnicki 2008).

A wheelset with S1002 wheels on UIC 60 rails is displaced and yawed by 2.4 mrad per millimetre. Its roll and pitch rate are
given. Each wheel carries 10 kN, including friction. CONTACT's results are in manchester.csv, with their provenance.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, ClassVar

from contact.errors import ContactError
from contact.geometry import profile
from contact.geometry.records import Patch, Pose, Velocity
from contact.geometry.wheelset import Pair as WheelOnRail
from contact.results import Solution
from contact.solve import solve
from contact.study.case import Case
from contact.study.compare import REFERENCE_ELEMENTS, Progress, compare
from contact.study.comparison import Comparison
from contact.study.files import csv_of
from contact.study.pairs import REFERENCE, RESOLUTION, SELECTION, Pair
from contact.study.report import Report
from contact.study.row import Row
from contact.study.table import Table, number, percent
from contact.version import __version__

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LOAD, SPEED, FRICTION = 10e3, 2.0, 0.3
METHODS = (*SELECTION, Pair("kpec", "fastsim"))
#: Largest number of Newton steps for the height of the wheelset, and their relative tolerance of the load.
_MAX_STEPS, _TOLERANCE = 20, 1e-5
NOTES = (
    "CONTACT's elements are 0.2 mm wide. At 7 and 10 mm its patch has only four rows of them, so its peak is less certain.",
    "CONTACT's KPEC has 443 MPa at 0 mm, 31 % above its own half space. At the edge of this patch it cuts strips deeper than "
    "the profiles overlap, and one row of elements determines the peak. If the depth of the cut is capped at the overlap, "
    "CONTACT gives 302 MPa and 14.0 µm on every grid. Our KPEC has this cap.",
    "At 5 mm the right wheel has two patches close to each other. CONTACT weakens the interaction of such patches by a factor "
    "that depends on its settings D_COMB and D_SEP. In our half space they interact fully.",
    "At 0 and 0.5 mm the longitudinal creepage is small. Ours is that of the wheel's surface. It differs from CONTACT's by up "
    "to the penetration over the radius, 4e-5, and the forces differ accordingly.",
)


@dataclass(frozen=True, slots=True)
class Place:
    """A position of the benchmark and CONTACT's results, in SI units. Forces act on the wheel; creepages are wheel minus rail.

    Attributes
    ----------
    y, yaw, roll, pitch, side : pose of the wheelset [m], [rad], [rad], its pitch rate [rad/s], and the side of the wheel
    angle : contact angle [rad]
    longitudinal, lateral, spin : creepages over the mean of V and the wheel's circumferential speed [-], [-], [1/m]
    N, Fx, Fy, approach, max_pressure : results of CONTACT's half space
    kpec, analyn : approach [m] and peak pressure [Pa] by CONTACT's fast methods, or None
    """

    y: float
    yaw: float
    roll: float
    pitch: float
    side: str
    angle: float
    longitudinal: float
    lateral: float
    spin: float
    N: float
    Fx: float
    Fy: float
    approach: float
    max_pressure: float
    kpec: tuple[float, float] | None
    analyn: tuple[float, float] | None

    @property
    def name(self) -> str:
        """Name in tables."""
        return f"{1e3 * self.y:g} mm {self.side}"


@cache
def places() -> tuple[Place, ...]:
    """Return the positions for which results of CONTACT are available."""
    text = resources.files("contact.study").joinpath("manchester.csv").read_text(encoding="utf-8")
    found = []
    for row in csv.DictReader(line for line in text.splitlines() if not line.startswith("#")):
        given = {name: float(value) for name, value in row.items() if name != "side" and value}
        fast = [
            (1e-3 * given[f"approach_{method}"], 1e6 * given[f"pmax_{method}"]) if f"pmax_{method}" in given else None
            for method in ("kpec", "analyn")
        ]
        found.append(
            Place(
                1e-3 * given["y"], given["yaw"], given["roll"], given["pitch"], row["side"], given["angle"],
                -given["xi"], -given["eta"], -1e3 * given["phi"], given["N"], -given["Fx"], -given["Fy"],
                1e-3 * given["approach"], 1e6 * given["pmax"], *fast,
            )
        )  # fmt: skip
    return tuple(found)


@dataclass(frozen=True)
class Manchester(Report):
    """Our results at the positions of the benchmark.

    Attributes
    ----------
    places : tuple of Place
        Positions with CONTACT's results.
    patches : tuple of Patch
        Our patches, at the height at which our half space carries the load.
    comparison : Comparison
        One case per position, with the normal force of our half space.
    fast : dict
        Method → solutions by KPEC and ANALYN with that force, in the order of the positions.
    """

    places: tuple[Place, ...]
    patches: tuple[Patch, ...]
    comparison: Comparison
    fast: dict[str, tuple[Solution, ...]]

    def tables(self) -> list[Table]:
        """Return tables of our half space and CONTACT, all methods against CONTACT, and KPEC and ANALYN of both programs."""
        headings = (
            ("", ""), ("angle", "mrad"), ("N", "N"), ("Fx", "N"), ("Fy", "N"), ("approach", "µm"), ("peak", "MPa"),
        )  # fmt: skip
        rows = []
        true_rows = [rows_of[0] for _, rows_of, _ in self.comparison.by_case()]
        for place, patch, row in zip(self.places, self.patches, true_rows, strict=True):
            for name, angle, r in ((place.name, patch.angle, row), ("  CONTACT", place.angle, place)):
                values = (1e3 * angle, r.N, r.Fx, r.Fy, 1e6 * r.approach, 1e-6 * r.max_pressure)
                rows.append([name, *map(number, values)])
        tables = [Table("Our half space, and CONTACT", headings, rows)]
        short = [("method", ""), *((f"{1e3 * p.y:g} {p.side[0].upper()}", "%") for p in self.places)]
        for caption, error in _ERRORS:
            cells = [
                [f"{pair.normal} + {pair.tangential}", *(percent(100.0 * error(*found)) for found in self._by_place(k))]
                for k, pair in enumerate(self.comparison.pairs)
            ]
            tables.append(Table(f"{caption} against CONTACT's half space; mm and side", short, cells))
        rows = []
        for method, solutions in self.fast.items():
            for place, s in zip(self.places, solutions, strict=True):
                published = getattr(place, method)
                if published is not None:
                    approach, peak = published
                    both = (1e6 * s.approach, 1e6 * approach, 1e-6 * s.max_pressure, 1e-6 * peak)
                    rows.append([f"{method}, {place.name}", *map(number, both)])
        units = (("", ""), ("approach", "µm"), ("CONTACT's", "µm"), ("peak", "MPa"), ("CONTACT's", "MPa"))
        tables.append(Table("KPEC and ANALYN, and CONTACT's", units, rows))
        return tables

    def _by_place(self, k: int) -> list[tuple[Place, Row]]:
        """Return each position with the row of pair k."""
        return [(place, rows[k]) for place, (_, rows, _) in zip(self.places, self.comparison.by_case(), strict=True)]

    def figure(self) -> Figure:
        """Return the picture of the patches of all methods at each position."""
        return self.comparison.figure()

    def csv(self) -> str:
        """Return CSV with one line per position and pair. CONTACT's numbers have names that end in _contact."""
        names = ("angle", "N", "Fx", "Fy", "approach", "max_pressure")
        lines = []
        for (_, rows, _), place, patch in zip(self.comparison.by_case(), self.places, self.patches, strict=True):
            published = {f"{name}_contact": getattr(place, name) for name in names}
            lines += [row.flat() | {"angle": patch.angle} | published for row in rows]
        return csv_of(lines)

    def json(self) -> str:
        """Return the comparison and CONTACT's results as JSON."""
        content = json.loads(self.comparison.json())
        for case, place, patch in zip(content["cases"], self.places, self.patches, strict=True):
            case |= {"angle": patch.angle, "contact": asdict(place)}
        return json.dumps(content | {"notes": NOTES}, indent=2)

    title: ClassVar[str] = "Manchester contact benchmark, A-2.2"

    @property
    def about(self) -> list[str]:
        """Paragraphs of explanation for the tables."""
        return [
            f"wheelrail-contact {__version__} compared with CONTACT (Apache-2.0; 25.1, rev 2707, and the examples of rev "
            "2447). S1002 on UIC 60 1:40: a wheelset on straight track, displaced and yawed by 2.4 mrad per millimetre, 10 kN "
            "on each wheel. Forces act on the wheel. At the height used, our half space carries the load. All methods have its "
            "normal force.",
            *NOTES,
        ]

    def parts(self) -> Iterable[str]:
        """Yield the tables and the comparison of each position in HTML."""
        from contact.study.page import html_of

        yield from map(html_of, self.tables())
        yield from self.comparison.parts()


def manchester(
    methods: str | Iterable[str | tuple[str, str]] = METHODS,
    *,
    at: Sequence[Place] | None = None,
    n_strips: int = RESOLUTION,
    n_elements: int = RESOLUTION,
    reference_elements: int = REFERENCE_ELEMENTS,
    progress: Progress | None = None,
) -> Manchester:
    """Compute the benchmark. Our half space finds the height of the wheel; then all methods solve the patch there.

    Parameters
    ----------
    methods, n_strips, n_elements, reference_elements, progress :
        As in `contact.compare`.
    at : sequence of Place
        Some of `places`; default all.

    Returns
    -------
    Manchester

    Raises
    ------
    ContactError
        As `contact.compare`, and if `at` is empty.
    """
    chosen = places() if at is None else tuple(at)
    if not chosen:
        raise ContactError("at is empty; at least one place is needed")
    tell = progress or (lambda share, what: None)
    patches, cases = [], []
    for k, place in enumerate(chosen):
        tell(0.3 * k / len(chosen), f"{place.name}: height under the load")
        patch, N = _settled(place, reference_elements)
        patches.append(patch)
        cases.append(Case(patch.separation, patch.creepage, load=N, friction=FRICTION, speed=SPEED, name=place.name))
    found = compare(
        cases,
        methods,
        n_strips=n_strips,
        n_elements=n_elements,
        reference_elements=reference_elements,
        progress=lambda share, what: tell(0.3 + 0.7 * share, what),
    )
    fast = {
        normal: tuple(solve(**case.arguments, normal=normal, n_strips=n_strips, throw=False) for case in cases)
        for normal in ("kpec", "analyn")
    }
    return Manchester(chosen, tuple(patches), found, fast)


def _settled(place: Place, elements: int) -> tuple[Patch, float]:
    """Return the patch at the height at which the half space carries the load, and its normal force [N]."""
    wheel, rail = profile.s1002(), profile.rail_60e1(1 / 40, breakpoints="UIC 519")
    both = WheelOnRail(wheel, rail, side=place.side)  # type: ignore[arg-type]
    motion = Velocity(forward=SPEED, spin=place.pitch)
    both.contacts(Pose(y=place.y, roll=place.roll, yaw=place.yaw), motion, load=LOAD)
    z = both.z
    for _ in range(_MAX_STEPS):
        found = both.contacts(Pose(y=place.y, z=z, roll=place.roll, yaw=place.yaw), motion)
        if len(found) != 1:
            raise ContactError(f"{place.name} has {len(found)} contact patches; the benchmark's places have one")
        patch = found[0]
        s = solve(
            patch.separation, patch.creepage, approach=patch.approach, friction=FRICTION, throw=False,
            normal=REFERENCE.normal, tangential=REFERENCE.tangential, n_strips=elements, n_elements=elements,
        )  # fmt: skip
        vertical = s.N * math.cos(patch.angle) - s.Fy * math.sin(patch.angle)
        if abs(vertical - LOAD) <= _TOLERANCE * LOAD:
            return patch, s.N
        z -= (vertical - LOAD) / (vertical / s.N * s.normal_stiffness * math.cos(patch.angle))
    raise ContactError(f"{place.name}: the height under the load was not found in {_MAX_STEPS} steps")


def _force_error(place: Place, row: Row) -> float:
    limit, true_limit = FRICTION * row.N, FRICTION * place.N
    return math.hypot(row.Fx / limit - place.Fx / true_limit, row.Fy / limit - place.Fy / true_limit)


_ERRORS: Sequence[tuple[str, Callable[[Place, Row], float]]] = (
    ("Force over µN", _force_error),
    ("Peak pressure", lambda place, row: row.max_pressure / place.max_pressure - 1.0),
    ("Approach", lambda place, row: row.approach / place.approach - 1.0),
)
