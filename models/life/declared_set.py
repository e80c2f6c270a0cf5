"""A set of scenarios for a wear run over a mileage, read from one TOML file."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from importlib.metadata import version
from os import PathLike
from pathlib import Path

import numpy as np

from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from models.life import scenario
from models.life.declared import build, read_table
from models.life.flange import Flange
from models.life.scenario import Scenario

#: A study in which the depth allows less than this share of the wished step stops.
LEAST_SHARE = 0.01


@dataclass(frozen=True, kw_only=True)
class Share:
    """One scenario of the set: its file, relative to the set's file, and its weight > 0, its share of the mileage."""

    file: str
    weight: float

    def __post_init__(self) -> None:
        require_number("weight", self.weight, 0.0, open_minimum=True)


@dataclass(frozen=True, kw_only=True)
class Steps:
    """Limits of a wear step, after which the scenarios run again on the changed profile.

    Parameters
    ----------
    distance : largest distance of one step [m], 1e3 to 1e9
    depth : largest smoothed wear depth of one step [m], 1e-7 to 1e-3
    smoothing : standard deviation of the Gaussian that smooths the depth of a step [m], 5e-4 to 0.02
    """

    distance: float = 1e7
    depth: float = 5e-5
    smoothing: float = 2e-3

    def __post_init__(self) -> None:
        require_number("distance", self.distance, 1e3, 1e9)
        require_number("depth", self.depth, 1e-7, 1e-3)
        require_number("smoothing", self.smoothing, 5e-4, 0.02)

    def length(self, rate: float, left: float) -> float:
        """Return the mileage of a step [m] for a smoothed wear `rate` [m/m] and the remaining mileage `left` [m].

        Raises
        ------
        ContactError
            If the depth allows less than `LEAST_SHARE` of the wished step.
        """
        allowed = min(self.distance, left)
        length = min(allowed, self.depth / rate) if rate * allowed > self.depth else allowed
        if length < LEAST_SHARE * allowed:
            raise ContactError(
                f"a step of {1e-3 * allowed:g} km would wear off {1e6 * rate * allowed:.3g} µm at the deepest place. "
                f"steps.depth = {1e6 * self.depth:g} µm allows {1e-3 * length:.3g} km, below {100.0 * LEAST_SHARE:g} % of it"
            )
        return length


@dataclass(frozen=True, kw_only=True)
class Declaration:
    """A set as declared in its file.

    Parameters
    ----------
    name : name for titles
    mileage : mileage at which the wear run ends [m], positive
    scenarios : scenarios with their weights, at least one
    steps : see `Steps`
    limits : dimensions of the flange at which the wear run ends too, see `models.life.flange`
    amplitudes : amplitudes of the equivalent conicity in the results [m]
    """

    name: str
    mileage: float
    scenarios: tuple[Share, ...]
    steps: Steps = field(default_factory=Steps)
    limits: Flange = field(default_factory=Flange.limits)
    amplitudes: tuple[float, ...] = (1e-3, 2e-3, 3e-3, 4e-3, 5e-3)

    def __post_init__(self) -> None:
        require_number("mileage", self.mileage, 0.0, 1e10, open_minimum=True)
        if not self.scenarios:
            raise ContactError("scenarios is empty; at least one is needed")
        for k, value in enumerate(self.amplitudes):
            require_number(f"amplitudes[{k}]", value, 1e-4, 0.02)


@dataclass(frozen=True)
class ScenarioSet:
    """A declaration with its scenarios, which share one wheel."""

    declared: Declaration
    scenarios: tuple[Scenario, ...]

    @property
    def name(self) -> str:
        return self.declared.name

    @property
    def wheel(self) -> Profile:
        """The unworn wheel."""
        return self.scenarios[0].wheel

    @property
    def weights(self) -> tuple[float, ...]:
        """Shares of the mileage, with the sum 1."""
        given = [share.weight for share in self.declared.scenarios]
        return tuple(weight / sum(given) for weight in given)

    @property
    def fingerprint(self) -> str:
        """Hash of the input. Sets with the same fingerprint have the same result."""
        parts = (version("wheelrail-contact"), repr(self.declared), *(each.fingerprint for each in self.scenarios))
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]


def read(path: str | PathLike[str]) -> ScenarioSet:
    """Return the set in a TOML file, with the scenarios of the files that it names.

    Raises
    ------
    ContactError
        As `scenario.read`, and if the scenarios differ in wheel, radius, bins or damage parameters.
    """
    path = Path(path)
    declared = build(Declaration, read_table(path), path.name)
    scenarios = tuple(scenario.read(path.parent / share.file) for share in declared.scenarios)
    first = scenarios[0]
    for share, other in zip(declared.scenarios, scenarios, strict=True):
        same = np.array_equal(first.wheel.y, other.wheel.y) and np.array_equal(first.wheel.z, other.wheel.z)
        if not same or (first.radius, first.declared.recording.bins, first.declared.damage) != (
            other.radius,
            other.declared.recording.bins,
            other.declared.damage,
        ):
            raise ContactError(
                f"{path.name}: {share.file} has another wheel, radius, bins or damage than {declared.scenarios[0].file}"
            )
    return ScenarioSet(declared, scenarios)
