"""One wheel on one rail, either of which may change along the way: all patches at a pose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.errors import ContactError, require_number
from contact.geometry.posed import Posed, Side
from contact.geometry.records import Irregularity, Pose, Velocity
from contact.geometry.shape import Profile
from contact.geometry.surfaces import compiled
from contact.geometry.surfaces.frame import Frame
from contact.geometry.surfaces.surface import RailSurface, WheelSurface
from contact.geometry.wheelset import SAMPLES, TAPE_FROM_FLANGE_BACK, place_of_rail
from contact.given_force import depth_under
from contact.halfspace.gap import Division, Gap
from contact.halfspace.lattice import Lattice
from contact.halfspace.norm import norm
from contact.inputs.creepage import Creepage
from contact.inputs.material import STEEL, Material
from contact.inputs.options import COMBINE_DISTANCE, FLANGE_BACK, GAUGE, GAUGE_POINT, RADIUS, REACH, REFERENCE_SPEED
from contact.instance import workspace
from contact.instance.ownership import one_thread, within
from contact.kernels.enumerations import Height
from contact.kernels.geometry.elements import fill_distance, find
from contact.kernels.geometry.prepare import move
from contact.kernels.geometry.section import AWAY
from contact.kernels.records import MAX_PATCHES

Range = tuple[float, float, float, float]
ROWS = COLUMNS = 60
_LOAD_TOLERANCE = 1e-5  # of a force, over the load
#: The overlap of a patch is measured on this many points along each side, at least twice, at most so many times. Where it
#: reaches an edge of their range, this becomes longer by a share.
_POINTS, _TWICE, _PASSES, _LONGER = 41, 2, 6, 0.4
_ABSENT = 1e-3  # [m] by which elements without a surface lie above the highest other one


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
        Reference point on the rail, and the point of the wheel deeper by `approach`, along the normal, (x, y, z) [m].
    on_rail, on_wheel : tuple of float
        As in `contact.geometry.records.Patch` [m].
    rolling_radius : float
        Distance of the wheel's point from the axle [m].
    share : float
        Weight of the patch [-], as in `contact.geometry.records.Patch`.
    """

    gap: Gap
    approach: float
    frame: Frame
    creepage: Creepage
    angle: float
    position: tuple[float, float, float]
    wheel_position: tuple[float, float, float]
    on_rail: tuple[float, float]
    on_wheel: tuple[float, float]
    rolling_radius: float
    share: float


class _Elements(NamedTuple):
    """The gap of a patch of the right side, its least value 0, the approach [m] and the frame."""

    gap: Gap
    approach: float
    frame: Frame


