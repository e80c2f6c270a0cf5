"""Height, thickness and qR of a flange, and their limits in service."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK

_BELOW_TREAD = 10e-3  # the thickness is measured this far below the tread at the tape circle [m]
_ABOVE_TIP = 2e-3  # the other end of qR lies this far above the flange's tip [m]


@dataclass(frozen=True, kw_only=True)
class Flange:
    """Dimensions of a flange [m], or their limits.

    Parameters
    ----------
    height : float
        Sh, from the tread at the tape circle down to the tip. The limit is the largest height in service.
    thickness : float
        Sd, from the back to the face 10 mm below the tread. The limit is the least thickness.
    qR : float
        Horizontal distance from the face 10 mm below the tread to the face 2 mm above the tip. The limit is the least qR.
    """

    height: float = 36e-3
    thickness: float = 22e-3
    qR: float = 6.5e-3

    def __post_init__(self) -> None:
        for name in ("height", "thickness", "qR"):
            require_number(name, getattr(self, name), 0.0, 0.1)

    @classmethod
    def limits(cls) -> Flange:
        """Return the limits 36, 22 and 6.5 mm of wheels with diameters above 840 mm.

        The source is EN 15313, recalled, not verified (constants.md 12.4).
        """
        return cls()

    @classmethod
    def measured(cls, wheel: Profile) -> Flange:
        """Return the dimensions of a wheel profile. The flange back is taken at 70 mm from the tape circle.

        Raises
        ------
        ContactError
            If the flange's tip is not more than 12 mm below the tread.
        """
        tread = float(np.interp(0.0, wheel.y, wheel.z))
        tip = int(np.argmax(np.where(wheel.y < 0.0, wheel.z, -np.inf)))
        height = float(wheel.z[tip]) - tread
        if tip == 0 or height <= _BELOW_TREAD + _ABOVE_TIP:
            raise ContactError(f"wheel = {wheel!r} has no flange that reaches 12 mm below its tread")
        face = slice(tip, int(np.argmin(np.abs(wheel.y))))
        y, z = wheel.y[face][::-1], wheel.z[face][::-1]  # z grows towards the tip
        here, there = np.interp([tread + _BELOW_TREAD, float(wheel.z[tip]) - _ABOVE_TIP], z, y).tolist()
        return cls(height=height, thickness=here + TAPE_FROM_FLANGE_BACK, qR=here - there)

    def exceeded(self, limits: Flange) -> str:
        """Return the limits that are reached, with dimension and limit, as text; "" if none is reached."""
        reached = [
            f"{name} {1e3 * own:.2f} mm (limit {1e3 * limit:.2f} mm)"
            for name, own, limit, beyond in (
                ("flange height", self.height, limits.height, self.height >= limits.height),
                ("flange thickness", self.thickness, limits.thickness, self.thickness <= limits.thickness),
                ("qR", self.qR, limits.qR, self.qR <= limits.qR),
            )
            if beyond
        ]
        return ", ".join(reached)
