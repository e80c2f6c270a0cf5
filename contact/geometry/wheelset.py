"""All contact patches between one wheel of a wheelset and its rail.

The conventions are those of theory.md 9.4.

Track frame: x forward, y to the right, z down, z = 0 on top of both rails. The wheelset's centre lies at
(0, pose.y, pose.z - nominal_radius). At pose = 0 both tape circles touch the plane z = 0. Roll is about x and yaw about z,
both right-handed: positive yaw steers to the right, positive roll lowers the right wheel. Spin is the rotation about the
axle, negative when rolling forward.

The contact frame is the track frame turned about x by the contact angle. Its z axis points from the wheel into the rail.
The angle is therefore negative on the right wheel's tread and positive on the left wheel's tread.

Creepages are wheel minus rail over the forward speed. A yaw angle psi gives the lateral creepage -psi/cos(angle), a rolling
radius r the longitudinal creepage 1 - r/r0, and a contact angle the spin creepage sin(angle)/r0.

The left side is computed as the mirror image of the right side, so both agree to the last bit.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from contact.arrays import Array, as_array
from contact.errors import ContactError, require_kind
from contact.geometry.posed import Posed, Side
from contact.geometry.records import Irregularity, Patch, Pose, Velocity
from contact.geometry.shape import Profile
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import (
    COMBINE_ANGLE,
    COMBINE_DISTANCE,
    FLANGE_BACK,
    GAUGE,
    GAUGE_POINT,
    MOST_PATCHES,
    RADIUS,
    REFERENCE_SPEED,
    SAMPLES,
)
from contact.inputs.separation import Separation
from contact.instance import workspace
from contact.instance.ownership import one_thread, within
from contact.kernels.arrays import Search
from contact.kernels.geometry.prepare import facing, move, rail_origin, take_nodes
from contact.kernels.geometry.settle import first_touch, settle
from contact.kernels.records import TAPE_FROM_FLANGE_BACK
from contact.kernels.rows import Curve

__all__ = ["Irregularity", "Pair", "Patch", "Pose", "Velocity", "contacts"]


class Pair(Posed):
    """One wheel on one rail, with all arrays prepared for use at every time step of a model.

    It serves one thread. A copy, by `copy.copy` or a pickle, has arrays of its own.

    Parameters
    ----------
    wheel, rail : Profile
        Profiles in the right-side convention, for either side.
    side : {"right", "left"}
    nominal_radius : float
        Radius of the tape circle [m], 0.05 to 2.
    gauge : float
        Distance of the rails' gauge points [m], 0.1 to 3.
    flange_back : float
        Distance between the backs of both flanges [m], 0.1 to 3.
    gauge_point : float
        Depth below the top of the rail at which the gauge is measured [m].
    combine_distance, combine_angle : float
        Limits [m], [rad] for separate patches. Lobes of interpenetration become separate patches with their own frames if
        the straight distance of their edges exceeds the first limit and their angles differ by more than the second.
        Otherwise they share one plane. Between 1 and 5/4 of the limits is a smooth transition, in which the list contains
        both descriptions, weighted by `Patch.share`.
    most_patches : int
        Largest number of separate patches, 1 to 4. Further lobes share the plane of the last one. In a transition the list
        is longer.
    samples : int or array_like
        Number of samples of each separation, 5 to 2001, spread over the interpenetration and a margin. Or the increasing
        sample positions in the contact plane [m], for a model whose separation lies on a fixed grid. On such a grid the
        gap opens at 45° beyond the ends of the profiles and of the patch's own range.
    material : Material
        Material for a search under a load.
    reference_speed : float
        Creepages are sliding velocities over the forward speed, or over this speed if the wheelset is slower [m/s], 1e-6 to
        10. So a wheel at rest resists sliding like a damper, Kalker's coefficient over this speed. A model with fixed steps h
        is stable down to rest if it is above f h/(2 m), with that coefficient f [N] and the least mass m that can slide,
        of an axle its inertia over the radius squared; other models may take less.

    Attributes
    ----------
    profiles : (Profile, Profile)
        Wheel and rail, in the right-side convention.
    patches, separations : ndarray
        Result of the last search on the right side: records PATCH, and rows `Sep` for each.
    space : contact.kernels.arrays.Search
        All arrays of the search, as kernels use them.

    Raises
    ------
    ContactError
        For profiles of the wrong kind, constants outside their range, or a rail without a point at the gauge point's depth.
    """

    def __init__(
        self,
        wheel: Profile,
        rail: Profile,
        *,
        side: Side = "right",
        nominal_radius: float = RADIUS.usual,
        gauge: float = GAUGE.usual,
        flange_back: float = FLANGE_BACK.usual,
        gauge_point: float = GAUGE_POINT.usual,
        combine_distance: float = COMBINE_DISTANCE.usual,
        combine_angle: float = COMBINE_ANGLE.usual,
        most_patches: int = MOST_PATCHES.usual,
        samples: int | ArrayLike = SAMPLES.usual,
        material: Material = STEEL,
        reference_speed: float = REFERENCE_SPEED.usual,
    ) -> None:
        for name, given in (("wheel", wheel), ("rail", rail)):
            if not isinstance(given, Profile) or given.kind != name:
                raise ContactError(f"{name} = {given!r} is not a profile of a {name}")
        super().__init__(side, nominal_radius, reference_speed)
        self.profiles = wheel, rail
        grid, n = _grid(samples)
        self.space: Search = workspace.search(_facing(wheel), _facing(rail), grid, n)
        origin = place_of_rail(rail, GAUGE.require("gauge", gauge), gauge_point)
        motion = self.space.motion[0]
        motion.radius = self.nominal_radius
        motion.tape = 0.5 * FLANGE_BACK.require("flange_back", flange_back) + TAPE_FROM_FLANGE_BACK
        motion.combine_distance = COMBINE_DISTANCE.require("combine_distance", combine_distance)
        motion.combine_angle = COMBINE_ANGLE.require("combine_angle", combine_angle)
        motion.most_patches = MOST_PATCHES.require("most_patches", most_patches)
        motion.mirror, motion.slowest = self._mirror, self.reference_speed
        motion.origin_y, motion.origin_z = origin
        self._widths = f"gauge = {gauge:g} and flange_back = {flange_back:g}"
        require_kind("material", material, Material)
        self.space.case["G"], self.space.case["nu"] = material.shear_modulus, material.poisson_ratio
        self.patches, self.separations = self.space.patches, self.space.separations

    @one_thread
    def locate(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> int:
        """Fill `patches` and `separations` and return the number of patches. Parameters and exceptions as in `contacts`.

        No Python objects are made for the patches.
        """
        mode, amount = self.prescribed(load, penetration)
        move(within(self.given)(pose, velocity, irregularity), self.space.motion[0])
        n = settle(mode, amount, self.space)
        self.require_found(n, pose, load)
        return int(n)

    @one_thread
    def contacts(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> tuple[Patch, ...]:
        """Return all patches, from the field side to the flange. See the function `contacts`."""
        n = within(self.locate)(pose, velocity, load=load, penetration=penetration, irregularity=irregularity)
        return tuple(self._patch(k, load is not None) for k in range(n))

    @one_thread
    def touch(self, pose: Pose, irregularity: Irregularity | None = None) -> float:
        """Return z [m] at which the rigid wheel just touches the rail. The other coordinates are those of `pose`."""
        s = self.space
        move(within(self.given)(pose, None, irregularity), s.motion[0])
        overlap, z = first_touch(s.wheel, s.rail, s.motion[0], s.line, s.placed)
        if not overlap:
            raise self._apart(pose)
        return float(z)

    @property
    def z(self) -> float:
        """pose.z of the last search [m]: as given, or as found for a load or a penetration."""
        return float(self.space.motion[0].z)

    def _patch(self, k: int, loaded: bool) -> Patch:
        m, p = self._mirror, self.patches[k]
        y, g, A, x_c, tilt = self.separations[k] if m > 0.0 else self.separations[k][:, ::-1]
        rolling = math.cos(float(p.angle)) / float(p.radius)
        edges = (float(p.low), float(p.high))
        separation = Separation(m * y, g, A, x_c, m * tilt, rolling)
        separation.told, separation.fit_error = self.told, float(p.fit_error)
        return Patch(
            separation=separation,
            creepage=Creepage(float(p.vx), m * float(p.vy), m * float(p.phi)),
            angle=m * float(p.angle),
            position=(float(p.x), m * float(p.y), float(p.z)),
            wheel_position=(float(p.x), m * float(p.point_y), float(p.point_z)),
            on_rail=(float(p.rail_y), float(p.rail_z)),
            on_wheel=(float(p.wheel_y), float(p.wheel_z)),
            rolling_radius=float(p.radius),
            approach=float(p.approach),
            edges=edges if m > 0.0 else (-edges[1], -edges[0]),
            load=float(p.load) if loaded else None,
            share=float(p.share),
        )

    def _apart(self, pose: Pose) -> ContactError:
        motion = self.space.motion[0]
        wheel, rail = self.space.wheel[Curve.Y] + motion.tape, self.space.rail[Curve.Y] + motion.origin_y
        low, high = sorted((self._mirror * (rail[0] - wheel[-1]), self._mirror * (rail[-1] - wheel[0])))
        other = "" if low < 0.0 < high else f"; {self._widths} hardly belong to one track"
        if low < pose.y < high:
            other = "; look at irregularity.y and offset.y"
        return ContactError(
            f"pose.y = {pose.y:g}: the {self.side} wheel and rail profiles do not overlap; "
            f"they do within about ]{low:g}, {high:g}[ m{'; is it in mm?' if abs(pose.y) >= 1.0 else ''}{other}"
        )


def contacts(
    wheel: Profile,
    rail: Profile,
    pose: Pose,
    velocity: Velocity | None = None,
    *,
    load: float | None = None,
    penetration: float | None = None,
    irregularity: Irregularity | None = None,
    **options: Any,
) -> tuple[Patch, ...]:
    """Return all contact patches of one wheel-rail pair.

    For use at every time step, make a `Pair` once and call its method of the same name.

    Parameters
    ----------
    wheel, rail : Profile
    pose : Pose
        Pose of the wheelset in track coordinates. pose.z is ignored if `load` or `penetration` is given.
    velocity : Velocity, optional
        Default: steady rolling at the nominal radius.
    load : float, optional
        Vertical force of this wheel on its rail [N]. z is found so that the sum of share N cos(angle) over the patches
        equals it, with normal forces N by ANALYN and without friction.
    penetration : float, optional
        Vertical depth below first touch [m].
    irregularity : Irregularity, optional
        Displacement of this rail.
    **options
        As for `Pair`: side, nominal_radius, gauge, flange_back, gauge_point, combine_distance, combine_angle,
        most_patches, samples, material.

    Returns
    -------
    tuple of Patch
        The patches from the field side to the flange; empty if the wheel does not touch.

    Raises
    ------
    ContactError
        For input outside its range, for profiles that do not overlap laterally or lie far inside each other, or if no z
        gives the load.

    Warns
    -----
    PlausibilityWarning
        For a pose, a spin of the axle or a load that no wheelset has, as from a wrong unit or sign.
    """
    pair = Pair(wheel, rail, **options)
    found = pair.contacts(pose, velocity, load=load, penetration=penetration, irregularity=irregularity)
    pair.doubt(pose, velocity, load)
    return found


def _rows(profile: Profile) -> Array:
    return np.stack((profile.y, profile.z, profile.angle))


def _facing(profile: Profile) -> Array:
    """Return rows y, z, dz/dy of the part of the profile that can touch."""
    rows = _rows(profile)
    low, high = facing(rows, profile.kind == "wheel")
    if low == high:
        raise ContactError(f"{profile!r} is steep at y = {profile.y[low]:g} m; is its unit or its side wrong?")
    curve = np.empty((3, high - low))
    take_nodes(rows, low, high, curve)
    return curve


def place_of_rail(rail: Profile, gauge: float, gauge_point: float) -> tuple[float, float]:
    """Return (y, z) [m] of the origin of the right rail's profile in track coordinates."""
    GAUGE_POINT.require("gauge_point", gauge_point)
    y, z, deepest = rail_origin(_rows(rail), gauge, gauge_point)
    if deepest < gauge_point:
        raise ContactError(
            f"gauge_point = {gauge_point:g} is outside the allowed range ]0, {deepest:g}]: "
            f"{rail!r} reaches no deeper on its gauge side"
        )
    return y, z


def _grid(samples: int | ArrayLike) -> tuple[Array, int]:
    """Return the prescribed sample positions [m], empty if there are none, and the number of samples."""
    if isinstance(samples, int | np.integer):
        return np.empty(0), SAMPLES.require("samples", samples)
    grid = as_array("samples", samples)
    if grid.ndim != 1 or grid.size < 5 or not np.isfinite(grid).all() or not (np.diff(grid) > 0.0).all():
        raise ContactError(f"samples of shape {grid.shape}: at least 5 finite, increasing positions [m] are needed")
    return grid, grid.size
