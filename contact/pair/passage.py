"""A wheel that rolls along a rail, either of which may change along the way: one solution at each of many stations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry.records import Pose, Velocity
from contact.geometry.surfaces import SurfacePair
from contact.pair.halfspace import HalfspacePair, SurfaceContact, SurfaceSolution
from contact.pair.wheel_rail import Contact, PairSolution, WheelRailPair
from contact.registry import DEFAULT_TANGENTIAL

Array = NDArray[np.float64]

MOST_STATIONS = 100_000
_OF_PATCH = ("angle", "approach", "N", "Fx", "Fy", "Mz", "max_pressure", "area", "gap_error")


@dataclass(frozen=True, slots=True, eq=False)
class Passage:
    """Solutions along the way.

    Attributes
    ----------
    station : positions of the axle along the rail [m], shape (n,)
    rotation : angles of the wheel [rad], shape (n,)
    solutions : one for each station
    """

    station: Array
    rotation: Array
    solutions: tuple[SurfaceSolution | PairSolution, ...]

    def columns(self) -> dict[str, Array]:
        """Return the results of the whole wheel by name, in SI units: forces on the wheel, sums and maxima over patches."""
        all_ = self.solutions
        forces = np.array([one.force for one in all_])
        return {
            "station": self.station,
            "rotation": self.rotation,
            "z": np.array([one.z for one in all_]),
            "Q": np.array([one.Q for one in all_]),
            "Y": np.array([one.Y for one in all_]),
            "Fx": forces[:, 0],
            "patches": np.array([float(len(one.contacts)) for one in all_]),
            "max_pressure": np.array([one.max_pressure for one in all_]),
            "power_per_metre": np.array([one.power_per_metre for one in all_]),
            "gap_error": np.array([one.gap_error for one in all_]),
            "status": np.array([float(one.status) for one in all_]),
        }

    def rows(self) -> list[dict[str, Any]]:
        """Return one row for each patch, in SI units: place, angle, normal and creep forces in its frame, quality."""
        rows = []
        for station, rotation, one in zip(self.station.tolist(), self.rotation.tolist(), self.solutions, strict=True):
            contacts: Sequence[Contact | SurfaceContact] = one.contacts
            for k, contact in enumerate(contacts):
                x, y, z = contact.position
                row = {"station": station, "rotation": rotation, "wheel_z": one.z, "patch": k, "x": x, "y": y, "z": z}
                row |= {name: getattr(contact, name) for name in _OF_PATCH}
                row["status"] = int(contact.status)
                rows.append(row)
        return rows


def solver_for(
    pair: SurfacePair, normal: str = "halfspace", tangential: str | None = None
) -> WheelRailPair | HalfspacePair:
    """Return the element-wise reference for "halfspace", else a solver on strips, with `fastrip_mapped` by default."""
    if normal == "halfspace":
        if tangential not in (None, "halfspace"):
            raise ContactError(f"tangential = {tangential!r} is on strips; normal = 'halfspace' is not")
        return HalfspacePair(pair)
    return WheelRailPair(pair, material=pair.material, normal=normal, tangential=tangential or DEFAULT_TANGENTIAL)


def passage(
    solver: WheelRailPair | HalfspacePair,
    stations: ArrayLike | Sequence[float],
    pose: Pose | None = None,
    velocity: Velocity | None = None,
    *,
    rotation: float = 0.0,
    load: float | None = None,
    penetration: float | None = None,
    vertical: float | None = None,
    friction: float | Friction = 0.3,
) -> Passage:
    """Return the solutions of a wheel at many stations, quasi-statically and without the memory of rolling.

    Parameters
    ----------
    solver : WheelRailPair or HalfspacePair
        The first solves on strips and is fast, the second is the reference.
    stations : array_like, shape (n,)
        Positions of the axle along the rail [m], in any order.
    pose, velocity, load, penetration, vertical, friction :
        As for `WheelRailPair.solve`.
    rotation : float
        Angle of the wheel at the first station [rad]. It rolls on with the nominal radius.

    Returns
    -------
    Passage

    Raises
    ------
    ContactError
        For invalid stations, and as `WheelRailPair.solve`; the message then names the station.
    """
    try:
        along = np.array(stations, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ContactError("stations is not an array of numbers") from None
    if along.ndim != 1 or not 1 <= along.size <= MOST_STATIONS or not np.isfinite(along).all():
        raise ContactError(f"stations has shape {along.shape}; 1 to {MOST_STATIONS} finite positions are needed")
    turned = require_number("rotation", rotation) - (along - along[0]) / solver.pair.nominal_radius
    found = []
    for station, angle in zip(along.tolist(), turned.tolist(), strict=True):
        try:
            found.append(
                solver.solve(
                    pose or Pose(),
                    velocity,
                    station=station,
                    rotation=angle,
                    load=load,
                    penetration=penetration,
                    vertical=vertical,
                    friction=friction,
                )
            )
        except ContactError as error:
            raise ContactError(f"at station {station:g} m: {error}") from None
    return Passage(along, turned, tuple(found))
