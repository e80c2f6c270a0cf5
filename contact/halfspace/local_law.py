"""Friction of each element: constants by rows, several terms over the slip velocity, and friction with memory.

    mu_s(s) = kinetic + sum of terms,    linear  a max(0, 1 - s/(2 s_h)),   rational  a/(1 + s/s_h),
    rational_square  a/(1 + (s/s_h)²),   exponential  a 2^(-s/s_h)

With a memory, the coefficient of a particle follows mu_s with the distance slipped (Vollebregt 2014, recalled),

    d mu/dt = -max(s, s_0)/distance (mu - mu_s).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array, as_array, brief
from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction
from contact.inputs.material import Thermal
from contact.inputs.options import FRICTION

#: Terms over the slip velocity.
TERMS = ("linear", "rational", "rational_square", "exponential")


@dataclass(frozen=True)
class Warmth:
    """Friction that changes linearly with the temperature of the surfaces, and what heats them.

    Parameters
    ----------
    change : float
        What is added to the coefficient at `reference` + `span` and above [-], of either sign.
    reference, span : float
        Temperatures [°C or K]; `span` positive.
    background : float
        Mean temperature of the bodies [the same].
    thermal : Thermal
        Thermal constants of both bodies.

    Raises
    ------
    ContactError
        For values outside their range.
    """

    change: float
    reference: float
    span: float
    background: float
    thermal: Thermal

    def __post_init__(self) -> None:
        for name in ("change", "reference", "background"):
            require_number(name, getattr(self, name))
        require_number("span", self.span, 0.0, open_minimum=True)

    def rise(self, flux: Array, dx: float, speed: float) -> Array:
        """Return the rise of temperature from the heat -q·s [W/m²] of the rows; particles come from the largest x."""
        ahead = np.arange(flux.shape[1])[None, :] - np.arange(flux.shape[1])[:, None]  # column minus place
        edges = np.sqrt(np.maximum(ahead + 0.5, 0.0)) - np.sqrt(np.maximum(ahead - 0.5, 0.0))
        scale = 2.0 * math.sqrt(dx) * self.thermal.heating / math.sqrt(speed)
        return np.asarray(scale * (flux @ edges.T))

    def added(self, rise: Array) -> Array:
        """Return what is added to the coefficient [-] at a rise of temperature."""
        return self.change * np.clip((self.background + rise - self.reference) / self.span, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class LocalLaw:
    """Friction that depends on the slip velocity of each element, for `contact.Transient`.

    Parameters
    ----------
    kinetic : float or array_like, shape (ny,)
        Coefficient in fast sliding [-], of all rows of elements or of each row.
    terms : tuple of (str, float or array_like, float or array_like)
        Kind, one of `TERMS`, coefficient a [-] and slip velocity s_h [m/s] of each term.
    memory_distance, memory_speed : float
        Distance [m] and least velocity s_0 [m/s] of the memory, not negative. A distance of 0 is no memory.
    warmth : Warmth
        Change with the temperature, in steady rolling.

    Raises
    ------
    ContactError
        For values outside their range.
    """

    kinetic: float | Array
    terms: tuple[tuple[str, float | Array, float | Array], ...] = ()
    memory_distance: float = 0.0
    memory_speed: float = 0.0
    warmth: Warmth | None = None

    __repr__ = brief

    def __post_init__(self) -> None:
        require_number("memory_distance", self.memory_distance, 0.0)
        require_number("memory_speed", self.memory_speed, 0.0)
        for kind, _, _ in self.terms:
            if kind not in TERMS:
                raise ContactError(f"terms: {kind!r} is unknown; allowed: {', '.join(TERMS)}")
        static = self.static
        if not (np.isfinite(static).all() and (static >= 0.0).all() and (static <= FRICTION.most).all()):
            raise ContactError(
                f"the coefficient at rest is {static.min():g} … {static.max():g}; allowed: [0, {FRICTION.most:g}]"
            )

    @property
    def constant(self) -> bool:
        """Whether the coefficient does not depend on the slip."""
        return not self.terms and self.warmth is None

    @property
    def static(self) -> Array:
        """Coefficient at rest [-] of each row, shape (ny, 1) or (1, 1)."""
        return self.at(np.zeros((1, 1)))

    def at(self, slip: Array, added: Array | float = 0.0) -> Array:
        """Return mu_s [-] at slip velocities [m/s], shape (ny, nx), with what the temperature adds."""
        total = np.zeros(slip.shape) + _column(self.kinetic)
        for kind, amount, half in self.terms:
            a, s = _column(amount), slip / np.where(_column(half) > 0.0, _column(half), 1.0)
            if kind == "linear":
                share = np.maximum(0.0, 1.0 - 0.5 * s)
            elif kind == "exponential":
                share = np.exp(-math.log(2.0) * s)
            else:
                share = 1.0 / (1.0 + (s if kind == "rational" else s * s))
            total = total + a * share
        return total + added

    def followed(self, slip: Array, before: Array, time: float, added: Array | float = 0.0) -> Array:
        """Return the coefficient [-] of particles that had `before`, after `time` [s] with a slip velocity [m/s]."""
        wanted = self.at(slip, added)
        if self.memory_distance == 0.0:
            return wanted
        share = np.exp(-np.maximum(slip, self.memory_speed) * time / self.memory_distance)
        return wanted + (before - wanted) * share

    def along_rows(self, slip: Array, touching: NDArray[np.bool_], time: float, added: Array | None = None) -> Array:
        """Return the coefficient [-] in steady rolling; particles enter each row at the largest x with the static one.

        `time` [s] is that in which a particle crosses an element.
        """
        if self.memory_distance == 0.0:
            return self.at(slip, 0.0 if added is None else added)
        more = np.zeros(slip.shape) if added is None else added
        static = np.broadcast_to(self.static, (slip.shape[0], 1))
        field, before = np.broadcast_to(static, slip.shape).copy(), static
        for j in range(slip.shape[1] - 1, -1, -1):
            now = self.followed(slip[:, j : j + 1], before, time, more[:, j : j + 1])
            before = np.where(touching[:, j : j + 1], now, static)
            field[:, j : j + 1] = before
        return field


def _column(value: float | Array) -> Array:
    """Return a number or one number for each row as an array that broadcasts over the rows of a grid."""
    return as_array("friction", value).reshape(-1, 1)


def of_each_element(friction: float | Friction | LocalLaw) -> tuple[LocalLaw, Friction, bool]:
    """Return the law of each element, a law over the global velocity in its place, and whether elements differ.

    Raises
    ------
    ContactError
        For a law over the greatest velocity, or a `Friction` that depends on the temperature.
    """
    if isinstance(friction, LocalLaw):
        return friction, Friction(float(friction.static.max())), True
    law = as_friction(friction)
    if law.velocity == "greatest" or law.hot_factor < 1.0:
        raise ContactError(
            "friction: a step takes no law over the greatest velocity or the temperature; allowed: global, local"
        )
    if law.velocity != "local" or law.law == "coulomb":
        return LocalLaw(law.static), law, False
    kinetic = law.static if law.kinetic is None else law.kinetic
    return LocalLaw(kinetic, ((law.law, law.static - kinetic, law.half_speed),)), law, True
