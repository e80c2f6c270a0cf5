"""Damage of every wheel and of the rail under it, in the ledgers of their contacts and as histograms."""

from __future__ import annotations

import numpy as np

from contact.accumulation import MAXIMA, SUMS, Histogram
from contact.inputs.material import Material
from contact.instance import workspace
from contact.kernels.arrays import Ledger
from .kernels.wheel_arrays import WheelArrays, bins

BODIES = ("wheel", "rail")
_NAMES = (*SUMS, *MAXIMA)


def ledger(wheel: Histogram, rail: Histogram, n_strips: int) -> Ledger:
    """Return an empty ledger whose bins are those of both histograms."""
    of_wheel, of_rail = (np.stack((each.profile.y, each.profile.z)) for each in (wheel, rail))
    first, last = min(wheel.edges[0], rail.edges[0]), max(wheel.edges[-1], rail.edges[-1])
    return workspace.ledger(of_wheel, of_rail, n_strips, round((last - first) / wheel.width), float(first), wheel.width)


def fill(
    histograms: tuple[Histogram, Histogram],
    wheel_arrays: WheelArrays,
    wheel: int,
    distance: float,
    methods: set[str],
    steel: Material,
) -> None:
    """Replace the damage of the histograms of a wheel and its rail by that of the ledger of wheel number `wheel`."""
    stored = bins(wheel_arrays, wheel)
    first = min(each.edges[0] for each in histograms)
    for histogram, rows in zip(histograms, stored, strict=True):
        start = round((histogram.edges[0] - first) / histogram.width)
        inside = slice(start, start + histogram.edges.size - 1)
        values = dict(zip(_NAMES, rows[:, inside], strict=True))
        histogram.restore(values, distance, methods, {steel})
