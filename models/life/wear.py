"""Wear over a mileage: run the scenarios, change the profile, and repeat."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from operator import add
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.accumulation import Histogram, worn_profile
from contact.errors import ContactError
from contact.geometry import conicity
from contact.geometry.profile import Profile
from models.life.declared_set import ScenarioSet
from models.life.flange import Flange
from models.life.scale import Workers
from models.life.scenario import Scenario
from models.life.start import start
from models.life.trust import TRUST, Trust, worst

Array = NDArray[np.float64]

DENSITY = 7850.0  # density of steel [kg/m³]
#: Column of the steps → unit and meaning. Flange dimensions are those at the end of a step. The first row is the unworn wheel.
COLUMNS = {
    "mileage": ("m", "mileage at the end of the step"),
    "deepest": ("m", "greatest smoothed depth worn off in the step"),
    "area": ("m2", "cross-section worn off in the step, before smoothing"),
    "area_smoothed": ("m2", "the same after smoothing, between the profiles before and after"),
    "mass": ("kg", "mass worn off a wheel in the step"),
    "energy": ("J", "frictional energy of a wheel in the step"),
    "flange_height": ("m", "Sh"),
    "flange_thickness": ("m", "Sd"),
    "qR": ("m", "qR"),
    "tread_depth": ("m", "depth worn off at the tape circle since the start"),
    **{name: (unit, f"{what}: worst of the runs, or sum") for name, (unit, what) in TRUST.items()},
}


class Worn(NamedTuple):
    """What a run has done to its wheels: the sum of their histograms, their frictional energy [J], and how far to trust it."""

    wheels: Histogram
    energy: float
    trust: Trust


def harvest(scenario: Scenario) -> Worn:
    """Run a scenario and return the damage of all its wheels together."""
    run = start(scenario)
    while not run.done:
        run.advance()
    wheels = reduce(add, (each for key, each in run.damage().items() if key[-1] == "wheel"))
    return Worn(wheels, run.energy, run.trust)


class Life:
    """Wear of a wheel under a set of scenarios.

    All wheels have the same wear, the mean over the wheels of the runs. This corresponds to as many curves to the right as to
    the left, and to a vehicle that is turned now and then. The rails do not wear. Each step has its own realisation of the
    irregularities.

    Attributes
    ----------
    plan : ScenarioSet
    wheels : list of Profile
        The unworn wheel, and the wheel at the end of each step.
    rows : list of ndarray
        One row for each of the wheels, in the order of `COLUMNS`.
    shares : ndarray, shape (scenarios, points)
        Smoothed depth that each scenario has worn off at each point of the profile [m].
    conicities : list of ndarray
        Equivalent conicity at the amplitudes of the plan, of each profile on the rail of the first scenario.
    """

    def __init__(self, plan: ScenarioSet) -> None:
        self.plan = plan
        self.wheels = [plan.wheel]
        self.shares = np.zeros((len(plan.scenarios), plan.wheel.y.size))
        self.rows = [self._row(0.0, {}, plan.wheel)]
        self.conicities = [self._conicity(plan.wheel)]

    @property
    def wheel(self) -> Profile:
        """The present wheel."""
        return self.wheels[-1]

    @property
    def mileage(self) -> float:
        """Mileage so far [m]."""
        return float(self.rows[-1][0])

    def __getitem__(self, column: str) -> Array:
        return np.array(self.rows)[:, list(COLUMNS).index(column)]

    @property
    def ended(self) -> str:
        """Reason for the end of the wear run: "mileage" or a limit; "" while it has not ended."""
        limit = Flange.measured(self.wheel).exceeded(self.plan.declared.limits)
        if limit:
            return limit
        return "mileage" if self.mileage >= self.plan.declared.mileage else ""

    def step(
        self, workers: Workers, watch: Callable[[int, int], None] = lambda done, total: None, *, go_on: bool = False
    ) -> None:
        """Run all scenarios on the present wheel, and wear it up to the limits of a step (`Steps`).

        Parameters
        ----------
        workers : Workers
        watch : callable
            Called with the number of runs done and the total number.
        go_on : bool
            Wear the profile also if the energy of a run does not close (`models.life.trust`).

        Raises
        ------
        ContactError
            If a run fails, as `Run.advance`, if its energy does not close, if there is no wear, or if the steps become too
            short (`Steps.length`). The wheel is then as before.
        """
        number = len(self.wheels) - 1
        scenarios = [each.worn(self.wheel, number) for each in self.plan.scenarios]
        found = workers.map(harvest, scenarios, watch)
        trusts = [each.trust for each in found]
        trust = worst(trusts)
        if not trust.closes and not go_on:
            which = scenarios[trusts.index(max(trusts, key=lambda each: abs(each.residual)))]
            raise ContactError(f"{self.plan.name}: step {number + 1}, {which.name}: {trust.warnings[0]}")
        per_metre = [
            each.wheels.scaled(weight / each.wheels.distance)
            for each, weight in zip(found, self.plan.weights, strict=True)
        ]
        smoothing = self.plan.declared.steps.smoothing
        total = reduce(add, per_metre)
        rate = float(_depth(self.wheel, worn_profile(total, smoothing=smoothing)).max())
        if rate <= 0.0:
            raise ContactError(f"{self.plan.name}: step {number + 1} has no wear")
        length = self.plan.declared.steps.length(rate, self.plan.declared.mileage - self.mileage)
        worn = worn_profile(total, length, smoothing=smoothing)
        wheel = Profile("wheel", worn.y, worn.z, worn.angle, self.plan.wheel.name)
        for k, histogram in enumerate(per_metre):
            self.shares[k] += _depth(self.wheel, worn_profile(histogram, length, smoothing=smoothing))
        energies = [each.energy / each.wheels.distance for each in found]
        booked = {
            "deepest": length * rate,
            "area": length * float(total["wear"].sum()) * total.width,
            "area_smoothed": _area_between(self.wheel, wheel),
            "mass": DENSITY * length * total.volume,
            "energy": length * float(np.dot(self.plan.weights, energies)),
            **trust.as_dict(),
        }
        self.rows.append(self._row(self.mileage + length, booked, wheel))
        self.wheels.append(wheel)
        self.conicities.append(self._conicity(wheel))

    @property
    def trust(self) -> Trust:
        """How far the runs of all steps can be trusted."""
        return worst([Trust(*(float(row[list(COLUMNS).index(name)]) for name in TRUST)) for row in self.rows])

    def _row(self, mileage: float, booked: dict[str, float], wheel: Profile) -> Array:
        size = Flange.measured(wheel)
        told = {
            "mileage": mileage,
            "flange_height": size.height,
            "flange_thickness": size.thickness,
            "qR": size.qR,
            "tread_depth": float(np.interp(0.0, self.plan.wheel.y, _depth(self.plan.wheel, wheel))),
        }
        return np.array([(booked | told).get(name, 0.0) for name in COLUMNS])

    def _conicity(self, wheel: Profile) -> Array:
        first = self.plan.scenarios[0]
        p = first.vehicle or first.parameters
        found = conicity(
            wheel,
            first.rail,
            self.plan.declared.amplitudes,
            nominal_radius=p.radius,
            gauge=p.gauge,
            flange_back=p.flange_back,
            gauge_point=p.gauge_point,
        )
        return found.conicity

    def save(self) -> dict[str, Array]:
        """Return the whole state as arrays."""
        return {
            "rows": np.array(self.rows),
            "wheels": np.array([(w.y, w.z, w.angle) for w in self.wheels]),
            "shares": self.shares.copy(),
            "conicities": np.array(self.conicities),
        }

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same set."""
        name = self.plan.wheel.name
        self.rows, self.conicities = list(saved["rows"]), list(saved["conicities"])
        self.wheels = [self.plan.wheel, *(Profile("wheel", y, z, angle, name) for y, z, angle in saved["wheels"][1:])]
        self.shares[:] = saved["shares"]


def _depth(before: Profile, after: Profile) -> Array:
    """Return the displacement of each point [m]."""
    return np.hypot(after.y - before.y, after.z - before.z)


def _area_between(before: Profile, after: Profile) -> float:
    """Return the area between two profiles [m²] by the shoelace formula. Their ends must coincide, at least nearly."""
    y, z = (np.concatenate((a, b[::-1])) for a, b in ((before.y, after.y), (before.z, after.z)))
    return abs(0.5 * float(np.dot(y, np.roll(z, -1)) - np.dot(z, np.roll(y, -1))))
