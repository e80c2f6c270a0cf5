"""`StressField`: stress tensors at points below the surface, and what follows from them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact.arrays import Array, brief
from contact.errors import ContactError, suggestion

#: Names of the scalars of which `StressField.peak` and `contact.stress.largest` return the largest value.
CRITERIA = ("von_mises", "tresca", "largest_principal", "shear_xz", "shear_yz")


@dataclass(frozen=True, slots=True)
class Peak:
    """Largest `value` [Pa] of a scalar, at the place `x`, `y` and the depth `z` [m]."""

    value: float
    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True, eq=False)
class StressField:
    """Stress tensors at points below the surface; all arrays have the same shape.

    The axes are those of the solution: x in the rolling direction, y lateral, z along the normal from the wheel into the
    rail. Tension is positive.

    Attributes
    ----------
    x, y : places [m]
    z : depths below the surface of the body [m], 0 on the surface, positive in both bodies
    xx, yy, zz, xy, xz, yz : stresses [Pa]
    body : "rail" or "wheel"
    """

    x: Array
    y: Array
    z: Array
    xx: Array
    yy: Array
    zz: Array
    xy: Array
    xz: Array
    yz: Array
    body: str

    __repr__ = brief

    @property
    def tensor(self) -> Array:
        """Stress tensors [Pa], shape (…, 3, 3)."""
        rows = (self.xx, self.xy, self.xz), (self.xy, self.yy, self.yz), (self.xz, self.yz, self.zz)
        return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

    @property
    def hydrostatic(self) -> Array:
        """A third of the trace [Pa]."""
        return (self.xx + self.yy + self.zz) / 3.0

    @property
    def von_mises(self) -> Array:
        """Equivalent stress of von Mises [Pa]: the yield stress in tension when the material yields."""
        normal = (self.xx - self.yy) ** 2 + (self.yy - self.zz) ** 2 + (self.zz - self.xx) ** 2
        shear = self.xy**2 + self.xz**2 + self.yz**2
        return np.asarray(np.sqrt(0.5 * normal + 3.0 * shear))

    @property
    def principal(self) -> Array:
        """Principal stresses [Pa], shape (…, 3), the largest first."""
        return np.asarray(np.linalg.eigvalsh(self.tensor)[..., ::-1], dtype=np.float64)

    @property
    def largest_principal(self) -> Array:
        """Largest principal stress [Pa]; positive where the material is pulled."""
        return self.principal[..., 0]

    @property
    def tresca(self) -> Array:
        """Equivalent stress of Tresca [Pa]: largest minus smallest principal stress, twice the largest shear."""
        principal = self.principal
        return np.asarray(principal[..., 0] - principal[..., 2])

    @property
    def shear_xz(self) -> Array:
        """Absolute value of the orthogonal shear stress xz [Pa]."""
        return np.abs(self.xz)

    @property
    def shear_yz(self) -> Array:
        """Absolute value of the orthogonal shear stress yz [Pa]."""
        return np.abs(self.yz)

    def peak(self, criterion: str = "von_mises") -> Peak:
        """Return the largest value of one of `CRITERIA` over the points of this field, and its place."""
        values = getattr(self, require_criterion(criterion))
        if values.size == 0:
            raise ContactError("the field has no point")
        k = np.unravel_index(int(np.argmax(values)), values.shape)
        return Peak(*(float(v[k]) for v in (values, self.x, self.y, self.z)))


def require_criterion(criterion: str) -> str:
    """Return `criterion`, or raise a ContactError if it is not one of `CRITERIA`."""
    if criterion not in CRITERIA:
        raise ContactError(
            f"criterion = {criterion!r} is unknown{suggestion(criterion, CRITERIA)}; allowed: {', '.join(CRITERIA)}"
        )
    return criterion
