"""A run of a scenario with a vehicle: steps, time series, damage and the balance of energy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from contact.accumulation import Histogram
from contact.arrays import Array
from contact.errors import ContactError
from contact.geometry.profile import Profile
from ..vehicle import linear
from ..vehicle.course import SPACING
from ..vehicle.declared import SIDES, VehicleDeclaration
from ..vehicle.duration import doubt_duration
from ..vehicle.kernels.layout import Book, Sum
from ..vehicle.kernels.motion import spin_rate
from ..vehicle.ledgers import BODIES, fill, ledger
from . import simulated
from .notebook import of_run
from .scenario import Scenario
from .series import columns, sample
from .stability import Stability
from .trust import StepError, Trust

#: Energies of a run → meaning.
BALANCE = {
    "drive": "delivered by what keeps the speed",
    "weight": "delivered by gravity",
    "torque": "delivered by torques on axles",
    "damper": "spent in dampers and under the rails",
    "dissipated": "spent in the contacts: creep forces times creepages",
    "stored": "stored since the second step: kinetic, elastic, in the contacts (2/5 load times approach)",
    "residual": "what the integration has lost",
    "counted": "spent in the contacts where damage was counted",
}
#: Largest factor by which a small motion may grow in a step: more than any motion of a vehicle grows.
_LARGEST_AMPLIFICATION = 1.02
_CREEPAGE = "_longitudinal_creepage"
_LONGEST_STEP, _SHORTEST_STEP = 5e-4, 5e-5  # [s]
#: The error of the step is estimated as far as this beyond the settling and the beginning of the first circle [m].
_PIECE = 40.0
#: Rounding of a distance that is a sum of steps [m].
_ROUND = 1e-6
#: Longest step with flats, polygons, slices and closely measured tracks [s]: the peak of an impact is then within 1.7 % of
#: that of half the step.
_LONGEST_UNEVEN = 1e-4


class VehicleRun:
    """A run of a scenario with a vehicle. `save` and `restore` are exact.

    Parameters
    ----------
    scenario : Scenario
    threads : int
        Threads that share the contacts, at most one for each wheel. No bit of the result depends on it.

    Attributes
    ----------
    scenario : Scenario
    simulation : Simulation
    histograms : dict
        (wheelset, side, "wheel" or "rail") → Histogram; wheelsets by their names. Uneven wheels and the rails under them have
        none.
    steps : int
        Number of steps so far.
    step : float
        [s].
    energy : float
        Frictional energy of all wheels where damage was counted [J].

    Raises
    ------
    ContactError
        If the step is too long for a stable integration.
    """

    def __init__(self, scenario: Scenario, threads: int = 1) -> None:
        d, vehicle = scenario.declared, scenario.vehicle
        self.scenario = scenario
        uneven = self._uneven = scenario.uneven
        rails: dict[str, Profile] = dict(zip(SIDES, scenario.rails, strict=True))
        histograms = {
            (name, side, body): Histogram(
                wheel if body == "wheel" else rails[side],
                width=d.recording.bins,
                parameters=d.damage,
                **({"radius": vehicle.radius} if body == "wheel" else {}),
            )
            for (name, side), wheel in zip(scenario.wheel_names, scenario.wheels, strict=True)
            for body in BODIES
        }
        # wheels share the scratch memory of their ledgers, so uneven ones have one too, which stays empty
        ledgers = tuple(
            ledger(histograms[name, side, "wheel"], histograms[name, side, "rail"], d.methods.strips)
            for name, side in scenario.wheel_names
        )
        self.histograms = {key: each for key, each in histograms.items() if key[:2] not in self.without_damage}
        track = simulated.track(scenario)
        ahead = max(axle.at for axle in vehicle.wheelsets) + 1.0  # all axles start before the irregularities
        surfaces: dict[str, Any] = {"uneven": uneven, "sections": scenario.sections}
        self.simulation = simulated.simulation(
            scenario, track, ledgers=ledgers, start=-ahead, threads=threads, **surfaces
        )
        impacts = any(surfaces.values()) or d.track.resolution < SPACING
        longest = _LONGEST_UNEVEN if impacts else _LONGEST_STEP
        self.step = d.recording.step or min(longest, 0.7 * self._stable(vehicle))
        factor = self._growth()
        while factor > _LARGEST_AMPLIFICATION and not d.recording.step and self.step > _SHORTEST_STEP:
            self.step *= 0.7  # worn profiles have larger patches, which are stiffer
            factor = self._growth()
        if factor > _LARGEST_AMPLIFICATION:
            raise ContactError(
                f"recording.step = {self.step:g} s is too long at {scenario.slowest:g} m/s: a small motion grows {factor:.3g} "
                f"times in a step; {_LARGEST_AMPLIFICATION:g} times are allowed"
            )
        doubt_duration(scenario.name, track, (self.distance, d.length), self.step, 2 * len(vehicle.wheelsets))
        self.energy, self._distance = 0.0, 0.0
        circles = [curve.start + curve.transition for curve in d.track.curves]
        self._piece = min(d.length, max(d.recording.settling, min(circles, default=0.0)) + _PIECE)
        self._at_piece = np.zeros(2)  # energy and worn volume over the distance that is counted there [J/m], [m³/m]
        self._before = self.simulation.state.u.copy()
        self._rows: list[Array] = []

    def _stable(self, vehicle: VehicleDeclaration) -> float:
        """Return an estimate of the longest stable step [s]: that of the spin of the axles, I V/(f r²) at the slowest speed."""
        model = self.simulation.model
        return min(1.0 / spin_rate(model.bodies[i], vehicle.radius, self.scenario.slowest) for i in model.wheelsets)

    def _growth(self) -> float:
        """Return the largest factor by which a small motion grows in a step."""
        return linear.amplification(simulated.on_straight(self.scenario, self.scenario.slowest), self.step)

    @cached_property
    def stability(self) -> Stability:
        """Modes, conicities and critical speeds, found when they are read."""
        return Stability(self.scenario, self.step)

    @property
    def steps(self) -> int:
        return int(self.simulation.state.books[Book.STEPS])

    @property
    def distance(self) -> float:
        """Distance so far [m]."""
        return self.simulation.distance

    @property
    def done(self) -> bool:
        """True if the whole length has been run."""
        return self.distance >= self.scenario.declared.length - _ROUND

    @property
    def share(self) -> float:
        """Share of the length that has been run, 0 to 1."""
        return min(max(self.distance / self.scenario.declared.length, 0.0), 1.0)

    def advance(self) -> None:
        """Advance by one sample: as many steps as fit in its spacing. Damage is counted at every solution of a contact.

        Raises
        ------
        ContactError
            If a wheel leaves its rail. The message contains the place.
        """
        simulation, h, settings = self.simulation, self.step, self.simulation.wheel_arrays.settings
        speed, had_piece = self.scenario.speed(self.distance), self._has_piece
        many = max(round(self.scenario.declared.recording.spacing / (speed * h)), 1)
        counts = self.distance >= self.scenario.declared.recording.settling - _ROUND
        settings["distance"] = h * speed if counts else 0.0
        self._set_torques(0.5 * many * h * speed)
        try:
            simulation.advance(h, many)
        except ContactError as error:
            raise ContactError(f"{self.scenario.name}, {speed:g} m/s: {error}") from None
        if counts:
            self._distance += many * h * speed
            on_profiles = ~simulation.on_surfaces
            self.energy += h * speed * float(simulation.state.sums[on_profiles, Sum.DISSIPATION].sum())
        self._sample(many * h)
        if self._has_piece and not had_piece and self._distance > 0.0:
            volume = sum(histogram.volume for histogram in self.damage().values())
            self._at_piece[:] = self.energy / self._distance, volume / self._distance

    def _set_torques(self, ahead: float) -> None:
        """Set the torques of the axles to those of the middle of this sample, which is `ahead` [m] of the vehicle."""
        given = self.scenario.declared.torque
        if given:
            bodies = self.simulation.model.bodies
            distance, time = self.distance + ahead, self.simulation.time + ahead / self.scenario.speed(self.distance)
            for axle, i in zip(self.scenario.vehicle.wheelsets, self.simulation.model.wheelsets, strict=True):
                added = sum(torque.on(axle.name, distance + axle.at, time) for torque in given)
                bodies[i]["torque"] = axle.torque + added

    def _sample(self, elapsed: float) -> None:
        """Add a row to the time series and clear the sums."""
        self._rows.append(np.array(sample(self.simulation, self._before, elapsed)))
        self.simulation.state.sums[:] = 0.0
        self._before[:] = self.simulation.state.u

    def _repr_html_(self) -> str:
        """Return HTML for a notebook: how far the run is, the largest forces, and a sketch of Y and Q of the first axle."""
        return of_run(self)

    @property
    def columns(self) -> dict[str, tuple[str, str]]:
        """Column of the time series → unit and meaning. Blanks in names of bodies are underscores."""
        return columns(self.simulation)

    @property
    def series(self) -> dict[str, Array]:
        """The time series, a column each of `columns`."""
        columns = self.columns
        rows = np.array(self._rows).reshape(-1, len(columns))
        return {name: rows[:, k] for k, name in enumerate(columns)}

    @property
    def balance(self) -> dict[str, float]:
        """Energies of the whole run [J], with the names of `BALANCE`."""
        books = self.simulation.state.books
        of_books = {name: float(books[Book[name.upper()]]) for name in BALANCE if name != "counted"}
        return of_books | {"stored": of_books["stored"] - float(books[Book.STORED_FIRST]), "counted": self.energy}

    @property
    def trust(self) -> Trust:
        """Measures of trust of the run: energy balance, impacts, doubtful contacts."""
        books, declared = self.simulation.state.books, self.scenario.declared
        dissipated = float(books[Book.DISSIPATED])
        return Trust(
            residual=float(books[Book.RESIDUAL]) / dissipated if dissipated > 0.0 else 0.0,
            impacts=float(books[Book.IMPACTS]),
            lifted=float(books[Book.LIFTED]),
            untrusted=float(books[Book.UNTRUSTED]),
            creepage=max(
                (float(np.abs(row).max(initial=0.0)) for name, row in self.series.items() if name.endswith(_CREEPAGE)),
                default=0.0,
            ),
            speed_ratio=self.scenario.fastest / self.stability.critical_speed,
            unfinished=float(sum(curve.end > declared.length for curve in declared.track.curves)),
            deepest_rate=max(
                (
                    float(h.depth.max()) / h.distance
                    for (*_, body), h in self.damage().items()
                    if body == "wheel" and h.distance > 0.0
                ),
                default=0.0,
            ),
            seizure=self._seizure,
            untrusted_share=float(books[Book.UNTRUSTED]) / max(self.steps * len(self.simulation.wheels), 1),
            wear_law=declared.damage.wear_law,
        )

    @property
    def _seizure(self) -> float:
        """Share of the samples at which the pressure of the worst wheel is in Archard's seizure; 0 with other laws."""
        damage, steel = self.scenario.declared.damage, self.scenario.declared.methods.material
        counted = self.series["distance"] >= self.scenario.declared.recording.settling
        if damage.wear_law != "archard" or not counted.any():
            return 0.0
        pressures = [row[counted] for name, row in self.series.items() if name.endswith("_max_pressure")]
        return float(max((row > damage.archard.seizure_ratio * steel.hardness).mean() for row in pressures))

    @cached_property
    def step_error(self) -> StepError:
        """The error of the step: twice the difference from half the step over the first metres, which are run once more."""
        half = replace(self.scenario.declared.recording, step=0.5 * self.step)
        other = VehicleRun(replace(self.scenario, declared=replace(self.scenario.declared, recording=half)))
        mine, theirs = (self if self._has_piece else VehicleRun(self.scenario))._over_piece(), other._over_piece()
        energy, volume = (2.0 * (a - b) / b if b > 0.0 else 0.0 for a, b in zip(mine, theirs, strict=True))
        return StepError(float(energy), float(volume), self._piece)

    @property
    def _has_piece(self) -> bool:
        return self.distance >= self._piece - _ROUND

    def _over_piece(self) -> Array:
        """Return `_at_piece`; run as far as that first."""
        while not self._has_piece:
            self.advance()
        return self._at_piece

    @property
    def axle_load(self) -> float:
        """Mean static load of an axle [N]."""
        model = self.simulation.model
        return 2.0 * float(model.bodies["load"][model.wheelsets].mean())

    @property
    def without_damage(self) -> tuple[tuple[str, str], ...]:
        """Wheelset and side of the wheels that are not round. They and the rails under them have no histograms."""
        return tuple(self.scenario.wheel_names[number] for number in self._uneven)

    @property
    def sections_without_damage(self) -> tuple[tuple[str, float, float], ...]:
        """Side, begin and end [m] of the parts of the rails that are given by slices, on which no damage is counted."""
        return tuple((each.side, each.begin, each.end) for each in self.scenario.sections)

    def damage(self) -> dict[tuple[str, str, str], Histogram]:
        """Return `histograms`, filled with the damage so far."""
        simulation, methods = self.simulation, self.scenario.declared.methods
        names = {f"{methods.normal} + {methods.tangential}"}
        for number, (name, side) in enumerate(self.scenario.wheel_names):
            if number not in self._uneven:
                both = self.histograms[name, side, "wheel"], self.histograms[name, side, "rail"]
                fill(both, simulation.wheel_arrays, number, self._distance, names, methods.material)
        return self.histograms

    def save(self) -> dict[str, Array]:
        """Return the whole state of the run as arrays."""
        return {
            **{name: array.copy() for name, array in self.simulation.kept.items()},
            "before": self._before.copy(),
            "progress": np.array([self.energy, self._distance, *self._at_piece]),
            "rows": np.array(self._rows).reshape(-1, len(self.columns)),
        }

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same scenario."""
        for name, array in self.simulation.kept.items():
            array[:] = saved[name]
        self._before[:] = saved["before"]
        self.energy, self._distance, *piece = saved["progress"].tolist()
        self._at_piece[:] = piece
        self._rows = list(saved["rows"])
