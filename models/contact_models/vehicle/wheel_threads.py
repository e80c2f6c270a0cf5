"""Threads that share the contacts of a vehicle."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import numpy as np

from contact.core import pack
from contact.instance.ownership import OwnsArrays, one_thread
from contact.kernels.arrays import PairArrays, Search
from .kernels import motion, wheel_threads
from .kernels.layout import Model, Scratch, State
from .kernels.wheel_arrays import WheelArrays


class WheelThreads(OwnsArrays):
    """One thread, or several, that advance a vehicle.

    Parameters
    ----------
    model, state, wheel_arrays, scratch
        Arrays of the kernels.
    memories : sequence of PairArrays
        Scratch memory of each thread.
    """

    def __init__(
        self, model: Model, state: State, wheel_arrays: WheelArrays, scratch: Scratch, memories: Sequence[PairArrays]
    ) -> None:
        kind = WheelArrays[Search]
        self._arrays = pack(Model, model), pack(State, state), pack(kind, wheel_arrays), pack(Scratch, scratch)
        self._helpers = [
            pack(kind, wheel_arrays._replace(shared=memory, scratch=np.zeros_like(wheel_arrays.scratch)))
            for memory in memories[1:]
        ]
        self._n_wheels = scratch.wheels.size
        self._counters = np.zeros(wheel_threads.N_LINE, np.int64)
        self._codes = np.zeros(scratch.wheels.size, np.int64)

    @one_thread
    def advance(self, h: float, steps: int) -> int:
        """Advance by `steps` steps of `h` [s]; return 0 or the code of `kernels.wheels.press`."""
        if not self._helpers:
            return int(motion.advance(*self._arrays, h, steps))
        scratch, shared = self._arrays[-1], (self._counters, self._codes)
        self._counters[wheel_threads.Counter.NEXT], self._counters[wheel_threads.Counter.ENDED] = (
            self._n_wheels,
            0,
        )  # the list is closed
        helpers = [
            threading.Thread(target=wheel_threads.serve, args=(memory, scratch, *shared)) for memory in self._helpers
        ]
        for helper in helpers:
            helper.start()
        code = wheel_threads.lead(*self._arrays, *shared, h, steps)
        for helper in helpers:
            helper.join()
        return int(code)