class SurfacePair(Posed):
    """A wheel and a rail of which one or both change along the way. It serves one thread; a copy has arrays of its own.

    Parameters
    ----------
    wheel : WheelSurface or Profile
    rail : RailSurface or Profile
        For either side, in the right-side convention.
    side : {"right", "left"}
    nominal_radius, gauge, flange_back, gauge_point :
        As for `contact.geometry.wheelset.Pair` [m].
    tape : float, optional
        Distance of the tape circle from the wheelset's centre [m], 0 to 3, instead of `flange_back`; 0: a single wheel.
    rail_origin : (float, float), optional
        Place (y, z) of the origin of the rail's points in track coordinates of the right side [m]. Default: the place at which
        a rail with one profile has the gauge. Required for a rail that changes along the track.
    combine_distance : float
        Regions of interpenetration further apart than this [m] are separate patches, each with its own frame and without
        influence on the other. Up to 5/4 of it they count in both ways, with shares, as in `contact.geometry.wheelset.Pair`.
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
    reference_speed : float
        As for `contact.geometry.wheelset.Pair` [m/s].

    Raises
    ------
    ContactError
        For surfaces of the wrong kind or numbers outside their range.
    """

    rolls_back = False

    def __init__(
        self,
        wheel: WheelSurface | Profile,
        rail: RailSurface | Profile,
        *,
        side: Side = "right",
        nominal_radius: float = RADIUS.usual,
        gauge: float = GAUGE.usual,
        flange_back: float = FLANGE_BACK.usual,
        tape: float | None = None,
        gauge_point: float = GAUGE_POINT.usual,
        rail_origin: tuple[float, float] | None = None,
        combine_distance: float = COMBINE_DISTANCE.usual,
        reach: float = REACH.usual,
        tilted: bool = False,
        rows: int = ROWS,
        columns: int = COLUMNS,
        spacing: float | tuple[float, float] | None = None,
        material: Material = STEEL,
        reference_speed: float = REFERENCE_SPEED.usual,
    ) -> None:
        super().__init__(side, nominal_radius, reference_speed)
        if rail_origin is None:
            if not isinstance(rail, Profile):
                raise ContactError(
                    f"rail_origin = None: {rail!r} has no gauge; give the place of its origin (y, z) [m]"
                )
            rail_origin = place_of_rail(rail, GAUGE.require("gauge", gauge), gauge_point)
        y, z = (require_number("rail_origin", at) for at in rail_origin)
        self.rail_origin = y, z
        self.wheel = WheelSurface.constant(wheel) if isinstance(wheel, Profile) else wheel
        self.rail = RailSurface.constant(rail) if isinstance(rail, Profile) else rail
        if not isinstance(self.wheel, WheelSurface) or not isinstance(self.rail, RailSurface):
            raise ContactError(f"wheel = {wheel!r} and rail = {rail!r} are not a WheelSurface and a RailSurface")
        back = require_number("flange_back", flange_back, 0.1, 3.0)
        self.tape = 0.5 * back + TAPE_FROM_FLANGE_BACK if tape is None else require_number("tape", tape, 0.0, 3.0)
        self.combine_distance = require_number("combine_distance", combine_distance, 0.0)
        self.reach = REACH.require("reach", reach)
        self.tilted = bool(tilted)
        both = (spacing, spacing) if isinstance(spacing, float | int) else spacing
        if both is not None:
            both = tuple(require_number("spacing", step, 1e-6, 1e-2) for step in both)  # type: ignore[assignment]
        n_rows, n_columns = (int(require_number(*each, 10, 1000)) for each in (("rows", rows), ("columns", columns)))
        self.division: Division | Lattice = Division(n_rows, n_columns, both)
        self.material = material
        self._made = compiled.sheet(self.wheel), compiled.sheet(self.rail)
        self.space = workspace.surface_search(*self._made, SAMPLES.usual)
        motion = self.space.motion[0]
        motion.radius, motion.tape, motion.mirror = self.nominal_radius, self.tape, self._mirror
        motion.combine_distance, motion.most_patches = self.combine_distance, MAX_PATCHES
        motion.origin_y, motion.origin_z = self.rail_origin
        motion.reach, motion.tilted, motion.slowest = self.reach, self.tilted, self.reference_speed
        self.space.case["G"], self.space.case["nu"] = material.shear_modulus, material.poisson_ratio
        self.patches, self.separations = self.space.patches, self.space.separations
        self._pose, self.depth = Pose(), 0.0  # of the last `place`, for errors; penetration that `settle` found [m]

    def _apart(self, pose: Pose) -> ContactError:
        return ContactError(f"pose.y = {pose.y:g}: the {self.side} wheel does not lie above its rail")

    def set_way(self, station: float, rotation: float) -> None:
        """Set the position along the rail [m] and the angle of the wheel [rad] for the search."""
        super().set_way(station, rotation)
        within(self.follow)(station)

    @one_thread
    def follow(self, station: float) -> None:
        """Fill the table of the rail's deviations around `station` [m], for a kernel called without `given`."""
        compiled.follow(self._made[1], self.rail, station)

    @property
    def z(self) -> float:
        """pose.z of the last search [m]: as given, or as found for a load or a penetration."""
        return float(self.space.motion[0].z)

    @one_thread
    def place(
        self,
        pose: Pose,
        velocity: Velocity | None = None,
        *,
        station: float = 0.0,
        rotation: float = 0.0,
        irregularity: Irregularity | None = None,
    ) -> None:
        """Place wheel and rail for `settle`, `carried` and `found`. Parameters as for `contacts`."""
        given = within(self.given)(pose, velocity, irregularity, station=station, rotation=rotation)
        move(given, self.space.motion[0])
        self._pose = pose

    @one_thread
    def touch(self, pose: Pose, *, station: float = 0.0, rotation: float = 0.0) -> float:
        """Return z [m] at which the rigid wheel just touches the rail. Parameters as for `contacts`."""
        within(self.place)(pose, station=station, rotation=rotation)
        self._search(Height.PENETRATION, 0.0)
        return self.z

    def _search(self, mode: int, amount: float) -> int:
        """Describe the patches at the pose of the last `place` and return their number."""
        n = find(mode, amount, self.space)
        self.require_found(n, self._pose, None)
        return int(n)

    @one_thread
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
        mode, amount = self.prescribed(load, penetration)
        within(self.place)(pose, velocity, station=station, rotation=rotation, irregularity=irregularity)
        if mode == Height.LOAD:
            mode, _ = Height.GIVEN, within(self.settle)(amount)
        return within(self.found)(mode, amount)

    @one_thread
    def settle(self, load: float, start: float | None = None) -> float:
        """Set the height at which the pressures of the half space carry a vertical load [N]; return its relative error.

        Where a surface ends or has an edge, the force may jump with z. Then the height is the best of those tried. The search
        begins at the penetration `start` [m].
        """
        if load <= 0.0:
            self._search(Height.PENETRATION, 0.0)
            return 0.0
        heights: dict[float, float] = {}

        def force(depth: float) -> float:
            found = within(self.carried)(Height.PENETRATION, depth)
            heights[depth] = self.z
            return found

        best = depth_under(force, load, start, _LOAD_TOLERANCE)
        if best is None:
            raise ContactError(
                f"load = {load:g}: no z was found at which the {self.side} wheel carries it on this rail"
            )
        missed, self.depth = best
        self.space.motion[0].z = heights[self.depth]
        return missed

    @one_thread
    def carried(self, mode: int = Height.GIVEN, amount: float = 0.0) -> float:
        """Return the vertical force of the pressures of the half space [N]. Parameters as for `found`."""
        total = 0.0
        for k in range(self._search(mode, amount)):
            made = self._elements(k)
            if made is not None:
                gap = made.gap
                p = norm(gap.h, gap.dx, gap.dy, self.material, approach=made.approach, tolerance=1e-4).p
                share, down = float(self.patches[k].share), float(made.frame.axes[2, 2])
                total += share * float(p.sum()) * gap.dx * gap.dy * down
        return total

    @one_thread
    def found(self, mode: int = Height.GIVEN, amount: float = 0.0) -> tuple[SurfacePatch, ...]:
        """Return the patches at the pose of the last `place`. `mode` and `amount` are those of `Posed.prescribed`."""
        made = ((k, self._elements(k)) for k in range(self._search(mode, amount)))
        return tuple(self._patch(k, one) for k, one in made if one is not None)

    def _elements(self, k: int) -> _Elements | None:
        """Return patch `k` of the last search on elements that cover its overlap; None without overlap."""
        p = self.patches[k]
        frame = Frame.of(p)
        box = self._overlap(frame, (p.back, p.front, p.left, p.right))
        if box is None:
            return None
        division, station = self.division, self.space.motion[0].station
        if isinstance(division, Lattice):
            division = division.placed(station + float(frame.origin[0]), float(p.rail_y))
        elif division.spacing is None:
            steps = _step(*box[:2], division.columns), _step(*box[2:], division.rows)
            division = division._replace(spacing=steps)
        centres = division.centres(box)
        h = within(self.distance)(frame, *centres)
        far = isinstance(division, Lattice) and division.clear(box, *centres, h, AWAY)
        present = h < AWAY
        if not h.min() < 0.0:
            return None
        approach = -float(h.min())
        h = np.where(present, h, AWAY if far else h[present].max() + _ABSENT) + approach
        return _Elements(Gap(*centres, h), approach, frame)

    def _overlap(self, frame: Frame, box: Range) -> Range | None:
        """Return the range of a frame that the overlap fills, about in the range `box`; None without overlap."""
        for k in range(_PASSES):
            x, y = np.linspace(*box[:2], _POINTS), np.linspace(*box[2:], _POINTS)
            inside = within(self.distance)(frame, x, y) < 0.0
            if not inside.any():
                return None
            (back, front), (low, high) = _around(x, inside.max(axis=0)), _around(y, inside.max(axis=1))
            whole = x[0] <= back and front <= x[-1] and y[0] <= low and high <= y[-1]
            box = back, front, low, high
            if whole and k + 1 >= _TWICE:
                break
        return box

    @one_thread
    def distance(self, frame: Frame, x: Array, y: Array) -> Array:
        """Return rail minus wheel along the normal of a frame of the right side, shape (ny, nx) [m].

        The wheel stands where the last search has left it. Where a body is absent, the distance is 1 m.
        """
        h = np.empty((y.size, x.size))
        fill_distance(
            tuple(frame.origin.tolist()), frame.turn, np.ascontiguousarray(x), np.ascontiguousarray(y), h, self.space
        )
        return h

    def _patch(self, k: int, made: _Elements) -> SurfacePatch:
        m, p, (gap, approach, frame) = self._mirror, self.patches[k], made
        x, y, z = frame.origin.tolist()
        return SurfacePatch(
            gap=gap if m > 0.0 else Gap(gap.x, -gap.y[::-1], gap.h[::-1]),
            approach=approach,
            frame=frame if m > 0.0 else frame.mirrored,
            creepage=Creepage(float(p.vx), m * float(p.vy), m * float(p.phi)),
            angle=m * float(p.angle),
            position=(x, m * y, z),
            wheel_position=(float(p.x), m * float(p.point_y), float(p.point_z)),
            on_rail=(float(p.rail_y), float(p.rail_z)),
            on_wheel=(float(p.wheel_y), float(p.wheel_z)),
            rolling_radius=float(p.radius),
            share=float(p.share),
        )


def _around(at: Array, inside: NDArray[np.bool_]) -> tuple[float, float]:
    """Return the range of positions `at` that are inside, with a step around it, or more where it reaches an end."""
    first, last = np.flatnonzero(inside)[[0, -1]]
    step, longer = float(at[1] - at[0]), _LONGER * float(at[-1] - at[0])
    return (
        float(at[first]) - (step if first > 0 else longer),
        float(at[last]) + (step if last < at.size - 1 else longer),
    )


def _step(low: float, high: float, n: int) -> float:
    """Return a size of elements [m] of which about `n` cover low … high: a power of 2^(1/4), so forces do not jump."""
    return float(2.0 ** (0.25 * math.floor(4.0 * math.log2(max(high - low, 1e-7) / n))))
