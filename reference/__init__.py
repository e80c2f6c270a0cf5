"""Reference numbers for tests, benchmarks and documentation. README.md names the source of each file.

Each file is read once. Lines that begin with # are comments.
"""

from __future__ import annotations

import csv
import json
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import contact

FOLDER = Path(__file__).parent
#: Material and friction with which the sets of CONTACT were computed.
STEEL = contact.Material(82e9, 0.28)
MU = 0.3
N_ELLIPSE = 52359.88  # [N] normal force on the ellipses

Rows = list[dict[str, str]]


class Patch(NamedTuple):
    """A patch of set O: our separation, CONTACT's load and answers; SI units, forces on the wheel."""

    name: str
    separation: contact.Separation
    creepage: contact.Creepage
    friction: float
    N: float
    Fx: float
    Fy: float
    max_pressure: float


def rows(name: str | Path) -> Rows:
    """Return the rows of a table with a header. `name` is a file in this folder or a full path."""
    return list(csv.DictReader(_lines(name)))


def _lines(name: str | Path) -> list[str]:
    return [line for line in (FOLDER / name).read_text(encoding="utf-8").splitlines() if not line.startswith("#")]


def _cases(name: str) -> list[dict[str, Any]]:
    return json.loads((FOLDER / name).read_text(encoding="utf-8"))["cases"]


@cache
def ellipses() -> list[dict[str, Any]]:
    """Return set A: creepages and forces on ellipses."""
    return [{k: v if k == "curve" else float(v) for k, v in row.items()} for row in rows("ellipses.csv")]


@cache
def fields() -> list[dict[str, Any]]:
    """Return set B: traction fields."""
    return _cases("fields.json")


@cache
def patches() -> list[dict[str, Any]]:
    """Return set D: real patches of S1002 on UIC60."""
    return _cases("patches.json")


def separation_of(case: dict[str, Any]) -> contact.Separation:
    """Return the separation of a case of set D."""
    return contact.Separation(*(np.array(case[k]) * s for k, s in (("y", 1e-3), ("g", 1e-3), ("A", 1e3))))


@cache
def wheel_rail_patches() -> tuple[Patch, ...]:
    """Return the difficult patches of set O."""
    return tuple(
        Patch(
            case["name"],
            contact.Separation(*(np.array(case[k]) for k in ("y", "g", "A", "x_c"))),
            contact.Creepage(*case["creepage"]),
            *(case[k] for k in Patch._fields[3:]),
        )
        for case in _cases("wheel_rail_patches.json")
    )


@cache
def linear_slopes() -> list[dict[str, Any]]:
    """Return the slopes at vanishing creepage, slopes[creepage][force], on the patches of set D in their order."""
    return _cases("linear_slopes.json")


@cache
def unseen_ellipses() -> tuple[np.ndarray, np.ndarray]:
    """Return random ellipses with the results of our half space.

    The first array (n, 4) is a/b and three creepages. The second (n, 4) is Fx and Fy over mu N, Mz over mu N c and the share of
    slip.
    """
    table = np.array([[float(v) for v in row.values()] for row in rows("creep_table_unseen.csv")])
    return table[:, :4], table[:, 4:]


@cache
def wheel_rail() -> Rows:
    """Return the patches of S1002 on UIC 60, one for each row."""
    return rows("wheel_rail.csv")


@cache
def conicities() -> Rows:
    """Return the equivalent conicities of EN 15302, both editions."""
    return rows("en15302.csv")


@cache
def frictional_energies() -> list[tuple[str, tuple[float, ...]]]:
    """Return name and (xi, eta, phi [1/mm], Fx, Fy [N], Mz [N mm], energy per metre [N]) of cases on ellipses."""
    return [(name, tuple(map(float, values))) for name, *values in csv.reader(_lines("frictional_energy.csv"))]
