"""`WheelRailSurfaces`: forces of one wheel on one rail, either of which may change along the way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.search import Scene
from contact.solution import Solution, Status
from contact.solve import solve

Array = NDArray[np.float64]

_MOST_STEPS, _TOLERANCE = 20, 1e-4  # of the iteration for a vertical force with friction, relative to the force


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceContact:
    """One patch and its solution.

    Attributes
    ----------
    patch : SurfacePatch
    solution : contact.Solution
        In the patch's frame; forces act on the wheel.
    force : force on the wheel in track coordinates [N], shape (3,)
    moment : moment of pressure and traction on the wheel about `patch.wheel_position`, in track coordinates [N m], shape (3,)
    """

    patch: SurfacePatch
    solution: Solution
    force: Array
    moment: Array


@dataclass(frozen=True, slots=True, eq=False)
class SurfaceSolution:
    """Action of one rail on the wheelset, in track coordinates.

    Attributes
    ----------
    force : (x, y, z) on the wheel [N]
    moment : about the wheelset's centre (0, pose.y, z - nominal radius) [N m]
    Q : vertical force of the wheel on the rail, positive down [N]
    Y : lateral force of the wheel on the rail, positive outwards [N]
    z : pose.z, as given or as found [m]
    contacts : all patches, from the field side to the flange
    status : the gravest status of the patches; NO_CONTACT without a patch
    """

    force: Array
    moment: Array
    Q: float
    Y: float
    z: float
    contacts: tuple[SurfaceContact, ...]
    status: Status

    @property
    def max_pressure(self) -> float:
        """Largest pressure of all patches [Pa]."""
        return max((contact.solution.max_pressure for contact in self.contacts), default=0.0)

    @property
    def power_per_metre(self) -> float:
        """Frictional energy per metre rolled, sum over the patches [N]."""
        return sum(contact.solution.power_per_metre for contact in self.contacts)


class WheelRailSurfaces:
    """One wheel rolling on one rail that may both change along the way.

    Parameters
    ----------
    pair : SurfacePair
        Surfaces, side, gauge, elements and material.

    Notes
    -----
    Each patch is solved with the element-wise half space on its own gap, by NORM and TANG, at steady rolling: what has
    happened before the present pose does not count.
    """

    def __init__(self, pair: SurfacePair) -> None:
        if not isinstance(pair, SurfacePair):
            raise ContactError(f"pair = {pair!r} is not a contact.geometry.surfaces.SurfacePair")
        self.pair = pair

    def solve(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
        load: float | None = None,
        penetration: float | None = None,
        vertical: float | None = None,
        irregularity: Irregularity | None = None,
        friction: float | Friction = 0.3,
    ) -> SurfaceSolution:
        """Find and solve all patches at one instant.

        Parameters
        ----------
        pose, velocity, station, rotation, load, penetration, irregularity :
            As for `SurfacePair.contacts`. The normal forces alone carry `load`.
        vertical : float
            Vertical force on the wheel [N] ≥ 0 that normal and friction forces carry together, instead of `load` and
            `penetration`.
        friction : float or contact.friction.Friction
            Coulomb's coefficient mu ≥ 0 [-], or a friction law.

        Raises
        ------
        ContactError
            For input outside its range, if the wheel does not lie above the rail, or if no z gives the force.
        """
        velocity = velocity or Velocity()
        if vertical is None:
            patches = self.pair.contacts(
                pose,
                velocity,
                station=station,
                rotation=rotation,
                load=load,
                penetration=penetration,
                irregularity=irregularity,
            )
            return self._total(pose, [self._solved(patch, velocity, friction) for patch in patches])
        if load is not None or penetration is not None:
            raise ContactError(f"vertical = {vertical} excludes load = {load} and penetration = {penetration}")
        amount = require_number("vertical", vertical, 0.0)
        return self._under(amount, pose, velocity, friction, self.pair.scene(pose, station, rotation, irregularity))

    def _under(
        self, vertical: float, pose: Pose, velocity: Velocity, friction: float | Friction, scene: Scene
    ) -> SurfaceSolution:
        """Return the solution under a vertical force: normal forces carry it less the friction of the last step."""
        carried = vertical
        for _ in range(_MOST_STEPS):
            self.pair.z = self.pair.settle(scene, carried, lambda z: self.pair.carried(scene, z))
            patches = self.pair.patches(scene, self.pair.z, velocity)
            found = self._total(pose, [self._solved(patch, velocity, friction) for patch in patches])
            if abs(found.Q - vertical) <= _TOLERANCE * vertical:
                return found
            carried = max(carried + vertical - found.Q, 1e-3 * vertical)
        raise ContactError(
            f"vertical = {vertical:g}: no z was found at which normal and friction forces carry it together"
        )

    def _solved(self, patch: SurfacePatch, velocity: Velocity, friction: float | Friction) -> SurfaceContact:
        found = solve(
            patch.gap,
            patch.creepage,
            approach=patch.approach,
            friction=friction,
            material=self.pair.material,
            speed=velocity.forward,
            normal="halfspace",
            tangential="halfspace",
            throw=False,
        )
        pressing = found.p * found.dA
        tipping = np.array([-(found.y * pressing).sum(), (found.x * pressing).sum(), found.Mz])
        axes = patch.frame.axes
        return SurfaceContact(patch, found, np.array([found.Fx, found.Fy, -found.N]) @ axes, tipping @ axes)

    def _total(self, pose: Pose, contacts: list[SurfaceContact]) -> SurfaceSolution:
        z = self.pair.z
        centre = np.array([0.0, pose.y, z - self.pair.nominal_radius])
        force, moment = np.zeros(3), np.zeros(3)
        for contact in contacts:
            force += contact.force
            moment += contact.moment + np.cross(np.array(contact.patch.wheel_position) - centre, contact.force)
        outwards = 1.0 if self.pair.side == "right" else -1.0
        states = [contact.solution.status for contact in contacts]
        return SurfaceSolution(
            force=force,
            moment=moment,
            Q=-float(force[2]),
            Y=-outwards * float(force[1]),
            z=z,
            contacts=tuple(contacts),
            status=max(states, key=int, default=Status.NO_CONTACT),
        )
