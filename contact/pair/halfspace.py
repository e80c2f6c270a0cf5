"""`HalfspacePair`: one wheel on one rail that change along the way, by the element-wise half space.

It is the reference for `contact.pair.WheelRailPair`, which solves the same surfaces on strips, as the FMU
`WheelRailSurfaces` does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from contact.errors import ContactError, require_number
from contact.friction import Friction
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.surfaces import SurfacePair, SurfacePatch
from contact.instance.ownership import one_thread, within
from contact.kernels.enumerations import Height
from contact.pair.motion import AnyPair
from contact.pair.solution import PairSolution, Solved, of_patches
from contact.pair.wheel_rail import WheelRailPair
from contact.registry import DEFAULT_TANGENTIAL
from contact.results import Status
from contact.solve import solve

#: Iteration for a vertical force with friction: largest number of steps, and tolerances relative to the force. On rough
#: surfaces the force jumps with z when the grid takes in another row, so after half of the steps the wider one counts.
_MOST_STEPS, _TOLERANCE, _WIDER = 16, 1e-4, 2e-3
_MISSED = 1e-3  # relative error of a load above which the status tells of it, as for strips


class HalfspacePair(AnyPair):
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

    pair: SurfacePair

    def __init__(self, pair: SurfacePair) -> None:
        if not isinstance(pair, SurfacePair):
            raise ContactError(f"pair = {pair!r} is not a contact.geometry.surfaces.SurfacePair")
        self.pair = pair.again()
        self._turn = self.pair._turn

    @one_thread
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
    ) -> PairSolution:
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
            For input outside its range, if the wheel does not lie above the rail, or if no z gives the force. Where the
            force jumps over a `load`, the status is NOT_CONVERGED instead.
        """
        velocity, given = velocity or Velocity(), {"load": load, "penetration": penetration, "vertical": vertical}
        if sum(amount is not None for amount in given.values()) > 1:
            raise ContactError(f"of {given} only one may be given")
        if vertical is not None:
            require_number("vertical", vertical, 0.0)
        within(self.pair.place)(pose, velocity, station=station, rotation=rotation, irregularity=irregularity)
        self.pair.doubt(pose, velocity, *((load,) if vertical is None else (vertical, "vertical")))
        if vertical is not None:
            return self._under(vertical, pose, velocity, friction)
        mode, amount = self.pair.prescribed(load, penetration)
        if mode != Height.LOAD:
            return self._solution(within(self.pair.found)(mode, amount), pose, velocity, friction)
        missed = within(self.pair.settle)(amount)
        found = self._solution(within(self.pair.found)(), pose, velocity, friction)
        return replace(found, status=Status.NOT_CONVERGED) if missed > _MISSED else found

    def _solution(
        self, patches: Sequence[SurfacePatch], pose: Pose, velocity: Velocity, friction: float | Friction
    ) -> PairSolution:
        """Return the solution of patches, which the last search has found."""
        radius = self.pair.nominal_radius
        spin = -velocity.forward / radius if velocity.spin is None else velocity.spin
        found = [self._solved(patch, velocity, friction) for patch in patches]
        return of_patches(found, pose, self.pair.z, self.pair.side, radius, spin)

    def _under(self, vertical: float, pose: Pose, velocity: Velocity, friction: float | Friction) -> PairSolution:
        """Return the solution under a vertical force.

        The normal forces carry it less the vertical part of friction, which is found by the secant method, from the force
        with friction over that without.
        """
        carried, before = vertical, None
        for step in range(_MOST_STEPS):
            within(self.pair.settle)(carried)
            found = self._solution(within(self.pair.found)(), pose, velocity, friction)
            miss = vertical - found.Q
            if abs(miss) <= (_TOLERANCE if step < _MOST_STEPS // 2 else _WIDER) * vertical:
                return found
            slope = 1.0 if before is None else (carried - before[0]) / (before[1] - miss)
            before = carried, miss
            carried = max(carried + miss * (slope if 0.2 < slope < 5.0 else 1.0), 1e-3 * vertical)
        raise ContactError(
            f"vertical = {vertical:g}: no z was found at which normal and friction forces carry it together"
        )

    def _solved(self, patch: SurfacePatch, velocity: Velocity, friction: float | Friction) -> Solved:
        """Return the patch with its solution."""
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
        return Solved(patch, found, patch.frame.axes)


def solver_for(
    pair: SurfacePair, normal: str = "halfspace", tangential: str | None = None
) -> WheelRailPair | HalfspacePair:
    """Return the element-wise reference for "halfspace", else a solver on strips, with `fastrip_mapped` by default."""
    if normal == "halfspace":
        if tangential not in (None, "halfspace"):
            raise ContactError(f"tangential = {tangential!r} is on strips; normal = 'halfspace' is not")
        return HalfspacePair(pair)
    return WheelRailPair(pair, material=pair.material, normal=normal, tangential=tangential or DEFAULT_TANGENTIAL)
