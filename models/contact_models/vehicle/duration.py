"""How long a run takes: at walking pace the stable step of a vehicle is some microseconds."""

from __future__ import annotations

import numpy as np

from contact.arrays import Array
from contact.errors import PlausibilityWarning, warn
from .kernels.layout import TrackRow

#: Time of a step for each wheel on one core [s], and from how many hours on a run is told to be long.
_OF_WHEEL, _LONG = 1e-4, 0.5


def doubt_duration(name: str, track: Array, way: tuple[float, float], step: float, n_wheels: int) -> None:
    """Warn of a run over a way [m] that takes long, because its speed is so low that the stable step [s] is short."""
    there = (track[TrackRow.PLACE] >= way[0]) & (track[TrackRow.PLACE] <= way[1])
    place, speed = track[TrackRow.PLACE, there], track[TrackRow.SPEED, there]
    many = float(np.sum(np.diff(place) / speed[1:])) / step
    hours = many * n_wheels * _OF_WHEEL / 3600.0
    if hours > _LONG and step < 1e-4:
        warn(
            f"{name}: at {speed.min():g} m/s the stable step is {step:.2g} s, so the run takes {many:.2g} steps, some "
            f"{hours:.2g} hours on one core. Twice the speed takes a quarter of that",
            PlausibilityWarning,
        )
