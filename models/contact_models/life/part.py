"""A wheel or a rail in a wear study: its profile at the end of each step, and what has been worn off it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import reduce
from operator import add
from typing import ClassVar

import numpy as np

from contact.accumulation import Histogram, worn_profile
from contact.arrays import Array
from contact.geometry.profile import Profile
from .flange import Flange

DENSITY = 7850.0  # density of steel [kg/m³]
_LONG = 1e6  # mileage from which a rate is computed [m]: the depth is then well above the round-off of the coordinates
_STEP = {
    "deepest": ("m", "greatest smoothed depth worn off in the step"),
    "area": ("m2", "cross-section worn off in the step, before smoothing"),
    "area_smoothed": ("m2", "the same after smoothing, between the profiles before and after"),
}


class Part(ABC):
    """A wheel or a rail.

    The damage that it is given in a step are histograms, one for each scenario that wears it. Their `distance` is the share
    of the mileage (of a wheel), or the number of axle passes for each metre of mileage (of a rail).

    Attributes
    ----------
    name : str
    profiles : list of Profile
        The unworn profile, and that at the end of each step.
    present : Profile
        The profile with which the next step begins: the last one, or a restored one.
    rows : list of ndarray
        One row for each profile, in the order of `columns`.
    shares : ndarray, shape (scenarios, points)
        Smoothed depth that each scenario has worn off at each point of the profile [m].
    """

    #: Column of the rows → unit and meaning. Dimensions are those at the end of a step.
    columns: ClassVar[dict[str, tuple[str, str]]]

    def __init__(self, name: str, profile: Profile, scenarios: int) -> None:
        self.name = name
        self.profiles, self.present = [profile], profile
        self.shares = np.zeros((scenarios, profile.y.size))
        self.rows = [self._row(self._measured(None, 0.0))]

    @abstractmethod
    def _times(self, total: Histogram, length: float) -> float:
        """Return the factor on the depth of a histogram after `length` [m] of mileage."""

    @abstractmethod
    def _measured(self, total: Histogram | None, length: float) -> dict[str, float]:
        """Return what is special about this kind, with the profile at the end of the step."""

    @property
    def new(self) -> Profile:
        """The unworn profile."""
        return self.profiles[0]

    @property
    def last(self) -> Profile:
        """The profile at the end of the last step."""
        return self.profiles[-1]

    def __getitem__(self, column: str) -> Array:
        return np.array(self.rows)[:, list(self.columns).index(column)]

    def rate(self, damage: Mapping[int, Histogram], smoothing: float) -> float:
        """Return the greatest smoothed depth per metre of mileage [-] under the damage of each scenario, by its number."""
        if not damage:
            return 0.0
        total = reduce(add, damage.values())
        worn = worn_profile(total, self._times(total, _LONG), smoothing=smoothing)
        return float(displacement(self.present, worn).max()) / _LONG

    def wear(self, damage: Mapping[int, Histogram], length: float, smoothing: float) -> None:
        """Wear the profile by `length` [m] of mileage under this damage."""
        before, booked = self.present, dict.fromkeys(_STEP, 0.0)
        total = reduce(add, damage.values()) if damage else None
        if total is not None:
            times = self._times(total, length)
            worn = worn_profile(total, times, smoothing=smoothing)
            self.present = Profile(before.kind, worn.y, worn.z, worn.angle, self.new.name)
            for k, histogram in damage.items():
                alone = worn_profile(histogram, self._times(histogram, length), smoothing=smoothing)
                self.shares[k] += displacement(before, alone)
            booked = {
                "deepest": float(displacement(before, self.present).max()),
                "area": times * float(total.depth.sum()) * total.width,
                "area_smoothed": _area_between(before, self.present),
            }
        self.profiles.append(self.present)
        self.rows.append(self._row(booked | self._measured(total, length)))

    def restore_profile(self) -> None:
        """Begin the next step with the unworn profile."""
        self.present = self.new

    def _row(self, booked: dict[str, float]) -> Array:
        return np.array([booked.get(name, 0.0) for name in self.columns])

    def save(self) -> dict[str, Array]:
        """Return the whole state as arrays."""
        stacked = [(p.y, p.z, p.angle) for p in (*self.profiles, self.present)]
        return {"profiles": np.array(stacked), "rows": np.array(self.rows), "shares": self.shares.copy()}

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same part."""
        kind, name = self.new.kind, self.new.name
        restored = [Profile(kind, y, z, angle, name) for y, z, angle in saved["profiles"][1:]]
        self.profiles, self.present = [self.new, *restored[:-1]], restored[-1]
        self.rows = list(saved["rows"])
        self.shares[:] = saved["shares"]


