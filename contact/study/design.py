"""The 3220 cases of Vollebregt, Iwnicki, Xie and Shackleton, Vehicle System Dynamics 50 (2012) 1-17.

The cases have five ellipses (a = 4, 6, 9, 12, 20 mm, a/b = 0.2 … 5), four spins, seven directions and twenty-three sizes of
the creepage. The numbers are those of the test bank of CONTACT 25.1 (test_table_mx11; Apache-2.0), as in theory.md 10:

    N = 82 kN,  G = 82 GPa,  nu = 0.28,  mu = 0.3,  c = √(ab),
    longitudinal + i lateral = m mu c/rho exp(i angle),   spin = chi mu/rho.

As in the source, the case without creepage (m = 0) is counted once for each direction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.inputs.material import Material

LOAD, FRICTION, MATERIAL = 82e3, 0.3, Material(shear_modulus=82e9, poisson_ratio=0.28)
#: a [m], b [m] and rho [m], the length that makes creepages dimensionless.
ELLIPSES = tuple(
    (1e-3 * a, 1e-3 * b, 1e-3 * rho)
    for a, b, rho in ((4, 20, 1772), (6, 12, 2075), (9, 9, 2700), (12, 6, 2075), (20, 4, 1772))
)
SPINS = (0.0, 0.5, 1.0, 2.0)
ANGLES = tuple(range(-90, 91, 30))
SIZES = (
    0.0,
    0.1,
    0.2,
    0.3,
    0.4,
    0.5,
    0.7,
    0.9,
    1.1,
    1.4,
    1.7,
    2.0,
    2.5,
    3.0,
    3.5,
    4.0,
    5.0,
    6.0,
    7.0,
    8.0,
    9.0,
    10.0,
    12.0,
)


@dataclass(frozen=True, slots=True)
class Design:
    """The cases. All arrays have shape (n,).

    Attributes
    ----------
    number : index in the list of 3220
    ellipse : index in `ELLIPSES`
    chi, angle, size : spin, direction [degrees] and size of the creepage, dimensionless
    longitudinal, lateral, spin : creepages [-], [-], [1/m]
    c : √(ab) [m]
    """

    number: NDArray[np.int64]
    ellipse: NDArray[np.int64]
    chi: Array
    angle: Array
    size: Array
    longitudinal: Array
    lateral: Array
    spin: Array
    c: Array

    def classes(self) -> Mapping[str, Mapping[str, NDArray[np.bool_]]]:
        """Return kind of classes → name of a class → mask of its cases."""
        return {
            "all": {"all": np.ones(self.number.size, dtype=bool)},
            "ellipse": {f"a/b = {a / b:g}": self.ellipse == k for k, (a, b, _) in enumerate(ELLIPSES)},
            "spin": {f"chi = {chi:g}": self.chi == chi for chi in SPINS},
            "creepage": {
                "m ≤ 0.5": self.size <= 0.5,
                "0.5 < m ≤ 2": (self.size > 0.5) & (self.size <= 2.0),
                "m > 2": self.size > 2.0,
            },
        }


def design(cases: int | None = None) -> Design:
    """Return all 3220 cases, or a random sample of `cases` of them. The sample is always the same, in the list's order."""
    total = len(ELLIPSES) * len(SPINS) * len(ANGLES) * len(SIZES)
    number = np.arange(total)
    if cases is not None and cases < total:
        number = np.sort(np.random.default_rng(2012).permutation(total)[:cases])
    ellipse, *places = np.unravel_index(number, (len(ELLIPSES), len(SPINS), len(ANGLES), len(SIZES)))
    chi, angle, size = (np.array(values)[k] for values, k in zip((SPINS, ANGLES, SIZES), places, strict=True))
    a, b, rho = np.array(ELLIPSES)[ellipse].T
    c = np.sqrt(a * b)
    creepage = size * FRICTION * c / rho
    turn = np.radians(angle)
    return Design(
        number,
        ellipse,
        chi,
        angle.astype(np.float64),
        size,
        creepage * np.cos(turn),
        creepage * np.sin(turn),
        chi * FRICTION / rho,
        c,
    )
