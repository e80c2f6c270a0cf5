"""Lobes as CONTACT joins them: fully up to the distance D_COMB, in shares up to D_SEP, and apart beyond."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.halfspace import Gap
from contact.halfspace.parts import Parts

#: Exponent of the share over the distance, of CONTACT.
_FADING = 0.8


class Lobe(NamedTuple):
    """Range of y in which the bodies overlap [m]."""

    low: float
    high: float


def lobes(gap: Gap, approach: float) -> list[Lobe]:
    """Return the lobes of a patch from low to high y."""
    least = gap.h.min(axis=1) - approach
    edges = np.flatnonzero(np.diff(np.concatenate(([False], least < 0.0, [False])).astype(np.int8))).reshape(-1, 2)
    return [Lobe(zero(gap.y, least, first - 1, first), zero(gap.y, least, end, end - 1)) for first, end in edges]


def zero(y: Array, least: Array, outside: int, inside: int) -> float:
    """Return where the line between two rows is 0 [m]."""
    if not 0 <= outside < y.size:
        return float(y[inside])
    t = least[inside] / (least[inside] - least[outside])
    return float(y[inside] + t * (y[outside] - y[inside]))


def parts(gap: Gap, approach: float, full: float, none: float) -> Parts | None:
    """Return the parts of a patch whose lobes act on each other in shares; None if they act fully.

    The influence is full up to the distance `full` between neighbouring lobes and ends at `none` [m]. CONTACT takes the share
    of the distance between, to the power of .8, and none between lobes that are no neighbours.
    """
    found = lobes(gap, approach)
    borders, shares = [], []
    for a, b in itertools.pairwise(found):
        distance = b.low - a.high
        if distance > full:
            borders.append(0.5 * (a.high + b.low))
            shares.append(max((none - distance) / (none - full), 0.0) ** _FADING if none > full else 0.0)
    if not borders:
        return None
    factor = np.eye(len(shares) + 1) + np.diag(shares, 1) + np.diag(shares, -1)
    return Parts(np.searchsorted(borders, gap.y), factor)


def reaches_over(gap: Gap, approach: float, distance: float) -> bool:
    """Return whether neighbouring lobes of a patch are further apart than `distance` [m]."""
    return any(b.low - a.high > distance for a, b in itertools.pairwise(lobes(gap, approach)))