class Wheel(Part):
    """A wheel, or several that wear alike."""

    columns: ClassVar = _STEP | {
        "mass": ("kg", "mass worn off in the step"),
        "flange_height": ("m", "Sh"),
        "flange_thickness": ("m", "Sd"),
        "qR": ("m", "qR"),
        "tread_depth": ("m", "depth worn off at the tape circle, from the unworn profile"),
        "T_gamma": ("N", "mean T-gamma over the mileage of the step"),
    }

    def _times(self, total: Histogram, length: float) -> float:
        return length

    def _measured(self, total: Histogram | None, length: float) -> dict[str, float]:
        size = self.flange
        return {
            "mass": DENSITY * length * total.volume if total is not None else 0.0,
            "flange_height": size.height,
            "flange_thickness": size.thickness,
            "qR": size.qR,
            "tread_depth": float(np.interp(0.0, self.new.y, displacement(self.new, self.last))),
            "T_gamma": float(total["T_gamma"].sum()) / total.distance if total is not None else 0.0,
        }

    @property
    def flange(self) -> Flange:
        """Dimensions of the flange at the end of the last step."""
        return Flange.measured(self.last)


class Rail(Part):
    """A rail at one place. It keeps the sum of Burstow's index of the passes at each point, which never falls below zero.

    Attributes
    ----------
    fatigue : ndarray, shape (points,)
        [-]; at 1 a crack becomes visible.
    """

    columns: ClassVar = _STEP | {
        "passes": ("1", "axle passes in the step"),
        "top_depth": ("m", "height worn off at the middle of the head since the start"),
        "side_depth": ("m", "greatest lateral displacement of a point since the start"),
        "fatigue": ("1", "greatest sum of Burstow's index of all passes, floored at 0; 1 is a visible crack"),
        "fatigue_rate": ("1", "greatest Burstow index of a million axle passes in the step"),
    }

    def __init__(self, name: str, profile: Profile, scenarios: int) -> None:
        self.fatigue = np.zeros(profile.y.size)
        super().__init__(name, profile, scenarios)

    def _times(self, total: Histogram, length: float) -> float:
        return length * total.distance

    def wear(self, damage: Mapping[int, Histogram], length: float, smoothing: float) -> None:
        """Wear the profile by `length` [m] of mileage under this damage, and add Burstow's index of its passes."""
        if damage:
            total = reduce(add, damage.values())
            grown = np.interp(total.arc, total.centres, total.fatigue) * self._times(total, length)
            self.fatigue = np.maximum(self.fatigue + grown, 0.0)
        super().wear(damage, length, smoothing)

    def _measured(self, total: Histogram | None, length: float) -> dict[str, float]:
        new, last = self.new, self.last
        top = int(np.argmin(np.abs(new.y)))
        return {
            "passes": self._times(total, length) if total is not None else 0.0,
            "top_depth": float(last.z[top] - new.z[top]),
            "side_depth": float(np.abs(last.y - new.y).max()),
            "fatigue": float(self.fatigue.max()),
            "fatigue_rate": 1e6 * max(float(total.fatigue.max()), 0.0) if total is not None else 0.0,
        }

    def save(self) -> dict[str, Array]:
        """Return the whole state as arrays."""
        return super().save() | {"fatigue": self.fatigue.copy()}

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same rail."""
        super().restore(saved)
        self.fatigue = saved["fatigue"].copy()


def displacement(before: Profile, after: Profile) -> Array:
    """Return the displacement of each point [m]."""
    return np.hypot(after.y - before.y, after.z - before.z)


def _area_between(before: Profile, after: Profile) -> float:
    """Return the area between two profiles [m²] by the shoelace formula. Their ends must coincide, at least nearly."""
    y, z = (np.concatenate((a, b[::-1])) for a, b in ((before.y, after.y), (before.z, after.z)))
    return abs(0.5 * float(np.dot(y, np.roll(z, -1)) - np.dot(z, np.roll(y, -1))))
