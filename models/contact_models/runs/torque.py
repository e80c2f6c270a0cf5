"""Torques on axles, as a scenario declares them: traction and braking."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from contact.errors import ContactError, require_number, suggestion

OVER = ("distance", "time")


@dataclass(frozen=True, kw_only=True)
class Torque:
    """Torque about axles over the distance or the time: straight lines between places, constant beyond the ends.

    Parameters
    ----------
    at : distances [m] or times since the start [s], increasing
    values : torques at these places [N m], -1e6 to 1e6, positive when they drive forward
    axles : names of the wheelsets; default: all
    over : "distance", that of the axle, or "time"
    """

    at: tuple[float, ...]
    values: tuple[float, ...]
    axles: tuple[str, ...] = ()
    over: str = "distance"

    def __post_init__(self) -> None:
        if self.over not in OVER:
            raise ContactError(f"over = {self.over!r} is neither 'distance' nor 'time'{suggestion(self.over, OVER)}")
        if len(self.at) != len(self.values) or not self.at:
            raise ContactError(
                f"at has {len(self.at)} places and values {len(self.values)} torques; equally many are needed"
            )
        for k, place in enumerate(self.at):
            require_number(f"at[{k}]", place, self.at[k - 1] if k else -math.inf, open_minimum=k > 0)
            require_number(f"values[{k}]", self.values[k], -1e6, 1e6)

    def require_axles(self, axles: Sequence[str], where: str) -> None:
        """Check that the axles are those of the vehicle.

        Raises
        ------
        ContactError
            If one is not. The message begins with `where` and has the names of the vehicle.
        """
        for k, axle in enumerate(self.axles):
            if axle not in axles:
                names = ", ".join(map(repr, axles))
                raise ContactError(f"{where}.axles[{k}] = {axle!r} is no wheelset; the vehicle has {names}")

    def on(self, axle: str, distance: float, time: float) -> float:
        """Return the torque [N m] on an axle that is at `distance` [m] at a `time` [s]."""
        if self.axles and axle not in self.axles:
            return 0.0
        return float(np.interp(distance if self.over == "distance" else time, self.at, self.values))
