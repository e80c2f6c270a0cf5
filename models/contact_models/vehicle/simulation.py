"""A vehicle on a track, advanced by its kernels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.arrays import Array
from contact.damage import DamageParameters
from contact.errors import ContactError, require_number
from contact.friction import Friction, as_friction
from contact.geometry.profile import Profile
from contact.geometry.surfaces import SurfacePair, WheelSurface
from contact.geometry.wheelset import Pair, Pose, Velocity
from contact.inputs.material import STEEL, Material
from contact.inputs.options import N_ELEMENTS, N_STRIPS, REFERENCE_SPEED
from contact.instance import workspace
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.arrays import Ledger
from contact.kernels.enumerations import Height
from contact.kernels.records import GIVEN
from contact.pair import PairSolution, WheelRailPair
from contact.registry import DEFAULT_NORMAL, DEFAULT_TANGENTIAL
from .assembly import Assembly, assemble
from .declared import SIDES, VehicleDeclaration
from .kernels import motion
from .kernels.between import LONGEST_PACE, PACE, TOLERANCE, LastSolution, lay_last
from .kernels.frames import speed_at
from .kernels.layout import Axis, Book, Model, Scratch, State, TrackRow, lay_scratch, lay_state
from .kernels.wheel_arrays import WheelArrays, gather
from .notebook import of_simulation
from .sections import RailSection, require_apart
from .uneven import Stretch, UnevenWheels
from .wheel_threads import WheelThreads

#: Half the distance of the contact points [m], nearly, with which a search of the roll begins, and its tolerance [m].
_HALF_BASE, _LEVEL, _MOST_TRIALS = 0.75, 1e-10, 60


@dataclass(frozen=True, kw_only=True)
class ContactOptions:
    """Contact methods of all wheels, as for `contact.pair.WheelRailPair`, and how often they are used.

    With `pace` above 1 no more than `pace` steps lie between two solutions of a contact, and in between its forces change to
    first order (vehicle.md, 8). A contact whose forces were not met to `tolerance` times the static load, or that has
    moved far, is solved at every step; with `pace` = 1 all are, as wheels that are not round always. Creepages refer to a speed
    of at least `reference_speed` [m/s]: with 10 m/s a vehicle can stop and stand at steps of 0.2 ms.
    """

    normal: str = DEFAULT_NORMAL
    tangential: str = DEFAULT_TANGENTIAL
    n_strips: int = N_STRIPS.usual
    n_elements: int = N_ELEMENTS.usual
    material: Material = STEEL
    damage: DamageParameters | None = None
    pace: int = PACE
    tolerance: float = TOLERANCE
    reference_speed: float = REFERENCE_SPEED.usual


class Simulation(OwnsArrays):
    """A vehicle that runs over a track.

    Where its speed is negative it rolls backwards, and it may stand. It serves one thread. A copy, by `copy.copy` or a pickle,
    is in the same state.

    Parameters
    ----------
    vehicle : VehicleDeclaration
    track : ndarray
        Rows of `contact_models.vehicle.course.lay`.
    wheels, rails : sequence of Profile
        Profiles of every wheel and of the rail under it: axle by axle, the right one before the left one; or one for all.
    friction : float or Friction
    options : ContactOptions, optional
    ledgers : sequence of Ledger, optional
        One for each wheel. Those of uneven wheels stay empty.
    uneven : mapping of int to WheelSurface, optional
        Number of a wheel, in the order of `wheels`, and its surface where it is no body of revolution. Its profile in
        `wheels` gives the height at the start.
    sections : sequence of RailSection
        Parts of the rails that are given by slices.
    start : float
        Place of the vehicle's reference at the start [m].
    threads : int
        Threads that share the contacts, at most as many as there are wheels. No bit of a result depends on it. With uneven
        wheels or sections there is one.

    Raises
    ------
    ContactError
        If there are more threads than wheels, or if a section overlaps another one or does not continue the rail.

    Attributes
    ----------
    names : tuple of str
        Names of the bodies.
    model, state, scratch, wheel_arrays
        Arrays of the kernels.
    rotations : ndarray
        Angle by which each wheelset has turned [rad], -pi to pi; it decreases when rolling forward. 0 without uneven wheels
        and sections.
    """

    def __init__(
        self,
        vehicle: VehicleDeclaration,
        track: Array,
        wheels: Profile | tuple[Profile, ...],
        rails: Profile | tuple[Profile, ...],
        friction: float | Friction = 0.3,
        options: ContactOptions | None = None,
        *,
        ledgers: tuple[Ledger, ...] | None = None,
        uneven: Mapping[int, WheelSurface] | None = None,
        sections: Sequence[RailSection] = (),
        start: float = 0.0,
        threads: int = 1,
    ) -> None:
        require_number("threads", threads, 1, 2 * len(vehicle.wheelsets))
        self.vehicle, self._options, self._friction = vehicle, options or ContactOptions(), friction
        require_number("pace", self._options.pace, 1, LONGEST_PACE)
        require_number("tolerance", self._options.tolerance, 0.0, 1.0)
        if (uneven or sections) and np.any(track[TrackRow.SPEED] < 0.0):
            raise ContactError("speed: over wheels that are not round and rails of slices a vehicle runs forwards only")
        made: Assembly = assemble(vehicle)
        self.names = made.names
        n_wheels = 2 * made.wheelsets.size
        wheels, rails = (each if isinstance(each, tuple) else (each,) * n_wheels for each in (wheels, rails))
        surface = as_friction(friction)
        members = surface.members()
        self.model = Model(
            made.bodies, made.links, made.elements, made.table, made.wheelsets, track, made.rail,
            np.array([members["mu"], members["kinetic"]]),
        )  # fmt: skip
        n = len(made.names)
        axles = made.wheelsets.size
        self.state: State = workspace.laid(lay_state, n, made.elements.size, axles)
        self.scratch: Scratch = workspace.laid(lay_scratch, n, n_wheels)
        self._pairs = [
            self._pair(SIDES[k % 2], wheel, rail, ledgers[k] if ledgers else workspace.closed_ledger())
            for k, (wheel, rail) in enumerate(zip(wheels, rails, strict=True))
        ]
        last: LastSolution = workspace.laid(lay_last, n_wheels)
        last.loads[:] = np.repeat(made.bodies["load"][made.wheelsets], 2)
        last.limits[:] = self._options.pace, self._options.tolerance
        self.wheel_arrays: WheelArrays = gather(self._pairs, last)
        for name, value in members.items():
            self.wheel_arrays.cases[name] = value
        self._place(start)
        self.rotations = np.zeros(axles)
        parts = self.model, self.state, self.wheel_arrays, self.scratch
        self._stepper: WheelThreads | UnevenWheels
        self._uneven_memories: dict[str, Array] = {}
        if uneven or sections:
            stretches = self._stretches(wheels, rails, uneven or {}, sections)
            for k, pieces in stretches.items():
                for number, stretch in enumerate(pieces):
                    self._uneven_memories[f"uneven.{k}.{number}"] = stretch.pair.arrays.memory
                    for name, value in members.items():
                        stretch.pair.arrays.case[name] = value
            self._stepper = UnevenWheels(*parts, stretches, self.rotations)
        else:
            self._stepper = WheelThreads(*parts, [pair.arrays for pair in self._pairs[:threads]])

    def _pair(self, side: str, wheel: Profile, rail: Profile, ledger: Ledger) -> WheelRailPair:
        return self._solver(Pair(wheel, rail, **self._sizes(side)), ledger)

    def _stretches(
        self,
        wheels: Sequence[Profile],
        rails: Sequence[Profile],
        uneven: Mapping[int, WheelSurface],
        sections: Sequence[RailSection],
    ) -> dict[int, list[Stretch]]:
        """Return number of a wheel → where it is solved on surfaces: on the sections of its rail, and if uneven everywhere."""
        require_apart(sections)
        found: dict[int, list[Stretch]] = {}
        for k, (wheel, rail) in enumerate(zip(wheels, rails, strict=True)):
            sizes = self._sizes(SIDES[k % 2])
            pieces = []
            for section in sections:
                if section.side == sizes["side"]:
                    if k < len(SIDES):
                        section.require_continued(wheel, rail, sizes)
                    surfaces = section.pair(uneven.get(k, wheel), rail, sizes)
                    pieces.append(Stretch(self._solver(surfaces), section.begin, section.end, section.at))
            if k in uneven:
                surfaces = SurfacePair(uneven[k], rail, **sizes, tilted=True)
                pieces.append(Stretch(self._solver(surfaces)))
            if pieces:
                found[k] = pieces
        return found

    def _sizes(self, side: str) -> dict[str, Any]:
        return {"side": side, **self.vehicle.sizes, "reference_speed": self._options.reference_speed}

    def _solver(self, pair: Pair | SurfacePair, ledger: Ledger | None = None) -> WheelRailPair:
        o = self._options
        return WheelRailPair(
            pair,
            material=o.material,
            normal=o.normal,
            tangential=o.tangential,
            n_strips=o.n_strips,
            n_elements=o.n_elements,
            damage=o.damage,
            ledger=ledger,
        )

    def _place(self, start: float) -> None:
        """Place the vehicle on the rails in its nominal position, rolling without other motion."""
        speed = float(speed_at(self.model.track, start))
        heights = np.zeros(self.model.wheelsets.size)
        for number, i in enumerate(self.model.wheelsets):
            load = float(self.model.bodies[i]["load"])
            heights[number] = 0.5 * sum(self._height(2 * number + side, speed, load) for side in range(2))
        motion.place(self.model, self.state, self.wheel_arrays.motions, heights, float(start), speed)

    def _height(self, wheel: int, speed: float, load: float) -> float:
        """Return the height of a wheelset at which the normal forces of one of its wheels carry the static load."""
        return self._carrying(wheel, Pose(), speed, load).z

    def _carrying(self, wheel: int, pose: Pose, speed: float, load: float) -> PairSolution:
        """Return the contact of a wheel whose normal forces carry `load` [N]; with friction a worn wheel may have none."""
        return self._pairs[wheel].solve(pose, Velocity(speed), load=load, friction=self._friction)

    @one_thread
    def stand_aside(self, lateral: float) -> None:
        """Put all wheelsets `lateral` [m] to the right, rolled so that both wheels carry the static load.

        They turn as the mean of both rolling radii rolls.

        Raises
        ------
        ContactError
            If a wheel does not lie above its rail there.
        """
        speed = float(speed_at(self.model.track, self.distance))
        for number, i in enumerate(self.model.wheelsets):
            load, q = float(self.model.bodies[i]["load"]), self.state.q[i]
            roll = before = difference = last = 0.0
            for trial in range(_MOST_TRIALS):
                pose = Pose(lateral, 0.0, roll)
                right, left = (self._carrying(2 * number + side, pose, speed, load) for side in range(2))
                last, difference = difference, right.z - left.z
                if abs(difference) <= _LEVEL or (trial > 0 and difference == last):
                    break
                slope = (difference - last) / (roll - before) if trial > 0 else -2.0 * _HALF_BASE
                before, roll = roll, roll - difference / slope
            q[Axis.Y], q[Axis.Z], q[Axis.ROLL] = lateral, 0.5 * (right.z + left.z), roll
            # creepage is that of the nominal radius
            slip = [max(each.contacts, key=lambda c: c.N).creepage.longitudinal for each in (right, left)]
            self.state.u[i, Axis.PITCH] = -speed / (self.vehicle.radius * (1.0 - 0.5 * sum(slip)))

    def _kept(self) -> Any:
        return {name: array.copy() for name, array in self.kept.items()}

    def _keep(self, kept: Any) -> None:
        for name, array in self.kept.items():
            array[:] = kept[name]

    def _repr_html_(self) -> str:
        """Return HTML for a notebook: place, time, and what every wheel does, with a sketch of the vertical forces."""
        return of_simulation(self)

    @property
    def distance(self) -> float:
        """Place of the vehicle's reference [m]."""
        return float(self.state.books[Book.DISTANCE])

    @property
    def time(self) -> float:
        """Time since the start [s]."""
        return float(self.state.books[Book.TIME])

    @property
    def wheels(self) -> NDArray:
        """Forces, power and damage of every wheel at the last step: records WHEEL by axle, right before left."""
        return self.scratch.wheels

    @property
    def on_surfaces(self) -> NDArray[np.bool_]:
        """Whether the contact of each wheel was on surfaces at the last step, where no damage is counted."""
        if isinstance(self._stepper, UnevenWheels):
            return self._stepper.on_surfaces
        return np.zeros(self.scratch.wheels.size, np.bool_)

    @property
    def kept(self) -> dict[str, Array]:
        """All that carries over from one step to the next, by name; not copied."""
        last = self.wheel_arrays.last
        return {
            **{f"state.{name}": array for name, array in self.state._asdict().items()},
            "forces": self.scratch.forces,
            "memories": self.wheel_arrays.memories,
            "contacts": self.wheel_arrays.contacts.view(np.float64),
            "totals": self.wheel_arrays.totals.view(np.float64),
            "wheels": self.scratch.wheels.view(np.float64),
            "asked": last.asked.view(np.float64),
            **{
                name: getattr(last, name)
                for name in ("answers", "drifts", "ages", "paces", "noises", "powers", "solutions", "pending")
            },
            "pool": self.wheel_arrays.pool,
            "rotations": self.rotations,
            **self._uneven_memories,
        }

    @one_thread
    def derive_contacts(self) -> tuple[Array, Array]:
        """Return force and moment of every wheel at the present state, and their derivatives by `scratch.given`.

        Shapes (wheels, 6) and (wheels, 6, members of GIVEN). Only on profiles.

        Raises
        ------
        ContactError
            If a contact is on surfaces, or if a wheel has left its rail.
        """
        if isinstance(self._stepper, UnevenWheels):
            raise ContactError(
                "a contact on surfaces changes along the way and has no derivatives of a steady motion: give an amplitude"
            )
        motion.prepare_contacts(
            self.model,
            self.state,
            self.wheel_arrays.motions,
            self.scratch,
            float(speed_at(self.model.track, self.distance)),
        )
        n_given = len(GIVEN.names or ())
        forces, jacobians = np.zeros((len(self._pairs), 6)), np.zeros((len(self._pairs), 6, n_given))
        for w, pair in enumerate(self._pairs):
            given, here, case = self.scratch.given[w], self.scratch.seats[w], pair.arrays.case
            case[0] = self.wheel_arrays.cases[w]
            case["mu"], case["kinetic"], case["speed"] = here["friction"], here["kinetic"], given["vx"]
            self._require_on_rail(-1 - w if pair.solve_given(Height.GIVEN, 0.0, given) < 0 else 0)
            jacobians[w] = pair.derive_given(Height.GIVEN).jacobian[:6, :n_given]
            forces[w] = [pair.arrays.total[0][name] for name in ("Fx", "Fy", "Fz", "Mx", "My", "Mz")]
        return forces, jacobians

    @one_thread
    def advance(self, h: float, steps: int = 1) -> None:
        """Advance by `steps` steps of `h` [s].

        Raises
        ------
        ContactError
            If a wheel leaves its rail. The message has wheel and place.
        """
        self._require_on_rail(self._stepper.advance(float(h), int(steps)))

    def _require_on_rail(self, code: int) -> None:
        """Raise ContactError for the code of a wheel that has left its rail."""
        if code < 0:
            axle, side = divmod(-1 - code, 2)
            raise ContactError(
                f"{self.distance:.2f} m: the {SIDES[side]} wheel of {self.names[self.model.wheelsets[axle]]} has left its rail"
            )
