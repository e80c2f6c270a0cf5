"""A run of a scenario: the wheelset and its two contacts, step by step, with time series, damage and energies."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from contact import Status
from contact.accumulation import Histogram
from contact.errors import ContactError
from contact.geometry.wheelset import Pose, Velocity
from contact.resultants import CaseForces
from models.life.harvest import Harvest
from models.life.plane import PlaneContact
from models.life.scenario import Scenario
from models.life.track import Place
from models.life.trust import IMPACT, Trust
from models.wheelset import dynamics, stability
from models.wheelset.model import WheelsetModel
from models.wheelset.ports import CREEPAGE, LOAD, SIDES

Array = NDArray[np.float64]

#: Column of the time series → unit and meaning. Lateral positions and angles are relative to the track without irregularities.
TRACK = {
    "distance": ("m", "distance run"),
    "time": ("s", "time"),
    "speed": ("m/s", "speed"),
    "curvature": ("1/m", "curvature of the track, positive to the right"),
    "cant": ("rad", "cant angle, positive where the left rail is higher"),
    "alignment": ("m", "lateral irregularity of the centre line"),
    "lateral": ("m", "lateral displacement of the wheelset"),
    "yaw": ("rad", "yaw, clockwise seen from above"),
    "roll": ("rad", "roll"),
    "spin": ("rad/s", "rotation about the axle"),
}
WHEEL = {
    "normal_force": ("N", "normal force of the coupled run"),
    "contact_angle": ("rad", "contact angle of the coupled run"),
    "lateral_force": ("N", "force of the rail on the wheel to the right"),
    "vertical_force": ("N", "force of the wheel on the rail downwards"),
    "longitudinal_creepage": ("1", "longitudinal creepage of the coupled run"),
    "lateral_creepage": ("1", "lateral creepage of the coupled run"),
    "spin_creepage": ("1/m", "spin creepage of the coupled run"),
    "T_gamma": ("N", "T-gamma, all patches"),
    "dissipation": ("N", "frictional energy per metre, all patches"),
    "max_pressure": ("Pa", "greatest pressure of all patches"),
    "patches": ("1", "number of patches"),
}
COLUMNS = {**TRACK, **{f"{side}_{name}": what for side in SIDES for name, what in WHEEL.items()}}
#: Energies of a run [J], and the number of contacts without a trustworthy solution.
BALANCE = {
    "drive": "delivered by what keeps the speed and by the loads of the surroundings",
    "damper": "spent in the suspension",
    "interface": "left the wheelset through the contacts",
    "dissipated": "of that, creep forces times creepages of the coupled run",
    "alignment": "of that, work on the irregularities of the alignment",
    "elastic": "of that, stored in the contacts since the second step (2/5 load times approach)",
    "residual": "of that, what the coupling has lost",
    "counted": "frictional energy of the coupled run where damage was counted",
    "harvested": "the same, of the patches that the damage is from",
    "untrusted": "contacts of the coupled run without a trustworthy solution",
}


class Book(IntEnum):
    """Entries of the energy balance of a run. INTERFACE_FIRST and ELASTIC_FIRST are values of the second step."""

    DISSIPATED = 0
    ALIGNMENT = 1
    ELASTIC = 2
    COUNTED = 3
    UNTRUSTED = 4
    INTERFACE_FIRST = 5
    ELASTIC_FIRST = 6
    IMPACTS = 7
    LIFTED = 8


class Run:
    """A run of a scenario.

    The coupling is Gauss-Seidel as in `models.wheelset.master`. `save` and `restore` are exact: a restored run has the same
    result as an uninterrupted one, bit for bit.

    Attributes
    ----------
    scenario : Scenario
    harvest : Harvest
        Damage so far.
    steps : int
        Number of steps so far.
    distance : float
        Distance so far [m].
    """

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self._p = scenario.parameters
        self._line, self._h = scenario.line(), scenario.step
        self._model = WheelsetModel(self._p)
        self._contacts = [PlaneContact(self._p, scenario.friction, scenario.declared.methods) for _ in SIDES]
        self.harvest = Harvest(scenario)
        self.steps, self.distance = 0, 0.0
        self._sampled = scenario.declared.recording.settling  # distance of the last sample of damage [m]
        self._books, self._power = np.zeros(len(Book)), 0.0
        self._loads = np.full(len(SIDES), 0.5 * self._p.axle_load)  # normal forces of the last step [N]
        self._rows: list[Array] = []

    @property
    def done(self) -> bool:
        """True if the whole length has been run."""
        return self.distance >= self.scenario.declared.length

    @property
    def share(self) -> float:
        """Share of the length that has been run, 0 to 1."""
        return min(self.distance / self.scenario.declared.length, 1.0)

    def advance(self) -> None:
        """Compute one step of the coupled system.

        Raises
        ------
        ContactError
            If a wheel leaves its rail. The message contains the place.
        """
        s, model = self.distance, self._model
        speed, place = self.scenario.speed(s), self._line.at(s)
        loads = self.scenario.declared.wheelset.loads(self._p, speed, place.curvature, place.cant)
        try:
            model.set_running(speed, curvature=place.curvature, **loads)
            model.set_irregularity(place.lateral, place.slope)
            problems = [model.problem(side) for side in SIDES]
            answers = [c.solve(problem, speed) for c, problem in zip(self._contacts, problems, strict=True)]
            self._book(problems, answers, speed, place.slope)
            if s - self._sampled >= self.scenario.declared.recording.spacing:
                self._sample(place, problems, answers, speed)
            for side, a in zip(SIDES, answers, strict=True):
                model.set_forces(side, a.Fx, a.Fy, a.Mz, a.approach)
            model.step(self._h)
        except ContactError as error:
            raise ContactError(f"{self.scenario.name} at {s:.2f} m, {speed:g} m/s: {error}") from None
        self.steps += 1
        self.distance += speed * self._h

    def _book(self, problems: list[Array], answers: list[CaseForces], speed: float, slope: float) -> None:
        """Add the energies of a step by the trapezoidal rule, from the second step. The first one has an assumed approach."""
        books, power, elastic, lateral = self._books, 0.0, 0.0, 0.0
        for side, problem, a in zip(SIDES, problems, answers, strict=True):
            angle = self._model.frame(side)[dynamics.Frame.ANGLE]
            power -= speed * float(problem[CREEPAGE] @ np.array([a.Fx, a.Fy, a.Mz]))
            elastic += 0.4 * float(problem[LOAD] * a.approach)
            lateral += float(a.Fy * np.cos(angle) + problem[LOAD] * np.sin(angle))
            books[Book.UNTRUSTED] += a.status in (Status.OUT_OF_RANGE, Status.NOT_CONVERGED)
        loads = np.array([problem[LOAD] for problem in problems])
        high = IMPACT * 0.5 * self._p.axle_load
        books[Book.IMPACTS] += int(((loads > high) & (self._loads <= high)).sum())
        books[Book.LIFTED] += int(((loads <= 0.0) & (self._loads > 0.0)).sum())
        self._loads = loads
        if self.steps > 1:
            books[Book.DISSIPATED] += 0.5 * (power + self._power) * self._h
            books[Book.ALIGNMENT] -= lateral * speed * slope * self._h
        else:
            books[Book.INTERFACE_FIRST], books[Book.ELASTIC_FIRST] = self._model.energy()[0], elastic
        self._power, books[Book.ELASTIC] = power, elastic

    def _sample(self, place: Place, problems: list[Array], answers: list[CaseForces], speed: float) -> None:
        """Add the damage of the distance since the last sample, and a row of the time series."""
        s, model = self.distance, self._model
        distance, self._sampled = s - self._sampled, s
        y, yaw, y_rate, yaw_rate, spin, _, roll = model.motion().tolist()
        frames = np.array([model.frame(side) for side in SIDES])
        relative = np.array([y, yaw, y_rate - speed * place.slope, yaw_rate, spin])
        z_rate, roll_rate = dynamics.follow(frames, relative)
        normal = np.array([problem[LOAD] for problem in problems])
        lateral, vertical = _track_forces(frames, np.array([a.Fy for a in answers]), normal)
        found = self.harvest.add(
            Pose(y - place.lateral, 0.0, roll, yaw - place.slope),
            Velocity(
                speed * (1.0 - place.curvature * y),
                relative[dynamics.State.LATERAL_VELOCITY],
                z_rate,
                roll_rate,
                yaw_rate + speed * place.curvature,
                -spin,
            ),
            speed,
            normal * np.cos(frames[:, dynamics.Frame.ANGLE]),
            distance,
        )
        self._books[Book.COUNTED] += distance * float(sum(a.power_per_metre for a in answers))
        row = [s, self.steps * self._h, speed, place.curvature, place.cant, place.lateral, y, yaw, roll, spin]
        for i, problem in enumerate(problems):
            row += [normal[i], frames[i, dynamics.Frame.ANGLE], lateral[i], vertical[i], *problem[CREEPAGE], *found[i]]
        self._rows.append(np.array(row))

    @property
    def columns(self) -> dict[str, tuple[str, str]]:
        """Column of the time series → unit and meaning."""
        return COLUMNS

    @property
    def step(self) -> float:
        """Step of the coupled system [s]."""
        return self._h

    def damage(self) -> dict[tuple[str, str], Histogram]:
        """Return the damage of both wheels and rails: (side, "wheel" or "rail") → histogram."""
        return {(side, body): histogram for (side, body), histogram in self.harvest.histograms.items()}

    @property
    def series(self) -> dict[str, Array]:
        """The time series, a column each of `COLUMNS`."""
        rows = np.array(self._rows).reshape(-1, len(COLUMNS))
        return {name: rows[:, k] for k, name in enumerate(COLUMNS)}

    @property
    def balance(self) -> dict[str, float]:
        """Energies of the whole run [J], with the names of `BALANCE`."""
        interface, drive, damper, _ = self._model.energy().tolist()
        dissipated, alignment, elastic, counted, untrusted, interface_first, elastic_first, *_ = self._books.tolist()
        left, stored = interface - interface_first, elastic - elastic_first
        values = (drive, damper, left, dissipated, alignment, stored, left - dissipated - alignment - stored)
        return dict(zip(BALANCE, (*values, counted, float(self.harvest.energy.sum()), untrusted), strict=True))

    @property
    def energy(self) -> float:
        """Frictional energy of both wheels where damage was counted [J]."""
        return float(self.harvest.energy.sum())

    @property
    def axle_load(self) -> float:
        """Static load of the axle [N]."""
        return self._p.axle_load

    @property
    def trust(self) -> Trust:
        """How far the run can be trusted."""
        balance = self.balance
        residual = balance["residual"] / balance["dissipated"] if balance["dissipated"] > 0.0 else 0.0
        critical = stability.critical_speed(self._p, self.scenario.friction.static)
        return Trust(
            residual=residual,
            impacts=float(self._books[Book.IMPACTS]),
            lifted=float(self._books[Book.LIFTED]),
            untrusted=balance["untrusted"],
            speed_ratio=self.scenario.fastest / critical,
        )

    def save(self) -> dict[str, Array]:
        """Return the whole state of the run as arrays."""
        return {
            "model": np.frombuffer(self._model.save()),
            "progress": np.array([self.steps, self.distance, self._sampled, self._power, self._h]),
            "books": self._books.copy(),
            "loads": self._loads.copy(),
            "rows": np.array(self._rows).reshape(-1, len(COLUMNS)),
            **self.harvest.save(),
        }

    def restore(self, saved: Mapping[str, Array]) -> None:
        """Restore the state from `save` of the same scenario."""
        self._model.restore(saved["model"].tobytes())
        steps, self.distance, self._sampled, self._power, self._h = saved["progress"].tolist()
        self.steps = int(steps)
        self._books[:] = saved["books"]
        self._loads = saved["loads"].copy()
        self._rows = list(saved["rows"])
        self.harvest.restore(saved)


def _track_forces(frames: Array, Fy: Array, normal: Array) -> tuple[Array, Array]:
    """Return lateral forces of the rails on the wheels and vertical forces of the wheels on the rails [N], shape (2,) each."""
    sine, cosine = np.sin(frames[:, dynamics.Frame.ANGLE]), np.cos(frames[:, dynamics.Frame.ANGLE])
    return Fy * cosine + normal * sine, normal * cosine - Fy * sine
