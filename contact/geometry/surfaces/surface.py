"""`RailSurface` and `WheelSurface`: surfaces that change along the track and around the wheel."""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError, require_number
from contact.geometry.shape import Profile
from contact.geometry.surfaces import files
from contact.geometry.surfaces.deviation import Deviation
from contact.geometry.surfaces.sheet import SplineSheet
from contact.geometry.surfaces.slices import SPACING, Slice, connect, positions

_FULL = 2.0 * math.pi
#: Slices of a roller on both sides of its axis, and [m] how far they reach at most.
_ROLLER_SLICES, _ROLLER_REACH = 60, 0.3
_WIDEST = (
    2.5  # a wheel is closed if the gap from its last to its first slice is at most this times the widest other one
)


class _Surface:
    """Slices and deviations. Points lie at (u, v): position of the slice, and index of a longitudinal path."""

    #: Radius of a roller where its profile has z = 0 [m]; None for a rail and a wheel.
    roller_radius: float | None = None

    def __init__(self, sheet: SplineSheet, deviations: Sequence[Deviation], name: str) -> None:
        for deviation in deviations:
            if not callable(getattr(deviation, "at", None)):
                raise ContactError(f"deviation = {deviation!r} has no method at(u)")
        self.sheet, self.deviations, self.name = sheet, tuple(deviations), name

    def with_deviations(self, *deviations: Deviation) -> Self:
        """Return this surface with `deviations` added."""
        new = object.__new__(type(self))
        _Surface.__init__(new, self.sheet, (*self.deviations, *deviations), self.name)
        new.roller_radius = self.roller_radius
        return new

    def curves(self, u: Array) -> Array:
        """Return the nodes (y, z) of the cross-sections at `u`, shape (2, k, m) [m]; NaN where the surface is absent."""
        f = self.sheet.curves(u)
        for deviation in self.deviations:
            f[1] += deviation.at(u)[0][:, None]
        return f

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        u = self.sheet.u
        return f"{type(self).__name__}({name}u = {u[0]:g} … {u[-1]:g}, {self.sheet.paths} paths" + (
            f", {len(self.deviations)} deviations)" if self.deviations else ")"
        )


class RailSurface(_Surface):
    """A rail given by slices along the track.

    The slices are connected by a tensor product of cubic splines, as in CONTACT: each slice is cut into parts at its
    features, each part is divided evenly into the same number of segments on every slice, and points of equal index form
    longitudinal paths. Before the first and after the last slice the rail is constant.

    Parameters
    ----------
    s : array_like, shape (n,)
        Positions of the slices along the track [m], strictly increasing.
    slices : sequence of n Profile or array_like of shape (k, 2)
        Points (y, z) of each slice [m], right rail: y to the field side, z down. All in the same coordinates, with their
        inclination. The number of points may differ.
    features : array_like, shape (n, f), optional
        Positions of the features on each slice, as chord length from its first point [m], increasing. NaN or a negative
        number: the feature, and the part of the surface at it, are absent on this slice. A surface that begins with a slice,
        such as a crossing nose, has its features absent on all slices before. Default: start and end of the slice.
    corners : sequence of int
        Inner features at which the tangent across the rail may jump.
    interpolating : bool
        True: the surface goes through the slices. False: the slices are control points of the splines along the track,
        which smooths them by about the weights 1, 4, 1 over 6.
    spacing : float
        Distance of the longitudinal paths [m].
    deviations : sequence of Deviation
        Such as `Wave`; added to z over the distance.
    name : str
        Name in messages.

    Raises
    ------
    ContactError
        For positions that do not increase, points or features that are not finite, of wrong shape or not in order.
    """

    def __init__(
        self,
        s: ArrayLike,
        slices: Sequence[Slice],
        *,
        features: ArrayLike | None = None,
        corners: Sequence[int] = (),
        interpolating: bool = True,
        spacing: float = SPACING,
        deviations: Sequence[Deviation] = (),
        name: str = "",
    ) -> None:
        require_number("spacing", spacing, 1e-5, 1e-2)
        u = positions("s", s)
        sheet = connect(u, slices, features, corners, interpolating=interpolating, spacing=spacing)
        _require_slices(slices, "rail")
        super().__init__(sheet, deviations, name)

    @classmethod
    def constant(cls, profile: Profile, *deviations: Deviation) -> Self:
        """Return a rail with one `profile`, and `deviations` along the track."""
        _require_kind(profile, "rail")
        return cls([0.0], [profile], deviations=deviations, name=profile.name)

    @classmethod
    def roller(cls, profile: Profile, radius: float, *, spacing: float = SPACING) -> Self:
        """Return the upper side of a roller with a rail's `profile`; s = 0 lies above its axis.

        `radius` is that where the profile has z = 0 [m], 0.05 to 10; `spacing` is the distance of the paths along it [m].
        """
        _require_kind(profile, "rail")
        R = require_number("radius", radius, 0.05, 10.0)
        if profile.z.max() >= 0.5 * R:
            raise ContactError(f"radius = {radius:g}: the profile reaches {profile.z.max():g} m down to the axis")
        reach = min(_ROLLER_REACH, 0.4 * R)
        s = np.linspace(-reach, reach, 2 * _ROLLER_SLICES + 1)
        slices = []
        for u in s.tolist():
            r = R - profile.z
            at = np.sqrt(r * r - u * u)  # the profile turned down along the circle
            slices.append(
                Profile("rail", profile.y, R - at, np.arctan2(np.sin(profile.angle) * r / at, np.cos(profile.angle)))
            )
        made = cls(s, slices, spacing=spacing, name=profile.name)
        made.roller_radius = R
        return made

    @classmethod
    def read(cls, path: str | PathLike[str], **options: Any) -> Self:
        """Return the rail in a file of slices (.slcs) of CONTACT. See `contact.geometry.surfaces.files.read_rail`."""
        return files.read_rail(path, cls, **options)


