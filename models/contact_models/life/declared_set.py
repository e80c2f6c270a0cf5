"""A set of scenarios for a wear run over a mileage, read from one TOML file."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass, field
from importlib.metadata import version
from os import PathLike
from pathlib import Path

import numpy as np

from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.inputs.material import STEEL
from contact.reading.text import toml
from ..runs import scenario
from ..runs.origin import hashed
from ..runs.scenario import Scenario
from ..toml import build
from .flange import Flange

_GRAVITY = 9.81  # [m/s²]
#: A study in which the depth allows less than this share of the wished step stops.
LEAST_SHARE = 0.01
#: Which wheels wear alike → how many parts of (wheelset, side) tell them apart.
ALIKE = {"none": 2, "sides": 1, "all": 0}
#: Limit of the pressure in wear [Pa]: full indentation at 5 k (recalled, constants.md 10). Elastic pressures of new profiles
#: exceed 2.16 GPa in flange roots, where Archard's map has seizure; steel yields before.
PRESSURE_LIMIT = 5.0 * STEEL.shear_yield


@dataclass(frozen=True, kw_only=True)
class Share:
    """One scenario of the set.

    Parameters
    ----------
    file : file of the scenario, relative to the set's file
    weight : its share of the mileage of the vehicle; 0 is other traffic, whose wheels do not wear
    tonnes_per_year : gross tonnes that pass over its rails in this manner in a year; 0: its rails do not wear
    rails : name of its rails; scenarios with the same name run on the same ones. Default: rails of its own
    """

    file: str
    weight: float
    tonnes_per_year: float = 0.0
    rails: str = ""

    def __post_init__(self) -> None:
        require_number("weight", self.weight, 0.0)
        require_number("tonnes_per_year", self.tonnes_per_year, 0.0, 1e10)
        if self.weight == 0.0 and self.tonnes_per_year == 0.0:
            raise ContactError("weight = 0 and tonnes_per_year = 0: the scenario would wear nothing")

    @property
    def line(self) -> str:
        """Name of the rails."""
        return self.rails or Path(self.file).stem


@dataclass(frozen=True, kw_only=True)
class Steps:
    """Limits of a wear step, after which the scenarios run again on the changed profile.

    Parameters
    ----------
    distance : largest distance of one step [m], 1e3 to 1e9
    depth : largest smoothed wear depth of one step [m], 1e-7 to 1e-3; the default by docs/understand/wear.md, Steps
    smoothing : standard deviation of the Gaussian that smooths the depth of a step [m], 5e-4 to 0.02
    """

    distance: float = 1e7
    depth: float = 1e-4
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
                f"steps.depth = {1e6 * self.depth:g} µm allows {1e-3 * length:.3g} km, below {100.0 * LEAST_SHARE:g} % of it. "
                "Cures: a larger steps.depth, a smaller steps.distance, or lower coefficients in damage.archard (those of the "
                "default are for dry steel)"
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
    limits : dimensions of the flange at which a wheel is worn out, see `contact_models.life.flange`
    reprofile : whether all wheels are then restored by the greatest cut that one of them needs; otherwise the run ends
    alike : which wheels wear alike, by their mean: "none"; "sides", the two of an axle, on a line with as many curves to
        either side; "all", in a vehicle that is turned and whose axles change places.
    mileage_per_year : mileage of the vehicle in a year [m]; needed if scenarios have tonnes_per_year
    pressure_limit : limit of the pressure in scenarios that give none [Pa], default 5 k (full indentation); inf: elastic
    amplitudes : amplitudes of the equivalent conicity in the results [m]
    """

    name: str
    mileage: float
    scenarios: tuple[Share, ...]
    steps: Steps = field(default_factory=Steps)
    limits: Flange = field(default_factory=Flange.limits)
    reprofile: bool = False
    alike: str = "none"
    mileage_per_year: float | None = None
    pressure_limit: float = PRESSURE_LIMIT
    amplitudes: tuple[float, ...] = (1e-3, 2e-3, 3e-3, 4e-3, 5e-3)

    def __post_init__(self) -> None:
        require_number("mileage", self.mileage, 0.0, 1e10, open_minimum=True)
        if not self.scenarios:
            raise ContactError("scenarios is empty; at least one is needed")
        if not any(share.weight > 0.0 for share in self.scenarios):
            raise ContactError("scenarios: none of them has a weight above 0")
        if self.alike not in ALIKE:
            raise ContactError(f"alike = {self.alike!r} is none of {', '.join(ALIKE)}")
        if self.mileage_per_year is not None:
            require_number("mileage_per_year", self.mileage_per_year, 0.0, 1e10, open_minimum=True)
        elif any(share.tonnes_per_year > 0.0 for share in self.scenarios):
            raise ContactError("mileage_per_year is missing; tonnes_per_year needs it")
        if self.pressure_limit != math.inf:
            require_number("pressure_limit", self.pressure_limit, 1e8, 1e11)
        for k, value in enumerate(self.amplitudes):
            require_number(f"amplitudes[{k}]", value, 1e-4, 0.02)


