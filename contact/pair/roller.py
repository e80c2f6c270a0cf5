"""A wheel on a roller of a test rig: curvature of the roller, creepages and forces (other_wheels.md).

The axle of the roller lies fixed at its radius R under the track plane; the rail profile is turned on it. A point of the
profile at the height z (down) has the radius r_r = R - z. In the plane of a patch with the contact angle δ the gap gets the
roller's curvature,

    A (x - x_c)² + A_r (x_p + x)²,   A_r = cos δ/(2 r_r),

where the patch lies x_p ahead of the axles, as under yaw. On the roller it then lies at x_p A/(A + A_r), which becomes the
origin of x. There the lateral creepage is that at x_p on a rail: the wheel's surface falls less by ω_w, the roller's more by
ω_r.

The surfaces move with V_r = ω_r r_r and V_w = -ω_w r_w, and creepages refer to V = (V_r + V_w)/2. Spin of the roller's
surface is -ω_r sin δ. If the wheelset stands x_w ahead of the roller, the line through both axles is inclined by
x_w/(r_r + r_w), and the wheel lies x_w²/(2 (r_r + r_w)) deeper.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction
from contact.geometry.posed import require_motion
from contact.geometry.records import Patch, Pose, Velocity
from contact.geometry.surfaces.frame import Frame
from contact.geometry.wheelset import Pair
from contact.given_force import rising_root
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.inputs.separation import Separation
from contact.instance.ownership import one_thread, within
from contact.pair.motion import AnyPair
from contact.pair.solution import PairSolution, Solved, of_patches
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from contact.solve import solve

#: Search of the penetration under a load: where it starts, its end [m], the shortest bracket [m], and the error of the load.
_START, _DEEPEST, _SHORTEST, _TOLERANCE = 5e-5, 2e-3, 1e-12, 1e-6


class RollerRig(AnyPair):
    """One wheel on one roller.

    Parameters
    ----------
    pair : contact.geometry.wheelset.Pair
        Profiles, side, gauge, …; the rail profile is that of the roller.
    radius : float
        Radius of the roller where the rail profile has z = 0 [m], 0.05 to 10.
    offset : float
        Distance of the wheelset's axle ahead of the roller's axle [m], within a tenth of the radius.
    material, normal, tangential, n_strips, n_elements
        As in `contact.solve`.

    Attributes
    ----------
    inclination : float
        Of the line through both axles [rad]; 0 without offset. Forces are in track coordinates turned with it.

    Raises
    ------
    ContactError
        For arguments outside their range.
    """

    pair: Pair

    def __init__(
        self,
        pair: Pair,
        radius: float,
        *,
        offset: float = 0.0,
        material: Material = STEEL,
        normal: str = DEFAULT_NORMAL,
        tangential: str = DEFAULT_TANGENTIAL,
        n_strips: int = N_STRIPS.usual,
        n_elements: int = N_ELEMENTS.usual,
    ) -> None:
        if not isinstance(pair, Pair):
            raise ContactError(f"pair = {pair!r} is not a contact.geometry.wheelset.Pair")
        self.pair = pair.again()
        self.take_turns_with(self.pair)
        self.radius = require_number("radius", radius, 0.05, 10.0)
        self.offset = require_number("offset", offset, -0.1 * radius, 0.1 * radius)
        between = self.radius + pair.nominal_radius
        self.inclination, self._lower = self.offset / between, 0.5 * self.offset**2 / between
        self._options: dict[str, Any] = {"material": material, "normal": normal, "tangential": tangential}
        self._options |= {"n_strips": n_strips, "n_elements": n_elements}

    @one_thread
    def contacts(self, pose: Pose, velocity: Velocity, *, penetration: float | None = None) -> tuple[Patch, ...]:
        """Return the patches on the roller. `velocity.forward` is the speed of the roller's surface at `radius` [m/s]."""
        require_motion(pose, velocity)
        found = within(self.pair.contacts)(replace(pose, z=pose.z - self._lower), velocity, penetration=penetration)
        return tuple(self._on_roller(patch, velocity) for patch in found)

    @one_thread
    def solve(
        self,
        pose: Pose,
        velocity: Velocity,
        *,
        load: float | None = None,
        vertical: float | None = None,
        friction: float | Friction = 0.3,
    ) -> PairSolution:
        """Find and solve all patches.

        Parameters
        ----------
        pose : Pose
            Of the wheelset; `z` is found under a load.
        velocity : Velocity
            `forward` is the speed of the roller's surface at its radius [m/s], positive. `spin` is that of the wheel
            [rad/s], negative; the other rates are those of the wheelset.
        load : float
            Vertical load of the wheel [N], positive, that the normal forces alone carry; default: `pose.z` is given.
        vertical : float
            Instead: vertical force on the wheel [N], positive, that normal and friction forces carry together.
        friction : float or contact.friction.Friction

        Returns
        -------
        PairSolution

        Raises
        ------
        ContactError
            For arguments outside their range, or if no height gives the force.
        """
        require_motion(pose, velocity)
        require_number("velocity.forward", velocity.forward, 0.0, open_minimum=True)
        surface = as_friction(friction)
        if load is not None and vertical is not None:
            raise ContactError(f"vertical = {vertical} excludes load = {load}")
        found: PairSolution | None = None
        if load is None and vertical is None:
            found = self._at(pose, velocity, surface)
            self.pair.doubt(pose, velocity, None)  # `contact.solve` doubts the friction
            return found
        name, given = ("load", load) if vertical is None else ("vertical", vertical)
        wanted = require_number(name, given, 0.0, open_minimum=True)

        def residual(penetration: float) -> float:
            nonlocal found
            found = self._at(pose, velocity, surface, penetration)
            left = (_of_normals(found) if vertical is None else found.Q) - wanted
            return 0.0 if abs(left) <= _TOLERANCE * wanted else left

        root = rising_root(residual, _START, wanted / _START, (0.0, _DEEPEST), shortest=_SHORTEST)
        if found is None or abs(root.residual) > 1e-3 * wanted:
            raise ContactError(f"{name} = {wanted:g}: no height was found at which the wheel carries it on this roller")
        self.pair.doubt(pose, velocity, wanted, name)
        return found

    def _on_roller(self, patch: Patch, velocity: Velocity) -> Patch:
        """Return a patch on a prismatic rail as a patch on the roller."""
        cosine, sine = math.cos(patch.angle), math.sin(patch.angle)
        radius = self.radius - patch.position[2]
        speed = velocity.forward / self.radius
        spin = -velocity.forward / self.pair.nominal_radius if velocity.spin is None else velocity.spin
        rolling, local = -spin * patch.rolling_radius, speed * radius
        V = 0.5 * (rolling + local)
        c, forward = patch.creepage, velocity.forward
        creepage = Creepage(
            (c.longitudinal * forward + local - forward) / V,
            c.lateral * forward / V,
            (c.spin * forward + sine * speed) / V,
        )
        s, curvature, ahead = patch.separation, 0.5 * cosine / radius, patch.position[0]
        A = s.A + curvature
        middle = float(np.interp(0.0, s.y, s.A))
        moved = -curvature * ahead / (middle + curvature)
        x_c = (s.A * (s.x_c - moved) - curvature * (ahead + moved)) / A
        lower = middle * curvature / (middle + curvature) * ahead**2
        gap = Separation(s.y, s.g + s.A * curvature / A * (s.x_c + ahead) ** 2 - lower, A, x_c, s.tilt, s.rolling)
        gap.told = s.told
        position = (ahead + moved, *patch.position[1:])
        return replace(patch, separation=gap, creepage=creepage, approach=patch.approach - lower, position=position)

    def _at(self, pose: Pose, velocity: Velocity, friction: Friction, penetration: float | None = None) -> PairSolution:
        """Return the solution of the patches at their approach."""
        mirror = -1.0 if self.pair.side == "left" else 1.0
        found = []
        for patch in within(self.contacts)(pose, velocity, penetration=penetration):
            coefficient = friction.placed(patch.on_rail[0], patch.angle, mirror)
            s = solve(
                patch.separation,
                patch.creepage,
                approach=patch.approach,
                friction=coefficient,
                throw=False,
                **self._options,
            )
            found.append(Solved(patch, s, Frame.turned(np.zeros(3), patch.angle).axes))
        z = pose.z if penetration is None else self.pair.z + self._lower
        radius = self.pair.nominal_radius
        spin = -velocity.forward / radius if velocity.spin is None else velocity.spin
        return of_patches(found, pose, z, self.pair.side, radius, spin)


def _of_normals(solution: PairSolution) -> float:
    """Return the vertical part of the normal forces [N]."""
    return sum(contact.N * math.cos(contact.angle) for contact in solution.contacts)
