"""Every contact patch between one wheel of a wheelset and its rail.

Conventions (theory.md 9.4). Track frame: x forward, y to the right, z down, z = 0 on top of both rails. The wheelset's
centre lies at (0, pose.y, pose.z - nominal_radius); at pose = 0 both tape circles touch the plane z = 0. Roll is about x,
yaw about z, right-handed: positive yaw steers to the right, positive roll lowers the right wheel. Spin is the rotation about
the axle, negative when rolling forward. The contact frame is the track frame turned about x by the contact angle; its z axis
points from the wheel into the rail, so the angle on the right wheel's tread is negative and on the left wheel's positive.

The left side is computed as the mirror image of the right, so both agree to the last bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact._layout import MAX_PATCHES
from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.geometry import frame, search
from contact.geometry.profile import Profile
from contact.geometry.search import MAX_LOBES, N_LINE_ROWS, N_LOBE
from contact.separation import Separation

Array = NDArray[np.float64]
Side = Literal["right", "left"]

TAPE_FROM_FLANGE_BACK = 0.070  # [m] EN 13715: the tape circle lies 70 mm outside the back of the flange
STEEPEST = math.radians(80.0)  # steeper parts of a profile take no part in the search
SAMPLES = 41


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the wheelset is: lateral and vertical displacement [m], roll and yaw [rad]."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class Velocity:
    """How the wheelset moves: forward, y, z [m/s]; roll, yaw, spin rates [rad/s].

    `spin` is the rotation about the axle; None rolls freely at the nominal radius, -forward/nominal_radius.
    """

    forward: float = 1.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    yaw: float = 0.0
    spin: float | None = None


@dataclass(frozen=True, slots=True)
class Irregularity:
    """Displacement of one rail from its place [m], its roll [rad] and their rates, in track coordinates."""

    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    y_rate: float = 0.0
    z_rate: float = 0.0
    roll_rate: float = 0.0


@dataclass(frozen=True)
class Patch:
    """One contact patch. All vectors are in track coordinates, all of the actual side.

    Attributes
    ----------
    separation : Separation
        Gap in the contact plane, y from the reference point; min g = 0.
    creepage : Creepage
        Wheel minus rail at the wheel's point opposite the reference point, over the forward speed, in the contact frame.
    angle : float
        Contact angle [rad]; the contact frame is the track frame turned by it about x.
    position : tuple of float
        Reference point (x, y, z) on the rail [m]: centroid of the overlap of the undeformed profiles.
    on_rail, on_wheel : tuple of float
        (y, z) of the reference point in rail and of its opposite in wheel profile coordinates (right-side convention) [m].
    rolling_radius : float
        Distance of the wheel's point from the axle [m].
    approach : float
        Depth of the overlap along the normal of the contact plane [m]: the approach that belongs to pose.z.
    overlap : float
        Area of that overlap [m²].
    edges : tuple of float
        Where the overlap begins and ends along the separation's y [m].
    load : float or None
        Normal force [N], when the pose was found from a load.
    """

    separation: Separation
    creepage: Creepage
    angle: float
    position: tuple[float, float, float]
    on_rail: tuple[float, float]
    on_wheel: tuple[float, float]
    rolling_radius: float
    approach: float
    overlap: float
    edges: tuple[float, float]
    load: float | None = None


class Pair:
    """One wheel on one rail with everything prepared: what a model calls at each time step.

    Parameters
    ----------
    wheel, rail : Profile
        Right-side convention for either side.
    side : {"right", "left"}
    nominal_radius : float
        Radius of the tape circle [m].
    gauge : float
        Distance of the rails' gauge points [m].
    flange_back : float
        Distance between the backs of both flanges [m].
    gauge_point : float
        Depth below the top of the rail at which the gauge is measured [m].
    combine_distance, combine_angle : float
        Lobes of overlap further apart than this [m] and differing in angle by more than this [rad] are separate patches.
    samples : int or array_like
        Number of samples of each separation, 5 to 2001, spread over the overlap and a margin; or their positions in the
        contact plane [m], increasing, for a model whose separation has a fixed grid. There the gap opens at 45° beyond
        the ends of the profiles and of the patch.

    Raises
    ------
    ContactError
        Profiles of the wrong kind, constants outside their range, no point of the rail at the gauge point's depth.
    """

    def __init__(
        self,
        wheel: Profile,
        rail: Profile,
        *,
        side: Side = "right",
        nominal_radius: float = 0.460,
        gauge: float = 1.435,
        flange_back: float = 1.360,
        gauge_point: float = 0.014,
        combine_distance: float = 8e-3,
        combine_angle: float = math.radians(20.0),
        samples: int | ArrayLike = SAMPLES,
    ) -> None:
        for name, given, kind in (("wheel", wheel, "wheel"), ("rail", rail, "rail")):
            if not isinstance(given, Profile) or given.kind != kind:
                raise ContactError(f"{name} = {given!r} is not a profile of a {kind}")
        if side not in ("right", "left"):
            raise ContactError(f"side = {side!r} is neither 'right' nor 'left'")
        self.side: Side = side
        self.nominal_radius = require_number("nominal_radius", nominal_radius, 0.05, 2.0)
        self._mirror = 1.0 if side == "right" else -1.0
        self._combine = (
            require_number("combine_distance", combine_distance, 0.0),
            require_number("combine_angle", combine_angle, 0.0),
        )
        self._tape = 0.5 * require_number("flange_back", flange_back, 0.1, 3.0) + TAPE_FROM_FLANGE_BACK
        self._rail_origin = _rail_origin(rail, require_number("gauge", gauge, 0.1, 3.0), gauge_point)
        self._wheel, self._rail = _facing(wheel), _facing(rail)
        self._grid, n = _grid(samples)
        self._motion = np.zeros(frame.N_MOTION)
        self._motion[frame.RADIUS], self._motion[frame.TAPE] = self.nominal_radius, self._tape
        n_wheel, n_rail = self._wheel.shape[1], self._rail.shape[1]
        self._line = np.empty((N_LINE_ROWS, n_wheel))
        self._placed = np.empty((3, n_rail))
        self._lobe = np.empty((MAX_LOBES, N_LOBE))
        self._planes = np.empty((3, n_wheel)), np.empty((3, n_rail))
        self.patches = np.empty((MAX_PATCHES, frame.N_PATCH))
        self.separations = np.empty((MAX_PATCHES, frame.N_SEP_ROWS, n))

    def _pose(self, pose: Pose, velocity: Velocity | None, irregularity: Irregularity | None) -> tuple[int, int]:
        """Take over the motion, mirrored to the right side; find the trace line and its gap over the rail."""
        m, motion = self._mirror, self._motion
        velocity, rail = velocity or _ROLLING, irregularity or _IDEAL
        for record in (pose, velocity, rail):
            _require_finite(record)
        if not velocity.forward > 0.0:
            raise ContactError(f"velocity.forward = {velocity.forward:g} is outside the allowed range ]0, inf[")
        spin = -velocity.forward / self.nominal_radius if velocity.spin is None else velocity.spin
        require_number("pose.roll", pose.roll, -0.2, 0.2)
        require_number("pose.yaw", pose.yaw, -0.2, 0.2)
        motion[: frame.RADIUS] = (
            m * pose.y, pose.z, m * pose.roll, m * pose.yaw,
            velocity.forward, m * velocity.y, velocity.z, m * velocity.roll, m * velocity.yaw, spin,
            self._rail_origin[0] + m * rail.y, self._rail_origin[1] + rail.z, m * rail.roll,
            m * rail.y_rate, rail.z_rate, m * rail.roll_rate,
        )  # fmt: skip
        start, end = search.oppose(
            self._wheel, self._rail, motion[frame.POSE_Y], motion[frame.POSE_ROLL], motion[frame.POSE_YAW],
            motion[frame.RAIL_Y], motion[frame.RAIL_Z], motion[frame.RAIL_ROLL], self.nominal_radius, self._tape,
            self._line, self._placed,
        )  # fmt: skip
        if end - start < 3:
            raise ContactError(
                f"pose.y = {pose.y:g}: the {self.side} wheel and rail profiles do not overlap; the allowed range is where "
                f"the wheel at y = {self._line[0, 0]:g} … {self._line[0, -1]:g} m lies above the rail at "
                f"{self._placed[0, 0]:g} … {self._placed[0, -1]:g} m (right side)"
            )
        return start, end

    def touch(self, pose: Pose, irregularity: Irregularity | None = None) -> float:
        """z [m] at which the rigid wheel just touches the rail, the other coordinates as in `pose`."""
        return float(search.touch(self._line, *self._pose(pose, None, irregularity)))

    def locate(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> int:
        """Fill `patches[k]` and `separations[k]` (right-side rows of `contact.geometry.frame`); returns their number.

        This is the path without objects. `penetration` [m] replaces pose.z by that depth below first touch.
        """
        start, end = self._pose(pose, velocity, irregularity)
        if penetration is not None:
            depth = require_number("penetration", penetration, 0.0)
            self._motion[frame.POSE_Z] = search.touch(self._line, start, end) + depth
        return self._describe(start, end)

    def _describe(self, start: int, end: int) -> int:
        return int(
            frame.describe_all(
                self._line, start, end, self._placed, self._lobe, *self._combine, self._motion, self._grid,
                *self._planes, self.patches, self.separations,
            )  # fmt: skip
        )

    def contacts(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> tuple[Patch, ...]:
        """The patches as records, from the field side to the flange; see `contacts`."""
        n = self.locate(pose, velocity, penetration=penetration, irregularity=irregularity)
        return tuple(self._patch(k) for k in range(n))

    def _patch(self, k: int, load: float | None = None) -> Patch:
        m, p = self._mirror, self.patches[k].tolist()
        y, g, A, x_c = self.separations[k] if m > 0.0 else self.separations[k][:, ::-1]
        edges = (p[frame.PATCH_FROM], p[frame.PATCH_TO])
        return Patch(
            separation=Separation(m * y, g, A, x_c),
            creepage=Creepage(p[frame.PATCH_VX], m * p[frame.PATCH_VY], m * p[frame.PATCH_PHI]),
            angle=m * p[frame.PATCH_ANGLE],
            position=(p[frame.PATCH_X], m * p[frame.PATCH_Y], p[frame.PATCH_Z]),
            on_rail=(p[frame.PATCH_RAIL_Y], p[frame.PATCH_RAIL_Z]),
            on_wheel=(p[frame.PATCH_WHEEL_Y], p[frame.PATCH_WHEEL_Z]),
            rolling_radius=p[frame.PATCH_RADIUS],
            approach=p[frame.PATCH_APPROACH],
            overlap=p[frame.PATCH_AREA],
            edges=edges if m > 0.0 else (-edges[1], -edges[0]),
            load=load,
        )


def contacts(
    wheel: Profile,
    rail: Profile,
    pose: Pose,
    velocity: Velocity | None = None,
    *,
    penetration: float | None = None,
    irregularity: Irregularity | None = None,
    **options: object,
) -> tuple[Patch, ...]:
    """Every contact patch of one wheel-rail pair; an empty tuple when the wheel does not touch.

    Parameters
    ----------
    wheel, rail : Profile
    pose : Pose
        Of the wheelset in track coordinates.
    velocity : Velocity, optional
        Default: steady rolling without creepage at the nominal radius.
    penetration : float, optional
        Depth below first touch [m] that replaces pose.z.
    irregularity : Irregularity, optional
        Displacement of this rail.
    **options
        As for `Pair`: side, nominal_radius, gauge, flange_back, gauge_point, combine_distance, combine_angle, samples.

    Returns
    -------
    tuple of Patch
        From the field side to the flange.

    Raises
    ------
    ContactError
        For input outside its range, and where the profiles do not lie above each other.
    """
    pair = Pair(wheel, rail, **options)  # type: ignore[arg-type]
    return pair.contacts(pose, velocity, penetration=penetration, irregularity=irregularity)


_ROLLING, _IDEAL = Velocity(), Irregularity()


def _require_finite(record: Pose | Velocity | Irregularity) -> None:
    for entry in fields(record):
        value = getattr(record, entry.name)
        if value is not None:
            require_number(f"{type(record).__name__.lower()}.{entry.name}", value)


def _facing(profile: Profile) -> Array:
    """Rows y, z, dz/dy of the part around the tape circle or crown that is less steep than `STEEPEST` and has rising y."""
    fair = np.cos(profile.angle) > math.cos(STEEPEST)
    fair[:-1] &= np.diff(profile.y) > 0.0
    centre = int(np.argmin(np.abs(profile.y)) if profile.kind == "wheel" else np.argmin(profile.z))
    if not fair[centre]:
        raise ContactError(f"{profile!r} is steep at its centre, y = {profile.y[centre]:g} m; is its unit or side wrong?")
    low = centre - int(np.argmin(np.append(fair[centre::-1], False))) + 1
    high = centre + int(np.argmin(np.append(fair[centre:], False)))
    part = slice(low, high)
    return np.stack((profile.y[part], profile.z[part], np.tan(profile.angle[part])))


def _rail_origin(rail: Profile, gauge: float, gauge_point: float) -> tuple[float, float]:
    """(y, z) of the origin of the right rail's profile: its top at z = 0, its gauge face at half the gauge."""
    top = int(np.argmin(rail.z))
    depth = rail.z[top::-1] - rail.z[top]
    require_number("gauge_point", gauge_point, 0.0, open_minimum=True)
    below = np.flatnonzero(depth >= gauge_point)
    if below.size == 0:
        raise ContactError(
            f"gauge_point = {gauge_point:g} is outside the allowed range ]0, {depth.max():g}]: "
            f"{rail!r} does not reach deeper on its gauge side"
        )
    i = int(below[0])
    y = np.interp(gauge_point, depth[i - 1 : i + 1], rail.y[top::-1][i - 1 : i + 1])
    return 0.5 * gauge - float(y), -float(rail.z[top])


def _grid(samples: int | ArrayLike) -> tuple[Array, int]:
    """Prescribed sample positions (or none) and the number of samples."""
    if isinstance(samples, int | np.integer):
        require_number("samples", samples, 5, 2001)
        return np.empty(0), int(samples)
    grid = np.array(samples, dtype=np.float64)
    if grid.ndim != 1 or grid.size < 5 or not (np.diff(grid) > 0.0).all() or not np.isfinite(grid).all():
        raise ContactError("samples must be a number or at least 5 increasing positions [m]")
    return grid, grid.size