class WheelSurface(_Surface):
    """A wheel given by slices around its circumference.

    Angle theta: a point at theta lies in front of the axle's vertical plane by radius·sin(theta + rotation), with the
    `rotation` of the wheel about its axle, which decreases when rolling forward. So the lowest line is theta = -rotation.

    Parameters
    ----------
    theta : array_like, shape (n,)
        Angles of the slices [rad], strictly increasing, over less than a full turn.
    slices : sequence of n Profile or array_like of shape (k, 2)
        Points (y, z) of each slice [m], right wheel: y to the field side; z is the radius minus the nominal radius, positive
        outwards, as in a profile.
    closed : bool, optional
        Whether the last slice is connected with the first. Otherwise the wheel is constant beyond them. Default: if the gap
        between them is at most 2.5 times the widest other gap.
    features, corners, interpolating, spacing, name :
        As for `RailSurface`.
    deviations : sequence of Deviation
        Such as `Flat` and `Polygon`; added to the radius over the angle.

    Raises
    ------
    ContactError
        As for `RailSurface`; also for angles over more than one turn.
    """

    def __init__(
        self,
        theta: ArrayLike,
        slices: Sequence[Slice],
        *,
        closed: bool | None = None,
        features: ArrayLike | None = None,
        corners: Sequence[int] = (),
        interpolating: bool = True,
        spacing: float = SPACING,
        deviations: Sequence[Deviation] = (),
        name: str = "",
    ) -> None:
        require_number("spacing", spacing, 1e-5, 1e-2)
        u = positions("theta", theta)
        span = float(u[-1] - u[0])
        if span >= _FULL:
            raise ContactError(f"theta spans {span:g} rad; less than a full turn is needed")
        if closed is None:
            closed = u.size > 2 and _FULL - span <= _WIDEST * float(np.diff(u).max())
        period = _FULL if closed else None
        sheet = connect(u, slices, features, corners, interpolating=interpolating, spacing=spacing, period=period)
        _require_slices(slices, "wheel")
        super().__init__(sheet, deviations, name)

    @classmethod
    def constant(cls, profile: Profile, *deviations: Deviation) -> Self:
        """Return a wheel of revolution with one `profile`, and `deviations` around it."""
        _require_kind(profile, "wheel")
        return cls([0.0], [profile], deviations=deviations, name=profile.name)

    @classmethod
    def from_deviations(cls, theta: ArrayLike, y: ArrayLike, dr: ArrayLike, **options: object) -> Self:
        """Return a wheel with deviations `dr` of its radius from the nominal one.

        Parameters
        ----------
        theta : array_like, shape (n,)
            Angles [rad].
        y : array_like, shape (m,)
            Positions across [m], increasing or decreasing.
        dr : array_like, shape (n, m)
            Radius minus nominal radius [m]. The profile's shape is part of it.
        **options
            As for the class.
        """
        across, out = as_array("y", y), as_array("dr", dr)
        n = np.size(np.asarray(theta))
        if across.ndim != 1 or out.shape != (n, across.size):
            raise ContactError(f"dr has shape {out.shape}; ({n}, {across.size}) is needed for theta and y")
        return cls(theta, [np.stack((across, row), axis=1) for row in out], **options)  # type: ignore[arg-type]

    @classmethod
    def read(cls, path: str | PathLike[str], **options: Any) -> Self:
        """Return the wheel in a file of slices (.slcw) of CONTACT. See `contact.geometry.surfaces.files.read_wheel`."""
        return files.read_wheel(path, cls, **options)

    @property
    def middle(self) -> float:
        """Middle of the slices [rad]. An open wheel is constant beyond them."""
        return 0.5 * float(self.sheet.u[0] + self.sheet.u[-1])

    def _turned(self, u: Array) -> Array:
        """Return the angles within half a turn from the middle of the slices."""
        return np.asarray(self.middle + np.mod(u - self.middle + math.pi, _FULL) - math.pi)

    def curves(self, u: Array) -> Array:
        """Return the nodes (y, z) of the meridians at the angles `u`, shape (2, k, m) [m]."""
        return super().curves(self._turned(u))


def _require_kind(profile: object, kind: str, name: str = "profile") -> None:
    if not isinstance(profile, Profile) or profile.kind != kind:
        raise ContactError(f"{name} = {profile!r} is not a profile of a {kind}")


def _require_slices(slices: Sequence[Slice], kind: str) -> None:
    for k, one in enumerate(slices):
        if isinstance(one, Profile):
            _require_kind(one, kind, f"slices[{k}]")
