"""Wheels that are no bodies of revolution, and rails given by slices: contacts on surfaces, one by one.

Pairs of surfaces have other arrays than those of profiles, so `kernels.motion.advance` cannot hold both. Python steps:
it asks, lets every wheel answer by the kernel for its arrays, and moves. Each of these is compiled.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from contact.arrays import Array
from contact.core import pack
from contact.geometry.surfaces import SurfacePair
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.arrays import Motions, PairArrays, Search, SurfaceSearch
from contact.pair import WheelRailPair
from .kernels import motion, wheels
from .kernels.frames import speed_at
from .kernels.layout import Axis, Book, Model, Scratch, State
from .kernels.wheel_arrays import WheelArrays


class Stretch(NamedTuple):
    """A part of the way on which a wheel is solved on surfaces."""

    pair: WheelRailPair
    begin: float = -math.inf  # places of the axle [m]
    end: float = math.inf
    origin: float = 0.0  # place at which the station of the slices is 0 [m]

    @property
    def surfaces(self) -> SurfacePair:
        """The surfaces of the pair."""
        assert isinstance(self.pair.pair, SurfacePair)
        return self.pair.pair


class UnevenWheels(OwnsArrays):
    """Advances a vehicle of which some wheels, or the rails at some places, are surfaces.

    Parameters
    ----------
    model, state, wheel_arrays, scratch
        Arrays of the kernels.
    stretches : mapping of int to sequence of Stretch
        Number of a wheel and its stretches; the first one that holds its place counts. Outside of them it uses `wheel_arrays`.
    rotations : ndarray
        Angle by which each wheelset has turned [rad]; it is advanced.

    Attributes
    ----------
    on_surfaces : ndarray of bool, shape (wheels,)
        Whether the contact of each wheel was on surfaces at the last step.
    """

    def __init__(
        self,
        model: Model,
        state: State,
        wheel_arrays: WheelArrays,
        scratch: Scratch,
        stretches: Mapping[int, Sequence[Stretch]],
        rotations: Array,
    ) -> None:
        self._arrays = model, state, wheel_arrays, scratch
        self._stretches = [tuple(stretches.get(w, ())) for w in range(scratch.wheels.size)]
        self._rotations = rotations
        self.on_surfaces = np.zeros(scratch.wheels.size, np.bool_)
        self._solvers: dict[tuple[int, Stretch | None], Callable[[], int]] = {}
        self._moving = (
            pack(Model, model),
            pack(State, state),
            pack(Motions, wheel_arrays.motions),
            pack(Scratch, scratch),
        )

    @one_thread
    def advance(self, h: float, steps: int) -> int:
        """Advance by `steps` steps of `h` [s]; return 0 or the code of `kernels.wheels.press`."""
        model, state, _, scratch = self._arrays
        for _ in range(steps):
            speed = float(speed_at(model.track, state.books[Book.DISTANCE]))
            motion.prepare_contacts(*self._moving, speed)
            for w in range(scratch.wheels.size):
                if self._solve(w) < 0:
                    return -1 - w
            motion.move(*self._moving, h, speed)
            turned = self._rotations + h * state.u[model.wheelsets, Axis.PITCH]
            self._rotations[:] = np.remainder(turned + math.pi, 2.0 * math.pi) - math.pi
        return 0

    def _solve(self, w: int) -> int:
        """Solve the contact of wheel `w` where it is; return as `kernels.wheels.solve_contact`."""
        model, state, _, _ = self._arrays
        place = float(state.books[Book.DISTANCE]) + float(model.bodies["place"][model.wheelsets[w // 2]])
        here = next((each for each in self._stretches[w] if each.begin <= place < each.end), None)
        self.on_surfaces[w] = here is not None
        if here is not None:
            moved = here.pair.arrays.search.motion
            moved["station"], moved["rotation"] = place - here.origin, self._rotations[w // 2]
            here.surfaces.follow(place - here.origin)
        if (w, here) not in self._solvers:
            self._solvers[w, here] = self._solver(w, here)
        return self._solvers[w, here]()

    def _solver(self, w: int, here: Stretch | None) -> Callable[[], int]:
        """Return what solves the contact of wheel `w` on a stretch, or on profiles."""
        _, _, wheel_arrays, scratch = self._arrays
        if here is not None:
            arrays = pack(PairArrays[SurfaceSearch], here.pair.arrays._replace(given=scratch.given[w : w + 1]))
            return lambda: int(wheels.solve_contact(arrays, scratch.seats[w], scratch.wheels[w]))
        every, rows = pack(WheelArrays[Search], wheel_arrays), pack(Scratch, scratch)
        return lambda: int(wheels.follow_wheel(every, rows, w))
