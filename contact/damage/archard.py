"""Archard's sliding wear with the KTH map of wear coefficients (thesis Eqs. 6.3-6.4; Jendel 2002)."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.errors import require_number
from contact.kernels.damage.archard import wear_coefficient_kernel


@dataclass(frozen=True, slots=True)
class ArchardMap:
    """Wear coefficients k as a function of sliding velocity and pressure (constants.md 4).

    The ranges of k are those of the thesis [T]. The single values inside them, the thresholds and the seizure rule are
    recalled [R] (Jendel 2002). They hold for dry steel; divide them by 2 to 10 for lubricated or wet contact (Enblom, [R]).

    Parameters
    ----------
    mild : float
        k below `severe_from` [-]. 5e-4, from the range 1e-4 to 10e-4 [T].
    severe : float
        k from `severe_from` to `severe_to` [-]. 35e-4, from the range 30e-4 to 40e-4 [T].
    mild_fast : float
        k above `severe_to` [-]. 5e-4, from the range 1e-4 to 10e-4 [T].
    seizure : float
        k if the pressure exceeds `seizure_ratio` times the hardness [-]. 350e-4, from the range 300e-4 to 400e-4 [T].
    severe_from, severe_to : float
        Sliding velocities 0.2 and 0.7 m/s [R].
    seizure_ratio : float
        0.8 [R].
    """

    mild: float = 5e-4
    severe: float = 35e-4
    mild_fast: float = 5e-4
    seizure: float = 350e-4
    severe_from: float = 0.2
    severe_to: float = 0.7
    seizure_ratio: float = 0.8

    def __post_init__(self) -> None:
        for name in ("mild", "severe", "mild_fast", "seizure", "severe_from", "seizure_ratio"):
            require_number(f"archard.{name}", getattr(self, name), 0.0)
        require_number("archard.severe_to", self.severe_to, self.severe_from)

    def constants(self) -> NDArray[np.float64]:
        """Return the constants as the array for `wear_coefficient_kernel`."""
        return np.array(astuple(self))


def wear_coefficient(
    velocity: ArrayLike, pressure: ArrayLike, hardness: ArrayLike, parameters: ArchardMap | None = None
) -> float | Array:
    """Return Archard's wear coefficient k [-] from the KTH map.

    Parameters
    ----------
    velocity : array_like
        Sliding velocity [m/s], not negative.
    pressure : array_like
        [Pa], not negative.
    hardness : array_like
        Hardness of the softer body [Pa], positive.
    parameters : ArchardMap
        Coefficients and thresholds.

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        wear_coefficient_kernel,
        require_numbers("velocity", velocity, 0.0),
        require_numbers("pressure", pressure, 0.0),
        require_numbers("hardness", hardness, 0.0, open_minimum=True),
        constants=((parameters or ArchardMap()).constants(),),
    )
