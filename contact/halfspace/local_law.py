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

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.friction import LARGEST

#: Terms over the slip velocity.
TERMS = ("linear", "rational", "rational_square", "exponential")


@dataclass(frozen=True)
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

    Raises
    ------
    ContactError
        For values outside their range.
    """

    kinetic: float | Array
    terms: tuple[tuple[str, float | Array, float | Array], ...] = ()
    memory_distance: float = 0.0
    memory_speed: float = 0.0

    def __post_init__(self) -> None:
        require_number("memory_distance", self.memory_distance, 0.0)
        require_number("memory_speed", self.memory_speed, 0.0)
        for kind, _, _ in self.terms:
            if kind not in TERMS:
                raise ContactError(f"terms: {kind!r} is unknown; allowed: {', '.join(TERMS)}")
        static = self.static
        if not (np.isfinite(static).all() and (static >= 0.0).all() and (static <= LARGEST).all()):
            raise ContactError(
                f"the coefficient at rest is {static.min():g} … {static.max():g}; allowed: [0, {LARGEST:g}]"
            )

    @property
    def constant(self) -> bool:
        """Whether the coefficient does not depend on the slip."""
        return not self.terms

    @property
    def static(self) -> Array:
        """Coefficient at rest [-] of each row, shape (ny, 1) or (1, 1)."""
        return self.at(np.zeros((1, 1)))

    def at(self, slip: Array) -> Array:
        """Return mu_s [-] at slip velocities [m/s], shape (ny, nx)."""
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
        return total

    def followed(self, slip: Array, before: Array, time: float) -> Array:
        """Return the coefficient [-] of particles that had `before`, after `time` [s] with a slip velocity [m/s]."""
        wanted = self.at(slip)
        if self.memory_distance == 0.0:
            return wanted
        share = np.exp(-np.maximum(slip, self.memory_speed) * time / self.memory_distance)
        return wanted + (before - wanted) * share

    def along_rows(self, slip: Array, touching: NDArray[np.bool_], time: float) -> Array:
        """Return the coefficient [-] in steady rolling; particles enter each row at the largest x with the static one.

        `time` [s] is that in which a particle crosses an element.
        """
        if self.memory_distance == 0.0:
            return self.at(slip)
        static = np.broadcast_to(self.static, (slip.shape[0], 1))
        field, before = np.broadcast_to(static, slip.shape).copy(), static
        for j in range(slip.shape[1] - 1, -1, -1):
            now = self.followed(slip[:, j : j + 1], before, time)
            before = np.where(touching[:, j : j + 1], now, static)
            field[:, j : j + 1] = before
        return field


def _column(value: float | Array) -> Array:
    """Return a number or one number for each row as an array that broadcasts over the rows of a grid."""
    return np.asarray(value, dtype=np.float64).reshape(-1, 1)
