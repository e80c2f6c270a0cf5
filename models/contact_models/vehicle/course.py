"""The track of a vehicle as the rows that its kernels read: plan, cant, speed, irregularities of both rails, friction."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError
from .kernels.layout import BEYOND, TrackRow
from .measured import RAIL_DISTANCE
from .track import Track

SPACING = 0.05  # largest distance of the places of a track [m]
#: Largest number of places of a track; 17 rows of them take 136 MB.
MOST_PLACES = 1_000_000
#: Kinks at the ends of transitions are rounded over this distance [m], as the bending of the rails does.
ROUNDING = 2.0
_HALF_BASE = 0.5 * RAIL_DISTANCE


def lay(track: Track, length: float, speed: Callable[[float], float], seed: tuple[int, ...], settling: float) -> Array:
    """Return the rows of a track from -`BEYOND` to `length` + `BEYOND`, in the order of `Row`.

    Its places are `SPACING` apart, or as far apart as the closest stations of a measured track.

    Parameters
    ----------
    track : Track
    length : float
        [m].
    speed : callable
        Speed [m/s] over the distance [m].
    seed : tuple of int
        Seed of the random irregularities. The channels are independent.
    settling : float
        Distance over which the irregularities grow from zero [m].

    Raises
    ------
    ContactError
        If the stations are so close that there would be more than `MOST_PLACES`.
    """
    whole, spacing = length + 2.0 * BEYOND, min(SPACING, track.resolution)
    if whole / spacing > MOST_PLACES:
        raise ContactError(
            f"measured = {track.series and track.series.file!r}: its closest stations are {spacing:.3g} m apart, which makes "
            f"{whole / spacing:.3g} places on {whole:g} m; {MOST_PLACES} are allowed. Take stations at least "
            f"{whole / MOST_PLACES:.3g} m apart, or a shorter length"
        )
    s = np.arange(-BEYOND, length + BEYOND + 0.5 * spacing, spacing)
    rows = np.zeros((len(TrackRow), s.size))
    rows[TrackRow.PLACE] = s
    plan = np.zeros((2, s.size))
    for curve in track.curves:
        share = np.array([curve.share(place) for place in s])
        plan[0] += share / curve.radius
        plan[1] += share * math.asin(curve.cant / RAIL_DISTANCE)
    curvature, cant = (_rounded(row, round(ROUNDING / spacing)) for row in plan)
    rows[TrackRow.CURVATURE], rows[TrackRow.CANT] = curvature, cant
    rows[TrackRow.CANT_SLOPE] = np.gradient(cant, spacing)
    direction = _integral(0.5 * (curvature[1:] + curvature[:-1]), spacing)
    middle = direction[:-1] + spacing * (0.375 * curvature[:-1] + 0.125 * curvature[1:])
    rows[TrackRow.DIRECTION] = direction
    for row, part in ((TrackRow.X, np.cos), (TrackRow.Y, np.sin)):  # Simpson's rule
        rows[row] = _integral((part(direction[:-1]) + 4.0 * part(middle) + part(direction[1:])) / 6.0, spacing)
    rows[TrackRow.SPEED] = [speed(place) for place in s]
    lateral, vertical, roll, gauge = track.channels(seed, s, settling)
    for row, side in ((TrackRow.RIGHT_Y, 1.0), (TrackRow.LEFT_Y, -1.0)):
        rows[row : row + 2] = lateral + 0.5 * side * gauge
        rows[row + 2 : row + 4] = vertical + _HALF_BASE * side * roll
    rows[TrackRow.RIGHT_FRICTION], rows[TrackRow.LEFT_FRICTION] = track.friction_at(s)
    return rows


def _integral(means: Array, spacing: float) -> Array:
    return np.concatenate(([0.0], spacing * np.cumsum(means)))


def _rounded(row: Array, width: int) -> Array:
    """Return the running mean over `width` places of a row, taken twice. Its sum is kept."""
    box = np.full(width + 1, 1.0)
    box[0] = box[-1] = 0.5
    box /= box.sum()
    padded = np.pad(row, width, mode="edge")
    return np.convolve(np.convolve(padded, box, "valid"), box, "valid")
