"""Friction that falls with sliding velocity and temperature, and surfaces softer at small creepage (theory.md 8.1-8.3, 8.5)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.errors import ContactError, require_number
from contact.kernels.friction import coefficient, over_profile
from contact.material import Thermal
from contact.notebook import table

#: Greatest coefficient [-]: adhesion beyond any use, and far from where squares overflow.
LARGEST = 1e6
#: Highest temperature [K], beyond any melt.
HOTTEST = 1e5
#: [K] of the bodies, unless told otherwise.
ROOM_TEMPERATURE = 293.15
#: Names of the laws; the place is the number by which kernels know a law.
LAWS = ("coulomb", "linear", "rational", "rational_square", "exponential")
#: Slip velocities that a law may follow; the place is the number by which kernels know them.
VELOCITIES = ("global", "local", "greatest")

#: Of what is no pure number, for `Friction._repr_html_`.
_UNITS = {
    "half_speed": "m/s",
    "border": "m",
    "border_width": "m",
    "reference_temperature": "K",
    "temperature_range": "K",
    "background_temperature": "K",
    "law": "",
    "velocity": "",
    "thermal": "",
}


@dataclass(frozen=True, slots=True, repr=False)
class Friction:
    """Friction of a real surface, in place of a constant coefficient.

    With Δ = static - kinetic and s the slip velocity over `half_speed`, mu = kinetic + Δ f: linear f = max(0, 1 - s/2),
    rational 1/(1 + s), rational_square 1/(1 + s²), exponential 2^-s. The velocity is

    * `global`: speed·√(longitudinal² + lateral²), so the coefficient is one number for a contact;
    * `local`: each element's own. Strips stick up to the static coefficient; an element that slips has the coefficient of the
      slip velocity that it would have under the static one. So the answer is unique and continuous: the velocity under its
      own coefficient would leave several answers (theory.md 8.1);
    * `greatest`: the greatest local one of a particle since it entered the patch; what has slipped keeps the lower coefficient
      until it leaves (Piotrowski 2010), in stick too.

    Whatever the velocity, the coefficient of an element falls with the temperature, linearly, from its full value at
    `reference_temperature` to `hot_factor` times it a `temperature_range` further on. The temperature is the background's and
    the flash temperature by the friction that there is, of this and all elements ahead: a causal equation with one
    answer (theory.md 8.5). No published constants were found (constants.md 8): the values are the user's.

    A local coefficient never exceeds the static one. Methods that give forces alone take the global velocity and the bodies'
    temperature; the element-wise half space iterates on the velocity under its own coefficient.

    Real surfaces are softer than the half space at small creepage: all creep stiffness is multiplied by
    k = slope (slope_far + (1 - slope_far)/(1 + slope_rate·eps)), eps Polach's creepage over that of saturation
    (Spiryagin, Polach and Cole 2013). It takes the place of G in the tangential problem, so the stick zone follows as well.

    Parameters
    ----------
    static : float
        Coefficient at rest [-], 0 to 1e6.
    kinetic : float
        Coefficient in fast sliding [-]; by default as at rest.
    half_speed : float
        Sliding velocity at which half of the difference is gone [m/s], positive.
    law : str
        One of `LAWS`.
    velocity : str
        One of `VELOCITIES`.
    gauge_factor, border, border_width : float
        Over the profile: within the gauge side, y < `border` [m], all coefficients are `gauge_factor` (0 to 100) times those
        on the other side, with a smooth transition over `border_width` [m] around the border. y is the lateral position in
        the plane of the separation; for `contact.pair` that in the rail's profile, of either side, where the gauge face
        lies at negative y. A negative width puts the gauge side at y > `border`, as on a left rail; 0 makes a step.
    slope, slope_far, slope_rate : float
        k0, α_inf and β; slope in ]0, 1], slope_far in [0, 1], slope_rate not negative. 1, 1, 1: the half space. The
        published set is .54, .02, .64 (constants.md 7; the source contradicts itself in β: .62).
    k_A, k_S : float
        Reduction factors of `tangential="polach"` alone, in the area of adhesion and that of slip, each in ]0, 1], k_S not
        above k_A in his theory. 1, 1: the clean surface; typical of dry rails are 1, .4, of wet ones .3, .1 (Polach 2005,
        Table 2; constants.md 6, two sources). At vanishing creepage the force is (k_A + k_S)/2 of Kalker's: not to be
        combined with `slope`, which says the same for every method.
    hot_factor : float
        What heat leaves of the coefficient, 0 to 1; 1: friction does not depend on the temperature.
    reference_temperature, temperature_range, background_temperature : float
        [K], 0 to 1e5: from which on it falls, over how much (positive), and what the bodies have where they do not touch; of
        two bodies the mean. Only the difference of the first and the last counts.
    thermal : Thermal
        Constants of the bodies; steel.

    Raises
    ------
    ContactError
        For values outside their range.
    """

    static: float
    kinetic: float | None = None
    half_speed: float = 1.0
    law: str = "coulomb"
    slope: float = 1.0
    slope_far: float = 1.0
    slope_rate: float = 1.0
    velocity: str = "global"
    gauge_factor: float = 1.0
    border: float = 0.0
    border_width: float = 5e-3
    k_A: float = 1.0
    k_S: float = 1.0
    hot_factor: float = 1.0
    reference_temperature: float = ROOM_TEMPERATURE
    temperature_range: float = 400.0
    background_temperature: float = ROOM_TEMPERATURE
    thermal: Thermal = field(default_factory=Thermal)

    def __post_init__(self) -> None:
        require_number("friction.static", self.static, 0.0, LARGEST)
        if self.kinetic is not None:
            require_number("friction.kinetic", self.kinetic, 0.0, LARGEST)
        require_number("friction.half_speed", self.half_speed, 0.0, open_minimum=True)
        if self.law not in LAWS:
            raise ContactError(f"friction.law = {self.law!r} is unknown; allowed: {', '.join(LAWS)}")
        if self.velocity not in VELOCITIES:
            raise ContactError(f"friction.velocity = {self.velocity!r} is unknown; allowed: {', '.join(VELOCITIES)}")
        require_number("friction.slope", self.slope, 0.0, 1.0, open_minimum=True)
        require_number("friction.slope_far", self.slope_far, 0.0, 1.0)
        require_number("friction.slope_rate", self.slope_rate, 0.0)
        require_number("friction.gauge_factor", self.gauge_factor, 0.0, 100.0)
        require_number("friction.border", self.border)
        require_number("friction.border_width", self.border_width)
        require_number("friction.k_A", self.k_A, 0.0, 1.0, open_minimum=True)
        require_number("friction.k_S", self.k_S, 0.0, 1.0, open_minimum=True)
        require_number("friction.hot_factor", self.hot_factor, 0.0, 1.0)
        require_number("friction.reference_temperature", self.reference_temperature, 0.0, HOTTEST)
        require_number("friction.temperature_range", self.temperature_range, 0.0, HOTTEST, open_minimum=True)
        require_number("friction.background_temperature", self.background_temperature, 0.0, HOTTEST)

    def __repr__(self) -> str:
        others = (f"{name}={value!r}" for name, value in self._changed().items())
        return f"Friction({', '.join((f'{self.static!r}', *others))})"

    def _repr_html_(self) -> str:
        """Return a table of what differs from a constant coefficient, for a notebook."""
        shown = {"static": self.static, **self._changed()}
        return table(
            ("friction", "value", "unit"),
            (
                (name, f"{value:g}" if isinstance(value, float | int) else str(value), _UNITS.get(name, "-"))
                for name, value in shown.items()
            ),
        )

    def _changed(self) -> dict[str, Any]:
        """Return the parameters after the first that differ from their default."""
        default = Friction(0.0)
        names = [each.name for each in fields(self)[1:]]
        return {name: getattr(self, name) for name in names if getattr(self, name) != getattr(default, name)}

    @classmethod
    def polach(cls, static: float = 0.55, A: float = 0.4, B: float = 0.6, **others: Any) -> Friction:
        """mu = static ((1 - A) exp(-B w) + A) over the sliding velocity w [m/s] (Polach 2005, Eq. for falling friction).

        The defaults are his typical values for dry rails, .30, .40, .20 those for wet ones (Wear 258, Table 2; constants.md 6).
        """
        require_number("friction.A", A, 0.0)
        require_number("friction.B", B, 0.0, open_minimum=True)
        return cls(static, A * static, math.log(2.0) / B, "exponential", **others)

    def coefficient(self, velocity: ArrayLike) -> float | NDArray[np.float64]:
        """Coefficient at slip velocities [m/s], not negative."""
        velocities = np.asarray(velocity, dtype=np.float64)
        if not (np.isfinite(velocities).all() and (velocities >= 0.0).all()):
            raise ContactError(
                f"velocity = {velocities.min():g} … {velocities.max():g} is outside the allowed range [0, inf["
            )
        kinetic = self.static if self.kinetic is None else self.kinetic
        law = LAWS.index(self.law)
        values = np.array(
            [coefficient(law, self.static, kinetic, self.half_speed, float(v)) for v in velocities.ravel()]
        )
        return values.reshape(velocities.shape) if velocities.ndim else float(values[0])

    def factor(self, y: ArrayLike) -> NDArray[np.float64]:
        """Factor on all coefficients at lateral positions `y` [m]."""
        at = np.asarray(y, dtype=np.float64)
        values = [over_profile(self.gauge_factor, self.border, self.border_width, float(v)) for v in at.ravel()]
        return np.array(values).reshape(at.shape)

    def placed(self, y: float, angle: float, mirror: float = 1.0) -> Friction:
        """The same surface seen from a patch whose reference point lies at `y` [m] of the profile, its plane at `angle` [rad].

        `mirror` is -1 on the left side, whose plane is the mirror image.
        """
        scale = mirror / math.cos(angle)
        return replace(self, border=scale * (self.border - y), border_width=scale * self.border_width)

    def members(self) -> dict[str, float | int]:
        """Return the members of a case (`contact.kernels.layout.CASE`) that say what the surface is."""
        return {
            "law": LAWS.index(self.law),
            "mu": self.static,
            "kinetic": self.static if self.kinetic is None else self.kinetic,
            "half_speed": self.half_speed,
            "velocity": VELOCITIES.index(self.velocity),
            "slope": self.slope,
            "slope_far": self.slope_far,
            "slope_rate": self.slope_rate,
            "gauge_factor": self.gauge_factor,
            "border": self.border,
            "border_width": self.border_width,
            "k_A": self.k_A,
            "k_S": self.k_S,
            "drop": 1.0 - self.hot_factor,
            "warm": self.reference_temperature - self.background_temperature,
            "warm_range": self.temperature_range,
            "heating": self.thermal.heating,
        }


def as_friction(friction: object) -> Friction:
    """A coefficient, or a `Friction` itself."""
    return friction if isinstance(friction, Friction) else Friction(require_number("friction", friction, 0.0, LARGEST))
