"""Fatigue below the surface, accumulated over the cross-section of a profile by Dang Van's criterion (subsurface.md)."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import as_array
from contact.errors import ContactError, require_number
from contact.geometry.profile import Profile
from contact.geometry.records import Patch
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.damage import deposit
from contact.kernels.rows import Strip
from contact.results import Solution
from contact.stress import Endurance, SurfaceLoad, dang_van

#: Elements along each side onto which a solution on strips is put.
_N_SIDE = 32
#: A patch may lie this far from the profile [m].
_OFF = 1e-4


class Worst(NamedTuple):
    """The largest damage [-] and its place: arc length and depth [m]."""

    damage: float
    arc: float
    depth: float


class Section(OwnsArrays):
    """Miner's sum of Dang Van's equivalent stress over arc length and depth of a profile.

    A passage takes the share ``endurance.damage(τ_DV)`` of the life of every point that it stresses; at 1 fatigue is expected.

    Parameters
    ----------
    profile : contact.geometry.profile.Profile
        Wheel or rail.
    endurance : contact.stress.Endurance
    depths : array_like, shape (nz,)
        Depths below the surface [m] ≥ 0, increasing.
    width : float
        Width of a bin of the arc length [m], 1e-5 to 1e-2.
    slope, residual : float
        As in `contact.stress.dang_van`.

    Attributes
    ----------
    centres, depths : ndarray, shape (n,), (nz,)
        Arc length of the middle of each bin, from the profile's point nearest to y = 0, and depths [m].
    damage : ndarray, shape (nz, n)
        Miner's sum so far [-].
    passages : passages so far

    Raises
    ------
    ContactError
        For arguments outside their range.
    """

    def __init__(
        self,
        profile: Profile,
        endurance: Endurance,
        depths: ArrayLike,
        *,
        width: float = 1e-3,
        slope: float = 1.0 / 3.0,
        residual: float = 0.0,
    ) -> None:
        if not isinstance(profile, Profile):
            raise ContactError(f"profile = {profile!r} is not a contact.geometry.profile.Profile")
        if not isinstance(endurance, Endurance):
            raise ContactError(f"endurance = {endurance!r} is not a contact.stress.Endurance")
        self.profile, self.endurance = profile, endurance
        self.depths = as_array("depths", depths)
        if self.depths.ndim != 1 or self.depths.size == 0 or not (np.diff(self.depths, prepend=-1e-300) > 0.0).all():
            raise ContactError("depths must be one or more depths ≥ 0 [m] that increase")
        width = require_number("width", width, 1e-5, 1e-2)
        self._slope, self._residual = require_number("slope", slope, 0.0, 3.0), require_number("residual", residual)
        self._rows = np.stack((profile.y, profile.z))
        self._arc = np.empty(profile.y.size)
        deposit.arc_length(self._rows, self._arc)
        first, last = math.floor(self._arc[0] / width), math.ceil(self._arc[-1] / width)
        self.centres = width * (np.arange(first, last) + 0.5)
        self.damage = np.zeros((self.depths.size, self.centres.size))
        self.passages = 0.0

    def _kept(self) -> Any:
        return self.damage.copy(), self.passages

    def _keep(self, kept: Any) -> None:
        self.damage, self.passages = kept

    @one_thread
    def add(self, patch: Patch, solution: Solution, passages: float = 1.0) -> None:
        """Add `passages` ≥ 0 of a contact. A wheel has one in 2π·radius of distance, a rail one for each wheel.

        Raises
        ------
        ContactError
            Without contact or fields, or for a patch that does not lie on the profile.
        """
        passages = require_number("passages", passages, 0.0)
        load, nu = SurfaceLoad.of(solution, _N_SIDE), solution.material.poisson_ratio
        kind = self.profile.kind
        found = dang_van(
            load, self.depths, slope=self._slope, residual=self._residual, body=kind, poisson_ratio=nu, margin=0.5
        )
        across = found.y[0]
        strips, edges = np.zeros((len(Strip), across.size)), np.empty((2, across.size))
        strips[Strip.Y], strips[Strip.DY] = across, load.steps[1]
        y, z = patch.on_wheel if kind == "wheel" else patch.on_rail
        mirror = math.copysign(1.0, patch.position[1])
        off = deposit.place(self._rows, self._arc, (y, z), patch.angle, mirror, strips, across.size, edges)
        if off > _OFF:
            raise ContactError(
                f"patch.on_{kind} = ({y:g}, {z:g}) does not lie on {self.profile!r}; was it found with another profile?"
            )
        middle = edges.mean(axis=0)
        order = np.argsort(middle)
        share = self.endurance.damage(found.equivalent)
        for sum_, row in zip(self.damage, share, strict=True):
            sum_ += passages * patch.share * np.interp(self.centres, middle[order], row[order], left=0.0, right=0.0)
        self.passages += passages

    @property
    def worst(self) -> Worst:
        """The largest damage and its place."""
        i, j = (int(k) for k in np.unravel_index(int(np.argmax(self.damage)), self.damage.shape))
        return Worst(float(self.damage[i, j]), float(self.centres[j]), float(self.depths[i]))