@dataclass(frozen=True)
class ScenarioSet:
    """A declaration with its scenarios, and name and SHA-256 of its file. Those with a weight share wheel and vehicle."""

    declared: Declaration
    scenarios: tuple[Scenario, ...]
    file: tuple[tuple[str, str], ...] = ()

    @property
    def name(self) -> str:
        return self.declared.name

    @property
    def files(self) -> tuple[tuple[str, str], ...]:
        """Name and SHA-256 of the files of the set and of its scenarios."""
        return (*self.file, *(each for one in self.scenarios for each in one.files))

    @property
    def first(self) -> Scenario:
        """The first scenario of the vehicle that wears."""
        return self.scenarios[self.first_number]

    @property
    def first_number(self) -> int:
        """Number of that scenario."""
        return next(k for k, weight in enumerate(self.weights) if weight > 0.0)

    @property
    def wheel(self) -> Profile:
        """The unworn wheel."""
        return self.first.wheel

    def group(self, wheel: tuple[str, str]) -> tuple[str, ...]:
        """Return what tells a wheel, (wheelset, side), from those that do not wear alike."""
        return wheel[: ALIKE[self.declared.alike]]

    @property
    def groups(self) -> tuple[tuple[str, ...], ...]:
        """The groups of wheels that wear alike, in the order of the wheels."""
        return tuple(dict.fromkeys(self.group(wheel) for wheel in self.first.wheel_names))

    def passes(self, number: int, axle_load: float) -> float:
        """Return the axle passes over the rails of a scenario for each metre of mileage [1/m]. `axle_load` is in N."""
        tonnes, mileage = self.declared.scenarios[number].tonnes_per_year, self.declared.mileage_per_year
        return tonnes / mileage * 1e3 * _GRAVITY / axle_load if mileage else 0.0

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
        As `scenario.read`, and if scenarios that share wheels or rails differ in what describes them.
    """
    path = Path(path)
    declared = build(Declaration, toml(path), path.name)
    scenarios = tuple(
        scenario.read(path.parent / share.file).limited(declared.pressure_limit) for share in declared.scenarios
    )
    for share, one in zip(declared.scenarios, scenarios, strict=True):
        one.require_profiles(f"{path.name}: {share.file}", "a study of wear takes")
    found = ScenarioSet(declared, scenarios, hashed([path]))
    lines: dict[str, tuple[Share, Scenario]] = {}
    first = (declared.scenarios[found.first_number], found.first)
    for share, other in zip(declared.scenarios, scenarios, strict=True):
        if share.weight > 0.0:
            _require_same(path.name, "wheel", (share, other), first)
        _require_same(path.name, "rail", (share, other), lines.setdefault(share.line, (share, other)))
    return found


def _require_same(path: str, body: str, one: tuple[Share, Scenario], other: tuple[Share, Scenario]) -> None:
    """Raise a ContactError unless two scenarios can wear the same body, "wheel" or "rail"."""
    a, b = one[1], other[1]
    mine, theirs = ((a.wheel,), (b.wheel,)) if body == "wheel" else (a.rails, b.rails)
    same = all(np.array_equal(p.y, q.y) and np.array_equal(p.z, q.z) for p, q in zip(mine, theirs, strict=True))
    alike = _bookkeeping(a) == _bookkeeping(b)
    if not same or not alike or (body == "wheel" and a.wheel_names != b.wheel_names):
        raise ContactError(f"{path}: {one[0].file} has another {body}, radius, bins or damage than {other[0].file}")


def _bookkeeping(given: Scenario) -> tuple[object, ...]:
    """Return what histograms must have in common to be added up."""
    return given.radius, given.declared.recording.bins, given.declared.damage
