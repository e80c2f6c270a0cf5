"""The record of a profile: the outline of a wheel or a rail as points with their tangents.

Convention (right wheel and right rail, seen from behind): y to the field side, z down, in metres. A wheel has its tape
circle at y = 0, z = 0 and its flange at negative y. A rail has its gauge corner at negative y. The left side is the mirror
image and uses the same record.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from html import escape
from typing import Any

import numpy as np

from contact.arrays import Array, as_array
from contact.errors import ContactError, require_number, warn
from contact.geometry import inspection
from contact.geometry.inspection import Kind as Kind
from contact.geometry.outline import spline_slopes
from contact.view.notebook import Sketch, figures


@dataclass(frozen=True, eq=False)
class Profile:
    """Outline of a wheel or a rail as points with their tangent angles.

    Parameters
    ----------
    kind : {"wheel", "rail"}
    y, z : array_like, shape (n,), n >= 4
        Points from the gauge or flange side to the field side [m]; y to the field side, z down.
    angle : array_like, shape (n,), optional
        Angle of the tangent, tan(angle) = dz/dy [rad]. Default: the tangents of a cubic spline over the chord length.
    name : str
        Name in plots and messages.
    note : str
        What was done to the points when they were read, as a caption of pictures.

    Raises
    ------
    ContactError
        For wrong shapes, values that are not finite, fewer than four points, or coincident neighbours.

    Warns
    -----
    PlausibilityWarning
        For points that lie upside down or mirrored, have the shape of the other kind, or the width of another unit.
    """

    kind: Kind
    y: Array
    z: Array
    angle: Array = field(default=None, repr=False)  # type: ignore[arg-type]
    name: str = ""
    note: str = field(default="", repr=False)

    def __post_init__(self) -> None:
        if self.kind not in ("wheel", "rail"):
            raise ContactError(f"profile.kind = {self.kind!r} is neither 'wheel' nor 'rail'")
        y, z = _points("y", self.y), _points("z", self.z)
        if y.size != z.size or y.size < 4:
            raise ContactError(
                f"profile has {y.size} values of y and {z.size} of z; equally many, at least 4, are needed"
            )
        chord = np.hypot(np.diff(y), np.diff(z))
        if not (chord > 0.0).all():
            i = int(np.argmin(chord))
            raise ContactError(f"profile points {i} and {i + 1} coincide at y = {y[i]:g} m")
        angle = _spline_angles(y, z, chord) if self.angle is None else _points("angle", self.angle)
        if angle.size != y.size:
            raise ContactError(f"profile has {angle.size} angles for {y.size} points")
        for name, array in (("y", y), ("z", z), ("angle", angle)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        if fault := inspection.misplaced(np.column_stack((y, z)), self.kind):
            warn(f"profile {self.name!r}: {fault[0]}; {fault[2]}" if self.name else f"profile: {fault[0]}; {fault[2]}")
        elif y[0] > y[-1]:
            warn("profile: y falls from the first point to the last; give the points from the flange or gauge side on")

    def rotated(self, roll: float) -> Profile:
        """Return the profile rotated about the x axis through its origin by `roll` [rad], positive from y towards z."""
        c, s = math.cos(require_number("roll", roll, -1.0, 1.0)), math.sin(roll)
        return Profile(
            self.kind, c * self.y - s * self.z, s * self.y + c * self.z, self.angle + roll, self.name, self.note
        )

    def plot(self, *others: Profile) -> Any:
        """Return a figure of the outline, its tangent and its curvature, with `others` for comparison (matplotlib's Figure)."""
        return figures().profiles(self, *others)

    def _repr_html_(self) -> str:
        """Return HTML with a sketch of the outline, for a notebook."""
        y, up = 1e3 * self.y, -1e3 * self.z
        labels = "y, to the field side [mm]", "−z, up [mm]"
        drawn = Sketch((y.min(), y.max()), (up.min(), up.max()), labels, f"outline of the {self.kind}", equal=True)
        drawn.curve(y, up)
        told = f"{self!r}; {self.note}" if self.note else repr(self)
        return f"{drawn.svg()}<div>{escape(told)}</div>"

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        return f"Profile({self.kind!r}, {name}{self.y.size} points, y = {self.y[0]:g} … {self.y[-1]:g} m)"


def _points(name: str, values: object) -> Array:
    """Return a finite one-dimensional float64 copy."""
    array = as_array(f"profile.{name}", values)
    if array.ndim != 1 or not np.isfinite(array).all():
        raise ContactError(f"profile.{name} must be one-dimensional and finite; its shape is {array.shape}")
    return array


def _spline_angles(y: Array, z: Array, chord: Array) -> Array:
    """Return tangent angles [rad] of the C² cubic spline (y, z) over the chord length. The end segments are parabolas."""
    u = np.concatenate(([0.0], np.cumsum(chord)))
    return np.unwrap(np.arctan2(spline_slopes(u, z), spline_slopes(u, y)))
