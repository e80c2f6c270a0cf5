"""How far a run can be trusted: what its balance of energy, its contacts and its speed say."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple

from contact.errors import ContactError
from contact.study.table import number

#: A run whose energy does not close to this share of its dissipation is not to be believed.
LARGEST_RESIDUAL = 0.02
#: A run in which a larger share of the contacts has no trustworthy solution is not to be believed either.
LARGEST_UNTRUSTED = 1e-3
#: An error of the step above this is told with its cure.
LARGEST_STEP_ERROR = 0.02
#: A rise of a normal force above this multiple of its static value is an impact.
IMPACT = 2.0
#: A wheel whose longitudinal creepage is larger spins or slides: its torque is more than friction bears.
LARGEST_CREEPAGE = 0.1
#: A wheel that loses more at its deepest place, over the distance, wears as none in service does: 1 mm in 100 km.
FASTEST_WEAR = 1e-8


def _largest(values: Iterable[float]) -> float:
    return max(values, key=abs)


class Measure(NamedTuple):
    """A measure of trust, a pure number: its meaning, and what it is of several runs together."""

    meaning: str
    joined: Callable[[Iterable[float]], float] = max


#: The members of `Trust` that are numbers.
TRUST = {
    "residual": Measure(
        "energy that the integration has lost or gained, over the energy dissipated in the contacts", _largest
    ),
    "impacts": Measure("rises of a wheel's normal force above twice its static value", sum),
    "lifted": Measure("times that a wheel lost contact with its rail", sum),
    "untrusted": Measure("contacts without a trustworthy solution", sum),
    "creepage": Measure("greatest longitudinal creepage of a wheel, of either sign, at the samples"),
    "speed_ratio": Measure("greatest speed over the linear critical speed on straight track"),
    "unfinished": Measure("curves of the track that the run does not reach the end of"),
    "deepest_rate": Measure("greatest depth that a wheel loses per distance, before smoothing"),
    "seizure": Measure("share of the samples at which a wheel's pressure is in Archard's seizure; 0 with other laws"),
    "untrusted_share": Measure("share of the contacts without a trustworthy solution"),
}


#: Why wear is so fast, and the cures, by the law.
_SHEFFIELD = (
    "Sheffield's law does this where T-gamma over the area exceeds 77 N/mm². Cures: less friction, as on a lubricated flange, "
    "or other constants in damage.usfd."
)
_FAST = {
    "archard": "Archard's map does this where sliding is fast or pressures are high, and does not know lubrication. Cures: "
    'damage.wear_law = "usfd", less friction, or lower coefficients of the law.',
    "usfd": _SHEFFIELD,
    "usfd_local": _SHEFFIELD,
}
_OTHERS = "Cures: less friction, or lower coefficients of the law."


class NotTrusted(ContactError):
    """A study stops because a run is not to be trusted."""


@dataclass(frozen=True, slots=True)
class Trust:
    """Measures of trust in a run. The members are explained in `TRUST`; `wear_law` is that of the run."""

    residual: float
    impacts: float
    lifted: float
    untrusted: float
    creepage: float
    speed_ratio: float
    unfinished: float
    deepest_rate: float = 0.0
    seizure: float = 0.0
    untrusted_share: float = 0.0
    wear_law: str = ""

    @property
    def closes(self) -> bool:
        """True if the balance of energy closes to `LARGEST_RESIDUAL`."""
        return abs(self.residual) <= LARGEST_RESIDUAL

    @property
    def reliable(self) -> bool:
        """False if the results are not to be trusted: the energy does not close, or many contacts have no solution."""
        return self.closes and self.untrusted_share <= LARGEST_UNTRUSTED

    @property
    def warnings(self) -> tuple[str, ...]:
        """Plain sentences on what is wrong; empty if nothing is."""
        said = []
        if not self.closes:
            said.append(
                f"The balance of energy does not close: {100.0 * self.residual:+.3g} % of the dissipation, where at most "
                f"{100.0 * LARGEST_RESIDUAL:g} % are accepted. Forces, damage and wear of this run are not to be trusted."
            )
        if self.untrusted:
            many = (
                f" These are {100.0 * self.untrusted_share:.2g} % of all, where at most {100.0 * LARGEST_UNTRUSTED:g} % are "
                "accepted. This run is not to be trusted."
            )
            told = many if self.untrusted_share > LARGEST_UNTRUSTED else ""
            said.append(f"{self.untrusted:.0f} contacts have no trustworthy solution.{told}")
        if self.lifted:
            said.append(f"A wheel lost contact with its rail {self.lifted:.0f} times.")
        if self.impacts:
            said.append(f"A normal force rose above {IMPACT:g} times its static value {self.impacts:.0f} times.")
        if self.creepage > LARGEST_CREEPAGE:
            said.append(
                f"A wheel spins or slides: its longitudinal creepage is up to {self.creepage:.3g}. Its torque is more than "
                "friction bears, or its load is low; nothing limits the spin as an anti-slip control would."
            )
        if self.speed_ratio > 1.0:
            said.append(
                f"The speed is {self.speed_ratio:.3g} times the linear critical speed: on straight track small motions grow."
            )
        if self.unfinished:
            said.append(
                f"The run ends before the end of {self.unfinished:.0f} of its curves: the length of the scenario is shorter "
                "than its track."
            )
        if self.seizure:
            said.append(
                f"Archard's law is in seizure at {100.0 * self.seizure:.2g} % of the samples of a wheel: the pressure exceeds "
                "the share of the hardness from which the coefficient is tens of times that of mild wear. Steel yields "
                'before. Cures: methods.pressure_limit = 1.5e9, or damage.wear_law = "usfd".'
            )
        if self.deepest_rate > FASTEST_WEAR:
            said.append(
                f"A wheel loses {1e9 * self.deepest_rate:.3g} µm in a kilometre at its deepest place, a millimetre in "
                f"{1e-6 / self.deepest_rate:.3g} km. No wheel in service wears so fast. {_FAST.get(self.wear_law, _OTHERS)}"
            )
        return tuple(said)

    def told(self) -> list[tuple[str, str]]:
        """Return meaning and value of each member, as text."""
        values = {name: number(value) for name, value in self.as_dict().items()}
        if self.speed_ratio == 0.0:
            values["speed_ratio"] = "none up to 150 m/s; see the conicity at 3 mm too"
        return [(TRUST[name].meaning, value) for name, value in values.items()]

    def as_dict(self) -> dict[str, float]:
        """Return the members by name."""
        return {name: float(getattr(self, name)) for name in TRUST}


@dataclass(frozen=True, slots=True)
class StepError:
    """Error of the time integration, estimated by half the step on the first part of the run.

    Attributes
    ----------
    energy, volume : float
        Error of the energy dissipated in the contacts, and of the worn volume of all wheels and rails, over themselves [-];
        negative where the step gives too little.
    length : float
        Length of the piece, from the start [m].
    """

    energy: float
    volume: float
    length: float

    @property
    def sentence(self) -> str:
        """The error as a sentence."""
        return (
            f"The step changes the energy dissipated in the contacts by {100.0 * self.energy:+.2g} % and the worn volume by "
            f"{100.0 * self.volume:+.2g} %, estimated by half the step over the first {self.length:.0f} m.{self._advice}"
        )

    @property
    def _advice(self) -> str:
        """What to do if the error is large: of first order, it falls with the step."""
        worst = max(abs(self.energy), abs(self.volume))
        if worst <= LARGEST_STEP_ERROR:
            return ""
        share = LARGEST_STEP_ERROR / worst
        return f" For {100.0 * LARGEST_STEP_ERROR:g} % set recording.step to {share:.2g} times the step of this run."


def worst(runs: list[Trust]) -> Trust:
    """Return the measures of several runs together: the sums of what happened, and the largest of the others."""
    joined = {name: measure.joined(getattr(run, name) for run in runs) for name, measure in TRUST.items()}
    return Trust(**joined, wear_law=runs[0].wear_law)
