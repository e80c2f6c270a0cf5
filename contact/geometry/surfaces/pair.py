"""One wheel on one rail, either of which may change along the way: all patches at a pose."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact import workspace
from contact.creepage import Creepage
from contact.errors import ContactError, require_number
from contact.geometry.posed import MAX_PENETRATION, Posed, Side
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.shape import Profile
from contact.geometry.surfaces import compiled
from contact.geometry.surfaces.frame import Frame, PlacedRail, PlacedWheel, heights
from contact.geometry.surfaces.search import Lobe, Scene, combined, sample
from contact.geometry.surfaces.surface import RailSurface, WheelSurface
from contact.geometry.wheelset import TAPE_FROM_FLANGE_BACK, place_of_rail
from contact.halfspace.gap import Division, Gap
from contact.halfspace.norm import norm
from contact.kernels.geometry.search import axle
from contact.kernels.geometry.settle import DEEPEST
from contact.kernels.records import MAX_PATCHES, SLOWEST
from contact.material import STEEL, Material

Array = NDArray[np.float64]

ROWS = COLUMNS = 60
SAMPLES = 81  # of a separation; 41 miss the peaks of crossing noses
_MIRROR = np.diag([1.0, -1.0, 1.0])
REACHES = 1e-2, 0.3  # [m] least and largest reach from the axle
_MOST_STEPS, _LOAD_TOLERANCE = 40, 1e-5


@dataclass(frozen=True, slots=True, eq=False)
class SurfacePatch:
    """One contact patch. Vectors are in track coordinates; signs are those of the actual side.

    Attributes
    ----------
    gap : contact.halfspace.Gap
        Undeformed distance over the plane of `frame`; its least value is 0. For the element-wise half space.
    approach : float
        Depth of the interpenetration along the normal of the frame [m].
    frame : Frame
        Contact frame. Its origin is the reference point on the rail.
    creepage : Creepage
        Wheel minus rail over the forward speed, in the frame, at `wheel_position`.
    angle : float
        Contact angle [rad]: that of the frame about x, or the lateral inclination of its normal.
    position, wheel_position : tuple of float
        Reference point on the rail, and the point of the wheel opposite along the normal, (x, y, z) [m].
    rolling_radius : float
        Distance of the wheel's point from the axle [m].
    """

    gap: Gap
    approach: float
    frame: Frame
    creepage: Creepage
    angle: float
    position: tuple[float, float, float]
    wheel_position: tuple[float, float, float]
    rolling_radius: float

    def mirrored(self) -> SurfacePatch:
        """Return the patch of the mirror image."""
        c, (x, y, z), (wx, wy, wz) = self.creepage, self.position, self.wheel_position
        return replace(
            self,
            gap=Gap(self.gap.x, -self.gap.y[::-1], self.gap.h[::-1]),
            frame=Frame(_MIRROR @ self.frame.origin, _MIRROR @ self.frame.axes @ _MIRROR),
            creepage=Creepage(c.longitudinal, -c.lateral, -c.spin),
            angle=-self.angle,
            position=(x, -y, z),
            wheel_position=(wx, -wy, wz),
        )


class SurfacePair(Posed):
    """A wheel and a rail of which one or both change along the way.

    Parameters
    ----------
    wheel : WheelSurface or Profile
    rail : RailSurface or Profile
        For either side, in the right-side convention.
    side : {"right", "left"}
    nominal_radius, gauge, flange_back, gauge_point :
        As for `contact.geometry.wheelset.Pair` [m].
    rail_origin : (float, float), optional
        Place (y, z) of the origin of the rail's points in track coordinates of the right side [m]. Default: the place at which
        a rail with one profile has the gauge. Required for a rail that changes along the track.
    combine_distance, combine_angle : float
        Two regions of interpenetration are separate patches, each with its own frame and without influence on the other,
        if they are further apart than the first limit [m] or their angles differ by more than the second [rad], as in
        CONTACT with its D_SEP and A_SEP. Otherwise they share one plane.
    reach : float
        Distance before and behind the axle that is searched [m], 0.01 to 0.3. It is doubled, up to 0.3, as long as the bodies
        still come closer at its ends, as on a steep ramp.
    tilted : bool
        False: contact frames are turned about x only, as in CONTACT. True: they follow the rail's normal in all directions,
        so the pressure of a ramp also acts along the track.
    rows, columns : int
        Elements across and along each region of interpenetration, 10 to 1000. The contact takes about 0.7 of it.
    spacing : float or (float, float), optional
        Size (dx, dy) of the elements [m] instead of their number.
    material : Material
        Material for a search under a load.

    Raises
    ------
    ContactError
        For surfaces of the wrong kind or numbers outside their range.
    """

    def __init__(
        self,
        wheel: WheelSurface | Profile,
        rail: RailSurface | Profile,
        *,
        side: Side = "right",
        nominal_radius: float = 0.460,
        gauge: float = 1.435,
        flange_back: float = 1.360,
        gauge_point: float = 0.014,
        rail_origin: tuple[float, float] | None = None,
        combine_distance: float = 8e-3,
        combine_angle: float = math.radians(90.0),
        reach: float = 0.06,
        tilted: bool = False,
        rows: int = ROWS,
        columns: int = COLUMNS,
        spacing: float | tuple[float, float] | None = None,
        material: Material = STEEL,
    ) -> None:
        super().__init__(side, nominal_radius)
        if rail_origin is None:
            if not isinstance(rail, Profile):
                raise ContactError(
                    f"rail_origin = None: {rail!r} has no gauge; give the place of its origin (y, z) [m]"
                )
            rail_origin = place_of_rail(rail, require_number("gauge", gauge, 0.1, 3.0), gauge_point)
        self.rail_origin = (
            require_number("rail_origin", rail_origin[0]),
            require_number("rail_origin", rail_origin[1]),
        )
        self.wheel = WheelSurface.constant(wheel) if isinstance(wheel, Profile) else wheel
        self.rail = RailSurface.constant(rail) if isinstance(rail, Profile) else rail
        if not isinstance(self.wheel, WheelSurface) or not isinstance(self.rail, RailSurface):
            raise ContactError(f"wheel = {wheel!r} and rail = {rail!r} are not a WheelSurface and a RailSurface")
        self.tape = 0.5 * require_number("flange_back", flange_back, 0.1, 3.0) + TAPE_FROM_FLANGE_BACK
        self.combine_distance = require_number("combine_distance", combine_distance, 0.0)
        self.combine_angle = require_number("combine_angle", combine_angle, 0.0)
        self.reach = require_number("reach", reach, *REACHES)
        self.tilted = bool(tilted)
        both = spacing if spacing is None or isinstance(spacing, tuple) else (spacing, spacing)
        if both is not None:
            both = tuple(require_number("spacing", step, 1e-6, 1e-2) for step in both)  # type: ignore[assignment]
        elements = (require_number("rows", rows, 10, 1000), require_number("columns", columns, 10, 1000))
        self.division = Division(int(elements[0]), int(elements[1]), both)
        self.material = material
        self._made = compiled.sheet(self.wheel), compiled.sheet(self.rail)
        self.space = workspace.surface_search(*self._made, SAMPLES)
        motion = self.space.motion[0]
        motion.radius, motion.tape, motion.mirror = self.nominal_radius, self.tape, self._mirror
        motion.combine_distance, motion.most_patches = self.combine_distance, MAX_PATCHES
        motion.origin_y, motion.origin_z = self.rail_origin
        motion.reach, motion.tilted = self.reach, self.tilted
        self.space.case["G"], self.space.case["nu"] = material.shear_modulus, material.poisson_ratio
        self.separations = self.space.separations
        self.z = 0.0  #: pose.z of the last search [m]: as given, or as found

    def scene(self, pose: Pose, station: float, rotation: float, irregularity: Irregularity | None = None) -> Scene:
        """Return wheel and rail at a pose, at z = 0. Parameters as for `contacts`."""
        require_number("station", station)
        require_number("rotation", rotation)
        pose, moved = self._right(pose), irregularity or Irregularity()
        if self.side == "left":
            moved = replace(moved, y=-moved.y, roll=-moved.roll, y_rate=-moved.y_rate, roll_rate=-moved.roll_rate)
        wheel = PlacedWheel(self.wheel, self.nominal_radius, self.tape, replace(pose, z=0.0), rotation)
        rail = PlacedRail(self.rail, self.rail_origin, station, moved)
        reach, scene = self.reach, None
        while True:
            ends = wheel.nodes(np.array([-rotation]))[1], rail.nodes(station + np.linspace(-reach, reach, 5))[1]
            low, high = max(float(np.nanmin(y)) for y in ends), min(float(np.nanmax(y)) for y in ends)
            if high > low:
                scene = Scene(wheel, rail, (-reach, reach, low, high))
            if scene is None or not scene.reaches_out or reach >= REACHES[1]:
                break
            reach = min(2.0 * reach, REACHES[1])
        if scene is None or not scene.overlaps:
            raise self._apart(pose)
        return scene

    def _apart(self, pose: Pose) -> ContactError:
        return ContactError(f"pose.y = {pose.y:g}: the {self.side} wheel does not lie above its rail")

    def given(self, *args: Any, station: float = 0.0, **options: Any) -> np.record:
        """Return the motion as a record. Parameters as for `Posed.given`."""
        made = super().given(*args, station=station, **options)
        self.follow(station)
        return made

    def follow(self, station: float) -> None:
        """Fill the table of the rail's deviations around `station` [m], for a kernel that is called without `given`."""
        compiled.follow(self._made[1], self.rail, station)

    def touch(self, pose: Pose, *, station: float = 0.0, rotation: float = 0.0) -> float:
        """Return z [m] at which the rigid wheel just touches the rail. Parameters as for `contacts`."""
        return self.scene(pose, station, rotation).touch()

    def contacts(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
        load: float | None = None,
        penetration: float | None = None,
        irregularity: Irregularity | None = None,
    ) -> tuple[SurfacePatch, ...]:
        """Return all patches, from the field side to the flange.

        Parameters
        ----------
        pose, velocity, load, penetration, irregularity :
            As for `contact.geometry.wheelset.contacts`. A load is carried by the pressures of the element-wise half space.
        station : float
            Position of the axle along the slices of the rail [m].
        rotation : float
            Angle by which the wheel has turned about the y axis [rad]; it decreases when rolling forward, as
            `Velocity.spin` is negative. The angle -rotation of the wheel is at the bottom.

        Raises
        ------
        ContactError
            For input outside its range, if the wheel does not lie above the rail, or if no z gives the load.
        """
        scene = self.scene(pose, station, rotation, irregularity)
        if load is None and penetration is None:
            self.z = pose.z
        elif load is not None and penetration is not None:
            raise ContactError(f"load = {load} and penetration = {penetration} exclude each other")
        elif penetration is not None:
            self.z = scene.touch() + require_number("penetration", penetration, 0.0, MAX_PENETRATION)
        else:
            amount = require_number("load", load, 0.0)
            self.z = self.settle(scene, amount, lambda z: self.carried(scene, z))
        return self.patches(scene, self.z, velocity or Velocity())

    def settle(self, scene: Scene, load: float, carried: Callable[[float], float]) -> float:
        """Return z [m] at which `carried(z)`, a vertical force [N], equals `load`.

        F^(2/3) is nearly linear in the penetration (Hertz). Its root is bracketed and found by the Illinois variant of
        regula falsi, as for constant profiles (`contact.kernels.geometry.settle`). Where a surface ends, the force may jump
        with z; then the result is the side of the jump that is nearer to the load.
        """
        touch = scene.touch()
        if load <= 0.0:
            return touch
        target = load ** (2.0 / 3.0)
        low, high, f_low, f_high, side = 0.0, math.inf, -target, 0.0, 0
        p = 1e-4 * (load / 1e5) ** (2.0 / 3.0)
        nearest, best = math.inf, p
        for step in range(_MOST_STEPS):
            force = carried(touch + p)
            if abs(force - load) < nearest:
                nearest, best = abs(force - load), p
            if nearest <= _LOAD_TOLERANCE * load or high - low <= 1e-12:
                return touch + best
            f = max(force, 0.0) ** (2.0 / 3.0) - target
            if f > 0.0:
                f_low = 0.5 * f_low if side > 0 else f_low
                high, f_high, side = p, f, 1
            else:
                f_high = 0.5 * f_high if side < 0 else f_high
                low, f_low, side = p, f, -1
            if high < math.inf:
                p = low - f_low * (high - low) / (f_high - f_low) if step < 20 else 0.5 * (low + high)
            else:
                p = min(1.05 * p * target / (f + target), 3.0 * p) if f > -target else 3.0 * p
                if p > DEEPEST:
                    break
        raise ContactError(f"load = {load:g}: no z was found at which the {self.side} wheel carries it on this rail")

    def carried(self, scene: Scene, z: float) -> float:
        """Return the vertical force of the pressures of the half space at the height z [N]."""
        wheel, total = self._lowered(scene, z), 0.0
        for lobe, frame in self._lobes(scene, z):
            sampled = sample(wheel, scene.rail, frame, lobe, self.division)
            if sampled is not None:
                gap, approach = sampled
                p = norm(gap.h, gap.dx, gap.dy, self.material, approach=approach, tolerance=1e-4).p
                total += float(p.sum()) * gap.dx * gap.dy * float(frame.axes[2, 2])
        return total

    def patches(self, scene: Scene, z: float, velocity: Velocity) -> tuple[SurfacePatch, ...]:
        """Return the patches of a scene at the height z [m]."""
        wheel = self._lowered(scene, z)
        found = []
        for lobe, frame in self._lobes(scene, z):
            sampled = sample(wheel, scene.rail, frame, lobe, self.division)
            if sampled is None:
                continue
            gap, approach = sampled
            origin = np.zeros(1)
            depth = float(heights(wheel, frame, origin, origin, deepest=True).z[0, 0])
            point = frame.origin + frame.axes[2] * (depth if math.isfinite(depth) else 0.0)
            body = wheel.axes.T @ (point - wheel.centre)
            found.append(
                SurfacePatch(
                    gap=gap,
                    approach=approach,
                    frame=frame,
                    creepage=self._creepage(wheel, scene.rail, velocity, frame, point),  # type: ignore[arg-type]
                    angle=math.atan2(-frame.axes[2, 1], frame.axes[2, 2]),
                    position=tuple(frame.origin.tolist()),
                    wheel_position=tuple(point.tolist()),
                    rolling_radius=math.hypot(body[0], body[2]),
                )
            )
        return tuple(patch if self.side == "right" else patch.mirrored() for patch in found)

    def _lobes(self, scene: Scene, z: float) -> list[tuple[Lobe, Frame]]:
        lobes = combined(scene.lobes(z), self.combine_distance, self.combine_angle)
        return [(lobe, scene.frame(lobe, self.tilted)) for lobe in lobes]

    def _lowered(self, scene: Scene, z: float) -> PlacedWheel:
        wheel = scene.wheel
        assert isinstance(wheel, PlacedWheel)
        return PlacedWheel(wheel.surface, wheel.radius, wheel.tape, replace(wheel.pose, z=z), wheel.rotation)

    def _right(self, pose: Pose) -> Pose:
        return pose if self.side == "right" else replace(pose, y=-pose.y, roll=-pose.roll, yaw=-pose.yaw)

    def _creepage(
        self, wheel: PlacedWheel, rail: PlacedRail, velocity: Velocity, frame: Frame, point: Array
    ) -> Creepage:
        """Return the creepage at a point of the wheel (as `contact.kernels.geometry.frame.creepages`, in any frame)."""
        mirror = 1.0 if self.side == "right" else -1.0
        pose, moved = wheel.pose, rail.moved
        spin = -velocity.forward / self.nominal_radius if velocity.spin is None else velocity.spin
        roll_rate = mirror * velocity.roll
        turning = spin * np.array(axle(pose.roll, pose.yaw))
        turning += (roll_rate * math.cos(pose.yaw), roll_rate * math.sin(pose.yaw), mirror * velocity.yaw)
        moving = np.array([velocity.forward, mirror * velocity.y, velocity.z])
        rail_turning = np.array([moved.roll_rate, 0.0, 0.0])
        from_rail = point - np.array([0.0, *self.rail_origin]) - np.array([0.0, moved.y, moved.z])
        rail_moving = np.array([0.0, moved.y_rate, moved.z_rate]) + np.cross(rail_turning, from_rail)
        slip = frame.axes @ (moving + np.cross(turning, point - wheel.centre) - rail_moving)
        speed = max(velocity.forward, SLOWEST)
        spinning = float(frame.axes[2] @ (turning - rail_turning))
        return Creepage(float(slip[0]) / speed, float(slip[1]) / speed, spinning / speed)
