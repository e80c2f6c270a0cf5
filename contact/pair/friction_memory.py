"""Friction that follows the sliding velocity with a lag (other_wheels.md).

    dmu/dt = max(s, s0)/d (mu_law(s) - mu)

with the sliding velocity s, the memory distance d and the least sliding velocity s0. These are the parameters of CONTACT's
friction memory (d_c, s_0), quoted from memory. For a constant s the lag is exponential over the distance slid,
mu = mu_law + (mu_0 - mu_law) exp(-s t/d). One coefficient stands for the whole contact.
"""

from __future__ import annotations

import math
from dataclasses import replace

from contact.errors import ContactError, require_number
from contact.friction import Friction


class FrictionMemory:
    """A coefficient of friction with a state.

    Parameters
    ----------
    friction : contact.friction.Friction
        The law of the steady state. Its sliding velocity is that of the whole contact.
    distance : float
        Memory distance d [m], positive.
    least : float
        Least sliding velocity s0 [m/s] ≥ 0 with which the state changes. With 0 it rests while the contact sticks.

    Attributes
    ----------
    coefficient : present coefficient [-]; at first that at rest

    Raises
    ------
    ContactError
        For arguments outside their range, or a law of the local slip velocity.
    """

    def __init__(self, friction: Friction, distance: float, least: float = 0.0) -> None:
        if not isinstance(friction, Friction):
            raise ContactError(f"friction = {friction!r} is not a contact.friction.Friction")
        if friction.velocity != "global":
            raise ContactError(f"friction.velocity = {friction.velocity!r}: one state follows only 'global'")
        self._law = friction
        self._distance = require_number("distance", distance, 0.0, open_minimum=True)
        self._least = require_number("least", least, 0.0)
        self.coefficient = friction.static

    def advance(self, sliding: float, step: float) -> float:
        """Advance the coefficient by `step` [s] ≥ 0 at the sliding velocity `sliding` [m/s] ≥ 0, and return it.

        The solution is exact for a sliding velocity that is constant over the step.
        """
        sliding, step = require_number("sliding", sliding, 0.0), require_number("step", step, 0.0)
        steady = float(self._law.coefficient(sliding))
        faded = math.exp(-max(sliding, self._least) * step / self._distance)
        self.coefficient = steady + (self.coefficient - steady) * faded
        return self.coefficient

    @property
    def friction(self) -> Friction:
        """The present friction: Coulomb's law with the present coefficient, all else as in the law."""
        return replace(self._law, static=self.coefficient, law="coulomb")
