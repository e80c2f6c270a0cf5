"""Friction that falls with sliding velocity and temperature, and reduced creep stiffness (theory.md 8.1-8.3, 8.5)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import require_numbers
from contact.errors import ContactError, require_number
from contact.inputs.material import Thermal
from contact.inputs.options import HOT_FACTOR, ROOM_TEMPERATURE, SURFACE, TEMPERATURE, TEMPERATURE_RANGE
from contact.kernels.friction import coefficient, over_profile
from contact.view.notebook import table

#: Names of the friction laws. Kernels identify a law by its index here.
LAWS = ("coulomb", "linear", "rational", "rational_square", "exponential")
#: Slip velocities that a law may depend on. Kernels identify them by their index here.
VELOCITIES = ("global", "local", "greatest")

#: Numbers of a law besides `static`, with their ranges.
_NUMBERS = {
    **{name: SURFACE[name] for name in ("kinetic", "half_speed", "slope", "slope_far", "slope_rate")},
    **{name: SURFACE[name] for name in ("gauge_factor", "border", "border_width", "k_A", "k_S")},
    "hot_factor": HOT_FACTOR,
    "reference_temperature": TEMPERATURE,
    "temperature_range": TEMPERATURE_RANGE,
    "background_temperature": TEMPERATURE,
}

#: Units of the parameters that are not dimensionless, for `Friction._repr_html_`.
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
    """Friction law of a surface, used instead of a constant coefficient.

    The coefficient depends on slip velocity, lateral position on the profile and temperature.

    Slip velocity: mu = kinetic + Δ f(s), with Δ = static - kinetic and s the slip velocity over `half_speed`. The law f is
    linear, max(0, 1 - s/2); rational, 1/(1 + s); rational_square, 1/(1 + s²); or exponential, 2^-s. `velocity` selects the
    slip velocity:

    * `global`: speed·√(longitudinal² + lateral²). One coefficient holds for the whole contact.
    * `local`: the slip velocity of each element. Strips stick up to the static coefficient. The coefficient of a slipping
      element is that of the slip velocity it would have under the static coefficient. The solution is therefore unique and
      continuous. With the slip velocity under the actual coefficient there can be several solutions (theory.md 8.1).
    * `greatest`: the largest local slip velocity of a particle since it entered the patch. A particle that has slipped
      keeps the lower coefficient until it leaves, also in the stick zone (Piotrowski 2010).

    Temperature: the coefficient of an element falls linearly with the temperature, for every choice of `velocity`. It has
    its full value at `reference_temperature` and `hot_factor` times that value at `reference_temperature` +
    `temperature_range`. The temperature of an element is the background temperature plus the flash temperature from the
    friction of this element and all elements ahead of it. This equation is causal and has one solution (theory.md 8.5). No
    published constants were found (constants.md 8), so the user chooses the values.

    A local coefficient never exceeds the static one. Methods that give forces only use the global velocity and the
    background temperature. The element-wise half space iterates on the slip velocity under the actual coefficient.

    Creep stiffness: real surfaces are softer than the half space at small creepage. All creep stiffness is multiplied by
    k = slope (slope_far + (1 - slope_far)/(1 + slope_rate·eps)), with eps Polach's creepage over that of saturation
    (Spiryagin, Polach and Cole 2013). The factor multiplies G in the tangential problem, so the stick zone changes too.

    Parameters
    ----------
    static : float
        Coefficient at rest [-], 0 to 1e6.
    kinetic : float
        Coefficient in fast sliding [-]; default `static`.
    half_speed : float
        Sliding velocity at which the coefficient is halfway between both [m/s], positive.
    law : str
        One of `LAWS`.
    velocity : str
        One of `VELOCITIES`.
    gauge_factor, border, border_width : float
        Friction over the profile. On the gauge side, y < `border` [m], all coefficients are multiplied by `gauge_factor`
        (0 to 100). The transition is smooth over `border_width` [m] around the border; 0 makes a step. y is the lateral
        position in the plane of the separation. For `contact.pair` it is the position in the rail's profile of either
        side, where the gauge face lies at negative y. A negative width puts the gauge side at y > `border`, as on a left
        rail.
    slope, slope_far, slope_rate : float
        k0, α_inf and β. slope in ]0, 1], slope_far in [0, 1], slope_rate not negative. 1, 1, 1 is the half space. The
        published values are .54, .02, .64 (constants.md 7; for β the source also has .62).
    k_A, k_S : float
        Reduction factors in the adhesion and the slip area, each in ]0, 1]; only `tangential="polach"` uses them. In
        Polach's theory k_S does not exceed k_A. 1, 1 is the clean surface. Typical values are 1, .4 for dry rails and
        .3, .1 for wet rails (Polach 2005, Table 2; constants.md 6, two sources). At vanishing creepage the force is
        (k_A + k_S)/2 of Kalker's. Do not combine them with `slope`, which has the same effect for every method.
    hot_factor : float
        Factor on the coefficient when hot, 0 to 1. With 1 the friction does not depend on the temperature.
    reference_temperature, temperature_range, background_temperature : float
        Temperatures [K], 0 to 1e5. The coefficient falls above `reference_temperature`, over `temperature_range`
        (positive). `background_temperature` is that of the bodies outside the contact, for two bodies the mean. Only the
        difference of reference and background matters.
    thermal : Thermal
        Thermal constants of the bodies; default steel.

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
        SURFACE["mu"].require("friction.static", self.static)
        for name, member in _NUMBERS.items():
            if name != "kinetic" or self.kinetic is not None:
                member.require(f"friction.{name}", getattr(self, name))
        for name, value, allowed in (("law", self.law, LAWS), ("velocity", self.velocity, VELOCITIES)):
            if value not in allowed:
                raise ContactError(f"friction.{name} = {value!r} is unknown; allowed: {', '.join(allowed)}")

    def __repr__(self) -> str:
        others = (f"{name}={value!r}" for name, value in self._changed().items())
        return f"Friction({', '.join((f'{self.static!r}', *others))})"

    def _repr_html_(self) -> str:
        """Return an HTML table of the parameters that differ from their default, for a notebook."""
        shown = {"static": self.static, **self._changed()}
        return table(
            ("friction", "value", "unit"),
            (
                (name, f"{value:g}" if isinstance(value, float | int) else str(value), _UNITS.get(name, "-"))
                for name, value in shown.items()
            ),
        )

    def _changed(self) -> dict[str, Any]:
        """Return the parameters, without `static`, that differ from their default."""
        default = Friction(0.0)
        names = [each.name for each in fields(self)[1:]]
        return {name: getattr(self, name) for name in names if getattr(self, name) != getattr(default, name)}

    @classmethod
    def polach(cls, static: float = 0.55, A: float = 0.4, B: float = 0.6, **others: Any) -> Friction:
        """Return Polach's law mu = static ((1 - A) exp(-B w) + A), with the sliding velocity w [m/s] (Polach 2005).

        The defaults are his typical values for dry rails. Those for wet rails are .30, .40, .20 (Wear 258, Table 2;
        constants.md 6). `others` are further parameters of `Friction`.
        """
        require_number("friction.A", A, 0.0)
        require_number("friction.B", B, 0.0, open_minimum=True)
        return cls(static, A * static, math.log(2.0) / B, "exponential", **others)

    def coefficient(self, velocity: ArrayLike) -> float | NDArray[np.float64]:
        """Return the coefficient [-] at slip velocities [m/s], which must not be negative."""
        velocities = require_numbers("velocity", velocity, 0.0)
        kinetic = self.static if self.kinetic is None else self.kinetic
        law = LAWS.index(self.law)
        values = np.array(
            [coefficient(law, self.static, kinetic, self.half_speed, float(v)) for v in velocities.ravel()]
        )
        return values.reshape(velocities.shape) if velocities.ndim else float(values[0])

    def factor(self, y: ArrayLike) -> NDArray[np.float64]:
        """Return the factor [-] on all coefficients at lateral positions `y` [m]."""
        at = require_numbers("y", y)
        values = [over_profile(self.gauge_factor, self.border, self.border_width, float(v)) for v in at.ravel()]
        return np.array(values).reshape(at.shape)

    def placed(self, y: float, angle: float, mirror: float = 1.0) -> Friction:
        """Return this law with `border` and `border_width` in the plane of a patch.

        The patch's reference point lies at `y` [m] of the profile, and its plane is inclined by `angle` [rad]. `mirror` is
        -1 on the left side, whose plane is the mirror image.
        """
        scale = mirror / math.cos(angle)
        return replace(self, border=scale * (self.border - y), border_width=scale * self.border_width)

    def members(self) -> dict[str, float | int]:
        """Return the members of a CASE record (`contact.kernels.records`) that describe the surface, by name."""
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
    """Return `friction` as a `Friction`; a number becomes a constant coefficient."""
    return friction if isinstance(friction, Friction) else Friction(SURFACE["mu"].require("friction", friction))
