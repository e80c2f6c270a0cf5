"""Reference numbers that tests, benchmarks and documentation compare with; README.md says where each comes from.

Files are read once, lines that begin with # are comments.
"""

from __future__ import annotations

import csv
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import contact

FOLDER = Path(__file__).parent
#: What the sets of CONTACT were computed with.
STEEL = contact.Material(82e9, 0.28)
MU = 0.3
N_ELLIPSE = 52359.88  # [N] of the ellipses

Rows = list[dict[str, str]]


def rows(name: str | Path) -> Rows:
    """Rows of a table with a header, by the name of the file in this folder, or another's whole path."""
    return list(csv.DictReader(_lines(name)))


def _lines(name: str | Path) -> list[str]:
    return [line for line in (FOLDER / name).read_text(encoding="utf-8").splitlines() if not line.startswith("#")]


def _cases(name: str) -> list[dict[str, Any]]:
    return json.loads((FOLDER / name).read_text(encoding="utf-8"))["cases"]


@cache
def ellipses() -> list[dict[str, Any]]:
    """Set A: creepages and forces on ellipses."""
    return [{k: v if k == "curve" else float(v) for k, v in row.items()} for row in rows("ellipses.csv")]


@cache
def fields() -> list[dict[str, Any]]:
    """Set B: traction fields."""
    return _cases("fields.json")


@cache
def patches() -> list[dict[str, Any]]:
    """Set D: real patches of S1002 on UIC60."""
    return _cases("patches.json")


def separation_of(case: dict[str, Any]) -> contact.Separation:
    """The separation of a case of set D."""
    return contact.Separation(*(np.array(case[k]) * s for k, s in (("y", 1e-3), ("g", 1e-3), ("A", 1e3))))


@cache
def linear_slopes() -> list[dict[str, Any]]:
    """Slopes at vanishing creepage on the patches of set D, in their order: slopes[creepage][force]."""
    return _cases("linear_slopes.json")


@cache
def unseen_ellipses() -> tuple[np.ndarray, np.ndarray]:
    """Random a/b and creepages (n, 4); Fx, Fy over mu N, Mz over mu N c and the share of slip (n, 4) by our half space."""
    table = np.array([[float(v) for v in row.values()] for row in rows("creep_table_unseen.csv")])
    return table[:, :4], table[:, 4:]


@cache
def wheel_rail() -> Rows:
    """S1002 on UIC 60, one patch a row."""
    return rows("wheel_rail.csv")


@cache
def conicities() -> Rows:
    """Equivalent conicities of EN 15302, both editions."""
    return rows("en15302.csv")


@cache
def frictional_energies() -> list[tuple[str, tuple[float, ...]]]:
    """Names, and xi, eta, phi [1/mm], Fx, Fy [N], Mz [N mm] and the energy per metre [N] on ellipses."""
    return [(name, tuple(map(float, values))) for name, *values in csv.reader(_lines("frictional_energy.csv"))]
