"""A track over its length: curves with transitions and cant, and random alignment."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from contact.arrays import Array
from contact.errors import ContactError, require_number
from .measured import Measured
from .spectra import CHANNELS, Irregularities

#: Speeds of a run [m/s]. Below, the steps would be micrometres: explicit integration of creepage needs steps in proportion.
SLOWEST, FASTEST = 0.1, 150.0


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A curve: transition, circle, transition. Curvature and cant are linear in the distance along the transitions.

    Parameters
    ----------
    start : start of the first transition [m]
    radius : radius of the circle [m], 15 to 100000
    length : length of the circle [m]
    transition : length of each transition [m], at least 1 m
    cant : height of the outer rail above the inner rail [m], 0 to 0.2
    direction : "right" or "left"
    """

    start: float
    radius: float
    length: float
    transition: float = 50.0
    cant: float = 0.0
    direction: str = "right"

    def __post_init__(self) -> None:
        require_number("start", self.start, 0.0)
        require_number("radius", self.radius, 15.0, 1e5)
        require_number("length", self.length, 0.0)
        require_number("transition", self.transition, 1.0)
        require_number("cant", self.cant, 0.0, 0.2)
        if self.direction not in ("right", "left"):
            raise ContactError(f"direction = {self.direction!r} is neither 'right' nor 'left'")

    @property
    def end(self) -> float:
        """End of the last transition [m]."""
        return self.start + self.length + 2.0 * self.transition

    def share(self, s: float) -> float:
        """Return the share of curvature and cant at `s` [m], 0 to 1; negative for a curve to the left."""
        share = min(s - self.start, self.end - s) / self.transition
        return math.copysign(min(max(share, 0.0), 1.0), 1.0 if self.direction == "right" else -1.0)


@dataclass(frozen=True, kw_only=True)
class Friction:
    """Factors on the coefficient of friction along the track, interpolated linearly, constant beyond the ends.

    Parameters
    ----------
    at : distances [m], increasing
    right, left : factors of both rails at these distances, 0 to 5
    """

    at: tuple[float, ...]
    right: tuple[float, ...]
    left: tuple[float, ...]

    def __post_init__(self) -> None:
        if not len(self.at) == len(self.right) == len(self.left) > 0:
            raise ContactError(f"at, right and left have {len(self.at)}, {len(self.right)} and {len(self.left)} values")
        for k, place in enumerate(self.at):
            require_number(f"at[{k}]", place, self.at[k - 1] if k else -math.inf, open_minimum=k > 0)
            require_number(f"right[{k}]", self.right[k], 0.0, 5.0)
            require_number(f"left[{k}]", self.left[k], 0.0, 5.0)


@dataclass(frozen=True, kw_only=True)
class Track:
    """A track that is straight outside its `curves`, which must not overlap.

    Parameters
    ----------
    curves : tuple of Curve
    alignment, vertical, cross_level, gauge : Irregularities, optional
        Random irregularities: of the centre line to the right, of its height downwards, of the angle by which the left rail
        lies higher, and of the gauge.
    measured : Measured or str, optional
        Station series instead: a table, or the path of its file alone.
    friction : Friction, optional
    """

    curves: tuple[Curve, ...] = ()
    alignment: Irregularities | None = None
    vertical: Irregularities | None = None
    cross_level: Irregularities | None = None
    gauge: Irregularities | None = None
    measured: Measured | str | None = None
    friction: Friction | None = None

    def __post_init__(self) -> None:
        if self.measured is not None and any(getattr(self, channel) for channel in CHANNELS):
            raise ContactError(f"measured = {self.measured!r} excludes random irregularities")
        if isinstance(self.measured, str):
            object.__setattr__(self, "measured", Measured(file=self.measured))
        ordered = sorted(self.curves, key=lambda curve: curve.start)
        for before, after in itertools.pairwise(ordered):
            if after.start < before.end:
                raise ContactError(
                    f"curves: the curve that starts at {after.start:g} m overlaps the previous curve, which ends at "
                    f"{before.end:g} m"
                )

    @property
    def series(self) -> Measured | None:
        """The measured series."""
        return None if isinstance(self.measured, str) else self.measured

    @property
    def resolution(self) -> float:
        """Least distance of the stations of a measured track [m]; inf for others, whose waves are .5 m long or longer."""
        return self.series.resolution if self.series is not None else math.inf

    def channels(self, seed: tuple[int, ...], s: Array, settling: float) -> tuple[Array, ...]:
        """Return values and slopes of alignment, vertical, cross-level and gauge at the distances `s` [m], shape (2, n) each.

        They grow from zero over the first `settling` metres. The channels have independent random numbers.
        """
        if self.series is not None:
            found = self.series.over(s)
        else:
            found = [np.zeros((2, s.size)) for _ in CHANNELS]
            for k, channel in enumerate(CHANNELS):
                declared: Irregularities | None = getattr(self, channel)
                if declared is not None:
                    found[k] = declared.realise(seed if k == 0 else (*seed, k), channel).over(s)
        grown, growth = np.array([_grown(place, settling) for place in s]).T
        return tuple(np.stack((grown * y, grown * rise + growth * y)) for y, rise in found)

    def friction_at(self, s: Array) -> tuple[Array, Array]:
        """Return the factors on the coefficient of friction of the right and the left rail."""
        if self.friction is None:
            return np.ones(s.size), np.ones(s.size)
        right, left = (np.interp(s, self.friction.at, each) for each in (self.friction.right, self.friction.left))
        return right, left


def _grown(s: float, over: float) -> tuple[float, float]:
    """Return a smooth step from 0 to 1 over `over` metres, and its slope [1/m]."""
    if over <= 0.0 or s >= over:
        return 1.0, 0.0
    t = max(s / over, 0.0)
    return t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / over


def require_forwards(name: str, speed: float) -> None:
    """Check the speed [m/s] of a scenario.

    Raises
    ------
    ContactError
        If it is outside its range. Where it is not above 0 the message says what rolls back.
    """
    try:
        require_number(name, speed, SLOWEST, FASTEST)
    except ContactError as error:
        if not speed <= 0.0:
            raise
        raise ContactError(
            f"{error}: a scenario runs forwards; `Simulation` and the FMU Vehicle stand and roll back"
        ) from None


@dataclass(frozen=True, kw_only=True)
class Speed:
    """Speed over the distance, interpolated linearly.

    Parameters
    ----------
    at : distances [m], increasing
    values : speeds at these distances [m/s], 0.1 to 150; constant before the first and after the last
    """

    at: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.at) != len(self.values) or not self.at:
            raise ContactError(
                f"at has {len(self.at)} distances and values {len(self.values)} speeds; equally many are needed"
            )
        for k, place in enumerate(self.at):
            require_number(f"at[{k}]", place, self.at[k - 1] if k else -math.inf, open_minimum=k > 0)
        for k, value in enumerate(self.values):
            require_forwards(f"values[{k}]", value)

    def __call__(self, s: float) -> float:
        return float(np.interp(s, self.at, self.values))
