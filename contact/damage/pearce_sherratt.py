"""Tread wear from T-gamma after Pearce & Sherratt 1991."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.arrays import Array, require_numbers
from contact.damage._check import elementwise
from contact.errors import require_number
from contact.kernels.damage.pearce_sherratt import pearce_sherratt_kernel


@dataclass(frozen=True, slots=True)
class PearceSherratt:
    """Constants of the published law: area loss in mm²/km for T-gamma in N and wheel diameter D in mm.

    ======================  ==========================  =====
    T-gamma                 area loss                   mark
    ======================  ==========================  =====
    below 100 N             0.25 T-gamma/D              [R]
    100 to 200 N            25/D                        [R]
    above 200 N             (1.19 T-gamma - 154)/D      [R]
    ======================  ==========================  =====

    [R]: recalled from Pearce & Sherratt 1991 (Wear 144, 343-351); no second source was found (constants.md 1).

    Parameters
    ----------
    mild_slope, plateau, severe_slope, severe_offset : float
        0.25, 25, 1.19, 154 in the table above.
    mild_limit, severe_limit : float
        Breakpoints 100 and 200 [N].
    jump : bool
        True: as published, with a jump from 25 to 84 at 200 N. False: the severe branch starts where it meets the plateau,
        at 150.4 N. The law is then continuous, but this variant is not published.
    """

    mild_slope: float = 0.25
    plateau: float = 25.0
    severe_slope: float = 1.19
    severe_offset: float = 154.0
    mild_limit: float = 100.0
    severe_limit: float = 200.0
    jump: bool = True

    def __post_init__(self) -> None:
        for name in ("mild_slope", "plateau", "severe_slope", "severe_offset", "mild_limit"):
            require_number(f"pearce_sherratt.{name}", getattr(self, name), 0.0)
        require_number("pearce_sherratt.severe_limit", self.severe_limit, self.mild_limit)

    def constants(self) -> NDArray[np.float64]:
        """Return the constants as the array for `pearce_sherratt_kernel`."""
        severe_from = self.severe_limit if self.jump else self.mild_limit
        floor = 0.0 if self.jump else self.plateau
        return np.array([*astuple(self)[:5], severe_from, floor])


def pearce_sherratt(
    T_gamma: ArrayLike, wheel_diameter: ArrayLike = 0.92, parameters: PearceSherratt | None = None
) -> float | Array:
    """Return the cross-section area that the tread loses per metre rolled [m²/m].

    The published unit 1 mm²/km is 1e-9 m²/m.

    Parameters
    ----------
    T_gamma : array_like
        [N], not negative.
    wheel_diameter : array_like
        [m], positive.
    parameters : PearceSherratt
        Constants; default as published (recalled).

    Raises
    ------
    ContactError
        For values outside their range.
    """
    return elementwise(
        pearce_sherratt_kernel,
        require_numbers("T_gamma", T_gamma, 0.0),
        require_numbers("wheel_diameter", wheel_diameter, 0.0, open_minimum=True),
        constants=((parameters or PearceSherratt()).constants(),),
    )
