"""Wear over a mileage: run the scenarios, change the profiles, and repeat."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from operator import add

import numpy as np

from contact.accumulation import Histogram
from contact.arrays import Array
from contact.errors import ContactError
from contact.geometry import conicity
from contact.geometry.profile import Profile
from ..runs.outcome import Outcome, outcome
from ..runs.scenario import Scenario
from ..runs.trust import TRUST, NotTrusted, Trust, worst
from ..vehicle.declared import SIDES
from .declared_set import ScenarioSet
from .part import Part, Rail, Wheel
from .reprofiling import cut, forecast
from .scale import Workers

#: Column of the steps → unit and meaning. The first row is the unworn vehicle.
COLUMNS = {
    "mileage": ("m", "mileage at the end of the step"),
    "deepest": ("m", "greatest smoothed depth worn off a wheel or a rail in the step"),
    "mass": ("kg", "mass worn off in the step, mean of all wheels"),
    "energy": ("J", "frictional energy in the step, mean of all wheels"),
    "cut": ("m", "taken off the radius of all wheels at the end of the step to restore their profile"),
    **{name: ("1", f"{measure.meaning}: worst of the runs, or sum") for name, measure in TRUST.items()},
}
#: Amplitudes of the nonlinearity parameter [m].
_NONLINEARITY = (2e-3, 4e-3)


class Life:
    """Wear of a vehicle's wheels, and of the rails of its line, under a set of scenarios.

    Wheels wear by the mean over the scenarios, weighted by their shares of the mileage. Those of a group
    (`ScenarioSet.group`) wear alike, by their mean. The right and the left rail of a line wear by the axle passes of its
    traffic. Each step has its own realisation of the irregularities.

    Attributes
    ----------
    plan : ScenarioSet
    wheels : dict of tuple to Wheel
        Group → wheel.
    rails : dict of (str, str) to Rail
        (line, side) → rail, of lines with traffic.
    rows : list of ndarray
        One row for each step, in the order of `COLUMNS`.
    conicities : list of ndarray, shape (axles, amplitudes + 1)
        Equivalent conicity of each axle at the amplitudes of the plan, and the nonlinearity parameter
        (γe(4 mm) - γe(2 mm))/2 mm [1/m] (EN 15302:2021; the formula is recalled), on the unworn rail of the first scenario.
        nan for an axle whose wheels differ so much that it does not oscillate about the track's centre.
    """

    def __init__(self, plan: ScenarioSet) -> None:
        self.plan = plan
        count = len(plan.scenarios)
        self.wheels = {group: Wheel(" ".join(group) or "all wheels", plan.wheel, count) for group in plan.groups}
        self.rails: dict[tuple[str, str], Rail] = {
            (share.line, side): Rail(f"{share.line} {side}", rail, count)
            for share, scenario in zip(plan.declared.scenarios, plan.scenarios, strict=True)
            if share.tonnes_per_year > 0.0
            for side, rail in zip(SIDES, scenario.rails, strict=True)
        }
        self.rows = [self._row({})]
        self.conicities = [self._conicity()]

    @property
    def parts(self) -> tuple[Part, ...]:
        """All wheels and rails that wear."""
        return (*self.wheels.values(), *self.rails.values())

    @property
    def mileage(self) -> float:
        """Mileage so far [m]."""
        return float(self.rows[-1][0])

    def __getitem__(self, column: str) -> Array:
        return np.array(self.rows)[:, list(COLUMNS).index(column)]

    def tonnes(self, line: str) -> float:
        """Return the gross tonnes that have passed over the rails of a line so far [t]."""
        yearly = sum(share.tonnes_per_year for share in self.plan.declared.scenarios if share.line == line)
        return (
            yearly * self.mileage / self.plan.declared.mileage_per_year if self.plan.declared.mileage_per_year else 0.0
        )

    @property
    def worn_out(self) -> str:
        """Wheels that have reached a limit, with the limit; "" if there are none."""
        reached = {wheel.name: wheel.flange.exceeded(self.plan.declared.limits) for wheel in self.wheels.values()}
        return "; ".join(f"{name}: {limit}" for name, limit in reached.items() if limit)

    @property
    def ended(self) -> str:
        """Reason for the end of the wear run: "mileage" or a limit; "" while it has not ended."""
        if self.worn_out and not self.plan.declared.reprofile:
            return self.worn_out
        return "mileage" if self.mileage >= self.plan.declared.mileage else ""

    @property
    def cut(self) -> float:
        """Reduction of the radius that would restore all wheels now [m]: the greatest that one of them needs."""
        return max(cut(wheel.present, self.plan.wheel) for wheel in self.wheels.values())

    @property
    def turned_off(self) -> float:
        """Reduction of the nominal radius of all wheels by reprofiling so far [m]."""
        return float(self["cut"].sum())

    @property
    def forecast(self) -> tuple[str, str, float] | None:
        """Wheel, limit and mileage [m] of the next reprofiling by the trend of the last steps; None if there is no trend."""
        since = int(np.flatnonzero(self["cut"])[-1]) + 1 if self["cut"].any() else 0
        found = {
            wheel.name: forecast(wheel, self["mileage"][since:], self.plan.declared.limits)
            for wheel in self.wheels.values()
        }
        known = {name: trend for name, trend in found.items() if trend is not None}
        if not known:
            return None
        name = min(known, key=lambda each: known[each][1])
        return name, *known[name]

    def step(
        self, workers: Workers, watch: Callable[[int, int], None] = lambda done, total: None, *, go_on: bool = False
    ) -> None:
        """Run all scenarios on the present profiles, and wear these up to the limits of a step (`Steps`).

        Parameters
        ----------
        workers : Workers
        watch : callable
            Called with the number of runs done and the total number.
        go_on : bool
            Wear the profiles also if a run is not to be trusted (`contact_models.runs.trust`).

        Raises
        ------
        ContactError
            If a run fails, as `VehicleRun.advance`, if its energy does not close, if there is no wear, or if the steps become
            too short (`Steps.length`). The profiles are then as before.
        """
        declared, number = self.plan.declared, len(self.rows) - 1
        found = workers.map(outcome, [self._present(k, number) for k in range(len(self.plan.scenarios))], watch)
        trust = worst([each.trust for each in found])
        if not trust.reliable and not go_on:
            at = max(range(len(found)), key=lambda k: (not found[k].trust.reliable, abs(found[k].trust.residual)))
            raise NotTrusted(
                f"{self.plan.name}: step {number + 1}, {self.plan.scenarios[at].name}: {found[at].trust.warnings[0]}"
            )
        damage = self._damage(found)
        rates = {part.name: part.rate(damage[part.name], declared.steps.smoothing) for part in self.parts}
        fastest = max(rates, key=lambda name: rates[name])
        if rates[fastest] <= 0.0:
            raise ContactError(f"{self.plan.name}: step {number + 1} has no wear")
        try:
            length = declared.steps.length(rates[fastest], declared.mileage - self.mileage)
        except ContactError as error:
            raise ContactError(f"{self.plan.name}: step {number + 1}, {fastest}: {error}") from None
        for part in self.parts:
            part.wear(damage[part.name], length, declared.steps.smoothing)
        members = self.members
        masses = [wheel["mass"][-1] * members[group] for group, wheel in self.wheels.items()]
        powers = [weight * each.energy / _distance(each.wheels.values()) for weight, each in self._weighted(found)]
        booked = {
            "mileage": self.mileage + length,
            "deepest": max(part["deepest"][-1] for part in self.parts),
            "mass": sum(masses) / sum(members.values()),
            "energy": length * sum(powers),
            **trust.as_dict(),
        }
        self.conicities.append(self._conicity())
        if self.worn_out and declared.reprofile:
            booked["cut"] = self.cut
            for wheel in self.wheels.values():
                wheel.restore_profile()
        self.rows.append(self._row(booked))

    def _present(self, k: int, number: int) -> Scenario:
        """Return scenario k on the present profiles. Other traffic keeps its wheels."""
        scenario, share = self.plan.scenarios[k], self.plan.declared.scenarios[k]
        wheels = scenario.wheels
        if share.weight > 0.0:
            wheels = tuple(self.wheels[self.plan.group(name)].present for name in scenario.wheel_names)
        worn = (self.rails.get((share.line, side)) for side in SIDES)
        rails = tuple(given if rail is None else rail.present for rail, given in zip(worn, scenario.rails, strict=True))
        scenario = scenario.reprofiled(self.turned_off) if share.weight > 0.0 else scenario
        return scenario.worn(wheels, rails, number)

    def _weighted(self, found: Iterable[Outcome]) -> list[tuple[float, Outcome]]:
        return [(weight, each) for weight, each in zip(self.plan.weights, found, strict=True) if weight > 0.0]

    def _damage(self, found: list[Outcome]) -> dict[str, dict[int, Histogram]]:
        """Return the damage of each part by each scenario that wears it, as `Part` needs it."""
        damage: dict[str, dict[int, Histogram]] = {part.name: {} for part in self.parts}
        for k, (share, weight, each) in enumerate(
            zip(self.plan.declared.scenarios, self.plan.weights, found, strict=True)
        ):
            for group, wheel in self.wheels.items():
                members = [h for name, h in each.wheels.items() if self.plan.group(name) == group]
                if weight > 0.0:
                    together = reduce(add, members)
                    damage[wheel.name][k] = together.scaled(weight / together.distance)
            for side, histogram in each.rails.items():
                rail, passes = self.rails.get((share.line, side)), self.plan.passes(k, each.axle_load)
                if rail is not None and passes > 0.0:
                    damage[rail.name][k] = histogram.scaled(passes / histogram.distance)
        return damage

    @property
    def members(self) -> dict[tuple[str, ...], int]:
        """Number of wheels of each group."""
        names = [self.plan.group(name) for name in self.plan.first.wheel_names]
        return {group: names.count(group) for group in self.wheels}

    @property
    def trust(self) -> Trust:
        """Measures of trust of the runs of all steps, the worst of each."""
        law = self.plan.scenarios[0].declared.damage.wear_law
        rows = [{name: float(row[list(COLUMNS).index(name)]) for name in TRUST} for row in self.rows]
        return worst([Trust(**row, wear_law=law) for row in rows])

    @staticmethod
    def _row(booked: dict[str, float]) -> Array:
        return np.array([booked.get(name, 0.0) for name in COLUMNS])

    @property
    def axles(self) -> dict[str, tuple[Profile, Profile]]:
        """Name of each axle that differs from the others → its right and left profile at the end of the last step."""
        axles: dict[str, tuple[Profile, Profile]] = {}
        for axle in dict.fromkeys(name for name, _ in self.plan.first.wheel_names):
            right, left = (self.wheels[self.plan.group((axle, side))] for side in SIDES)
            alone = axle if self.plan.group((axle, SIDES[0])) else right.name
            axles[alone] = (right.last, left.last)
        return axles

    def _conicity(self) -> Array:
        first, amplitudes = self.plan.first.reprofiled(self.turned_off), self.plan.declared.amplitudes
        rows = []
        for right, left in self.axles.values():
            try:
                wanted_at = *amplitudes, *_NONLINEARITY
                found = conicity(right, first.rail, wanted_at, left_wheel=left, **first.vehicle.sizes).conicity
            except ContactError:
                rows.append([math.nan] * (len(amplitudes) + 1))
                continue
            *wanted, low, high = found.tolist()
            rows.append([*wanted, (high - low) / (_NONLINEARITY[1] - _NONLINEARITY[0])])
        return np.array(rows)

    def save(self) -> dict[str, Array]:
        """Return the whole state as arrays."""
        parts = {f"{part.name}.{name}": array for part in self.parts for name, array in part.save().items()}
        return {"rows": np.array(self.rows), "conicities": np.array(self.conicities), **parts}

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same set."""
        self.rows, self.conicities = list(saved["rows"]), list(saved["conicities"])
        for part in self.parts:
            prefix = f"{part.name}."
            part.restore({name.removeprefix(prefix): a for name, a in saved.items() if name.startswith(prefix)})


def _distance(histograms: Iterable[Histogram]) -> float:
    """Return the distance that all wheels together have rolled [m]."""
    return sum(histogram.distance for histogram in histograms)
