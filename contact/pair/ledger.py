"""What one pair does to both of its profiles, added up over the distance: the arrays, and the kernel that enters a patch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact._jit import kernel
from contact._layout import MAX_PATCHES
from contact.damage.deposit import N_ROWS, arc_length, deposit, place, strip_rates
from contact.geometry.layout import PATCH_ANGLE, PATCH_RAIL_Y, PATCH_RAIL_Z, PATCH_WHEEL_Y, PATCH_WHEEL_Z

Array = NDArray[np.float64]

WHEEL, RAIL = range(2)  # bins[BODY, ROW, bin], rows of `contact.damage.deposit`
# settings[...]: where the first bin begins, in widths; width of a bin [m]; distance that the next solution is for [m]
START, WIDTH, DISTANCE = range(3)
N_SETTINGS = 3


class Ledger(NamedTuple):
    """Bins over both profiles; without a bin nothing is entered.

    `wheel` and `rail` are rows y, z of the whole profiles, with the arc length of each point; `rates` and `edges` are scratch.
    """

    wheel: Array
    wheel_arc: Array
    rail: Array
    rail_arc: Array
    settings: Array
    rates: Array
    edges: Array
    bins: Array


@kernel
def enter(patch, strips, n, fields, parameters, damage, damage_fields, ledger):
    """Let the strips of one patch, on the right side, act on both profiles."""
    settings, rates, edges = ledger.settings, ledger.rates, ledger.edges
    start, width, distance = settings[START], settings[WIDTH], settings[DISTANCE]
    strip_rates(strips, n, fields, parameters, damage, damage_fields, rates)
    y, z, angle = patch[PATCH_WHEEL_Y], patch[PATCH_WHEEL_Z], patch[PATCH_ANGLE]
    place(ledger.wheel, ledger.wheel_arc, y, z, angle, 1.0, strips, n, edges)
    deposit(rates, edges, strips, n, distance, True, start, width, ledger.bins[WHEEL])
    place(ledger.rail, ledger.rail_arc, patch[PATCH_RAIL_Y], patch[PATCH_RAIL_Z], angle, 1.0, strips, n, edges)
    deposit(rates, edges, strips, n, distance, False, start, width, ledger.bins[RAIL])


def allocate(wheel: Array, rail: Array, n_strips: int, n_bins: int, first: float, width: float) -> Ledger:
    """A ledger with nothing in it, for patches of at most `n_strips` strips a part.

    Parameters
    ----------
    wheel, rail : ndarray
        Rows y, z [m] of the profiles with which the pair was made.
    n_bins : int
    first, width : float
        Arc length at which the first bin begins, and width of a bin [m].
    """
    arcs = [np.empty(rows.shape[1]) for rows in (wheel, rail)]
    for rows, arc in zip((wheel, rail), arcs, strict=True):
        arc_length(rows, arc)
    settings, capacity = np.zeros(N_SETTINGS), MAX_PATCHES * n_strips
    settings[START], settings[WIDTH] = first / width, width
    rates, edges, bins = (np.zeros(shape) for shape in ((N_ROWS, capacity), (2, capacity), (2, N_ROWS, n_bins)))
    return Ledger(wheel, arcs[0], rail, arcs[1], settings, rates, edges, bins)


def closed() -> Ledger:
    """A ledger without bins, in which nothing is entered."""
    nothing, none = np.zeros((2, 0)), np.zeros(0)
    return Ledger(nothing, none, nothing, none, np.zeros(N_SETTINGS), nothing, nothing, np.zeros((2, N_ROWS, 0)))
