"""Threads that share the contacts of a vehicle."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from contact._jit import compiled_for
from contact.kernels.arrays import Bench
from models.vehicle.kernels import crew, motion
from models.vehicle.kernels.benches import Benches
from models.vehicle.kernels.layout import Model, Scratch, State


class Crew:
    """One thread, or several, that advance a vehicle.

    Parameters
    ----------
    model, state, benches, scratch
        Arrays of the kernels.
    memories : sequence of Bench
        Scratch memory of each thread.
    """

    def __init__(
        self, model: Model, state: State, benches: Benches, scratch: Scratch, memories: Sequence[Bench]
    ) -> None:
        self._arrays = model, state, benches, scratch
        self._helpers = [benches._replace(shared=own, scratch=np.zeros_like(benches.scratch)) for own in memories[1:]]
        self._counters = np.zeros(crew.N_LINE, np.int64)
        self._codes = np.zeros(scratch.wheels.size, np.int64)
        self._lead: Callable[..., Any] | None = None
        self._serve: Callable[..., Any] | None = None

    def advance(self, h: float, steps: int) -> int:
        """Advance by `steps` steps of `h` [s]; return 0 or the code of `kernels.wheels.press`."""
        _, _, benches, scratch = self._arrays
        if not self._helpers:
            if self._lead is None:
                self._lead = compiled_for(motion.advance, *self._arrays, h, steps)
            return int(self._lead(*self._arrays, h, steps))
        shared = self._counters, self._codes
        if self._lead is None or self._serve is None:
            self._lead = compiled_for(crew.lead, *self._arrays, *shared, h, steps)
            self._serve = compiled_for(crew.serve, benches, scratch, *shared)
        self._counters[crew.Line.NEXT], self._counters[crew.Line.ENDED] = scratch.wheels.size, 0  # the list is closed
        helpers = [threading.Thread(target=self._serve, args=(own, scratch, *shared)) for own in self._helpers]
        for helper in helpers:
            helper.start()
        code = self._lead(*self._arrays, *shared, h, steps)
        for helper in helpers:
            helper.join()
        return int(code)
