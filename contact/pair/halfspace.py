"""`HalfspacePair`: one wheel on one rail that change along the way, by the element-wise half space.

It is the reference for `contact.pair.WheelRailPair`, which solves the same surfaces on strips, as the FMU
`WheelRailSurfaces` does."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry.posed import MAX_PENETRATION
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.geometry.surfaces.search import Scene
from contact.solution import Solution, Status
from contact.solve import solve

Array = NDArray[np.float64]

#: Iteration for a vertical force with friction: largest number of steps, and tolerances relative to the force. On rough
#: surfaces the force jumps with z when the grid takes in another row, so after half of the steps the wider one counts.
_MOST_STEPS, _TOLERANCE, _WIDER = 16, 1e-4, 2e-3


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

    @property
    def N(self) -> float:
        """Normal force [N]; as the following, under the name of `contact.pair.Contact`."""
        return self.solution.N

    @property
    def Fx(self) -> float:
        """Longitudinal creep force [N]."""
        return self.solution.Fx

    @property
    def Fy(self) -> float:
        """Lateral creep force [N]."""
        return self.solution.Fy

    @property
    def Mz(self) -> float:
        """Spin moment [N m]."""
        return self.solution.Mz

    @property
    def area(self) -> float:
        """Contact area [m²]."""
        return self.solution.area

    @property
    def max_pressure(self) -> float:
        """Largest pressure [Pa]."""
        return self.solution.max_pressure

    @property
    def status(self) -> Status:
        """Status of the solution."""
        return self.solution.status

    @property
    def gap_error(self) -> float:
        """0: the half space solves the gap itself."""
        return 0.0

    @property
    def position(self) -> tuple[float, float, float]:
        """Point of the wheel opposite the reference point, (x, y, z) [m]."""
        return self.patch.wheel_position

    @property
    def angle(self) -> float:
        """Contact angle [rad]."""
        return self.patch.angle

    @property
    def approach(self) -> float:
        """Depth of the interpenetration [m]."""
        return self.patch.approach


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
    def gap_error(self) -> float:
        """0: the half space solves the gap itself."""
        return 0.0

    @property
    def power_per_metre(self) -> float:
        """Frictional energy per metre rolled, sum over the patches [N]."""
        return sum(contact.solution.power_per_metre for contact in self.contacts)


class HalfspacePair:
    """One wheel rolling on one rail that may both change along the way.

    Parameters
    ----------
    pair : SurfacePair
        Surfaces, side, gauge, elements and material. Each patch is solved on its own gap, by NORM and TANG.

    Notes
    -----
    Rolling is steady: what has happened before the present pose does not count.

    Raises
    ------
    ContactError
        If `pair` is no SurfacePair.
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
        velocity, given = velocity or Velocity(), {"load": load, "penetration": penetration, "vertical": vertical}
        if sum(amount is not None for amount in given.values()) > 1:
            raise ContactError(f"of {given} only one may be given")
        scene = self.pair.scene(pose, station, rotation, irregularity)
        if vertical is not None:
            return self._under(require_number("vertical", vertical, 0.0), pose, velocity, friction, scene)
        z = pose.z
        if load is not None:
            z = self._settled(scene, require_number("load", load, 0.0))
        elif penetration is not None:
            z = scene.touch() + require_number("penetration", penetration, 0.0, MAX_PENETRATION)
        return self._at(z, scene, pose, velocity, friction)

    def _settled(self, scene: Scene, load: float) -> float:
        """Return z [m] at which the pressures carry a vertical load."""
        return self.pair.settle(scene, load, lambda z: self.pair.carried(scene, z))

    def _at(
        self, z: float, scene: Scene, pose: Pose, velocity: Velocity, friction: float | Friction
    ) -> SurfaceSolution:
        """Return the solution at the height z [m]."""
        patches = self.pair.patches(scene, z, velocity)
        return self._total(z, pose, [self._solved(patch, velocity, friction) for patch in patches])

    def _under(
        self, vertical: float, pose: Pose, velocity: Velocity, friction: float | Friction, scene: Scene
    ) -> SurfaceSolution:
        """Return the solution under a vertical force.

        The normal forces carry it less the vertical part of friction, which is found by the secant method, from the force
        with friction over that without.
        """
        carried, before = vertical, None
        for step in range(_MOST_STEPS):
            found = self._at(self._settled(scene, carried), scene, pose, velocity, friction)
            miss = vertical - found.Q
            if abs(miss) <= (_TOLERANCE if step < _MOST_STEPS // 2 else _WIDER) * vertical:
                return found
            slope = 1.0 if before is None else (carried - before[0]) / (before[1] - miss)
            before = carried, miss
            carried = max(carried + miss * (slope if 0.2 < slope < 5.0 else 1.0), 1e-3 * vertical)
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
            throw=False,
            normal="halfspace",
            tangential="halfspace",
        )
        pressing = found.p * found.dA
        tipping = np.array([-(found.y * pressing).sum(), (found.x * pressing).sum(), found.Mz])
        axes = patch.frame.axes
        return SurfaceContact(patch, found, np.array([found.Fx, found.Fy, -found.N]) @ axes, tipping @ axes)

    def _total(self, z: float, pose: Pose, contacts: list[SurfaceContact]) -> SurfaceSolution:
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
