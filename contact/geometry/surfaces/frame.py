"""`Frame`: the plane of a contact, with its axes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from contact.arrays import Array

_MIRROR = np.diag([1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Frame:
    """Contact frame in track coordinates: `origin` [m] and rows x (forward), y (across), z (from the wheel into the rail)."""

    origin: Array
    axes: Array

    @classmethod
    def turned(cls, origin: Array, angle: float, pitch: float = 0.0) -> Self:
        """Return the track frame moved to `origin`, turned about x by `angle` and then forward by `pitch` [rad].

        Without a pitch it is as CONTACT's frames are (`contact.kernels.geometry.section.tilted`).
        """
        c, s, cp, sp = math.cos(angle), math.sin(angle), math.cos(pitch), math.sin(pitch)
        return cls(origin, np.array([[cp, s * sp, -c * sp], [0.0, c, s], [sp, -s * cp, c * cp]]))

    @classmethod
    def of(cls, patch: Any) -> Self:
        """Return the frame of a record `patch` of a search, with the reference point as its origin."""
        frame = cls.turned(np.array([patch.x, patch.y, patch.z]), float(patch.angle), float(patch.pitch))
        frame.origin[0] -= patch.approach * frame.axes[2, 0]  # the record has x of the wheel's point
        return frame

    @property
    def turn(self) -> tuple[float, float]:
        """Angle about x and pitch [rad]."""
        x, y, z = self.axes[2].tolist()
        return math.atan2(-y, z), math.asin(min(max(x, -1.0), 1.0))

    @property
    def mirrored(self) -> Self:
        """The frame of the mirror image."""
        return type(self)(_MIRROR @ self.origin, _MIRROR @ self.axes @ _MIRROR)
