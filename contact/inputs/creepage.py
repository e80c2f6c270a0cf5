"""Rigid relative motion of wheel and rail in the contact plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact.errors import ContactError
from contact.inputs.options import CREEPAGE


@dataclass(frozen=True, slots=True)
class Creepage:
    """Velocity of the wheel relative to the rail at the origin of the separation, divided by the rolling speed V.

    The rigid slip is (longitudinal - spin·y, lateral + spin·x), thesis Eqs. 3.5-3.6. A positive creepage gives a negative
    force on the wheel. The frame is right-handed: x in the rolling direction, y lateral, z along the common normal.

    Parameters
    ----------
    longitudinal, lateral : float
        Creepages [-], within ±1e6.
    spin : float
        Spin creepage [1/m], within ±1e6.

    Raises
    ------
    ContactError
        For a creepage that is not finite or out of range.

    Examples
    --------
    A wheel that turns .1 % too slowly is braked by the rail, so the force on it points backwards:

    >>> import contact
    >>> gap = contact.Separation.hertzian(1.1, 0.8)
    >>> contact.solve(gap, contact.Creepage(longitudinal=1e-3), load=80e3).Fx < 0.0
    True
    """

    longitudinal: float = 0.0
    lateral: float = 0.0
    spin: float = 0.0

    def __post_init__(self) -> None:
        for name in ("longitudinal", "lateral", "spin"):
            CREEPAGE.require(f"creepage.{name}", getattr(self, name))


def as_creepage(value: object) -> Creepage:
    """Return `value`, a Creepage or (longitudinal, lateral, spin), as a Creepage, or raise a ContactError."""
    if isinstance(value, Creepage):
        return value
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, tuple | list) or len(value) != 3:
        raise ContactError(f"creepage = {value!r} is neither a contact.Creepage nor (longitudinal, lateral, spin)")
    return Creepage(*value)
