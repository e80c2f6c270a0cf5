"""Wheels that are no bodies of revolution: their contacts are solved one by one, at the angle of their wheelset.

Benches of surfaces have other arrays than those of profiles, so `kernels.motion.advance` cannot hold both. Python steps:
it asks, lets every wheel answer by the kernel for its bench, and moves. Each of these is compiled.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact._jit import compiled_for
from contact.pair import WheelRailPair
from models.vehicle.kernels import motion, wheels
from models.vehicle.kernels.benches import Benches
from models.vehicle.kernels.frames import speed_at
from models.vehicle.kernels.layout import Axis, Book, Model, Scratch, State

Array = NDArray[np.float64]


class Uneven:
    """Advances a vehicle of which some wheels are surfaces.

    Parameters
    ----------
    model, state, benches, scratch
        Arrays of the kernels.
    pairs : mapping of int to WheelRailPair
        Number of a wheel and its pair of surfaces. All others use `benches`.
    rotations : ndarray
        Angle by which each wheelset has turned [rad]; it is advanced.
    """

    def __init__(
        self,
        model: Model,
        state: State,
        benches: Benches,
        scratch: Scratch,
        pairs: Mapping[int, WheelRailPair],
        rotations: Array,
    ) -> None:
        self._arrays = model, state, benches, scratch
        self._benches = {w: pair.bench for w, pair in pairs.items()}
        self._rotations = rotations
        self._solve: list[Callable[[], int]] | None = None
        self._ask: Any = None
        self._move: Any = None

    def advance(self, h: float, steps: int) -> int:
        """Advance by `steps` steps of `h` [s]; return 0 or the code of `kernels.wheels.press`."""
        model, state, benches, scratch = self._arrays
        moving = model, state, benches.motions, scratch
        if self._solve is None:
            self._solve = [self._solver(w) for w in range(scratch.wheels.size)]
            self._ask = compiled_for(motion.ask, *moving, h)
            self._move = compiled_for(motion.move, *moving, h, h)
        for _ in range(steps):
            speed = float(speed_at(model.track, model.spacing, state.books[Book.DISTANCE]))
            self._ask(*moving, speed)
            self._turn()
            for w, solve in enumerate(self._solve):
                if solve() < 0:
                    return -1 - w
            self._move(*moving, h, speed)
            turned = self._rotations + h * state.u[model.wheelsets, Axis.PITCH]
            self._rotations[:] = np.remainder(turned + math.pi, 2.0 * math.pi) - math.pi
        return 0

    def _turn(self) -> None:
        """Tell every surface where it is."""
        for w, bench in self._benches.items():
            bench.search.motion["rotation"] = self._rotations[w // 2]

    def _solver(self, w: int) -> Callable[[], int]:
        """Return what solves the contact of wheel `w`."""
        _, _, benches, scratch = self._arrays
        if w in self._benches:
            bench = self._benches[w]
            given = bench, scratch.given[w], scratch.seats[w], scratch.wheels[w]
            one = compiled_for(wheels.press_one, *given)
            return lambda: int(one(*given))
        any_wheel = compiled_for(wheels.follow_wheel, benches, scratch, w)
        return lambda: int(any_wheel(benches, scratch, w))
