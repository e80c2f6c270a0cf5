"""Damping of the contact forces of a pair over time steps (other_wheels.md).

    F_tot = F + C dF/dt

for the normal and the tangential forces of every patch, by backward differences, with limits of the rates. This is the contact
damping of CONTACT 25.1. It is part of the total force; pressures and tractions do not know it.
"""

from __future__ import annotations

import math

import numpy as np

from contact.arrays import Array
from contact.errors import require_number
from contact.pair.solution import Contact, PairSolution

#: Two patches of successive steps are the same if their places on the wheel are not further apart than this [m].
_SAME = 5e-3


class ContactDamping:
    """Contact damping of one wheel on one rail.

    Parameters
    ----------
    normal, tangential : float
        Damping times C [s] ≥ 0.
    normal_rate, tangential_rate : float
        Largest rates of the forces that count [N/s], positive.

    Raises
    ------
    ContactError
        For a number outside its range.
    """

    def __init__(
        self,
        normal: float,
        tangential: float = 0.0,
        *,
        normal_rate: float = math.inf,
        tangential_rate: float = math.inf,
    ) -> None:
        self._times = np.array([require_number(n, v, 0.0) for n, v in (("normal", normal), ("tangential", tangential))])
        rates = ("normal_rate", normal_rate), ("tangential_rate", tangential_rate)
        self._rates = [v if v == math.inf else require_number(n, v, 0.0, open_minimum=True) for n, v in rates]
        self._before: list[tuple[float, Array]] = []

    def forget(self) -> None:
        """Start anew: the next solution has no damping."""
        self._before = []

    def force(self, solution: PairSolution, step: float) -> Array:
        """Return the force on the wheel [N] with damping, shape (3,), for a solution `step` [s] after the last one.

        A patch that was not there before has no damping. No patch pulls: its normal force with damping is not negative.
        """
        step = require_number("step", step, 0.0, open_minimum=True)
        total = np.array(solution.force)
        after = []
        for patch in solution.contacts:
            forces = np.array([patch.N, patch.Fx, patch.Fy])
            total += _track(self._added(patch, forces, step), patch.angle)
            after.append((patch.on_wheel[0], forces))
        self._before = after
        return total

    def _added(self, patch: Contact, forces: Array, step: float) -> Array:
        """Return what damping adds to N, Fx, Fy [N]."""
        near = min(self._before, key=lambda old: abs(old[0] - patch.on_wheel[0]), default=None)
        if near is None or abs(near[0] - patch.on_wheel[0]) > _SAME:
            return np.zeros(3)
        rates = (forces - near[1]) / step
        limits = np.array([self._rates[0], self._rates[1], self._rates[1]])
        added: Array = self._times[[0, 1, 1]] * np.clip(rates, -limits, limits)
        added[0] = max(added[0], -patch.N)
        return added


def _track(forces: Array, angle: float) -> Array:
    """Return N, Fx, Fy of a contact frame as a force in track coordinates."""
    N, Fx, Fy = forces
    c, s = math.cos(angle), math.sin(angle)
    return np.array([Fx, c * Fy + s * N, s * Fy - c * N])
