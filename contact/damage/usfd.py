"""Wear rate from T-gamma/A: the University of Sheffield's function (Lewis & Dwyer-Joyce 2004, Braghin et al. 2006)."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.errors import ContactError, require_number
from contact.kernels.damage.usfd import usfd_kernel

SevereBranch = Literal["continuous", "proportional", "from_zero"]


@dataclass(frozen=True, slots=True)
class Usfd:
    """Constants for R8T wheel on UIC60 900A rail: wear rate in µg/(m mm²) as a function of I = T-gamma/A in N/mm².

    The marks are those of constants.md 3. [R+1]: recalled, one public code agrees.

    Parameters
    ----------
    mild_slope, mild_limit : float
        Rate 5.3 I below I = 10.4 N/mm² [R+1].
    plateau : float
        Rate 55.0 up to `severe_limit` [R+1]. With 55.12 the rate is continuous at the lower breakpoint.
    severe_limit, severe_slope : float
        77.2 N/mm² and 61.9 [R+1].
    severe_branch : {"continuous", "proportional", "from_zero"}
        Rate above 77.2, for which the sources disagree [X]. "continuous": plateau + 61.9 (I - 77.2); inferred from
        61.9·77.2 = 4778.7, not seen in print. "proportional": 61.9 I. "from_zero": 61.9 I - 4778.7, which drops to 0 at
        77.2.
    density : float
        Density of steel [kg/m³], 7850 [2+].
    """

    mild_slope: float = 5.3
    mild_limit: float = 10.4
    plateau: float = 55.0
    severe_limit: float = 77.2
    severe_slope: float = 61.9
    severe_branch: SevereBranch = "continuous"
    density: float = 7850.0

    def __post_init__(self) -> None:
        for name in ("mild_slope", "mild_limit", "plateau", "severe_slope"):
            require_number(f"usfd.{name}", getattr(self, name), 0.0)
        require_number("usfd.severe_limit", self.severe_limit, self.mild_limit)
        require_number("usfd.density", self.density, 0.0, open_minimum=True)
        if self.severe_branch not in get_args(SevereBranch):
            allowed = ", ".join(get_args(SevereBranch))
            raise ContactError(f"usfd.severe_branch = {self.severe_branch!r} is unknown; allowed: {allowed}")

    def constants(self) -> NDArray[np.float64]:
        """Return the constants as the array for `usfd_kernel`."""
        intercept = {
            "continuous": self.plateau - self.severe_slope * self.severe_limit,
            "proportional": 0.0,
            "from_zero": -self.severe_slope * self.severe_limit,
        }[self.severe_branch]
        return np.array([*astuple(self)[:5], intercept, self.density])


def usfd(T_gamma: ArrayLike, area: ArrayLike, parameters: Usfd | None = None) -> float | Array:
    """Return the volume that the wheel loses per contact area and metre rolled [m³/(m² m)].

    Multiplied by `density` it is the published mass rate (1 µg/(m mm²) = 1e-3 kg/(m m²)). The area is that of the contact
    patch. The wheel loses `usfd·area` [m³] per metre rolled, spread over its circumference and the width of the patch.

    Parameters
    ----------
    T_gamma : array_like
        [N], not negative.
    area : array_like
        Contact area [m²], positive.
    parameters : Usfd
        Constants.

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        usfd_kernel,
        require_numbers("T_gamma", T_gamma, 0.0),
        require_numbers("area", area, 0.0, open_minimum=True),
        constants=((parameters or Usfd()).constants(),),
    )
